use super::*;
use crate::color::RgbSpace;
use ::exr::prelude::*;
use glam::DVec3;
use std::io::Cursor;

type ExrImage = Image<Layers<AnyChannels<FlatSamples>>>;

/// A part with channels of f32 values.
fn part(name: &str, size: (usize, usize), channels: &[(&str, &[f32])]) -> Layer<AnyChannels<FlatSamples>> {
    let list =
        channels.iter().map(|(name, values)| AnyChannel::new(*name, FlatSamples::F32(values.to_vec()))).collect();
    let attributes = LayerAttributes::named(name);
    Layer::new(Vec2(size.0, size.1), attributes, Encoding::FAST_LOSSLESS, AnyChannels::sort(list))
}

fn bytes_of(image: &ExrImage) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

fn image(attributes: ImageAttributes, parts: Vec<Layer<AnyChannels<FlatSamples>>>) -> ExrImage {
    Image { attributes, layer_data: parts.into_iter().collect() }
}

fn file(parts: Vec<Layer<AnyChannels<FlatSamples>>>) -> Vec<u8> {
    bytes_of(&image(ImageAttributes::with_size(parts[0].size), parts))
}

const RGB: [(&str, &[f32]); 3] = [("R", &[1.0, 0.0]), ("G", &[1.0, 0.0]), ("B", &[1.0, 0.5])];

fn xyz(bytes: &[u8]) -> (Vec<DVec3>, Source) {
    let picture = decode(bytes, Preference::Xyz, None).unwrap();
    (picture.xyz.triples().iter().copied().map(DVec3::from).collect(), picture.source)
}

fn message(result: crate::Result<ReadPicture>) -> String {
    result.unwrap_err().to_string()
}

#[test]
fn rgb_by_chromaticities() {
    let bytes = file(vec![part("a", (2, 1), &RGB)]);
    let (pixels, source) = xyz(&bytes);
    assert_eq!(source, Source::Rgb { chromaticities: false });
    assert!(pixels[0].abs_diff_eq(RgbSpace::srgb().white_xyz(), 1e-12));

    // Primaries X, Y, Z and the equal-energy white: RGB is XYZ.
    let mut image = image(ImageAttributes::with_size(Vec2(2, 1)), vec![part("a", (2, 1), &RGB)]);
    let [red, green, blue, white] =
        [(1.0, 0.0), (0.0, 1.0), (0.0, 0.0), (1.0 / 3.0, 1.0 / 3.0)].map(|(x, y)| Vec2(x, y));
    image.attributes.chromaticities = Some(attribute::Chromaticities { red, green, blue, white });
    let (pixels, source) = xyz(&bytes_of(&image));
    assert_eq!(source, Source::Rgb { chromaticities: true });
    assert!(pixels[1].abs_diff_eq(DVec3::new(0.0, 0.0, 0.5), 1e-6), "{pixels:?}");

    image.attributes.chromaticities = Some(attribute::Chromaticities { red, green: red, blue, white });
    assert!(message(decode(&bytes_of(&image), Preference::Xyz, None)).contains("triangle"));
}

#[test]
fn half_and_integers() {
    let list = [
        AnyChannel::new("X", FlatSamples::F16([0.5, 1.5].map(f16::from_f32).to_vec())),
        AnyChannel::new("Y", FlatSamples::U32(vec![3, 4])),
        AnyChannel::new("Z", FlatSamples::F32(vec![0.0, f32::NAN])),
    ];
    let layer = Layer::new(
        Vec2(1, 2),
        LayerAttributes::default(),
        Encoding::SMALL_LOSSLESS,
        AnyChannels::sort(list.into_iter().collect()),
    );
    let (pixels, source) = xyz(&file(vec![layer]));
    assert_eq!((source, pixels[0]), (Source::Xyz, DVec3::new(0.5, 3.0, 0.0)));
    assert!(pixels[1].x == 1.5 && pixels[1].y == 4.0 && pixels[1].z.is_nan());
}

#[test]
fn preferences() {
    let values: &[f32] = &[1.0];
    let mut channels: Vec<(&str, &[f32])> = ["R", "G", "B", "X", "Y", "Z"].into_iter().map(|n| (n, values)).collect();
    let spectral: Vec<String> = (0..8).map(|i| format!("S0.{},000000nm", 350 + 70 * i)).collect();
    channels.extend(spectral.iter().map(|name| (name.as_str(), values)));
    let source = |channels: &[(&str, &[f32])], preference| {
        decode(&file(vec![part("a", (1, 1), channels)]), preference, None).unwrap().source
    };
    assert_eq!(source(&channels, Preference::Xyz), Source::Xyz);
    assert_eq!(source(&channels, Preference::Rgb), Source::Rgb { chromaticities: false });
    assert_eq!(source(&channels[3..], Preference::Rgb), Source::Xyz);
    channels.drain(3..6);
    assert_eq!(source(&channels, Preference::Xyz), Source::Spectral { bands: 8 });
    let (pixels, _) = xyz(&file(vec![part("a", (1, 1), &channels)]));
    assert!((pixels[0].y - 1.0).abs() < 1e-12);
}

