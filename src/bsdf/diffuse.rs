//! Lambertian reflection.

use super::{BsdfSample, Carried, Density, ScatteringModel};
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

impl Diffuse {
    /// f · |cos θ_i|.
    pub fn eval(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> SampledSpectrum {
        if frame.same_side(wo, wi) {
            self.reflectance * (frame.cos_shading(wi).max(0.0) * FRAC_1_PI)
        } else {
            SampledSpectrum::ZERO
        }
    }

    /// Draws in proportion to cos θ about the shading normal.
    #[inline(always)]
    pub fn sample(&self, frame: &Frame, wo: Vec3, u: [f32; 2]) -> Option<BsdfSample> {
        let wi = frame.world_from_local(cosine_hemisphere(u));
        let pdf = frame.cos_shading(wi) * FRAC_1_PI;
        (pdf > 0.0 && frame.same_side(wo, wi)).then_some(BsdfSample::reflected(wi, self.reflectance, pdf))
    }

    /// cos θ_i / π.
    pub fn pdf(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> f32 {
        if frame.same_side(wo, wi) { frame.cos_shading(wi).max(0.0) * FRAC_1_PI } else { 0.0 }
    }
}

impl ScatteringModel for Diffuse {
    const SPECULAR: bool = false;
    const ROUGH: bool = false;
    const TRANSMITS: bool = false;

    fn eval(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> SampledSpectrum {
        Self::eval(self, frame, wo, wi)
    }

    #[inline(always)]
    fn sample(&self, frame: &Frame, wo: Vec3, _: &Carried, u: [f32; 2], _: f32) -> Option<BsdfSample> {
        Self::sample(self, frame, wo, u)
    }

    fn pdf(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> Density {
        Density::Shared(Self::pdf(self, frame, wo, wi))
    }

    fn own_pdf(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> SampledSpectrum {
        SampledSpectrum::splat(Self::pdf(self, frame, wo, wi))
    }
}
