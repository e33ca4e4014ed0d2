//! What `--integrator hero` does otherwise than the rest: the wavelengths and the samples of pbrt-v4, so that every gain over
//! it is measured with the same tree, sampler and roulette \[PBRT4\], \[Wilkie2014\].
//!
//! Four wavelengths a path, drawn from one density for all scenes and offset from each other by a quarter of the unit
//! interval, wrapped. The first is the hero. At the first surface whose index depends on the wavelength the others are given
//! up, even if the path is reflected there, and with them their share of all light gathered before. Samples are placed by a
//! pixel's filter and count in that pixel alone.

use crate::bsdf::BASELINE_LANES;
use crate::math;
use crate::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, LANES, SampledSpectrum, Wavelengths};

/// Wavelength where the density 1 / cosh²((λ − `PEAK_NM`) / `WIDTH_NM`) is largest.
const PEAK_NM: f64 = 538.0;
/// 1 / 0.0072 nm.
const WIDTH_NM: f64 = 1250.0 / 9.0;

fn tanh(x: f64) -> f64 {
    let e = math::exp_m1(2.0 * x);
    e / (e + 2.0)
}

/// Wavelengths for a random number: the first four lanes carry the path, the others are copies without weight.
pub fn wavelengths(u: f32) -> Wavelengths {
    let (low, high) = (tanh((LAMBDA_MIN_NM - PEAK_NM) / WIDTH_NM), tanh((LAMBDA_MAX_NM - PEAK_NM) / WIDTH_NM));
    let (mut lambda_nm, mut pdf) = ([0.0; LANES], [0.0; LANES]);
    for lane in 0..LANES {
        let v = (f64::from(u) + (lane % BASELINE_LANES) as f64 / BASELINE_LANES as f64).fract();
        let t = low + (high - low) * v;
        // atanh t = ½ ln((1 + t) / (1 − t)); 1 / cosh² = 1 − tanh².
        let lambda = PEAK_NM + 0.5 * WIDTH_NM * math::ln((1.0 + t) / (1.0 - t));
        lambda_nm[lane] = lambda.clamp(LAMBDA_MIN_NM, LAMBDA_MAX_NM) as f32;
        pdf[lane] = ((1.0 - t * t) / (WIDTH_NM * (high - low))) as f32;
    }
    Wavelengths { lambda_nm, pdf }
}

/// What a path starts with: the film divides by eight lanes.
pub fn throughput() -> SampledSpectrum {
    let share = LANES as f32 / BASELINE_LANES as f32;
    SampledSpectrum::from_fn(|lane| if lane < BASELINE_LANES { share } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_four_lanes_estimate_integrals() {
        let n = 4096;
        let (mut area, mut moment) = (0.0, 0.0);
        for i in 0..n {
            let w = wavelengths((i as f32 + 0.5) / n as f32);
            for (lane, share) in throughput().lanes().into_iter().enumerate() {
                let weight = f64::from(share) / f64::from(w.pdf[lane]) / LANES as f64 / f64::from(n);
                area += weight;
                moment += weight * f64::from(w.lambda_nm[lane]);
            }
        }
        assert!((area - 470.0).abs() < 1e-2, "{area}");
        assert!((moment / area - 595.0).abs() < 1e-2, "{}", moment / area);
    }
}
