//! CIE 1976 L\*a\*b\*, and polar coordinates of any space with a lightness and two opponent axes.

use crate::color::lightness::{ratio_cie_1976, response_cie_1976};
use crate::math;
use glam::DVec3;
use std::f64::consts::PI;

/// L\*, a\*, b\* of XYZ for a white with positive components \[CIE15\]; white has (100, 0, 0).
///
/// Total: below (6/29)³ of white each response is a straight line, which goes on for negative XYZ.
pub fn lab_from_xyz(xyz: DVec3, white_xyz: DVec3) -> DVec3 {
    let [x, y, z] = (xyz / white_xyz).to_array().map(response_cie_1976);
    DVec3::new(116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z))
}

/// Inverse of [`lab_from_xyz`].
pub fn xyz_from_lab(lab: DVec3, white_xyz: DVec3) -> DVec3 {
    let y = (lab.x + 16.0) / 116.0;
    let responses = [lab.y / 500.0 + y, y, y - lab.z / 200.0];
    DVec3::from(responses.map(ratio_cie_1976)) * white_xyz
}

/// Lightness, chroma and hue angle in degrees, [0, 360), of a lightness and two opponent coordinates: LCh of Lab, Luv,
/// Oklab and their like. The hue of a grey is 0.
pub fn lch_from_lab(lab: DVec3) -> DVec3 {
    DVec3::new(lab.x, math::hypot(lab.y, lab.z), hue_degrees(lab.y, lab.z))
}

/// Inverse of [`lch_from_lab`]; hues outside [0, 360) are taken modulo 360.
pub fn lab_from_lch(lch: DVec3) -> DVec3 {
    let hue = lch.z % 360.0 * (PI / 180.0);
    DVec3::new(lch.x, lch.y * math::cos(hue), lch.y * math::sin(hue))
}

/// The angle of (a, b) in degrees, [0, 360); 0 for the origin.
pub(in crate::color) fn hue_degrees(a: f64, b: f64) -> f64 {
    if a == 0.0 && b == 0.0 {
        return 0.0;
    }
    let degrees = math::atan2(b, a) * (180.0 / PI);
    let turned = if degrees < 0.0 { degrees + 360.0 } else { degrees };
    // A negative angle of less than half an ulp of 360 rounds up to a full turn.
    if turned >= 360.0 { 0.0 } else { turned }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::xyz_from_xy;
    use proptest::prelude::*;

    const D65: [f64; 2] = [0.3127, 0.3290];

    #[test]
    fn white_black_and_the_break() {
        let white = xyz_from_xy(D65);
        assert!((lab_from_xyz(white, white) - DVec3::new(100.0, 0.0, 0.0)).abs().max_element() < 1e-13);
        assert!(lab_from_xyz(DVec3::ZERO, white).abs().max_element() < 1e-14);
        // At (6/29)³ both branches give L* = 8.
        let at_break: f64 = 216.0 / 24_389.0;
        for y in [at_break, at_break.next_up(), at_break.next_down()] {
            assert!((lab_from_xyz(white * y, white).x - 8.0).abs() < 1e-13);
        }
    }

    #[test]
    fn hue_angles_wrap() {
        assert_eq!(lch_from_lab(DVec3::new(50.0, 0.0, -0.0)).z, 0.0);
        assert_eq!(lch_from_lab(DVec3::new(50.0, -0.0, 0.0)).z, 0.0);
        assert_eq!(lch_from_lab(DVec3::new(50.0, 1.0, -1e-30)).z, 0.0);
        assert_eq!(lch_from_lab(DVec3::new(50.0, 0.0, -2.0)).z, 270.0);
        assert!(lch_from_lab(DVec3::new(50.0, 1.0, -1e-9)).z < 360.0);
        let [low, high] = [-30.0, 330.0].map(|h| lab_from_lch(DVec3::new(50.0, 10.0, h)));
        assert!((low - high).abs().max_element() < 1e-13);
    }

    proptest! {
        #[test]
        fn lab_and_lch_round_trip(x in -0.5..2.0_f64, y in -0.5..2.0_f64, z in -0.5..2.0_f64) {
            let (xyz, white) = (DVec3::new(x, y, z), xyz_from_xy(D65));
            let lab = lab_from_xyz(xyz, white);
            prop_assert!((xyz_from_lab(lab, white) - xyz).abs().max_element() < 1e-13);
            let lch = lch_from_lab(lab);
            prop_assert!((0.0..360.0).contains(&lch.z));
            prop_assert!((lab_from_lch(lch) - lab).abs().max_element() < 1e-14 * (1.0 + lch.y));
        }

        #[test]
        fn lightness_is_monotone(y in -0.5..2.0_f64, step in 1e-12..1.0_f64) {
            let white = xyz_from_xy(D65);
            let [low, high] = [y, y + step].map(|y| lab_from_xyz(white * y, white).x);
            prop_assert!(low < high);
        }
    }
}
