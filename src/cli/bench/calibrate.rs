//! How much the claim of a render that stops by itself is worth: how often the true error of its picture is below the
//! bound that it tells, over many seeds.

use super::measure::{self, Run};
use super::reference::{self, Reference};
use super::variant::{Kind, Variant};
use super::{Session, TARGET, work::Work};
use crate::Result;
use crate::cli::usage;
use crate::io::output::write_atomically;
use crate::metrics::stats;
use crate::render::blind_spot;
use crate::scene::RenderSettings;
use serde_json::{Value, json};

/// Runs of each scene and variant.
const RUNS: u64 = 100;
/// Most samples a pixel of a run.
const MOST_SAMPLES: u64 = 1 << 24;

/// What the claims of one variant in one scene were worth.
pub struct Calibration {
    scene: String,
    variant: String,
    runs: Vec<Run>,
}

/// Renders every scene to the target error with many seeds.
pub fn calibrate(session: &Session) -> Result<Vec<Calibration>> {
    if let Some(other) = session.variants.iter().find(|variant| matches!(variant.kind, Kind::Command { .. })) {
        return Err(usage(format!("--calibrate: {} makes no claims; expected no --against", other.name)));
    }
    let mut calibrations = Vec::new();
    for path in &session.args.scenes {
        let work = session.pool.install(|| Work::new(path, session.args.resolution.as_deref()))?;
        work.warnings.iter().for_each(|warning| session.say(&format!("warning: {warning}")));
        let reference = reference::get(session, &work, None)?;
        session.say(&format!("{}: {}", work.name, reference.told()));
        for variant in &session.variants {
            let calibration = of_variant(session, &work, variant, &reference)?;
            session.say(&calibration.told());
            calibrations.push(calibration);
        }
    }
    Ok(calibrations)
}

fn of_variant(session: &Session, work: &Work, variant: &Variant, reference: &Reference) -> Result<Calibration> {
    let target_error = Some(session.args.target.unwrap_or(TARGET));
    let plain = variant.kind.settings(work, MOST_SAMPLES, 0);
    if let Some(what) = blind_spot(&work.compiled.scene, plain.integrator) {
        return Err(usage(format!("--calibrate: {}: {what}, and no error tells of it", work.name)));
    }
    let first_seed = session.args.seed;
    let run = |seed: u64| {
        let settings = RenderSettings { seed, target_error, adaptive: true, ..plain };
        let (picture, mut run) = measure::abbe(session, work, &settings);
        run.judge(&picture, reference, None)?;
        Ok(run)
    };
    let runs = (first_seed..first_seed + session.args.replicates.max(RUNS)).map(run).collect::<Result<_>>()?;
    Ok(Calibration { scene: work.name.clone(), variant: variant.name.clone(), runs })
}

impl Calibration {
    /// Runs whose true error is below what they claim.
    fn right(&self) -> usize {
        self.runs.iter().filter(|run| run.claimed_relmse.is_some_and(|claim| run.raw_relmse < claim)).count()
    }

    fn mean(&self, value: impl Fn(&Run) -> f64) -> f64 {
        stats::mean(&self.runs.iter().map(value).collect::<Vec<_>>())
    }

    fn claim(&self) -> f64 {
        self.mean(|run| run.claimed_relmse.unwrap_or(f64::NAN))
    }

    fn told(&self) -> String {
        let largest = self.runs.iter().map(|run| run.raw_relmse / run.claimed_relmse.unwrap_or(f64::NAN));
        format!(
            "{}, {}: below the claim in {} of {} runs; mean claim {:.2e}, mean error {:.2e}, at most {:.2} of the claim; {:.1} \
             samples per pixel, {:.2} CPU s",
            self.scene,
            self.variant,
            self.right(),
            self.runs.len(),
            self.claim(),
            self.mean(|run| run.raw_relmse),
            largest.fold(0.0, f64::max),
            self.mean(|run| run.samples_per_pixel as f64),
            self.mean(|run| run.cpu_seconds),
        )
    }

    fn to_json(&self) -> Value {
        json!({
            "scene": self.scene, "variant": self.variant, "runs": self.runs.len(), "below_claim": self.right(),
            "mean_claim": self.claim(), "mean_relmse": self.mean(|run| run.raw_relmse),
            "mean_samples_per_pixel": self.mean(|run| run.samples_per_pixel as f64),
            "mean_cpu_seconds": self.mean(|run| run.cpu_seconds),
        })
    }
}

/// Writes calibration.csv, a line for each run, and gives the summary for stdout.
pub fn report(session: &Session, calibrations: &[Calibration]) -> Result<String> {
    let mut csv = "scene,variant,seed,claimed_relmse,relmse,samples_per_pixel,cpu_seconds\n".to_owned();
    for c in calibrations {
        for run in &c.runs {
            let claim = run.claimed_relmse.map_or(String::new(), |claim| claim.to_string());
            let Run { seed, raw_relmse, samples_per_pixel, cpu_seconds, .. } = run;
            csv += &format!(
                "{},{},{seed},{claim},{raw_relmse},{samples_per_pixel},{cpu_seconds}\n",
                super::output::quoted(&c.scene),
                super::output::quoted(&c.variant),
            );
        }
    }
    write_atomically(&session.args.output.join("calibration.csv"), csv.as_bytes())?;
    Ok(match session.args.json {
        true => format!(
            "{}\n",
            json!({ "calibrations": calibrations.iter().map(Calibration::to_json).collect::<Vec<_>>() })
        ),
        false => calibrations.iter().map(|c| c.told() + "\n").collect(),
    })
}
