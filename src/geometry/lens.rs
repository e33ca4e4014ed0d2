//! The spherical lens: a solid of a cylinder and two faces, as intervals along the ray, so its rim has no gap.

use super::hit::LocalHit;
use super::shape::{CurvedFaces, LocalShape, Parametrization, Patch, turns};
use super::span::Span;
use super::sphere::ball_span;
use crate::{Error, ErrorKind, Result};
use glam::{DAffine3, DVec2, DVec3};
use std::f64::consts::TAU;

/// A spherical lens about the z axis, its centre at the origin: the points of the cylinder of the given diameter between
/// face 0, the one towards −z with vertex (0, 0, −thickness/2), and face 1, towards +z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lens {
    faces: [Face; 2],
    rim: f64,
}

/// One face. Everything about face 1 is measured along −z, so that both are seen from outside in the same way.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Face {
    /// +1 for the face towards −z, −1 for that towards +z: z times this grows from the face into the lens.
    inward: f64,
    /// Inward coordinate of the vertex.
    vertex: f64,
    /// Radius of curvature, positive if convex; infinite if flat.
    radius: f64,
    /// Inward coordinate of the rim.
    edge: f64,
}

const CYLINDER: u8 = 2;

impl Lens {
    /// A lens by the radii of curvature of its faces towards −z and +z (positive when convex, infinite when flat), its
    /// thickness on the axis and its diameter, all in the same unit of length.
    ///
    /// Errors: `OutOfRange` for a thickness or diameter that is not positive, or a radius that is 0 or below half the
    /// diameter; `Degenerate` if the faces meet before the rim.
    pub fn new(radii: [f64; 2], thickness: f64, diameter: f64) -> Result<Self> {
        for (name, value) in [("thickness", thickness), ("diameter", diameter)] {
            if !(value > 0.0 && value.is_finite()) {
                let message = format!("{name} is {value}; expected a positive number");
                return Err(Error::new(ErrorKind::OutOfRange, message));
            }
        }
        let rim = 0.5 * diameter;
        for (i, radius) in radii.into_iter().enumerate() {
            if radius.is_nan() || radius.abs() < rim {
                let message = format!(
                    "radii[{i}] is {radius}; a face of a lens of diameter {diameter} needs a radius of at least {rim} \
                     (convex), at most {} (concave), or none (flat)",
                    -rim
                );
                return Err(Error::new(ErrorKind::OutOfRange, message));
            }
        }
        let sag = radii.map(|radius| sag(radius, rim));
        let edge = thickness - sag[0] - sag[1];
        if edge < -16.0 * f64::EPSILON * (thickness + sag[0].abs() + sag[1].abs()) {
            let message = format!(
                "thickness {thickness} is too small: the faces meet before the rim; a diameter of {diameter} needs at \
                 least {}",
                sag[0] + sag[1]
            );
            return Err(Error::new(ErrorKind::Degenerate, message));
        }
        let vertex = -0.5 * thickness;
        let face = |i: usize, inward| Face { inward, vertex, radius: radii[i], edge: vertex + sag[i] };
        Ok(Self { faces: [face(0, 1.0), face(1, -1.0)], rim })
    }

    /// Radius of the rim, and the least and largest z of the solid.
    fn extent(&self) -> (f64, f64, f64) {
        let [least, most] = self.faces.map(|face| face.vertex.min(face.edge) * face.inward);
        (self.rim, least, most)
    }

    /// The first t in (0, t_max) at which the line enters or leaves the lens, and the surface there.
    fn first_crossing(&self, o: DVec3, d: DVec3, t_max: f64) -> Option<(f64, u8)> {
        let cylinder = Span::cylinder(o.with_z(0.0), d.with_z(0.0), self.rim, CYLINDER)?;
        let mut solid = cylinder;
        // At most two stretches are cut out: one by each concave face.
        let mut cuts = [None; 2];
        for (i, face) in self.faces.iter().enumerate() {
            let span = face.convex_span(i as u8, o, d, &cylinder);
            if face.radius < 0.0 {
                cuts[i] = span;
            } else {
                solid = solid.intersection(&span?);
            }
        }
        if cuts[1].is_some_and(|second| cuts[0].is_none_or(|first| second.t[0] < first.t[0])) {
            cuts.swap(0, 1);
        }
        let mut rest = solid;
        for cut in cuts.into_iter().flatten() {
            let before = Span {
                t: [rest.t[0], rest.t[1].min(cut.t[0])],
                face: [rest.face[0], if cut.t[0] < rest.t[1] { cut.face[0] } else { rest.face[1] }],
            };
            if let Some(hit) = before.first_end(t_max) {
                return Some(hit);
            }
            if cut.t[1] > rest.t[0] {
                rest.t[0] = cut.t[1];
                rest.face[0] = cut.face[1];
            }
        }
        rest.first_end(t_max)
    }
}

