//! What a chromaticity says about its light: wavelength, purity, and how bright a surface of that colour can be.

mod dominant;

pub use dominant::{Dominant, complementary_wavelength, dominant_wavelength, is_within_locus};
