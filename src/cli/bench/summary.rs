//! From runs to figures: spread, cost, slope, time to a target.

use super::measure::{Kinds, Run};
use crate::math;
use crate::metrics::stats::{self, Line};

/// All runs of one budget.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    /// Samples per pixel.
    pub spp: u64,
    /// The runs.
    pub runs: Vec<Run>,
    /// Mean relMSE, less the reference's own.
    pub relmse: f64,
    /// Standard error of that mean.
    pub standard_error: f64,
    /// 90 % of the runs are better.
    pub percentile_90: f64,
    /// Mean relMSE without the worst 0.1 % of the pixels, as measured.
    pub trimmed_relmse: f64,
    /// relMSE that more samples would not remove, as estimated from all runs together; about 0 if there is none.
    pub systematic_relmse: f64,
    /// Mean processor time of a run.
    pub cpu_seconds: f64,
    /// Mean wall time of a run.
    pub wall_seconds: f64,
    /// Whether the reference is too noisy to judge this.
    pub too_good: bool,
}

/// Share of a measured relMSE that may be the reference's.
const MAX_REFERENCE_SHARE: f64 = 0.5;

impl Level {
    /// Sums up the runs of one budget.
    pub fn new(spp: u64, runs: Vec<Run>, reference_relmse: f64, systematic_relmse: f64) -> Self {
        let of = |value: &dyn Fn(&Run) -> f64| runs.iter().map(value).collect::<Vec<f64>>();
        let raw = of(&|run| run.raw_relmse);
        Self {
            spp,
            relmse: stats::mean(&raw) - reference_relmse,
            standard_error: stats::standard_deviation(&raw) / (raw.len() as f64).sqrt(),
            percentile_90: stats::quantile(&raw, 0.9) - reference_relmse,
            trimmed_relmse: stats::mean(&of(&|run| run.trimmed_relmse)),
            systematic_relmse,
            cpu_seconds: stats::mean(&of(&|run| run.cpu_seconds)),
            wall_seconds: stats::mean(&of(&|run| run.wall_seconds)),
            too_good: reference_relmse > MAX_REFERENCE_SHARE * stats::mean(&raw),
            runs,
        }
    }

    /// Rays a second of processor time.
    pub fn rays_per_cpu_second(&self) -> Option<f64> {
        let rays: Option<Vec<f64>> = self.runs.iter().map(|run| run.rays.map(|n| n as f64)).collect();
        Some(stats::mean(&rays?) / self.cpu_seconds).filter(|v| v.is_finite())
    }

    /// Rays a second of processor time, of those that `count` counts.
    pub fn rays_of_kind(&self, count: impl Fn(&Kinds) -> u64) -> Option<f64> {
        Some(self.mean_of_kinds(|kinds| count(kinds) as f64)? / self.cpu_seconds).filter(|v| v.is_finite())
    }

    /// The mean over runs of something known of their rays.
    pub fn mean_of_kinds(&self, value: impl Fn(&Kinds) -> f64) -> Option<f64> {
        let values: Option<Vec<f64>> = self.runs.iter().map(|run| run.kinds.as_ref().map(&value)).collect();
        values.filter(|values| !values.is_empty()).map(|values| stats::mean(&values))
    }

    /// The largest memory of any run.
    pub fn peak_memory_bytes(&self) -> Option<u64> {
        self.runs.iter().filter_map(|run| run.peak_memory_bytes).max()
    }
}

/// Processor time of a run: fixed + per_sample · samples per pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cost {
    /// What a run costs before its first sample, CPU seconds.
    pub fixed: f64,
    /// CPU seconds for each sample per pixel.
    pub per_sample: f64,
}

impl Cost {
    /// Of so many samples per pixel.
    pub fn at(&self, spp: f64) -> f64 {
        self.fixed + self.per_sample * spp
    }

