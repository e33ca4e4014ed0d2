//! Light from a disc at infinity, such as the sun, and parallel light.

use super::aim::{Aim, turned};
use super::source::{Emission, EmissionStart, Exit, Extent, GuidedPair, LightSample, LightSource, SMALL_LIGHT_SR};
use crate::geometry::{Aabb, orthonormal_basis};
use crate::sampling::{concentric_disk, concentric_disk_inverse, uniform_cone};
use crate::scene::Scene;
use glam::Vec3;
use std::f32::consts::{PI, TAU};

/// A disc at infinity, or parallel light if its size is 0.
#[derive(Debug, Clone)]
pub struct DirectionalLight {
    /// Unit direction of travel.
    pub direction: Vec3,
    /// 1 − cos of the disc's angular radius.
    pub one_minus_cos: f32,
}

impl DirectionalLight {
    /// Whether its rays are parallel.
    fn is_parallel(&self) -> bool {
        self.one_minus_cos == 0.0
    }

    /// Radiance per unit of irradiance on a surface that faces the disc: 1 / ∫ cos θ dω = 1 / (π sin²θ).
    fn radiance(&self) -> f32 {
        1.0 / (PI * self.one_minus_cos * (2.0 - self.one_minus_cos))
    }
}

impl LightSource for DirectionalLight {
    fn power(&self, scene_radius: f32) -> f64 {
        let (pi, radius) = (std::f64::consts::PI, f64::from(scene_radius));
        pi * radius * radius
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
        if self.one_minus_cos > 0.0 { Extent::Infinite } else { Extent::None }
    }

    fn aimed_share(&self, _: Option<Aabb>, aim: &Aim, scene_radius: f32) -> f32 {
        share_of_scene(aim, scene_radius)
    }

    fn makes_caustics(&self, _: Option<Aabb>, _: &Aim) -> bool {
        TAU * self.one_minus_cos < SMALL_LIGHT_SR
    }

    fn sample(&self, _: &Scene, _: Vec3, u: [f32; 2]) -> Option<LightSample> {
        if self.is_parallel() {
            return Some(LightSample { target: None, wi: -self.direction, weight: 1.0, pdf: None });
        }
        let (s, t) = orthonormal_basis(-self.direction);
        let local = uniform_cone(u, self.one_minus_cos);
        let wi = s * local.x + t * local.y - self.direction * local.z;
        let pdf = 1.0 / (TAU * self.one_minus_cos);
        Some(LightSample { target: None, wi, weight: self.radiance() / pdf, pdf: Some(pdf) })
    }

    fn escaped(&self, direction: Vec3) -> Option<(f32, f32)> {
        if self.is_parallel() {
            return None;
        }
        // 1 − cos of the angle between unit vectors is half their squared distance: no digits are lost.
        let inside = 0.5 * (direction + self.direction).length_squared() <= self.one_minus_cos;
        inside.then(|| (self.radiance(), 1.0 / (TAU * self.one_minus_cos)))
    }

    fn emit(&self, scene: &Scene, aim: &Aim, u: [f32; 2], v: [f32; 2]) -> Option<Emission> {
        let direction = turned(self.direction, uniform_cone(v, self.one_minus_cos));
        // Radiance times solid angle: 1 up to the cosine in `radiance`.
        Some(from_infinity(scene, direction, aim, 2.0 / (2.0 - self.one_minus_cos), u))
    }

    fn emission_density(&self, _: &Exit, aim: &Aim) -> Option<f32> {
        (!self.is_parallel()).then(|| 1.0 / (TAU * self.one_minus_cos * PI * aim.radius * aim.radius))
    }

    fn guided_pair(&self) -> Option<GuidedPair> {
        Some(GuidedPair::Point)
    }

    fn guided_numbers(&self, exit: &Exit, aim: &Aim) -> Option<[f32; 2]> {
        if self.is_parallel() {
            return None;
        }
        let (s, t) = orthonormal_basis(exit.direction);
        let offset = (exit.point - aim.center) / aim.radius;
        Some(concentric_disk_inverse([s.dot(offset), t.dot(offset)]))
    }
}

/// Share of the light that comes from infinity onto the scene's cross section and onto that of what is aimed at.
pub(super) fn share_of_scene(aim: &Aim, scene_radius: f32) -> f32 {
    let ratio = aim.radius / scene_radius;
    ratio * ratio
}

/// A point of a disc of `radius` across `direction`.
pub(super) fn disc_offset(direction: Vec3, radius: f32, u: [f32; 2]) -> Vec3 {
    let (s, t) = orthonormal_basis(direction);
    let [x, y] = concentric_disk(u);
    (s * x + t * y) * radius
}

/// A ray from outside the scene onto the disc that faces it and holds what is aimed at.
pub(super) fn from_infinity(scene: &Scene, direction: Vec3, aim: &Aim, solid_angle: f32, u: [f32; 2]) -> Emission {
    let Aim { center, radius } = *aim;
    let point = center + disc_offset(direction, radius, u) - direction * (2.0 * scene.radius + center.length());
    Emission { start: EmissionStart::free(point), direction, weight: solid_angle * PI * radius * radius }
}
