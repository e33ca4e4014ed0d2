//! The point light.

use super::aim::Aim;
use super::source::{Emission, EmissionStart, Exit, Extent, GuidedPair, LightSample, LightSource};
use crate::geometry::Aabb;
use crate::sampling::uniform_sphere;
use crate::scene::Scene;
use glam::Vec3;
use std::f32::consts::PI;

/// A point of equal intensity in all directions.
#[derive(Debug, Clone)]
pub struct PointLight {
    /// Where it is.
    pub position: Vec3,
}

impl LightSource for PointLight {
    fn power(&self, _: f32) -> f64 {
        4.0 * std::f64::consts::PI
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
        bounds.and_then(|bounds| aim.cone(bounds.center())).map_or(1.0, |(_, cone)| 0.5 * cone)
    }

    fn makes_caustics(&self, _: Option<Aabb>, _: &Aim) -> bool {
        true
    }

    fn sample(&self, _: &Scene, from: Vec3, _: [f32; 2]) -> Option<LightSample> {
        towards_point(self.position, from, |_| 1.0)
    }

    fn escaped(&self, _: Vec3) -> Option<(f32, f32)> {
        None
    }

    fn emit(&self, _: &Scene, aim: &Aim, _: [f32; 2], v: [f32; 2]) -> Option<Emission> {
        let start = EmissionStart::free(self.position);
        Some(match aim.sample(self.position, v) {
            Some((direction, solid_angle)) => Emission { start, direction, weight: solid_angle },
            None => Emission { start, direction: uniform_sphere(v).normalize(), weight: 4.0 * PI },
        })
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

/// The sample of a light at a point, whose intensity towards −`to_light` has the given factor.
pub(super) fn towards_point(position: Vec3, from: Vec3, factor: impl Fn(Vec3) -> f32) -> Option<LightSample> {
    let to_light = position - from;
    let distance2 = to_light.length_squared();
    let wi = to_light / distance2.sqrt();
    let weight = factor(wi) / distance2;
    (weight > 0.0 && weight.is_finite()).then_some(LightSample { target: Some(position), wi, weight, pdf: None })
}
