//! Scattering at a surface, evaluated at a path's wavelengths: one file a model, each with `sample` and `evaluate`.
//!
//! Directions point away from the surface; `wo` is where the path came from. Everything spectral is resolved before
//! sampling starts, so a [`Bsdf`] is a small Copy value. Throughput weights are f · cos θ / pdf. Values at transparent
//! boundaries are shares of flux: see [`Bsdf::radiance_change`].

mod carried;
mod conductor;
mod dielectric;
mod diffuse;
mod microfacet;
mod mirror;
mod rough_conductor;
mod rough_dielectric;

pub use carried::{BASELINE_LANES, Branching, Carried, Lanes, NEVER, Parting, lane_of_way};
pub use conductor::Conductor;
pub use dielectric::{Dielectric, DielectricChoice, Division, Incidence, Indices};
pub use diffuse::Diffuse;
pub use microfacet::Ggx;
pub use mirror::Mirror;
pub use rough_conductor::RoughConductor;
pub use rough_dielectric::RoughDielectric;

use crate::geometry::Frame;
use crate::spectrum::{LANES, SampledSpectrum};
use glam::Vec3;

/// A surface at a hit.
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
    /// Smooth boundary of a transparent volume.
    Dielectric(Dielectric),
    /// Rough boundary of a transparent volume.
    RoughDielectric(RoughDielectric),
}

/// Where a path goes on.
#[derive(Debug, Clone, Copy)]
pub enum Outgoing {
    /// All lanes take one direction.
    Shared(Vec3),
    /// Each lane takes its own; `None` if nothing of it goes on.
    PerLane([Option<Vec3>; LANES]),
}

/// Density of a sampled direction in solid angle.
#[derive(Debug, Clone, Copy)]
pub enum Density {
    /// The direction is the only one possible.
    Delta,
    /// All lanes have the same.
    Shared(f32),
    /// Each lane has its own.
    PerLane(SampledSpectrum),
}

impl Outgoing {
    /// The direction that all lanes take, if they take one.
    pub fn shared(self) -> Option<Vec3> {
        if let Self::Shared(wi) = self { Some(wi) } else { None }
    }
}

impl Density {
    /// The density that all lanes have in common; `None` for a delta, and where each has its own.
    pub fn shared(self) -> Option<f32> {
        if let Self::Shared(pdf) = self { Some(pdf) } else { None }
    }
}

/// A sampled direction, or one for each lane.
#[derive(Debug, Clone, Copy)]
pub struct BsdfSample {
    /// Direction away from the surface.
    pub wi: Outgoing,
    /// f · |cos θ| / pdf.
    pub weight: SampledSpectrum,
    /// Density of the direction.
    pub pdf: Density,
    /// Whether it lies on the other side of the surface.
    pub crosses: bool,
    /// The odds of the lanes after it, if they have changed; see [`Carried::odds`].
    pub odds: Option<SampledSpectrum>,
    /// A direction that is followed besides, where the path forks.
    pub aside: Option<Aside>,
}

/// A second direction of a path that forks.
#[derive(Debug, Clone, Copy)]
pub struct Aside {
    /// Direction away from the surface, on the side where the path came from.
    pub wi: Vec3,
    /// Share of each lane's flux.
    pub weight: SampledSpectrum,
}

/// A scattering model at a pair of directions.
#[derive(Debug, Clone, Copy)]
pub struct Evaluation {
    /// f · |cos θ_i|, per sr.
    pub value: SampledSpectrum,
    /// Density by which a sample of this direction is balanced against other techniques.
    pub pdf: Density,
    /// Density in solid angle with which each lane would draw the direction if it were alone.
    pub own_pdf: SampledSpectrum,
    /// Whether the directions lie on different sides of the surface.
    pub crosses: bool,
}

impl BsdfSample {
    /// A direction of reflection that was drawn with a density in solid angle.
    #[inline(always)]
    pub fn reflected(wi: Vec3, weight: SampledSpectrum, pdf: f32) -> Self {
        let (wi, pdf) = (Outgoing::Shared(wi), Density::Shared(pdf));
        Self { wi, weight, pdf, crosses: false, odds: None, aside: None }
    }

    /// The only direction of reflection.
    #[inline(always)]
    pub fn mirrored(wi: Vec3, weight: SampledSpectrum) -> Self {
        Self { wi: Outgoing::Shared(wi), weight, pdf: Density::Delta, crosses: false, odds: None, aside: None }
    }
}

