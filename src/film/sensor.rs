//! Turns radiance at a path's wavelengths into the channels of the film. No other place divides by a wavelength's density.

use super::Xyz;
use crate::color::Observer;
use crate::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, LANES, SampledSpectrum, Wavelengths};

/// Channels that the picture is made of and that errors are judged by: an observer's X, Y and Z come first in every sensor.
pub const PICTURE_CHANNELS: usize = 3;

/// Entries of a row of curves are padded to a multiple of this.
const ROW: usize = 4;

/// What a film records: an observer's X, Y and Z, and any further channels, each the integral of radiance with a response
/// curve. X = ∫ L x̄ dλ / ∫ ȳ dλ, so that a radiance of 1 everywhere gives Y = 1.
#[derive(Debug, Clone)]
pub struct Sensor {
    /// Response curves at `first_nm`, `first_nm` + 1, …: rows of `stride` entries, of which `channels` are used.
    curves: Vec<f32>,
    channels: usize,
    stride: usize,
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
        let curves = matching.iter().flat_map(normalised).collect();
        Self { curves, channels: PICTURE_CHANNELS, stride: ROW, first_nm: first_nm as f32, name: "" }
    }

    /// Adds channels after those that there are. `response(channel, nm)` is the factor of radiance under the integral over
    /// wavelength in nm; it is read at 1 nm steps and linear in between.
    pub fn with_channels(mut self, added: usize, response: impl Fn(usize, f64) -> f64) -> Self {
        let (channels, stride) = (self.channels + added, (self.channels + added).next_multiple_of(ROW));
        let mut curves = Vec::with_capacity(self.curves.len() / self.stride * stride);
        for (step, row) in self.curves.chunks_exact(self.stride).enumerate() {
            let nm = f64::from(self.first_nm) + step as f64;
            curves.extend_from_slice(&row[..self.channels]);
            curves.extend((0..added).map(|channel| response(channel, nm) as f32));
            curves.resize((step + 1) * stride, 0.0);
        }
        (self.curves, self.channels, self.stride) = (curves, channels, stride);
        self
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
    pub fn weights(&self, wavelengths: &Wavelengths, weights: &mut Vec<SampledSpectrum>) {
        weights.resize(self.channels, SampledSpectrum::ZERO);
        match <&mut [SampledSpectrum; PICTURE_CHANNELS]>::try_from(weights.as_mut_slice()) {
            Ok(weights) => self.fill_weights(wavelengths, weights),
            Err(_) => self.fill_weights(wavelengths, weights),
        }
    }

    /// Its length is known to the compiler where there are as many channels as the picture has.
    #[inline(always)]
    fn fill_weights(&self, wavelengths: &Wavelengths, weights: &mut (impl AsMut<[SampledSpectrum]> + ?Sized)) {
        let rows = self.curves.len() / self.stride;
        let mut at = [(0, 0.0, 0.0); LANES];
        for (k, (lambda_nm, pdf)) in wavelengths.lambda_nm.into_iter().zip(wavelengths.pdf).enumerate() {
            let x = (lambda_nm - self.first_nm).clamp(0.0, (rows - 1) as f32);
            let i = (x as usize).min(rows - 2);
            at[k] = (i * self.stride, x - i as f32, 1.0 / (LANES as f32 * pdf));
        }
        for (c, weight) in weights.as_mut().iter_mut().enumerate() {
            *weight = SampledSpectrum::from_fn(|k| {
                let (row, t, share) = at[k];
                let (a, b) = (self.curves[row + c], self.curves[row + self.stride + c]);
                (a + (b - a) * t) * share
            });
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
