//! Adaptive sampling: where the picture is noisy pixels get more samples, where it has converged few. What a stage gives each
//! pixel is decided by the stages before it, and what a stage counts in the mean is fixed: see
//! [`crate::film::CameraPart::close_stage`]. Pooling the samples that decide with those that follow would be biased.

use super::schedule::Segment;
use crate::film::Film;
use crate::sampling::mix;
use rayon::prelude::*;
use std::ops::Range;

/// Pixels that the blur of noise and cost reaches on each side: a single pixel has too few samples to know either.
const REACH: usize = 2;
/// Share of the samples that are spread evenly, against what earlier stages have missed.
const DEFENSIVE: f64 = 0.1;
/// Variance of a pixel relative to its brightness squared beyond which it counts as this: the error of a pixel that has
/// hardly been hit says little.
const LARGEST_VARIANCE: f64 = 1.0;
/// Most samples of a pixel, for each sample that pixels get on average.
const LARGEST_RATE: f64 = 16.0;
/// Least samples of a pixel in a stage: one in each replicate.
const LEAST_SAMPLES: u64 = 2;
/// Cost of a path beside that of its rays, in units of a ray.
const COST_OF_A_PATH: f64 = 1.0;

/// The numbers of samples that each pixel gets in the stages of a render.
#[derive(Debug, Default)]
pub struct Adaptive {
    /// Seed of the random rounding of sample numbers.
    seed: u64,
    /// Samples of each pixel in earlier stages.
    before: Vec<u64>,
    /// Samples of each pixel in this stage; empty in the first, where all get the same.
    counts: Vec<u64>,
    /// Rays that each pixel has cost.
    rays: Vec<u64>,
}

impl Adaptive {
    /// Starts with a picture of so many pixels, all alike.
    pub fn new(pixels: usize, seed: u64) -> Self {
        Self { seed, before: vec![0; pixels], counts: Vec::new(), rays: vec![0; pixels] }
    }

    /// Returns the samples of a pixel in a round of a stage, and the weight of each: a stage counts as much in every pixel,
    /// however many samples the pixel gets. The share of the samples that is due by the end of a round is rounded at random,
    /// so that it is right on average in a stage that is broken off.
    pub fn samples(&self, pixel: usize, round: &Range<u64>, stage: &Segment) -> (Range<u64>, f64) {
        let Some(&count) = self.counts.get(pixel) else { return (round.clone(), 1.0) };
        let length = stage.samples.end - stage.samples.start;
        let chance = ((mix(self.seed ^ mix(stage.samples.start) ^ pixel as u64) >> 32) * length) >> 32;
        // Both replicates go together.
        let part = |samples: u64| self.before[pixel] + (count / 2 * stage.taken(samples) + chance) / length * 2;
        (part(round.start)..part(round.end), length as f64 / count as f64)
    }

    /// Adds rays that were traced for a pixel.
    pub fn add_rays(&mut self, pixel: usize, rays: u64) {
        self.rays[pixel] += rays;
    }

    /// Decides on a stage of `length` samples on average, by what is on the film. With variances V of a sample and costs c,
    /// the relMSE for a given cost is least with numbers in proportion to √(V / c).
    pub fn start_stage(&mut self, film: &Film, length: u64) {
        self.before = (0..self.rays.len()).map(|pixel| film.camera().samples(pixel)).collect();
        let size = [film.width() as usize, film.height() as usize];
        let variances = film.relative_camera_variances();
        let of_a_sample = variances.iter().zip(&self.before).map(|(v, &n)| v.min(LARGEST_VARIANCE) * n as f64);
        let variances = blurred(&of_a_sample.collect::<Vec<_>>(), size);
        let costs =
            self.rays.iter().zip(&self.before).map(|(&rays, &n)| COST_OF_A_PATH + rays as f64 / n.max(1) as f64);
        let costs = blurred(&costs.collect::<Vec<_>>(), size);
        self.counts = rates(&variances, &costs).into_iter().map(|rate| count(rate, length)).collect();
    }
}

/// Returns the samples that a pixel with this rate gets in a stage, as many in each replicate.
fn count(rate: f64, length: u64) -> u64 {
    ((0.5 * rate * length as f64).round() as u64 * 2).max(LEAST_SAMPLES)
}

