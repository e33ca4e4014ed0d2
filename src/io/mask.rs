//! Masks: pictures whose bright pixels say which pixels count.

use super::exr::{self, Preference};
use crate::{Error, ErrorKind, Image, Result};
use std::io::Cursor;
use std::path::Path;

/// Largest amount of memory that decoding a PNG may take, in bytes.
const MAX_BYTES: u64 = 4 << 30;

/// Reads a mask as a picture of one channel: the values of a PNG as they are stored, in [0, 1], or the luminance of an EXR.
///
/// # Errors
/// `FileNotFound`, `FileFormat`, and those of [`exr::decode`], with the file.
pub fn read_file(path: &Path) -> Result<Image> {
    let bytes = std::fs::read(path).map_err(|e| {
        let message = format!("cannot be read: {e}; expected a mask, .png or .exr");
        Error::new(ErrorKind::FileNotFound, message).in_file(path)
    })?;
    decode(&bytes).map_err(|error| error.in_file(path))
}

fn decode(bytes: &[u8]) -> Result<Image> {
    if bytes.starts_with(&::exr::meta::magic_number::BYTES) {
        let xyz = exr::decode(bytes, Preference::Xyz, None)?.xyz;
        return Ok(Image::new(xyz.size(), &["Y"], xyz.plane(1).collect()));
    }
    let failed = |e: image::ImageError| {
        Error::new(ErrorKind::FileFormat, format!("not a picture: {e}; expected a mask, PNG or EXR"))
    };
    let mut reader = image::ImageReader::with_format(Cursor::new(bytes), image::ImageFormat::Png);
    let mut limits = image::Limits::default();
    limits.max_alloc = Some(MAX_BYTES);
    reader.limits(limits);
    let grey = reader.decode().map_err(failed)?.into_luma16();
    let values = grey.pixels().map(|pixel| f64::from(pixel.0[0]) / f64::from(u16::MAX));
    Ok(Image::new([grey.width(), grey.height()], &["Y"], values.collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{ExtendedColorType, ImageEncoder};

    #[test]
    fn png_and_exr() {
        let mut png = Vec::new();
        let encoder = image::codecs::png::PngEncoder::new(&mut png);
        encoder.write_image(&[0, 127, 128, 255], 4, 1, ExtendedColorType::L8).unwrap();
        let bright = |bytes: &[u8]| decode(bytes).map(|mask| (mask.size(), mask.plane(0).map(|v| v > 0.5).collect()));
        assert_eq!(bright(&png).unwrap(), ([4, 1], vec![false, false, true, true]));

        let grey = Image::new([2, 1], &["R", "G", "B"], vec![0.4, 0.4, 0.4, 0.6, 0.6, 0.6]);
        let exr = exr::encode_image(&grey).unwrap();
        assert_eq!(bright(&exr).unwrap(), ([2, 1], vec![false, true]));

        assert!(decode(b"P3 1 1").unwrap_err().to_string().contains("expected a mask, PNG or EXR"));
        let missing = read_file("/no/such.png".as_ref()).unwrap_err();
        assert_eq!(missing.kind, ErrorKind::FileNotFound);
    }
}
