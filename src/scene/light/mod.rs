//! Lights: sampled from a point (next-event estimation), met by a ray, or the start of light paths. Each kind is a struct in
//! a file of its own that answers everything [`source::LightSource`] asks; [`Light`] forwards.

mod aim;
mod area;
mod area_shape;
mod beam;
mod directional;
mod environment;
mod point;
mod source;
mod spot;

pub use aim::Aim;
pub use area::AreaLight;
pub use area_shape::AreaShape;
pub use beam::BeamLight;
pub use directional::DirectionalLight;
pub use environment::EnvironmentLight;
pub use point::PointLight;
pub use source::{Emission, EmissionStart, Exit, GuidedPair, LightSample};
pub use spot::SpotLight;

use super::{Scene, SpectrumId, Surface};
use crate::geometry::Aabb;
use crate::spectrum::WavelengthDensity;
use glam::Vec3;
use source::{Extent, LightSource};

/// A light. Its radiance (or intensity, irradiance, power) is a factor times its spectrum, in units of the compiled scene.
#[derive(Debug, Clone)]
pub struct Light {
    /// Where the light comes from.
    pub kind: LightKind,
    /// Spectral shape.
    pub spectrum: SpectrumId,
    /// Wavelengths of light paths that start here.
    pub wavelengths: WavelengthDensity,
    /// Whether its starting points can lie inside a transparent object.
    pub may_be_inside: bool,
}

/// The kinds of light.
#[derive(Debug, Clone)]
pub enum LightKind {
    /// A surface that emits.
    Area(AreaLight),
    /// A point of equal intensity in all directions.
    Point(PointLight),
    /// A cone of light with a smooth edge.
    Spot(SpotLight),
    /// A disc at infinity, or parallel light.
    Directional(DirectionalLight),
    /// Parallel light through a disc.
    Beam(BeamLight),
    /// The same radiance from all directions.
    Environment(EnvironmentLight),
}

/// Calls the same method of whichever kind of light it is.
macro_rules! for_kind {
    ($kind:expr, $light:ident => $body:expr) => {
        match $kind {
            LightKind::Area($light) => $body,
            LightKind::Point($light) => $body,
            LightKind::Spot($light) => $body,
            LightKind::Directional($light) => $body,
            LightKind::Beam($light) => $body,
            LightKind::Environment($light) => $body,
        }
    };
}

impl LightKind {
    /// Power per unit of the light's spectrum.
    pub fn power(&self, scene_radius: f32) -> f64 {
        for_kind!(self, light => light.power(scene_radius))
    }
}

impl Light {
    /// Whether next-event estimation can draw a direction towards it.
    pub(crate) fn is_sampled(&self) -> bool {
        for_kind!(&self.kind, light => light.is_sampled())
    }

    /// Whether it lights so little of the scene that next-event estimation asks it at every point instead of drawing it,
    /// as for a beam.
    pub fn is_local(&self) -> bool {
        for_kind!(&self.kind, light => light.is_local())
    }

    /// Whether light paths can start from it.
    pub(crate) fn can_emit(&self) -> bool {
        for_kind!(&self.kind, light => light.can_emit())
    }

    /// Whether a ray can run into it.
    pub fn has_extent(&self) -> bool {
        for_kind!(&self.kind, light => light.extent() != Extent::None)
    }

    /// Whether a ray that leaves the scene can run into it.
    pub fn is_infinite(&self) -> bool {
        for_kind!(&self.kind, light => light.extent() == Extent::Infinite)
    }

    /// Rough share of its power that light paths send to what they are aimed at.
    pub(crate) fn aimed_share(&self, bounds: Option<Aabb>, aim: &Aim, scene_radius: f32) -> f64 {
        f64::from(for_kind!(&self.kind, light => light.aimed_share(bounds, aim, scene_radius)).min(1.0))
    }

    /// Whether it makes caustics, by way of what is aimed at, that camera paths hardly find.
    pub(crate) fn makes_caustics(&self, bounds: Option<Aabb>, aim: &Aim) -> bool {
        for_kind!(&self.kind, light => light.makes_caustics(bounds, aim))
    }

    /// Draws a direction from `from` towards the light.
    pub fn sample(&self, scene: &Scene, from: Vec3, u: [f32; 2]) -> Option<LightSample> {
        for_kind!(&self.kind, light => light.sample(scene, from, u))
    }

    /// Factor of the light's spectrum, and density of [`Self::sample`], for a ray that escapes the scene.
    pub fn escaped(&self, direction: Vec3) -> Option<(f32, f32)> {
        for_kind!(&self.kind, light => light.escaped(direction))
    }

    /// Starts a light path towards what is aimed at: `u` draws the point, `v` the direction.
    pub fn emit(&self, scene: &Scene, aim: &Aim, u: [f32; 2], v: [f32; 2]) -> Option<Emission> {
        for_kind!(&self.kind, light => light.emit(scene, aim, u, v))
    }

    /// Density of [`Self::emit`] per unit of étendue (area times projected solid angle) for light that leaves in this
    /// way; `None` for delta lights and the environment.
    pub fn emission_density(&self, exit: &Exit, aim: &Aim) -> Option<f32> {
        for_kind!(&self.kind, light => light.emission_density(exit, aim))
    }

    /// Which of the pairs of random numbers that [`Self::emit`] takes decides what a path of this light meets.
    pub fn guided_pair(&self) -> Option<GuidedPair> {
        for_kind!(&self.kind, light => light.guided_pair())
    }

    /// The guided pair of numbers from which [`Self::emit`] makes this way of leaving the light. `None` if it makes it
    /// from no such pair, or if the light has no extent, so that nobody asks.
    pub fn guided_numbers(&self, exit: &Exit, aim: &Aim) -> Option<[f32; 2]> {
        for_kind!(&self.kind, light => light.guided_numbers(exit, aim))
    }

    /// The light of a surface, if it is one.
    fn area_light(&self) -> Option<&AreaLight> {
        match &self.kind {
            LightKind::Area(light) => Some(light),
            LightKind::Point(_)
            | LightKind::Spot(_)
            | LightKind::Directional(_)
            | LightKind::Beam(_)
            | LightKind::Environment(_) => None,
        }
    }

    /// Area that emits, of both sides where both do; `None` for a light that is no surface.
    pub fn emitting_area(&self) -> Option<f32> {
        self.area_light().map(AreaLight::emitting_area)
    }

    /// Whether a surface hit from the side of `-direction` emits towards it.
    pub fn emits(&self, surface: &Surface, direction: Vec3) -> bool {
        self.area_light().is_some_and(|light| light.emits(surface, direction))
    }

    /// Density with which [`Self::sample`] draws the direction of a ray from `from` that met this light's surface.
    pub fn pdf_surface(&self, from: Vec3, direction: Vec3, surface: &Surface) -> f32 {
        self.area_light().map_or(0.0, |light| light.pdf_surface(from, direction, surface))
    }
}
