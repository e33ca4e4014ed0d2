//! Scattering at a surface, evaluated at a path's wavelengths: one file a model, each with `eval`, `sample`, `pdf`.
//!
//! Directions point away from the surface; `wo` is where the path came from. Everything spectral is resolved before
//! sampling starts, so a [`Bsdf`] is a small Copy value. Throughput weights are f · cos θ / pdf.

mod conductor;
mod dielectric;
mod diffuse;
mod microfacet;
mod mirror;
mod rough_conductor;
mod rough_dielectric;

pub use conductor::Conductor;
pub use dielectric::{Dielectric, DielectricSample, Division, Incidence, Indices, Lanes};
pub use diffuse::Diffuse;
pub use microfacet::{Ggx, lit_of_visible};
pub use mirror::Mirror;
pub use rough_conductor::RoughConductor;
pub use rough_dielectric::{Lobe, RoughDielectric, RoughSample};

use crate::geometry::Frame;
use crate::spectrum::SampledSpectrum;
use glam::Vec3;

/// A surface at a hit. Smooth boundaries of transparent volumes are no part of it, as they are met by [`Dielectric`].
#[derive(Debug, Clone, Copy)]
pub enum Bsdf {
    /// Lambertian.
    Diffuse(Diffuse),
    /// Perfect mirror.
    Mirror(Mirror),
    /// Smooth metal.
    Conductor(Conductor),
    /// Rough metal.
    RoughConductor(RoughConductor),
    /// Rough boundary of a transparent volume.
    RoughDielectric(RoughDielectric),
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
        matches!(self, Self::Mirror(_) | Self::Conductor(_))
    }

    /// Whether it has a lobe about the direction of reflection or refraction, wide or narrow.
    pub fn is_rough(&self) -> bool {
        matches!(self, Self::RoughConductor(_) | Self::RoughDielectric(_))
    }

    /// f · |cos θ_i|, per sr, for unit directions.
    pub fn eval(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> SampledSpectrum {
        match self {
            Self::Diffuse(b) => b.eval(frame, wo, wi),
            Self::Mirror(_) | Self::Conductor(_) => SampledSpectrum::ZERO,
            Self::RoughConductor(b) => b.eval(frame, wo, wi),
            Self::RoughDielectric(b) => b.eval(frame, wo, wi),
        }
    }

    /// Draws a direction at an opaque surface; at a boundary, where lanes have something to say, see
    /// [`RoughDielectric::sample`].
    pub fn sample(&self, frame: &Frame, wo: Vec3, u: [f32; 2]) -> Option<BsdfSample> {
        match self {
            Self::Diffuse(b) => b.sample(frame, wo, u),
            Self::Mirror(b) => b.sample(frame, wo),
            Self::Conductor(b) => b.sample(frame, wo),
            Self::RoughConductor(b) => b.sample(frame, wo, u),
            Self::RoughDielectric(_) => None,
        }
    }

    /// Density in solid angle with which each lane would draw a direction if it were alone.
    pub fn own_pdf(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> SampledSpectrum {
        match self {
            Self::RoughDielectric(b) => b.lobe(frame, wo, wi).map_or(SampledSpectrum::ZERO, |lobe| lobe.own_pdf),
            _ => SampledSpectrum::splat(self.pdf(frame, wo, wi)),
        }
    }

    /// Density of `sample` in solid angle; 0 at boundaries.
    pub fn pdf(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> f32 {
        match self {
            Self::Diffuse(b) => b.pdf(frame, wo, wi),
            Self::RoughConductor(b) => b.pdf(frame, wo, wi),
            Self::Mirror(_) | Self::Conductor(_) | Self::RoughDielectric(_) => 0.0,
        }
    }
}
