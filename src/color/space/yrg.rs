//! Yrg: luminance and a chromaticity diagram of the CIE 2006 cones, made for grading.

use glam::{DMat3, DVec3};
use std::sync::LazyLock;

/// CIE 2006 cones from CIE 1931 XYZ \[Kirk2019\].
const CONES_FROM_XYZ: DMat3 = DMat3::from_cols(
    DVec3::new(0.257_085, -0.394_427, 0.064_856),
    DVec3::new(0.859_943, 1.175_800, -0.076_250),
    DVec3::new(-0.031_061, 0.106_423, 0.559_067),
);
/// Luminance of L and M.
const LUMINANCE: [f64; 2] = [0.689_902_72, 0.348_321_89];

static XYZ_FROM_CONES: LazyLock<DMat3> = LazyLock::new(|| CONES_FROM_XYZ.inverse());

/// Y, r, g of XYZ \[Kirk2019\]; black, which has no chromaticity, is 0 with r and g of no cone at all.
pub fn yrg_from_xyz(xyz: DVec3) -> DVec3 {
    let cones = CONES_FROM_XYZ * xyz;
    let sum = cones.element_sum();
    let (l, m) = if sum == 0.0 { (0.0, 0.0) } else { (cones.x / sum, cones.y / sum) };
    DVec3::new(
        LUMINANCE[0] * cones.x + LUMINANCE[1] * cones.y,
        1.0671 * l - 0.6873 * m + 0.02062,
        -0.0362 * l + 1.7182 * m - 0.05155,
    )
}

/// Inverse of [`yrg_from_xyz`], of its rounded matrix and not the paper's own inverse, which is rounded too (to two digits)
/// and off by 1e-4. Black for Y = 0.
pub fn xyz_from_yrg(yrg: DVec3) -> DVec3 {
    if yrg.x == 0.0 {
        return DVec3::ZERO;
    }
    let (r, g) = (yrg.y - 0.02062, yrg.z + 0.05155);
    let determinant = 1.0671 * 1.7182 - 0.6873 * 0.0362;
    let l = (1.7182 * r + 0.6873 * g) / determinant;
    let m = (0.0362 * r + 1.0671 * g) / determinant;
    let sum = yrg.x / (LUMINANCE[0] * l + LUMINANCE[1] * m);
    *XYZ_FROM_CONES * (DVec3::new(l, m, 1.0 - l - m) * sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::xyz_from_xy;
    use proptest::prelude::*;

    #[test]
    fn black_and_luminance() {
        assert_eq!(yrg_from_xyz(DVec3::ZERO).x, 0.0);
        assert_eq!(xyz_from_yrg(yrg_from_xyz(DVec3::ZERO)), DVec3::ZERO);
        // The luminance of 2006 is near that of 1931 for a white.
        assert!((yrg_from_xyz(xyz_from_xy([0.3127, 0.3290])).x - 1.0).abs() < 0.06);
    }

    proptest! {
        #[test]
        fn round_trip(x in 0.05..2.0_f64, y in 0.05..2.0_f64, z in 0.0..2.0_f64) {
            let xyz = DVec3::new(x, y, z);
            let back = xyz_from_yrg(yrg_from_xyz(xyz));
            prop_assert!((back - xyz).abs().max_element() < 1e-11, "{back} {xyz}");
        }
    }
}
