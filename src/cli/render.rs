//! `abbe render`: a scene in, pictures out.

use super::{process, write_data};
use crate::develop::{self, Tonemap};
use crate::film::Film;
use crate::io::exr::Attributes;
use crate::io::output::write_atomically;
use crate::io::{exr, png};
use crate::render::{Progress, Statistics, render};
use crate::scene::description::{self, Integrator, SceneDescription};
use crate::scene::{Compiled, SceneFeatures, compile};
use crate::{Error, ErrorKind, Result};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde_json::json;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Arguments of `abbe render`.
#[derive(Debug, Clone, clap::Args)]
pub struct RenderArgs {
    /// Scene file; - is stdin
    pub scene: PathBuf,
    /// Picture to write, .exr or .png, or - for EXR on stdout; may be repeated. Default: the scene's name with .exr and
    /// .png, here
    #[arg(short, long = "output", value_name = "FILE")]
    pub output: Vec<PathBuf>,
    /// Samples per pixel
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1 << 40))]
    pub spp: Option<u64>,
    /// Seed of the random sequences
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    /// Threads; all processors by default
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=4096))]
    pub threads: Option<u16>,
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH")]
    pub resolution: Option<String>,
    /// auto, path or light
    #[arg(long, value_name = "NAME")]
    pub integrator: Option<String>,
    /// Exposure of PNGs in stops, or auto
    #[arg(long, value_name = "EV", allow_negative_numbers = true)]
    pub exposure: Option<String>,
    /// Tone mapping of PNGs: srgb, exponential or reinhard
    #[arg(long, value_name = "OP")]
    pub tonemap: Option<String>,
    /// Spectral bands in the EXR (not yet)
    #[arg(long, value_name = "N", hide = true)]
    pub bands: Option<String>,
    /// Render for a given time (not yet)
    #[arg(long, value_name = "SECONDS", hide = true)]
    pub time: Option<String>,
    /// Render to a given error (not yet)
    #[arg(long, value_name = "E", hide = true)]
    pub target_error: Option<String>,
    /// No progress, no warnings
    #[arg(short, long)]
    pub quiet: bool,
    /// Tell what is done and how it went
    #[arg(short, long)]
    pub verbose: bool,
    /// End with one JSON object on stdout
    #[arg(long)]
    pub json: bool,
}

/// Renders. Interrupted with Ctrl-C it writes what it has and returns exit code 75.
///
/// # Errors
/// `Usage` for flags that make no sense, those of scene files, `Io` if a picture cannot be written.
pub fn run(args: &RenderArgs) -> Result<ExitCode> {
    refuse_what_is_not_there(args)?;
    let started = Instant::now();
    let outputs = outputs(args)?;
    let (mut description, mut warnings) = read(&args.scene)?;
    override_settings(&mut description, args)?;
    check_memory(&description)?;
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(args.threads.map_or(0, usize::from))
        .build()
        .map_err(|e| Error::new(ErrorKind::Io, format!("cannot start threads: {e}")))?;
    let compiled = pool.install(|| compile(&description))?;
    warnings.extend_from_slice(&compiled.warnings);
    if !args.quiet {
        warnings.iter().for_each(|warning| eprintln!("warning: {warning}"));
    }
    if args.verbose {
        describe(&compiled, started.elapsed());
    }

    let interrupted = watch_for_interrupts()?;
    let bar = progress_bar(args.quiet, compiled.render.samples_per_pixel);
    let rendering = Instant::now();
    let (film, statistics) = pool.install(|| {
        let none = SceneFeatures { dispersion: false, interiors: false };
        render(&compiled.scene, &compiled.render, &compiled.film, none, &mut |progress: Progress| {
            show(&bar, &progress, rendering.elapsed());
            !interrupted.load(Ordering::Relaxed)
        })
    });
    bar.finish_and_clear();

    let seconds = started.elapsed().as_secs_f64();
    write_outputs(&outputs, &film, &description, &compiled, &statistics, seconds, args.verbose)?;
    report(args, &outputs, &film, &statistics, seconds)?;
    Ok(if statistics.complete { ExitCode::SUCCESS } else { ExitCode::from(super::INTERRUPTED) })
}

