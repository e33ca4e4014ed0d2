//! Writes OpenEXR files of 32-bit floats with ZIP compression. Those of films have the channels R, G, B (linear sRGB) and
//! X, Y, Z, the number of camera samples `samples`, and the standard error of each value `error.X`, `error.Y`, `error.Z`.

use crate::color::RgbSpace;
use crate::film::Film;
use crate::{Error, ErrorKind, Result};
use exr::prelude::*;
use glam::DVec3;
use std::io::Cursor;

/// What is written beside the pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attributes {
    /// Hash of the scene's file.
    pub scene_hash: u64,
    /// Seed of the render.
    pub seed: u64,
    /// Camera paths per pixel.
    pub samples_per_pixel: u64,
    /// Wall time of the render.
    pub seconds: f64,
    /// Name of the observer whose XYZ the film holds.
    pub observer: &'static str,
}

/// The channels of a film's file.
const CHANNELS: [&str; 10] = ["R", "G", "B", "X", "Y", "Z", "samples", "error.X", "error.Y", "error.Z"];

/// Encodes a film. Also returns how many values did not fit into f32 and became its largest number.
pub fn encode(film: &Film, attributes: &Attributes) -> Result<(Vec<u8>, usize)> {
    let mut overflows = 0;
    let mut narrow = |v: f64| {
        let fits = v.abs() <= f64::from(f32::MAX);
        overflows += usize::from(!fits);
        if fits { v as f32 } else { f32::MAX.copysign(v as f32) }
    };
    let mut planes: [Vec<f32>; CHANNELS.len()] = Default::default();
    for (pixel, xyz) in film.to_image().triples().iter().enumerate() {
        let rgb = (RgbSpace::srgb().rgb_from_xyz * DVec3::from(*xyz)).to_array();
        let samples = [film.camera().samples(pixel) as f64];
        let error = film.standard_error(pixel);
        for (plane, value) in planes.iter_mut().zip(rgb.into_iter().chain(*xyz).chain(samples).chain(error)) {
            plane.push(narrow(value));
        }
    }

    let mut layer = software();
    let mut other = |name: &str, value: AttributeValue| layer.other.insert(Text::from(name), value);
    other("sceneHash", AttributeValue::Text(Text::from(format!("{:016x}", attributes.scene_hash).as_str())));
    other("seed", AttributeValue::Text(Text::from(attributes.seed.to_string().as_str())));
    other("samplesPerPixel", AttributeValue::Text(Text::from(attributes.samples_per_pixel.to_string().as_str())));
    other("observer", AttributeValue::Text(Text::from(attributes.observer)));
    other("renderSeconds", AttributeValue::F64(attributes.seconds));

    let at = |[x, y]: [f64; 2]| Vec2(x as f32, y as f32);
    let [red, green, blue] = RgbSpace::srgb().primaries.map(at);
    let white = at(RgbSpace::srgb().white);
    let chromaticities = Some(attribute::Chromaticities { red, green, blue, white });
    let size = [film.width(), film.height()];
    Ok((bytes(size, CHANNELS.into_iter().zip(planes), layer, chromaticities)?, overflows))
}

/// Encodes the channels of a picture under their names.
pub fn encode_image(image: &crate::Image) -> Result<Vec<u8>> {
    let plane = |c: usize| image.plane(c).map(|v| v as f32).collect();
    let planes = image.channels().iter().enumerate().map(|(c, name)| (name.as_str(), plane(c)));
    bytes(image.size(), planes, software(), None)
}

/// Returns the attributes that every file has.
fn software() -> LayerAttributes {
    LayerAttributes { software_name: Some(Text::from(crate::VERSION)), ..Default::default() }
}

fn bytes<'a>(
    [width, height]: [u32; 2],
    planes: impl Iterator<Item = (&'a str, Vec<f32>)>,
    attributes: LayerAttributes,
    chromaticities: Option<attribute::Chromaticities>,
) -> Result<Vec<u8>> {
    let channels: SmallVec<[AnyChannel<FlatSamples>; 4]> =
        planes.map(|(name, plane)| AnyChannel::new(name, FlatSamples::F32(plane))).collect();
    let encoding = Encoding { compression: Compression::ZIP16, ..Encoding::FAST_LOSSLESS };
    let size = Vec2(width as usize, height as usize);
    let mut image = Image::from_layer(Layer::new(size, attributes, encoding, AnyChannels::sort(channels)));
    image.attributes.chromaticities = chromaticities;
    let mut bytes = Cursor::new(Vec::new());
    image
        .write()
        .to_buffered(&mut bytes)
        .map_err(|e| Error::new(ErrorKind::Io, format!("cannot encode the EXR: {e}")))?;
    Ok(bytes.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::CameraTile;

    #[test]
    fn what_is_written_can_be_read() {
        let attributes =
            Attributes { scene_hash: 0xabc, seed: 7, samples_per_pixel: 16, seconds: 1.5, observer: "1931-2" };
        let mut film = Film::new(3, 2, 1.0);
        let mut tile = CameraTile::new([0, 0], [3, 2], 0, 3);
        for i in 0..6u32 {
            (0..2).for_each(|r| {
                tile.add_to_pixel([i as i32 % 3, i as i32 / 3], r, &[f64::from(i), 0.5 + r as f64, 1e60]);
            });
            film.camera_mut().count_samples(Some(i as usize), 2);
        }
        film.add_tiles(&[&tile]);
        film.camera_mut().weigh_open_stage([1.0; 2], 1.0);
        let (bytes, overflows) = encode(&film, &attributes).unwrap();
        assert!(overflows > 0);
        let image = read().no_deep_data().largest_resolution_level().all_channels().all_layers().all_attributes();
        let image = image.from_buffered(Cursor::new(bytes)).unwrap();
        let layer = &image.layer_data[0];
        assert_eq!((layer.size.0, layer.size.1), (3, 2));
        let names: Vec<String> = layer.channel_data.list.iter().map(|c| c.name.to_string()).collect();
        assert_eq!(names, ["B", "G", "R", "X", "Y", "Z", "error.X", "error.Y", "error.Z", "samples"]);
        let values = |i: usize| layer.channel_data.list[i].sample_data.values_as_f32().collect::<Vec<f32>>();
        assert_eq!(values(3), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
        assert_eq!(values(7), [0.5; 6]);
        assert_eq!(values(9), [2.0; 6]);
        assert_eq!(layer.attributes.other[&Text::from("sceneHash")], AttributeValue::Text("0000000000000abc".into()));
        assert_eq!(layer.attributes.other[&Text::from("observer")], AttributeValue::Text("1931-2".into()));
        assert!(image.attributes.chromaticities.is_some());
    }
}
