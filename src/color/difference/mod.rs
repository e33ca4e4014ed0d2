//! Colour differences ΔE: what two colours look apart. All are 0 for equal colours; 1 is about just noticeable where a
//! formula does not say otherwise.

mod cie1976;
mod cie1994;
mod cie2000;
mod cmc;
mod hybrid;
mod names;
mod ucs;

use crate::color::space::{Din99, Din99Factors};
use crate::math;
use glam::DVec3;

pub use cie1976::cie1976;
pub use cie1994::{cie1994, cie1994_textiles};
pub use cie2000::{Parametric, cie2000, cie2000_weighted};
pub use cmc::{cmc, cmc_weighted};
pub use hybrid::{hyab, hych};
pub use names::{LabDifference, by_name, names};
pub use ucs::{CamSpace, cam_ucs, din99, din99_distance, din99_textiles, itp};

/// Length of (a, b): chroma.
fn chroma(lab: DVec3) -> f64 {
    math::hypot(lab.y, lab.z)
}

/// Square of the metric hue difference ΔH² = Δa² + Δb² − ΔC², without the cancellation of that form.
fn hue_difference_squared(lab_1: DVec3, lab_2: DVec3) -> f64 {
    // ΔH² = 2 (C₁ C₂ − a₁ a₂ − b₁ b₂), and (C₁ C₂)² = dot² + cross².
    let dot = lab_1.y * lab_2.y + lab_1.z * lab_2.z;
    let product = chroma(lab_1) * chroma(lab_2);
    if dot < 0.0 {
        return 2.0 * (product - dot);
    }
    // From differences, which are exact for neighbours.
    let cross = lab_1.y * (lab_2.z - lab_1.z) - lab_1.z * (lab_2.y - lab_1.y);
    if product + dot == 0.0 { 0.0 } else { 2.0 * cross * cross / (product + dot) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    pub(super) fn lab() -> impl Strategy<Value = DVec3> {
        (0.0..100.0_f64, -128.0..128.0_f64, -128.0..128.0_f64).prop_map(|(l, a, b)| DVec3::new(l, a, b))
    }

    #[test]
    fn a_turn_of_a_picoradian_is_a_hue_difference() {
        // Δa² + Δb² − ΔC² loses all digits here.
        let (c, angle) = (100.0, 1e-12);
        let [one, two] = [DVec3::new(50.0, c, 0.0), DVec3::new(50.0, c * math::cos(angle), c * math::sin(angle))];
        let hue = hue_difference_squared(one, two).sqrt();
        assert!((hue / (c * angle) - 1.0).abs() < 1e-12, "{hue:e}");
    }

    proptest! {
        #[test]
        fn hue_difference_is_what_the_textbook_says(one in lab(), two in lab()) {
            let textbook = (one.y - two.y) * (one.y - two.y) + (one.z - two.z) * (one.z - two.z)
                - (chroma(one) - chroma(two)) * (chroma(one) - chroma(two));
            prop_assert!((hue_difference_squared(one, two) - textbook).abs() < 1e-10);
            prop_assert!(hue_difference_squared(one, one) == 0.0);
        }
    }
}
