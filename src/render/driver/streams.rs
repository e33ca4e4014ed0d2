//! The streams of random numbers of a render: no two draw from the same sequence.

use crate::sampling::{Sobol, mix};

/// What a sequence of random numbers is for. Sequences of one seed differ in 64 bits that tell it: pixels and replicates
/// count from below, everything else from above or from the middle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Stream {
    /// Camera paths of one replicate in the square of a pixel. Squares number fewer than 2⁵⁴.
    Camera {
        /// Number of the square.
        square: u64,
        /// Number of the replicate, less than 255.
        replicate: u8,
    },
    /// Camera paths of merging through a pixel.
    Eye {
        /// Index of the pixel.
        pixel: u32,
    },
    /// Light paths of one replicate.
    Light {
        /// Number of the replicate.
        replicate: u8,
    },
    /// Wavelengths of the passes of merging.
    MergingWavelengths,
    /// Light paths of merging.
    Photons,
}

/// What stands for merging where camera paths have their replicate.
const EYE_REPLICATE: u64 = 0xff;

impl Stream {
    /// The sequence of the stream in a render, whose mixed seed is given.
    pub fn sequence(self, seed: u64) -> Sobol {
        Sobol::new(seed ^ self.tag())
    }

    fn tag(self) -> u64 {
        match self {
            Self::Camera { square, replicate } => square << 8 | u64::from(replicate),
            Self::Eye { pixel } => u64::from(pixel) << 8 | EYE_REPLICATE,
            Self::Light { replicate } => u64::MAX - u64::from(replicate),
            Self::MergingWavelengths => u64::MAX >> 1,
            Self::Photons => u64::MAX >> 2,
        }
    }
}

/// The mixed seed of a render.
pub fn render_seed(seed: u64) -> u64 {
    mix(seed)
}

/// The mixed seed of a pilot, whose samples are independent of the render's.
pub fn pilot_seed(seed: u64) -> u64 {
    mix(seed ^ 0x7069_6c6f_7421)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{CAMERA_REPLICATES, LIGHT_REPLICATES};
    use std::collections::HashSet;

    /// No two streams share a tag, at either end of what they count.
    #[test]
    fn streams_are_disjoint() {
        let squares = (0..1000).chain((1 << 40) - 1000..1 << 40).chain((1 << 54) - 1000..1 << 54);
        let cameras = squares
            .flat_map(|square| (0..CAMERA_REPLICATES as u8).map(move |replicate| Stream::Camera { square, replicate }));
        let eyes = (0..1000).chain(u32::MAX - 1000..=u32::MAX).map(|pixel| Stream::Eye { pixel });
        let lights = (0..LIGHT_REPLICATES as u8).map(|replicate| Stream::Light { replicate });
        let others = [Stream::MergingWavelengths, Stream::Photons];
        let all: Vec<Stream> = cameras.chain(eyes).chain(lights).chain(others).collect();
        let tags: HashSet<u64> = all.iter().map(|stream| stream.tag()).collect();
        assert_eq!(tags.len(), all.len());
    }
}
