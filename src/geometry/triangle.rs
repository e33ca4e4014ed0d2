//! One triangle: the watertight intersection with its error bound, the normal, sampling by area.

use super::Ray;
use crate::math::gamma;
use glam::{DVec3, Vec3};

/// A ray's frame for the watertight triangle test: the axes are permuted so that the direction's largest component
/// comes last, and sheared so that the direction becomes that axis \[Woop2013\].
///
/// The sign of an edge function of the sheared, rounded vertices cannot come out wrong (the two products are rounded
/// monotonically), only 0; edges are inclusive, so triangles that share vertices leave no gap between them.
#[derive(Debug, Clone, Copy)]
pub(super) struct ShearedRay {
    /// The coordinates that become x, y and z.
    pub axes: [usize; 3],
    /// d_x/d_z, d_y/d_z and 1/d_z of the permuted direction.
    pub shear: Vec3,
    /// Permuted origin.
    pub origin: Vec3,
}

impl ShearedRay {
    /// The frame of a ray; `None` for a direction without length or with NaN.
    #[inline]
    pub fn new(ray: &Ray) -> Option<Self> {
        let size = ray.direction.abs();
        let last_is_x = size.x > size.y && size.x > size.z;
        let z = if last_is_x { 0 } else { 2 - usize::from(size.y > size.z) };
        // Arrays: a component of a vector by its index is a jump, which no processor foresees.
        let (d, o) = (ray.direction.to_array(), ray.origin.to_array());
        if !(d[z].abs() > 0.0 && ray.direction.is_finite() && ray.origin.is_finite()) {
            return None;
        }
        let (x, y) = ((z + 1) % 3, (z + 2) % 3);
        let rate = 1.0 / d[z];
        Some(Self {
            axes: [x, y, z],
            shear: Vec3::new(d[x] * rate, d[y] * rate, rate),
            origin: Vec3::new(o[x], o[y], o[z]),
        })
    }

    /// A vertex in the frame, relative to the origin; z is not yet divided by d_z.
    #[inline(always)]
    fn apply(&self, vertex: Vec3) -> Vec3 {
        let v = vertex.to_array();
        let [x, y, z] = self.axes;
        let depth = v[z] - self.origin.z;
        Vec3::new((v[x] - self.origin.x) - self.shear.x * depth, (v[y] - self.origin.y) - self.shear.y * depth, depth)
    }
}

/// Where a ray meets a triangle that the traversal has found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TriangleHit {
    /// Weights of the three vertices, ≥ 0; their sum is 1 up to rounding.
    pub barycentrics: [f32; 3],
    /// Σ bᵢ vᵢ, on the triangle up to `error` and independent of the rounding of the distance.
    pub point: Vec3,
    /// Bound of the error of each component of `point`: γ₇ Σ|bᵢ vᵢ| [PBRT4, 6.8.4].
    pub error: Vec3,
}

impl TriangleHit {
    /// The hit of a ray with a triangle, from the edge functions of the traversal; `None` where the traversal would
    /// not hit either.
    #[inline]
    pub fn new(ray: &Ray, vertices: [Vec3; 3]) -> Option<Self> {
        let frame = ShearedRay::new(ray)?;
        let [a, b, c] = vertices.map(|vertex| frame.apply(vertex));
        let (u, v, w) = (c.x * b.y - c.y * b.x, a.x * c.y - a.y * c.x, b.x * a.y - b.y * a.x);
        let one_side = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
        let determinant = u + v + w;
        if !one_side || determinant == 0.0 {
            return None;
        }
        let barycentrics = [u / determinant, v / determinant, w / determinant];
        let [wa, wb, wc] = barycentrics;
        let parts = [vertices[0] * wa, vertices[1] * wb, vertices[2] * wc];
        let size = parts[0].abs() + parts[1].abs() + parts[2].abs();
        Some(Self { barycentrics, point: parts[0] + parts[1] + parts[2], error: size * gamma(7) })
    }
}

/// The cross product of two edges in f64, of twice the triangle's area; it points to the side from which the vertices run
/// counter-clockwise. Zero for a degenerate triangle.
#[inline]
pub(super) fn double_area_vector(v0: Vec3, v1: Vec3, v2: Vec3) -> DVec3 {
    let [v0, v1, v2] = [v0, v1, v2].map(|v| v.as_dvec3());
    (v1 - v0).cross(v2 - v0)
}

