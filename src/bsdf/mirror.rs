//! The perfect mirror.

use super::{BsdfSample, Carried, Evaluation, ScatteringModel};
use crate::geometry::Frame;
use crate::optics;
use crate::spectrum::SampledSpectrum;
use glam::Vec3;

/// Reflects into the mirror direction alone. The direction is the same at every wavelength, so lanes never separate.
#[derive(Debug, Clone, Copy)]
pub struct Mirror {
    /// Reflected share of the light, in [0, 1].
    pub reflectance: SampledSpectrum,
}

/// Mirror image of `wo` about the geometric normal, in f64 as every specular direction.
pub(super) fn mirror_direction(frame: &Frame, wo: Vec3) -> Vec3 {
    optics::reflect(-wo.as_dvec3().normalize(), frame.geometric).as_vec3()
}

impl ScatteringModel for Mirror {
    const SPECULAR: bool = true;
    const ROUGH: bool = false;
    const TRANSMITS: bool = false;

    #[inline(always)]
    fn sample(&self, frame: &Frame, wo: Vec3, _: &Carried, _: [f32; 2], _: f32) -> Option<BsdfSample> {
        Some(BsdfSample::mirrored(mirror_direction(frame, wo), self.reflectance))
    }

    fn evaluate(&self, _: &Frame, _: Vec3, _: Vec3) -> Option<Evaluation> {
        None
    }
}
