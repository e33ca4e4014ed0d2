//! The picture that all others are measured against: made by the technique least like those on test, with its own error
//! known, and kept for the next time.

use super::Session;
use super::measure::{self, Run};
use super::sums::Sums;
use super::variant::Kind;
use super::work::{Work, hash_bytes};
use crate::cli::names::{INTEGRATORS, integrator_name, named};
use crate::cli::usage;
use crate::io::exr::{self, Preference};
use crate::io::output::write_atomically;
use crate::metrics::{self, Pair};
use crate::render::blind_spot;
use crate::scene::{Integrator, RenderSettings};
use crate::{Error, ErrorKind, Image, Result};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Independent runs that a reference is the mean of, from whose spread its own error follows.
const RUNS: u64 = 8;
/// Most samples per pixel of the runs from which the reference's cost is foreseen: renders of 32 and more plan their work.
const PILOT_SPP: u64 = 64;
/// The pilot's samples double until a run takes this share of the time limit, so that all its runs together take at most
/// four times as much.
const PILOT_SHARE: f64 = 0.025;
/// The reference is made so accurate that its own relMSE is this share of the lowest target.
const SHARE_OF_TARGET: f64 = 0.05;
/// Seeds of references; those on test are below.
const FIRST_SEED: u64 = 1 << 40;

/// A reference.
#[derive(Debug, Clone)]
pub struct Reference {
    /// The picture.
    pub mean: Image,
    /// Variance of each of its values; `None` for a file, of whose error nothing is known.
    pub variance: Option<Image>,
    /// Origin of the picture.
    pub origin: Origin,
    /// relMSE of the reference itself, over the mask.
    own_relmse: f64,
}

/// Origin of a reference.
#[derive(Debug, Clone, PartialEq)]
pub enum Origin {
    /// A file that the user names.
    File(PathBuf),
    /// Rendered by the benchmark.
    Rendered {
        /// The technique.
        integrator: Integrator,
        /// Reason for the choice of the technique.
        why: &'static str,
        /// Samples per pixel of each run.
        spp: u64,
        /// Whether it is from an earlier benchmark.
        cached: bool,
        /// Processor time that it took.
        cpu_seconds: f64,
    },
}

impl Reference {
    /// relMSE of the reference itself; 0 for a file.
    pub fn own_relmse(&self) -> f64 {
        self.own_relmse
    }

    /// One line for people.
    pub fn told(&self) -> String {
        match &self.origin {
            Origin::File(path) => format!("reference {}, its own error unknown", path.display()),
            Origin::Rendered { integrator, why, spp, cached, cpu_seconds } => format!(
                "reference: {}, {RUNS} x {spp} samples per pixel, {cpu_seconds:.1} CPU s{}, its own relMSE {:.2e} ({why})",
                integrator_name(*integrator),
                if *cached { " (kept from an earlier run)" } else { "" },
                self.own_relmse
            ),
        }
    }

    /// Describes the reference as JSON.
    pub fn to_json(&self) -> Value {
        match &self.origin {
            Origin::File(path) => json!({ "file": path, "relmse": Value::Null }),
            Origin::Rendered { integrator, why, spp, cached, cpu_seconds } => json!({
                "integrator": integrator_name(*integrator), "why": why, "runs": RUNS, "samples_per_pixel": spp,
                "cached": cached, "cpu_seconds": cpu_seconds, "relmse": self.own_relmse,
            }),
        }
    }

    /// Estimates the error that more samples would not remove, as a relMSE: that of the mean of some runs, less what their
    /// spread and the reference's own error explain. About 0, of either sign, for a technique that is right.
    pub fn systematic_error(&self, runs: &Sums, mask: Option<&[bool]>) -> Result<f64> {
        let (n, mean) = (f64::from(runs.runs), runs.mean());
        let variance = mean.zip_with(&runs.squares, |m, s| ((s / n - m * m) / (n - 1.0)).max(0.0));
        let pair = Pair::new(&mean, &self.mean, mask)?;
        let of_spread = relative_to(&self.mean, &variance, mask)?;
        Ok(metrics::relative_mse(&pair) - of_spread - self.own_relmse)
    }
}

