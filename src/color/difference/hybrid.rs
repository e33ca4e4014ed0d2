//! Hybrid distances, which add lightness instead of squaring it: better for large differences.

use super::cie2000::terms;
use crate::math;
use glam::DVec3;

/// HyAB of two CIE Lab colours \[Abasi2020\]: |ΔL\*| plus the distance of (a\*, b\*). Symmetric.
pub fn hyab(lab_1: DVec3, lab_2: DVec3) -> f64 {
    let difference = lab_1 - lab_2;
    difference.x.abs() + math::hypot(difference.y, difference.z)
}

/// HyCH of two CIE Lab colours \[Abasi2020\]: the weighted lightness difference of CIEDE2000 plus the length of its
/// weighted chroma and hue differences, without rotation. Symmetric up to rounding.
pub fn hych(lab_1: DVec3, lab_2: DVec3) -> f64 {
    let terms = terms(lab_1, lab_2);
    (terms.delta_l / terms.s_l).abs() + math::hypot(terms.delta_c / terms.s_c, terms.delta_h / terms.s_h)
}

#[cfg(test)]
mod tests {
    use super::super::tests::lab;
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn bounds_and_symmetry(one in lab(), two in lab()) {
            let distance = one.distance(two);
            let value = hyab(one, two);
            prop_assert!(distance <= value * (1.0 + 1e-14) && value <= distance * (2.0_f64.sqrt() + 1e-14));
            prop_assert_eq!(value, hyab(two, one));
            prop_assert_eq!(hyab(one, one) + hych(one, one), 0.0);
            prop_assert!((hych(one, two) - hych(two, one)).abs() < 1e-11);
        }
    }
}