    /// A fit with equal relative weights, but not finer than the clock.
    fn fit(levels: &[Level]) -> Option<Self> {
        const CLOCK_SECONDS: f64 = 0.01;
        let points: Vec<(f64, f64)> = levels.iter().map(|level| (level.spp as f64, level.cpu_seconds)).collect();
        let weight = |level: &Level| {
            let tick = CLOCK_SECONDS / (level.runs.len() as f64).sqrt();
            1.0 / (level.cpu_seconds * level.cpu_seconds + tick * tick)
        };
        let weights: Vec<f64> = levels.iter().map(weight).collect();
        let line = stats::fit_line(&points, &weights)?;
        if line.intercept >= 0.0 && line.slope > 0.0 {
            return Some(Self { fixed: line.intercept, per_sample: line.slope });
        }
        let through_zero =
            |value: fn(&(f64, f64)) -> f64| points.iter().zip(&weights).map(|(p, w)| w * value(p)).sum::<f64>();
        Some(Self { fixed: 0.0, per_sample: through_zero(|p| p.0 * p.1) / through_zero(|p| p.0 * p.0) })
    }
}

/// When a target is reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reached {
    /// After so many CPU seconds: best, and the ends of a 95 % interval.
    After {
        /// CPU time at which the mean crosses the target.
        cpu_seconds: f64,
        /// CPU time at which its lower bound does; 0 if already that of the smallest budget does.
        low: f64,
        /// CPU time at which its upper bound does; infinite if it never does.
        high: f64,
    },
    /// Already by the smallest budget, in so many CPU seconds.
    AtOnce(f64),
    /// The largest budget, of so many CPU seconds, does not reach the target.
    NotIn(f64),
}

/// What is known of a variant.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// Fitted cost; `None` while there are fewer than two budgets.
    pub cost: Option<Cost>,
    /// Slope of log relMSE over log samples per pixel, with its standard error.
    pub slope: Option<(f64, f64)>,
    /// 1 / (relMSE · CPU seconds) at the largest budget that can be judged, with the fitted cost.
    pub efficiency: Option<f64>,
    /// Time to each target.
    pub reached: Vec<(f64, Reached)>,
}

impl Summary {
    /// Sums up all budgets, the smallest first.
    pub fn new(levels: &[Level], targets: &[f64]) -> Self {
        let cost = Cost::fit(levels);
        let judged: Vec<&Level> = levels.iter().filter(|level| !level.too_good && level.relmse > 0.0).collect();
        let efficiency = cost.zip(judged.last()).map(|(cost, level)| 1.0 / (level.relmse * cost.at(level.spp as f64)));
        let reached = targets.iter().map(|&target| (target, reached(levels, cost, target))).collect();
        let slope = slope(&judged).map(|line| (line.slope, line.slope_error));
        Self { cost, slope, efficiency: efficiency.filter(|e| e.is_finite()), reached }
    }
}

/// Budgets weigh by how well their errors are known.
fn slope(levels: &[&Level]) -> Option<Line> {
    let log = |level: &&Level| (math::ln(level.spp as f64), math::ln(level.relmse));
    let points: Vec<(f64, f64)> = levels.iter().map(log).collect();
    // A few per cent are never known better: budgets differ in more than noise.
    const FLOOR: f64 = 0.03;
    let weight = |level: &&Level| {
        let relative = level.standard_error / level.relmse;
        1.0 / (relative * relative + FLOOR * FLOOR)
    };
    let weights: Vec<f64> = levels.iter().map(weight).collect();
    stats::fit_line(&points, &weights)
}

fn reached(levels: &[Level], cost: Option<Cost>, target: f64) -> Reached {
    let Some(largest) = levels.last() else { return Reached::NotIn(0.0) };
    let seconds = |spp: f64| cost.map_or(largest.cpu_seconds, |cost| cost.at(spp));
    let mean = |level: &Level| level.relmse;
    let bound = |level: &Level, sign: f64| {
        let t = stats::student_t_quantile(0.975, (level.runs.len() - 1) as f64);
        level.relmse + sign * t * level.standard_error
    };
    match crossing(levels, target, mean) {
        Crossing::Before => Reached::AtOnce(levels[0].cpu_seconds),
        Crossing::Never => Reached::NotIn(largest.cpu_seconds),
        Crossing::At(spp) => Reached::After {
            cpu_seconds: seconds(spp),
            low: match crossing(levels, target, |level| bound(level, -1.0)) {
                Crossing::At(spp) => seconds(spp),
                _ => 0.0,
            },
            high: match crossing(levels, target, |level| bound(level, 1.0)) {
                Crossing::At(spp) => seconds(spp),
                _ => f64::INFINITY,
            },
        },
    }
}

