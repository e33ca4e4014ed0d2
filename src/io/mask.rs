//! Masks: pictures whose bright pixels say which pixels count.

use super::exr::{self, Preference};
use crate::{Error, ErrorKind, Result};
use std::io::Cursor;
use std::path::Path;

/// Most memory that decoding a PNG may take, bytes.
const MAX_BYTES: u64 = 4 << 30;

/// Which pixels of a PNG (as they are stored, in [0, 1]) or EXR (luminance) exceed 0.5, row by row, with the width.
///
/// # Errors
/// `FileNotFound`, `FileFormat`, and those of [`exr::decode`], with the file.
pub fn read_file(path: &Path) -> Result<(u32, Vec<bool>)> {
    let bytes = std::fs::read(path).map_err(|e| {
        let message = format!("cannot be read: {e}; expected a mask, .png or .exr");
        Error::new(ErrorKind::FileNotFound, message).in_file(path)
    })?;
    decode(&bytes).map_err(|error| error.in_file(path))
}

fn decode(bytes: &[u8]) -> Result<(u32, Vec<bool>)> {
    if bytes.starts_with(&::exr::meta::magic_number::BYTES) {
        let picture = exr::decode(bytes, Preference::Xyz, None)?;
        return Ok((picture.width, picture.xyz.iter().map(|pixel| pixel[1] > 0.5).collect()));
    }
    let failed = |e: image::ImageError| {
        Error::new(ErrorKind::FileFormat, format!("not a picture: {e}; expected a mask, PNG or EXR"))
    };
    let mut reader = image::ImageReader::with_format(Cursor::new(bytes), image::ImageFormat::Png);
    let mut limits = image::Limits::default();
    limits.max_alloc = Some(MAX_BYTES);
    reader.limits(limits);
    let grey = reader.decode().map_err(failed)?.into_luma16();
    Ok((grey.width(), grey.pixels().map(|pixel| pixel.0[0] > u16::MAX / 2).collect()))
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
        assert_eq!(decode(&png).unwrap(), (4, vec![false, false, true, true]));

        let planes = ["R", "G", "B"].map(|name| (name, vec![0.4, 0.6]));
        let exr = crate::io::exr::encode_planes(planes.into(), 2).unwrap();
        assert_eq!(decode(&exr).unwrap(), (2, vec![false, true]));

        assert!(decode(b"P3 1 1").unwrap_err().to_string().contains("expected a mask, PNG or EXR"));
        let missing = read_file("/no/such.png".as_ref()).unwrap_err();
        assert_eq!(missing.kind, ErrorKind::FileNotFound);
    }
}
