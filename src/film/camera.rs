//! The part of the picture that camera samples make, in stages.
//!
//! What samples count in a pixel adds up to their number on average, but not exactly, where a filter decides it. That error
//! is known, and taken off at the brightness that the other replicate has found: as this is independent of it, the mean
//! stays what it was, and where the picture is even there is no noise at all. A quotient of both sums would be biased.

use super::tile::stride;
use super::{CAMERA_REPLICATES, CameraTile, PICTURE_CHANNELS, Xyz};
use rayon::prelude::*;

/// Rows of the film that tiles are added to at a time.
const BAND: usize = 16;

/// Stages of a render whose numbers of samples differ from place to place, by what earlier stages have shown. The mean of
/// a pixel is that of its means in all stages with weights that do not depend on what was found: so a stage that stopped
/// early because it missed something does not pull the mean down.
#[derive(Debug, Clone, PartialEq)]
struct ClosedStages {
    /// Sums over stages of weight times mean, by pixel, replicate and channel.
    sums: Vec<f64>,
    weight: f64,
}

impl ClosedStages {
    /// Makes sums of no stage.
    fn empty(numbers: usize) -> Self {
        Self { sums: vec![0.0; numbers], weight: 0.0 }
    }
}

/// Samples of a pixel in each replicate.
pub type CameraSamples = [f64; CAMERA_REPLICATES];

