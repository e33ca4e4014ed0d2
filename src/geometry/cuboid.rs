//! The box with edges along the axes: a solid of three slabs.

use super::hit::{F64_CHAIN, LocalHit};
use super::shape::{CurvedFaces, LocalShape, Parametrization, Patch};
use super::span::Span;
use crate::{Error, ErrorKind, Result};
use glam::{DAffine3, DVec2, DVec3};

/// A box in object space; under an affine transform a parallelepiped. Local space has its faces at ±1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cuboid {
    center: DVec3,
    half: DVec3,
}

/// For each face its outward normal and the directions of u and v, whose cross product is the normal. Face 2i lies at −1 of
/// axis i, face 2i + 1 at +1. On the upright faces, v points along y.
const FACES: [[DVec3; 3]; 6] = [
    [DVec3::NEG_X, DVec3::Z, DVec3::Y],
    [DVec3::X, DVec3::NEG_Z, DVec3::Y],
    [DVec3::NEG_Y, DVec3::X, DVec3::Z],
    [DVec3::Y, DVec3::X, DVec3::NEG_Z],
    [DVec3::NEG_Z, DVec3::NEG_X, DVec3::Y],
    [DVec3::Z, DVec3::X, DVec3::Y],
];

impl Cuboid {
    /// A box by two opposite corners.
    ///
    /// Errors: `NotFinite`, or `Degenerate` if a component of `min` is not below that of `max`.
    pub fn new(min: DVec3, max: DVec3) -> Result<Self> {
        let (center, half) = (0.5 * (min + max), 0.5 * (max - min));
        if !(center.is_finite() && half.is_finite()) {
            return Err(Error::new(ErrorKind::NotFinite, format!("corners are {min} and {max}; expected numbers")));
        }
        if !half.cmpgt(DVec3::ZERO).all() {
            let message = format!("min is {min}, max {max}; expected each component of min to be below that of max");
            return Err(Error::new(ErrorKind::Degenerate, message));
        }
        Ok(Self { center, half })
    }

    fn span(o: DVec3, d: DVec3) -> Option<Span> {
        let x = Span::slab(o.x, d.x, [0, 1])?;
        let y = Span::slab(o.y, d.y, [2, 3])?;
        let z = Span::slab(o.z, d.z, [4, 5])?;
        Some(x.intersection(&y).intersection(&z))
    }
}

impl LocalShape for Cuboid {
    fn object_from_local(&self) -> DAffine3 {
        DAffine3::from_scale_rotation_translation(self.half, glam::DQuat::IDENTITY, self.center)
    }

    fn bounds(&self, world_from_local: &DAffine3) -> (DVec3, DVec3) {
        let DAffine3 { matrix3: m, translation: center } = *world_from_local;
        let half = m.x_axis.abs() + m.y_axis.abs() + m.z_axis.abs();
        (center - half, center + half)
    }

    fn is_closed(&self) -> bool {
        true
    }

    fn contains(&self, p: DVec3) -> bool {
        p.abs().max_element() <= 1.0
    }

    fn side(&self, face: u8, p: DVec3) -> f64 {
        p.dot(FACES[usize::from(face)][0]) - 1.0
    }

    fn intersect(&self, o: DVec3, d: DVec3, t_max: f64) -> Option<LocalHit> {
        let (t, face) = Self::span(o, d)?.first_end(t_max)?;
        let normal = FACES[usize::from(face)][0];
        // The coordinate along the normal is exactly ±1.
        let across = DVec3::ONE - normal.abs();
        Some(LocalHit { t, point: (o + d * t) * across + normal, normal, distance: F64_CHAIN, face })
    }

    fn hits(&self, o: DVec3, d: DVec3, t_max: f64) -> bool {
        Self::span(o, d).is_some_and(|span| span.first_end(t_max).is_some())
    }

    fn curved_faces(&self) -> CurvedFaces {
        CurvedFaces::default()
    }

    fn facets(&self) -> Vec<(DVec3, DVec3)> {
        FACES.iter().map(|[normal, ..]| (*normal, *normal)).collect()
    }

