//! The right circular cylinder, with caps or without.

use super::hit::{F64_CHAIN, LocalHit};
use super::shape::{CurvedFaces, LocalShape, Parametrization, Patch, turns};
use super::span::Span;
use super::sphere::ball_span;
use crate::{Error, ErrorKind, Result};
use glam::{DAffine3, DVec2, DVec3};
use std::f64::consts::TAU;

/// A cylinder about the y axis, its centre at the origin. Local space has radius 1 and caps at y = ±1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cylinder {
    radius: f64,
    half_height: f64,
    open: bool,
}

const SIDE: u8 = 0;
const BOTTOM: u8 = 1;
const TOP: u8 = 2;

impl Cylinder {
    /// A cylinder by its radius and height, both > 0; `open` is without caps.
    pub fn new(radius: f64, height: f64, open: bool) -> Result<Self> {
        for (name, value) in [("radius", radius), ("height", height)] {
            if !(value > 0.0 && value.is_finite()) {
                let message = format!("{name} is {value}; expected a positive number");
                return Err(Error::new(ErrorKind::OutOfRange, message));
            }
        }
        Ok(Self { radius, half_height: 0.5 * height, open })
    }

    /// The first t in (0, `t_max`) at which a line meets the surface, and which part of it.
    fn first_crossing(&self, o: DVec3, d: DVec3, t_max: f64) -> Option<(f64, u8)> {
        let (across, along) = (o.with_y(0.0), d.with_y(0.0));
        if !self.open {
            let side = Span::cylinder(across, along, 1.0, SIDE)?;
            return side.intersection(&Span::slab(o.y, d.y, [BOTTOM, TOP])?).first_end(t_max);
        }
        if along == DVec3::ZERO {
            return None;
        }
        let (t0, t1) = ball_span(across, along, 1.0)?;
        let meets = |t: f64| t > 0.0 && t < t_max && (o.y + t * d.y).abs() <= 1.0;
        [t0, t1].into_iter().find(|&t| meets(t)).map(|t| (t, SIDE))
    }
}

impl LocalShape for Cylinder {
    fn object_from_local(&self) -> DAffine3 {
        DAffine3::from_scale(DVec3::new(self.radius, self.half_height, self.radius))
    }

    fn bounds(&self, world_from_local: &DAffine3) -> (DVec3, DVec3) {
        let DAffine3 { matrix3: m, translation: center } = *world_from_local;
        let disk = (m.x_axis * m.x_axis + m.z_axis * m.z_axis).map(f64::sqrt);
        let half = disk + m.y_axis.abs();
        (center - half, center + half)
    }

    fn is_closed(&self) -> bool {
        !self.open
    }

    fn contains(&self, p: DVec3) -> bool {
        !self.open && p.y.abs() <= 1.0 && p.x * p.x + p.z * p.z <= 1.0
    }

    fn side(&self, face: u8, p: DVec3) -> f64 {
        match face {
            BOTTOM => -1.0 - p.y,
            TOP => p.y - 1.0,
            _ => p.x * p.x + p.z * p.z - 1.0,
        }
    }

    fn intersect(&self, o: DVec3, d: DVec3, t_max: f64) -> Option<LocalHit> {
        let (t, face) = self.first_crossing(o, d, t_max)?;
        let p = o + d * t;
        let (point, normal) = match face {
            BOTTOM => (p.with_y(-1.0), DVec3::NEG_Y),
            TOP => (p.with_y(1.0), DVec3::Y),
            _ => {
                let outward = p.with_y(0.0).normalize();
                (outward.with_y(p.y), outward)
            }
        };
        Some(LocalHit { t, point, normal, distance: F64_CHAIN, face })
    }

    fn hits(&self, o: DVec3, d: DVec3, t_max: f64) -> bool {
        self.first_crossing(o, d, t_max).is_some()
    }

    fn curved_faces(&self) -> CurvedFaces {
        CurvedFaces { cylindrical: true, ..CurvedFaces::default() }
    }

    fn facets(&self) -> Vec<(DVec3, DVec3)> {
        if self.open { Vec::new() } else { vec![(DVec3::NEG_Y, DVec3::NEG_Y), (DVec3::Y, DVec3::Y)] }
    }

    /// Exact while the cylinder stays right and circular.
    fn patches(&self, world_from_object: &DAffine3) -> Option<Vec<Patch>> {
        let placed = *world_from_object * self.object_from_local();
        let (x, axis, z) = (placed.matrix3.x_axis, placed.matrix3.y_axis, placed.matrix3.z_axis);
        let tolerance = 1024.0 * f64::EPSILON;
        let across = |a: DVec3, b: DVec3| a.dot(b).abs() <= tolerance * a.length() * b.length();
        let circular = (x.length_squared() - z.length_squared()).abs() <= tolerance * x.length_squared();
        if !(circular && across(x, z) && across(x, axis) && across(z, axis)) {
            return None;
        }
        let center = placed.translation;
        let mut patches = vec![Patch::Tube { center, half_axis: axis, radius: x.length() }];
        if !self.open {
            // z × x points along y, or against it after a mirroring.
            let (u, v) = if placed.matrix3.determinant() < 0.0 { (x, z) } else { (z, x) };
            patches.push(Patch::Ellipse { center: center + axis, u, v });
            patches.push(Patch::Ellipse { center: center - axis, u: v, v: u });
        }
        Some(patches)
    }