fn usage(message: impl Into<String>) -> Error {
    Error::new(ErrorKind::Usage, message)
}

fn refuse_what_is_not_there(args: &RenderArgs) -> Result<()> {
    let later = [("--bands", &args.bands), ("--time", &args.time), ("--target-error", &args.target_error)];
    match later.into_iter().find(|(_, value)| value.is_some()) {
        Some((flag, _)) => Err(usage(format!("`{flag}` is not there yet"))),
        None => Ok(()),
    }
}

/// The files to write; checked before any work is done.
fn outputs(args: &RenderArgs) -> Result<Vec<PathBuf>> {
    if args.output.is_empty() {
        let stem = match args.scene.as_os_str() == "-" {
            true => Path::new("picture").as_os_str(),
            false => args
                .scene
                .file_stem()
                .ok_or_else(|| usage("the scene's name gives no name for the pictures; use -o"))?,
        };
        return Ok(["exr", "png"].map(|extension| Path::new(stem).with_extension(extension)).to_vec());
    }
    if args.json && args.output.iter().any(|path| is_stdout(path)) {
        return Err(usage("-o - and --json both write to stdout; expected one of them"));
    }
    for path in args.output.iter().filter(|path| !is_stdout(path)) {
        if extension(path).is_none() {
            let message = format!("-o {}: expected a name that ends in .exr or .png, or -", path.display());
            return Err(usage(message));
        }
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        if !folder.is_dir() {
            let message = format!("the folder {} does not exist", folder.display());
            return Err(Error::new(ErrorKind::Io, message).in_file(path));
        }
    }
    Ok(args.output.clone())
}

/// Kinds of pictures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    Exr,
    Png,
}

fn is_stdout(path: &Path) -> bool {
    path.as_os_str() == "-"
}

fn extension(path: &Path) -> Option<Format> {
    if is_stdout(path) {
        return Some(Format::Exr);
    }
    match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
        "exr" => Some(Format::Exr),
        "png" => Some(Format::Png),
        _ => None,
    }
}

fn read(path: &Path) -> Result<(SceneDescription, Vec<String>)> {
    let parsed = match path.as_os_str() == "-" {
        true => description::parse_reader(std::io::stdin().lock(), Path::new("<stdin>"))?,
        false => description::parse_file(path)?,
    };
    Ok((parsed.description, parsed.warnings))
}

/// What the command line says wins over the scene.
fn override_settings(description: &mut SceneDescription, args: &RenderArgs) -> Result<()> {
    let render = &mut description.render;
    render.samples_per_pixel = args.spp.unwrap_or(render.samples_per_pixel);
    render.seed = args.seed.unwrap_or(render.seed);
    if let Some(name) = &args.integrator {
        render.integrator = named("--integrator", name, &INTEGRATORS)?;
    }
    if let Some(name) = &args.tonemap {
        description.develop.tonemap = named("--tonemap", name, &TONEMAPS)?;
    }
    if let Some(text) = &args.exposure {
        description.develop.exposure_ev = match text.as_str() {
            "auto" => None,
            _ => {
                let stops: Option<f64> = text.parse().ok().filter(|ev: &f64| ev.abs() <= 200.0);
                Some(stops.ok_or_else(|| usage(format!("--exposure {text}: expected stops in [-200, 200], or auto")))?)
            }
        };
    }
    if let Some(text) = &args.resolution {
        let sizes =
            text.split_once(['x', 'X']).and_then(|(w, h)| Some((w.parse::<u32>().ok()?, h.parse::<u32>().ok()?)));
        let legal = |n: u32| (1..=1 << 20).contains(&n);
        let (width, height) = sizes
            .filter(|(w, h)| legal(*w) && legal(*h) && u64::from(*w) * u64::from(*h) <= 1 << 32)
            .ok_or_else(|| usage(format!("--resolution {text}: expected WIDTHxHEIGHT in pixels, such as 640x480")))?;
        (description.film.width, description.film.height) = (width, height);
    }
    Ok(())
}