#[test]
fn windows() {
    let mut layer = part("a", (2, 1), &[("X", &[1.0, 2.0]), ("Y", &[1.0, 2.0]), ("Z", &[1.0, 2.0])]);
    layer.attributes.layer_position = Vec2(-1, 5);
    let window = |x, y, w, h| attribute::IntegerBounds::new(Vec2(x, y), Vec2(w, h));
    let read = |display| {
        let bytes = bytes_of(&image(ImageAttributes::new(display), vec![layer.clone()]));
        let picture = decode(&bytes, Preference::Xyz, None).unwrap();
        (picture.xyz.size()[0], picture.xyz.plane(1).collect::<Vec<_>>())
    };
    // Cropped on the left, black below; then larger all round.
    assert_eq!(read(window(0, 5, 1, 2)), (1, vec![2.0, 0.0]));
    assert_eq!(read(window(-2, 4, 4, 3)), (4, [[0.0; 4], [0.0, 1.0, 2.0, 0.0], [0.0; 4]].concat()));
    assert_eq!(read(window(1000, 1000, 1, 1)), (1, vec![0.0]));
}

#[test]
fn layers_and_parts() {
    let named = |layer: &str| RGB.map(|(name, values)| (format!("{layer}.{name}"), values));
    let (one, two) = (named("a.Combined"), named("a.Diffuse"));
    let [one, two] = [&one, &two].map(|names| names.iter().map(|(n, v)| (n.as_str(), *v)).collect::<Vec<_>>());
    let normal: [(&str, &[f32]); 3] = [("N.X", &[0.0; 2]), ("N.Y", &[0.0; 2]), ("N.Z", &[0.0; 2])];

    let bytes = file(vec![part("p", (2, 1), &[&one[..], &normal].concat())]);
    assert!(matches!(xyz(&bytes).1, Source::Rgb { .. }));
    assert_eq!(decode(&bytes, Preference::Xyz, Some("N")).unwrap().source, Source::Xyz);

    let bytes = file(vec![part("p", (2, 1), &[&one[..], &two].concat())]);
    assert!(message(decode(&bytes, Preference::Xyz, None)).contains("a.Combined, a.Diffuse; expected one of them"));
    assert!(decode(&bytes, Preference::Xyz, Some("a.Diffuse")).is_ok());

    let bytes = file(vec![part("left", (2, 1), &RGB), part("right", (2, 1), &RGB), part("depth", (2, 1), &normal)]);
    assert!(message(decode(&bytes, Preference::Xyz, None)).contains("several pictures: left, right;"));
    assert!(decode(&bytes, Preference::Xyz, Some("right")).is_ok());
    let missing = message(decode(&bytes, Preference::Xyz, Some("middle")));
    assert!(missing.contains("in the layer \"middle\": the channels are B, G, R, B, G, R, N.X"), "{missing}");
    // One part with a picture among others.
    assert!(
        decode(&file(vec![part("depth", (2, 1), &normal), part("c", (2, 1), &RGB)]), Preference::Xyz, None).is_ok()
    );
}

#[test]
fn refuses_what_is_no_picture() {
    assert!(message(decode(b"", Preference::Xyz, None)).contains("not an EXR"));
    assert!(message(decode(b"\x89PNG\r\n", Preference::Xyz, None)).contains("not an EXR"));
    let luminance = file(vec![part("a", (2, 1), &[("Y", &[1.0; 2]), ("A", &[1.0; 2])])]);
    assert!(message(decode(&luminance, Preference::Xyz, None)).contains("the channels are A, Y; expected X, Y, Z or"));
    assert!(
        message(read_file("/no/such.exr".as_ref(), Preference::Xyz, None)).starts_with("/no/such.exr: cannot be read")
    );
}

/// Cut short or with any byte changed, a file is refused or read, but never ends the program.
#[test]
fn damaged_files() {
    let bytes = file(vec![part("a", (2, 1), &RGB)]);
    for length in 0..bytes.len() {
        let _ = decode(&bytes[..length], Preference::Xyz, None);
    }
    for i in 0..bytes.len() {
        for flip in [1, 0x80, 0xff] {
            let mut bytes = bytes.clone();
            bytes[i] ^= flip;
            let _ = decode(&bytes, Preference::Xyz, None);
        }
    }
}
