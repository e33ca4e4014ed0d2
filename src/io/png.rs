//! Writes PNG files.

use crate::develop::Picture;
use crate::{Error, ErrorKind, Result};
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};

/// Encodes a picture as a PNG.
pub fn encode(picture: &Picture) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let height = picture.rgb8.len() as u32 / picture.width;
    PngEncoder::new(&mut bytes)
        .write_image(picture.rgb8.as_flattened(), picture.width, height, ExtendedColorType::Rgb8)
        .map_err(|e| Error::new(ErrorKind::Io, format!("cannot encode the PNG: {e}")))?;
    Ok(bytes)
}
