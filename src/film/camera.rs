//! The part of the picture that camera samples make, in stages.
//!
//! What samples count in a pixel adds up to their number on average, but not exactly, where a filter decides it. That error
//! is known, and taken off at the brightness that the other replicate has found: as this is independent of it, the mean
//! stays what it was, and where the picture is even there is no noise at all. A quotient of both sums would be biased.

use super::{CAMERA_REPLICATES, CameraSums, CameraTile, Xyz};
use rayon::prelude::*;

/// Rows of the film that tiles are added to at a time.
const BAND: usize = 16;

/// Stages of a render whose numbers of samples differ from place to place, by what earlier stages have shown. The mean of
/// a pixel is that of its means in all stages with weights that do not depend on what was found: so a stage that stopped
/// early because it missed something does not pull the mean down.
#[derive(Debug, Clone, PartialEq)]
struct ClosedStages {
    /// Sums over stages of weight times mean, by replicate.
    sums: Vec<[Xyz; CAMERA_REPLICATES]>,
    weight: f64,
}

/// Samples of a pixel in each replicate.
pub type CameraSamples = [f64; CAMERA_REPLICATES];

/// What camera samples have given so far.
#[derive(Debug, Clone, PartialEq)]
pub struct CameraPart {
    /// Sums since the last stage,
    sums: Vec<CameraSums>,
    /// and what to divide them by: so many samples of each pixel in each replicate.
    open_samples: CameraSamples,
    /// What the open stage counts in the mean over stages.
    open_weight: f64,
    /// What closed stages gave, if there are any.
    closed: Option<ClosedStages>,
    /// Samples in the square of each pixel, and beyond the film.
    counts: Vec<u64>,
    beyond: u64,
    /// Sum of squared correlations of a pixel's noise with others', see [`super::Filter::correlation`].
    pub(super) correlation: f64,
}

impl CameraPart {
    pub(super) fn new(pixels: usize) -> Self {
        Self {
            sums: vec![CameraSums::default(); pixels],
            open_samples: CameraSamples::default(),
            open_weight: 0.0,
            closed: None,
            counts: vec![0; pixels],
            beyond: 0,
            correlation: 1.0,
        }
    }

    /// Adds what camera samples gave in some tiles, in their order whatever the number of threads.
    pub(super) fn add_tiles(&mut self, width: usize, tiles: &[&CameraTile]) {
        self.sums.par_chunks_mut(BAND * width).enumerate().for_each(|(band, pixels)| {
            let first = (band * BAND) as i32;
            let rows = first..first + (pixels.len() / width) as i32;
            for tile in tiles {
                let ([x, y], [tile_width, tile_height]) = (tile.corner, tile.size.map(|size| size as i32));
                let columns = x.max(0)..(x + tile_width).min(width as i32);
                if columns.is_empty() {
                    continue;
                }
                for row in rows.start.max(y)..rows.end.min(y + tile_height) {
                    let from = ((row - y) * tile_width + columns.start - x) as usize;
                    let to = (row - first) as usize * width + columns.start as usize;
                    let added = &tile.sums[from..from + columns.len()];
                    for (sums, added) in pixels[to..to + columns.len()].iter_mut().zip(added) {
                        sums.add(added);
                    }
                }
            }
        });
    }

    /// Counts camera samples in the square of a pixel, or beyond the film.
    pub fn count_samples(&mut self, pixel: Option<usize>, samples: u64) {
        match pixel {
            Some(pixel) => self.counts[pixel] += samples,
            None => self.beyond += samples,
        }
    }

    /// Tells for how many samples of each pixel the sums since the last stage stand, and what they count in the mean over
    /// stages (without closed stages that does not matter).
    pub fn weigh_open_stage(&mut self, samples: CameraSamples, weight: f64) {
        (self.open_samples, self.open_weight) = (samples, weight);
    }

