//! The torus.

use super::super::shape::{Parametrization, turns};
use super::number::Number;
use super::roots::Field;
use super::{Box3, positive};
use crate::math;
use crate::{Error, ErrorKind, Result};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// A ring torus about the y axis: (√(x² + z²) − R)² + y² = r².
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Torus {
    major: f64,
    minor: f64,
}

impl Torus {
    /// A torus by the radius of its centre line and of its tube, 0 < `minor_radius` < `major_radius`.
    pub fn new(major_radius: f64, minor_radius: f64) -> Result<Self> {
        let major = positive("major_radius", major_radius)?;
        let minor = positive("minor_radius", minor_radius)?;
        if minor >= major {
            return Err(Error::new(
                ErrorKind::OutOfRange,
                format!("minor_radius {minor} is not below major_radius {major}: a torus needs a hole"),
            ));
        }
        Ok(Self { major, minor })
    }

    /// u is the turn about +y from +x, v that around the tube from its outermost circle upwards.
    pub(super) fn parametrization(&self, p: DVec3) -> Parametrization {
        let across = math::hypot(p.x, p.z);
        let (out, up) = (across - self.major, p.y);
        let outward = DVec3::new(p.x, 0.0, p.z) / across;
        Parametrization {
            uv: DVec2::new(turns(-p.z, p.x), turns(up, out)),
            dp_du: TAU * DVec3::new(p.z, 0.0, -p.x),
            dp_dv: TAU * (DVec3::Y * out - outward * up),
        }
    }

    pub(super) fn bounds(&self) -> Box3 {
        let reach = self.major + self.minor;
        Box3::around(DVec3::ZERO, DVec3::new(reach, self.minor, reach))
    }
}

impl Field for Torus {
    fn value<N: Number>(&self, [x, y, z]: [N; 3]) -> N {
        (x.norm(z, 2.0).shift(-self.major).square() + y.square()).shift(-self.minor * self.minor)
    }
}
