//! CIE 1960 UCS (U, V, W and u, v) and CIE 1964 U\*V\*W\*.

use crate::math;
use glam::DVec3;

/// U, V, W of the CIE 1960 uniform chromaticity scale \[Wyszecki2000\]: linear in XYZ.
pub fn ucs_from_xyz(xyz: DVec3) -> DVec3 {
    DVec3::new(2.0 / 3.0 * xyz.x, xyz.y, 0.5 * (3.0 * xyz.y - xyz.x + xyz.z))
}

/// Inverse of [`ucs_from_xyz`].
pub fn xyz_from_ucs(ucs: DVec3) -> DVec3 {
    let x = 1.5 * ucs.x;
    DVec3::new(x, ucs.y, x - 3.0 * ucs.y + 2.0 * ucs.z)
}

/// u, v of CIE 1960, in which correlated colour temperature is defined \[CIE15\]; NaN for black.
pub fn uv_1960_from_xyz(xyz: DVec3) -> [f64; 2] {
    let sum = xyz.x + 15.0 * xyz.y + 3.0 * xyz.z;
    [4.0 * xyz.x / sum, 6.0 * xyz.y / sum]
}

/// Chromaticity x, y of u, v of CIE 1960.
pub fn xy_from_uv_1960(uv: [f64; 2]) -> [f64; 2] {
    let [u, v] = uv;
    let sum = 2.0 * u - 8.0 * v + 4.0;
    [3.0 * u / sum, 2.0 * v / sum]
}

/// XYZ of u, v of CIE 1960 and a luminance Y; black for Y = 0.
pub fn xyz_from_uv_1960_y(uv: [f64; 2], y: f64) -> DVec3 {
    if y == 0.0 {
        return DVec3::ZERO;
    }
    let [u, v] = uv;
    DVec3::new(1.5 * y * u / v, y, y * (2.0 - 0.5 * u - 5.0 * v) / v)
}

/// U\*, V\*, W\* of CIE 1964 \[Wyszecki1963\] for a white's chromaticity; W\* is meant for 0.01 ≤ Y ≤ 0.98.
///
/// Black, which has no chromaticity, gets that of white: (0, 0, −17). Negative luminance keeps its sign under the root.
pub fn uvw_from_xyz(xyz: DVec3, white_xyz: DVec3) -> DVec3 {
    let w = 25.0 * math::cbrt(100.0 * xyz.y) - 17.0;
    if xyz == DVec3::ZERO {
        return DVec3::new(0.0, 0.0, w);
    }
    let ([u, v], [white_u, white_v]) = (uv_1960_from_xyz(xyz), uv_1960_from_xyz(white_xyz));
    DVec3::new(13.0 * w * (u - white_u), 13.0 * w * (v - white_v), w)
}

/// Inverse of [`uvw_from_xyz`] for Y ≠ 0 and black. Where W\* = 0 (Y = 0.0031) all chromaticities fall together, and it
/// gives that of white.
pub fn xyz_from_uvw(uvw: DVec3, white_xyz: DVec3) -> DVec3 {
    let root = (uvw.z + 17.0) / 25.0;
    let y = root * root * root / 100.0;
    let [white_u, white_v] = uv_1960_from_xyz(white_xyz);
    let offset = |coordinate: f64| if uvw.z == 0.0 { 0.0 } else { coordinate / (13.0 * uvw.z) };
    xyz_from_uv_1960_y([white_u + offset(uvw.x), white_v + offset(uvw.y)], y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{chromaticity, xyz_from_xy};
    use proptest::prelude::*;

    #[test]
    fn known_points() {
        let white = xyz_from_xy([0.31006, 0.31616]);
        let uvw = uvw_from_xyz(white, white);
        assert_eq!((uvw.x, uvw.y), (0.0, 0.0));
        assert!((uvw.z - 99.03972).abs() < 1e-5, "{uvw}");
        assert_eq!(uvw_from_xyz(DVec3::ZERO, white), DVec3::new(0.0, 0.0, -17.0));
        assert_eq!(xyz_from_uvw(DVec3::new(0.0, 0.0, -17.0), white), DVec3::ZERO);
        assert_eq!(uv_1960_from_xyz(DVec3::ONE), [4.0 / 19.0, 6.0 / 19.0]);
        let ucs = ucs_from_xyz(DVec3::ONE);
        assert_eq!(ucs.x / ucs.element_sum(), 4.0 / 19.0);
    }

    proptest! {
        #[test]
        fn round_trips(x in 0.0..2.0_f64, y in 0.01..2.0_f64, z in 0.0..2.0_f64) {
            let (xyz, white) = (DVec3::new(x, y, z), xyz_from_xy([0.3457, 0.3585]));
            prop_assert!((xyz_from_ucs(ucs_from_xyz(xyz)) - xyz).abs().max_element() < 1e-14);
            let back = xyz_from_uvw(uvw_from_xyz(xyz, white), white);
            prop_assert!((back - xyz).abs().max_element() < 1e-11, "{back} {xyz}");
            let [a, b] = [xy_from_uv_1960(uv_1960_from_xyz(xyz)), chromaticity(xyz)];
            prop_assert!((a[0] - b[0]).abs() < 1e-13 && (a[1] - b[1]).abs() < 1e-13);
        }
    }
}
