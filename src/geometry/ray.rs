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
/// rounded away from the surface by one or two units in its last place. No length of the scene enters, so no scale is
/// special [PBRT4, 6.8.6].
#[inline]
pub fn offset_origin(point: Vec3, error: Vec3, normal: Vec3, direction: Vec3) -> Vec3 {
    let distance = normal.abs().dot(error);
    let side = if normal.dot(direction) < 0.0 { -1.0 } else { 1.0 };
    let offset = normal * (distance * side);
    let moved = point + offset;
    // Without a branch on the signs, which are anyone's guess. The smallest normal number is for components of about 0.
    let away = |p: f32, o: f32| {
        let step = p.abs() * f32::EPSILON + f32::MIN_POSITIVE;
        if o == 0.0 { p } else { p + step.copysign(o) }
    };
    Vec3::new(away(moved.x, offset.x), away(moved.y, offset.y), away(moved.z, offset.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every component that moves is at least one number farther out than the offset alone brings it, at any size.
    #[test]
    fn origins_are_rounded_away() {
        for i in 0..4000i32 {
            let size = crate::math::pow(2.0, f64::from(i % 270 - 149)) as f32;
            let point = Vec3::new((i % 7 - 3) as f32, (i % 13 - 6) as f32, 0.0) * size;
            let normal = Vec3::new((i % 5 - 2) as f32, 0.0, (i % 3 - 1) as f32 + 0.5).normalize();
            let direction = Vec3::new(0.3, (i % 2) as f32, -0.4);
            let error = point.abs() * crate::math::gamma(7);
            let side = if normal.dot(direction) < 0.0 { -1.0 } else { 1.0 };
            let offset = normal * (normal.abs().dot(error) * side);
            let origin = offset_origin(point, error, normal, direction);
            for ((from, o), to) in (point + offset).to_array().into_iter().zip(offset.to_array()).zip(origin.to_array())
            {
                let far_enough = match o {
                    o if o > 0.0 => to >= from.next_up(),
                    o if o < 0.0 => to <= from.next_down(),
                    _ => to == from,
                };
                assert!(far_enough, "{from:e} {o:e} {to:e}");
                assert!((to - from).abs() <= 2.0 * (from.abs() * f32::EPSILON + f32::MIN_POSITIVE));
            }
        }
    }
}
