//! Tristimulus values by the exact rule.

use super::Observer;
use super::integration::{integral_of_product_2, integral_of_product_3};
use crate::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, Spectrum};
use crate::{Error, ErrorKind, Result};
use glam::DVec3;

/// XYZ of an emission: ∫ L x̄ dλ / ∫ ȳ dλ, so that L = 1 has Y = 1.
///
/// Exact for constants and tables; blackbodies and lines are integrated as they are tabulated
/// ([`Spectrum::tabulate`]), which changes their XYZ by less than 1e-5.
pub fn xyz_of_emission(emission: &Spectrum, observer: &Observer) -> DVec3 {
    let emission = emission.tabulate();
    let integrate = |curve| integral_of_product_2(&emission, curve, LAMBDA_MIN_NM, LAMBDA_MAX_NM);
    DVec3::from(observer.curves().map(integrate)) / observer.y_integral()
}

/// XYZ of a reflectance (or transmittance) under an illuminant: ∫ R S x̄ dλ / ∫ S ȳ dλ, so that R = 1 has Y = 1.
///
/// The illuminant's scale does not matter, but its luminance must not be 0 (the result is NaN then).
pub fn xyz_of_reflectance(reflectance: &Spectrum, illuminant: &Spectrum, observer: &Observer) -> DVec3 {
    let (reflectance, illuminant) = (reflectance.tabulate(), illuminant.tabulate());
    let integrate = |curve| integral_of_product_3(&reflectance, &illuminant, curve, LAMBDA_MIN_NM, LAMBDA_MAX_NM);
    let y_of_white = integral_of_product_2(&illuminant, observer.curves()[1], LAMBDA_MIN_NM, LAMBDA_MAX_NM);
    DVec3::from(observer.curves().map(integrate)) / y_of_white
}

/// The spectrum times the factor that gives it Y = 1.
///
/// # Errors
/// A luminance that is not positive, or so small or large that the factor is not a finite number.
pub fn normalized_to_unit_luminance(spectrum: Spectrum, observer: &Observer) -> Result<Spectrum> {
    if spectrum.is_constant().is_some_and(|value| value > 0.0) {
        return Ok(Spectrum::Constant(1.0));
    }
    let y = xyz_of_emission(&spectrum, observer).y;
    if y > 0.0 && (1.0 / y).is_finite() {
        return Ok(spectrum.scaled(1.0 / y));
    }
    let message = format!("luminance {y:e} over 360–830 nm; expected a positive one to normalise by");
    Err(Error::new(ErrorKind::OutOfRange, message))
}

/// Chromaticity x, y of XYZ; NaN for black.
pub fn chromaticity(xyz: DVec3) -> [f64; 2] {
    let sum = xyz.element_sum();
    [xyz.x / sum, xyz.y / sum]
}

/// XYZ of a chromaticity x, y at Y = 1.
pub fn xyz_from_xy(xy: [f64; 2]) -> DVec3 {
    DVec3::new(xy[0] / xy[1], 1.0, (1.0 - xy[0] - xy[1]) / xy[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::illuminant;
    use crate::spectrum::PiecewiseLinear;
    use approx::assert_relative_eq;

    #[test]
    fn unit_radiance_is_near_the_equal_energy_white() {
        let xyz = xyz_of_emission(&Spectrum::Constant(1.0), Observer::cie_1931_2deg());
        assert_eq!(xyz.y, 1.0);
        assert!((xyz.x - 1.0).abs() < 2e-4 && (xyz.z - 1.0).abs() < 5e-4, "{xyz}");
    }

    #[test]
    fn a_white_reflectance_is_its_illuminant() {
        let observer = Observer::cie_1931_2deg();
        for name in ["A", "D65", "FL11", "HP1", "LED-RGB1"] {
            let lamp = illuminant::by_name(name).unwrap();
            let white = xyz_of_reflectance(&Spectrum::Constant(1.0), &lamp, observer);
            let grey = xyz_of_reflectance(&Spectrum::Constant(0.25), &lamp.clone().scaled(7.0), observer);
            assert_relative_eq!(white.y, 1.0, max_relative = 1e-14);
            assert!((white - xyz_of_emission(&lamp, observer)).abs().max_element() < 1e-13, "{name}");
            assert!((white * 0.25 - grey).abs().max_element() < 1e-14, "{name}");
        }
    }

    #[test]
    fn a_narrow_line_sees_the_observer_at_its_centre() {
        let observer = Observer::cie_1931_2deg();
        let xyz = xyz_of_emission(&Spectrum::line(632.816, 0.01).unwrap(), observer);
        let expected = observer.eval(632.816) / observer.y_integral();
        assert!(((xyz - expected) / expected).abs().max_element() < 1e-9, "{xyz} {expected}");
    }

    #[test]
    fn blackbodies_have_the_published_chromaticity() {
        // CIE illuminant A is a Planckian radiator of 2855.5 K: x, y = 0.44758, 0.40745.
        let body = Spectrum::blackbody(2855.5).unwrap();
        let xy = chromaticity(xyz_of_emission(&body, Observer::cie_1931_2deg()));
        assert!((xy[0] - 0.44758).abs() < 1e-4 && (xy[1] - 0.40745).abs() < 1e-4, "{xy:?}");
    }

    #[test]
    fn normalising_gives_unit_luminance_or_says_why_not() {
        let observer = Observer::cie_1931_2deg();
        let body = normalized_to_unit_luminance(Spectrum::blackbody(5600.0).unwrap(), observer).unwrap();
        assert_relative_eq!(xyz_of_emission(&body, observer).y, 1.0, max_relative = 1e-14);
        let constant = normalized_to_unit_luminance(Spectrum::Constant(3.0), observer).unwrap();
        assert_eq!(constant, Spectrum::Constant(1.0));
        for dark in [Spectrum::Constant(0.0), Spectrum::Constant(-1.0), Spectrum::blackbody(5.0).unwrap()] {
            assert_eq!(normalized_to_unit_luminance(dark, observer).unwrap_err().kind, ErrorKind::OutOfRange);
        }
    }

    #[test]
    fn a_finer_table_of_the_same_function_changes_nothing() {
        let observer = Observer::cie_1931_2deg();
        let coarse = PiecewiseLinear::new(vec![380.0, 520.5, 700.0], vec![0.1, 0.9, 0.2]).unwrap();
        let knots: Vec<f64> = (0..=640).map(|i| 380.0 + 0.5 * f64::from(i)).collect();
        let fine = PiecewiseLinear::new(knots.clone(), coarse.eval_ascending(&knots)).unwrap();
        let [coarse, fine] = [coarse, fine].map(|t| xyz_of_emission(&Spectrum::PiecewiseLinear(t), observer));
        assert!((coarse - fine).abs().max_element() < 1e-10, "{}", coarse - fine);
    }

    #[test]
    fn chromaticity_and_back() {
        let xyz = xyz_from_xy([0.3127, 0.3290]);
        let [x, y] = chromaticity(xyz);
        assert_relative_eq!(x, 0.3127, max_relative = 1e-15);
        assert_relative_eq!(y, 0.3290, max_relative = 1e-15);
        assert_eq!(xyz.y, 1.0);
    }
}