/// The mean over pixels and channels of variance / (R² + 0.01 m²): the relMSE that a variance amounts to.
fn relative_to(reference: &Image, variance: &Image, mask: Option<&[bool]>) -> Result<f64> {
    let noisy = reference.zip_with(variance, |r, v| r + v.max(0.0).sqrt());
    Ok(metrics::relative_mse(&Pair::new(&noisy, reference, mask)?))
}

/// The reference of a scene: a file, one made earlier, or one made now.
pub fn get(session: &Session, work: &Work, mask: Option<&[bool]>) -> Result<Reference> {
    let (integrator, why) = match session.args.reference.as_deref() {
        Some(name) if is_file(name) => return from_file(work, Path::new(name)),
        Some(name) => (named("--reference", name, INTEGRATORS)?, "as asked for"),
        None => least_alike(session, work),
    };
    let path = path_for(session, work, integrator);
    let mut reference = match from_cache(&path, work, (integrator, why)) {
        Some(reference) => reference,
        None => {
            let made = make(session, work, (integrator, why))?;
            keep(&made, &path)?;
            made
        }
    };
    if let Some(variance) = &reference.variance {
        reference.own_relmse = relative_to(&reference.mean, variance, mask)?;
    }
    Ok(reference)
}

fn is_file(name: &str) -> bool {
    name.to_ascii_lowercase().ends_with(".exr") || Path::new(name).is_file()
}

/// Another technique than those on test, if it can see everything, and not so seldom that its own spread tells nothing: camera
/// paths hardly find the caustic of a small lamp, and what none of the runs has found is in no estimate of their error.
fn least_alike(session: &Session, work: &Work) -> (Integrator, &'static str) {
    let settings = |v: &super::Variant| match v.kind {
        Kind::Abbe { .. } => Some(v.kind.settings(work, 1, 0).integrator),
        Kind::Command { .. } => None,
    };
    let all_trace_light =
        session.variants.iter().filter_map(settings).all(|integrator| integrator == Integrator::Light);
    match (blind_spot(&work.compiled.scene, Integrator::Light).is_none(), work.has_specular()) {
        (true, _) if !all_trace_light => (Integrator::Light, "light paths see everything here"),
        (_, false) => (Integrator::Path, "camera paths see everything here; light paths do not, or are on test"),
        _ => (Integrator::Auto, "no technique but auto finds everything here: an error that auto has stays unseen"),
    }
}

/// File in which the reference of a scene and its settings is kept.
fn path_for(session: &Session, work: &Work, integrator: Integrator) -> PathBuf {
    let [width, height] = work.size();
    let asked = session.args.reference_spp.map_or("auto".to_owned(), |spp| spp.to_string());
    let quality = match session.args.reference_spp {
        Some(_) => String::new(),
        None => format!("{:e} {}", session.lowest_target(), session.args.time_limit),
    };
    let settings = format!(
        "{} {} {width} {height} {} {asked} {quality}",
        crate::VERSION,
        integrator_name(integrator),
        work.compiled.render.max_depth
    );
    let hash = hash_bytes(work.content_hash, settings.as_bytes());
    session.args.output.join("references").join(format!("{}-{hash:016x}.exr", work.name))
}

fn from_file(work: &Work, path: &Path) -> Result<Reference> {
    let mean = picture_of_size(path, work)?;
    Ok(Reference { mean, variance: None, origin: Origin::File(path.to_owned()), own_relmse: 0.0 })
}

fn picture_of_size(path: &Path, work: &Work) -> Result<Image> {
    let picture = exr::read_file(path, Preference::Xyz, None)?.xyz;
    let [[a, b], [width, height]] = [picture.size(), work.size()];
    if [a, b] != [width, height] {
        let message = format!("{a}x{b} pixels; expected {width}x{height}, as the scene has");
        return Err(Error::new(ErrorKind::OutOfRange, message).in_file(path));
    }
    Ok(picture)
}

