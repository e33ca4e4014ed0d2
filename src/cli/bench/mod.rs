//! `abbe bench`: run time against error, of abbe's integrators and of any other renderer on the same work.

mod calibrate;
mod html;
mod judge;
mod measure;
mod output;
mod plot;
mod reference;
mod summary;
mod sums;
mod table;
mod variant;
mod work;

use crate::cli::compare::read_mask;
use crate::cli::{usage, write_data};
use crate::{Error, ErrorKind, Image, Result};
use measure::{Clock, Run};
use std::path::PathBuf;
use std::process::ExitCode;
use summary::{Level, Summary};
use sums::Sums;
use variant::Variant;
use work::Work;

/// Arguments of `abbe bench`.
#[derive(Debug, Clone, clap::Args)]
pub struct BenchArgs {
    /// Scene files
    #[arg(required = true, value_name = "SCENE")]
    pub scenes: Vec<PathBuf>,
    /// Compare values of a setting, such as integrator=hero,auto, max-depth=8,16 or adaptive=on,off; repeated: all combinations
    #[arg(long, value_name = "KEY=A,B")]
    pub vary: Vec<String>,
    /// Compare another renderer: a shell command in which {spp}, {out} (an EXR to write), {seed}, {width}, {height} and
    /// {threads} are replaced; may be repeated
    #[arg(long, value_name = "NAME=COMMAND")]
    pub against: Vec<String>,
    /// Factor of the other renderers' pictures; auto makes the means equal
    #[arg(long, value_name = "auto|S", default_value = "auto")]
    pub against_scale: String,
    /// What the reference is made with: an integrator, or an EXR file. Default: light where light paths see all that the
    /// scene has, else path where all is matte, else auto
    #[arg(long, value_name = "INTEGRATOR|FILE")]
    pub reference: Option<String>,
    /// Samples per pixel of each of the reference's 8 runs; by default as many as make its own error a twentieth of the
    /// target, in at most the time limit
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(2..=1 << 32))]
    pub reference_spp: Option<u64>,
    /// relMSE whose time is told beside that of 0.01
    #[arg(long, value_name = "E")]
    pub target: Option<f64>,
    /// Independent runs of each budget
    #[arg(long, value_name = "R", default_value_t = 8, value_parser = clap::value_parser!(u64).range(8..=1 << 10))]
    pub replicates: u64,
    /// Seconds for each scene, shared by what is compared; the reference may take as many again
    #[arg(long, value_name = "SECONDS", default_value_t = 40.0)]
    pub time_limit: f64,
    /// Smallest budget, samples per pixel
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..=1 << 20))]
    pub from_spp: u64,
    /// Largest budget, samples per pixel
    #[arg(long, value_name = "N", default_value_t = 1 << 16, value_parser = clap::value_parser!(u64).range(1..=1 << 32))]
    pub to_spp: u64,
    /// Size of the pictures instead of the scenes'
    #[arg(long, value_name = "WxH")]
    pub resolution: Option<String>,
    /// Only pixels where this picture exceeds 0.5 count, .png or .exr
    #[arg(long, value_name = "FILE")]
    pub mask: Option<PathBuf>,
    /// Seed from which all runs take theirs
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(0..=1 << 20))]
    pub seed: u64,
    /// Threads; all processors by default
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=4096))]
    pub threads: Option<u16>,
    /// Folder for bench.csv, bench.json, bench.html, a plot SCENE.svg of each scene and the references
    #[arg(short, long = "output", value_name = "DIR", default_value = "bench")]
    pub output: PathBuf,
    /// Instead: how often the true error of renders to the target error is below what they claim, in 100 runs of each scene
    #[arg(long)]
    pub calibrate: bool,
    /// Print one JSON object instead of a table
    #[arg(long)]
    pub json: bool,
    /// No progress, no warnings
    #[arg(short, long)]
    pub quiet: bool,
}

/// The target that is always told.
const TARGET: f64 = 0.01;
/// No variant goes on beyond this share of its lowest target.
const FAR_BELOW: f64 = 0.25;

