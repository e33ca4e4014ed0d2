//! Absorption along a path by the Beer–Lambert law.

use crate::math;
use crate::spectrum::SampledSpectrum;

/// Share of light left after `distance` in a medium with absorption coefficient `absorption` (per unit of `distance`).
pub fn transmittance(absorption: SampledSpectrum, distance: f32) -> SampledSpectrum {
    SampledSpectrum::new((absorption * distance).lanes().map(|depth| math::exp_f32(-depth)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponential() {
        let t = transmittance(SampledSpectrum::from_fn(|k| k as f32), 0.5);
        for (k, t) in t.lanes().into_iter().enumerate() {
            assert!((f64::from(t) - math::exp(-0.5 * k as f64)).abs() < 1e-7);
        }
    }
}
