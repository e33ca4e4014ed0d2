//! Indices of yellowness: 0 for the perfect diffuser, positive for yellowish, negative for bluish.
//!
//! All are NaN for a luminance of 0.

use super::Field;
use glam::DVec3;

/// ASTM D1925, withdrawn in 1995, for illuminant C and 2° \[ASTMD1925\]: 100 (1.28 X − 1.06 Z) / Y.
pub fn yellowness_astm_d1925(xyz: DVec3) -> f64 {
    yellowness_astm_e313_with(xyz, [1.28, 1.06])
}

/// The illuminants that ASTM E313 has coefficients for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum YellownessIlluminant {
    /// CIE C.
    C,
    /// CIE D65.
    D65,
}

/// ASTM E313 for an illuminant and a field \[ASTME313\]: 100 (C_X X − C_Z Z) / Y.
pub fn yellowness_astm_e313(xyz: DVec3, illuminant: YellownessIlluminant, field: Field) -> f64 {
    let coefficients = match (illuminant, field) {
        (YellownessIlluminant::C, Field::Degrees2) => [1.2769, 1.0592],
        (YellownessIlluminant::D65, Field::Degrees2) => [1.2985, 1.1335],
        (YellownessIlluminant::C, Field::Degrees10) => [1.2871, 1.0781],
        (YellownessIlluminant::D65, Field::Degrees10) => [1.3013, 1.1498],
    };
    yellowness_astm_e313_with(xyz, coefficients)
}

/// [`yellowness_astm_e313`] with other coefficients C_X and C_Z.
pub fn yellowness_astm_e313_with(xyz: DVec3, coefficients: [f64; 2]) -> f64 {
    100.0 * (coefficients[0] * xyz.x - coefficients[1] * xyz.z) / xyz.y
}

/// The older ASTM E313 of green and blue alone \[ASTME313\]: 100 (1 − 0.847 Z / Y).
pub fn yellowness_astm_e313_alternative(xyz: DVec3) -> f64 {
    100.0 * (1.0 - 0.847 * xyz.z / xyz.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::xyz_from_xy;

    #[test]
    fn the_white_of_each_index_is_near_0() {
        // The coefficients have four digits, hence 0.01; D1925 has three.
        let whites = [
            (YellownessIlluminant::C, Field::Degrees2, [0.31006, 0.31616]),
            (YellownessIlluminant::D65, Field::Degrees2, [0.31272, 0.32903]),
            (YellownessIlluminant::C, Field::Degrees10, [0.31039, 0.31905]),
            (YellownessIlluminant::D65, Field::Degrees10, [0.31382, 0.33100]),
        ];
        for (illuminant, field, xy) in whites {
            let index = yellowness_astm_e313(xyz_from_xy(xy), illuminant, field);
            assert!(index.abs() < 0.2, "{illuminant:?} {field:?}: {index}");
        }
        let c = xyz_from_xy([0.31006, 0.31616]);
        assert!(yellowness_astm_d1925(c).abs() < 0.5);
        assert!(yellowness_astm_e313_alternative(c).abs() < 0.2);
    }

    #[test]
    fn less_blue_is_more_yellow_and_brightness_does_not_matter() {
        let (white, yellow) = (DVec3::new(0.95, 1.0, 1.08), DVec3::new(0.95, 1.0, 0.9));
        for index in [yellowness_astm_d1925, yellowness_astm_e313_alternative] {
            assert!(index(yellow) > index(white) + 10.0);
            assert!((index(yellow * 0.25) - index(yellow)).abs() < 1e-12);
            assert!(index(DVec3::ZERO).is_nan());
        }
    }
}
