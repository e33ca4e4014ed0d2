//! Fairchild's models: incomplete adaptation of 1991, and that of 2020 with a memory.

use super::ConeTransform;
use crate::math;
use glam::{DMat3, DVec3};

/// What an eye is adapted to, for [`fairchild1991`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fairchild1991Field {
    /// XYZ of the adapting white, of any scale.
    pub white: DVec3,
    /// Its luminance in cd/m².
    pub luminance: f64,
    /// Whether the eye knows the illuminant and adapts to it completely.
    pub discounts_illuminant: bool,
}

/// The matrix, XYZ to XYZ, of Fairchild's model of incomplete adaptation \[Fairchild1991\].
///
/// The less an adapting white is coloured and the brighter it is, the more complete is the adaptation of each cone; the
/// cones of one field also act on each other, less so in bright fields. Exchanging the fields inverts the matrix.
pub fn fairchild1991(from: Fairchild1991Field, to: Fairchild1991Field) -> DMat3 {
    let cone_from_xyz = ConeTransform::VonKries.cone_from_xyz();
    let adapted = |field: Fairchild1991Field| interaction(field.luminance) * DMat3::from_diagonal(gains(field));
    cone_from_xyz.inverse() * adapted(to).inverse() * adapted(from) * cone_from_xyz
}

/// Degree of adaptation of each cone over its response to white.
fn gains(field: Fairchild1991Field) -> DVec3 {
    let cone_from_xyz = ConeTransform::VonKries.cone_from_xyz();
    let white = cone_from_xyz * field.white;
    if field.discounts_illuminant {
        return white.recip();
    }
    let relative = white / (cone_from_xyz * DVec3::ONE);
    let excess = 3.0 * relative / relative.element_sum();
    let brightness = 1.0 + math::cbrt(field.luminance);
    let degree = (brightness + excess) / (brightness + excess.recip());
    degree / white
}

/// How much each cone's signal adds to the others'.
fn interaction(luminance: f64) -> DMat3 {
    let c = 0.219 - 0.0784 * math::log10(luminance);
    DMat3::from_cols(DVec3::new(1.0, c, c), DVec3::new(c, 1.0, c), DVec3::new(c, c, 1.0))
}

/// The matrix, XYZ to XYZ, of von Kries' transform with a memory \[Fairchild2020\]: it takes the white that an eye is
/// adapted to, which is a mixture of whites, to [1, 1, 1] in the responses of `transform`.
///
/// `whites` are XYZ of the previous, the present and the reference white, [`FAIRCHILD2020_REFERENCE_WHITE`] as a rule;
/// `weights` their parts, which should sum to 1: [0, 0.7, 0.3] is the author's choice.
pub fn fairchild2020(whites: [DVec3; 3], weights: [f64; 3], transform: ConeTransform) -> DMat3 {
    let cone_from_xyz = transform.cone_from_xyz();
    let mixture: DVec3 = whites.into_iter().zip(weights).map(|(white, weight)| cone_from_xyz * white * weight).sum();
    transform.scaling(mixture.recip())
}

/// The white near 15 000 K that an eye without any other is adapted to, XYZ \[Fairchild2020\].
pub const FAIRCHILD2020_REFERENCE_WHITE: DVec3 = DVec3::new(0.979_411_76, 1.0, 1.732_352_94);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::xyz_from_xy;

    fn field(xy: [f64; 2], luminance: f64, discounts_illuminant: bool) -> Fairchild1991Field {
        Fairchild1991Field { white: xyz_from_xy(xy), luminance, discounts_illuminant }
    }

    #[test]
    fn discounting_at_one_luminance_is_von_kries() {
        let (a, d65) = (field([0.44758, 0.40745], 200.0, true), field([0.3127, 0.3290], 200.0, true));
        let expected = ConeTransform::VonKries.adaptation(a.white, d65.white);
        assert!(fairchild1991(a, d65).abs_diff_eq(expected, 1e-14));
    }

    /// Equal energy is adapted to completely at any luminance, a lamp the more the brighter it is.
    #[test]
    fn bright_and_neutral_fields_are_adapted_to_more() {
        let degree = |f: Fairchild1991Field| gains(f) * (ConeTransform::VonKries.cone_from_xyz() * f.white);
        let e = degree(field([1.0 / 3.0, 1.0 / 3.0], 5.0, false));
        assert!((e - 1.0).abs().max_element() < 1e-14, "{e}");
        let [dim, bright] = [5.0, 5000.0].map(|luminance| degree(field([0.44758, 0.40745], luminance, false)));
        assert!((dim - 1.0).abs().cmpgt((bright - 1.0).abs()).all(), "{dim} {bright}");
    }

    #[test]
    fn exchanged_fields_invert() {
        let (a, d65) = (field([0.44758, 0.40745], 50.0, false), field([0.3127, 0.3290], 1000.0, false));
        let both = fairchild1991(d65, a) * fairchild1991(a, d65);
        assert!(both.abs_diff_eq(DMat3::IDENTITY, 1e-13), "{both}");
    }

    #[test]
    fn a_white_without_memory_becomes_equal_responses() {
        let white = xyz_from_xy([0.44758, 0.40745]);
        let whites = [DVec3::ONE, white, FAIRCHILD2020_REFERENCE_WHITE];
        let matrix = fairchild2020(whites, [0.0, 1.0, 0.0], ConeTransform::Cat16);
        let responses = ConeTransform::Cat16.cone_from_xyz() * matrix * white;
        assert!((responses - 1.0).abs().max_element() < 2e-15, "{responses}");
    }
}
