//! What light paths are aimed at, and the cones in which spheres are seen.

use crate::geometry::orthonormal_basis;
use crate::sampling::uniform_cone;
use glam::Vec3;
use std::f32::consts::TAU;

/// A sphere that light paths are aimed at: it holds everything that matters to them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aim {
    /// Centre.
    pub center: Vec3,
    /// Radius.
    pub radius: f32,
}

impl Aim {
    /// Axis and 1 − cos of the half angle of the cone in which the sphere is seen; `None` from inside.
    pub(super) fn cone(&self, from: Vec3) -> Option<(Vec3, f32)> {
        let one_minus_cos = sphere_cone(self.center, self.radius, from)?;
        Some(((self.center - from).normalize(), one_minus_cos))
    }

    /// Draws a direction uniform in that cone; gives the cone's solid angle with it.
    pub(super) fn sample(&self, from: Vec3, u: [f32; 2]) -> Option<(Vec3, f32)> {
        let (axis, one_minus_cos) = self.cone(from)?;
        Some((turned(axis, uniform_cone(u, one_minus_cos)), TAU * one_minus_cos))
    }
}

/// Turns a direction given about +z so that +z becomes `axis`.
pub(super) fn turned(axis: Vec3, local: Vec3) -> Vec3 {
    let (s, t) = orthonormal_basis(axis);
    (s * local.x + t * local.y + axis * local.z).normalize()
}

/// 1 − cos of the half angle under which a sphere is seen; `None` from inside.
pub(super) fn sphere_cone(center: Vec3, radius: f32, from: Vec3) -> Option<f32> {
    let distance2 = f64::from(center.distance_squared(from));
    let sin2 = f64::from(radius) * f64::from(radius) / distance2;
    // 1 − √(1 − s) = s / (1 + √(1 − s)), without cancellation for far spheres.
    (sin2 < 1.0).then(|| (sin2 / (1.0 + (1.0 - sin2).sqrt())) as f32)
}
