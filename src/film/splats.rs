//! Contributions of light paths and of merging to pixels.

use super::sensor::value;
use crate::spectrum::SampledSpectrum;

/// Contributions in the order in which they were found. Each has a value in every channel, and the pixels that the filter
/// reaches from where it falls on the film get shares of that.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Splats {
    channels: usize,
    /// Values by contribution and channel, already weighted by wavelength density.
    values: Vec<f64>,
    /// The shares of all contributions, one contribution after the other.
    shares: Vec<Share>,
    /// Where each contribution's shares begin.
    starts: Vec<usize>,
}

/// What a pixel gets of a contribution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Share {
    /// Row-major index of the pixel.
    pub pixel: u32,
    /// Factor of the contribution's values.
    pub share: f32,
}

impl Splats {
    /// Makes room for contributions in so many channels.
    pub fn new(channels: usize) -> Self {
        Self { channels, ..Self::default() }
    }

    /// Makes contributions of three channels whose values are known, each to one pixel.
    pub fn of(splats: &[(u32, [f64; 3])]) -> Self {
        let mut made = Self::new(3);
        for (pixel, values) in splats {
            made.starts.push(made.shares.len());
            made.values.extend(values);
            made.share(*pixel, 1.0);
        }
        made
    }

    /// Adds a contribution of some radiance, by the sensor's weights at the path's wavelengths. [`Self::share`] tells who
    /// gets it.
    #[inline]
    pub fn begin(&mut self, weights: &[SampledSpectrum], radiance: SampledSpectrum) {
        self.starts.push(self.shares.len());
        self.values.extend(weights.iter().map(|&weights| value(weights, radiance)));
    }

    /// Gives a pixel a share of the last contribution.
    #[inline]
    pub fn share(&mut self, pixel: u32, share: f32) {
        self.shares.push(Share { pixel, share });
    }

    /// Adds others behind these.
    pub fn append(&mut self, mut others: Self) {
        debug_assert_eq!(self.channels, others.channels);
        let before = self.shares.len();
        self.starts.extend(others.starts.iter().map(|start| before + start));
        self.shares.append(&mut others.shares);
        self.values.append(&mut others.values);
    }

    /// Forgets all contributions, and keeps the memory.
    pub fn clear(&mut self) {
        self.starts.clear();
        self.shares.clear();
        self.values.clear();
    }

    /// Lists the contributions: the values of each and their shares.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (&[f64], &[Share])> {
        let ends = self.starts.iter().skip(1).copied().chain([self.shares.len()]);
        let shares = self.starts.iter().zip(ends).map(|(&start, end)| &self.shares[start..end]);
        self.values.chunks_exact(self.channels.max(1)).zip(shares)
    }
}
