//! Rays, and where to start a ray that leaves a surface.

use glam::Vec3;

/// A half line. Its direction is a unit vector up to rounding; distances are counted in its length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Start.
    pub origin: Vec3,
    /// Direction.
    pub direction: Vec3,
}

impl Ray {
    /// The point at distance `t`.
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + self.direction * t
    }
}

/// The start of a ray that leaves a surface: `point` moved along the unit geometric normal to the side that `direction`
/// points to, by as much as the true surface can be off (`error`: bound of each component of `point`), each component then
/// rounded away from the surface. No length of the scene enters, so no scale is special [PBRT4, 6.8.6].
pub fn offset_origin(point: Vec3, error: Vec3, normal: Vec3, direction: Vec3) -> Vec3 {
    let distance = normal.abs().dot(error);
    let side = if normal.dot(direction) < 0.0 { -1.0 } else { 1.0 };
    let offset = normal * (distance * side);
    let moved = point + offset;
    let away = |p: f32, o: f32| {
        if o > 0.0 {
            p.next_up()
        } else if o < 0.0 {
            p.next_down()
        } else {
            p
        }
    };
    Vec3::new(away(moved.x, offset.x), away(moved.y, offset.y), away(moved.z, offset.z))
}
