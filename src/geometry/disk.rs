//! The flat disk.

use glam::{DAffine3, DMat3, DVec3};

use crate::{Error, ErrorKind, Result};

/// A flat disk in object space, open; under an affine transform an ellipse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disk {
    center: DVec3,
    normal: DVec3,
    radius: f64,
}

impl Disk {
    /// A disk by centre, normal (any length but 0) and radius > 0.
    pub fn new(center: DVec3, normal: DVec3, radius: f64) -> Result<Self> {
        if !(center.is_finite() && normal.is_finite()) {
            let message = format!("centre is {center}, normal {normal}; expected numbers");
            return Err(Error::new(ErrorKind::NotFinite, message));
        }
        if !(radius > 0.0 && radius.is_finite()) {
            return Err(Error::new(ErrorKind::OutOfRange, format!("radius is {radius}; expected a positive number")));
        }
        let Some(normal) = normal.try_normalize() else {
            return Err(Error::new(ErrorKind::Degenerate, format!("normal is {normal}; expected a direction")));
        };
        Ok(Self { center, normal, radius })
    }

    /// Takes the unit disk in z = 0, normal +z, to this one.
    pub fn object_from_unit(&self) -> DAffine3 {
        let (u, v) = self.normal.any_orthonormal_pair();
        let matrix = DMat3::from_cols(u * self.radius, v * self.radius, self.normal * self.radius);
        DAffine3::from_mat3_translation(matrix, self.center)
    }
}

/// The t in (0, t_max) at which the line meets the unit disk in z = 0.
pub(super) fn first_crossing(o: DVec3, d: DVec3, t_max: f64) -> Option<f64> {
    let t = -o.z / d.z;
    if !(t > 0.0 && t < t_max) {
        return None;
    }
    let (x, y) = (o.x + t * d.x, o.y + t * d.y);
    (x * x + y * y <= 1.0).then_some(t)
}
