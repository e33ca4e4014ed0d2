//! CIE 1994: distances in lightness, chroma and hue, scaled by the chroma of a reference.

use super::{chroma, hue_difference_squared};
use glam::DVec3;

/// ΔE\*94 for graphic arts (k_L = 1, K₁ = 0.045, K₂ = 0.015) \[CIE116\].
///
/// `lab_1` is the reference: its chroma alone scales, so the formula is not symmetric.
pub fn cie1994(lab_1: DVec3, lab_2: DVec3) -> f64 {
    weighted(lab_1, lab_2, 1.0, [0.045, 0.015])
}

/// ΔE\*94 for textiles (k_L = 2, K₁ = 0.048, K₂ = 0.014) \[CIE116\]; `lab_1` is the reference.
pub fn cie1994_textiles(lab_1: DVec3, lab_2: DVec3) -> f64 {
    weighted(lab_1, lab_2, 2.0, [0.048, 0.014])
}

fn weighted(lab_1: DVec3, lab_2: DVec3, k_l: f64, [k_1, k_2]: [f64; 2]) -> f64 {
    let (c_1, c_2) = (chroma(lab_1), chroma(lab_2));
    let lightness = (lab_1.x - lab_2.x) / k_l;
    let chroma = (c_1 - c_2) / (1.0 + k_1 * c_1);
    let s_h = 1.0 + k_2 * c_1;
    (lightness * lightness + chroma * chroma + hue_difference_squared(lab_1, lab_2) / (s_h * s_h)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::tests::lab;
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn closed_forms() {
        let (grey, red) = (DVec3::new(50.0, 0.0, 0.0), DVec3::new(50.0, 20.0, 0.0));
        // From a grey the chroma is not scaled; from the red it is, by 1.9.
        assert_eq!(cie1994(grey, red), 20.0);
        assert!((cie1994(red, grey) - 20.0 / 1.9).abs() < 1e-14);
        assert_eq!(cie1994_textiles(grey, DVec3::new(60.0, 0.0, 0.0)), 5.0);
    }

    proptest! {
        #[test]
        fn is_below_cie1976_and_zero_for_equals(one in lab(), two in lab()) {
            prop_assert!(cie1994(one, two) <= one.distance(two) * (1.0 + 1e-12));
            prop_assert_eq!(cie1994(one, one), 0.0);
            prop_assert_eq!(cie1994_textiles(two, two), 0.0);
        }
    }
}