    fn patches(&self, world_from_object: &DAffine3) -> Option<Vec<Patch>> {
        let world_from_local = *world_from_object * self.object_from_local();
        let mirrored = world_from_local.matrix3.determinant() < 0.0;
        let patch = |[normal, u, v]: &[DVec3; 3]| {
            let origin = world_from_local.transform_point3(*normal - *u - *v);
            let [u, v] = [*u, *v].map(|edge| world_from_local.transform_vector3(2.0 * edge));
            // Mirrored, the cross product would point inward.
            if mirrored { Patch::Parallelogram { origin, u: v, v: u } } else { Patch::Parallelogram { origin, u, v } }
        };
        Some(FACES.iter().map(patch).collect())
    }

    fn parametrization(&self, face: u8, p: DVec3) -> Option<Parametrization> {
        let [_, u, v] = FACES[usize::from(face)];
        let uv = (DVec2::new(p.dot(u), p.dot(v)) + 1.0) * 0.5;
        Some(Parametrization { uv, dp_du: 2.0 * u, dp_dv: 2.0 * v })
    }
}

#[cfg(test)]
mod tests {
    use super::super::random::Rng;
    use super::super::{Analytic, AnalyticShape, Ray};
    use super::*;
    use glam::Vec3;

    fn placed(min: DVec3, max: DVec3) -> Analytic {
        Analytic::new(AnalyticShape::Cuboid(Cuboid::new(min, max).unwrap()), DAffine3::IDENTITY).unwrap()
    }

    /// A ray from outside meets the plane that it passes last among those of the faces that it enters by.
    #[test]
    fn hits_agree_with_the_planes() {
        let (min, max) = (DVec3::new(-0.5, 0.25, 1.0), DVec3::new(0.75, 0.5, 1.125));
        let solid = placed(min, max);
        let mut rng = Rng::new(21);
        let mut met = 0;
        for _ in 0..20_000 {
            let target = min + (max - min) * DVec3::new(rng.uniform(), rng.uniform(), rng.uniform()) * 1.5;
            let origin = (rng.direction() * 4.0).as_vec3();
            let ray = Ray { origin, direction: (target - origin.as_dvec3()).normalize().as_vec3() };
            let (o, d) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
            let (a, b) = ((min - o) / d, (max - o) / d);
            let (enter, leave) = (a.min(b).max_element(), a.max(b).min_element());
            let hit = solid.intersect(&ray, f32::INFINITY);
            if (enter - leave).abs() < 1e-12 {
                continue;
            }
            assert_eq!(hit.is_some(), enter < leave, "{ray:?}");
            let Some(hit) = hit else { continue };
            met += 1;
            assert!((hit.t - enter).abs() < 1e-13);
            let face = usize::from(hit.face);
            assert_eq!(hit.point[face / 2], if face % 2 == 0 { min } else { max }[face / 2]);
            assert!(hit.normal.dot(d) < 0.0);
        }
        assert!(met > 5000, "{met}");
    }

    #[test]
    fn rays_in_faces_and_along_edges_end() {
        let solid = placed(DVec3::splat(-1.0), DVec3::splat(1.0));
        let t = |origin: Vec3, direction: Vec3| solid.intersect(&Ray { origin, direction }, 100.0).map(|hit| hit.t);
        // In a face: inside counts, so that the ray meets the two faces across.
        assert_eq!(t(Vec3::new(-3.0, 1.0, 0.0), Vec3::X), Some(2.0));
        assert_eq!(t(Vec3::new(-3.0, 1.0, 1.0), Vec3::X), Some(2.0));
        assert_eq!(t(Vec3::new(-3.0, 1.5, 0.0), Vec3::X), None);
        assert_eq!(t(Vec3::ZERO, Vec3::Z), Some(1.0));
        assert_eq!(t(Vec3::new(0.0, 0.0, 1.0), Vec3::Z), None);
    }

    #[test]
    fn impossible_boxes_are_errors() {
        let kind = |min, max| Cuboid::new(min, max).unwrap_err().kind;
        assert_eq!(kind(DVec3::ZERO, DVec3::new(1.0, 0.0, 1.0)), ErrorKind::Degenerate);
        assert_eq!(kind(DVec3::ONE, DVec3::ZERO), ErrorKind::Degenerate);
        assert_eq!(kind(DVec3::NAN, DVec3::ONE), ErrorKind::NotFinite);
    }
}