impl LocalShape for Lens {
    fn object_from_local(&self) -> DAffine3 {
        DAffine3::IDENTITY
    }

    fn bounds(&self, world_from_local: &DAffine3) -> (DVec3, DVec3) {
        let DAffine3 { matrix3: m, translation: center } = *world_from_local;
        let disk = (m.x_axis * m.x_axis + m.y_axis * m.y_axis).map(f64::sqrt);
        let (rim, least, most) = self.extent();
        let (a, b) = (center + m.z_axis * least, center + m.z_axis * most);
        (a.min(b) - disk * rim, a.max(b) + disk * rim)
    }

    fn is_closed(&self) -> bool {
        true
    }

    fn contains(&self, p: DVec3) -> bool {
        (0..3).all(|face| self.side(face, p) <= 0.0)
    }

    /// For a face, within the cylinder.
    fn side(&self, face: u8, p: DVec3) -> f64 {
        if face == CYLINDER {
            return p.x * p.x + p.y * p.y - self.rim * self.rim;
        }
        let face = &self.faces[usize::from(face)];
        let z = p.z * face.inward;
        if face.radius.is_infinite() {
            return face.vertex - z;
        }
        let r = DVec3::new(p.x, p.y, z - face.center());
        let ball = r.dot(r) - face.radius * face.radius;
        // Convex: inside the ball or beyond its centre. Concave: outside the ball and not behind its centre.
        if face.radius > 0.0 {
            if r.z >= 0.0 { ball.min(-r.z) } else { ball }
        } else if r.z <= 0.0 {
            (-ball).max(-r.z)
        } else {
            -ball
        }
    }

    fn intersect(&self, o: DVec3, d: DVec3, t_max: f64) -> Option<LocalHit> {
        let (t, face) = self.first_crossing(o, d, t_max)?;
        let p = o + d * t;
        let (point, normal) = if face == CYLINDER {
            let outward = DVec3::new(p.x, p.y, 0.0).normalize();
            (DVec3::new(outward.x * self.rim, outward.y * self.rim, p.z), outward)
        } else {
            self.faces[usize::from(face)].project(p)
        };
        let distance = 8.0 * f64::EPSILON * (self.rim + point.length());
        Some(LocalHit { t, point, normal, distance, face })
    }

    fn hits(&self, o: DVec3, d: DVec3, t_max: f64) -> bool {
        self.first_crossing(o, d, t_max).is_some()
    }

    fn curved_faces(&self) -> CurvedFaces {
        CurvedFaces { spherical: true, cylindrical: true }
    }

    fn facets(&self) -> Vec<(DVec3, DVec3)> {
        let flat = self.faces.iter().filter(|face| face.radius.is_infinite());
        flat.map(|face| (DVec3::NEG_Z * face.inward, DVec3::Z * (face.vertex * face.inward))).collect()
    }

    /// Not known: the faces are parts of spheres, whose points are not drawn yet.
    fn patches(&self, _: &DAffine3) -> Option<Vec<Patch>> {
        None
    }

    /// The square around a face, seen from outside with v along y, is [0, 1]². Around the rim, u is the turn about +z.
    fn parametrization(&self, face: u8, p: DVec3) -> Option<Parametrization> {
        if face == CYLINDER {
            let (_, least, most) = self.extent();
            let uv = DVec2::new(turns(p.y, p.x), (p.z - least) / (most - least));
            let dp_dv = DVec3::Z * (most - least);
            return Some(Parametrization { uv, dp_du: TAU * DVec3::new(-p.y, p.x, 0.0), dp_dv });
        }
        let face = &self.faces[usize::from(face)];
        let (_, normal) = face.project(p);
        // At the rim of a hemisphere the derivatives have no bound.
        if normal.z == 0.0 {
            return None;
        }
        let size = 2.0 * self.rim;
        let to_right = -face.inward;
        let uv = DVec2::new(p.x * to_right, p.y) / size + 0.5;
        let dp_du = DVec3::new(1.0, 0.0, -normal.x / normal.z) * (size * to_right);
        Some(Parametrization { uv, dp_du, dp_dv: DVec3::new(0.0, 1.0, -normal.y / normal.z) * size })
    }
}

