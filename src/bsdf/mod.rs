//! Scattering at a surface, evaluated at a path's wavelengths: one file a model, each with `eval`, `sample`, `pdf`.
//!
//! Directions point away from the surface; `wo` is where the path came from. Everything spectral is resolved before
//! sampling starts, so a [`Bsdf`] is a small Copy value. Throughput weights are f · cos θ / pdf.

mod conductor;
mod dielectric;
mod diffuse;
mod mirror;

pub use conductor::Conductor;
pub use dielectric::{Dielectric, Incidence, Indices, Lanes};
pub use diffuse::Diffuse;
pub use mirror::Mirror;

use crate::geometry::Frame;
use crate::spectrum::SampledSpectrum;
use glam::Vec3;

/// An opaque surface at a hit.
#[derive(Debug, Clone, Copy)]
pub enum Bsdf {
    /// Lambertian.
    Diffuse(Diffuse),
    /// Perfect mirror.
    Mirror(Mirror),
    /// Smooth metal.
    Conductor(Conductor),
}

/// A sampled direction.
#[derive(Debug, Clone, Copy)]
pub struct BsdfSample {
    /// Direction away from the surface.
    pub wi: Vec3,
    /// f · |cos θ| / pdf.
    pub weight: SampledSpectrum,
    /// Density in solid angle; `None` for a delta distribution.
    pub pdf: Option<f32>,
}

impl Bsdf {
    /// Whether the distribution is a delta, for which `eval` and `pdf` are 0.
    pub fn is_specular(&self) -> bool {
        !matches!(self, Self::Diffuse(_))
    }

    /// f · |cos θ_i|, per sr, for unit directions.
    pub fn eval(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> SampledSpectrum {
        match self {
            Self::Diffuse(b) => b.eval(frame, wo, wi),
            Self::Mirror(_) | Self::Conductor(_) => SampledSpectrum::ZERO,
        }
    }

    /// Draws a direction.
    pub fn sample(&self, frame: &Frame, wo: Vec3, u: [f32; 2]) -> Option<BsdfSample> {
        match self {
            Self::Diffuse(b) => b.sample(frame, wo, u),
            Self::Mirror(b) => b.sample(frame, wo),
            Self::Conductor(b) => b.sample(frame, wo),
        }
    }

    /// Density of `sample` in solid angle.
    pub fn pdf(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> f32 {
        match self {
            Self::Diffuse(b) => b.pdf(frame, wo, wi),
            Self::Mirror(_) | Self::Conductor(_) => 0.0,
        }
    }
}
