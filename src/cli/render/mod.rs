//! `abbe render`: a scene in, pictures out.

mod progress;
mod report;
mod write;

use super::names::{INTEGRATORS, TONEMAPS, listed, named};
use super::values::{exposure, resolution};
use super::{process, usage};
use crate::color::Observer;
use crate::film::{Film, PICTURE_CHANNELS};
use crate::render::{Progress, blind_spot, render};
use crate::scene::description::{self, SceneDescription};
use crate::scene::{Compiled, compile};
use crate::{DevelopSettings, Error, ErrorKind, Result};
use progress::ProgressDisplay;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use write::Written;

/// Arguments of `abbe render`.
#[derive(Debug, Clone, clap::Args)]
pub struct RenderArgs {
    /// Scene file; - is stdin
    pub scene: PathBuf,
    /// Picture to write, .exr or .png, or - for EXR on stdout; may be repeated. Default: the scene's name with .exr and
    /// .png, here
    #[arg(short, long = "output", value_name = "FILE")]
    pub output: Vec<PathBuf>,
    /// Samples per pixel; with --time or --target-error the most of them
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
    #[arg(long, value_name = "NAME", help = format!("Integrator: {}", listed(INTEGRATORS)))]
    pub integrator: Option<String>,
    /// Observer whose XYZ is recorded: 1931-2, 1964-10, 2015-2 or 2015-10
    #[arg(long, value_name = "NAME")]
    pub observer: Option<String>,
    /// Exposure of PNGs in stops, or auto
    #[arg(long, value_name = "EV", allow_negative_numbers = true)]
    pub exposure: Option<String>,
    #[arg(long, value_name = "OP", help = format!("Tone mapping of PNGs: {}", listed(TONEMAPS)))]
    pub tonemap: Option<String>,
    /// Stop after this time, reading the scene included
    #[arg(long, value_name = "SECONDS")]
    pub time: Option<f64>,
    /// Stop when the relMSE is below E, with a confidence of 95 %
    #[arg(long, value_name = "E")]
    pub target_error: Option<f64>,
    /// Whether pixels that have converged get fewer samples and the others more; by default with --time and --target-error
    #[arg(long, value_name = "on|off")]
    pub adaptive: Option<Switch>,
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

/// On or off.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Switch {
    /// On
    On,
    /// Off
    Off,
}

/// Most samples a pixel where something else stops the render.
const ENDLESS: u64 = 1 << 40;

/// Renders. Interrupted with Ctrl-C it writes what it has and returns exit code 75.
///
/// # Errors
/// `Usage` for flags that make no sense, those of scene files, `Io` if a picture cannot be written.
pub fn run(args: &RenderArgs) -> Result<ExitCode> {
    let started = Instant::now();
    check(args)?;
    let outputs = outputs(args)?;
    let (mut description, mut warnings) = read(&args.scene)?;
    override_settings(&mut description, args)?;
    let develop = develop_settings(&description, args)?;
    let integrator = args.integrator.as_ref().map(|name| named("--integrator", name, INTEGRATORS)).transpose()?;
    check_memory(&description)?;
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(args.threads.map_or(0, usize::from))
        .build()
        .map_err(|e| Error::new(ErrorKind::Io, format!("cannot start threads: {e}")))?;
    let mut compiled = pool.install(|| compile(&description))?;
    compiled.render.integrator = integrator.unwrap_or(compiled.render.integrator);
    stop_as_asked(&mut compiled, args, started)?;
    warnings.extend_from_slice(&compiled.warnings);
    if !args.quiet {
        warnings.iter().for_each(|warning| eprintln!("warning: {warning}"));
    }
    let compiling = started.elapsed();
    if args.verbose {
        report::describe(&compiled, compiling);
    }

    let interrupted = watch_for_interrupts()?;
    let bar = ProgressDisplay::new(args.quiet, &compiled.render, started);
    let rendering = pool.install(|| {
        render(&compiled.scene, &compiled.render, &compiled.film, &mut |progress: Progress| {
            bar.show(&progress);
            !interrupted.load(Ordering::Relaxed)
        })
    });
    bar.finish();

    let written = Written { args, outputs: &outputs, file: &description.file, develop, compiled: &compiled, compiling };
    let (seconds, writing) = (started.elapsed().as_secs_f64(), Instant::now());
    written.write(&rendering, seconds)?;
    report::report(&written, &rendering, seconds, writing.elapsed())?;
    Ok(if rendering.statistics.complete { ExitCode::SUCCESS } else { ExitCode::from(super::INTERRUPTED) })
}

/// Refuses what makes no sense before any work is done.
fn check(args: &RenderArgs) -> Result<()> {
    if let Some(seconds) = args.time.filter(|seconds| !(0.0..=1e9).contains(seconds)) {
        return Err(usage(format!("--time {seconds}: expected seconds, from 0 to a billion")));
    }
    match args.target_error.filter(|error| !(*error > 0.0 && error.is_finite())) {
        Some(error) => Err(usage(format!("--target-error {error}: expected a relMSE above 0, such as 0.001"))),
        None => Ok(()),
    }
}

/// Sets what stops the render.
fn stop_as_asked(compiled: &mut Compiled, args: &RenderArgs, started: Instant) -> Result<()> {
    let until = args.time.is_some() || args.target_error.is_some();
    let settings = &mut compiled.render;
    settings.target_error = args.target_error;
    settings.deadline = args.time.map(|seconds| started + Duration::from_secs_f64(seconds));
    settings.adaptive = args.adaptive.map_or(until, |switch| switch == Switch::On);
    if until {
        settings.samples_per_pixel = args.spp.unwrap_or(ENDLESS);
    }
    match blind_spot(&compiled.scene, settings.integrator).filter(|_| args.target_error.is_some()) {
        Some(what) => {
            Err(usage(format!("--target-error: {what}, and no error tells of it; expected --integrator auto")))
        }
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

/// Sets what the command line says of sampling and of the size instead of the scene.
fn override_settings(description: &mut SceneDescription, args: &RenderArgs) -> Result<()> {
    let render = &mut description.render;
    render.samples_per_pixel = args.spp.unwrap_or(render.samples_per_pixel);
    render.seed = args.seed.unwrap_or(render.seed);
    if let Some(name) = &args.observer {
        description.film.observer = Observer::by_name(name)
            .map_err(|e| Error { kind: ErrorKind::Usage, ..e.at("--observer") })?
            .name()
            .to_owned();
    }
    if let Some(text) = &args.resolution {
        (description.film.width, description.film.height) = resolution(text)?;
    }
    Ok(())
}

/// How the scene, or else the command line, develops pictures.
fn develop_settings(description: &SceneDescription, args: &RenderArgs) -> Result<DevelopSettings> {
    let mut settings = description.develop;
    if let Some(name) = &args.tonemap {
        settings.tonemap = named("--tonemap", name, TONEMAPS)?;
    }
    if let Some(text) = &args.exposure {
        settings.exposure_ev = exposure(text)?;
    }
    Ok(settings)
}

/// Refuses a film that does not fit into memory before any work is done.
fn check_memory(description: &SceneDescription) -> Result<()> {
    let (width, height) = (description.film.width, description.film.height);
    let needed = u64::from(width) * u64::from(height) * Film::bytes_per_pixel(PICTURE_CHANNELS) as u64;
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
