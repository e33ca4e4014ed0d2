//! The beam: parallel light through a disc, such as a laser's.

use super::aim::Aim;
use super::directional::disc_offset;
use super::source::{Emission, EmissionStart, Exit, Extent, GuidedPair, LightSample, LightSource};
use crate::geometry::Aabb;
use crate::scene::Scene;
use glam::Vec3;
use std::f32::consts::PI;

/// Parallel light through a disc.
#[derive(Debug, Clone)]
pub struct BeamLight {
    /// Centre of the disc.
    pub origin: Vec3,
    /// Unit direction of travel.
    pub direction: Vec3,
    /// Radius of the disc.
    pub radius: f32,
}

impl LightSource for BeamLight {
    fn power(&self, _: f32) -> f64 {
        1.0
    }

    fn is_sampled(&self) -> bool {
        true
    }

    fn is_local(&self) -> bool {
        true
    }

    fn can_emit(&self) -> bool {
        true
    }

    fn extent(&self) -> Extent {
        Extent::None
    }

    fn aimed_share(&self, _: Option<Aabb>, _: &Aim, _: f32) -> f32 {
        1.0
    }

    fn makes_caustics(&self, _: Option<Aabb>, _: &Aim) -> bool {
        true
    }

    fn sample(&self, _: &Scene, from: Vec3, _: [f32; 2]) -> Option<LightSample> {
        let along = (from - self.origin).dot(self.direction);
        let target = from - self.direction * along;
        if along <= 0.0 || target.distance_squared(self.origin) > self.radius * self.radius {
            return None;
        }
        let weight = 1.0 / (PI * self.radius * self.radius);
        Some(LightSample { target: Some(target), wi: -self.direction, weight, pdf: None })
    }

    fn escaped(&self, _: Vec3) -> Option<(f32, f32)> {
        None
    }

    fn emit(&self, _: &Scene, _: &Aim, u: [f32; 2], _: [f32; 2]) -> Option<Emission> {
        let point = self.origin + disc_offset(self.direction, self.radius, u);
        Some(Emission { start: EmissionStart::free(point), direction: self.direction, weight: 1.0 })
    }

    fn emission_density(&self, _: &Exit, _: &Aim) -> Option<f32> {
        None
    }

    fn guided_pair(&self) -> Option<GuidedPair> {
        Some(GuidedPair::Point)
    }

    fn guided_numbers(&self, _: &Exit, _: &Aim) -> Option<[f32; 2]> {
        None
    }
}
