//! CMC l:c, the formula of textile standards.

use super::{chroma, hue_difference_squared};
use crate::color::space::hue_degrees;
use crate::math;
use glam::DVec3;
use std::f64::consts::PI;

/// ΔE CMC 2:1, for acceptability \[Clarke1984\]. `lab_1` is the reference: the formula is not symmetric.
pub fn cmc(lab_1: DVec3, lab_2: DVec3) -> f64 {
    cmc_weighted(lab_1, lab_2, 2.0, 1.0)
}

/// ΔE CMC l:c \[Clarke1984\]; 1:1 is for perceptibility. `lab_1` is the reference.
///
/// The hue weight jumps where the reference's hue is 164° or 345°, and the lightness weight where its L\* is 16.
pub fn cmc_weighted(lab_1: DVec3, lab_2: DVec3, l: f64, c: f64) -> f64 {
    let (c_1, c_2) = (chroma(lab_1), chroma(lab_2));
    let s_l = if lab_1.x < 16.0 { 0.511 } else { 0.040_975 * lab_1.x / (1.0 + 0.017_65 * lab_1.x) };
    let s_c = 0.0638 * c_1 / (1.0 + 0.0131 * c_1) + 0.638;
    let c_4 = (c_1 * c_1) * (c_1 * c_1);
    let f = (c_4 / (c_4 + 1900.0)).sqrt();
    let s_h = s_c * (f * hue_weight(hue_degrees(lab_1.y, lab_1.z)) + 1.0 - f);
    let lightness = (lab_1.x - lab_2.x) / (l * s_l);
    let chroma = (c_1 - c_2) / (c * s_c);
    (lightness * lightness + chroma * chroma + hue_difference_squared(lab_1, lab_2) / (s_h * s_h)).sqrt()
}

/// T of the standard, of a hue in degrees.
fn hue_weight(hue: f64) -> f64 {
    let cosine = |degrees: f64| math::cos(degrees * (PI / 180.0));
    if (164.0..=345.0).contains(&hue) {
        0.56 + (0.2 * cosine(hue + 168.0)).abs()
    } else {
        0.36 + (0.4 * cosine(hue + 35.0)).abs()
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::lab;
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn greys_differ_in_lightness_alone() {
        let [dark, darker] = [10.0, 8.0].map(|l| DVec3::new(l, 0.0, 0.0));
        assert!((cmc(dark, darker) - 2.0 / (2.0 * 0.511)).abs() < 1e-14);
        assert!((cmc_weighted(dark, darker, 1.0, 1.0) - 2.0 / 0.511).abs() < 1e-14);
    }

    proptest! {
        #[test]
        fn zero_for_equals_and_positive_otherwise(one in lab(), two in lab()) {
            prop_assert_eq!(cmc(one, one), 0.0);
            prop_assert!(cmc(one, two) > 0.0);
            prop_assert!(cmc(one, two) <= cmc_weighted(one, two, 1.0, 1.0));
        }
    }
}
