//! The methods by name.

use crate::{Error, Result};

/// A way from RGB to a reflectance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Method {
    /// The smoothest logit plus what measured reflectances of such a colour have in common; the default.
    Natural,
    /// The smoothest logit \[Burns2019\]: no data at all.
    Smoothest,
    /// A sigmoid of a quadratic polynomial \[Jakob2019\], solved to convergence.
    JakobHanika,
    /// Three basis reflectances for sRGB \[Mallett2019\]; spiky, linear in RGB.
    Mallett,
    /// Seven basis reflectances of ten constant bins \[Smits1999\], as published: for the white E, up to 1.0149.
    Smits,
    /// The tables of [`Method::Smits`] joined by straight lines from 380 to 720 nm, as colour-science reads them.
    SmitsLinear,
    /// Principal components of measured reflectances in eight clusters \[Otsu2018\], cut off at 0 and 1.
    Otsu,
    /// The smoothest spectrum that is not negative \[Meng2015\]; may exceed 1.
    Meng,
}

impl Method {
    /// All methods.
    pub const ALL: [Method; 8] = [
        Method::Natural,
        Method::Smoothest,
        Method::JakobHanika,
        Method::Mallett,
        Method::Smits,
        Method::SmitsLinear,
        Method::Otsu,
        Method::Meng,
    ];

    /// Its name: `natural`, `smoothest`, `jakob-hanika`, `mallett`, `smits`, `smits-linear`, `otsu`, `meng`.
    pub fn name(self) -> &'static str {
        match self {
            Method::Natural => "natural",
            Method::Smoothest => "smoothest",
            Method::JakobHanika => "jakob-hanika",
            Method::Mallett => "mallett",
            Method::Smits => "smits",
            Method::SmitsLinear => "smits-linear",
            Method::Otsu => "otsu",
            Method::Meng => "meng",
        }
    }

    /// All names.
    pub fn names() -> impl Iterator<Item = &'static str> {
        Self::ALL.into_iter().map(Self::name)
    }

    /// A method by its name.
    ///
    /// # Errors
    /// [`UnknownName`](crate::ErrorKind::UnknownName) with the nearest name.
    pub fn by_name(name: &str) -> Result<Self> {
        Self::ALL
            .into_iter()
            .find(|method| method.name() == name)
            .ok_or_else(|| Error::unknown_name("method of upsampling", name, Self::names()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ErrorKind;

    #[test]
    fn names_lead_back() {
        for method in Method::ALL {
            assert_eq!(Method::by_name(method.name()).unwrap(), method);
        }
        let error = Method::by_name("jakob").unwrap_err();
        assert_eq!((error.kind, error.nearest.as_deref()), (ErrorKind::UnknownName, Some("jakob-hanika")));
    }
}
