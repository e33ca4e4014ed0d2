//! Hunter Lab and Hunter Rdab.

use glam::DVec3;

/// Kₐ and K_b of a white: 175 √(X/0.98043), 70 √(Z/1.18115), which are 175 and 70 for illuminant C \[Hunter1966\].
///
/// Instruments round them to 172.30 and 67.20 for D65, which changes a and b by up to 1e-3 of their values.
pub fn hunter_coefficients(white_xyz: DVec3) -> [f64; 2] {
    [175.0 * (white_xyz.x / 0.980_43).sqrt(), 70.0 * (white_xyz.z / 1.181_15).sqrt()]
}

/// L, a, b of Hunter \[Hunter1966\] for a white and its coefficients ([`hunter_coefficients`]); white is (100, 0, 0).
///
/// Black is (0, 0, 0). NaN for negative luminance, infinite for a luminance of 0 with other components.
pub fn hunter_lab_from_xyz(xyz: DVec3, white_xyz: DVec3, coefficients: [f64; 2]) -> DVec3 {
    if xyz == DVec3::ZERO {
        return DVec3::ZERO;
    }
    let DVec3 { x, y, z } = xyz / white_xyz;
    let root = y.sqrt();
    DVec3::new(100.0 * root, coefficients[0] * ((x - y) / root), coefficients[1] * ((y - z) / root))
}

/// Inverse of [`hunter_lab_from_xyz`].
pub fn xyz_from_hunter_lab(lab: DVec3, white_xyz: DVec3, coefficients: [f64; 2]) -> DVec3 {
    let root = lab.x / 100.0;
    let y = root * root;
    DVec3::new(lab.y / coefficients[0] * root + y, y, y - lab.z / coefficients[1] * root) * white_xyz
}

/// How Hunter Rdab scales its opponent axes at a luminance.
fn rdab_scale(y: f64) -> f64 {
    let y = 20.0 * y;
    0.51 * ((21.0 + y) / (1.0 + y))
}

/// Rd, a, b of Hunter \[Hunter1966\]: luminance in per cent and opponent axes that need no root. White is (100, 0, 0).
pub fn hunter_rdab_from_xyz(xyz: DVec3, white_xyz: DVec3, coefficients: [f64; 2]) -> DVec3 {
    let DVec3 { x, y, z } = xyz / white_xyz;
    let scale = rdab_scale(xyz.y);
    DVec3::new(100.0 * xyz.y, coefficients[0] * scale * (x - y), coefficients[1] * scale * (y - z))
}

/// Inverse of [`hunter_rdab_from_xyz`].
pub fn xyz_from_hunter_rdab(rdab: DVec3, white_xyz: DVec3, coefficients: [f64; 2]) -> DVec3 {
    let luminance = rdab.x / 100.0;
    let (scale, y) = (rdab_scale(luminance), luminance / white_xyz.y);
    let [x, z] = [y + rdab.y / (coefficients[0] * scale), y - rdab.z / (coefficients[1] * scale)];
    DVec3::new(x * white_xyz.x, luminance, z * white_xyz.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::xyz_from_xy;
    use proptest::prelude::*;

    #[test]
    fn illuminant_c_has_the_design_coefficients() {
        let c = DVec3::new(0.98043, 1.0, 1.18115);
        assert_eq!(hunter_coefficients(c), [175.0, 70.0]);
        assert_eq!(hunter_lab_from_xyz(c, c, [175.0, 70.0]), DVec3::new(100.0, 0.0, 0.0));
        assert_eq!(hunter_rdab_from_xyz(c, c, [175.0, 70.0]), DVec3::new(100.0, 0.0, 0.0));
        assert_eq!(hunter_lab_from_xyz(DVec3::ZERO, c, [175.0, 70.0]), DVec3::ZERO);
        assert_eq!(xyz_from_hunter_lab(DVec3::ZERO, c, [175.0, 70.0]), DVec3::ZERO);
    }

    proptest! {
        #[test]
        fn round_trips(x in 0.0..2.0_f64, y in 1e-4..2.0_f64, z in 0.0..2.0_f64) {
            let (xyz, white) = (DVec3::new(x, y, z), xyz_from_xy([0.3127, 0.3290]));
            let k = hunter_coefficients(white);
            for back in [
                xyz_from_hunter_lab(hunter_lab_from_xyz(xyz, white, k), white, k),
                xyz_from_hunter_rdab(hunter_rdab_from_xyz(xyz, white, k), white, k),
            ] {
                prop_assert!((back - xyz).abs().max_element() < 1e-13, "{back} {xyz}");
            }
        }
    }
}