/// Refuses a film that does not fit into memory before any work is done.
fn check_memory(description: &SceneDescription) -> Result<()> {
    let (width, height) = (description.film.width, description.film.height);
    let needed = u64::from(width) * u64::from(height) * Film::BYTES_PER_PIXEL as u64;
    match process::available_memory_bytes() {
        Some(available) if needed > available => {
            let gigabytes = |bytes: u64| bytes as f64 / f64::from(1 << 30);
            let message = format!(
                "a picture of {width}x{height} pixels needs {:.1} GiB, and {:.1} GiB are free; expected a smaller one",
                gigabytes(needed),
                gigabytes(available)
            );
            Err(Error::new(ErrorKind::LimitExceeded, message).at("film").in_file(&description.file))
        }
        _ => Ok(()),
    }
}

const INTEGRATORS: [(&str, Integrator); 5] = [
    ("auto", Integrator::Auto),
    ("path", Integrator::Path),
    ("light", Integrator::Light),
    ("merge", Integrator::Merge),
    ("hero", Integrator::Hero),
];

const TONEMAPS: [(&str, description::Tonemap); 3] = [
    ("srgb", description::Tonemap::Srgb),
    ("exponential", description::Tonemap::Exponential),
    ("reinhard", description::Tonemap::Reinhard),
];

fn named<T: Copy>(flag: &str, name: &str, known: &[(&str, T)]) -> Result<T> {
    let names = known.iter().map(|(n, _)| *n);
    known.iter().find(|(n, _)| *n == name).map(|(_, value)| *value).ok_or_else(|| {
        let list = names.clone().collect::<Vec<_>>().join(", ");
        usage(format!("{flag} {name}: expected one of {list}")).nearest(name, names)
    })
}

fn describe(compiled: &Compiled, elapsed: Duration) {
    let scene = &compiled.scene;
    let yes = |b: bool| if b { "yes" } else { "no" };
    eprintln!(
        "compiled in {:.2} s: {} objects, {} lights; dispersion: {}, interiors: {}; integrator: {:?}",
        elapsed.as_secs_f64(),
        scene.objects.len(),
        scene.lights.len(),
        yes(scene.features.dispersion),
        yes(scene.features.interiors),
        compiled.render.integrator,
    );
}

/// A flag that Ctrl-C raises; a second Ctrl-C ends the process at once.
fn watch_for_interrupts() -> Result<&'static AtomicBool> {
    static INTERRUPTED: AtomicBool = AtomicBool::new(false);
    ctrlc::set_handler(|| {
        if INTERRUPTED.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    })
    .map_err(|e| Error::new(ErrorKind::Io, format!("cannot watch for Ctrl-C: {e}")))?;
    Ok(&INTERRUPTED)
}

fn progress_bar(quiet: bool, samples: u64) -> ProgressBar {
    if quiet || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::with_draw_target(Some(samples), ProgressDrawTarget::stderr());
    let template = "{bar:32} {pos}/{len} samples per pixel, {msg}, {eta} left";
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar
}

fn show(bar: &ProgressBar, progress: &Progress, elapsed: Duration) {
    bar.set_position(progress.samples);
    bar.set_message(format!("{:.1} Mrays/s", progress.rays as f64 / elapsed.as_secs_f64() / 1e6));
}

