//! The light of a surface that emits.

use super::aim::{Aim, sphere_cone, turned};
use super::area_shape::AreaShape;
use super::source::{Emission, EmissionStart, Exit, Extent, GuidedPair, LightSample, LightSource, SMALL_LIGHT_SR};
use crate::geometry::{Aabb, offset_origin, orthonormal_basis};
use crate::math;
use crate::sampling::{cosine_hemisphere, uniform_cone, uniform_cone_inverse};
use crate::scene::{Scene, Surface};
use glam::Vec3;
use std::f32::consts::{FRAC_1_PI, PI, TAU};

/// A surface of equal radiance in all directions.
#[derive(Debug, Clone)]
pub struct AreaLight {
    /// The surface, for drawing points.
    pub shape: AreaShape,
    /// Area of one side.
    pub area: f32,
    /// Whether the back emits as well.
    pub two_sided: bool,
}

impl AreaLight {
    /// Area that emits, of both sides where both do.
    pub(super) fn emitting_area(&self) -> f32 {
        self.area * if self.two_sided { 2.0 } else { 1.0 }
    }

    /// Whether a surface of the light that is hit in this direction emits towards where the ray comes from.
    pub(super) fn emits(&self, surface: &Surface, direction: Vec3) -> bool {
        self.two_sided || surface.geometric.as_vec3().dot(direction) < 0.0
    }

    /// Density with which [`LightSource::sample`] draws the direction of a ray from `from` that met the light.
    pub(super) fn pdf_surface(&self, from: Vec3, direction: Vec3, surface: &Surface) -> f32 {
        match self.shape {
            AreaShape::Unsampled => 0.0,
            AreaShape::Sphere { center, radius } if !self.two_sided => {
                sphere_cone(center, radius, from).map_or(0.0, |one_minus_cos| 1.0 / (TAU * one_minus_cos))
            }
            _ => {
                let cos = surface.geometric.as_vec3().dot(direction).abs();
                from.distance_squared(surface.point) / (cos * self.area)
            }
        }
    }
}

impl LightSource for AreaLight {
    fn power(&self, _: f32) -> f64 {
        std::f64::consts::PI * f64::from(self.area) * if self.two_sided { 2.0 } else { 1.0 }
    }

    fn is_sampled(&self) -> bool {
        self.shape.is_sampled()
    }

    fn is_local(&self) -> bool {
        false
    }

    fn can_emit(&self) -> bool {
        self.shape.is_sampled()
    }

    fn extent(&self) -> Extent {
        Extent::Surface
    }

    fn aimed_share(&self, bounds: Option<Aabb>, aim: &Aim, _: f32) -> f32 {
        bounds.and_then(|bounds| aim.cone(bounds.center())).map_or(1.0, |(_, cone)| 0.5 * cone)
    }

    fn makes_caustics(&self, bounds: Option<Aabb>, aim: &Aim) -> bool {
        let distance2 = bounds.map_or(0.0, |b| b.center().distance_squared(aim.center)).max(aim.radius * aim.radius);
        self.can_emit() && self.area < SMALL_LIGHT_SR * distance2
    }

    fn sample(&self, scene: &Scene, from: Vec3, u: [f32; 2]) -> Option<LightSample> {
        if let AreaShape::Sphere { center, radius } = self.shape
            && !self.two_sided
        {
            return sample_sphere(center, radius, from, u);
        }
        let start = self.shape.point(scene, u)?;
        let to_light = start.point - from;
        let distance2 = to_light.length_squared();
        let wi = to_light / distance2.sqrt();
        let cos = -start.normal.dot(wi);
        let facing = if self.two_sided { cos.abs() } else { cos };
        if facing.is_nan() || facing <= 0.0 || distance2 == 0.0 {
            return None;
        }
        let solid_angle = facing * self.area / distance2;
        let target = offset_origin(start.point, start.error, start.normal, -wi);
        Some(LightSample { target: Some(target), wi, weight: solid_angle, pdf: Some(1.0 / solid_angle) })
    }

    fn escaped(&self, _: Vec3) -> Option<(f32, f32)> {
        None
    }

    fn emit(&self, scene: &Scene, aim: &Aim, u: [f32; 2], v: [f32; 2]) -> Option<Emission> {
        // A two-sided light uses the first number to choose a side as well.
        let (side, u) = match self.two_sided {
            true if u[0] < 0.5 => (-1.0, [2.0 * u[0], u[1]]),
            true => (1.0, [2.0 * u[0] - 1.0, u[1]]),
            false => (1.0, u),
        };
        let start = self.shape.point(scene, u)?;
        let normal = start.normal * side;
        let start = EmissionStart { normal, ..start };
        let area = self.emitting_area();
        let aimed = if self.two_sided { None } else { aim.sample(start.point, v) };
        let (direction, weight) = match aimed {
            Some((direction, solid_angle)) => (direction, area * solid_angle * normal.dot(direction)),
            None => (turned(normal, cosine_hemisphere(v)), area * PI),
        };
        (weight > 0.0).then_some(Emission { start, direction, weight })
    }

    fn emission_density(&self, exit: &Exit, aim: &Aim) -> Option<f32> {
        let per_area = 1.0 / self.emitting_area();
        Some(match aim.cone(exit.point) {
            Some((_, one_minus_cos)) if !self.two_sided => per_area / (TAU * one_minus_cos * exit.cos),
            _ => per_area * FRAC_1_PI,
        })
    }

    fn guided_pair(&self) -> Option<GuidedPair> {
        (!self.two_sided).then_some(GuidedPair::Direction)
    }

    fn guided_numbers(&self, exit: &Exit, aim: &Aim) -> Option<[f32; 2]> {
        if self.two_sided {
            return None;
        }
        let (axis, one_minus_cos) = aim.cone(exit.point)?;
        let (s, t) = orthonormal_basis(axis);
        let local = Vec3::new(s.dot(exit.direction), t.dot(exit.direction), axis.dot(exit.direction));
        Some(uniform_cone_inverse(local, one_minus_cos))
    }
}

/// Draws a direction uniform in the cone of a sphere that emits outward; the target is where it meets the sphere.
fn sample_sphere(center: Vec3, radius: f32, from: Vec3, u: [f32; 2]) -> Option<LightSample> {
    let one_minus_cos = sphere_cone(center, radius, from)?;
    let to_center = center - from;
    let distance = to_center.length();
    let axis = to_center / distance;
    let (s, t) = orthonormal_basis(axis);
    let local = uniform_cone(u, one_minus_cos);
    let wi = s * local.x + t * local.y + axis * local.z;
    // The normal at the hit follows from the triangle of centre, reference point and hit.
    let sin2 = local.x * local.x + local.y * local.y;
    let half_chord = (radius * radius - distance * distance * sin2).max(0.0).sqrt();
    let normal = (wi * (distance * local.z - half_chord) - to_center) / radius;
    let normal = normal.normalize();
    let error = (center.abs() + radius) * math::gamma(5);
    let target = offset_origin(center + normal * radius, error, normal, normal);
    let pdf = 1.0 / (TAU * one_minus_cos);
    Some(LightSample { target: Some(target), wi, weight: 1.0 / pdf, pdf: Some(pdf) })
}
