//! Reads OpenEXR pictures of any renderer as XYZ.
//!
//! Half, float and integer channels X, Y, Z; R, G, B with the file's chromaticities (Rec. 709 without them); or the spectral
//! layout of \[Fichet2021\]. Scan lines or tiles, any compression, one part or several; no deep data. The picture is what
//! the display window shows: black where the data window does not reach, cropped where it reaches further.

use super::channels::{self, Candidate, Colors, Preference};
use super::spectral;
use crate::color::{RgbSpace, xyz_from_xy};
use crate::{Error, ErrorKind, Image, Result};
use exr::block::UncompressedBlock;
use exr::block::reader::ChunksReader;
use exr::meta::MetaData;
use exr::meta::attribute::{ChannelList, Chromaticities, SampleType};
use exr::meta::header::Header;
use exr::prelude::{Vec2, f16};
use glam::{DMat3, DVec3};
use std::io::Cursor;
use std::path::Path;

/// Where a picture's values came from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// X, Y, Z.
    Xyz,
    /// R, G, B.
    Rgb {
        /// Whether the file says what its primaries are.
        chromaticities: bool,
    },
    /// Spectral channels.
    Spectral {
        /// Number of channels.
        bands: usize,
    },
}

/// A picture in XYZ.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadPicture {
    /// The channels X, Y, Z.
    pub xyz: Image,
    /// Channels of the file from which X, Y and Z were computed.
    pub source: Source,
}

/// Largest number of samples in all channels of a file that is read.
const MAX_SAMPLES: u128 = 1 << 31;

/// Reads a file as [`decode`] does.
///
/// # Errors
/// `FileNotFound`, and those of [`decode`], with the file.
pub fn read_file(path: &Path, preference: Preference, layer: Option<&str>) -> Result<ReadPicture> {
    let bytes = std::fs::read(path).map_err(|e| {
        let message = format!("cannot be read: {e}; expected an OpenEXR file");
        Error::new(ErrorKind::FileNotFound, message).in_file(path)
    })?;
    decode(&bytes, preference, layer).map_err(|error| error.in_file(path))
}

/// Decodes the bytes of an EXR file. `layer` names a part, or the channels `layer.R`, `layer.G`, `layer.B`; without it the
/// channels must be found in one way only.
///
/// # Errors
/// `FileFormat` for what is no EXR or damaged, `Unsupported` for deep data and subsampled channels, `LimitExceeded` for more
/// than 2³¹ samples, `Missing` where the channels are not there (the message lists those that are), `Usage` where there are
/// several pictures to choose from.
pub fn decode(bytes: &[u8], preference: Preference, layer: Option<&str>) -> Result<ReadPicture> {
    if !bytes.starts_with(&exr::meta::magic_number::BYTES) {
        return Err(Error::new(ErrorKind::FileFormat, "not an EXR file; expected OpenEXR"));
    }
    let reader = exr::block::read(Cursor::new(bytes), false).map_err(|e| not_exr(&e))?;
    check_size(reader.meta_data())?;
    let candidate = channels::choose(reader.headers(), preference, layer)?;
    let header = reader.headers()[candidate.part].clone();
    if let Some(coarse) = header.channels.list.iter().find(|c| c.sampling != Vec2(1, 1)) {
        let message = format!("the channel {} is subsampled; expected a value for every pixel", coarse.name);
        return Err(Error::new(ErrorKind::Unsupported, message));
    }
    let (xyz_from_channels, source) = to_xyz(&candidate, header.shared_attributes.chromaticities)?;
    let mut factors = vec![DVec3::ZERO; header.channels.list.len()];
    candidate.indices().zip(xyz_from_channels).for_each(|(index, column)| factors[index] = column);
    let mut window = Window::new(&header)?;
    let chunks =
        reader.filter_chunks(false, |_, tile, block| block.layer == candidate.part && tile.level_index == Vec2(0, 0));
    for block in chunks.map_err(|e| not_exr(&e))?.sequential_decompressor(false) {
        window.add_block(&block.map_err(|e| not_exr(&e))?, &header.channels, &factors)?;
    }
    Ok(ReadPicture { xyz: Image::xyz(window.size.0 as u32, window.xyz)?, source })
}

fn not_exr(error: &exr::error::Error) -> Error {
    use exr::error::Error as Exr;
    let (kind, message) = match error {
        Exr::NotSupported(what) => (ErrorKind::Unsupported, format!("EXR with what is not supported: {what}")),
        Exr::Invalid(what) => (ErrorKind::FileFormat, format!("damaged EXR: {what}")),
        other => (ErrorKind::FileFormat, format!("damaged EXR: {other}")),
    };
    Error::new(kind, message)
}

/// Refuses deep data and pictures that are too large, before memory for the pixels is taken.
fn check_size(meta: &MetaData) -> Result<()> {
    if meta.requirements.has_deep_data || meta.headers.iter().any(|header| header.deep) {
        let message = "deep data, samples at several depths a pixel; expected a flat picture";
        return Err(Error::new(ErrorKind::Unsupported, message));
    }
    let area = |size: Vec2<usize>| size.0 as u128 * size.1 as u128;
    let samples: u128 = meta.headers.iter().map(|h| area(h.layer_size) * h.channels.list.len() as u128).sum();
    let shown = meta.headers.iter().map(|h| area(h.shared_attributes.display_window.size)).max().unwrap_or(0);
    if samples.max(shown) > MAX_SAMPLES {
        let message = format!("{} samples; expected at most {MAX_SAMPLES}", samples.max(shown));
        return Err(Error::new(ErrorKind::LimitExceeded, message));
    }
    Ok(())
}

