//! What the tree is made of: references, nodes of eight boxes, packets of eight triangles, and their intersection with a
//! ray in eight lanes.

use super::super::triangle::ShearedRay;
use super::super::{Aabb, Ray};
use glam::Vec3;
use wide::f32x8;

/// Children of a node.
pub(super) const WIDTH: usize = 8;

/// Triangles of a packet. Eight were 15 to 25 % faster than four in every scene of `benches/traversal.rs`, in less memory.
pub(super) const PACKET: usize = 8;
type PacketLanes = f32x8;

/// Growth of a far plane's distance: the near one carries three roundings, the far one four, (1 + γ₃)/(1 − γ₄) < 1 + 8u
/// \[Ize2013\].
const FAR_GROWTH: f32 = 1.0 + 4.0 * f32::EPSILON;

/// What a child is, packed in 32 bits: two for the kind, the rest an index.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Reference(pub u32);

/// A reference unpacked.
pub(super) enum Target {
    Node(usize),
    Packet(usize),
    Analytic(u32),
}

impl Reference {
    const LEAF: u32 = 1 << 31;
    const ANALYTIC: u32 = 1 << 30;
    /// Largest index that fits.
    pub const MAX_INDEX: usize = (1 << 30) - 1;
    /// A child that is not there: a packet far out of range.
    pub const EMPTY: Self = Self(Self::LEAF | Self::MAX_INDEX as u32);

    pub fn node(index: usize) -> Self {
        Self(index as u32)
    }

    pub fn packet(index: usize) -> Self {
        Self(index as u32 | Self::LEAF)
    }

    pub fn analytic(index: u32) -> Self {
        Self(index | Self::LEAF | Self::ANALYTIC)
    }

    #[inline(always)]
    pub fn target(self) -> Target {
        let index = self.0 & Self::MAX_INDEX as u32;
        if self.0 & Self::LEAF == 0 {
            Target::Node(index as usize)
        } else if self.0 & Self::ANALYTIC == 0 {
            Target::Packet(index as usize)
        } else {
            Target::Analytic(index)
        }
    }
}

/// The larger of each lane, and `b` where `a` is NaN.
#[inline(always)]
fn max_or_second(a: f32x8, b: f32x8) -> f32x8 {
    // The x86 instruction gives the second operand when either is NaN, which is all that is needed, as `b` never is.
    if cfg!(any(target_arch = "x86_64", target_arch = "x86")) { a.fast_max(b) } else { a.max(b) }
}

/// The smaller of each lane, and `b` where `a` is NaN.
#[inline(always)]
fn min_or_second(a: f32x8, b: f32x8) -> f32x8 {
    if cfg!(any(target_arch = "x86_64", target_arch = "x86")) { a.fast_min(b) } else { a.min(b) }
}

/// A ray spread over the lanes, for boxes and triangles.
pub(super) struct RayLanes {
    origin: [f32x8; 3],
    /// 1/d for near planes.
    rate: [f32x8; 3],
    /// 1/d for far planes, a little longer.
    far_rate: [f32x8; 3],
    /// Which of (lower, upper) is the near plane: 1 for a negative direction, −0 included.
    sign: [usize; 3],
    axes: [usize; 3],
    sheared_origin: [PacketLanes; 3],
    shear: [PacketLanes; 3],
}

impl RayLanes {
    /// `None` for a ray that can hit nothing: not finite, or without a direction.
    #[inline(always)]
    pub fn new(ray: &Ray) -> Option<Self> {
        let frame = ShearedRay::new(ray)?;
        let splat = |v: Vec3| v.to_array().map(f32x8::splat);
        let rate = ray.direction.recip();
        Some(Self {
            origin: splat(ray.origin),
            rate: splat(rate),
            far_rate: splat(rate * FAR_GROWTH),
            sign: rate.to_array().map(|r| usize::from(r.is_sign_negative())),
            axes: frame.axes,
            sheared_origin: frame.origin.to_array().map(PacketLanes::splat),
            shear: frame.shear.to_array().map(PacketLanes::splat),
        })
    }
}

/// Eight boxes and what they hold. Absent children have inverted infinite boxes.
#[derive(Debug, Clone)]
pub(super) struct Node {
    /// By axis, then lower and upper.
    planes: [[f32x8; 2]; 3],
    pub children: [Reference; WIDTH],
}

impl Node {
    pub fn new(children: &[(Aabb, Reference)]) -> Self {
        let mut planes = [[[f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]]; 3];
        let mut references = [Reference::EMPTY; WIDTH];
        for (lane, (bounds, reference)) in children.iter().enumerate().take(WIDTH) {
            references[lane] = *reference;
            for (axis, plane) in planes.iter_mut().enumerate() {
                plane[0][lane] = bounds.min[axis];
                plane[1][lane] = bounds.max[axis];
            }
        }
        Self { planes: planes.map(|axis| axis.map(f32x8::new)), children: references }
    }

