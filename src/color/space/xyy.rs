//! Chromaticity and luminance.

use glam::DVec3;

/// x, y, Y of XYZ \[CIE15\]; (0, 0, Y) where X + Y + Z = 0, as black, which has no chromaticity.
pub fn xyy_from_xyz(xyz: DVec3) -> DVec3 {
    let sum = xyz.element_sum();
    if sum == 0.0 { DVec3::new(0.0, 0.0, xyz.y) } else { DVec3::new(xyz.x / sum, xyz.y / sum, xyz.y) }
}

/// XYZ of x, y, Y; black for Y = 0 whatever the chromaticity. Infinite for y = 0 with another Y.
///
/// It inverts [`xyy_from_xyz`] for every XYZ with Y ≠ 0, and for black.
pub fn xyz_from_xyy(xyy: DVec3) -> DVec3 {
    if xyy.z == 0.0 {
        return DVec3::ZERO;
    }
    let scale = xyy.z / xyy.y;
    DVec3::new(xyy.x * scale, xyy.z, (1.0 - (xyy.x + xyy.y)) * scale)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn black_is_black() {
        assert_eq!(xyy_from_xyz(DVec3::ZERO), DVec3::ZERO);
        assert_eq!(xyz_from_xyy(DVec3::ZERO), DVec3::ZERO);
        assert_eq!(xyz_from_xyy(DVec3::new(0.3, 0.0, 0.0)), DVec3::ZERO);
        assert_eq!(xyy_from_xyz(DVec3::new(1.0, 1.0, 2.0)), DVec3::new(0.25, 0.25, 1.0));
    }

    proptest! {
        #[test]
        fn round_trip(x in 0.0..2.0_f64, y in 1e-3..2.0_f64, z in 0.0..2.0_f64) {
            let xyz = DVec3::new(x, y, z);
            prop_assert!((xyz_from_xyy(xyy_from_xyz(xyz)) - xyz).abs().max_element() < 1e-12);
        }
    }
}
