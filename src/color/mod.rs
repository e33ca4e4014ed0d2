//! The colour library: observers, illuminants, XYZ by an exact rule, RGB spaces, spectra from RGB.
//!
//! It knows spectra and nothing of rendering. All of it is f64. Conventions:
//!
//! * XYZ of an emission L is ∫ L x̄ dλ / ∫ ȳ dλ (and so on) over 360–830 nm: L = 1 has Y = 1.
//! * XYZ of a reflectance R under an illuminant S is ∫ R S x̄ dλ / ∫ S ȳ dλ: the perfect diffuser has Y = 1.
//! * Matrices are named so that they cancel when read: `xyz_from_rgb * rgb`. RGB is linear unless a name says encoded.
//!
//! Tables come from data/, where each file names its source, edition and licence.

pub mod adaptation;
pub mod appearance;
pub mod astm_e308;
pub mod chroma;
pub mod daylight;
pub mod difference;
pub mod illuminant;
pub mod integration;
pub mod led;
pub mod lightness;
pub mod luminous;
pub mod measured;
mod observer;
pub mod quality;
mod rgb;
mod root;
pub mod space;
pub mod sums;
mod table;
pub mod temperature;
pub mod thermal;
pub mod transfer;
pub mod upsample;
mod xyz;

pub use observer::Observer;
pub use rgb::{EncodedRgb, LinearRgb, RgbSpace};
pub use transfer::{Transfer, srgb_decode, srgb_encode};
pub use xyz::{chromaticity, normalized_to_unit_luminance, xyz_from_xy, xyz_of_emission, xyz_of_reflectance};