    /// Distances at which the ray enters the boxes, at least 0, and the mask of those that it meets within [0, limit].
    ///
    /// A ray that lies in a plane (0·∞ = NaN) is not constrained by it; roundings only ever widen the interval.
    #[inline(always)]
    pub fn intersect(&self, ray: &RayLanes, limit: f32) -> (f32x8, u32) {
        let mut near = f32x8::ZERO;
        let mut far = f32x8::splat(limit);
        for axis in 0..3 {
            let sign = ray.sign[axis] & 1;
            let enter = (self.planes[axis][sign] - ray.origin[axis]) * ray.rate[axis];
            let leave = (self.planes[axis][sign ^ 1] - ray.origin[axis]) * ray.far_rate[axis];
            near = max_or_second(enter, near);
            far = min_or_second(leave, far);
        }
        (near, near.simd_le(far).to_bitmask())
    }

    /// The box of one child.
    #[cfg(test)]
    pub fn bounds(&self, lane: usize) -> Aabb {
        let corner =
            |side: usize| Vec3::from_array([0, 1, 2].map(|axis: usize| self.planes[axis][side].to_array()[lane]));
        Aabb { min: corner(0), max: corner(1) }
    }
}

/// Share of the depths of a triangle's vertices below which a distance in f32 may have the wrong sign: 2⁻¹⁰, far more
/// than its error at any but the most grazing angles, as a doubtful hit costs little and occurs once a ray at most.
const DOUBT: f32 = 1.0 / 1024.0;

/// Eight triangles. Unused lanes hold three equal vertices, which nothing hits.
#[derive(Debug, Clone)]
pub(super) struct Packet {
    /// By vertex, then axis.
    vertices: [[PacketLanes; 3]; 3],
    pub triangles: [u32; PACKET],
}

impl Packet {
    pub fn new(triangles: &[(u32, [Vec3; 3])]) -> Self {
        let mut vertices = [[[0.0; PACKET]; 3]; 3];
        let mut ids = [u32::MAX; PACKET];
        for (lane, (id, corners)) in triangles.iter().enumerate().take(PACKET) {
            ids[lane] = *id;
            for (vertex, corner) in vertices.iter_mut().zip(corners) {
                for (axis, lanes) in vertex.iter_mut().enumerate() {
                    lanes[lane] = corner[axis];
                }
            }
        }
        Self { vertices: vertices.map(|vertex| vertex.map(PacketLanes::new)), triangles: ids }
    }

    /// Distances, the distances below which these cannot be trusted, and the mask of the triangles that the ray may meet
    /// within (0, limit]; the watertight test of \[Woop2013\], see [`ShearedRay`]. Both faces count.
    ///
    /// The distance is a sum of depths of the vertices that cancel where the ray starts near the triangle, and its
    /// error is in proportion to them. What is nearer than [`DOUBT`] of them is for [`Self::exact_distance`] to decide.
    #[inline(always)]
    pub fn intersect(&self, ray: &RayLanes, limit: f32) -> (PacketLanes, PacketLanes, u32) {
        let [x, y, z] = ray.axes;
        let sheared = |vertex: &[PacketLanes; 3]| {
            let depth = vertex[z] - ray.sheared_origin[2];
            let across = (vertex[x] - ray.sheared_origin[0]) - ray.shear[0] * depth;
            let up = (vertex[y] - ray.sheared_origin[1]) - ray.shear[1] * depth;
            (across, up, depth)
        };
        let (ax, ay, az) = sheared(&self.vertices[0]);
        let (bx, by, bz) = sheared(&self.vertices[1]);
        let (cx, cy, cz) = sheared(&self.vertices[2]);
        let (u, v, w) = (cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax);
        let zero = PacketLanes::ZERO;
        let front = u.simd_ge(zero) & v.simd_ge(zero) & w.simd_ge(zero);
        let back = u.simd_le(zero) & v.simd_le(zero) & w.simd_le(zero);
        let inside = front | back;
        if inside.to_bitmask() == 0 {
            return (zero, zero, 0);
        }
        let determinant = u + v + w;
        let t = (u * az + v * bz + w * cz) * ray.shear[2] / determinant;
        let flat = determinant.simd_eq(zero);
        let doubt = (az.abs() + bz.abs() + cz.abs()) * (ray.shear[2].abs() * DOUBT);
        let ahead = t.simd_gt(-doubt) & t.simd_le(PacketLanes::splat(limit));
        (t, doubt, (inside & ahead).to_bitmask() & !flat.to_bitmask())
    }

    /// Distance to the plane of one triangle, if that is ahead. A ray that leaves the triangle starts beside it by the
    /// rounding of f32, which f64 tells apart at any angle.
    pub fn exact_distance(&self, lane: usize, ray: &Ray) -> Option<f32> {
        let vertex = |v: usize| {
            let [x, y, z] = &self.vertices[v];
            Vec3::new(x.as_array()[lane], y.as_array()[lane], z.as_array()[lane]).as_dvec3()
        };
        let a = vertex(0);
        let normal = (vertex(1) - a).cross(vertex(2) - a);
        let t = normal.dot(a - ray.origin.as_dvec3()) / normal.dot(ray.direction.as_dvec3());
        (t > 0.0).then(|| (t as f32).max(f32::MIN_POSITIVE))
    }
}
