//! Splits: of what a camera path finds, the light that comes to the first matte surface from other surfaces is much of the
//! noise and little of the cost, where lamps light that surface well. So several paths go on from there, each by points of
//! its own of the sequence, and stand for one together.
//!
//! With variances V and costs c of what a path finds up to there (f), behind (b), and of what other techniques find (o), the
//! error for a given cost, (V_f + V_b / k + V_o)(c_f + k c_b + c_o), is least with k² = V_b (c_f + c_o) / ((V_f + V_o) c_b). A
//! trial in the pilot tells V_b and c_b from V_f and c_f: for a number of samples and not for one, because well-spread samples
//! settle what a surface gets from its lamps sooner than all else. The rest is known at the end of a segment, see
//! [`super::allocation`].
//!
//! k is a power of two, so that all points together are a net where the samples are, the lower one, as few samples see
//! too little of the variance in front; and it never falls, so that no point is used twice. By experiment with 64 samples, the
//! number found makes relMSE × CPU time less by 1.5 in cornell.json and prism-through-prism.json, by 1.07 in prism.json, and
//! changes it by less than 6 % in five other scenes.

use super::Renderer;
use super::fork::Branching;
use super::pilot::COST_OF_A_PATH;
use super::workspace::{Counters, Workspace};
use crate::film::{CAMERA_REPLICATES, Xyz};
use rayon::prelude::*;

/// Share of what a path started with that it must carry to be split: what carries less has been divided by forks before.
pub const LEAST_CARRIED_TO_SPLIT: f32 = 0.5;
/// Most paths that go on.
const MOST: u8 = 8;
/// The trial takes one pixel of each square of this edge,
const SQUARE: u32 = 8;
/// and so many samples of it: half a sample of each pixel.
const SAMPLES: u64 = 32;
/// Variance of a pixel, relative to the square of its brightness, beyond which it counts as this.
const LARGEST_VARIANCE: f64 = 1.0;

/// Shares of the variance and of the cost of paths that are not split that lie behind the first matte surface.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Behind {
    /// Of the variance.
    pub variance: f64,
    /// Of the cost.
    pub cost: f64,
}

impl Behind {
    /// Variance of a sample for which so many paths go on, relative to that of one that is not split.
    pub fn variance_of(self, splits: u8) -> f64 {
        1.0 - self.variance + self.variance / f64::from(splits.max(1))
    }

    /// The same for its cost.
    pub fn cost_of(self, splits: u8) -> f64 {
        1.0 - self.cost + self.cost * f64::from(splits.max(1))
    }

    /// How many paths go on best, 0 for just the path itself, where other techniques have so much variance and cost, relative
    /// to those of a sample that is not split.
    pub fn best_splits(self, [variance, cost]: [f64; 2]) -> u8 {
        let gain = self.variance / (1.0 - self.variance + variance);
        let power = (gain * (1.0 - self.cost + cost) / self.cost).log2() / 2.0;
        // Where nothing is found behind there is nothing to gain.
        if power >= 1.0 { 1 << power.min(f64::from(MOST.ilog2())) as u8 } else { 0 }
    }
}

/// What the samples of one pixel gave: means of each replicate up to the first matte surface, and behind it.
#[derive(Default)]
struct TrialPixel {
    front: [Xyz; CAMERA_REPLICATES],
    behind: [Xyz; CAMERA_REPLICATES],
    rays_behind: u64,
}