/// Reads a reference that was kept; `None` unless all its files are there.
fn from_cache(path: &Path, work: &Work, (integrator, why): (Integrator, &'static str)) -> Option<Reference> {
    let about: Value = serde_json::from_slice(&std::fs::read(path.with_extension("json")).ok()?).ok()?;
    let mean = picture_of_size(path, work).ok()?;
    let variance = Some(picture_of_size(&path.with_extension("variance.exr"), work).ok()?);
    let (spp, cpu_seconds) = (about["samples_per_pixel"].as_u64()?, about["cpu_seconds"].as_f64()?);
    let origin = Origin::Rendered { integrator, why, spp, cached: true, cpu_seconds };
    Some(Reference { mean, variance, origin, own_relmse: 0.0 })
}

fn keep(reference: &Reference, path: &Path) -> Result<()> {
    let folder = path.parent().unwrap_or(Path::new(""));
    std::fs::create_dir_all(folder)
        .map_err(|e| Error::new(ErrorKind::Io, format!("cannot make the folder: {e}")).in_file(folder))?;
    write_atomically(path, &exr::encode_image(&reference.mean)?)?;
    if let Some(variance) = &reference.variance {
        write_atomically(&path.with_extension("variance.exr"), &exr::encode_image(variance)?)?;
    }
    write_atomically(&path.with_extension("json"), format!("{:#}\n", reference.to_json()).as_bytes())
}

/// Renders a reference: a pilot foretells how many samples make it good enough, and is not part of it.
fn make(session: &Session, work: &Work, (integrator, why): (Integrator, &'static str)) -> Result<Reference> {
    if let Some(what) = blind_spot(&work.compiled.scene, integrator) {
        session.say(&format!("warning: {}: {what}", work.name));
    }
    let settings = RenderSettings { integrator, ..work.compiled.render };
    let spp = match session.args.reference_spp {
        Some(spp) => spp,
        None => {
            let enough = PILOT_SHARE * session.args.time_limit;
            let mut pilot_spp = 1;
            let (pilot, run) = loop {
                let (pilot, run) = mean_of_runs(session, work, &settings, pilot_spp, FIRST_SEED);
                if pilot_spp >= PILOT_SPP || run.wall_seconds > enough {
                    break (pilot, run);
                }
                pilot_spp *= 2;
            };
            let variance = pilot.variance.as_ref().ok_or_else(|| usage("a reference without a variance"))?;
            let error = relative_to(&pilot.mean, variance, None)?;
            let wanted = error / (SHARE_OF_TARGET * session.lowest_target());
            let affordable = session.args.time_limit / run.wall_seconds.max(f64::MIN_POSITIVE);
            let factor = wanted.min(affordable).clamp(1.0, 65536.0);
            (pilot_spp as f64 * factor).ceil() as u64
        }
    };
    let (mut reference, run) = mean_of_runs(session, work, &settings, spp, FIRST_SEED + RUNS);
    reference.origin = Origin::Rendered { integrator, why, spp, cached: false, cpu_seconds: run.cpu_seconds };
    Ok(reference)
}

/// The mean of independent runs, the variance of that mean, and what all of them cost.
fn mean_of_runs(
    session: &Session,
    work: &Work,
    settings: &RenderSettings,
    samples_per_pixel: u64,
    first_seed: u64,
) -> (Reference, Run) {
    let n = RUNS as f64;
    let mut sums = Sums::new(work.size());
    let mut cost = Run::default();
    for seed in first_seed..first_seed + RUNS {
        let (picture, run) = measure::abbe(session, work, &RenderSettings { samples_per_pixel, seed, ..*settings });
        sums.add(&picture);
        cost.wall_seconds += run.wall_seconds;
        cost.cpu_seconds += run.cpu_seconds;
    }
    let variance =
        sums.values.zip_with(&sums.squares, |sum, square| ((square - sum * sum / n) / (n * (n - 1.0))).max(0.0));
    let origin = Origin::File(PathBuf::new());
    (Reference { mean: sums.mean(), variance: Some(variance), origin, own_relmse: 0.0 }, cost)
}
