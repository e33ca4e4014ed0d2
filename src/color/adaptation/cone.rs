//! Von Kries' rule in the cone-like responses of twelve transforms.

use crate::{Error, Result};
use glam::{DMat3, DVec3};

/// Responses in which adaptation is a scaling of each by the ratio of the whites.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ConeTransform {
    /// Bianco and Schettini 2010 \[Bianco2010\].
    Bianco2010,
    /// The transform of Bianco and Schettini with only positive responses \[Bianco2010\].
    BiancoPc2010,
    /// Bradford \[Lam1985\].
    Bradford,
    /// CAT02, the transform of CIECAM02 \[Moroney2002\].
    Cat02,
    /// CAT02 with a blue response that cannot be negative \[Brill2008\].
    Cat02Brill2008,
    /// CAT16, the transform of CIECAM16 \[Li2017\].
    Cat16,
    /// The transform of CMCCAT97 \[Luo1998\]: Bradford's responses, here without CMCCAT97's exponent of blue.
    Cmccat97,
    /// The transform of CMCCAT2000 \[Li2002\].
    Cmccat2000,
    /// Fairchild's \[Fairchild2013\].
    Fairchild,
    /// Sharp \[Susstrunk2000\].
    Sharp,
    /// Cones after Hunt, Pointer and Estévez, normalised to D65 \[Fairchild2013\].
    VonKries,
    /// XYZ themselves.
    XyzScaling,
}

const NAMED: [(&str, ConeTransform); 12] = [
    ("bianco-2010", ConeTransform::Bianco2010),
    ("bianco-pc-2010", ConeTransform::BiancoPc2010),
    ("bradford", ConeTransform::Bradford),
    ("cat02", ConeTransform::Cat02),
    ("cat02-brill-2008", ConeTransform::Cat02Brill2008),
    ("cat16", ConeTransform::Cat16),
    ("cmccat97", ConeTransform::Cmccat97),
    ("cmccat2000", ConeTransform::Cmccat2000),
    ("fairchild", ConeTransform::Fairchild),
    ("sharp", ConeTransform::Sharp),
    ("von-kries", ConeTransform::VonKries),
    ("xyz-scaling", ConeTransform::XyzScaling),
];

impl ConeTransform {
    /// Iterates over all transforms that have a name.
    pub fn all() -> impl Iterator<Item = ConeTransform> {
        NAMED.into_iter().map(|(_, transform)| transform)
    }

    /// Names that [`ConeTransform::by_name`] knows.
    pub fn names() -> impl Iterator<Item = &'static str> {
        NAMED.into_iter().map(|(name, _)| name)
    }

    /// A transform by its name: `bradford`, `cat16`, …
    ///
    /// # Errors
    /// [`UnknownName`](crate::ErrorKind::UnknownName) with the nearest name.
    pub fn by_name(name: &str) -> Result<Self> {
        NAMED
            .into_iter()
            .find(|(known, _)| *known == name)
            .map(|(_, transform)| transform)
            .ok_or_else(|| Error::unknown_name("chromatic adaptation transform", name, Self::names()))
    }

    /// XYZ to cone-like responses.
    pub fn cone_from_xyz(self) -> DMat3 {
        let rows = match self {
            Self::Bianco2010 => [[0.8752, 0.2787, -0.1539], [-0.8904, 1.8709, 0.0195], [-0.0061, 0.0162, 0.9899]],
            Self::BiancoPc2010 => [[0.6489, 0.3915, -0.0404], [-0.3775, 1.3055, 0.0720], [-0.0271, 0.0888, 0.9383]],
            Self::Bradford | Self::Cmccat97 => {
                [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]]
            }
            Self::Cat02 => [[0.7328, 0.4296, -0.1624], [-0.7036, 1.6975, 0.0061], [0.0030, 0.0136, 0.9834]],
            Self::Cat02Brill2008 => [[0.7328, 0.4296, -0.1624], [-0.7036, 1.6975, 0.0061], [0.0, 0.0, 1.0]],
            Self::Cat16 => {
                [[0.401288, 0.650173, -0.051461], [-0.250268, 1.204414, 0.045854], [-0.002079, 0.048952, 0.953127]]
            }
            Self::Cmccat2000 => [[0.7982, 0.3389, -0.1371], [-0.5918, 1.5512, 0.0406], [0.0008, 0.0239, 0.9753]],
            Self::Fairchild => [[0.8562, 0.3372, -0.1934], [-0.8360, 1.8327, 0.0033], [0.0357, -0.0469, 1.0112]],
            Self::Sharp => [[1.2694, -0.0988, -0.1706], [-0.8364, 1.8006, 0.0357], [0.0297, -0.0315, 1.0018]],
            Self::VonKries => [[0.40024, 0.70760, -0.08081], [-0.22630, 1.16532, 0.04570], [0.0, 0.0, 0.91822]],
            Self::XyzScaling => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        };
        DMat3::from_cols_array_2d(&rows).transpose()
    }

    /// The matrix, XYZ to XYZ, that takes one white to another; the identity for equal whites.
    ///
    /// Whites are XYZ with positive responses, as every real white has.
    pub fn adaptation(self, from_white: DVec3, to_white: DVec3) -> DMat3 {
        if from_white == to_white {
            return DMat3::IDENTITY;
        }
        let cone_from_xyz = self.cone_from_xyz();
        let gains = (cone_from_xyz * to_white) / (cone_from_xyz * from_white);
        self.scaling(gains)
    }

    /// The matrix, XYZ to XYZ, that multiplies each response.
    pub(super) fn scaling(self, gains: DVec3) -> DMat3 {
        let cone_from_xyz = self.cone_from_xyz();
        cone_from_xyz.inverse() * DMat3::from_diagonal(gains) * cone_from_xyz
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ErrorKind;
    use crate::color::xyz_from_xy;

    #[test]
    fn white_goes_to_white_and_back() {
        let whites = [[0.3127, 0.3290], [0.3457, 0.3585], [0.44758, 0.40745], [1.0 / 3.0, 1.0 / 3.0]].map(xyz_from_xy);
        for transform in ConeTransform::all() {
            for from in whites {
                for to in whites {
                    let there = transform.adaptation(from, to);
                    assert!((there * from - to).abs().max_element() < 2e-15, "{transform:?}");
                    let both = transform.adaptation(to, from) * there;
                    assert!(both.abs_diff_eq(DMat3::IDENTITY, 1e-14), "{transform:?} {both}");
                }
                assert_eq!(transform.adaptation(from, from), DMat3::IDENTITY);
            }
        }
    }

    /// Each row's responses to equal energy or D65 are 1 as far as the digits of the matrices go.
    #[test]
    fn matrices_are_normalised_as_published() {
        let d65 = xyz_from_xy([0.3127, 0.3290]);
        for transform in ConeTransform::all() {
            let m = transform.cone_from_xyz();
            let to_e = (m * DVec3::ONE - 1.0).abs().max_element();
            let to_d65 = (m * d65 - 1.0).abs().max_element();
            assert!(to_e.min(to_d65) < 3e-4, "{transform:?}: {to_e} {to_d65}");
        }
    }

    #[test]
    fn names_find_what_they_name() {
        for (name, transform) in ConeTransform::names().zip(ConeTransform::all()) {
            assert_eq!(ConeTransform::by_name(name).unwrap(), transform);
        }
        let error = ConeTransform::by_name("cat2").unwrap_err();
        assert_eq!((error.kind, error.nearest.is_some()), (ErrorKind::UnknownName, true));
    }
}