impl<const DISPERSION: bool, const INTERIORS: bool> Renderer<'_, DISPERSION, INTERIORS> {
    /// What lies behind the first matte surface of camera paths.
    pub fn look_behind(&self) -> (Behind, Counters) {
        let [across, down] = self.squares(SQUARE);
        let pixels: Vec<(TrialPixel, Counters)> = (0..across * down)
            .into_par_iter()
            .map_init(
                || Workspace::new(self.scene),
                |workspace, square| {
                    workspace.counters = Counters::default();
                    let pixel = self.split_trial(workspace, self.pilot_pixel(square, SQUARE));
                    (pixel, workspace.counters)
                },
            )
            .collect();
        let mut counters = Counters::default();
        pixels.iter().for_each(|(_, count)| counters.add(*count));
        let pixels: Vec<TrialPixel> = pixels.into_iter().map(|(pixel, _)| pixel).collect();
        let paths = pixels.len() as u64 * SAMPLES;
        let rays_behind: u64 = pixels.iter().map(|pixel| pixel.rays_behind).sum();
        let [of_front, of_behind] = variances(&pixels);
        let share = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 0.0 };
        let behind = Behind {
            variance: share(of_behind, of_front + of_behind),
            cost: share(rays_behind as f64, counters.rays as f64 + COST_OF_A_PATH * paths as f64),
        };
        (behind, counters)
    }

    fn split_trial(&self, workspace: &mut Workspace, pixel: u32) -> TrialPixel {
        let branching = Branching { splits: 1, ..self.plan.camera };
        let mut trial = TrialPixel::default();
        let share = CAMERA_REPLICATES as f64 / SAMPLES as f64;
        for sample in 0..SAMPLES {
            let found = self.camera_path(workspace, pixel, sample, (self.pilot_seed(), branching));
            let [all, behind] =
                [found.radiance, found.behind.radiance].map(|light| self.xyz(&found.wavelengths, light));
            if all.iter().all(|v| v.is_finite()) {
                for c in 0..3 {
                    trial.front[found.replicate][c] += share * (all[c] - behind[c]);
                    trial.behind[found.replicate][c] += share * behind[c];
                }
            }
            trial.rays_behind += found.behind.rays;
        }
        trial
    }
}

