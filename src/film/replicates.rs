//! Parts of a picture that are estimated as a whole: their errors span pixels.

use super::splats::Share;
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
    /// Makes room for sums in so many channels.
    pub fn new(channels: usize) -> Self {
        Self { channels, sums: Default::default(), counts: Default::default() }
    }

    /// Adds contributions, each times `weight`, and to the count. Returns how many values were not finite, and left out.
    pub fn add(&mut self, pixels: usize, replicate: usize, count: f64, weight: f64, splats: &Splats) -> u64 {
        let channels = self.channels;
        let sums = &mut self.sums[replicate];
        if sums.is_empty() {
            sums.resize(pixels * channels, 0.0);
        }
        self.counts[replicate] += count;
        let mut lost = 0;
        for (values, shares) in splats.iter() {
            if !values.iter().all(|value| value.is_finite()) {
                lost += shares.len() as u64;
                continue;
            }
            match <[f64; PICTURE_CHANNELS]>::try_from(values) {
                Ok(values) => add_shares(sums, &values, shares, weight),
                Err(_) => add_shares(sums, values, shares, weight),
            }
        }
        lost
    }

    /// Returns the sum of one replicate in a channel of a pixel.
    pub fn sum(&self, replicate: usize, pixel: usize, channel: usize) -> f64 {
        self.sums[replicate][pixel * self.channels + channel]
    }

    /// Lists the replicates that have samples.
    pub fn used(&self) -> Vec<usize> {
        (0..LIGHT_REPLICATES).filter(|&r| self.counts[r] > 0.0).collect()
    }

    /// Returns the mean over all that has been counted, in a channel of a pixel; 0 if nothing has been.
    pub fn mean(&self, pixel: usize, channel: usize) -> f64 {
        let count: f64 = self.counts.iter().sum();
        if count == 0.0 {
            return 0.0;
        }
        let sum: f64 = self.sums.iter().filter(|s| !s.is_empty()).map(|s| s[pixel * self.channels + channel]).sum();
        sum / count
    }

    /// Returns the variance of the mean in one channel of a pixel.
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

/// Adds the shares of a contribution. The number of its values is known to the compiler where they come as an array.
#[inline(always)]
fn add_shares(sums: &mut [f64], values: &(impl AsRef<[f64]> + ?Sized), shares: &[Share], weight: f64) {
    let values = values.as_ref();
    for &Share { pixel, share } in shares {
        let sums = &mut sums[pixel as usize * values.len()..][..values.len()];
        sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += value * f64::from(share) * weight);
    }
}