/// What camera samples have given so far.
#[derive(Debug, Clone, PartialEq)]
pub struct CameraPart {
    channels: usize,
    /// Sums since the last stage, see [`super::tile::stride`].
    sums: Vec<f64>,
    /// What to divide them by: so many samples of each pixel in each replicate.
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
    pub(super) fn new(pixels: usize, channels: usize) -> Self {
        Self {
            channels,
            sums: vec![0.0; pixels * stride(channels)],
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
        let stride = stride(self.channels);
        self.sums.par_chunks_mut(BAND * width * stride).enumerate().for_each(|(band, sums)| {
            let first = (band * BAND) as i32;
            let rows = first..first + (sums.len() / (width * stride)) as i32;
            for tile in tiles {
                let ([x, y], [tile_width, tile_height]) = (tile.corner, tile.size.map(|size| size as i32));
                let columns = x.max(0)..(x + tile_width).min(width as i32);
                if columns.is_empty() {
                    continue;
                }
                for row in rows.start.max(y)..rows.end.min(y + tile_height) {
                    let from = stride * ((row - y) * tile_width + columns.start - x) as usize;
                    let to = stride * ((row - first) as usize * width + columns.start as usize);
                    let added = &tile.sums[from..from + stride * columns.len()];
                    sums[to..].iter_mut().zip(added).for_each(|(sum, added)| *sum += added);
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

    /// Counts all camera samples taken.
    pub fn paths(&self) -> u64 {
        self.beyond + self.counts.iter().sum::<u64>()
    }

    /// Returns the number of camera samples in the square of a pixel.
    pub fn samples(&self, pixel: usize) -> u64 {
        self.counts[pixel]
    }

    /// Ends a stage, which has samples in both replicates: samples from here on are another.
    pub fn close_stage(&mut self) {
        let (pixels, channels) = (self.counts.len(), self.channels);
        let mut closed =
            self.closed.take().unwrap_or_else(|| ClosedStages::empty(pixels * CAMERA_REPLICATES * channels));
        for (pixel, sums) in closed.sums.chunks_exact_mut(CAMERA_REPLICATES * channels).enumerate() {
            for channel in 0..channels {
                let means = self.open_means::<1>(pixel, channel);
                (0..CAMERA_REPLICATES).for_each(|r| sums[r * channels + channel] += self.open_weight * means[r][0]);
            }
        }
        closed.weight += self.open_weight;
        self.closed = Some(closed);
        self.sums.fill(0.0);
        self.weigh_open_stage(CameraSamples::default(), 0.0);
    }

    /// Returns the means of a pixel's replicates in the open stage, in `N` channels from `first` on; 0 without samples.
    #[inline]
    fn open_means<const N: usize>(&self, pixel: usize, first: usize) -> [[f64; N]; CAMERA_REPLICATES] {
        let length = self.channels + 1;
        let rows: [&[f64]; CAMERA_REPLICATES] =
            std::array::from_fn(|r| &self.sums[(pixel * CAMERA_REPLICATES + r) * length..][..length]);
        let (weights, sums) = (rows.map(|row| row[0]), rows.map(|row| channels_of::<N>(row, 1 + first)));
        let samples = self.open_samples;
        std::array::from_fn(|r| {
            let (n, other) = (samples[r], 1 - r);
            if n == 0.0 {
                return [0.0; N];
            }
            // Without another replicate there is only the brightness that this one has found.
            let by = if samples[other] > 0.0 { other } else { r };
            let brightness = |c: usize| if weights[by] > 0.0 { sums[by][c] / weights[by] } else { 0.0 };
            std::array::from_fn(|c| (sums[r][c] - brightness(c) * (weights[r] - n)) / n)
        })
    }

    /// Returns the mean of a pixel's camera samples in `N` channels from `first` on.
    pub(super) fn mean<const N: usize>(&self, pixel: usize, first: usize) -> [f64; N] {
        let (means, samples) = (self.open_means::<N>(pixel, first), self.open_samples);
        let taken: f64 = samples.iter().sum();
        let open = |c: usize| {
            let sum: f64 = means.iter().zip(samples).map(|(mean, samples)| samples * mean[c]).sum();
            if taken > 0.0 { sum / taken } else { 0.0 }
        };
        let Some(closed) = &self.closed else { return std::array::from_fn(open) };
        let weight = if taken > 0.0 { self.open_weight } else { 0.0 };
        let sums = self.closed_sums::<N>(closed, pixel, first);
        let before = |c: usize| sums.iter().map(|sums| sums[c]).sum::<f64>() / CAMERA_REPLICATES as f64;
        std::array::from_fn(|c| (before(c) + weight * open(c)) / (closed.weight + weight))
    }

    /// Returns the means of a pixel's replicates in `N` channels from `first` on; `None` while one has no samples.
    pub(super) fn replicates<const N: usize>(
        &self,
        pixel: usize,
        first: usize,
    ) -> Option<[[f64; N]; CAMERA_REPLICATES]> {
        let (open, samples) = (self.open_means::<N>(pixel, first), self.open_samples);
        let Some(closed) = &self.closed else { return (!samples.contains(&0.0)).then_some(open) };
        let sums = self.closed_sums::<N>(closed, pixel, first);
        Some(std::array::from_fn(|r| {
            let weight = if samples[r] > 0.0 { self.open_weight } else { 0.0 };
            std::array::from_fn(|c| (sums[r][c] + weight * open[r][c]) / (closed.weight + weight))
        }))
    }

    /// Returns what closed stages gave in a pixel's replicates, times their weight.
    fn closed_sums<'c, const N: usize>(
        &self,
        closed: &'c ClosedStages,
        pixel: usize,
        first: usize,
    ) -> [&'c [f64; N]; CAMERA_REPLICATES] {
        let row = &closed.sums[pixel * CAMERA_REPLICATES * self.channels..];
        std::array::from_fn(|r| channels_of(row, r * self.channels + first))
    }

    /// Whether an error can be told: either there are no samples, or there are in both replicates.
    pub(super) fn replicated(&self) -> bool {
        self.closed.is_some() || self.open_samples == [0.0, 0.0] || !self.open_samples.contains(&0.0)
    }

    /// Returns the variance of the mean of a pixel's samples in the channels of the picture, from two replicates; 0 without
    /// samples.
    pub(super) fn variance(&self, pixel: usize) -> Xyz {
        let Some([a, b]) = self.replicates::<PICTURE_CHANNELS>(pixel, 0) else { return [0.0; PICTURE_CHANNELS] };
        std::array::from_fn(|c| 0.25 * (a[c] - b[c]) * (a[c] - b[c]))
    }
}

/// Returns `N` entries of a row from `first` on.
fn channels_of<const N: usize>(row: &[f64], first: usize) -> &[f64; N] {
    row[first..].first_chunk().expect("a row holds all channels of the film")
}