fn write_outputs(
    outputs: &[PathBuf],
    film: &Film,
    description: &SceneDescription,
    compiled: &Compiled,
    statistics: &Statistics,
    seconds: f64,
    verbose: bool,
) -> Result<()> {
    let xyz = film.to_xyz();
    for path in outputs {
        let bytes = match extension(path) {
            Some(Format::Exr) => {
                let attributes = Attributes {
                    scene_hash: scene_hash(&description.file),
                    seed: compiled.render.seed,
                    samples_per_pixel: statistics.camera_paths / (u64::from(film.width()) * u64::from(film.height())),
                    seconds,
                };
                let (bytes, overflows) = exr::encode(&xyz, film.width(), &attributes)?;
                if overflows > 0 {
                    eprintln!("warning: {}: {overflows} values were too large for 32 bits", path.display());
                }
                bytes
            }
            Some(Format::Png) | None => {
                let tonemap = match description.develop.tonemap {
                    description::Tonemap::Srgb => Tonemap::Srgb,
                    description::Tonemap::Exponential => Tonemap::Exponential,
                    description::Tonemap::Reinhard => Tonemap::Reinhard,
                };
                let picture = develop::develop(&xyz, film.width(), description.develop.exposure_ev, tonemap);
                if verbose {
                    let outside = picture.out_of_gamut * 100.0;
                    eprintln!(
                        "developed at {:+.2} EV; {outside:.2} % of the pixels were outside sRGB",
                        picture.exposure_ev
                    );
                }
                png::encode(&picture)?
            }
        };
        match is_stdout(path) {
            true => write_data(&mut std::io::stdout().lock(), &bytes)?,
            false => write_atomically(path, &bytes)?,
        }
    }
    Ok(())
}

/// Hash of the scene file's bytes; 0 for a scene that is no file.
fn scene_hash(path: &Path) -> u64 {
    let bytes = std::fs::read(path).unwrap_or_default();
    bytes.chunks(8).fold(0, |hash, chunk| {
        let mut word = [0; 8];
        word[..chunk.len()].copy_from_slice(chunk);
        crate::sampling::mix(hash ^ u64::from_le_bytes(word))
    })
}

fn report(args: &RenderArgs, outputs: &[PathBuf], film: &Film, statistics: &Statistics, seconds: f64) -> Result<()> {
    let error = film.estimated_relative_mse();
    let pixels = u64::from(film.width()) * u64::from(film.height());
    let camera = statistics.camera_paths;
    if film.non_finite_samples > 0 {
        eprintln!("warning: {} samples were not finite and have been left out", film.non_finite_samples);
    }
    let decisions = &statistics.decisions;
    if args.verbose {
        eprintln!("{decisions}");
        let cpu = process::cpu_seconds().unwrap_or(f64::NAN);
        let paths = (camera + statistics.light_paths + statistics.photon_paths) as f64;
        eprintln!(
            "{camera} camera paths, {} light paths, {} of them for merging, {:.2} rays a path, {:.3} µs of CPU a path, {} rays left glass they had \
             not entered; estimated relMSE {}",
            statistics.light_paths + statistics.photon_paths,
            statistics.photon_paths,
            statistics.counters.rays as f64 / paths,
            cpu / paths * 1e6,
            statistics.counters.medium_underflows,
            error.map_or("unknown".to_owned(), |e| format!("{e:.2e}")),
        );
    }
    if args.json {
        let value = json!({
            "seconds": seconds,
            "cpu_seconds": process::cpu_seconds(),
            "samples_per_pixel": camera.max(if camera == 0 { statistics.light_paths } else { 0 }) / pixels,
            "width": film.width(),
            "height": film.height(),
            "camera_paths": camera,
            "light_paths": statistics.light_paths,
            "photon_paths": statistics.photon_paths,
            "plan": {
                "camera_ways": decisions.camera_ways,
                "light_ways": decisions.light_ways,
                "light_paths_per_camera_path": decisions.light_paths_per_camera_path,
                "merge_passes_per_sample": decisions.merge_passes_per_sample,
                "photon_paths_per_pass": decisions.photon_paths_per_pass,
                "pilot_rays": decisions.pilot_rays,
            },
            "rays": statistics.counters.rays,
            "medium_underflows": statistics.counters.medium_underflows,
            "estimated_relative_mse": error,
            "non_finite_samples": film.non_finite_samples,
            "peak_memory_bytes": process::peak_memory_bytes(),
            "outputs": outputs,
        });
        write_data(&mut std::io::stdout().lock(), format!("{value}\n").as_bytes())?;
    } else if !args.quiet && std::io::stderr().is_terminal() {
        let names: Vec<String> = outputs.iter().map(|p| p.display().to_string()).collect();
        eprintln!("{} in {seconds:.1} s", names.join(", "));
    }
    Ok(())
}
