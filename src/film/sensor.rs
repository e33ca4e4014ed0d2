//! Turns radiance at a path's wavelengths into the channels of the film. No other place divides by a wavelength's density.

use super::Xyz;
use crate::color::Observer;
use crate::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, LANES, SampledSpectrum, Wavelengths};
use wide::f32x4;

/// Channels that the picture is made of and that errors are judged by: an observer's X, Y and Z come first in every sensor.
pub const PICTURE_CHANNELS: usize = 3;

/// Channels that are computed at once. The last group of a wavelength is filled up with zeros.
const GROUP: usize = 4;

/// What a film records: an observer's X, Y and Z, and any further channels, each the integral of radiance with a response
/// curve. X = ∫ L x̄ dλ / ∫ ȳ dλ, so that a radiance of 1 everywhere gives Y = 1.
#[derive(Debug, Clone)]
pub struct Sensor {
    /// Response curves at `first_nm`, `first_nm` + 1, …: for each wavelength the responses of all channels, in groups.
    curves: Vec<[f32; GROUP]>,
    channels: usize,
    first_nm: f32,
    name: &'static str,
}

impl Sensor {
    /// Makes a sensor with the colour matching functions of a standard observer.
    pub fn of_observer(observer: &Observer) -> Self {
        let matching: Vec<Xyz> =
            (LAMBDA_MIN_NM as u32..=LAMBDA_MAX_NM as u32).map(|l| observer.eval(f64::from(l)).to_array()).collect();
        Self { name: observer.name(), ..Self::new(LAMBDA_MIN_NM, &matching) }
    }

    /// Makes a sensor from colour matching functions at 1 nm steps, which are linear in between.
    pub fn new(first_nm: f64, matching: &[Xyz]) -> Self {
        let y: f64 = matching.windows(2).map(|w| 0.5 * (w[0][1] + w[1][1])).sum();
        let normalised = |m: &Xyz| [(m[0] / y) as f32, (m[1] / y) as f32, (m[2] / y) as f32, 0.0];
        let curves = matching.iter().map(normalised).collect();
        Self { curves, channels: PICTURE_CHANNELS, first_nm: first_nm as f32, name: "" }
    }

    /// Adds channels after those that there are. `response(channel, nm)` is the factor of radiance under the integral over
    /// wavelength in nm; it is read at 1 nm steps and linear in between.
    pub fn with_channels(mut self, added: usize, response: impl Fn(usize, f64) -> f64) -> Self {
        let channels = self.channels + added;
        let of_wavelength = |(step, groups): (usize, &[[f32; GROUP]])| {
            let nm = f64::from(self.first_nm) + step as f64;
            let mut responses = groups.as_flattened()[..self.channels].to_vec();
            responses.extend((0..added).map(|channel| response(channel, nm) as f32));
            responses.resize(channels.next_multiple_of(GROUP), 0.0);
            responses
        };
        let responses: Vec<f32> = self.curves.chunks_exact(self.groups()).enumerate().flat_map(of_wavelength).collect();
        self.curves = responses.as_chunks().0.to_vec();
        self.channels = channels;
        self
    }

    fn groups(&self) -> usize {
        self.channels.div_ceil(GROUP)
    }

    /// How many channels there are.
    pub fn channels(&self) -> usize {
        self.channels
    }

    /// Returns the observer's name, which is empty unless the observer is a standard one.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// Computes the factor of each lane's radiance in each channel: response / (8 pdf).
    #[inline]
    pub fn weights(&self, wavelengths: &Wavelengths, weights: &mut Vec<SampledSpectrum>) {
        weights.resize(self.channels, SampledSpectrum::ZERO);
        match self.groups() {
            1 => self.fill_weights::<1>(1, wavelengths, weights),
            groups => self.fill_weights::<0>(groups, wavelengths, weights),
        }
    }

    /// `GROUPS` is the number of groups of channels if the compiler is to know it, else 0.
    #[inline(always)]
    fn fill_weights<const GROUPS: usize>(
        &self,
        groups: usize,
        wavelengths: &Wavelengths,
        weights: &mut [SampledSpectrum],
    ) {
        let groups = if GROUPS > 0 { GROUPS } else { groups };
        let rows = self.curves.len() / groups;
        let shares = wavelengths.pdf.map(|pdf| 1.0 / (LANES as f32 * pdf));
        for (group, weights) in weights.chunks_mut(GROUP).enumerate() {
            let responses = |k: usize| {
                let x = (wavelengths.lambda_nm[k] - self.first_nm).clamp(0.0, (rows - 1) as f32);
                let i = (x as usize).min(rows - 2);
                let below = f32x4::from(self.curves[i * groups + group]);
                let above = f32x4::from(self.curves[(i + 1) * groups + group]);
                (below + (above - below) * (x - i as f32)) * shares[k]
            };
            let halves = [0, GROUP].map(|first| f32x4::transpose(std::array::from_fn(|k| responses(first + k))));
            for (c, weight) in weights.iter_mut().enumerate() {
                *weight = SampledSpectrum::new(
                    *halves.map(|half| half[c].to_array()).as_flattened().first_chunk().expect("eight lanes"),
                );
            }
        }
    }
}

/// Returns what some radiance adds to a channel, by the weights of that channel.
#[inline]
pub fn value(weights: SampledSpectrum, radiance: SampledSpectrum) -> f64 {
    f64::from((weights * radiance).sum())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::WavelengthDensity;

    #[test]
    fn unit_radiance_gives_unit_y() {
        let l: Vec<f64> = (360..=830).map(f64::from).collect();
        let bell = |l: f64, m: f64| crate::math::exp(-(l - m) * (l - m) / 4000.0);
        let matching: Vec<Xyz> = l.iter().map(|&l| [bell(l, 600.0), bell(l, 555.0), 1.7 * bell(l, 450.0)]).collect();
        let sensor = Sensor::new(360.0, &matching);
        let density =
            WavelengthDensity::new(&l, &vec![1.0; 471], &l.iter().map(|&l| bell(l, 540.0)).collect::<Vec<_>>());
        let n = 2048;
        let (mut mean, mut weights) = ([0.0; 3], Vec::new());
        for i in 0..n {
            let w = density.sample((i as f32 + 0.5) / n as f32);
            sensor.weights(&w, &mut weights);
            (0..3).for_each(|c| mean[c] += value(weights[c], SampledSpectrum::ONE) / f64::from(n));
        }
        let area = |c: usize| matching.windows(2).map(|w| 0.5 * (w[0][c] + w[1][c])).sum::<f64>();
        for (c, mean) in mean.into_iter().enumerate() {
            assert!((mean - area(c) / area(1)).abs() < 1e-4, "{c}: {mean} {}", area(c) / area(1));
        }
    }
}