impl Face {
    /// Inward coordinate of the centre of curvature.
    fn center(&self) -> f64 {
        self.vertex + self.radius
    }

    /// The stretch of the line on the convex side of the face within the cylinder: the solid's side of a flat or convex
    /// face, the side cut away by a concave one. The set is convex, so the line meets it in one stretch: the hull of its
    /// stretch in the ball and that in the half space beyond the ball's centre.
    fn convex_span(&self, tag: u8, o: DVec3, d: DVec3, cylinder: &Span) -> Option<Span> {
        let (oz, dz) = (o.z * self.inward, d.z * self.inward);
        if self.radius.is_infinite() {
            return Span::half_space(oz - self.vertex, dz, tag);
        }
        let ball = ball_span(
            DVec3::new(o.x, o.y, oz - self.center()),
            d * DVec3::new(1.0, 1.0, self.inward),
            self.radius.abs(),
        );
        let ball = ball.map(|(t0, t1)| Span { t: [t0, t1], face: [tag; 2] }.intersection(cylinder));
        let side = self.radius.signum();
        let beyond =
            Span::half_space((oz - self.center()) * side, dz * side, tag).map(|span| span.intersection(cylinder));
        let solid = |span: &Span| span.t[0] < span.t[1];
        match (ball.filter(solid), beyond.filter(solid)) {
            (Some(a), Some(b)) => Some(a.hull(&b)),
            (a, b) => a.or(b),
        }
    }

    /// The point of the face nearest to p, and the outward normal there.
    fn project(&self, p: DVec3) -> (DVec3, DVec3) {
        if self.radius.is_infinite() {
            return (DVec3::new(p.x, p.y, self.vertex * self.inward), DVec3::new(0.0, 0.0, -self.inward));
        }
        let center = DVec3::new(0.0, 0.0, self.center() * self.inward);
        let outward = (p - center).normalize() * self.radius.signum();
        (center + outward * self.radius, outward)
    }
}

/// Depth of a face of radius r at distance `rim` from the axis, positive if convex: r − √(r² − rim²), without cancellation.
fn sag(radius: f64, rim: f64) -> f64 {
    if radius.is_infinite() {
        return 0.0;
    }
    let height = ((radius.abs() - rim) * (radius.abs() + rim)).sqrt();
    rim * rim / (radius.abs() + height) * radius.signum()
}

#[cfg(test)]
mod tests {
    use super::super::random::Rng;
    use super::*;

    const FLAT: f64 = f64::INFINITY;

    /// Where a ray inside the aperture crosses a face, straight from the sphere's equation (convex or concave).
    fn face_by_hand(o: DVec3, d: DVec3, vertex: f64, center: f64) -> f64 {
        let radius = (vertex - center).abs();
        let oc = o - DVec3::new(0.0, 0.0, center);
        let (a, b, c) = (d.dot(d), oc.dot(d), oc.dot(oc) - radius * radius);
        let root = (b * b - a * c).sqrt();
        let z = |t: f64| o.z + t * d.z;
        let (t0, t1) = ((-b - root) / a, (-b + root) / a);
        if (z(t0) - vertex).abs() < (z(t1) - vertex).abs() { t0 } else { t1 }
    }

    #[test]
    fn agrees_with_tracing_two_spheres() {
        let mut rng = Rng::new(3);
        for (radii, thickness) in [([1.0, 1.5], 0.4), ([-1.0, -2.0], 0.1), ([0.7, -1.1], 0.2), ([-0.9, 0.6], 0.3)] {
            let lens = Lens::new(radii, thickness, 1.0).unwrap();
            let (v0, v1) = (-0.5 * thickness, 0.5 * thickness);
            for _ in 0..10_000 {
                let from = DVec3::new(rng.signed() * 0.3, rng.signed() * 0.3, -2.0);
                let to = DVec3::new(rng.signed() * 0.3, rng.signed() * 0.3, 2.0);
                let d = (to - from).normalize();
                let first = lens.intersect(from, d, 10.0).unwrap();
                let (t0, t1) = (face_by_hand(from, d, v0, v0 + radii[0]), face_by_hand(from, d, v1, v1 - radii[1]));
                assert!((first.t - t0).abs() < 1e-12 && first.face == 0, "{} {t0}", first.t);
                assert!(first.normal.dot(d) < 0.0);
                let second = lens.intersect(from + d * (0.5 * (t0 + t1)), d, 10.0).unwrap();
                assert!((second.t - 0.5 * (t1 - t0)).abs() < 1e-12 && second.face == 1);
                assert!(second.normal.dot(d) > 0.0);
            }
        }
    }