    /// Around the side, u is the turn about +y from +x, and v the height. The caps are seen from outside with u along x.
    fn parametrization(&self, face: u8, p: DVec3) -> Option<Parametrization> {
        let (uv, dp_du, dp_dv) = match face {
            TOP => (DVec2::new(p.x + 1.0, 1.0 - p.z) * 0.5, 2.0 * DVec3::X, 2.0 * DVec3::NEG_Z),
            BOTTOM => (DVec2::new(p.x + 1.0, p.z + 1.0) * 0.5, 2.0 * DVec3::X, 2.0 * DVec3::Z),
            _ => {
                let uv = DVec2::new(turns(-p.z, p.x), (p.y + 1.0) * 0.5);
                (uv, TAU * DVec3::new(p.z, 0.0, -p.x), 2.0 * DVec3::Y)
            }
        };
        Some(Parametrization { uv, dp_du, dp_dv })
    }
}

#[cfg(test)]
mod tests {
    use super::super::random::Rng;
    use super::super::{Analytic, AnalyticShape, Lens, Ray};
    use super::*;
    use glam::Vec3;

    fn placed(open: bool, world_from_object: DAffine3) -> Analytic {
        let shape = AnalyticShape::Cylinder(Cylinder::new(0.5, 2.0, open).unwrap());
        Analytic::new(shape, world_from_object).unwrap()
    }

    /// A lens with flat faces is a cylinder about z.
    #[test]
    fn hits_agree_with_a_flat_lens() {
        let turned = DAffine3::from_rotation_x(-std::f64::consts::FRAC_PI_2);
        let cylinder = placed(false, DAffine3::IDENTITY);
        let lens = Lens::new([f64::INFINITY; 2], 2.0, 1.0).unwrap();
        let lens = Analytic::new(AnalyticShape::Lens(lens), turned).unwrap();
        let mut rng = Rng::new(22);
        let mut met = 0;
        for _ in 0..20_000 {
            let origin = rng.direction() * (0.1 + 3.0 * rng.uniform());
            let target = DVec3::new(rng.signed() * 0.5, rng.signed() * 1.1, rng.signed() * 0.5);
            let ray = Ray { origin: origin.as_vec3(), direction: (target - origin).normalize().as_vec3() };
            match (cylinder.intersect(&ray, f32::INFINITY), lens.intersect(&ray, f32::INFINITY)) {
                (Some(a), Some(b)) => {
                    met += 1;
                    assert!((a.t - b.t).abs() < 1e-9 && a.normal.distance(b.normal) < 1e-6, "{a:?} {b:?}");
                }
                (None, None) => {}
                (a, b) => panic!("{ray:?}: {a:?} {b:?}"),
            }
        }
        assert!(met > 10_000, "{met}");
    }

    #[test]
    fn an_open_cylinder_is_met_from_both_sides() {
        let tube = placed(true, DAffine3::IDENTITY);
        let hit = |origin: Vec3, direction: Vec3| tube.intersect(&Ray { origin, direction }, 100.0);
        let outside = hit(Vec3::new(-3.0, 0.0, 0.0), Vec3::X).unwrap();
        assert_eq!((outside.t, outside.normal), (2.5, DVec3::NEG_X));
        let inside = hit(Vec3::ZERO, Vec3::X).unwrap();
        assert_eq!((inside.t, inside.normal), (0.5, DVec3::X));
        assert!(hit(Vec3::new(0.0, 3.0, 0.0), Vec3::NEG_Y).is_none());
        // Over the rim and onto the far wall.
        let far = hit(Vec3::new(-1.0, 1.5, 0.0), Vec3::new(1.0, -0.6, 0.0).normalize()).unwrap();
        assert!(far.normal.distance(DVec3::X) < 1e-12 && (far.point.x - 0.5).abs() < 1e-12);
        assert!(!tube.is_closed() && !tube.contains(DVec3::ZERO));
    }

    #[test]
    fn impossible_cylinders_are_errors() {
        for (radius, height) in [(0.0, 1.0), (1.0, -1.0), (f64::NAN, 1.0), (1.0, f64::INFINITY)] {
            assert_eq!(Cylinder::new(radius, height, false).unwrap_err().kind, ErrorKind::OutOfRange);
        }
    }
}
