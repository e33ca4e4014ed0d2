//! The wavelengths of a path and how they are drawn.

use super::LANES;
use crate::sampling::QuantileDensity;

/// The wavelengths of a path with their densities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wavelengths {
    /// Wavelengths, nm, ascending.
    pub lambda_nm: [f32; LANES],
    /// Density of each, nm⁻¹: lane k carries P⁻¹((k + u) / 8), and averaging over lanes makes 1 / (8 pdf) its weight.
    pub pdf: [f32; LANES],
}

/// The density that wavelengths are drawn from: light × observer, mixed with two defensive shares so that no weight is
/// unbounded where the lights of a scene happen to be dark.
#[derive(Debug, Clone)]
pub struct WavelengthDensity(QuantileDensity);

/// Share of the observer alone.
const OBSERVER_SHARE: f64 = 0.08;
/// Share of the uniform density over the whole range.
const UNIFORM_SHARE: f64 = 0.02;

impl WavelengthDensity {
    /// Makes the density of a light's spectrum and an observer's sensitivity at the same strictly ascending knots (nm).
    pub fn new(lambda_nm: &[f64], light: &[f64], sensitivity: &[f64]) -> Self {
        let product: Vec<f64> = light.iter().zip(sensitivity).map(|(l, s)| l * s).collect();
        let integral = |v: &[f64]| -> f64 {
            lambda_nm.windows(2).zip(v.windows(2)).map(|(l, v)| (l[1] - l[0]) * (v[0] + v[1]) * 0.5).sum()
        };
        let (of_product, of_sensitivity) = (integral(&product), integral(sensitivity));
        let range = lambda_nm[lambda_nm.len() - 1] - lambda_nm[0];
        let matched = 1.0 - OBSERVER_SHARE - UNIFORM_SHARE;
        let weights: Vec<f64> = product
            .iter()
            .zip(sensitivity)
            .map(|(p, s)| {
                let observer = s / of_sensitivity;
                let light = if of_product > 0.0 { p / of_product } else { observer };
                matched * light + OBSERVER_SHARE * observer + UNIFORM_SHARE / range
            })
            .collect();
        Self(QuantileDensity::new(lambda_nm, &weights))
    }

    /// Lane k is P⁻¹((k + u) / 8): the lanes are stratified among themselves, and with the samples of the pixel through u.
    pub fn sample(&self, u: f32) -> Wavelengths {
        let (lambda_nm, pdf) = self.0.sample_many(std::array::from_fn(|k| (k as f32 + u) * (1.0 / LANES as f32)));
        Wavelengths { lambda_nm, pdf }
    }

    /// Density at a wavelength, nm⁻¹.
    pub fn density(&self, lambda_nm: f32) -> f32 {
        self.0.density(lambda_nm)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::Sobol;

    fn density() -> WavelengthDensity {
        let l: Vec<f64> = (360..=830).map(f64::from).collect();
        let light: Vec<f64> = l.iter().map(|&l| if (l - 546.0).abs() < 2.0 { 50.0 } else { 0.2 }).collect();
        let eye: Vec<f64> = l.iter().map(|&l| crate::math::exp(-(l - 550.0) * (l - 550.0) / 5000.0)).collect();
        WavelengthDensity::new(&l, &light, &eye)
    }

    /// Every (hero, octile of u) cell fills, and evenly: the hero comes from a dimension of its own.
    #[test]
    fn every_hero_meets_every_octile() {
        let sobol = Sobol::new(5);
        let mut cells = [[0u32; 8]; 8];
        for i in 0..4096 {
            let p = sobol.group(i, 0);
            cells[(p[3] * 8.0) as usize][(p[2] * 8.0) as usize] += 1;
        }
        assert!(cells.iter().flatten().all(|&n| (32..=96).contains(&n)), "{cells:?}");
    }

    /// The estimator ∫ f dλ = E[mean of f/p] is exact on average, and the defensive shares bound every weight.
    #[test]
    fn lanes_estimate_integrals() {
        let density = density();
        let n = 4096;
        let mut sum = 0.0;
        for i in 0..n {
            let w = density.sample((i as f32 + 0.5) / n as f32);
            assert!(w.lambda_nm.windows(2).all(|l| l[0] <= l[1]));
            assert!(w.pdf.iter().all(|&p| p >= 0.999 * 0.02 / 470.0));
            for (l, p) in w.lambda_nm.iter().zip(w.pdf) {
                assert!((360.0..=830.0).contains(l));
                sum += f64::from(l / 100.0) / f64::from(p) / 8.0 / n as f64;
            }
        }
        let exact = (8.3f64 * 8.3 - 3.6 * 3.6) / 2.0 * 100.0;
        assert!((sum / exact - 1.0).abs() < 1e-3, "{sum} {exact}");
    }
}
