//! `abbe compare` as people and scripts meet it.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};

use abbe::Image;
use abbe::io::exr::{Preference, decode, encode_image};
use serde_json::Value;

/// A folder of its own, removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let name = format!("abbe-compare-{}-{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let path = std::env::temp_dir().join(name);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    /// A picture of `width` × n pixels with X = Y = Z.
    fn grey(&self, name: &str, width: u32, values: &[f32]) {
        let pixels = values.iter().map(|v| [f64::from(*v); 3]).collect();
        self.write(name, &Image::xyz(width, pixels).unwrap());
    }

    /// A picture of `side` × `side` pixels that are all alike: a value for each channel.
    fn uniform(&self, name: &str, side: u32, pixel: &[(&str, f64)]) {
        let (channels, values): (Vec<&str>, Vec<f64>) = pixel.iter().copied().unzip();
        self.write(name, &Image::new([side; 2], &channels, values.repeat((side * side) as usize)));
    }

    fn write(&self, name: &str, image: &Image) {
        fs::write(self.0.join(name), encode_image(image).unwrap()).unwrap();
    }

    /// Exit code, stdout, stderr.
    fn compare(&self, args: &[&str]) -> (i32, String, String) {
        let mut command = Command::new(env!("CARGO_BIN_EXE_abbe"));
        let output = command.current_dir(&self.0).arg("compare").args(args).stdin(Stdio::null()).output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
    }

    fn json(&self, args: &[&str]) -> Value {
        let (code, out, err) = self.compare(&[args, &["--json"]].concat());
        assert_eq!(code, 0, "{err}");
        serde_json::from_str(&out).unwrap()
    }

    /// Asserts exit code 2 or 3 and one line on stderr with all of `parts`.
    fn refuses(&self, args: &[&str], code: i32, parts: &[&str]) {
        let (found, out, err) = self.compare(args);
        let one_line = err.lines().count() == 1 && !err.contains("panicked");
        assert!(found == code && out.is_empty() && one_line, "{args:?}: {found}: {out}{err}");
        assert!(parts.iter().all(|part| err.contains(part)), "{args:?}: expected {parts:?} in {err}");
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn close(value: &Value, expected: f64) -> bool {
    (value.as_f64().unwrap() - expected).abs() <= 1e-6 * expected.abs()
}

#[test]
fn a_picture_with_itself() {
    let folder = Folder::new();
    folder.grey("a.exr", 8, &[0.25; 64]);
    let report = folder.json(&["a.exr", "a.exr", "--threshold", "0", "--threshold", "psnr=90"]);
    for key in ["relmse", "relmse_trimmed", "mape", "smape", "flip"] {
        assert_eq!(report[key], 0.0, "{key}");
    }
    assert_eq!((&report["psnr"], &report["delta_e_2000"]["max"]), (&Value::Null, &Value::from(0.0)));
    assert_eq!(report["bias"][1]["significant"], false);
    let (code, out, _) = folder.compare(&["a.exr", "a.exr"]);
    assert!(code == 0 && out.contains("infinite: no difference") && out.contains("8x8"), "{out}");
}

#[test]
fn known_differences_scale_and_threshold() {
    let folder = Folder::new();
    folder.grey("a.exr", 8, &[0.5; 64]);
    folder.grey("b.exr", 8, &[0.25; 64]);
    let report = folder.json(&["a.exr", "b.exr"]);
    assert!(close(&report["relmse"], 1.0 / 1.01) && close(&report["mape"], 1.0 / 1.01), "{report}");
    assert!(close(&report["smape"], 2.0 / 3.0) && close(&report["bias"][0]["mean"], 0.25), "{report}");
    assert_eq!(report["bias"][0]["significant"], true);
    for arguments in [["--scale", "auto"], ["--scale", "0.5"]] {
        let report = folder.json(&[&["a.exr", "b.exr"], &arguments[..]].concat());
        assert!(close(&report["scale"], 0.5) && report["relmse"].as_f64().unwrap() < 1e-12, "{report}");
    }
    let (code, out, err) = folder.compare(&["a.exr", "b.exr", "--threshold", "0.5", "--threshold", "smape=0.6"]);
    assert!(code == 4 && out.contains("relMSE") && err.lines().count() == 2, "{code} {err}");
    assert_eq!(folder.compare(&["a.exr", "b.exr", "--threshold", "1"]).0, 0);
    let (code, out, err) = folder.compare(&["a.exr", "b.exr", "-q", "--threshold", "psnr=90"]);
    assert!(code == 4 && out.is_empty() && err.is_empty());
}

#[test]
fn pixels_that_are_not_finite_are_counted_and_fail() {
    let folder = Folder::new();
    let mut values = [0.5; 64];
    folder.grey("b.exr", 8, &values);
    (values[3], values[9]) = (f32::NAN, f32::INFINITY);
    folder.grey("a.exr", 8, &values);
    let (code, out, err) = folder.compare(&["a.exr", "b.exr"]);
    assert!(code == 0 && out.contains("62 pixels of them") && err.contains("2 pixels of A and 0 of B"), "{out}{err}");
    assert_eq!(folder.json(&["b.exr", "a.exr"])["non_finite_pixels"]["b"], 2);
    assert_eq!(folder.compare(&["a.exr", "b.exr", "--threshold", "1"]).0, 4);
    folder.grey("nan.exr", 8, &[f32::NAN; 64]);
    folder.refuses(&["nan.exr", "b.exr"], 3, &["no pixel is finite in both"]);
}

#[test]
fn a_black_reference() {
    let folder = Folder::new();
    folder.grey("a.exr", 4, &[0.5; 16]);
    folder.grey("black.exr", 4, &[0.0; 16]);
    let report = folder.json(&["a.exr", "black.exr"]);
    assert_eq!((&report["relmse"], &report["mape"], &report["smape"]), (&Value::Null, &Value::Null, &Value::from(2.0)));
    assert!(folder.compare(&["a.exr", "black.exr"]).1.contains("relMSE   infinite"));
    assert_eq!(folder.compare(&["a.exr", "black.exr", "--threshold", "1e30"]).0, 4);
    assert_eq!(folder.json(&["black.exr", "black.exr"])["relmse"], 0.0);
    folder.refuses(&["a.exr", "black.exr", "--scale", "auto"], 3, &["--scale auto", "expected both positive"]);
}

#[test]
fn rgb_and_spectral_pictures() {
    let folder = Folder::new();
    // The equal-energy spectrum: in all bands 1; in XYZ the sums over the observer; in linear sRGB 1.205, 0.948, 0.909.
    let names: Vec<String> = (0..95).map(|i| format!("S0.{},0nm", 360 + 5 * i)).collect();
    folder.uniform("s.exr", 4, &names.iter().map(|name| (name.as_str(), 1.0)).collect::<Vec<_>>());
    folder.uniform("x.exr", 4, &[("X", 1.000_03), ("Y", 1.0), ("Z", 1.000_08)]);
    folder.uniform("r.exr", 4, &[("R", 1.20503), ("G", 0.94827), ("B", 0.90890)]);
    for (a, b) in [("s.exr", "x.exr"), ("r.exr", "x.exr"), ("s.exr", "r.exr")] {
        for channels in ["xyz", "rgb"] {
            let report = folder.json(&[a, b, "--channels", channels]);
            assert!(report["relmse"].as_f64().unwrap() < 1e-7, "{a} {b}: {report}");
            assert_eq!(report["channels"], channels);
        }
    }
    let report = folder.json(&["s.exr", "r.exr"]);
    assert_eq!(report["sources"], serde_json::json!(["95 spectral channels", "R, G, B taken as Rec. 709"]));
}

#[test]
fn masks_and_pictures_of_the_difference() {
    let folder = Folder::new();
    let ramp: Vec<f32> = (0..64).map(|i| 0.1 + 0.01 * i as f32).collect();
    let mut test = ramp.clone();
    test[0] += 0.5;
    folder.grey("a.exr", 8, &test);
    folder.grey("b.exr", 8, &ramp);
    let mut mask = [1.0; 64];
    mask[0] = 0.0;
    folder.grey("mask.exr", 8, &mask);
    let report = folder.json(&["a.exr", "b.exr", "--mask", "mask.exr"]);
    assert_eq!((&report["relmse"], &report["pixels"]), (&Value::from(0.0), &Value::from(63)));

    let (code, ..) = folder.compare(&["a.exr", "b.exr", "-q", "-o", "d.exr", "-o", "d.png", "--map", "flip"]);
    assert_eq!(code, 0);
    let difference = decode(&fs::read(folder.0.join("d.exr")).unwrap(), Preference::Xyz, None).unwrap();
    assert!((difference.xyz.triples()[0][1] - 0.5).abs() < 1e-6 && difference.xyz.triples()[1] == [0.0; 3]);
    let picture = image::load_from_memory(&fs::read(folder.0.join("d.png")).unwrap()).unwrap().to_rgb8();
    assert_eq!(picture.dimensions(), (8, 8));
    assert!(picture.get_pixel(0, 0).0.iter().any(|v| *v > 50));
    let again = fs::read(folder.0.join("mask.exr")).unwrap();
    fs::write(folder.0.join("mask.png"), again).unwrap();
    // The content decides, not the name.
    assert_eq!(folder.json(&["a.exr", "b.exr", "--mask", "mask.png"])["pixels"], 63);
}

#[test]
fn refusals_in_one_line() {
    let folder = Folder::new();
    folder.grey("a.exr", 8, &[0.5; 64]);
    folder.grey("wide.exr", 16, &[0.5; 64]);
    folder.grey("mask.exr", 8, &[0.0; 64]);
    folder.uniform("y.exr", 8, &[("Y", 1.0)]);
    fs::write(folder.0.join("text.exr"), "no picture").unwrap();
    folder.refuses(&["a.exr", "wide.exr"], 3, &["a.exr has 8x8 pixels, wide.exr has 16x4"]);
    folder.refuses(&["a.exr", "text.exr"], 3, &["text.exr: not an EXR file; expected OpenEXR"]);
    folder.refuses(&["none.exr", "a.exr"], 3, &["none.exr: cannot be read"]);
    folder.refuses(&["y.exr", "a.exr"], 3, &["y.exr: no picture: the channels are Y; expected X, Y, Z or R, G, B"]);
    folder.refuses(&["a.exr", "a.exr", "--layer", "left"], 3, &["a.exr: no picture in the layer \"left\""]);
    folder.refuses(&["a.exr", "a.exr", "--mask", "mask.exr"], 3, &["the mask leaves no finite pixel"]);
    folder.refuses(&["a.exr", "a.exr", "--mask", "wide.exr"], 3, &["wide.exr: a mask of 16x4 pixels; expected 8x8"]);
    folder.refuses(&["a.exr", "a.exr", "--scale=-1"], 2, &["expected a positive factor, or auto"]);
    folder.refuses(&["a.exr", "a.exr", "--exposure", "bright"], 2, &["expected stops"]);
    folder.refuses(&["a.exr", "a.exr", "--threshold", "sMape=1"], 2, &["did you mean \"smape\"?"]);
    folder.refuses(&["a.exr", "a.exr", "-o", "a.jpg"], 2, &["ends in .exr or .png"]);
    folder.refuses(&["a.exr", "a.exr", "--pixels-per-degree", "0"], 2, &["expected more than 0"]);
    folder.refuses(&["-", "-"], 2, &["expected one of them on stdin"]);
    folder.refuses(&["-", "a.exr"], 3, &["<stdin>: not an EXR file"]);
}