/// Finds the CPU time at which errors cross a target.
enum Crossing {
    /// The smallest budget is below already.
    Before,
    /// At so many samples per pixel.
    At(f64),
    /// All are above.
    Never,
}

/// The last budget above the target and its successor, joined by a straight line in log–log.
fn crossing(levels: &[Level], target: f64, error: impl Fn(&Level) -> f64) -> Crossing {
    let Some(above) = levels.iter().rposition(|level| error(level) > target) else { return Crossing::Before };
    let Some(next) = levels.get(above + 1) else { return Crossing::Never };
    let (a, b) = (&levels[above], next);
    // An error that noise makes 0 or negative has no logarithm; the crossing is before it in any case.
    let [log_a, log_b] = [error(a), error(b)].map(|e| math::ln(e.max(target * 1e-3)));
    let share = (log_a - math::ln(target)) / (log_a - log_b);
    let [from, to] = [a, b].map(|level| math::ln(level.spp as f64));
    Crossing::At(math::exp(from + (to - from) * share))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// relMSE 0.64/spp, cost 0.5 + 0.25 spp.
    fn levels(count: u32) -> Vec<Level> {
        let level = |k: u32| {
            let spp = 1 << k;
            let run = |wobble: f64| Run {
                raw_relmse: 0.64 / f64::from(spp) * (1.0 + wobble) + 1e-4,
                cpu_seconds: 0.5 + 0.25 * f64::from(spp),
                rays: Some(1000 * u64::from(spp as u32)),
                ..Run::default()
            };
            Level::new(spp as u64, [-0.05, 0.05].repeat(4).into_iter().map(run).collect(), 1e-4, 0.0)
        };
        (0..count).map(level).collect()
    }

    #[test]
    fn figures_of_a_known_law() {
        let summary = Summary::new(&levels(9), &[0.01, 0.1, 1.0, 1e-4]);
        let cost = summary.cost.unwrap();
        assert!((cost.fixed - 0.5).abs() < 1e-9 && (cost.per_sample - 0.25).abs() < 1e-9);
        let (slope, error) = summary.slope.unwrap();
        assert!((slope + 1.0).abs() < 1e-9 && error < 1e-9);
        // 64 samples.
        let Reached::After { cpu_seconds, low, high } = summary.reached[0].1 else { panic!("{summary:?}") };
        assert!((cpu_seconds - 16.5).abs() < 1e-6 && low < cpu_seconds && high > cpu_seconds && high < 17.5);
        let Reached::After { cpu_seconds, .. } = summary.reached[1].1 else { panic!("{summary:?}") };
        assert!((cpu_seconds - 2.1).abs() < 1e-6);
        assert_eq!(summary.reached[2].1, Reached::AtOnce(0.75));
        assert_eq!(summary.reached[3].1, Reached::NotIn(64.5));
        let efficiency = summary.efficiency.unwrap();
        assert!((efficiency - 256.0 / 0.64 / 64.5).abs() < 1e-6, "{efficiency}");
    }

    #[test]
    fn a_noisy_reference_judges_nothing() {
        let mut all = levels(12);
        assert!(!all[8].too_good && all[11].too_good == (1e-4 > 0.64 / 2048.0));
        for level in &mut all {
            level.too_good = true;
        }
        let summary = Summary::new(&all, &[0.01]);
        assert!(summary.slope.is_none() && summary.efficiency.is_none());
        let single = Summary::new(&levels(1), &[0.01]);
        assert!(single.cost.is_none() && single.reached[0].1 == Reached::NotIn(0.75));
        assert_eq!(Summary::new(&[], &[0.01]).reached[0].1, Reached::NotIn(0.0));
    }

    #[test]
    fn a_fit_is_never_negative() {
        let mut all = levels(4);
        all.iter_mut().for_each(|level| level.cpu_seconds = (0.25 * level.spp as f64 - 0.1).max(0.0));
        let cost = Cost::fit(&all).unwrap();
        assert!(cost.fixed == 0.0 && cost.per_sample > 0.15 && cost.per_sample < 0.25);
    }
}
