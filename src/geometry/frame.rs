//! Normals at a hit.

use crate::sampling::orthonormal_basis;
use glam::{DVec3, Vec3};

/// Normals of a surface at a hit, both turned to the side that is being looked at.
#[derive(Debug, Clone, Copy)]
pub struct Frame {
    /// Of the surface as it is; unit, f64 since specular directions follow from it.
    pub geometric: DVec3,
    /// Interpolated where a mesh has vertex normals, else the same.
    pub shading: Vec3,
}

impl Frame {
    /// Whether two directions are on the same side of the surface.
    pub fn same_side(&self, a: Vec3, b: Vec3) -> bool {
        let n = self.geometric.as_vec3();
        n.dot(a) * n.dot(b) > 0.0
    }

    /// Cosine of a unit direction to the shading normal.
    pub fn cos_shading(&self, w: Vec3) -> f32 {
        self.shading.dot(w)
    }

    /// A local direction, z along the shading normal, in world coordinates.
    pub fn world_from_local(&self, local: Vec3) -> Vec3 {
        let (s, t) = orthonormal_basis(self.shading);
        s * local.x + t * local.y + self.shading * local.z
    }
}
