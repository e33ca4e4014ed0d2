//! Surfaces that points can be drawn from uniformly by area.

use super::source::EmissionStart;
use crate::geometry::{Patch, TriangleId, geometric_normal, sample_triangle};
use crate::math;
use crate::sampling::{AliasTable, concentric_disk, uniform_sphere};
use crate::scene::Scene;
use glam::{DVec3, Vec3};

/// A surface that points can be drawn from uniformly by area.
#[derive(Debug, Clone)]
pub enum AreaShape {
    /// Triangles from `first` on, drawn by area.
    Triangles {
        /// The first.
        first: TriangleId,
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
    /// The side of a right circular cylinder.
    Tube {
        /// Centre.
        center: Vec3,
        /// From the centre to that of an end.
        half_axis: Vec3,
        /// Two unit vectors across the axis.
        across: [Vec3; 2],
        /// Radius.
        radius: f32,
    },
    /// Several surfaces.
    Parts {
        /// The surfaces.
        parts: Vec<Self>,
        /// Draws one by area.
        table: AliasTable,
    },
    /// A shape that no points are drawn from: only camera paths find it.
    Unsampled,
}

impl AreaShape {
    /// The surface of these pieces.
    pub(in crate::scene) fn of(patches: &[Patch]) -> Self {
        if let [patch] = patches {
            return Self::of_patch(patch);
        }
        let areas: Vec<f64> = patches.iter().map(Patch::area).collect();
        Self::Parts { parts: patches.iter().map(Self::of_patch).collect(), table: AliasTable::new(&areas) }
    }

    fn of_patch(patch: &Patch) -> Self {
        let normal = |u: DVec3, v: DVec3| u.cross(v).normalize().as_vec3();
        match *patch {
            Patch::Parallelogram { origin, u, v } => {
                Self::Parallelogram { origin: origin.as_vec3(), u: u.as_vec3(), v: v.as_vec3(), normal: normal(u, v) }
            }
            Patch::Ellipse { center, u, v } => {
                Self::Ellipse { center: center.as_vec3(), u: u.as_vec3(), v: v.as_vec3(), normal: normal(u, v) }
            }
            Patch::Sphere { center, radius } => Self::Sphere { center: center.as_vec3(), radius: radius as f32 },
            Patch::Tube { center, half_axis, radius } => {
                let (s, t) = half_axis.normalize().any_orthonormal_pair();
                Self::Tube {
                    center: center.as_vec3(),
                    half_axis: half_axis.as_vec3(),
                    across: [s.as_vec3(), t.as_vec3()],
                    radius: radius as f32,
                }
            }
        }
    }

    /// Whether points can be drawn.
    pub(super) fn is_sampled(&self) -> bool {
        !matches!(self, Self::Unsampled)
    }

    /// Draws a point uniform over the area, with its outward normal.
    pub(super) fn point(&self, scene: &Scene, u: [f32; 2]) -> Option<EmissionStart> {
        Some(match self {
            Self::Triangles { first, table } => {
                let draw = table.sample(u[0])?;
                let vertices = scene.triangles[first.0 as usize + draw.index].map(|i| scene.positions[i as usize]);
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
            Self::Tube { center, half_axis, across, radius } => {
                let (sin, cos) = math::sin_cos_turns(u[0]);
                let normal = (across[0] * cos + across[1] * sin).normalize();
                let error = (center.abs() + half_axis.abs() + *radius) * math::gamma(7);
                EmissionStart { point: *center + *half_axis * (2.0 * u[1] - 1.0) + normal * *radius, error, normal }
            }
            Self::Parts { parts, table } => {
                let draw = table.sample(u[0])?;
                return parts[draw.index].point(scene, [draw.rest, u[1]]);
            }
            Self::Unsampled => return None,
        })
    }
}

/// The point of a plane at `origin` + `a` + `b`.
fn on_plane(origin: Vec3, a: Vec3, b: Vec3, normal: Vec3) -> EmissionStart {
    EmissionStart { point: origin + a + b, error: (origin.abs() + a.abs() + b.abs()) * math::gamma(7), normal }
}
