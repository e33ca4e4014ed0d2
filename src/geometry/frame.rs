//! Normals at a hit.

use glam::{DVec3, Vec3};

/// Normals of a surface at a hit, both turned to the side that is being looked at.
#[derive(Debug, Clone, Copy)]
pub struct Frame {
    /// Unit normal of the surface itself, in f64 since specular directions follow from it.
    pub geometric: DVec3,
    /// Normal interpolated between those of a mesh's vertices, or the geometric one.
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

    /// The frame without interpolation.
    pub fn without_shading(&self) -> Self {
        Self { geometric: self.geometric, shading: self.geometric.as_vec3() }
    }

    /// A local direction, z along the shading normal, in world coordinates.
    pub fn world_from_local(&self, local: Vec3) -> Vec3 {
        let (s, t) = orthonormal_basis(self.shading);
        s * local.x + t * local.y + self.shading * local.z
    }
}

/// Two unit vectors that make a right-handed frame with the unit vector `n` as third \[Duff2017\].
pub fn orthonormal_basis(n: Vec3) -> (Vec3, Vec3) {
    let sign = 1.0f32.copysign(n.z);
    let a = -1.0 / (sign + n.z);
    let b = n.x * n.y * a;
    (Vec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x), Vec3::new(b, sign + n.y * n.y * a, -n.y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bases_are_right_handed() {
        for i in 0..1000i32 {
            let n = Vec3::new((i % 7 - 3) as f32, (i % 11 - 5) as f32, (i % 13 - 6) as f32).normalize_or(-Vec3::Z);
            let (s, t) = orthonormal_basis(n);
            assert!(s.cross(t).distance(n) < 1e-5 && s.dot(t).abs() < 1e-6);
        }
    }
}
