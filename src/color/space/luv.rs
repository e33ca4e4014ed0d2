//! CIE 1976 L\*u\*v\* and its uniform chromaticity scale u′, v′.

use crate::color::lightness::{lightness_cie_1976, luminance_cie_1976};
use glam::DVec3;

/// u′, v′ of CIE 1976 \[CIE15\]; NaN for black.
pub fn uv_1976_from_xyz(xyz: DVec3) -> [f64; 2] {
    let sum = xyz.x + 15.0 * xyz.y + 3.0 * xyz.z;
    [4.0 * xyz.x / sum, 9.0 * xyz.y / sum]
}

/// Chromaticity x, y of u′, v′.
pub fn xy_from_uv_1976(uv: [f64; 2]) -> [f64; 2] {
    let [u, v] = uv;
    let sum = 6.0 * u - 16.0 * v + 12.0;
    [9.0 * u / sum, 4.0 * v / sum]
}

/// XYZ of u′, v′ and a luminance Y; black for Y = 0.
pub fn xyz_from_uv_1976_y(uv: [f64; 2], y: f64) -> DVec3 {
    if y == 0.0 {
        return DVec3::ZERO;
    }
    let [u, v] = uv;
    DVec3::new(9.0 * y * u / (4.0 * v), y, y * (12.0 - 3.0 * u - 20.0 * v) / (4.0 * v))
}

/// L\*, u\*, v\* of XYZ for a white with positive Y \[CIE15\]; white has (100, 0, 0), and Y = 0 has (0, 0, 0).
///
/// Negative luminance has a negative L\*. Infinite where X + 15 Y + 3 Z is 0 and Y is not.
pub fn luv_from_xyz(xyz: DVec3, white_xyz: DVec3) -> DVec3 {
    let lightness = lightness_cie_1976(xyz.y / white_xyz.y);
    if xyz.y == 0.0 {
        return DVec3::ZERO;
    }
    let ([u, v], [white_u, white_v]) = (uv_1976_from_xyz(xyz), uv_1976_from_xyz(white_xyz));
    DVec3::new(lightness, 13.0 * lightness * (u - white_u), 13.0 * lightness * (v - white_v))
}

/// Inverse of [`luv_from_xyz`] for Y ≠ 0; black for L\* = 0.
pub fn xyz_from_luv(luv: DVec3, white_xyz: DVec3) -> DVec3 {
    if luv.x == 0.0 {
        return DVec3::ZERO;
    }
    let [white_u, white_v] = uv_1976_from_xyz(white_xyz);
    let uv = [luv.y / (13.0 * luv.x) + white_u, luv.z / (13.0 * luv.x) + white_v];
    xyz_from_uv_1976_y(uv, luminance_cie_1976(luv.x) * white_xyz.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{chromaticity, xyz_from_xy};
    use proptest::prelude::*;

    #[test]
    fn white_and_black() {
        let white = xyz_from_xy([0.3127, 0.3290]);
        assert!((luv_from_xyz(white, white) - DVec3::new(100.0, 0.0, 0.0)).abs().max_element() < 1e-13);
        assert_eq!(luv_from_xyz(DVec3::ZERO, white), DVec3::ZERO);
        assert_eq!(xyz_from_luv(DVec3::ZERO, white), DVec3::ZERO);
        // A stimulus without luminance has no place in the diagram's lightness: black.
        assert_eq!(luv_from_xyz(DVec3::new(0.1, 0.0, 0.2), white), DVec3::ZERO);
        // CIE 15: u', v' of the equal-energy white are 4/19, 9/19.
        assert_eq!(uv_1976_from_xyz(DVec3::ONE), [4.0 / 19.0, 9.0 / 19.0]);
        assert!(uv_1976_from_xyz(DVec3::ZERO)[0].is_nan());
    }

    proptest! {
        #[test]
        fn round_trips(x in 0.0..2.0_f64, y in 1e-6..2.0_f64, z in 0.0..2.0_f64) {
            let (xyz, white) = (DVec3::new(x, y, z), xyz_from_xy([0.3457, 0.3585]));
            let scale = xyz.max_element();
            let back = xyz_from_luv(luv_from_xyz(xyz, white), white);
            // Divided by v', which is small for a stimulus with little luminance.
            let condition = scale / y;
            prop_assert!((back - xyz).abs().max_element() < 1e-14 * scale * condition.max(10.0), "{back} {xyz}");
            let [a, b] = [xy_from_uv_1976(uv_1976_from_xyz(xyz)), chromaticity(xyz)];
            prop_assert!((a[0] - b[0]).abs() < 1e-13 && (a[1] - b[1]).abs() < 1e-13);
        }
    }
}
