//! Thermal radiation with named constants: Planck's law and its long-wave limit.

use crate::spectrum::{BOLTZMANN, LIGHT_SPEED, PLANCK};
use crate::{Error, Result, math};
use std::f64::consts::PI;

/// The constants of Planck's law.
///
/// A radiator of one temperature under one c₂ is that of another temperature under another: only T / c₂ matters for the
/// relative spectrum. Colorimetry defines colour temperatures on the scale of 1990.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RadiationConstants {
    /// First radiation constant 2πhc², W·m².
    pub c1: f64,
    /// Second radiation constant hc/k, m·K.
    pub c2: f64,
}

impl RadiationConstants {
    /// The values that follow from the exact constants of the SI \[SI2019\]: c₂ = 1.438776877…·10⁻² m·K.
    pub const SI_2019: Self =
        Self { c1: 2.0 * PI * PLANCK * LIGHT_SPEED * LIGHT_SPEED, c2: PLANCK * LIGHT_SPEED / BOLTZMANN };
    /// c₂ = 1.4388·10⁻² m·K of the International Temperature Scale of 1990 \[PrestonThomas1990\], which CIE 15 \[CIE15\] and
    /// colour-science use, with c₁ = 3.741771·10⁻¹⁶ W·m².
    pub const ITS_90: Self = Self { c1: 3.741_771e-16, c2: 1.4388e-2 };

    /// "si-2019" or "its-90".
    ///
    /// # Errors
    /// [`UnknownName`](crate::ErrorKind::UnknownName) with the nearest name.
    pub fn by_name(name: &str) -> Result<Self> {
        match name {
            "si-2019" => Ok(Self::SI_2019),
            "its-90" => Ok(Self::ITS_90),
            _ => Err(Error::unknown_name("radiation constants", name, Self::names())),
        }
    }

    /// The names that [`RadiationConstants::by_name`] knows.
    pub fn names() -> impl Iterator<Item = &'static str> {
        ["si-2019", "its-90"].into_iter()
    }

    /// Spectral radiance of a blackbody in vacuum, W·m⁻²·sr⁻¹·nm⁻¹ \[Planck1901\], at a positive wavelength in nm and a
    /// positive temperature in K.
    pub fn planck_radiance(self, lambda_nm: f64, kelvin: f64) -> f64 {
        let lambda = lambda_nm * 1e-9;
        let lambda_2 = lambda * lambda;
        // c₁ / π λ⁵ / (exp(c₂ / λT) − 1), per metre; 1e-9 makes it per nm.
        1e-9 * self.c1 / (PI * lambda_2 * lambda_2 * lambda * math::exp_m1(self.c2 / (lambda * kelvin)))
    }
}

/// The long-wave limit 2ckT/λ⁴ of Planck's law with the exact constants of the SI, W·m⁻²·sr⁻¹·nm⁻¹.
///
/// Positive wavelength in nm. Larger than Planck's law by the factor (eˣ − 1) / x with x = hc/λkT: by 0.7 % at λT = 1 m·K.
pub fn rayleigh_jeans_radiance(lambda_nm: f64, kelvin: f64) -> f64 {
    let lambda = lambda_nm * 1e-9;
    let lambda_2 = lambda * lambda;
    1e-9 * 2.0 * LIGHT_SPEED * BOLTZMANN * kelvin / (lambda_2 * lambda_2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ErrorKind;
    use crate::spectrum::planck_radiance;
    use approx::assert_relative_eq;

    #[test]
    fn the_exact_constants_are_those_of_the_renderer() {
        assert_relative_eq!(RadiationConstants::SI_2019.c2, 1.438_776_877e-2, max_relative = 1e-9);
        for (lambda, kelvin) in [(360.0, 500.0), (555.0, 2856.0), (830.0, 1e6)] {
            let same = RadiationConstants::SI_2019.planck_radiance(lambda, kelvin);
            assert_relative_eq!(same, planck_radiance(lambda, kelvin), max_relative = 1e-14);
        }
    }

    #[test]
    fn only_the_ratio_of_temperature_and_second_constant_shapes_a_spectrum() {
        let (si, its) = (RadiationConstants::SI_2019, RadiationConstants::ITS_90);
        let ratio = |lambda| {
            its.planck_radiance(lambda, 6500.0 * its.c2 / si.c2) / si.planck_radiance(lambda, 6500.0) * si.c1 / its.c1
        };
        for lambda in [360.0, 555.0, 830.0] {
            assert_relative_eq!(ratio(lambda), 1.0, max_relative = 1e-14);
        }
    }

    #[test]
    fn the_long_wave_limit_is_reached_from_above() {
        // (e^x − 1) / x = 1 + x/2 + x²/6 + … with x = c₂ / λT = 0.0143877….
        let x = RadiationConstants::SI_2019.c2;
        let ratio = rayleigh_jeans_radiance(1e6, 1000.0) / planck_radiance(1e6, 1000.0);
        assert_relative_eq!(ratio, 1.0 + x / 2.0 + x * x / 6.0 + x * x * x / 24.0, max_relative = 1e-9);
    }

    #[test]
    fn names() {
        for name in RadiationConstants::names() {
            assert!(RadiationConstants::by_name(name).is_ok());
        }
        let error = RadiationConstants::by_name("its90").unwrap_err();
        assert_eq!((error.kind, error.nearest.as_deref()), (ErrorKind::UnknownName, Some("its-90")));
    }
}
