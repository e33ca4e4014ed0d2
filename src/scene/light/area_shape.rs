//! Surfaces that points can be drawn from uniformly by area.

use super::source::EmissionStart;
use crate::geometry::{geometric_normal, sample_triangle};
use crate::math;
use crate::sampling::{AliasTable, concentric_disk, uniform_sphere};
use crate::scene::Scene;
use glam::Vec3;

/// A surface that points can be drawn from uniformly by area.
#[derive(Debug, Clone)]
pub enum AreaShape {
    /// Triangles from `first` on, drawn by area.
    Triangles {
        /// Index of the first.
        first: u32,
        /// Draws one by area.
        table: AliasTable,
    },
    /// A parallelogram.
    Parallelogram {
        /// Corner.
        origin: Vec3,
        /// Edge.
        u: Vec3,
        /// Edge.
        v: Vec3,
        /// Unit normal along u × v.
        normal: Vec3,
    },
    /// An ellipse.
    Ellipse {
        /// Centre.
        center: Vec3,
        /// Half axis.
        u: Vec3,
        /// Half axis, conjugate to the first.
        v: Vec3,
        /// Unit normal along u × v.
        normal: Vec3,
    },
    /// A sphere.
    Sphere {
        /// Centre.
        center: Vec3,
        /// Radius.
        radius: f32,
    },
    /// A shape that no points are drawn from: only camera paths find it.
    Unsampled,
}

impl AreaShape {
    /// Whether points can be drawn.
    pub(super) fn is_sampled(&self) -> bool {
        !matches!(self, Self::Unsampled)
    }

    /// Draws a point uniform over the area, with its outward normal.
    pub(super) fn point(&self, scene: &Scene, u: [f32; 2]) -> Option<EmissionStart> {
        Some(match self {
            Self::Triangles { first, table } => {
                let draw = table.sample(u[0])?;
                let vertices = scene.triangles[*first as usize + draw.index].map(|i| scene.positions[i as usize]);
                let weights = sample_triangle([draw.rest, u[1]]);
                let normal = geometric_normal(vertices[0], vertices[1], vertices[2])?.as_vec3();
                let parts = std::array::from_fn::<Vec3, 3, _>(|i| vertices[i] * weights[i]);
                let size = parts[0].abs() + parts[1].abs() + parts[2].abs();
                EmissionStart { point: parts[0] + parts[1] + parts[2], error: size * math::gamma(7), normal }
            }
            Self::Parallelogram { origin, u: a, v: b, normal } => on_plane(*origin, *a * u[0], *b * u[1], *normal),
            Self::Ellipse { center, u: a, v: b, normal } => {
                let [x, y] = concentric_disk(u);
                on_plane(*center, *a * x, *b * y, *normal)
            }
            Self::Sphere { center, radius } => {
                let normal = uniform_sphere(u).normalize();
                let error = (center.abs() + *radius) * math::gamma(5);
                EmissionStart { point: *center + normal * *radius, error, normal }
            }
            Self::Unsampled => return None,
        })
    }
}

/// The point of a plane at `origin` + `a` + `b`.
fn on_plane(origin: Vec3, a: Vec3, b: Vec3, normal: Vec3) -> EmissionStart {
    EmissionStart { point: origin + a + b, error: (origin.abs() + a.abs() + b.abs()) * math::gamma(7), normal }
}
