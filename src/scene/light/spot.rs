//! The spot light.

use super::aim::{Aim, turned};
use super::point::towards_point;
use super::source::{Emission, EmissionStart, Exit, Extent, GuidedPair, LightSample, LightSource};
use crate::geometry::Aabb;
use crate::sampling::uniform_cone;
use crate::scene::Scene;
use glam::Vec3;
use std::f32::consts::TAU;

/// A cone of light from a point, with a smooth edge.
#[derive(Debug, Clone)]
pub struct SpotLight {
    /// Where it is.
    pub position: Vec3,
    /// Unit axis.
    pub axis: Vec3,
    /// 1 − cos of the half angle of full intensity.
    pub inner: f32,
    /// 1 − cos of the half angle where the cone ends.
    pub outer: f32,
}

impl SpotLight {
    /// Relative intensity in a direction: 1 inside the inner cone, 0 outside the outer, smooth in between.
    fn falloff(&self, direction: Vec3) -> f32 {
        let off_axis = 0.5 * (direction - self.axis).length_squared();
        if off_axis <= self.inner {
            return 1.0;
        }
        let t = ((self.outer - off_axis) / (self.outer - self.inner)).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    }
}

impl LightSource for SpotLight {
    fn power(&self, _: f32) -> f64 {
        std::f64::consts::PI * f64::from(self.inner + self.outer)
    }

    fn is_sampled(&self) -> bool {
        true
    }

    fn is_local(&self) -> bool {
        false
    }

    fn can_emit(&self) -> bool {
        true
    }

    fn extent(&self) -> Extent {
        Extent::None
    }

    fn aimed_share(&self, bounds: Option<Aabb>, aim: &Aim, _: f32) -> f32 {
        let outer = self.outer.max(f32::MIN_POSITIVE);
        bounds.and_then(|bounds| aim.cone(bounds.center())).map_or(1.0, |(_, cone)| cone / outer)
    }

    fn makes_caustics(&self, _: Option<Aabb>, _: &Aim) -> bool {
        true
    }

    fn sample(&self, _: &Scene, from: Vec3, _: [f32; 2]) -> Option<LightSample> {
        towards_point(self.position, from, |to_light| self.falloff(-to_light))
    }

    fn escaped(&self, _: Vec3) -> Option<(f32, f32)> {
        None
    }

    fn emit(&self, _: &Scene, aim: &Aim, _: [f32; 2], v: [f32; 2]) -> Option<Emission> {
        let narrower = aim.cone(self.position).is_some_and(|(_, one_minus_cos)| one_minus_cos < self.outer);
        let aimed = if narrower { aim.sample(self.position, v) } else { None };
        let (direction, solid_angle) =
            aimed.unwrap_or_else(|| (turned(self.axis, uniform_cone(v, self.outer)), TAU * self.outer));
        let weight = solid_angle * self.falloff(direction);
        (weight > 0.0).then_some(Emission { start: EmissionStart::free(self.position), direction, weight })
    }

    fn emission_density(&self, _: &Exit, _: &Aim) -> Option<f32> {
        None
    }

    fn guided_pair(&self) -> Option<GuidedPair> {
        Some(GuidedPair::Direction)
    }

    fn guided_numbers(&self, _: &Exit, _: &Aim) -> Option<[f32; 2]> {
        None
    }
}
