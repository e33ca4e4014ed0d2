//! One run: a picture, and what it cost.

use super::variant::{Kind, Variant};
use super::{Session, work::Work};
use crate::cli::process;
use crate::io::exr::{self, Preference};
use crate::render::{Phase, Progress, Rendering, render};
use crate::scene::RenderSettings;
use crate::{Error, ErrorKind, Image, Result};
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// What one run cost and how good it was.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Run {
    /// Seed.
    pub seed: u64,
    /// Wall time.
    pub wall_seconds: f64,
    /// Processor time of all threads.
    pub cpu_seconds: f64,
    /// Rays, where the program tells.
    pub rays: Option<u64>,
    /// What kinds of rays these were.
    pub kinds: Option<Kinds>,
    /// Largest resident memory while it ran, where the system tells.
    pub peak_memory_bytes: Option<u64>,
    /// Samples of each pixel, where abbe tells.
    pub samples_per_pixel: u64,
    /// What abbe claims that the relMSE is below.
    pub claimed_relmse: Option<f64>,
    /// relMSE against the reference as it is.
    pub raw_relmse: f64,
    /// relMSE without the worst 0.1 % of the pixels.
    pub trimmed_relmse: f64,
    /// Pixels that are not finite.
    pub non_finite_pixels: usize,
}

/// The rays of a run by kind.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Kinds {
    /// Rays of each kind of work, shadow rays included, in the order of [`Phase::ALL`].
    pub phases: [u64; Phase::ALL.len()],
    /// Shadow rays among all of them.
    pub shadow: u64,
    /// Mean share of lanes that go along with a segment of a path.
    pub lane_occupancy: f64,
    /// Seconds that finding what a ray meets takes, as far as single rays were timed.
    pub seconds_per_ray: f64,
}

impl Kinds {
    fn new(rendering: &Rendering) -> Self {
        let (counters, profile) = (&rendering.statistics.counters, &rendering.profile);
        Self {
            phases: profile.rays,
            shadow: counters.shadow_rays,
            lane_occupancy: counters.lane_occupancy(),
            seconds_per_ray: profile.intersections.seconds_per_ray(),
        }
    }
}

/// The processor time of this process and of those it has waited for.
pub struct Clock {
    known: bool,
    started: Instant,
}

impl Clock {
    /// Starts a clock.
    pub fn new() -> Self {
        Self { known: process::cpu_seconds().is_some(), started: Instant::now() }
    }

    /// Whether the system tells the processor time; otherwise wall time stands in for it.
    pub fn is_known(&self) -> bool {
        self.known
    }

    fn own(&self) -> f64 {
        process::cpu_seconds().unwrap_or_else(|| self.started.elapsed().as_secs_f64())
    }

    fn children(&self) -> f64 {
        process::children_cpu_seconds().unwrap_or_else(|| self.started.elapsed().as_secs_f64())
    }
}

/// Renders once.
pub fn measure(session: &Session, work: &Work, variant: &Variant, spp: u64, seed: u64) -> Result<(Image, Run)> {
    match &variant.kind {
        Kind::Abbe { .. } => Ok(abbe(session, work, &variant.kind.settings(work, spp, seed))),
        Kind::Command { template, .. } => command(session, work, &variant.name, template, (spp, seed)),
    }
}

/// Renders once with abbe.
pub fn abbe(session: &Session, work: &Work, settings: &RenderSettings) -> (Image, Run) {
    process::reset_peak_memory();
    let (started, cpu) = (Instant::now(), session.clock.own());
    let compiled = &work.compiled;
    let (picture, rendering) = session.pool.install(|| {
        let rendering = render(&compiled.scene, settings, &compiled.film, &mut |_: Progress| true);
        (rendering.film.to_image(), rendering)
    });
    let statistics = &rendering.statistics;
    let run = Run {
        seed: settings.seed,
        wall_seconds: started.elapsed().as_secs_f64(),
        cpu_seconds: session.clock.own() - cpu,
        rays: Some(statistics.counters.rays),
        kinds: Some(Kinds::new(&rendering)),
        samples_per_pixel: statistics.samples,
        claimed_relmse: statistics.error_bound,
        peak_memory_bytes: process::peak_memory_bytes(),
        ..Run::default()
    };
    (picture, run)
}

fn command(
    session: &Session,
    work: &Work,
    name: &str,
    template: &str,
    (spp, seed): (u64, u64),
) -> Result<(Image, Run)> {
    let out = session.args.output.join("against.exr");
    // A picture of an earlier run must not pass for this one's; there may be none.
    let _ = std::fs::remove_file(&out);
    let [width, height] = work.size();
    let values = [
        ("{spp}", spp.to_string()),
        ("{seed}", seed.to_string()),
        ("{width}", width.to_string()),
        ("{height}", height.to_string()),
        ("{threads}", session.pool.current_num_threads().to_string()),
        ("{out}", quoted(&out)),
    ];
    let line = values.iter().fold(template.to_owned(), |line, (key, value)| line.replace(key, value));
    let (started, cpu) = (Instant::now(), session.clock.children());
    let peak_memory_bytes = run_shell(&line).map_err(|e| Error { message: format!("{name}: {}", e.message), ..e })?;
    let run = Run {
        seed,
        wall_seconds: started.elapsed().as_secs_f64(),
        cpu_seconds: session.clock.children() - cpu,
        peak_memory_bytes,
        ..Run::default()
    };
    let picture = exr::read_file(&out, Preference::Xyz, None)?.xyz;
    let found = picture.size();
    if found != [width, height] {
        let message = format!("{name} wrote {}x{} pixels; expected {width}x{height}", found[0], found[1]);
        return Err(Error::new(ErrorKind::OutOfRange, message).in_file(&out));
    }
    // It is read; that it stays where it cannot be removed harms nobody.
    let _ = std::fs::remove_file(&out);
    Ok((picture, run))
}

fn quoted(path: &Path) -> String {
    format!("'{}'", path.display().to_string().replace('\'', "'\\''"))
}

/// Runs a line in the shell, and tells the largest memory of its processes.
fn run_shell(line: &str) -> Result<Option<u64>> {
    let failed = |what: String| Error::new(ErrorKind::Io, what);
    let child = Command::new("sh")
        .args(["-c", line])
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|e| failed(format!("cannot run sh: {e}")))?;
    let (id, over) = (child.id(), AtomicBool::new(false));
    let (output, peak) = std::thread::scope(|scope| {
        let watcher = scope.spawn(|| {
            let mut peak = None;
            while !over.load(Ordering::Relaxed) {
                peak = peak.max(process::peak_memory_bytes_of_tree(id));
                std::thread::sleep(Duration::from_millis(20));
            }
            peak
        });
        let output = child.wait_with_output();
        over.store(true, Ordering::Relaxed);
        (output, watcher.join().unwrap_or(None))
    });
    let output = output.map_err(|e| failed(format!("waiting failed: {e}")))?;
    if !output.status.success() {
        let text = String::from_utf8_lossy(&output.stderr);
        let lines: Vec<&str> = text.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
        let last = lines[lines.len().saturating_sub(3)..].join(" | ");
        return Err(failed(format!("the command failed ({}): {last}", output.status)));
    }
    Ok(peak)
}
