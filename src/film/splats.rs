//! Contributions of light paths and of merging to pixels.

use super::sensor::value;
use crate::spectrum::SampledSpectrum;

/// Values that pixels get, in their order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Splats {
    channels: usize,
    /// Row-major pixel indices.
    pixels: Vec<u32>,
    /// Values by splat and channel, already weighted by filter and wavelength density.
    values: Vec<f64>,
}

impl Splats {
    /// None yet, in so many channels.
    pub fn new(channels: usize) -> Self {
        Self { channels, ..Self::default() }
    }

    /// Splats of three channels whose values are known.
    pub fn of(splats: &[(u32, [f64; 3])]) -> Self {
        let (pixels, values): (Vec<u32>, Vec<[f64; 3]>) = splats.iter().copied().unzip();
        Self { channels: 3, pixels, values: values.into_flattened() }
    }

    /// Adds some radiance to a pixel, by the sensor's weights at the path's wavelengths.
    #[inline]
    pub fn push(&mut self, pixel: u32, weights: &[SampledSpectrum], radiance: SampledSpectrum) {
        self.pixels.push(pixel);
        self.values.extend(weights.iter().map(|&weights| value(weights, radiance)));
    }

    /// Adds `share` of some values to a pixel.
    #[inline]
    pub fn push_share(&mut self, pixel: u32, share: f64, values: &[f64]) {
        self.pixels.push(pixel);
        self.values.extend(values.iter().map(|value| value * share));
    }

    /// Adds others behind these.
    pub fn append(&mut self, mut others: Self) {
        debug_assert_eq!(self.channels, others.channels);
        self.pixels.append(&mut others.pixels);
        self.values.append(&mut others.values);
    }

    /// Forgets all, and keeps the memory.
    pub fn clear(&mut self) {
        self.pixels.clear();
        self.values.clear();
    }

    /// Each pixel with its values.
    pub fn iter(&self) -> impl Iterator<Item = (u32, &[f64])> {
        self.pixels.iter().copied().zip(self.values.chunks_exact(self.channels.max(1)))
    }
}
