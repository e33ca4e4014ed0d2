//! Spheres melted into each other.

use glam::DVec3;

use super::number::Number;
use super::roots::Field;
use super::{Box3, positive};
use crate::{Error, ErrorKind, Result};

/// The smooth minimum \[Quilez2013\] of the spheres' algebraic distances (|p − c|² − r²)/2r, folded in the order given.
/// The cubic polynomial keeps curvature continuous, so reflections show no seam, and where distances differ by more
/// than `blend` every sphere is exactly a sphere.
#[derive(Debug, Clone, PartialEq)]
pub struct SmoothUnion {
    spheres: Vec<Ball>,
    blend: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Ball {
    center: DVec3,
    radius: f64,
    half_curvature: f64,
}

impl SmoothUnion {
    /// Most spheres: every evaluation visits all of them.
    pub const MAX_SPHERES: usize = 256;

    /// A union of 1 to 256 spheres by their centres and radii, with a blend of the given width ≥ 0 (0: a plain union).
    pub fn new(centers: &[[f64; 3]], radii: &[f64], blend: f64) -> Result<Self> {
        let out_of_range = |message: String| Err(Error::new(ErrorKind::OutOfRange, message));
        if centers.is_empty() || centers.len() > Self::MAX_SPHERES {
            return out_of_range(format!("{} spheres; expected 1 to {}", centers.len(), Self::MAX_SPHERES));
        }
        if centers.len() != radii.len() {
            return out_of_range(format!("{} radii for {} centers; expected one each", radii.len(), centers.len()));
        }
        if !(blend >= 0.0 && blend.is_finite()) {
            return out_of_range(format!("blend is {blend}; expected a width of 0 or more"));
        }
        let ball = |(i, (center, radius)): (usize, (&[f64; 3], &f64))| {
            let radius = positive(&format!("radii[{i}]"), *radius)?;
            let center = DVec3::from(*center);
            if !center.is_finite() {
                return Err(Error::new(ErrorKind::NotFinite, format!("centers[{i}] is {center}; expected numbers")));
            }
            Ok(Ball { center, radius, half_curvature: 0.5 / radius })
        };
        let spheres = centers.iter().zip(radii).enumerate().map(ball).collect::<Result<_>>()?;
        Ok(Self { spheres, blend })
    }

    /// The fold lies less than k·min(1, (n − 1)/6) below the least distance d, for each of its n − 1 steps takes at most
    /// k/6 and none takes anything from a value that lies k below; so |p − c|² ≤ r² + 2 r d somewhere.
    pub(super) fn bounds(&self) -> Box3 {
        let sag = self.blend * (1.0f64).min((self.spheres.len() - 1) as f64 / 6.0);
        let around = |ball: &Ball| {
            let reach = (ball.radius * ball.radius + 2.0 * ball.radius * sag).sqrt();
            Box3::around(ball.center, DVec3::splat(reach))
        };
        self.spheres.iter().map(around).reduce(Box3::union).unwrap_or(Box3::around(DVec3::ZERO, DVec3::ZERO))
    }
}

impl Field for SmoothUnion {
    fn value<N: Number>(&self, [x, y, z]: [N; 3]) -> N {
        let distance = |ball: &Ball| {
            let c = ball.center;
            let square = x.shift(-c.x).square() + y.shift(-c.y).square() + z.shift(-c.z).square();
            square.shift(-ball.radius * ball.radius).scale(ball.half_curvature)
        };
        let first = distance(&self.spheres[0]);
        self.spheres[1..].iter().fold(first, |sum, ball| sum.smooth_min(distance(ball), self.blend))
    }
}