/// Returns the rate of each pixel, that is its samples for each sample that pixels get on average. All together cost as much
/// as an even spread.
fn rates(variances: &[f64], costs: &[f64]) -> Vec<f64> {
    let wanted: Vec<f64> = variances.iter().zip(costs).map(|(v, c)| (v / c).sqrt()).collect();
    let total: f64 = costs.iter().sum();
    let spent: f64 = wanted.iter().zip(costs).map(|(w, c)| w * c).sum();
    let scale = if spent > 0.0 { (1.0 - DEFENSIVE) * total / spent } else { 0.0 };
    wanted.iter().map(|w| (DEFENSIVE + scale * w).min(LARGEST_RATE)).collect()
}

/// Returns the mean over the square around each pixel.
fn blurred(values: &[f64], [width, height]: [usize; 2]) -> Vec<f64> {
    let around = |at: usize, size: usize| at.saturating_sub(REACH)..(at + REACH + 1).min(size);
    let mean_of_row = |row: usize, x: usize| {
        let columns = around(x, width);
        let n = columns.len() as f64;
        columns.map(|column| values[row * width + column]).sum::<f64>() / n
    };
    let rows: Vec<f64> =
        (0..values.len()).into_par_iter().map(|pixel| mean_of_row(pixel / width, pixel % width)).collect();
    let mean = |pixel: usize| {
        let around = around(pixel / width, height);
        let n = around.len() as f64;
        around.map(|row| rows[row * width + pixel % width]).sum::<f64>() / n
    };
    (0..values.len()).into_par_iter().map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::driver::allocation::Allocation;
    use crate::render::driver::schedule::Work;

    #[test]
    fn rates_follow_noise_at_the_same_cost() {
        let (variances, costs) = ([4.0, 1.0, 0.0, 1.0], [1.0, 1.0, 1.0, 4.0]);
        let rates = rates(&variances, &costs);
        assert!(((rates[0] - DEFENSIVE) / (rates[1] - DEFENSIVE) - 2.0).abs() < 1e-12);
        assert!(((rates[1] - DEFENSIVE) / (rates[3] - DEFENSIVE) - 2.0).abs() < 1e-12);
        assert_eq!(rates[2], DEFENSIVE);
        let cost: f64 = rates.iter().zip(costs).map(|(r, c)| r * c).sum();
        assert!((cost - 7.0).abs() < 1e-12);
    }

    /// All of them by the end of a stage, and of what a stage that is broken off has given as much as is due, on average.
    #[test]
    fn every_pixel_gets_its_samples_in_whatever_rounds() {
        let pixels = 4000;
        let adaptive = Adaptive {
            seed: 1,
            before: vec![8; pixels],
            counts: (0..pixels).map(|pixel| if pixel % 2 == 0 { 2 } else { 30 }).collect(),
            rays: vec![0; pixels],
        };
        let stage = Segment::new(Work { samples: 8, ..Work::default() }, 16, 1, Allocation::START);
        let mut taken = [0.0; 2];
        for pixel in 0..pixels {
            let mut next = 8;
            for round in [8..10, 10..12, 12..14, 14..16] {
                let (samples, weight) = adaptive.samples(pixel, &round, &stage);
                assert_eq!((samples.start, samples.start % 2, samples.end % 2), (next, 0, 0));
                next = samples.end;
                if round.end <= 10 {
                    taken[pixel % 2] += weight * (samples.end - samples.start) as f64 / (pixels / 2) as f64;
                }
            }
            assert_eq!(next - 8, adaptive.counts[pixel]);
        }
        assert!((taken[0] - 2.0).abs() < 0.25 && (taken[1] - 2.0).abs() < 0.02, "{taken:?}");
        assert_eq!(Adaptive::new(1, 1).samples(0, &(12..14), &stage), (12..14, 1.0));
    }

    #[test]
    fn blur_keeps_constants_and_spreads_spikes() {
        assert!(blurred(&[2.0; 12], [4, 3]).iter().all(|v| (v - 2.0).abs() < 1e-12));
        let mut spike = vec![0.0; 49];
        spike[24] = 25.0;
        let spread = blurred(&spike, [7, 7]);
        assert!((spread[24] - 1.0).abs() < 1e-12 && spread[21] == 0.0);
    }
}
