//! Chromatic adaptation: how a colour seen under one white looks under another.
//!
//! * [`ConeTransform`]: von Kries' rule in the responses of twelve transforms; [`bradford`] is the usual one.
//! * [`cmccat2000`], [`zhai2018`], [`li2025`], [`fairchild1991`], [`fairchild2020`]: linear models that know luminances
//!   and how far an eye adapts. They return matrices, XYZ to XYZ; the inverse model is the inverse matrix.
//! * [`Cie1994`], which is not linear.
//!
//! XYZ has Y = 1 for white throughout. A white is XYZ with positive Y and responses, as every real white has; with another
//! one results may be infinite or NaN.

mod cie1994;
mod cone;
mod fairchild;
mod incomplete;

pub use cie1994::{Cie1994, Cie1994Field};
pub use cone::ConeTransform;
pub use fairchild::{FAIRCHILD2020_REFERENCE_WHITE, Fairchild1991Field, fairchild1991, fairchild2020};
pub use incomplete::{Surround, cmccat2000, li2025, zhai2018};

use glam::{DMat3, DVec3};

/// The linear Bradford transform, XYZ to XYZ, that takes one white to another; the identity for equal whites.
///
/// Whites are XYZ with positive Y and Bradford responses, as every real white has.
pub fn bradford(from_white: DVec3, to_white: DVec3) -> DMat3 {
    ConeTransform::Bradford.adaptation(from_white, to_white)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bradford_has_the_published_matrix() {
        // D65 to D50 as in the ICC profile of sRGB, to four digits.
        let there = bradford(DVec3::new(0.95047, 1.0, 1.08883), DVec3::new(0.96422, 1.0, 0.82521));
        let published = DMat3::from_cols_array(&[
            1.0478, 0.0296, -0.0092, //
            0.0229, 0.9905, 0.0151, //
            -0.0501, -0.0171, 0.7521,
        ]);
        assert!(there.abs_diff_eq(published, 1.5e-4), "{there}");
    }
}
