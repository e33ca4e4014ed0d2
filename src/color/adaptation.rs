//! Chromatic adaptation: how a colour seen under one white looks under another.

use glam::{DMat3, DVec3};

/// Cone-like responses of the Bradford transform \[Lam1985\].
const BRADFORD: DMat3 = DMat3::from_cols(
    DVec3::new(0.8951, -0.7502, 0.0389),
    DVec3::new(0.2664, 1.7135, -0.0685),
    DVec3::new(-0.1614, 0.0367, 1.0296),
);

/// The linear Bradford transform, XYZ to XYZ, that takes one white to another; the identity for equal whites.
///
/// Whites are XYZ with positive Y and Bradford responses, as every real white has.
pub fn bradford(from_white: DVec3, to_white: DVec3) -> DMat3 {
    if from_white == to_white {
        return DMat3::IDENTITY;
    }
    let gains = (BRADFORD * to_white) / (BRADFORD * from_white);
    BRADFORD.inverse() * DMat3::from_diagonal(gains) * BRADFORD
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::xyz_from_xy;

    #[test]
    fn takes_white_to_white_and_back() {
        let (d65, d50) = (xyz_from_xy([0.3127, 0.3290]), xyz_from_xy([0.3457, 0.3585]));
        let there = bradford(d65, d50);
        assert!((there * d65 - d50).abs().max_element() < 1e-15);
        let both = bradford(d50, d65) * there;
        assert!(both.abs_diff_eq(DMat3::IDENTITY, 1e-14), "{both}");
        assert_eq!(bradford(d65, d65), DMat3::IDENTITY);
    }

    #[test]
    fn has_the_published_matrix() {
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