/// Computes what each of a candidate's channels adds to X, Y and Z.
fn to_xyz(candidate: &Candidate, chromaticities: Option<Chromaticities>) -> Result<(Vec<DVec3>, Source)> {
    Ok(match &candidate.colors {
        Colors::Xyz(_) => (vec![DVec3::X, DVec3::Y, DVec3::Z], Source::Xyz),
        Colors::Rgb(_) => {
            let matrix = match chromaticities {
                Some(c) => xyz_from_rgb(&c)?,
                None => RgbSpace::srgb().xyz_from_rgb,
            };
            let columns = vec![matrix.x_axis, matrix.y_axis, matrix.z_axis];
            (columns, Source::Rgb { chromaticities: chromaticities.is_some() })
        }
        Colors::Spectral { lambdas_nm, .. } => {
            (spectral::weights(lambdas_nm)?, Source::Spectral { bands: lambdas_nm.len() })
        }
    })
}

fn xyz_from_rgb(c: &Chromaticities) -> Result<DMat3> {
    let point = |v: Vec2<f32>| [f64::from(v.0), f64::from(v.1)];
    let srgb = RgbSpace::srgb();
    let primaries = [c.red, c.green, c.blue].map(point);
    let near = |a: [f64; 2], b: [f64; 2]| (0..2).all(|i| (a[i] - b[i]).abs() < f64::from(f32::EPSILON));
    if primaries.iter().zip(srgb.primaries).all(|(a, b)| near(*a, b)) && near(point(c.white), srgb.white) {
        return Ok(srgb.xyz_from_rgb);
    }
    let directions = DMat3::from_cols_array_2d(&primaries.map(|[x, y]| [x, y, 1.0 - x - y]));
    let amounts = directions.inverse() * xyz_from_xy(point(c.white));
    if !amounts.is_finite() {
        let message =
            "the chromaticities span no colours; expected three primaries in a triangle and a white with y > 0";
        return Err(Error::new(ErrorKind::FileFormat, message));
    }
    Ok(DMat3::from_cols(directions.x_axis * amounts.x, directions.y_axis * amounts.y, directions.z_axis * amounts.z))
}

/// The display window, which is filled block by block with the pixels of a part.
struct Window {
    size: Vec2<usize>,
    /// Position of the data's first pixel in the display window.
    offset: [i64; 2],
    xyz: Vec<[f64; 3]>,
}

impl Window {
    fn new(header: &Header) -> Result<Self> {
        let (display, data) = (header.shared_attributes.display_window, header.own_attributes.layer_position);
        if display.size.area() == 0 {
            return Err(Error::new(ErrorKind::FileFormat, "an empty display window; expected pixels to show"));
        }
        let offset =
            [(data.0, display.position.0), (data.1, display.position.1)].map(|(a, b)| i64::from(a) - i64::from(b));
        Ok(Self { size: display.size, offset, xyz: vec![[0.0; 3]; display.size.area()] })
    }

    /// Adds each channel by its factors to X, Y and Z.
    fn add_block(&mut self, block: &UncompressedBlock, channels: &ChannelList, factors: &[DVec3]) -> Result<()> {
        if block.data.len() != block.index.pixel_size.area() * channels.bytes_per_pixel {
            return Err(Error::new(ErrorKind::FileFormat, "damaged EXR: a block of another size than its pixels have"));
        }
        for line in block.lines(channels) {
            let factors = factors[line.location.channel];
            if factors == DVec3::ZERO {
                continue;
            }
            let kind = channels.list[line.location.channel].sample_type;
            let (x, y) = (line.location.position.0 as i64, line.location.position.1 as i64);
            for (i, sample) in line.value.chunks_exact(kind.bytes_per_sample()).enumerate() {
                self.add([x + i as i64 + self.offset[0], y + self.offset[1]], value(kind, sample), factors);
            }
        }
        Ok(())
    }

    fn add(&mut self, [x, y]: [i64; 2], value: f64, factors: DVec3) {
        let (width, height) = (self.size.0 as i64, self.size.1 as i64);
        if (0..width).contains(&x) && (0..height).contains(&y) {
            let pixel = &mut self.xyz[(y * width + x) as usize];
            for (sum, factor) in pixel.iter_mut().zip(factors.to_array()) {
                // A channel that adds nothing adds no NaN either.
                *sum += if factor == 0.0 { 0.0 } else { value * factor };
            }
        }
    }
}

/// Decodes one sample of a block, which has the byte order of the machine.
fn value(kind: SampleType, bytes: &[u8]) -> f64 {
    match (kind, bytes) {
        (SampleType::F16, &[a, b]) => f64::from(f16::from_ne_bytes([a, b])),
        (SampleType::F32, &[a, b, c, d]) => f64::from(f32::from_ne_bytes([a, b, c, d])),
        (SampleType::U32, &[a, b, c, d]) => f64::from(u32::from_ne_bytes([a, b, c, d])),
        _ => f64::NAN,
    }
}
