//! Lambertian reflection.

use super::{BsdfSample, Carried, Evaluation, ScatteringModel};
use crate::geometry::Frame;
use crate::sampling::cosine_hemisphere;
use crate::spectrum::SampledSpectrum;
use glam::Vec3;
use std::f32::consts::FRAC_1_PI;

/// Reflects the same radiance in every direction: f = reflectance / π.
#[derive(Debug, Clone, Copy)]
pub struct Diffuse {
    /// Reflected share of the light, in [0, 1].
    pub reflectance: SampledSpectrum,
}

impl ScatteringModel for Diffuse {
    const SPECULAR: bool = false;
    const ROUGH: bool = false;
    const TRANSMITS: bool = false;

    /// Draws in proportion to cos θ about the shading normal.
    #[inline(always)]
    fn sample(&self, frame: &Frame, wo: Vec3, _: &Carried, u: [f32; 2], _: f32) -> Option<BsdfSample> {
        let wi = frame.world_from_local(cosine_hemisphere(u));
        let pdf = frame.cos_shading(wi) * FRAC_1_PI;
        (pdf > 0.0 && frame.same_side(wo, wi)).then_some(BsdfSample::reflected(wi, self.reflectance, pdf))
    }

    #[inline]
    fn evaluate(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> Option<Evaluation> {
        let pdf = frame.cos_shading(wi).max(0.0) * FRAC_1_PI;
        frame.same_side(wo, wi).then(|| Evaluation::reflected(self.reflectance * pdf, pdf))
    }
}
