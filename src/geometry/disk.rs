//! The flat disk.

use super::hit::{F64_CHAIN, LocalHit};
use super::shape::{CurvedFaces, LocalShape, Parametrization, Patch};
use crate::{Error, ErrorKind, Result};
use glam::{DAffine3, DMat3, DVec2, DVec3};

/// A flat disk in object space, open; under an affine transform an ellipse. Local space has it about the origin in z = 0 with
/// radius 1 and normal +z.
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
}

impl LocalShape for Disk {
    fn object_from_local(&self) -> DAffine3 {
        let (u, v) = self.normal.any_orthonormal_pair();
        let matrix = DMat3::from_cols(u * self.radius, v * self.radius, self.normal * self.radius);
        DAffine3::from_mat3_translation(matrix, self.center)
    }

    fn bounds(&self, world_from_local: &DAffine3) -> (DVec3, DVec3) {
        let DAffine3 { matrix3: m, translation: center } = *world_from_local;
        let half = (m.x_axis * m.x_axis + m.y_axis * m.y_axis).map(f64::sqrt);
        (center - half, center + half)
    }

    fn is_closed(&self) -> bool {
        false
    }

    fn contains(&self, _: DVec3) -> bool {
        false
    }

    fn side(&self, _: u8, p: DVec3) -> f64 {
        p.z
    }

    fn intersect(&self, o: DVec3, d: DVec3, t_max: f64) -> Option<LocalHit> {
        let t = first_crossing(o, d, t_max)?;
        Some(LocalHit { t, point: (o + d * t).with_z(0.0), normal: DVec3::Z, distance: F64_CHAIN, face: 0 })
    }

    fn hits(&self, o: DVec3, d: DVec3, t_max: f64) -> bool {
        first_crossing(o, d, t_max).is_some()
    }

    fn curved_faces(&self) -> CurvedFaces {
        CurvedFaces::default()
    }

    fn facets(&self) -> Vec<(DVec3, DVec3)> {
        Vec::new()
    }

    fn patches(&self, world_from_object: &DAffine3) -> Option<Vec<Patch>> {
        let placed = *world_from_object * self.object_from_local();
        let (u, v) = (placed.matrix3.x_axis, placed.matrix3.y_axis);
        // Mirrored, the front stays where the shape's normal goes.
        let v = if world_from_object.matrix3.determinant() < 0.0 { -v } else { v };
        Some(vec![Patch::Ellipse { center: placed.translation, u, v }])
    }

    /// The square around the disk is [0, 1]².
    fn parametrization(&self, _: u8, p: DVec3) -> Option<Parametrization> {
        let uv = (DVec2::new(p.x, p.y) + 1.0) * 0.5;
        Some(Parametrization { uv, dp_du: 2.0 * DVec3::X, dp_dv: 2.0 * DVec3::Y })
    }
}

/// The t in (0, t_max) at which the line meets the unit disk in z = 0.
fn first_crossing(o: DVec3, d: DVec3, t_max: f64) -> Option<f64> {
    let t = -o.z / d.z;
    if !(t > 0.0 && t < t_max) {
        return None;
    }
    let (x, y) = (o.x + t * d.x, o.y + t * d.y);
    (x * x + y * y <= 1.0).then_some(t)
}
