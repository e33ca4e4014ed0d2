//! Models in which an eye adapts by a degree between none and complete.

use super::ConeTransform;
use crate::math;
use glam::{DMat3, DVec3};

/// What surrounds the adapting field, for [`cmccat2000`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Surround {
    /// The surround is as bright as the field, as for surface colours.
    Average,
    /// Dim or dark: screens and projections.
    Dim,
}

/// The matrix, XYZ to XYZ, of CMCCAT2000 \[Li2002\]: corresponding colours under `to_white` of colours under `from_white`.
///
/// `luminances` are those of the adapting fields there and here, in cd/m², positive; a fifth of white's is usual. The
/// inverse model is the inverse matrix.
pub fn cmccat2000(from_white: DVec3, to_white: DVec3, luminances: [f64; 2], surround: Surround) -> DMat3 {
    let [from, to] = luminances;
    let factor = match surround {
        Surround::Average => 1.0,
        Surround::Dim => 0.8,
    };
    let degree = factor * (0.08 * math::log10(0.5 * (from + to)) + 0.76 - 0.45 * (from - to) / (from + to));
    one_step(ConeTransform::Cmccat2000, from_white, to_white, degree.clamp(0.0, 1.0))
}

/// The matrix, XYZ to XYZ, of the one-step CAT16 of \[Li2025\].
///
/// `adapting_luminance` is in cd/m²; `surround` is CIECAM's F: 1 for average, 0.9 for dim, 0.8 for dark surrounds. An eye
/// that discounts the illuminant adapts completely: `surround` infinite says so.
pub fn li2025(from_white: DVec3, to_white: DVec3, adapting_luminance: f64, surround: f64) -> DMat3 {
    let degree = surround * (1.0 - math::exp((-adapting_luminance - 42.0) / 92.0) / 3.6);
    one_step(ConeTransform::Cat16, from_white, to_white, degree.clamp(0.0, 1.0))
}

/// The matrix, XYZ to XYZ, of the two-step transform of \[Zhai2018\] by way of a baseline white.
///
/// `degrees` in [0, 1] tell how far an eye adapts from each white to the baseline, which is equal energy as a rule. The
/// authors use CAT02 or CAT16. Exchanging the whites and the degrees inverts the matrix.
pub fn zhai2018(
    from_white: DVec3,
    to_white: DVec3,
    degrees: [f64; 2],
    baseline_white: DVec3,
    transform: ConeTransform,
) -> DMat3 {
    let to_baseline = |white, degree| step_gains(transform, white, baseline_white, degree);
    transform.scaling(to_baseline(from_white, degrees[0]) / to_baseline(to_white, degrees[1]))
}

fn one_step(transform: ConeTransform, from_white: DVec3, to_white: DVec3, degree: f64) -> DMat3 {
    transform.scaling(step_gains(transform, from_white, to_white, degree))
}

/// Gains of the responses at a degree of adaptation, the whites taken at equal luminance.
fn step_gains(transform: ConeTransform, from_white: DVec3, to_white: DVec3, degree: f64) -> DVec3 {
    let cone_from_xyz = transform.cone_from_xyz();
    let complete = (cone_from_xyz * to_white) / (cone_from_xyz * from_white) * (from_white.y / to_white.y);
    complete * degree + (1.0 - degree)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::xyz_from_xy;

    const A: [f64; 2] = [0.44758, 0.40745];
    const D65: [f64; 2] = [0.3127, 0.3290];

    #[test]
    fn complete_adaptation_takes_white_to_white() {
        let [a, d65] = [A, D65].map(xyz_from_xy);
        // CMCCAT2000 is complete for a bright field seen after a dark one, Li et al. when the illuminant is discounted.
        for matrix in [
            cmccat2000(a, d65, [200.0, 2000.0], Surround::Average),
            li2025(a, d65, 100.0, f64::INFINITY),
            zhai2018(a, d65, [1.0, 1.0], DVec3::ONE, ConeTransform::Cat16),
        ] {
            assert!((matrix * a - d65).abs().max_element() < 2e-15, "{}", matrix * a);
        }
    }

    #[test]
    fn no_adaptation_changes_nothing() {
        let [a, d65] = [A, D65].map(xyz_from_xy);
        for matrix in [li2025(a, d65, 100.0, 0.0), zhai2018(a, d65, [0.0, 0.0], DVec3::ONE, ConeTransform::Cat02)] {
            assert!(matrix.abs_diff_eq(DMat3::IDENTITY, 1e-14), "{matrix}");
        }
    }

    #[test]
    fn partial_adaptation_lies_between_and_dim_surrounds_adapt_less() {
        let [a, d65] = [A, D65].map(xyz_from_xy);
        let z = |surround| (cmccat2000(a, d65, [200.0, 200.0], surround) * a).z;
        assert!(a.z < z(Surround::Dim) && z(Surround::Dim) < z(Surround::Average) && z(Surround::Average) < d65.z);
    }

    #[test]
    fn exchanged_whites_invert_zhai2018() {
        let [a, d65] = [A, D65].map(xyz_from_xy);
        let there = zhai2018(a, d65, [0.7, 0.9], DVec3::ONE, ConeTransform::Cat16);
        let back = zhai2018(d65, a, [0.9, 0.7], DVec3::ONE, ConeTransform::Cat16);
        assert!((back * there).abs_diff_eq(DMat3::IDENTITY, 1e-14));
    }
}
