//! The program as people and scripts meet it: exit codes, what goes to which stream, and what is left on disk.

#[path = "common/bad_scenes.rs"]
mod bad;

use std::collections::BTreeMap;
use std::fs;
use std::io::{BufRead, BufReader, Cursor, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

use bad::{BadScene, GOOD, bad_scenes};
use exr::prelude::*;
use rayon::prelude::*;
use serde_json::{Value, json};

/// An empty folder of its own, removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let name = format!("abbe-cli-{}-{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let path = std::env::temp_dir().join(name);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    /// With the small good scene in `scene.json`.
    fn with_scene() -> Self {
        let folder = Self::new();
        folder.write("scene.json", GOOD);
        folder
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.0.join(name), text).unwrap();
    }

    fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.0.join(name)).unwrap()
    }

    fn files(&self) -> Vec<String> {
        let mut names: Vec<String> =
            fs::read_dir(&self.0).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    fn command(&self, args: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_abbe"));
        command.current_dir(&self.0).args(args).stdin(Stdio::null());
        command
    }

    /// Runs `abbe ARGS` here.
    fn abbe(&self, args: &[&str]) -> Run {
        Run::new(self.command(args).output().unwrap())
    }

    fn abbe_with_stdin(&self, args: &[&str], input: &str) -> Run {
        let mut command = self.command(args);
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
        Run::new(child.wait_with_output().unwrap())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// How a run ended.
#[derive(Debug)]
struct Run {
    code: Option<i32>,
    out: Vec<u8>,
    err: String,
}

impl Run {
    fn new(output: Output) -> Self {
        Self { code: output.status.code(), out: output.stdout, err: String::from_utf8(output.stderr).unwrap() }
    }

    fn out(&self) -> &str {
        std::str::from_utf8(&self.out).unwrap()
    }

    /// Asserts an exit code and, on stderr, one line that holds all of `parts`; nothing on stdout.
    fn fails(&self, code: i32, parts: &[&str]) {
        assert_eq!(self.code, Some(code), "{self:?}");
        assert!(self.is_one_line(), "{self:?}");
        assert!(parts.iter().all(|part| self.err.contains(part)), "expected {parts:?} in {self:?}");
        assert!(self.out.is_empty(), "{self:?}");
    }

    fn is_one_line(&self) -> bool {
        self.err.lines().count() == 1 && self.err.ends_with('\n') && !self.err.contains("panicked")
    }

    fn succeeds(&self) -> &Self {
        assert_eq!(self.code, Some(0), "{self:?}");
        self
    }
}

/// What is wrong with how a bad scene was refused, if anything.
fn complaint(scene: &BadScene, run: &Run, file: &str) -> Option<String> {
    let line = run.err.trim_end();
    let prefix = if scene.place.is_empty() { format!("{file}: ") } else { format!("{file}: {}", scene.place) };
    let ends_place = |rest: &str| scene.place.is_empty() || scene.code == "syntax" || rest.starts_with([':', ' ']);
    let says_where = line.strip_prefix(&prefix).is_some_and(ends_place);
    let good = run.code == Some(3) && run.is_one_line() && run.out.is_empty();
    let said = line.contains(scene.fragment);
    (!(good && says_where && said)).then(|| {
        format!("{}: expected {prefix} …{}…\n    exit {:?}: {}", scene.name, scene.fragment, run.code, run.err)
    })
}

fn refuse_all(arguments: &[&str], scenes: &[BadScene]) {
    let complaints: Vec<String> = scenes
        .par_iter()
        .filter_map(|scene| {
            let folder = Folder::new();
            folder.write("bad scene.json", &scene.text);
            let run = folder.abbe(&[arguments, &["bad scene.json"]].concat());
            assert_eq!(folder.files(), ["bad scene.json"], "{}: something was written", scene.name);
            complaint(scene, &run, "bad scene.json")
        })
        .collect();
    assert!(complaints.is_empty(), "{} of {} scenes:\n{}", complaints.len(), scenes.len(), complaints.join("\n"));
}

#[test]
fn check_refuses_every_bad_scene_in_one_line() {
    let scenes = bad_scenes();
    assert!(scenes.len() > 130 && scenes.iter().filter(|s| s.needs_compile).count() > 8);
    refuse_all(&["scene", "check"], &scenes);
}

#[test]
fn render_refuses_bad_scenes_in_one_line() {
    let scenes: Vec<BadScene> =
        bad_scenes().into_iter().enumerate().filter(|(i, s)| s.needs_compile || i % 5 == 0).map(|(_, s)| s).collect();
    assert!(scenes.len() > 30);
    refuse_all(&["render"], &scenes);
}

/// Scene, place in it, file, place in that, and what was expected there.
#[test]
fn faults_in_files_are_told_from_the_scene() {
    const SPHERE: &str = "{ \"type\": \"sphere\", \"center\": [0, 0, 0], \"radius\": 1 }";
    let mesh =
        |file: &str| (SPHERE, format!("{{ \"type\": \"mesh\", \"file\": \"{file}\" }}"), "objects[0].shape.file");
    let lamp = ("1.0", "{\"file\": \"lamp.csv\"}".to_owned(), "lights[0].intensity.file");
    let ior = ("1.5", "{\"file\": \"ior.yml\"}".to_owned(), "materials.glass.ior.file");
    for ((from, to, place), file, content, expected) in [
        (mesh("a.obj"), "a.obj", "v 1 2\nf 1 2 3\n", "a.obj: line 1: "),
        (mesh("a.obj"), "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "a.obj: line 4: "),
        (mesh("a.ply"), "a.ply", "ply\nhello\n", "a.ply: line 2: "),
        (mesh("a.obj"), "a.obj", "", "a.obj: "),
        (lamp.clone(), "lamp.csv", "wavelength,power\n", "lamp.csv: no samples; expected"),
        (lamp, "lamp.csv", "400, 1\n500, x\n", "lamp.csv: line 2: "),
        (ior.clone(), "ior.yml", "DATA: 3", "ior.yml: line 1: "),
        (ior, "other.yml", "", "ior.yml: no such file"),
    ] {
        let folder = Folder::new();
        folder.write("scene.json", &GOOD.replacen(from, &to, 1));
        folder.write(file, content);
        folder.abbe(&["scene", "check", "scene.json"]).fails(3, &[&format!("scene.json: {place}: "), expected]);
    }
}

#[test]
fn check_reports_every_scene_as_text_and_as_json() {
    let folder = Folder::with_scene();
    folder.write("bad.json", "{}");
    let run = folder.abbe(&["scene", "check", "bad.json", "scene.json", "none.json"]);
    assert_eq!(run.code, Some(3));
    assert_eq!(run.out(), "scene.json: ok: 2 objects, 2 materials, 1 light, 1 named spectrum\n");
    let lines: Vec<&str> = run.err.lines().collect();
    assert!(lines.len() == 2 && lines[0].starts_with("bad.json: ") && lines[1].starts_with("none.json: "), "{lines:?}");

    let run = folder.abbe(&["scene", "check", "--json", "scene.json", "bad.json"]);
    let report: Value = serde_json::from_str(run.out()).unwrap();
    assert_eq!((run.code, &report["scenes"][0]["ok"]), (Some(3), &Value::Bool(true)));
    assert_eq!(report["scenes"][1]["error"]["code"], "missing");

    let quiet = folder.abbe(&["scene", "check", "-q", "scene.json"]);
    assert!(quiet.succeeds().out.is_empty() && quiet.err.is_empty());
    let stdin = folder.abbe_with_stdin(&["scene", "check", "-"], GOOD);
    assert!(stdin.succeeds().out().starts_with("-: ok: "));
    folder.abbe_with_stdin(&["scene", "check", "-"], "{").fails(3, &["<stdin>: line 1"]);
}

#[test]
fn check_warns_with_file_and_place() {
    let folder = Folder::new();
    folder.write("scene.json", &GOOD.replace("\"ior\": 1.5", "\"ior\": {\"glass\": \"N-SF66\"}"));
    let run = folder.abbe(&["scene", "check", "scene.json"]);
    assert!(run.succeeds().err.starts_with("warning: scene.json: materials.glass.ior: glass \"N-SF66\""), "{run:?}");
    assert!(run.is_one_line());
}

#[test]
fn the_scenes_of_the_repository_pass_the_check_and_the_schema() {
    let folder = Folder::new();
    let schema: Value = serde_json::from_str(folder.abbe(&["scene", "schema"]).succeeds().out()).unwrap();
    let validator = jsonschema::validator_for(&schema).unwrap();
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut count = 0;
    for path in fs::read_dir(scenes).unwrap().map(|entry| entry.unwrap().path()) {
        if path.extension().is_some_and(|e| e == "json") {
            let scene: Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
            let errors: Vec<String> = validator.iter_errors(&scene).map(|e| e.to_string()).collect();
            assert!(errors.is_empty(), "{}: {errors:?}", path.display());
            folder.abbe(&["scene", "check", path.to_str().unwrap()]).succeeds();
            count += 1;
        }
    }
    assert!(count >= 2);
}

#[test]
fn usage_errors_exit_with_2() {
    let folder = Folder::with_scene();
    for args in [
        &["render", "scene.json", "--sppp", "3"][..],
        &["render"],
        &["rendre", "scene.json"],
        &["render", "scene.json", "--spp", "0"],
        &["render", "scene.json", "--spp", "many"],
        &["render", "scene.json", "--threads", "0"],
        &["render", "scene.json", "--seed", "-1"],
        &["scene"],
        &["scene", "check"],
        &["glass", "--colour"],
        &[],
    ] {
        let run = folder.abbe(args);
        assert!(run.code == Some(2) && !run.err.is_empty() && run.out.is_empty(), "{args:?}: {run:?}");
        assert!(!run.err.contains("panicked"), "{args:?}: {run:?}");
    }
    for (flag, value, expected) in [
        ("--resolution", "640", "WIDTHxHEIGHT"),
        ("--resolution", "0x4", "WIDTHxHEIGHT"),
        ("--resolution", "99999999x1", "WIDTHxHEIGHT"),
        ("--resolution", "-4x4", "WIDTHxHEIGHT"),
        ("-o", "a.jpg", ".exr or .png"),
        ("-o", "exr", ".exr or .png"),
        ("--integrator", "paht", "did you mean \"path\"?"),
        ("--tonemap", "reinhart", "did you mean \"reinhard\"?"),
        ("--exposure", "bright", "or auto"),
        ("--exposure", "NaN", "or auto"),
    ] {
        let argument = format!("{flag}={value}");
        let run = folder.abbe(&["render", "scene.json", &argument]);
        // With an equals sign, so that a value may start with a dash.
        run.fails(2, &[flag, expected]);
    }
    assert_eq!(folder.files(), ["scene.json"]);
}

#[test]
fn what_is_not_there_yet_is_refused_not_ignored() {
    let folder = Folder::with_scene();
    for command in ["explain", "develop"] {
        folder.abbe(&[command]).fails(2, &["unrecognized subcommand", command]);
        folder.abbe(&[command, "scene.json", "--threshold", "1"]).fails(2, &["unrecognized subcommand", command]);
    }
    folder.abbe(&["render", "scene.json", "--bands", "8"]).fails(2, &["unexpected argument", "--bands"]);
    let help = folder.abbe(&["--help"]);
    assert!(help.code == Some(0) && !String::from_utf8_lossy(&help.out).contains("not yet"), "{help:?}");
}

#[test]
fn a_render_stops_at_its_time_and_at_its_target() {
    let folder = Folder::with_scene();
    let run = folder.abbe(&["render", "scene.json", "-o", "a.exr", "--time", "0.4", "--json"]);
    let told: Value = serde_json::from_slice(&run.out).unwrap();
    assert!(run.code == Some(0) && told["samples_per_pixel"].as_u64().unwrap() > 0, "{told}");
    assert_eq!((told["adaptive"].clone(), told["target_reached"].clone()), (json!(true), Value::Null));
    let phases = &told["profile"]["phases"];
    assert!(phases["camera"]["seconds"].as_f64().unwrap() > 0.0 && phases["camera"]["rays"].as_u64().unwrap() > 0);
    let target = ["render", "scene.json", "-o", "b.exr", "--target-error", "0.5", "--json"];
    let run = folder.abbe(&target);
    let told: Value = serde_json::from_slice(&run.out).unwrap();
    assert!(run.code == Some(0) && told["relative_mse_bound"].as_f64().unwrap() < 0.5, "{told}");
    assert_eq!(told["target_reached"], json!(true));
    // With a limit that is too low it says so.
    let run = folder.abbe(&[&target[..], &["--spp", "2", "--adaptive", "off"]].concat());
    let told: Value = serde_json::from_slice(&run.out).unwrap();
    assert_eq!((told["target_reached"].clone(), told["samples_per_pixel"].clone()), (json!(false), json!(2)));
    assert!(run.err.contains("has not been reached"), "{}", run.err);
    for (flag, value) in [("--time", "-1"), ("--time", "nan"), ("--target-error", "0"), ("--target-error", "inf")] {
        let argument = format!("{flag}={value}");
        folder.abbe(&["render", "scene.json", &argument]).fails(2, &[flag, "expected"]);
    }
}

#[test]
fn every_integrator_renders_and_tells_its_plan() {
    let folder = Folder::with_scene();
    for name in ["auto", "path", "light", "merge", "hero"] {
        let run =
            folder.abbe(&["render", "scene.json", "--integrator", name, "--spp", "2", "-o", "a.exr", "--json", "-v"]);
        assert_eq!(run.code, Some(0), "{name}: {run:?}");
        assert!(run.err.contains("plan: "), "{name}: {}", run.err);
        let told: Value = serde_json::from_slice(&run.out).unwrap();
        assert!(told["plan"]["camera_ways"].as_u64().is_some(), "{name}: {told}");
        assert_eq!(told["non_finite_samples"], 0, "{name}");
    }
}

#[test]
fn what_cannot_be_written_exits_with_1() {
    let folder = Folder::with_scene();
    folder.abbe(&["render", "scene.json", "-o", "none/a.exr"]).fails(1, &["none", "does not exist"]);
    fs::create_dir(folder.0.join("folder.exr")).unwrap();
    folder.abbe(&["render", "scene.json", "--spp", "1", "-o", "folder.exr"]).fails(1, &["folder.exr: cannot write"]);
    assert_eq!(folder.files(), ["folder.exr", "scene.json"]);
    if cfg!(target_os = "linux") {
        folder.abbe(&["render", "scene.json", "--spp", "1", "-o", "/proc/abbe.exr"]).fails(1, &["/proc/abbe.exr"]);
    }
}

#[test]
fn a_failed_render_leaves_what_was_there() {
    let folder = Folder::with_scene();
    folder.write("a.exr", "precious");
    folder.write("a.png", "precious");
    folder.write("bad.json", &GOOD.replace("\"glass\" }", "\"glas\" }"));
    let outputs = ["-o", "a.exr", "-o", "a.png"];
    folder.abbe(&[&["render", "bad.json"], &outputs[..]].concat()).fails(3, &["objects[1].material"]);
    folder.abbe(&[&["render", "none.json"], &outputs[..]].concat()).fails(3, &["none.json: cannot open"]);
    folder.abbe(&[&["render", "scene.json", "--tonemap", "x"], &outputs[..]].concat()).fails(2, &["--tonemap x"]);
    assert_eq!((folder.read("a.exr"), folder.read("a.png")), (b"precious".to_vec(), b"precious".to_vec()));

    // A file size limit stands in for a full disk.
    if cfg!(target_os = "linux") {
        let script = "trap '' XFSZ; ulimit -f 0; exec \"$0\" render scene.json --spp 1 -o a.exr";
        let mut shell = Command::new("sh");
        shell.args(["-c", script, env!("CARGO_BIN_EXE_abbe")]).current_dir(&folder.0);
        Run::new(shell.output().unwrap()).fails(1, &["a.exr: cannot write"]);
        assert_eq!(folder.read("a.exr"), b"precious");
        assert_eq!(folder.files(), ["a.exr", "a.png", "bad.json", "scene.json"]);
    }
}

/// Size and channels of an EXR of one layer.
fn read_exr(bytes: &[u8]) -> ((usize, usize), BTreeMap<String, Vec<f32>>) {
    let reader = read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer().all_attributes();
    let image = reader.from_buffered(Cursor::new(bytes)).unwrap();
    let layer = image.layer_data;
    let values = |channel: &AnyChannel<FlatSamples>| match &channel.sample_data {
        FlatSamples::F32(values) => values.clone(),
        _ => panic!("{} is not f32", channel.name),
    };
    let channels = layer.channel_data.list.iter().map(|channel| (channel.name.to_string(), values(channel)));
    (layer.size.into(), channels.collect())
}

#[test]
fn render_writes_exr_and_png() {
    let folder = Folder::with_scene();
    let run = folder.abbe(&["render", "scene.json", "--resolution", "24x18", "--spp", "4"]);
    assert!(run.succeeds().out.is_empty() && run.err.is_empty(), "{run:?}");
    assert_eq!(folder.files(), ["scene.exr", "scene.json", "scene.png"]);
    let (size, channels) = read_exr(&folder.read("scene.exr"));
    assert_eq!(size, (24, 18));
    assert_eq!(
        channels.keys().collect::<Vec<_>>(),
        ["B", "G", "R", "X", "Y", "Z", "error.X", "error.Y", "error.Z", "samples"]
    );
    assert!(channels.values().flatten().all(|v| v.is_finite()));
    assert!(channels["Y"].iter().all(|&y| y > 0.0) && channels["Y"].len() == 24 * 18);
    // Linear sRGB's luminance is Y.
    let rgb = channels["R"].iter().zip(&channels["G"]).zip(&channels["B"]);
    for (((r, g), b), y) in rgb.zip(&channels["Y"]) {
        let luminance = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        assert!((luminance - y).abs() < 2e-3 * y, "{luminance} {y}");
    }
    let png = image::load_from_memory(&folder.read("scene.png")).unwrap();
    assert_eq!((png.width(), png.height(), png.color()), (24, 18, image::ColorType::Rgb8));
    assert!(png.to_rgb8().pixels().any(|p| p.0.iter().any(|&v| v > 40)));
}

#[test]
fn flags_win_over_the_scene() {
    let folder = Folder::with_scene();
    let render = |args: &[&str]| {
        folder.abbe(&[&["render", "scene.json", "--spp", "2", "-o", "a.exr", "-o", "a.PNG"], args].concat()).succeeds();
        let (_, channels) = read_exr(&folder.read("a.exr"));
        (channels["Y"].clone(), folder.read("a.PNG"))
    };
    let (film, picture) = render(&[]);
    assert_eq!((&film, &picture), (&render(&["--threads", "2"]).0, &render(&["--threads", "1"]).1));
    assert_ne!(film, render(&["--seed", "9"]).0);
    assert_ne!(film, render(&["--integrator", "light"]).0);
    let (same, darker) = render(&["--exposure", "-3"]);
    assert!(same == film && darker != picture);
    assert_ne!(render(&["--exposure", "1", "--tonemap", "reinhard"]).1, render(&["--exposure", "1"]).1);
}

#[test]
fn json_has_the_keys_of_the_contract() {
    let folder = Folder::with_scene();
    let run = folder.abbe(&["render", "scene.json", "--json", "--spp", "300", "-o", "a.png", "-o", "b.exr"]);
    assert!(run.succeeds().err.is_empty() && run.out().lines().count() == 1 && run.out().ends_with('\n'), "{run:?}");
    let value: Value = serde_json::from_str(run.out()).unwrap();
    let keys = [
        "seconds",
        "cpu_seconds",
        "samples_per_pixel",
        "width",
        "height",
        "camera_paths",
        "light_paths",
        "rays",
        "estimated_relative_mse",
        "non_finite_samples",
        "peak_memory_bytes",
    ];
    for key in keys {
        assert!(value[key].as_f64().is_some_and(|v| v >= 0.0), "{key}: {}", value[key]);
    }
    assert_eq!(value["outputs"], serde_json::json!(["a.png", "b.exr"]));
    for (key, expected) in [("samples_per_pixel", 300), ("width", 8), ("height", 8), ("camera_paths", 64 * 300)] {
        assert_eq!(value[key], expected, "{key}");
    }
    assert_eq!(value["non_finite_samples"], 0);
    assert!(value["rays"].as_u64() > Some(64 * 300) && value["peak_memory_bytes"].as_u64() > Some(1 << 20));
    assert!(value["seconds"].as_f64() > Some(0.0) && value["seconds"].as_f64() < Some(60.0));

    let run = folder.abbe(&["render", "scene.json", "--json", "--integrator", "path", "--spp", "1", "-o", "a.png"]);
    let value: Value = serde_json::from_str(run.succeeds().out()).unwrap();
    assert_eq!(value["light_paths"], 0);
    assert!(value["estimated_relative_mse"].is_null(), "one sample tells nothing of its error: {value}");
}

#[test]
fn quiet_is_silent_and_verbose_is_not() {
    let folder = Folder::new();
    // With something to warn of: an unused spectrum.
    folder.write("scene.json", &GOOD.replace("\"spectra\": {", "\"spectra\": { \"spare\": 0.5,"));
    let args = ["render", "scene.json", "--spp", "1", "-o", "a.exr"];
    let plain = folder.abbe(&args);
    assert!(plain.succeeds().err.starts_with("warning: scene.json: spectra.spare"), "{plain:?}");
    let quiet = folder.abbe(&[&args[..], &["-q"]].concat());
    assert!(quiet.succeeds().err.is_empty() && quiet.out.is_empty(), "{quiet:?}");
    let verbose = folder.abbe(&[&args[..], &["-v"]].concat());
    assert!(verbose.succeeds().err.contains("camera paths") && verbose.out.is_empty(), "{verbose:?}");
}

#[test]
fn scenes_come_from_stdin_and_pictures_go_to_stdout() {
    let folder = Folder::with_scene();
    folder.abbe_with_stdin(&["render", "-", "--spp", "1"], GOOD).succeeds();
    assert_eq!(folder.files(), ["picture.exr", "picture.png", "scene.json"]);
    let (_, from_stdin) = read_exr(&folder.read("picture.exr"));

    let run = folder.abbe(&["render", "scene.json", "--spp", "1", "-o", "-"]);
    let (size, channels) = read_exr(&run.succeeds().out);
    assert_eq!((size, &channels), ((8, 8), &from_stdin));
    assert!(run.err.is_empty() && folder.files().len() == 3, "{run:?}");
    folder.abbe(&["render", "scene.json", "--json", "-o", "-"]).fails(2, &["--json"]);
    folder.abbe_with_stdin(&["render", "-"], "{\"abbe\": 2}").fails(3, &["<stdin>: abbe: "]);
}

/// Waits for the end of a child, but not for ever.
fn wait(mut child: Child) -> Run {
    let start = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if start.elapsed() > Duration::from_secs(30) {
            child.kill().unwrap();
            panic!("it did not stop");
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    Run::new(child.wait_with_output().unwrap())
}

#[cfg(unix)]
#[test]
fn interrupted_renders_write_what_they_have() {
    let folder = Folder::with_scene();
    folder.write("a.exr", "older");
    let args = ["render", "scene.json", "--spp", "1000000000", "-o", "a.exr", "--json", "-v"];
    let mut command = folder.command(&args);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    // It tells that the scene is compiled, and then watches for signals and renders.
    let mut stderr = BufReader::new(child.stderr.take().unwrap());
    let mut line = String::new();
    stderr.read_line(&mut line).unwrap();
    assert!(line.starts_with("compiled"), "{line}");
    std::thread::sleep(Duration::from_millis(300));
    assert_eq!(folder.read("a.exr"), b"older");
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(sent.success());
    let run = wait(child);
    assert_eq!(run.code, Some(75), "{run:?}");
    let value: Value = serde_json::from_str(run.out()).unwrap();
    let samples = value["samples_per_pixel"].as_u64().unwrap();
    assert!(samples > 0 && samples < 1_000_000_000 && value["camera_paths"] == samples * 64, "{value}");
    let (size, channels) = read_exr(&folder.read("a.exr"));
    assert!(size == (8, 8) && channels["Y"].iter().all(|&y| y > 0.0));
    assert_eq!(folder.files(), ["a.exr", "scene.json"]);
}

#[test]
fn glass_prints_a_table_or_json() {
    let folder = Folder::new();
    let run = folder.abbe(&["glass"]);
    let lines: Vec<&str> = run.succeeds().out().lines().collect();
    assert!(lines.len() > 50 && lines[0].starts_with("name") && lines.iter().any(|l| l.starts_with("N-BK7 ")));
    let run = folder.abbe(&["glass", "--json"]);
    let table: Value = serde_json::from_str(run.succeeds().out()).unwrap();
    assert_eq!(table.as_array().unwrap().len(), lines.len() - 1);
    let run = folder.abbe(&["glass", "N-BK7", "--at", "587.5618", "--json"]);
    let glass: Value = serde_json::from_str(run.succeeds().out()).unwrap();
    assert!((glass["indices"][0]["n"].as_f64().unwrap() - 1.5168).abs() < 1e-5, "{glass}");
    folder.abbe(&["glass", "N-SF12"]).fails(3, &["unknown glass \"N-SF12\"", "did you mean"]);
    folder.abbe(&["glass", "--at", "500"]).fails(2, &["--at"]);
    folder.abbe(&["glass", "N-BK7", "--at", "-3"]).fails(3, &["--at", "-3"]);
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let folder = Folder::with_scene();
    for args in [
        &["glass"][..],
        &["glass", "N-BK7"],
        &["scene", "schema"],
        &["scene", "check", "scene.json"],
        &["scene", "check", "--json", "scene.json"],
        &["render", "scene.json", "--spp", "1", "--json"],
        &["render", "scene.json", "--spp", "1", "-o", "-"],
        &["--help"],
    ] {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let run = Run::new(folder.command(args).stdout(writer).stderr(Stdio::piped()).output().unwrap());
        assert!(run.code == Some(0) && run.err.is_empty(), "{args:?}: {run:?}");
    }
}

#[test]
fn version_and_help_go_to_stdout() {
    let folder = Folder::new();
    let run = folder.abbe(&["--version"]);
    assert_eq!(run.succeeds().out(), format!("abbe {}\n", env!("CARGO_PKG_VERSION")));
    let run = folder.abbe(&["render", "--help"]);
    assert!(run.succeeds().out().contains("--spp") && run.err.is_empty());
}

/// A lamp that light paths cannot start from: no error tells of a picture that stays black, so none is aimed at.
#[test]
fn a_target_error_needs_lamps_that_light_paths_can_start_from() {
    let folder = Folder::new();
    let scene = r#"{ "camera": { "type": "perspective", "from": [1, 1.5, 6], "to": [0, 0, 0] }, "film": { "width": 8, "height": 6 },
        "objects": [ { "shape": { "type": "cylinder", "radius": 0.3, "height": 0.8 }, "emission": 5,
                       "transform": [ { "scale": [1, 1, 2] } ] } ] }"#;
    folder.write("lamp.json", scene);
    let aimed = ["render", "lamp.json", "-o", "a.exr", "--target-error", "0.1", "--integrator", "light"];
    folder.abbe(&aimed).fails(2, &["--target-error: light paths do not start from"]);
}

#[test]
fn names_and_outputs_that_lead_nowhere_are_errors_of_usage() {
    let folder = Folder::with_scene();
    folder.abbe(&["render", "scene.json", "-o", "a.exr", "--observer", "x"]).fails(2, &["--observer", "1931-2"]);
    folder.abbe(&["scene", "export", "--format", "pbrt", "-o", "-", "scene.json"]).fails(2, &["-o -"]);
}
