//! What every kind of light answers, and the samples that it draws.

use super::aim::Aim;
use crate::geometry::{Aabb, offset_origin};
use crate::scene::Scene;
use glam::Vec3;

/// What every kind of light states. No method has a default, so that a new kind cannot inherit a wrong answer.
pub(super) trait LightSource {
    /// Power per unit of the light's spectrum.
    fn power(&self, scene_radius: f32) -> f64;

    /// Whether next-event estimation can draw a direction towards the light.
    fn is_sampled(&self) -> bool;

    /// Whether a point knows at once that most of the scene is not lit: next-event estimation then asks the light at
    /// every point instead of drawing it.
    fn is_local(&self) -> bool;

    /// Whether light paths can start from it.
    fn can_emit(&self) -> bool;

    /// Where a ray can run into it.
    fn extent(&self) -> Extent;

    /// Rough share of its power that light paths aimed at a sphere send there; it may exceed 1. `bounds` is the box around
    /// a light that is not at infinity.
    fn aimed_share(&self, bounds: Option<Aabb>, aim: &Aim, scene_radius: f32) -> f32;

    /// Whether camera paths hardly find the caustics that the light makes by way of what is aimed at.
    fn makes_caustics(&self, bounds: Option<Aabb>, aim: &Aim) -> bool;

    /// Draws a direction from `from` towards the light.
    fn sample(&self, scene: &Scene, from: Vec3, u: [f32; 2]) -> Option<LightSample>;

    /// Factor of the light's spectrum, and density of [`Self::sample`], for a ray that escapes the scene.
    fn escaped(&self, direction: Vec3) -> Option<(f32, f32)>;

    /// Starts a light path towards what is aimed at: `u` draws the point, `v` the direction.
    fn emit(&self, scene: &Scene, aim: &Aim, u: [f32; 2], v: [f32; 2]) -> Option<Emission>;

    /// Density of [`Self::emit`] per unit of étendue (area times projected solid angle) for light that leaves in this
    /// way; `None` for delta lights and the environment.
    fn emission_density(&self, exit: &Exit, aim: &Aim) -> Option<f32>;

    /// Which of the pairs of random numbers that [`Self::emit`] takes decides what a path of this light meets.
    fn guided_pair(&self) -> Option<GuidedPair>;

    /// The guided pair of numbers from which [`Self::emit`] makes this way of leaving the light. `None` if it makes it
    /// from no such pair, or if the light has no extent, so that nobody asks.
    fn guided_numbers(&self, exit: &Exit, aim: &Aim) -> Option<[f32; 2]>;
}

/// Where a ray can run into a light.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Extent {
    /// Nowhere: the light is a point, or its rays are parallel.
    None,
    /// On a surface of the scene.
    Surface,
    /// At infinity, when it leaves the scene.
    Infinite,
}

/// Solid angle, seen from what focuses it, below which camera paths hardly find a light: by scattering diffusely they
/// hit it once in 30 times or less, and light paths take part.
pub(super) const SMALL_LIGHT_SR: f32 = 0.1;

/// A direction towards a light.
#[derive(Debug, Clone, Copy)]
pub struct LightSample {
    /// Where the light is; `None` at infinity.
    pub target: Option<Vec3>,
    /// Unit direction towards it.
    pub wi: Vec3,
    /// Factor of the light's spectrum, divided by the density in solid angle.
    pub weight: f32,
    /// Density in solid angle; `None` if no other technique can find this direction.
    pub pdf: Option<f32>,
}

/// The start of a light path.
#[derive(Debug, Clone, Copy)]
pub struct Emission {
    /// Point on the light.
    pub start: EmissionStart,
    /// Unit direction of travel.
    pub direction: Vec3,
    /// Factor of the light's spectrum: radiance · cos θ / density of point and direction.
    pub weight: f32,
}

/// How light leaves a light: what the density of light paths depends on.
#[derive(Debug, Clone, Copy)]
pub struct Exit {
    /// The point that it leaves from.
    pub point: Vec3,
    /// Unit direction of travel.
    pub direction: Vec3,
    /// Cosine to the light's normal; 1 off surfaces.
    pub cos: f32,
}

/// One of the pairs of random numbers of [`Light::emit`](super::Light::emit).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GuidedPair {
    /// The first: the point that a path starts from.
    Point,
    /// The second: its direction.
    Direction,
}

impl Emission {
    /// How the path leaves its light.
    pub fn exit(&self) -> Exit {
        let cos = if self.start.normal == Vec3::ZERO { 1.0 } else { self.start.normal.dot(self.direction) };
        Exit { point: self.start.point, direction: self.direction, cos }
    }
}

/// Where a light path starts.
#[derive(Debug, Clone, Copy)]
pub struct EmissionStart {
    /// The point.
    pub point: Vec3,
    /// Bound of its error; 0 off surfaces.
    pub error: Vec3,
    /// Unit normal on the emitting side; 0 off surfaces.
    pub normal: Vec3,
}

impl EmissionStart {
    /// A start that lies on no surface.
    pub(super) fn free(point: Vec3) -> Self {
        Self { point, error: Vec3::ZERO, normal: Vec3::ZERO }
    }

    /// Where a ray in this direction starts.
    pub fn origin(&self, direction: Vec3) -> Vec3 {
        if self.normal == Vec3::ZERO {
            self.point
        } else {
            offset_origin(self.point, self.error, self.normal, direction)
        }
    }
}
