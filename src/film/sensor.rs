//! From radiance at a path's wavelengths to XYZ. The only place that divides by a wavelength's density.

use super::Xyz;
use crate::color::Observer;
use crate::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, LANES, SampledSpectrum, Wavelengths};

/// A colour observer at 1 nm: X = ∫ L x̄ dλ / ∫ ȳ dλ, so that a radiance of 1 everywhere gives Y = 1.
#[derive(Debug, Clone)]
pub struct Sensor {
    /// x̄, ȳ, z̄ divided by ∫ ȳ dλ, at `first_nm`, `first_nm` + 1, …
    matching: Vec<[f32; 4]>,
    first_nm: f32,
    name: &'static str,
}

impl Sensor {
    /// The colour matching functions of a standard observer.
    pub fn of_observer(observer: &Observer) -> Self {
        let matching: Vec<Xyz> =
            (LAMBDA_MIN_NM as u32..=LAMBDA_MAX_NM as u32).map(|l| observer.eval(f64::from(l)).to_array()).collect();
        Self { name: observer.name(), ..Self::new(LAMBDA_MIN_NM, &matching) }
    }

    /// The observer's name; empty if it is no standard one.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// From colour matching functions at 1 nm steps, linear in between.
    pub fn new(first_nm: f64, matching: &[Xyz]) -> Self {
        let y: f64 = matching.windows(2).map(|w| 0.5 * (w[0][1] + w[1][1])).sum();
        let normalised = |m: &Xyz| [(m[0] / y) as f32, (m[1] / y) as f32, (m[2] / y) as f32, 0.0];
        Self { matching: matching.iter().map(normalised).collect(), first_nm: first_nm as f32, name: "" }
    }

    /// The factor of each lane's radiance in X, Y and Z: matching function / (8 pdf).
    pub fn weights(&self, wavelengths: &Wavelengths) -> [SampledSpectrum; 3] {
        let mut weights = [[0.0; LANES]; 3];
        for (k, (lambda_nm, pdf)) in wavelengths.lambda_nm.into_iter().zip(wavelengths.pdf).enumerate() {
            let x = (lambda_nm - self.first_nm).clamp(0.0, (self.matching.len() - 1) as f32);
            let i = (x as usize).min(self.matching.len() - 2);
            let (a, b, t) = (self.matching[i], self.matching[i + 1], x - i as f32);
            let share = 1.0 / (LANES as f32 * pdf);
            for (c, weight) in weights.iter_mut().enumerate() {
                weight[k] = (a[c] + (b[c] - a[c]) * t) * share;
            }
        }
        weights.map(SampledSpectrum::new)
    }

    /// XYZ of a sample's radiance.
    pub fn xyz(weights: &[SampledSpectrum; 3], radiance: SampledSpectrum) -> Xyz {
        weights.map(|w| f64::from((w * radiance).sum()))
    }
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
        let mut mean = [0.0; 3];
        for i in 0..n {
            let w = density.sample((i as f32 + 0.5) / n as f32);
            let xyz = Sensor::xyz(&sensor.weights(&w), SampledSpectrum::ONE);
            (0..3).for_each(|c| mean[c] += xyz[c] / f64::from(n));
        }
        let area = |c: usize| matching.windows(2).map(|w| 0.5 * (w[0][c] + w[1][c])).sum::<f64>();
        for (c, mean) in mean.into_iter().enumerate() {
            assert!((mean - area(c) / area(1)).abs() < 1e-4, "{c}: {mean} {}", area(c) / area(1));
        }
    }
}
