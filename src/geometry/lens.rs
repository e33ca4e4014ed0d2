//! The spherical lens: a solid of a cylinder and two faces, as intervals along the ray, so its rim has no gap.

use glam::DVec3;

use super::analytic::LocalHit;
use super::sphere::ball_span;
use crate::{Error, ErrorKind, Result};

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
const NOT_HIT: u8 = 3;

/// A stretch of the ray and the surfaces (0, 1 or `CYLINDER`) at its ends.
#[derive(Debug, Clone, Copy)]
struct Span {
    t: [f64; 2],
    face: [u8; 2],
}

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
    pub(super) fn extent(&self) -> (f64, f64, f64) {
        let [least, most] = self.faces.map(|face| face.vertex.min(face.edge) * face.inward);
        (self.rim, least, most)
    }

    /// Whether a point is inside or on the surface.
    pub fn contains(&self, p: DVec3) -> bool {
        (0..3).all(|face| self.side(face, p) <= 0.0)
    }

    /// Negative inside, positive outside of one of the surfaces (within the cylinder, for a face).
    pub(super) fn side(&self, face: u8, p: DVec3) -> f64 {
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

    /// The first t in (0, t_max) at which the line enters or leaves the lens, and the surface there.
    pub(super) fn first_crossing(&self, o: DVec3, d: DVec3, t_max: f64) -> Option<(f64, u8)> {
        let cylinder = self.cylinder_span(o, d)?;
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

    /// The hit on the line, moved onto its surface.
    pub(super) fn intersect(&self, o: DVec3, d: DVec3, t_max: f64) -> Option<LocalHit> {
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

    /// Where the line is inside the infinite cylinder.
    fn cylinder_span(&self, o: DVec3, d: DVec3) -> Option<Span> {
        let flat = DVec3::new(1.0, 1.0, 0.0);
        let (o, d) = (o * flat, d * flat);
        let t = if d == DVec3::ZERO {
            (o.dot(o) <= self.rim * self.rim).then_some((f64::NEG_INFINITY, f64::INFINITY))
        } else {
            ball_span(o, d, self.rim)
        };
        t.map(|(t0, t1)| Span { t: [t0, t1], face: [CYLINDER; 2] })
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
            return half_space(oz - self.vertex, dz, tag);
        }
        let ball = ball_span(
            DVec3::new(o.x, o.y, oz - self.center()),
            d * DVec3::new(1.0, 1.0, self.inward),
            self.radius.abs(),
        );
        let ball = ball.map(|(t0, t1)| Span { t: [t0, t1], face: [tag; 2] }.intersection(cylinder));
        let side = self.radius.signum();
        let beyond = half_space((oz - self.center()) * side, dz * side, tag).map(|span| span.intersection(cylinder));
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

impl Span {
    fn intersection(&self, other: &Self) -> Self {
        let (first, last) = (self.t[0] >= other.t[0], self.t[1] <= other.t[1]);
        Self {
            t: [self.t[0].max(other.t[0]), self.t[1].min(other.t[1])],
            face: [if first { self.face[0] } else { other.face[0] }, if last { self.face[1] } else { other.face[1] }],
        }
    }

    fn hull(&self, other: &Self) -> Self {
        let (first, last) = (self.t[0] <= other.t[0], self.t[1] >= other.t[1]);
        Self {
            t: [self.t[0].min(other.t[0]), self.t[1].max(other.t[1])],
            face: [if first { self.face[0] } else { other.face[0] }, if last { self.face[1] } else { other.face[1] }],
        }
    }

    /// The first end in (0, t_max), if the stretch has a length.
    fn first_end(&self, t_max: f64) -> Option<(f64, u8)> {
        if self.t[0] >= self.t[1] {
            return None;
        }
        let end = usize::from(self.t[0] <= 0.0);
        (self.t[end] > 0.0 && self.t[end] < t_max).then_some((self.t[end], self.face[end]))
    }
}

/// Where h + t · slope ≥ 0.
fn half_space(h: f64, slope: f64, face: u8) -> Option<Span> {
    let root = -h / slope;
    if slope > 0.0 {
        Some(Span { t: [root, f64::INFINITY], face: [face, NOT_HIT] })
    } else if slope < 0.0 {
        Some(Span { t: [f64::NEG_INFINITY, root], face: [NOT_HIT, face] })
    } else {
        (h >= 0.0).then_some(Span { t: [f64::NEG_INFINITY, f64::INFINITY], face: [NOT_HIT; 2] })
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
    use super::super::analytic::tests::Rng;
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
