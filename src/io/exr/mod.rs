//! OpenEXR files: what a render writes, and pictures of any renderer.

mod channels;
mod read;
mod spectral;
#[cfg(test)]
mod tests;
mod write;

pub use channels::Preference;
pub use read::{ReadPicture, Source, decode, read_file};
pub use write::{Attributes, encode, encode_image};
