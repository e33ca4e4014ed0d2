//! The smooth metal.

use super::mirror::mirror_direction;
use super::{BsdfSample, Carried, Evaluation, ScatteringModel};
use crate::geometry::Frame;
use crate::optics::fresnel_conductor;
use crate::spectrum::{LANES, SampledSpectrum};
use glam::Vec3;

/// Reflects into the mirror direction by Fresnel's equations with a complex index.
#[derive(Debug, Clone, Copy)]
pub struct Conductor {
    /// Real part of the index, relative to air.
    pub eta: SampledSpectrum,
    /// Imaginary part.
    pub k: SampledSpectrum,
    /// Index of the medium in front of it: a metal under water reflects less.
    pub eta_outside: [f64; LANES],
}

impl Conductor {
    /// Reflected share of unpolarised light that arrives with this cosine, in each lane.
    pub fn reflectance(&self, cos_theta: f64) -> SampledSpectrum {
        let (eta, k) = (self.eta.lanes(), self.k.lanes());
        SampledSpectrum::from_fn(|lane| {
            fresnel_conductor(cos_theta, self.eta_outside[lane], f64::from(eta[lane]), f64::from(k[lane])) as f32
        })
    }
}

impl ScatteringModel for Conductor {
    const SPECULAR: bool = true;
    const ROUGH: bool = false;
    const TRANSMITS: bool = false;

    #[inline(always)]
    fn sample(&self, frame: &Frame, wo: Vec3, _: &Carried, _: [f32; 2], _: f32) -> Option<BsdfSample> {
        let cos_theta = frame.geometric.dot(wo.as_dvec3().normalize()).abs();
        Some(BsdfSample::mirrored(mirror_direction(frame, wo), self.reflectance(cos_theta)))
    }

    fn evaluate(&self, _: &Frame, _: Vec3, _: Vec3) -> Option<Evaluation> {
        None
    }
}
