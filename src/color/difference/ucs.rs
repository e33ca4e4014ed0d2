//! Distances in uniform spaces other than Lab: ICtCp, DIN99, the J′a′b′ of CAM02 and CAM16.

use crate::color::space::{Din99, Din99Factors, din99_from_lab};
use glam::DVec3;

/// ΔE ITP of two ICtCp colours \[BT2124\]: 720 times the distance with Ct halved; 1 is about just noticeable. Symmetric.
pub fn itp(ictcp_1: DVec3, ictcp_2: DVec3) -> f64 {
    720.0 * ((ictcp_1 - ictcp_2) * DVec3::new(1.0, 0.5, 1.0)).length()
}

/// ΔE99 of two CIE Lab colours: the distance in DIN99 \[DIN6176\]. Symmetric.
pub fn din99(lab_1: DVec3, lab_2: DVec3) -> f64 {
    din99_distance(lab_1, lab_2, Din99::Standard, Din99Factors::REFERENCE)
}

/// ΔE99 for textiles, which halves lightness \[DIN6176\]. Symmetric.
pub fn din99_textiles(lab_1: DVec3, lab_2: DVec3) -> f64 {
    din99_distance(lab_1, lab_2, Din99::Standard, Din99Factors::TEXTILES)
}

/// The distance of two CIE Lab colours in one of the DIN99 spaces.
pub fn din99_distance(lab_1: DVec3, lab_2: DVec3, formula: Din99, factors: Din99Factors) -> f64 {
    din99_from_lab(lab_1, formula, factors).distance(din99_from_lab(lab_2, formula, factors))
}

/// What kind of differences a space of CAM02 or CAM16 was fitted to: decides the weight of lightness.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CamSpace {
    /// LCD: K_L = 0.77.
    LargeDifferences,
    /// SCD: K_L = 1.24.
    SmallDifferences,
    /// UCS: K_L = 1.
    Uniform,
}

/// ΔE′ of two J′, a′, b′ of CAM02 or CAM16 \[Luo2006\]; the coordinates must be of the same kind of space. Symmetric.
pub fn cam_ucs(jab_1: DVec3, jab_2: DVec3, space: CamSpace) -> f64 {
    let k_l = match space {
        CamSpace::LargeDifferences => 0.77,
        CamSpace::SmallDifferences => 1.24,
        CamSpace::Uniform => 1.0,
    };
    let difference = jab_1 - jab_2;
    DVec3::new(difference.x / k_l, difference.y, difference.z).length()
}

#[cfg(test)]
mod tests {
    use super::super::tests::lab;
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn closed_forms() {
        assert_eq!(itp(DVec3::ZERO, DVec3::new(0.5, 0.0, 0.0)), 360.0);
        assert_eq!(itp(DVec3::ZERO, DVec3::new(0.0, 0.5, 0.0)), 180.0);
        assert_eq!(cam_ucs(DVec3::ZERO, DVec3::new(0.77, 0.0, 0.0), CamSpace::LargeDifferences), 1.0);
        assert_eq!(cam_ucs(DVec3::ZERO, DVec3::new(3.0, 0.0, 4.0), CamSpace::Uniform), 5.0);
    }

    proptest! {
        #[test]
        fn symmetric_and_zero_for_equals(one in lab(), two in lab()) {
            for difference in [din99, din99_textiles] {
                prop_assert_eq!(difference(one, two), difference(two, one));
                prop_assert_eq!(difference(one, one), 0.0);
            }
            prop_assert!(din99_textiles(one, two) <= din99(one, two));
            prop_assert!(cam_ucs(one, two, CamSpace::SmallDifferences) <= cam_ucs(one, two, CamSpace::LargeDifferences));
        }
    }
}