    #[test]
    fn special_shapes_have_their_surfaces() {
        let hit = |lens: &Lens, o: DVec3, d: DVec3| lens.intersect(o, d, 100.0).map(|hit| (hit.t, hit.face));
        let disc = Lens::new([FLAT, FLAT], 0.5, 2.0).unwrap();
        assert_eq!(hit(&disc, DVec3::new(0.5, 0.0, -3.0), DVec3::Z), Some((2.75, 0)));
        assert_eq!(hit(&disc, DVec3::new(0.5, 0.0, 3.0), -DVec3::Z), Some((2.75, 1)));
        assert_eq!(hit(&disc, DVec3::new(-3.0, 0.0, 0.1), DVec3::X), Some((2.0, CYLINDER)));
        assert_eq!(hit(&disc, DVec3::new(-3.0, 0.0, 0.3), DVec3::X), None);
        // A ball, and a rod longer than its round ends: the far half of a face's sphere cuts nothing.
        let ball = Lens::new([1.0, 1.0], 2.0, 2.0).unwrap();
        assert_eq!(hit(&ball, DVec3::new(0.0, 0.0, -3.0), DVec3::Z), Some((2.0, 0)));
        let rod = Lens::new([1.0, 1.0], 10.0, 2.0).unwrap();
        assert_eq!(hit(&rod, DVec3::new(-3.0, 0.0, 0.0), DVec3::X), Some((2.0, CYLINDER)));
        assert_eq!(hit(&rod, DVec3::ZERO, DVec3::Z), Some((5.0, 1)));
        assert!(rod.contains(DVec3::new(0.0, 0.0, 4.9)) && !rod.contains(DVec3::new(0.9, 0.0, 4.9)));
        // Through the hollow of a concave face near the rim, and across the hollow to the glass again.
        let concave = Lens::new([-1.0, -1.0], 0.1, 1.6).unwrap();
        let z = -0.4;
        let (t, face) = hit(&concave, DVec3::new(-3.0, 0.0, z), DVec3::X).unwrap();
        assert!((t - 2.2).abs() < 1e-15 && face == CYLINDER);
        let inner = 1.0 - (0.05 + 1.0 + z) * (0.05 + 1.0 + z);
        let (t, face) = hit(&concave, DVec3::new(-0.79, 0.0, z), DVec3::X).unwrap();
        assert!((t - (0.79 - inner.sqrt())).abs() < 1e-12 && face == 0);
        let (t, face) = hit(&concave, DVec3::new(0.0, 0.0, z), DVec3::X).unwrap();
        assert!((t - inner.sqrt()).abs() < 1e-12 && face == 0);
    }

    #[test]
    fn impossible_lenses_are_errors() {
        let kind = |radii, thickness, diameter| Lens::new(radii, thickness, diameter).unwrap_err().kind;
        assert_eq!(kind([0.4, 1.0], 0.5, 1.0), ErrorKind::OutOfRange);
        assert_eq!(kind([0.0, 1.0], 0.5, 1.0), ErrorKind::OutOfRange);
        assert_eq!(kind([f64::NAN, 1.0], 0.5, 1.0), ErrorKind::OutOfRange);
        assert_eq!(kind([-1.0, -1.0], 0.0, 1.0), ErrorKind::OutOfRange);
        assert_eq!(kind([1.0, 1.0], 0.1, -1.0), ErrorKind::OutOfRange);
        assert_eq!(kind([1.0, 1.0], 0.1, 1.0), ErrorKind::Degenerate);
        assert_eq!(kind([1.0, -2.0], 0.01, 1.0), ErrorKind::Degenerate);
        let message = Lens::new([1.0, 1.0], 0.1, 1.0).unwrap_err().message;
        assert!(message.contains("0.267"), "{message}");
    }
}