    /// Camera samples taken in all.
    pub fn paths(&self) -> u64 {
        self.beyond + self.counts.iter().sum::<u64>()
    }

    /// Camera samples in the square of a pixel.
    pub fn samples(&self, pixel: usize) -> u64 {
        self.counts[pixel]
    }

    /// Ends a stage, which has samples in both replicates: samples from here on are another.
    pub fn close_stage(&mut self) {
        let means: Vec<_> = (0..self.sums.len()).map(|pixel| self.open_means(pixel)).collect();
        let closed = self
            .closed
            .get_or_insert_with(|| ClosedStages { sums: vec![Default::default(); means.len()], weight: 0.0 });
        for (sums, means) in closed.sums.iter_mut().zip(means) {
            for (sum, mean) in sums.iter_mut().zip(means) {
                (0..3).for_each(|c| sum[c] += self.open_weight * mean[c]);
            }
        }
        closed.weight += self.open_weight;
        self.sums.fill(CameraSums::default());
        self.weigh_open_stage(CameraSamples::default(), 0.0);
    }

    /// Means of a pixel's replicates in the open stage; 0 without samples.
    fn open_means(&self, pixel: usize) -> [Xyz; CAMERA_REPLICATES] {
        let CameraSums { xyz, weights } = &self.sums[pixel];
        let samples = self.open_samples;
        std::array::from_fn(|r| {
            let (n, other) = (samples[r], 1 - r);
            if n == 0.0 {
                return Xyz::default();
            }
            // Without another replicate there is only the brightness that this one has found.
            let by = if samples[other] > 0.0 { other } else { r };
            let brightness = |c: usize| if weights[by] > 0.0 { xyz[by][c] / weights[by] } else { 0.0 };
            std::array::from_fn(|c| (xyz[r][c] - brightness(c) * (weights[r] - n)) / n)
        })
    }

    /// Mean of a pixel's camera samples.
    pub(super) fn mean(&self, pixel: usize) -> Xyz {
        let (means, samples) = (self.open_means(pixel), self.open_samples);
        let taken: f64 = samples.iter().sum();
        let open = |c: usize| {
            let sum: f64 = means.iter().zip(samples).map(|(mean, samples)| samples * mean[c]).sum();
            if taken > 0.0 { sum / taken } else { 0.0 }
        };
        let Some(closed) = &self.closed else { return std::array::from_fn(open) };
        let weight = if taken > 0.0 { self.open_weight } else { 0.0 };
        let before = |c: usize| closed.sums[pixel].iter().map(|s| s[c]).sum::<f64>() / CAMERA_REPLICATES as f64;
        std::array::from_fn(|c| (before(c) + weight * open(c)) / (closed.weight + weight))
    }

    /// Means of a pixel's replicates; `None` while one has no samples.
    pub(super) fn replicates(&self, pixel: usize) -> Option<[Xyz; CAMERA_REPLICATES]> {
        let (open, samples) = (self.open_means(pixel), self.open_samples);
        let Some(closed) = &self.closed else { return (!samples.contains(&0.0)).then_some(open) };
        Some(std::array::from_fn(|r| {
            let weight = if samples[r] > 0.0 { self.open_weight } else { 0.0 };
            std::array::from_fn(|c| (closed.sums[pixel][r][c] + weight * open[r][c]) / (closed.weight + weight))
        }))
    }

    /// Whether an error can be told: either there are no samples, or there are in both replicates.
    pub(super) fn replicated(&self) -> bool {
        self.closed.is_some() || self.open_samples == [0.0, 0.0] || !self.open_samples.contains(&0.0)
    }

    /// Variance of the mean of a pixel's samples, from two replicates; 0 without samples.
    pub(super) fn variance(&self, pixel: usize) -> Xyz {
        let Some([a, b]) = self.replicates(pixel) else { return [0.0; 3] };
        std::array::from_fn(|c| 0.25 * (a[c] - b[c]) * (a[c] - b[c]))
    }
}
