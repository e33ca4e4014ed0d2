//! ProLab: Lab's uniformity by a projective map, under which straight lines stay straight.

use glam::{DMat3, DVec3};
use std::sync::LazyLock;

/// Linear part of the map, applied to XYZ over white.
const NUMERATOR: DMat3 = DMat3::from_cols(
    DVec3::new(75.54, 617.72, 48.34),
    DVec3::new(486.66, -595.45, 194.94),
    DVec3::new(167.39, -22.27, -243.28),
);
/// The denominator is 1 plus the product with this.
const DENOMINATOR: DVec3 = DVec3::new(0.7554, 3.8666, 1.6739);

static NUMERATOR_INVERSE: LazyLock<DMat3> = LazyLock::new(|| NUMERATOR.inverse());

/// ProLab of XYZ for a white \[Konovalenko2021\]; white is near (100, 0, 0), black (0, 0, 0).
///
/// Infinite where the denominator 1 + 0.7554 X + 3.8666 Y + 1.6739 Z (over white) is 0, which no light reaches.
pub fn prolab_from_xyz(xyz: DVec3, white_xyz: DVec3) -> DVec3 {
    let ratios = xyz / white_xyz;
    NUMERATOR * ratios / (1.0 + DENOMINATOR.dot(ratios))
}

/// Inverse of [`prolab_from_xyz`].
pub fn xyz_from_prolab(prolab: DVec3, white_xyz: DVec3) -> DVec3 {
    // From p = N r / (1 + d·r): r = (1 + d·r) N⁻¹ p, and so 1 + d·r = 1 / (1 − d·N⁻¹ p).
    let direction = *NUMERATOR_INVERSE * prolab;
    white_xyz * direction / (1.0 - DENOMINATOR.dot(direction))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::xyz_from_xy;
    use proptest::prelude::*;

    #[test]
    fn white_black_and_straight_lines() {
        let white = xyz_from_xy([0.3127, 0.3290]);
        let at_white = prolab_from_xyz(white, white);
        assert!((at_white - DVec3::new(100.0, 0.0, 0.0)).abs().max_element() < 0.01, "{at_white}");
        assert_eq!(prolab_from_xyz(DVec3::ZERO, white), DVec3::ZERO);
        let (a, b) = (DVec3::new(0.4, 0.2, 0.1), DVec3::new(0.1, 0.3, 0.9));
        let [start, middle, end] = [a, a.midpoint(b), b].map(|xyz| prolab_from_xyz(xyz, white));
        assert!((middle - start).cross(end - start).length() < 1e-11);
    }

    proptest! {
        #[test]
        fn round_trip(x in 0.0..2.0_f64, y in 0.0..2.0_f64, z in 0.0..2.0_f64) {
            let (xyz, white) = (DVec3::new(x, y, z), xyz_from_xy([0.3457, 0.3585]));
            let back = xyz_from_prolab(prolab_from_xyz(xyz, white), white);
            prop_assert!((back - xyz).abs().max_element() < 1e-12, "{back} {xyz}");
        }
    }
}
