//! Pictures as a display shows them, for the metrics of what an observer sees.

use crate::Image;
use crate::color::{RgbSpace, srgb_encode};
use glam::DVec3;

/// A picture in XYZ, exposed for a display: both pictures of a pair by the same factor.
#[derive(Debug, Clone, PartialEq)]
pub struct Displayed {
    size: [u32; 2],
    xyz: Vec<DVec3>,
}

impl Displayed {
    /// Exposes a picture in linear XYZ by a factor. Pixels that are not finite are shown black.
    ///
    /// # Panics
    /// If there are other than three channels.
    pub fn new(xyz: &Image, exposure: f64) -> Self {
        let shown =
            |pixel: &[f64; 3]| Some(DVec3::from(*pixel) * exposure).filter(|v| v.is_finite()).unwrap_or(DVec3::ZERO);
        Self { size: xyz.size(), xyz: xyz.triples().iter().map(shown).collect() }
    }

    /// Returns the numbers of pixels in a row and of rows.
    pub(super) fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Iterates over the pixels in XYZ, with white at Y = 1. Colours brighter than white are brought to Y = 1 at their
    /// chromaticity; colours outside the gamut of any display stay where they are.
    pub fn xyz(&self) -> impl ExactSizeIterator<Item = DVec3> {
        self.xyz.iter().map(|xyz| if xyz.y > 1.0 { xyz / xyz.y } else { *xyz })
    }

    /// Iterates over the pixels in linear sRGB, clipped to [0, 1].
    pub fn linear_srgb(&self) -> impl ExactSizeIterator<Item = DVec3> {
        let rgb_from_xyz = RgbSpace::srgb().rgb_from_xyz;
        self.xyz.iter().map(move |xyz| (rgb_from_xyz * *xyz).clamp(DVec3::ZERO, DVec3::ONE))
    }

    /// Iterates over the pixels in encoded sRGB, in [0, 1].
    pub fn encoded_srgb(&self) -> impl ExactSizeIterator<Item = DVec3> {
        self.linear_srgb().map(|rgb| rgb.map(srgb_encode))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exposes_and_clips() {
        let white = RgbSpace::srgb().white_xyz();
        let pixels = vec![(white * 0.25).to_array(), [f64::NAN, 0.0, 0.0], [0.1, 0.5, 0.0]];
        let picture = Displayed::new(&Image::xyz(3, pixels).unwrap(), 4.0);
        let xyz: Vec<DVec3> = picture.xyz().collect();
        assert!(xyz[0].abs_diff_eq(white, 1e-15) && xyz[1] == DVec3::ZERO);
        assert!(xyz[2].abs_diff_eq(DVec3::new(0.2, 1.0, 0.0), 1e-15));
        let rgb: Vec<DVec3> = picture.linear_srgb().collect();
        assert!(rgb[0].abs_diff_eq(DVec3::ONE, 1e-12));
        assert_eq!((rgb[2].y, rgb[2].z), (1.0, 0.0));
        assert!(picture.encoded_srgb().next().unwrap().abs_diff_eq(DVec3::ONE, 1e-12));
    }
}
