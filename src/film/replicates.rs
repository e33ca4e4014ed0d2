//! Parts of a picture that are estimated as a whole: their errors span pixels.

use super::{LIGHT_REPLICATES, Splat, Xyz};

/// A part of the picture that is estimated as a whole, with a sum for each replicate.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Replicates {
    /// Pixel sums; empty until there is something to add.
    pub sums: [Vec<Xyz>; LIGHT_REPLICATES],
    /// What to divide the sums by.
    pub counts: [f64; LIGHT_REPLICATES],
}

impl Replicates {
    /// Adds to pixels and to the count; the number of values that were not finite, and left out.
    pub fn add(&mut self, pixels: usize, replicate: usize, count: f64, splats: impl Iterator<Item = Splat>) -> u64 {
        let sums = &mut self.sums[replicate];
        if sums.is_empty() {
            sums.resize(pixels, [0.0; 3]);
        }
        let mut lost = 0;
        for splat in splats {
            if splat.xyz.iter().all(|v| v.is_finite()) {
                let pixel = &mut sums[splat.pixel as usize];
                for (sum, v) in pixel.iter_mut().zip(splat.xyz) {
                    *sum += v;
                }
            } else {
                lost += 1;
            }
        }
        self.counts[replicate] += count;
        lost
    }

    /// Replicates that have samples.
    pub fn used(&self) -> Vec<usize> {
        (0..LIGHT_REPLICATES).filter(|&r| self.counts[r] > 0.0).collect()
    }

    pub fn mean(&self, pixel: usize, channel: usize) -> f64 {
        let sum: f64 = self.sums.iter().filter(|s| !s.is_empty()).map(|s| s[pixel][channel]).sum();
        let count: f64 = self.counts.iter().sum();
        if count > 0.0 { sum / count } else { 0.0 }
    }

    /// Variance of the mean in one channel of a pixel.
    pub fn variance(&self, pixel: usize, channel: usize, used: &[usize]) -> f64 {
        let n = used.len() as f64;
        if used.is_empty() {
            return 0.0;
        }
        let mean_of = |r: usize| self.sums[r][pixel][channel] / self.counts[r];
        let mean = used.iter().map(|&r| mean_of(r)).sum::<f64>() / n;
        used.iter().map(|&r| (mean_of(r) - mean) * (mean_of(r) - mean)).sum::<f64>() / (n * (n - 1.0))
    }
}
