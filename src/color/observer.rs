//! Colour-matching functions.

use super::integration::integral_of_product_2;
use super::table;
use crate::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, PiecewiseLinear};
use crate::{Error, Result};
use glam::DVec3;
use std::sync::LazyLock;

/// Names and tables of data/observers.
const TABLES: [(&str, &str); 4] = [
    ("1931-2", include_str!("../../data/observers/cie_1931_2deg.csv")),
    ("1964-10", include_str!("../../data/observers/cie_1964_10deg.csv")),
    ("2015-2", include_str!("../../data/observers/cie_2015_2deg.csv")),
    ("2015-10", include_str!("../../data/observers/cie_2015_10deg.csv")),
];

static OBSERVERS: LazyLock<[Observer; 4]> = LazyLock::new(|| {
    TABLES.map(|(name, text)| {
        Observer::from_table(name, text).expect("tables of data/observers have the columns x_bar, y_bar, z_bar")
    })
});

/// A standard observer: x̄, ȳ, z̄ over 360–830 nm, linear between samples 1 nm apart, 0 outside.
///
/// The observers of 2015 are published from 390 nm on and are 0 below.
#[derive(Debug, Clone, PartialEq)]
pub struct Observer {
    name: &'static str,
    from_nm: f64,
    curves: [PiecewiseLinear; 3],
    y_integral: f64,
}

impl Observer {
    /// The CIE 1931 standard observer for a field of 2° \[CIE15\].
    pub fn cie_1931_2deg() -> &'static Observer {
        &OBSERVERS[0]
    }

    /// A CIE observer by year and field in degrees: "1931-2" and "1964-10" \[CIE15\], "2015-2" and "2015-10" \[CIE170-2\].
    ///
    /// # Errors
    /// [`UnknownName`](crate::ErrorKind::UnknownName) with the nearest name.
    pub fn by_name(name: &str) -> Result<&'static Observer> {
        OBSERVERS
            .iter()
            .find(|observer| observer.name == name)
            .ok_or_else(|| Error::unknown_name("observer", name, Self::names()))
    }

    /// The names that [`Observer::by_name`] knows.
    pub fn names() -> impl Iterator<Item = &'static str> {
        TABLES.into_iter().map(|(name, _)| name)
    }

    /// The observer's name.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// First and last wavelength of the published table, nm; what lies between that and 360 or 830 nm is 0.
    pub fn published_range_nm(&self) -> (f64, f64) {
        (self.from_nm, LAMBDA_MAX_NM)
    }

    fn from_table(name: &'static str, text: &str) -> Result<Self> {
        let published = [table::column(text, "x_bar")?, table::column(text, "y_bar")?, table::column(text, "z_bar")?];
        let from_nm = published[0].lambdas_nm()[0];
        let curves = published.map(|curve| dark_below(from_nm, curve));
        let one = PiecewiseLinear::new(vec![LAMBDA_MIN_NM], vec![1.0])?;
        let y_integral = integral_of_product_2(&one, &curves[1], LAMBDA_MIN_NM, LAMBDA_MAX_NM);
        Ok(Self { name, from_nm, curves, y_integral })
    }

    /// x̄, ȳ, z̄ at a wavelength in nm; 0 outside 360–830 nm.
    pub fn eval(&self, lambda_nm: f64) -> DVec3 {
        if !(LAMBDA_MIN_NM..=LAMBDA_MAX_NM).contains(&lambda_nm) {
            return DVec3::ZERO;
        }
        let [x, y, z] = self.curves().map(|curve| curve.eval(lambda_nm));
        DVec3::new(x, y, z)
    }

    /// The tables of x̄, ȳ, z̄, right over 360–830 nm (the step of a table that starts above 360 nm is one ulp wide).
    pub fn curves(&self) -> [&PiecewiseLinear; 3] {
        self.curves.each_ref()
    }

    /// ∫ ȳ dλ, nm.
    pub fn y_integral(&self) -> f64 {
        self.y_integral
    }
}

/// A curve that is 0 from 360 nm up to the wavelength where its samples begin.
fn dark_below(from_nm: f64, curve: PiecewiseLinear) -> PiecewiseLinear {
    if from_nm <= LAMBDA_MIN_NM {
        return curve;
    }
    let lambda_nm = [LAMBDA_MIN_NM, from_nm.next_down()].iter().chain(curve.lambdas_nm()).copied().collect();
    let values = [0.0; 2].iter().chain(curve.values()).copied().collect();
    PiecewiseLinear::from_valid_knots(lambda_nm, values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ErrorKind;
    use approx::assert_relative_eq;

    #[test]
    fn has_the_published_values() {
        let observer = Observer::cie_1931_2deg();
        assert_eq!(observer.eval(555.0), DVec3::new(0.512_050_1, 1.0, 0.005_749_999));
        assert_eq!(observer.curves()[0].lambdas_nm().len(), 471);
        // CIE 15 gives the sum of ȳ at 1 nm as 106.857.
        assert_relative_eq!(observer.y_integral(), 106.857, epsilon = 5e-4);
    }

    #[test]
    fn sees_nothing_outside_its_range() {
        let observer = Observer::cie_1931_2deg();
        assert_eq!(observer.eval(359.999), DVec3::ZERO);
        assert_eq!(observer.eval(830.001), DVec3::ZERO);
        assert!(observer.eval(360.0).min_element() > 0.0);
    }

    #[test]
    fn all_four_by_name() {
        // Sums of the columns ȳ of the published tables at 1 nm, added up elsewhere.
        let sums = [106.857, 116.662, 113.042, 118.518];
        for (name, sum) in Observer::names().zip(sums) {
            let observer = Observer::by_name(name).unwrap();
            assert_eq!(observer.name(), name);
            assert!((observer.y_integral() - sum).abs() < 1e-3, "{name}: {}", observer.y_integral());
        }
        assert_eq!(Observer::by_name("1931-2").unwrap(), Observer::cie_1931_2deg());
        let error = Observer::by_name("1931-10").unwrap_err();
        assert_eq!(error.kind, ErrorKind::UnknownName);
        assert!(error.to_string().contains("1931-2, 1964-10, 2015-2, 2015-10"), "{error}");
    }

    #[test]
    fn the_observers_of_2015_begin_at_390_nm() {
        for name in ["2015-2", "2015-10"] {
            let observer = Observer::by_name(name).unwrap();
            assert_eq!(observer.published_range_nm(), (390.0, 830.0));
            assert_eq!(observer.eval(389.999), DVec3::ZERO);
            assert!(observer.eval(390.0).min_element() > 1e-4);
            let below = observer.curves()[2].integral(360.0, 390.0);
            assert!(below < 1e-12, "{name}: {below}");
        }
    }
}
