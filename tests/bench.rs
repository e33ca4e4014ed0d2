//! `abbe bench` as people and scripts meet it, on scenes of a few pixels.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};

use serde_json::Value;

/// A lit sphere on a floor: no glass, so that light paths and camera paths see the same.
const SCENE: &str = r#"{
    "camera": { "type": "perspective", "from": [0, 1, 4], "to": [0, 0.6, 0], "fov_degrees": 40 },
    "film": { "width": 8, "height": 8 },
    "render": { "max_depth": 4 },
    "materials": { "grey": { "type": "diffuse", "reflectance": 0.5 } },
    "objects": [
        { "shape": { "type": "quad", "origin": [-3, 0, 3], "u": [6, 0, 0], "v": [0, 0, -6] }, "material": "grey" },
        { "shape": { "type": "sphere", "center": [0, 0.7, 0], "radius": 0.7 }, "material": "grey" },
        { "shape": { "type": "quad", "origin": [-1, 3, -1], "u": [2, 0, 0], "v": [0, 0, 2] }, "material": "grey",
          "emission": { "illuminant": "D65", "scale": 3 } }
    ]
}"#;

/// A folder of its own, removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let name = format!("abbe-bench-{}-{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let path = std::env::temp_dir().join(name);
        fs::create_dir_all(&path).unwrap();
        fs::write(path.join("ball.json"), SCENE).unwrap();
        Self(path)
    }

    /// Exit code, stdout, stderr.
    fn bench(&self, args: &[&str]) -> (i32, String, String) {
        let mut command = Command::new(env!("CARGO_BIN_EXE_abbe"));
        let output = command.current_dir(&self.0).arg("bench").args(args).stdin(Stdio::null()).output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.0.join(name)).unwrap()
    }

    fn refuses(&self, args: &[&str], code: i32, part: &str) {
        let (found, out, err) = self.bench(args);
        let one_line = err.lines().count() == 1 && !err.contains("panicked");
        assert!(found == code && out.is_empty() && one_line && err.contains(part), "{args:?}: {found}: {out}{err}");
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[test]
fn two_integrators_and_a_command_on_the_same_work() {
    let folder = Folder::new();
    let abbe = env!("CARGO_BIN_EXE_abbe");
    // Another program: this one, by its command line, half as bright for the scale to be found.
    let against = format!("other='{abbe}' render ball.json -q --spp {{spp}} --seed {{seed}} -o {{out}}");
    let budgets = ["--from-spp", "2", "--to-spp", "8", "--reference-spp", "128", "--target", "0.3", "--seed", "5"];
    let arguments =
        [&["ball.json", "--vary", "integrator=path,hero", "--against", &against, "-o", "out"], &budgets[..]];
    let (code, out, err) = folder.bench(&arguments.concat());
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("CPU s to relMSE 0.3") && out.contains("bench.html"), "{out}");
    assert!(err.contains("reference: light, 8 x 128 samples per pixel"), "{err}");

    let report: Value = serde_json::from_str(&folder.read("out/bench.json")).unwrap();
    let variants = report["scenes"][0]["variants"].as_array().unwrap();
    let names: Vec<&str> = variants.iter().map(|v| v["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["path", "hero", "other"]);
    assert_eq!(report["targets"], serde_json::json!([0.01, 0.3]));
    for variant in variants {
        let budgets = variant["budgets"].as_array().unwrap();
        let spp: Vec<u64> = budgets.iter().map(|b| b["samples_per_pixel"].as_u64().unwrap()).collect();
        assert_eq!(spp, [2, 4, 8], "{variant}");
        let errors: Vec<f64> = budgets.iter().map(|b| b["relmse"].as_f64().unwrap()).collect();
        assert!(errors[0] > errors[2] && errors[2] > 0.0, "{errors:?}");
        assert!(budgets.iter().all(|b| b["runs"].as_array().unwrap().len() == 8));
        // Both integrators are right: nothing systematic beyond noise.
        let systematic = budgets[2]["systematic_relmse"].as_f64().unwrap();
        assert!(systematic.abs() < 0.5 * errors[2], "{systematic} of {errors:?}");
        assert!(variant["slope"].as_f64().unwrap() < -0.6, "{variant}");
    }
    // Rays by kind are known of abbe's runs, not of another program's.
    let budget = |variant: usize, key: &str| variants[variant]["budgets"][2][key].clone();
    let kinds = budget(0, "rays_per_cpu_second_by_kind");
    // Eight fast runs can be over before the clock of the processor ticks.
    if budget(0, "cpu_seconds").as_f64().unwrap() > 0.0 {
        let [camera, shadow] = ["camera", "shadow"].map(|kind| kinds[kind].as_f64().unwrap());
        assert!(camera > shadow && shadow > 0.0 && kinds.get("merging").is_none(), "{kinds}");
    }
    assert_eq!(budget(0, "lane_occupancy"), 1.0);
    assert!(budget(2, "lane_occupancy").is_null() && budget(2, "rays_per_cpu_second").is_null());
    assert!(out.contains("shadow rays  lanes in use") && budget(0, "peak_memory_bytes").is_u64());
    // The command renders the same samples that the library does: path is what auto does here.
    let error =
        |variant: usize, run: usize| variants[variant]["budgets"][1]["runs"][run]["relmse_raw"].as_f64().unwrap();
    assert!((error(0, 3) / error(2, 3) - 1.0).abs() < 0.1, "{} {}", error(0, 3), error(2, 3));

    let csv = folder.read("out/bench.csv");
    assert_eq!(csv.lines().count(), 1 + 3 * 3 * 8);
    let html = folder.read("out/bench.html");
    assert_eq!((html.matches("<svg").count(), html.matches("data:image/png;base64,").count()), (2, 7));
    assert!(!html.contains("http://") || html.matches("http").all(|_| html.contains("www.w3.org/2000/svg")));
    // The plot over time stands alone too: a name space, a size, a white ground, the legend; nothing from elsewhere.
    let svg = folder.read("out/ball.svg");
    assert!(svg.starts_with("<svg width=\"560\" height=") && svg.ends_with("</svg>\n"), "{svg}");
    assert!(svg.contains("xmlns=\"http://www.w3.org/2000/svg\"") && svg.contains("fill=\"#fff\"/>"), "{svg}");
    let shown = ["path", "hero", "other", "ball, 8 × 8", "CPU seconds", "relMSE"];
    assert!(shown.iter().all(|text| svg.contains(&format!(">{text}</text>"))), "{svg}");
    assert_eq!((svg.matches("http").count(), svg.matches("<svg").count()), (1, 1));
    let drawn = |text: &str| text.lines().filter(|line| line.starts_with("<polyline")).map(str::to_owned).collect();
    let (lines, of_page): (Vec<String>, Vec<String>) = (drawn(&svg), drawn(&html));
    assert!(lines.len() == 3 && of_page[..3] == lines, "{lines:?} {of_page:?}");
    assert!(!folder.0.join("out/against.exr").exists());
}

#[test]
fn references_are_kept_and_what_is_not_reached_is_said() {
    let folder = Folder::new();
    let arguments = ["ball.json", "--to-spp", "2", "--reference-spp", "64", "--target", "1e-9", "--json"];
    let (code, out, err) = folder.bench(&arguments);
    assert!(code == 0 && !err.contains("kept"), "{err}");
    let first: Value = serde_json::from_str(&out).unwrap();
    let target = &first["scenes"][0]["variants"][0]["time_to_target"][1];
    assert!(target["cpu_seconds"].is_null() && target["not_reached_in"].is_number(), "{target}");
    assert_eq!(first["scenes"][0]["reference"]["integrator"], "light");
    let (_, out, err) = folder.bench(&arguments);
    assert!(err.contains("kept from an earlier run"), "{err}");
    let second: Value = serde_json::from_str(&out).unwrap();
    let error = |report: &Value| report["scenes"][0]["variants"][0]["budgets"][1]["runs"][2]["relmse_raw"].as_f64();
    // The kept reference is rounded to f32.
    let (a, b) = (error(&first).unwrap(), error(&second).unwrap());
    assert!((a / b - 1.0).abs() < 1e-3, "{a} {b}");
    // Another scene, or other settings, is another reference.
    fs::write(folder.0.join("ball.json"), SCENE.replace("\"reflectance\": 0.5", "\"reflectance\": 0.6")).unwrap();
    assert!(!folder.bench(&arguments).2.contains("kept"));
    let (_, out, _) = folder.bench(&["ball.json", "--to-spp", "2", "--reference-spp", "64"]);
    assert!(out.contains("not reached in"), "{out}");
}

#[test]
fn the_reference_is_made_by_what_finds_everything() {
    let folder = Folder::new();
    let sky = SCENE.replacen('{', r#"{ "environment": { "radiance": 0.1 },"#, 1);
    let ball = r#""radius": 0.7 }, "material": "grey""#;
    let glass = SCENE
        .replace(r#""materials": {"#, r#""materials": { "glass": { "type": "dielectric", "ior": 1.5 },"#)
        .replace(ball, &ball.replace("grey", "glass"));
    for (name, scene, integrator) in [("ball", SCENE, "light"), ("sky", &sky, "path"), ("glass", &glass, "auto")] {
        fs::write(folder.0.join(name).with_extension("json"), scene).unwrap();
        let small = ["--to-spp", "1", "--reference-spp", "2", "--json", "-q"];
        let (_, out, err) = folder.bench(&[&[format!("{name}.json").as_str()], &small[..]].concat());
        let report: Value = serde_json::from_str(&out).unwrap_or_else(|e| panic!("{name}: {e}: {err}"));
        assert_eq!(report["scenes"][0]["reference"]["integrator"], integrator, "{name}");
    }
}

#[test]
fn a_file_as_reference_and_a_mask() {
    let folder = Folder::new();
    let mut render = Command::new(env!("CARGO_BIN_EXE_abbe"));
    render.current_dir(&folder.0).args(["render", "ball.json", "--spp", "64", "-q", "-o", "r.exr"]);
    assert!(render.status().unwrap().success());
    let mask = (0..64).flat_map(|i| if i < 32 { [0.0; 3] } else { [1.0; 3] }).collect();
    let mask = abbe::Image::new([8, 8], &["R", "G", "B"], mask);
    fs::write(folder.0.join("mask.exr"), abbe::io::exr::encode_image(&mask).unwrap()).unwrap();
    let relmse = |more: &[&str]| {
        let (code, out, err) =
            folder.bench(&[&["ball.json", "--to-spp", "2", "--reference", "r.exr", "--json", "-q"], more].concat());
        assert!(code == 0 && err.is_empty(), "{err}");
        let report: Value = serde_json::from_str(&out).unwrap();
        assert_eq!(report["scenes"][0]["reference"]["file"], "r.exr");
        report["scenes"][0]["variants"][0]["budgets"][0]["relmse"].as_f64().unwrap()
    };
    assert!(relmse(&[]) != relmse(&["--mask", "mask.exr"]));
    folder.refuses(&["ball.json", "--reference", "r.exr", "--resolution", "4x4"], 3, "r.exr: 8x8 pixels; expected 4x4");
    folder.refuses(&["ball.json", "--mask", "mask.exr", "--resolution", "4x4"], 3, "expected 4x4");
}

#[test]
fn refusals_in_one_line() {
    let folder = Folder::new();
    folder.refuses(&["ball.json", "--calibrate", "--against", "x=y {spp} {out}"], 2, "makes no claims");
    folder.refuses(&["none.json"], 3, "none.json");
    folder.refuses(
        &["ball.json", "--vary", "lanes=4"],
        2,
        "no such setting; expected one of integrator, max-depth, adaptive",
    );
    folder.refuses(&["ball.json", "--reference", "heroo"], 2, "did you mean \"hero\"?");
    folder.refuses(&["ball.json", "--against", "x"], 2, "expected NAME=COMMAND");
    folder.refuses(&["ball.json", "--target", "0"], 2, "expected a relMSE above 0");
    folder.refuses(&["ball.json", "--from-spp", "8", "--to-spp", "4"], 2, "exceeds");
    folder.refuses(&["ball.json", "--resolution", "8"], 2, "expected WIDTHxHEIGHT");
    let small = ["ball.json", "-q", "--to-spp", "2", "--reference-spp", "2", "--against"];
    folder.refuses(
        &[&small[..], &["x=echo no such renderer {spp} {out} >&2; exit 7"]].concat(),
        1,
        "no such renderer 1",
    );
    folder.refuses(&[&small[..], &["x=true {spp} {out}"]].concat(), 3, "against.exr: cannot be read");
    let writes_text = "x=echo {spp} > {out}";
    folder.refuses(&[&small[..], &[writes_text]].concat(), 3, "against.exr: not an EXR file");
}
