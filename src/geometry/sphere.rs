//! The sphere: exact roots in f64 and a hit point on the surface, however far the ray comes from.

use glam::DVec3;

use crate::{Error, ErrorKind, Result};

/// A sphere in object space; under an affine transform an ellipsoid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    pub(super) center: DVec3,
    pub(super) radius: f64,
}

impl Sphere {
    /// A sphere by centre and radius > 0.
    pub fn new(center: DVec3, radius: f64) -> Result<Self> {
        if !center.is_finite() {
            return Err(Error::new(ErrorKind::NotFinite, format!("centre is {center}; expected numbers")));
        }
        if !(radius > 0.0 && radius.is_finite()) {
            return Err(Error::new(ErrorKind::OutOfRange, format!("radius is {radius}; expected a positive number")));
        }
        Ok(Self { center, radius })
    }
}

/// Where the line o + t d, with o relative to the centre, is inside a sphere about the origin: ascending (t₀, t₁), or
/// `None` if it misses or only touches. `d` need not be a unit vector.
///
/// The discriminant is r² minus the squared perpendicular from the centre, not b² − 4ac, which cancels far away; the
/// root on the origin's side comes from the product of roots, so that its sign is the sign of |o| − r even if the origin
/// is within rounding error of the surface [Haines2019].
pub(super) fn ball_span(o: DVec3, d: DVec3, radius: f64) -> Option<(f64, f64)> {
    let a = d.dot(d);
    let b = o.dot(d);
    let perpendicular = o - d * (b / a);
    let discriminant = radius * radius - perpendicular.dot(perpendicular);
    if !(discriminant > 0.0) {
        return None;
    }
    let c = o.dot(o) - radius * radius;
    let q = (a * discriminant).sqrt();
    if b < 0.0 { Some((c / (q - b), (q - b) / a)) } else { Some(((-b - q) / a, -c / (b + q))) }
}

/// The first t in (0, t_max) at which the line crosses the sphere.
pub(super) fn first_crossing(o: DVec3, d: DVec3, radius: f64, t_max: f64) -> Option<f64> {
    let (t0, t1) = ball_span(o, d, radius)?;
    let t = if t0 > 0.0 { t0 } else { t1 };
    (t > 0.0 && t < t_max).then_some(t)
}
