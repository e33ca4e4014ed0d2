//! Bringing a scene to unit size around the origin, by a shift and a power of two.

use super::place::Placed;
use crate::scene::description::{LightKind, SceneDescription};
use glam::{DAffine3, DMat3, DVec3};

/// p ↦ (p − center) / `meters_per_unit`.
///
/// The scale is a power of two and the centre a multiple of 2⁻²⁰ of it, so that a scene at any power-of-two scale compiles to
/// the same bits, and no precision is lost far from the origin.
#[derive(Debug, Clone, Copy)]
pub struct Normalization {
    center: DVec3,
    /// Length of a unit, metres; a power of two.
    pub meters_per_unit: f64,
    /// Radius of a sphere about the origin that holds everything, in units.
    pub radius: f32,
}

impl Normalization {
    /// From the bounds of shapes, camera and finite lights.
    pub fn of(description: &SceneDescription, placed: &[Placed]) -> Self {
        let camera = DVec3::from(description.camera.from);
        let lens = description.camera.aperture_radius;
        let (mut min, mut max) = (camera - lens, camera + lens);
        let mut include = |a: DVec3, b: DVec3| {
            min = min.min(a);
            max = max.max(b);
        };
        for shape in placed {
            let (a, b) = shape.bounds();
            include(a, b);
        }
        for light in &description.lights {
            match &light.kind {
                LightKind::Point { position, .. } | LightKind::Spot { position, .. } => {
                    include(DVec3::from(*position), DVec3::from(*position));
                }
                LightKind::Beam { origin, radius, .. } => {
                    include(DVec3::from(*origin) - *radius, DVec3::from(*origin) + *radius);
                }
                LightKind::Directional { .. } => {}
            }
        }
        let half_diagonal = (max - min).length() * 0.5;
        let meters_per_unit = power_of_two_above(half_diagonal);
        let grid = meters_per_unit / f64::from(1 << 20);
        let center = ((min + max) * 0.5 / grid).round() * grid;
        let radius = (min - center).abs().max((max - center).abs()).length() / meters_per_unit;
        // A little more than everything, so that discs of light paths overlap the rim.
        Self { center, meters_per_unit, radius: (radius * 1.000_001).max(f64::from(f32::MIN_POSITIVE)) as f32 }
    }

    /// A point.
    pub fn point(&self, meters: DVec3) -> DVec3 {
        (meters - self.center) / self.meters_per_unit
    }

    /// A length.
    pub fn length(&self, meters: f64) -> f64 {
        meters / self.meters_per_unit
    }

    /// A transform into metres, followed by this one.
    pub fn after(&self, meters_from_object: DAffine3) -> DAffine3 {
        let scale = DMat3::from_diagonal(DVec3::splat(1.0 / self.meters_per_unit));
        DAffine3::from_mat3_translation(scale * meters_from_object.matrix3, self.point(meters_from_object.translation))
    }
}

/// The smallest power of two that is greater than `x`; 1 for 0.
pub fn power_of_two_above(x: f64) -> f64 {
    if !(x.is_normal() && x > 0.0) {
        return 1.0;
    }
    // Keeping the exponent's bits alone gives the power of two at or below.
    2.0 * f64::from_bits(x.to_bits() & (0x7ff << 52))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_two() {
        for (x, p) in [(0.7, 1.0), (1.0, 2.0), (1.5, 2.0), (5.0, 8.0), (1e-9, f64::from_bits(0x3e20_0000_0000_0000))] {
            assert_eq!(power_of_two_above(x), p);
        }
        assert_eq!(power_of_two_above(0.0), 1.0);
    }
}
