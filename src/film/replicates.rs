//! Parts of a picture that are estimated as a whole: their errors span pixels.

use super::{LIGHT_REPLICATES, PICTURE_CHANNELS, Splats};

/// A part of the picture that is estimated as a whole, with a sum for each replicate.
#[derive(Debug, Clone, PartialEq)]
pub struct Replicates {
    channels: usize,
    /// Sums by pixel and channel; empty until there is something to add.
    pub sums: [Vec<f64>; LIGHT_REPLICATES],
    /// What to divide the sums by.
    pub counts: [f64; LIGHT_REPLICATES],
}

impl Replicates {
    /// Nothing yet, in so many channels.
    pub fn new(channels: usize) -> Self {
        Self { channels, sums: Default::default(), counts: Default::default() }
    }

    /// Adds splats, each times `weight`, and to the count. Returns how many were not finite, and left out.
    pub fn add(&mut self, pixels: usize, replicate: usize, count: f64, weight: f64, splats: &Splats) -> u64 {
        let sums = &mut self.sums[replicate];
        if sums.is_empty() {
            sums.resize(pixels * self.channels, 0.0);
        }
        let lost = splats.iter().filter(|(pixel, values)| {
            let sums = &mut sums[*pixel as usize * self.channels..][..self.channels];
            match (<&mut [f64; PICTURE_CHANNELS]>::try_from(&mut *sums), <&[f64; PICTURE_CHANNELS]>::try_from(*values))
            {
                (Ok(sums), Ok(values)) => !add_finite(sums, values, weight),
                _ => !add_finite(sums, values, weight),
            }
        });
        let lost = lost.count() as u64;
        self.counts[replicate] += count;
        lost
    }

    /// Sum of one replicate in a channel of a pixel.
    pub fn sum(&self, replicate: usize, pixel: usize, channel: usize) -> f64 {
        self.sums[replicate][pixel * self.channels + channel]
    }

    /// Replicates that have samples.
    pub fn used(&self) -> Vec<usize> {
        (0..LIGHT_REPLICATES).filter(|&r| self.counts[r] > 0.0).collect()
    }

    pub fn mean(&self, pixel: usize, channel: usize) -> f64 {
        let sum: f64 = self.sums.iter().filter(|s| !s.is_empty()).map(|s| s[pixel * self.channels + channel]).sum();
        let count: f64 = self.counts.iter().sum();
        if count > 0.0 { sum / count } else { 0.0 }
    }

    /// Variance of the mean in one channel of a pixel.
    pub fn variance(&self, pixel: usize, channel: usize, used: &[usize]) -> f64 {
        let n = used.len() as f64;
        if used.is_empty() {
            return 0.0;
        }
        let mean_of = |r: usize| self.sum(r, pixel, channel) / self.counts[r];
        let mean = used.iter().map(|&r| mean_of(r)).sum::<f64>() / n;
        used.iter().map(|&r| (mean_of(r) - mean) * (mean_of(r) - mean)).sum::<f64>() / (n * (n - 1.0))
    }
}

/// Adds values times `weight`, or none of them where one is not finite then; tells whether it has.
#[inline(always)]
fn add_finite(sums: &mut [f64], values: &[f64], weight: f64) -> bool {
    let finite = values.iter().all(|v| (v * weight).is_finite());
    if finite {
        sums.iter_mut().zip(values).for_each(|(sum, v)| *sum += v * weight);
    }
    finite
}
