//! Hits on shapes that are intersected by their equations, and bounds of rounding errors.

use glam::{DVec3, Vec3};

/// Where a ray meets a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnalyticHit {
    /// Distance along the ray in lengths of its direction, > 0.
    pub t: f64,
    /// The point, in world space, moved onto the surface (it is not origin + t · direction).
    pub point: DVec3,
    /// Unit outward geometric normal; for an open shape the side that its normal points to.
    pub normal: DVec3,
    /// Bound of each component of `point.as_vec3()` against the true surface, its curvature included: what
    /// [`offset_origin`](super::offset_origin) needs to step off the surface on the side asked for.
    pub error: Vec3,
    /// Which surface of the shape.
    pub face: u8,
}

/// A hit in a shape's local space.
#[derive(Debug, Clone, Copy)]
pub(super) struct LocalHit {
    /// Distance along the ray, the same as in the world.
    pub t: f64,
    /// The point on the surface.
    pub point: DVec3,
    /// Outward normal of any length.
    pub normal: DVec3,
    /// How far `point` can be from the surface.
    pub distance: f64,
    /// Which surface of the shape.
    pub face: u8,
}

/// Half the spacing of f32, relative: rounding a coordinate moves it by at most this much of itself.
pub(super) const HALF_ULP: f64 = f32::EPSILON as f64 / 2.0;
/// Relative error of a few chained f64 operations.
pub(super) const F64_CHAIN: f64 = 16.0 * f64::EPSILON;

/// Rounds a bound of non-negative components to f32, up by at most 2⁻²²: cheaper than rounding up exactly.
pub(super) fn inflated(bound: DVec3) -> Vec3 {
    (bound * (1.0 + f64::from(f32::EPSILON)) + f64::from(f32::MIN_POSITIVE)).as_vec3()
}
