//! The environment: light from all directions.

use super::aim::Aim;
use super::directional::{from_infinity, share_of_scene};
use super::source::{Emission, Exit, Extent, GuidedPair, LightSample, LightSource};
use crate::geometry::Aabb;
use crate::sampling::uniform_sphere;
use crate::scene::Scene;
use glam::Vec3;
use std::f32::consts::PI;

/// The same radiance from all directions. The rays that scattering sends out find it anyway, so next-event estimation does
/// not draw it.
#[derive(Debug, Clone)]
pub struct EnvironmentLight;

impl LightSource for EnvironmentLight {
    fn power(&self, scene_radius: f32) -> f64 {
        let (pi, radius) = (std::f64::consts::PI, f64::from(scene_radius));
        4.0 * pi * pi * radius * radius
    }

    fn is_sampled(&self) -> bool {
        false
    }

    fn is_local(&self) -> bool {
        false
    }

    fn can_emit(&self) -> bool {
        true
    }

    fn extent(&self) -> Extent {
        Extent::Infinite
    }

    fn aimed_share(&self, _: Option<Aabb>, aim: &Aim, scene_radius: f32) -> f32 {
        share_of_scene(aim, scene_radius)
    }

    fn makes_caustics(&self, _: Option<Aabb>, _: &Aim) -> bool {
        false
    }

    fn sample(&self, _: &Scene, _: Vec3, _: [f32; 2]) -> Option<LightSample> {
        None
    }

    fn escaped(&self, _: Vec3) -> Option<(f32, f32)> {
        Some((1.0, 0.0))
    }

    fn emit(&self, scene: &Scene, aim: &Aim, u: [f32; 2], v: [f32; 2]) -> Option<Emission> {
        Some(from_infinity(scene, uniform_sphere(v).normalize(), aim, 4.0 * PI, u))
    }

    fn emission_density(&self, _: &Exit, _: &Aim) -> Option<f32> {
        None
    }

    fn guided_pair(&self) -> Option<GuidedPair> {
        None
    }

    fn guided_numbers(&self, _: &Exit, _: &Aim) -> Option<[f32; 2]> {
        None
    }
}
