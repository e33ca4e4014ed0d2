//! The gyroid wall.

use glam::DVec3;

use super::number::Number;
use super::roots::Field;
use super::{Box3, positive};
use crate::{Error, ErrorKind, Result};

/// A wall about the gyroid g = sin x cos y + sin y cos z + sin z cos x = 0 \[Schoen1970\] (coordinates times 2π/period),
/// cut by a sphere about the origin: max(|g|/(√3 · 2π/period) − thickness/2, (|p|² − R²)/2R) = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gyroid {
    frequency: f64,
    flatness: f64,
    half_thickness: f64,
    radius: f64,
}

impl Gyroid {
    /// Most periods across the radius: the cost of a ray grows with them.
    pub const MAX_PERIODS: f64 = 100.0;

    /// Limit of the thickness, in periods: from there on the wall would fill the space.
    pub const MAX_THICKNESS: f64 = 0.25;

    /// A gyroid wall by the surface's period, the wall's thickness (to first order, where the gradient is largest and the
    /// wall thinnest; below a quarter of the period) and the radius of the sphere that cuts it, at most 100 periods.
    pub fn new(period: f64, thickness: f64, radius: f64) -> Result<Self> {
        positive("period", period)?;
        positive("thickness", thickness)?;
        positive("radius", radius)?;
        let out_of_range = |message: String| Err(Error::new(ErrorKind::OutOfRange, message));
        if thickness >= Self::MAX_THICKNESS * period {
            return out_of_range(format!(
                "thickness {thickness} is not below a quarter of the period {period}: the wall would fill the space"
            ));
        }
        if radius > Self::MAX_PERIODS * period {
            return out_of_range(format!("radius {radius} is more than {} periods of {period}", Self::MAX_PERIODS));
        }
        let frequency = std::f64::consts::TAU / period;
        // |∇g| is at most √3 on g = 0, reached at the origin among others.
        let flatness = 1.0 / (3f64.sqrt() * frequency);
        Ok(Self { frequency, flatness, half_thickness: 0.5 * thickness, radius })
    }

    pub(super) fn bounds(&self) -> Box3 {
        Box3::around(DVec3::ZERO, DVec3::splat(self.radius))
    }
}

impl Field for Gyroid {
    fn value<N: Number>(&self, [x, y, z]: [N; 3]) -> N {
        let ball = (x.square() + y.square() + z.square()).shift(-self.radius * self.radius).scale(0.5 / self.radius);
        let [(sin_x, cos_x), (sin_y, cos_y), (sin_z, cos_z)] = [x, y, z].map(|v| v.scale(self.frequency).sin_cos());
        let gyroid = sin_x * cos_y + sin_y * cos_z + sin_z * cos_x;
        gyroid.scale(self.flatness).abs().shift(-self.half_thickness).max(ball)
    }
}

#[cfg(test)]
mod tests {
    use super::super::roots::gradient;
    use super::*;

    #[test]
    fn slope_on_the_middle_surface_is_at_most_one() {
        let gyroid = Gyroid::new(1.0, 0.1, 100.0).unwrap();
        let mut steepest = 0.0f64;
        for i in 0..64 {
            for j in 0..64 {
                for k in 0..64 {
                    let p = (DVec3::new(f64::from(i), f64::from(j), f64::from(k)) + 1e-3) / 64.0;
                    let f = gyroid.value([p.x, p.y, p.z]) + 0.05;
                    if f < 0.02 {
                        steepest = steepest.max(gradient(&gyroid, p).length());
                    }
                }
            }
        }
        assert!((0.98..1.001).contains(&steepest), "{steepest}");
    }
}