/// What was found out about one scene.
struct SceneReport {
    name: String,
    width: u32,
    height: u32,
    compile_seconds: f64,
    reference: reference::Reference,
    variants: Vec<VariantReport>,
}

/// What was found out about one variant.
struct VariantReport {
    variant: Variant,
    levels: Vec<Level>,
    summary: Summary,
    /// One picture of the largest budget, in XYZ.
    picture: Option<Image>,
}

/// What holds for all scenes.
struct Session<'a> {
    args: &'a BenchArgs,
    pool: rayon::ThreadPool,
    clock: Clock,
    targets: Vec<f64>,
    variants: Vec<Variant>,
}

/// Runs the benchmark and writes its files.
///
/// # Errors
/// `Usage` for arguments that make no sense, those of scene files, `Io` where a command fails or a file cannot be written.
pub fn run(args: &BenchArgs) -> Result<ExitCode> {
    let session = Session::new(args)?;
    std::fs::create_dir_all(&args.output)
        .map_err(|e| Error::new(ErrorKind::Io, format!("cannot make the folder: {e}")).in_file(&args.output))?;
    if args.calibrate {
        let text = calibrate::report(&session, &calibrate::calibrate(&session)?)?;
        write_data(&mut std::io::stdout().lock(), text.as_bytes())?;
        return Ok(ExitCode::SUCCESS);
    }
    let reports = args.scenes.iter().map(|path| session.scene(path)).collect::<Result<Vec<_>>>()?;
    output::write_files(&session, &reports)?;
    let text = match args.json {
        true => format!("{}\n", output::to_json(&session, &reports)),
        false => table::to_table(&session, &reports),
    };
    write_data(&mut std::io::stdout().lock(), text.as_bytes())?;
    Ok(ExitCode::SUCCESS)
}

impl<'a> Session<'a> {
    fn new(args: &'a BenchArgs) -> Result<Self> {
        let legal = |value: f64| value > 0.0 && value.is_finite();
        if let Some(bad) = args.target.filter(|target| !legal(*target)) {
            return Err(usage(format!("--target {bad}: expected a relMSE above 0, such as 0.001")));
        }
        if !legal(args.time_limit) {
            return Err(usage(format!("--time-limit {}: expected seconds above 0", args.time_limit)));
        }
        if args.from_spp > args.to_spp {
            return Err(usage(format!("--from-spp {} exceeds --to-spp {}", args.from_spp, args.to_spp)));
        }
        let mut targets = vec![TARGET];
        targets.extend(args.target.filter(|target| *target != TARGET));
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(args.threads.map_or(0, usize::from))
            .build()
            .map_err(|e| Error::new(ErrorKind::Io, format!("cannot start threads: {e}")))?;
        let variants = variant::all(&args.vary, &args.against, &args.against_scale)?;
        Ok(Self { args, pool, clock: Clock::new(), targets, variants })
    }

    fn say(&self, text: &str) {
        if !self.args.quiet {
            eprintln!("{text}");
        }
    }

    fn lowest_target(&self) -> f64 {
        self.targets.iter().copied().fold(f64::INFINITY, f64::min)
    }

    fn scene(&self, path: &std::path::Path) -> Result<SceneReport> {
        let work = self.pool.install(|| Work::new(path, self.args.resolution.as_deref()))?;
        work.warnings.iter().for_each(|warning| self.say(&format!("warning: {warning}")));
        let mask = self.args.mask.as_deref().map(|path| read_mask(path, work.size())).transpose()?;
        for variant in &self.variants {
            // Once for nothing: first touches of memory and caches are no part of the cost, and what fails fails early.
            measure::measure(self, &work, variant, self.args.from_spp, 0)?;
        }
        let reference = reference::get(self, &work, mask.as_deref())?;
        self.say(&format!("{}: {}", work.name, reference.told()));
        let mut progress: Vec<Progress> = self.variants.iter().map(|v| Progress::new(v, work.size())).collect();
        self.measure(&work, mask.as_deref(), &reference, &mut progress)?;
        let variants = progress
            .into_iter()
            .map(|p| VariantReport {
                summary: Summary::new(&p.levels, &self.targets),
                variant: p.variant.clone(),
                levels: p.levels,
                picture: p.picture,
            })
            .collect();
        Ok(SceneReport {
            name: work.name.clone(),
            width: work.compiled.film.width,
            height: work.compiled.film.height,
            compile_seconds: work.compile_seconds,
            reference,
            variants,
        })
    }