/// Relative variances of both parts, up to the first matte surface and behind it, up to a common factor.
fn variances(pixels: &[TrialPixel]) -> [f64; 2] {
    let brightness = |pixel: &TrialPixel, c: usize| -> f64 {
        let parts = pixel.front.iter().chain(&pixel.behind);
        parts.map(|xyz| xyz[c]).sum::<f64>() / CAMERA_REPLICATES as f64
    };
    let all = pixels.iter().flat_map(|pixel| (0..3).map(move |c| brightness(pixel, c)));
    let mean = all.sum::<f64>() / (3 * pixels.len()) as f64;
    if mean <= 0.0 {
        return [0.0; 2];
    }
    let mut sums = [0.0; 2];
    for pixel in pixels {
        for (sum, part) in sums.iter_mut().zip([&pixel.front, &pixel.behind]) {
            let relative = |c: usize| {
                let (difference, brightness) = (0.5 * (part[0][c] - part[1][c]), brightness(pixel, c));
                difference * difference / (brightness * brightness + 0.01 * mean * mean)
            };
            *sum += (0..3).map(relative).sum::<f64>().min(LARGEST_VARIANCE);
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::mix;
    use crate::scene::Compiled;
    use std::path::Path;

    /// Against all numbers: none has less than 8/9 of the product of error and cost, which is what the lower of two powers of
    /// two can be off where the best lies just below the higher.
    #[test]
    fn the_number_has_the_least_error_for_its_cost() {
        for (variance, cost) in [(0.5, 0.5), (0.9, 0.6), (0.97, 0.5), (0.6, 0.1), (0.8, 0.05), (0.1, 0.3)] {
            for others in [[0.0, 0.0], [1.0, 0.2], [5.0, 0.1], [0.1, 3.0]] {
                let behind = Behind { variance, cost };
                let product = |k: u8| (behind.variance_of(k) + others[0]) * (behind.cost_of(k) + others[1]);
                let least = (1..=MOST).map(product).fold(f64::INFINITY, f64::min);
                let found = behind.best_splits(others);
                assert!(least >= 8.0 / 9.0 * product(found), "{behind:?} {others:?}: {found}");
            }
        }
        let best = |variance, cost, others| Behind { variance, cost }.best_splits(others);
        assert_eq!(best(0.97, 0.5, [0.0, 0.0]), 4);
        assert_eq!(best(0.97, 0.5, [1e3, 0.0]), 0, "others are noisier");
        assert_eq!(best(1.0, 0.5, [0.0, 0.0]), MOST);
        assert_eq!(best(0.0, 0.5, [0.0, 0.0]), 0);
        assert_eq!(best(0.0, 0.0, [0.0, 0.0]), 0);
        assert_eq!(best(0.0, 0.0, [f64::INFINITY, 1.0]), 0);
    }

    /// A floor between a wall and a ball of glass, under a lamp.
    fn room() -> Compiled {
        let text = r#"{
            "camera": { "type": "perspective", "from": [0, 1, 2], "to": [0, 0.3, 0], "fov_degrees": 50 },
            "film": { "width": 8, "height": 8 },
            "materials": {
                "matte": { "type": "diffuse", "reflectance": 0.8 },
                "glass": { "type": "dielectric", "ior": { "glass": "SF11" }, "absorption_per_m": 0.5 }
            },
            "objects": [
                { "shape": { "type": "quad", "origin": [-1, 0, 1], "u": [2, 0, 0], "v": [0, 0, -2] }, "material": "matte" },
                { "shape": { "type": "quad", "origin": [-1, 0, -1], "u": [2, 0, 0], "v": [0, 2, 0] }, "material": "matte" },
                { "shape": { "type": "sphere", "center": [0, 0.4, 0], "radius": 0.3 }, "material": "glass" },
                { "shape": { "type": "quad", "origin": [-1, 2, -1], "u": [2, 0, 0], "v": [0, 0, 2] },
                  "emission": { "illuminant": "D65" } }
            ]
        }"#;
        let parsed = crate::scene::description::parse_str(text, Path::new("room.json")).unwrap();
        crate::scene::compile(&parsed.description).unwrap()
    }

    /// However many paths go on, a sample brings the same on average. Several paths trace more rays, and bring less noise.
    #[test]
    fn splits_change_no_mean() {
        let compiled = room();
        let renderer = Renderer::<true, true>::new(&compiled.scene, &compiled.render, &compiled.film);
        let mut workspace = Workspace::new(&compiled.scene);
        let mut of_splits = |splits: u8| {
            workspace.counters = Counters::default();
            let (mut front, mut behind) = (Vec::new(), Vec::new());
            for i in 0..40_000u64 {
                let branching = Branching { splits, ..renderer.plan.camera };
                // Seeds of their own, so that samples are independent of each other and of those of other numbers.
                let seed = mix(i << 8 | if splits > 1 { u64::from(splits) } else { 1 });
                let found = renderer.camera_path(&mut workspace, (i % 64) as u32, 0, (seed, branching));
                front.push(f64::from((found.radiance - found.behind.radiance).mean()));
                behind.push(f64::from(if splits > 0 { found.behind.radiance } else { found.radiance }.mean()));
            }
            (front, moments(&behind), workspace.counters.rays)
        };
        let (unsplit, single, split) = (of_splits(0), of_splits(1), of_splits(4));
        let whole = |(front, behind, _): &(Vec<f64>, [f64; 2], u64)| moments(front)[0] + behind[0];
        assert!((unsplit.1[0] / whole(&single) - 1.0).abs() < 1e-6, "one path that goes on is the path itself");
        assert_eq!(unsplit.2, single.2);
        let ([a, var_a], [b, var_b]) = (single.1, split.1);
        let z = (a - b) / ((var_a + var_b) / 40_000.0).sqrt();
        assert!(z.abs() < 4.0 && (a / b - 1.0).abs() < 0.05, "{a} {b}: {z} σ");
        assert!(var_b < 0.5 * var_a, "{var_a} {var_b}");
        assert!(split.2 > 2 * single.2, "{} {} rays", single.2, split.2);
    }

    /// Mean and variance.
    fn moments(values: &[f64]) -> [f64; 2] {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        [mean, values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / (n - 1.0)]
    }
}