/// The unit normal on the side from which the vertices run counter-clockwise; `None` for a triangle without area.
#[inline]
pub fn geometric_normal(v0: Vec3, v1: Vec3, v2: Vec3) -> Option<DVec3> {
    let cross = double_area_vector(v0, v1, v2);
    let length = cross.length();
    // f32 input: the squared length neither overflows nor vanishes in f64 unless it is exactly 0.
    (length > 0.0).then(|| cross / length)
}

/// Area, computed in f64 and rounded.
pub fn triangle_area(v0: Vec3, v1: Vec3, v2: Vec3) -> f32 {
    (0.5 * double_area_vector(v0, v1, v2).length()) as f32
}

/// Barycentrics uniform over a triangle's area from a point of the unit square [0, 1)². The map is continuous and
/// keeps neighbours together, so a well-spread point set stays so \[Heitz2019\]. The weights are ≥ 0 and sum to 1 up to
/// rounding.
pub fn sample_triangle(u: [f32; 2]) -> [f32; 3] {
    let (b0, b1) = if u[0] < u[1] {
        let b0 = 0.5 * u[0];
        (b0, u[1] - b0)
    } else {
        let b1 = 0.5 * u[1];
        (u[0] - b1, b1)
    };
    [b0, b1, (1.0 - b0 - b1).max(0.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(state: &mut u64) -> f32 {
        *state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (*state >> 40) as f32 / (1u64 << 24) as f32
    }

    fn point(state: &mut u64) -> Vec3 {
        Vec3::new(unit(state), unit(state), unit(state)) * 2.0 - 1.0
    }

    #[test]
    fn hit_points_are_within_their_bound_of_the_plane() {
        let mut state = 1;
        let mut hits = 0;
        let mut worst: f64 = 0.0;
        for _ in 0..200_000 {
            let [a, b, c] = [0; 3].map(|_| point(&mut state));
            let ray = Ray { origin: point(&mut state) * 2.0, direction: point(&mut state).normalize() };
            let Some(hit) = TriangleHit::new(&ray, [a, b, c]) else { continue };
            hits += 1;
            assert!(hit.barycentrics.iter().all(|&weight| weight >= 0.0));
            let sum: f32 = hit.barycentrics.iter().sum();
            assert!((sum - 1.0).abs() <= 3.0 * f32::EPSILON, "{sum}");
            let normal = double_area_vector(a, b, c);
            let distance = (hit.point.as_dvec3() - a.as_dvec3()).dot(normal).abs();
            worst = worst.max(distance / normal.abs().dot(hit.error.as_dvec3()));
        }
        assert!(hits > 2_000, "{hits}");
        assert!(worst < 1.0 && worst > 0.05, "largest share of the bound: {worst}");
    }

    #[test]
    fn normals_point_to_the_counter_clockwise_side() {
        assert_eq!(geometric_normal(Vec3::ZERO, Vec3::X, Vec3::Y), Some(DVec3::Z));
        assert_eq!(geometric_normal(Vec3::ZERO, Vec3::Y, Vec3::X), Some(-DVec3::Z));
        assert_eq!(geometric_normal(Vec3::ZERO, Vec3::X, Vec3::X * 2.0), None);
        let tiny = 1e-30;
        assert_eq!(geometric_normal(Vec3::ZERO, Vec3::X * tiny, Vec3::Y * tiny), Some(DVec3::Z));
        assert_eq!(triangle_area(Vec3::ZERO, Vec3::X * 2.0, Vec3::Y * 3.0), 3.0);
    }

    #[test]
    fn samples_are_uniform_over_the_area() {
        // The regions bᵢ > ½ and the middle have a quarter of the area each.
        let n = 512;
        let mut counts = [0; 4];
        for i in 0..n * n {
            let u = [(i % n) as f32 + 0.5, (i / n) as f32 + 0.5].map(|x| x / n as f32);
            let weights = sample_triangle(u);
            assert!(weights.iter().all(|&weight| weight >= 0.0));
            assert!((weights.iter().sum::<f32>() - 1.0).abs() <= f32::EPSILON);
            counts[weights.iter().position(|&weight| weight > 0.5).unwrap_or(3)] += 1;
        }
        for count in counts {
            let share = f64::from(count) / f64::from(n * n);
            assert!((share - 0.25).abs() < 0.003, "{counts:?}");
        }
        let last = 1.0 - f32::EPSILON * 0.5;
        assert!(sample_triangle([last, last]).iter().all(|&weight| weight >= 0.0));
    }
}