    /// Doubling budgets; within one, all variants take turns, so that whatever disturbs the machine disturbs them alike.
    fn measure(
        &self,
        work: &Work,
        mask: Option<&[bool]>,
        reference: &reference::Reference,
        progress: &mut [Progress],
    ) -> Result<()> {
        let share = self.args.time_limit / progress.len() as f64;
        let mut spp = self.args.from_spp;
        for level in 0.. {
            let order: Vec<usize> = (0..progress.len()).filter(|&i| progress[i].goes_on(share)).collect();
            if order.is_empty() || spp > self.args.to_spp {
                break;
            }
            for replicate in 0..self.args.replicates {
                let seed = self.args.seed + level * self.args.replicates + replicate;
                for k in 0..order.len() {
                    let p = &mut progress[order[(k + replicate as usize) % order.len()]];
                    let (picture, mut run) = measure::measure(self, work, p.variant, spp, seed)?;
                    let picture = judge::rescale(p.variant, picture, reference)?;
                    run.judge(&picture, reference, mask)?;
                    p.add(run, picture);
                }
            }
            for &i in &order {
                progress[i].finish_level(spp, reference, mask, self.lowest_target())?;
                self.say(&format!("{}: {}", work.name, progress[i].told()));
            }
            spp *= 2;
        }
        Ok(())
    }
}

/// A variant while it is measured.
struct Progress<'v> {
    variant: &'v Variant,
    levels: Vec<Level>,
    runs: Vec<Run>,
    /// Sums over the runs of a level.
    sums: Sums,
    picture: Option<Image>,
    spent: f64,
    done: bool,
}

impl<'v> Progress<'v> {
    fn new(variant: &'v Variant, size: [u32; 2]) -> Self {
        let (levels, runs) = (Vec::new(), Vec::new());
        Self { variant, levels, runs, sums: Sums::new(size), picture: None, spent: 0.0, done: false }
    }

    /// Whether the next level, of twice the cost, fits into what is left. The first two are always measured, for a line
    /// needs two points.
    fn goes_on(&self, share: f64) -> bool {
        let last = self.levels.last().map_or(0.0, |level| level.runs.iter().map(|run| run.wall_seconds).sum::<f64>());
        !self.done && (self.levels.len() < 2 || self.spent + 2.0 * last <= share)
    }

    fn add(&mut self, run: Run, picture: Image) {
        self.spent += run.wall_seconds;
        self.sums.add(&picture);
        self.runs.push(run);
        self.picture = Some(picture);
    }

    fn finish_level(
        &mut self,
        spp: u64,
        reference: &reference::Reference,
        mask: Option<&[bool]>,
        lowest_target: f64,
    ) -> Result<()> {
        let sums = std::mem::replace(&mut self.sums, Sums::new(reference.mean.size()));
        let systematic = reference.systematic_error(&sums, mask)?;
        let level = Level::new(spp, std::mem::take(&mut self.runs), reference.own_relmse(), systematic);
        self.done = self.levels.len() >= 2 && level.relmse < FAR_BELOW * lowest_target;
        self.levels.push(level);
        Ok(())
    }

    fn told(&self) -> String {
        self.levels.last().map_or(String::new(), |level| {
            let Level { spp, relmse, standard_error, cpu_seconds, .. } = level;
            format!(
                "{}, {spp} spp: relMSE {relmse:.3e} ± {standard_error:.1e}, {cpu_seconds:.3} CPU s",
                self.variant.name
            )
        })
    }
}