impl Evaluation {
    /// A direction of reflection that all lanes draw with the same density.
    #[inline(always)]
    pub fn reflected(value: SampledSpectrum, pdf: f32) -> Self {
        Self { value, pdf: Density::Shared(pdf), own_pdf: SampledSpectrum::splat(pdf), crosses: false }
    }
}

/// What every model states. No method has a default, so that a new model cannot inherit a wrong answer; models of
/// boundaries that light passes through are met by [`Bsdf::radiance_change`] and [`Bsdf::reversed`] besides.
pub trait ScatteringModel {
    /// Whether the distribution is a delta, of which nothing can be evaluated.
    const SPECULAR: bool;
    /// Whether it has a lobe about the direction of reflection or refraction, wide or narrow.
    const ROUGH: bool;
    /// Whether light passes through the surface.
    const TRANSMITS: bool;

    /// Draws a direction by two random numbers, and what kind of scattering takes place by a third, for the lanes that the
    /// path carries. `None` if the path ends.
    fn sample(&self, frame: &Frame, wo: Vec3, carried: &Carried, u: [f32; 2], choice: f32) -> Option<BsdfSample>;

    /// Evaluates the model for unit directions; `None` where nothing is scattered.
    fn evaluate(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> Option<Evaluation>;
}

/// Calls the same method of whichever model it is.
macro_rules! for_model {
    ($bsdf:expr, $model:ident => $body:expr) => {
        match $bsdf {
            Bsdf::Diffuse($model) => $body,
            Bsdf::Mirror($model) => $body,
            Bsdf::Conductor($model) => $body,
            Bsdf::RoughConductor($model) => $body,
            Bsdf::Dielectric($model) => $body,
            Bsdf::RoughDielectric($model) => $body,
        }
    };
}

/// The capabilities of a model, of which only its type is known.
fn capabilities<M: ScatteringModel>(_: &M) -> (bool, bool, bool) {
    (M::SPECULAR, M::ROUGH, M::TRANSMITS)
}

impl Bsdf {
    /// Whether the distribution is a delta, of which nothing can be evaluated.
    #[inline]
    pub fn is_specular(&self) -> bool {
        for_model!(self, model => capabilities(model).0)
    }

    /// Whether it has a lobe about the direction of reflection or refraction, wide or narrow.
    #[inline]
    pub fn is_rough(&self) -> bool {
        for_model!(self, model => capabilities(model).1)
    }

    /// Whether light passes through the surface.
    #[inline]
    pub fn transmits(&self) -> bool {
        for_model!(self, model => capabilities(model).2)
    }

    /// Draws a direction by two random numbers, and what kind of scattering takes place by a third, for the lanes that the
    /// path carries. `None` if the path ends.
    #[inline(always)]
    pub fn sample(
        &self,
        frame: &Frame,
        wo: Vec3,
        carried: &Carried,
        direction: [f32; 2],
        choice: f32,
    ) -> Option<BsdfSample> {
        for_model!(self, model => model.sample(frame, wo, carried, direction, choice))
    }

    /// Evaluates the model for unit directions; `None` where nothing is scattered, at no wavelength of the path.
    pub fn evaluate(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> Option<Evaluation> {
        self.evaluate_lobe(frame, wo, wi).filter(|evaluation| !evaluation.value.is_zero())
    }

    /// Returns f · |cos θ_i|, per sr, for unit directions; 0 for deltas.
    pub fn eval(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> SampledSpectrum {
        self.evaluate_lobe(frame, wo, wi).map_or(SampledSpectrum::ZERO, |evaluation| evaluation.value)
    }

    /// Returns the density in solid angle with which each lane would draw a direction if it were alone.
    pub fn own_pdf(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> SampledSpectrum {
        self.evaluate_lobe(frame, wo, wi).map_or(SampledSpectrum::ZERO, |evaluation| evaluation.own_pdf)
    }

    #[inline(always)]
    fn evaluate_lobe(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> Option<Evaluation> {
        for_model!(self, model => model.evaluate(frame, wo, wi))
    }

    /// (η_from / η_to)² of each lane for what crosses, else 1: what radiance from there is multiplied by.
    pub fn radiance_change(&self, crosses: bool) -> SampledSpectrum {
        match self {
            Self::RoughDielectric(b) => b.radiance_change(crosses),
            _ => SampledSpectrum::ONE,
        }
    }

    /// The same surface met from where a direction goes, with the frame turned to it.
    pub fn reversed(&self, frame: &Frame, crosses: bool) -> (Self, Frame) {
        match self {
            Self::RoughDielectric(b) => {
                let (reversed, frame) = b.reversed(frame, crosses);
                (Self::RoughDielectric(reversed), frame)
            }
            _ => (*self, *frame),
        }
    }
}
