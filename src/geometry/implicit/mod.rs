//! Implicit surfaces: closed solids given by f(p) < 0, intersected without missing a root that can be seen.
//!
//! Each surface writes its function once, generic over [`Number`]. Evaluated on intervals it gives rigorous enclosures of
//! the function and its slope along a piece of a ray, which isolate the first root; evaluated on [`Dual`] numbers it
//! gives Newton's method and the normal.

mod gyroid;
mod interval;
mod number;
mod roots;
mod smooth_union;
mod superquadric;
mod tanglecube;
mod torus;

use glam::{DAffine3, DVec3};

pub use gyroid::Gyroid;
pub use roots::Field;
pub use smooth_union::SmoothUnion;
pub use superquadric::Superquadric;
pub use tanglecube::Tanglecube;
pub use torus::Torus;

use super::hit::LocalHit;
use super::shape::{CurvedFaces, LocalShape, Parametrization, Patch};
use crate::{Error, ErrorKind, Result};
use roots::Line;

/// A built-in implicit surface in object space.
#[derive(Debug, Clone, PartialEq)]
pub enum Implicit {
    /// Torus about the y axis.
    Torus(Torus),
    /// Superellipsoid.
    Superquadric(Superquadric),
    /// Gyroid wall cut by a sphere.
    Gyroid(Gyroid),
    /// Spheres melted into each other.
    SmoothUnion(SmoothUnion),
    /// Tanglecube.
    Tanglecube(Tanglecube),
}

/// Calls the same generic code for whichever surface it is.
macro_rules! for_surface {
    ($implicit:expr, $surface:ident => $body:expr) => {
        match $implicit {
            Implicit::Torus($surface) => $body,
            Implicit::Superquadric($surface) => $body,
            Implicit::Gyroid($surface) => $body,
            Implicit::SmoothUnion($surface) => $body,
            Implicit::Tanglecube($surface) => $body,
        }
    };
}

impl Implicit {
    /// The function: negative inside, positive outside.
    pub fn value(&self, p: DVec3) -> f64 {
        for_surface!(self, surface => roots::value_at(surface, p))
    }

    fn object_box(&self) -> Box3 {
        for_surface!(self, surface => surface.bounds())
    }

    /// The first t in (0, `t_max`) at which the line crosses the surface.
    fn first_crossing(&self, origin: DVec3, direction: DVec3, t_max: f64) -> Option<f64> {
        let (t0, t1) = self.object_box().clip(origin, direction, t_max)?;
        let line = Line { origin, direction };
        for_surface!(self, surface => roots::first_root(surface, &line, t0, t1))
    }
}

impl LocalShape for Implicit {
    fn object_from_local(&self) -> DAffine3 {
        DAffine3::IDENTITY
    }

    fn bounds(&self, world_from_local: &DAffine3) -> (DVec3, DVec3) {
        let Box3 { min, max } = self.object_box();
        let m = &world_from_local.matrix3;
        let (middle, half) = (world_from_local.transform_point3(0.5 * (min + max)), 0.5 * (max - min));
        let half = m.x_axis.abs() * half.x + m.y_axis.abs() * half.y + m.z_axis.abs() * half.z;
        (middle - half, middle + half)
    }

    fn is_closed(&self) -> bool {
        true
    }

    fn contains(&self, p: DVec3) -> bool {
        self.value(p) < 0.0
    }

    fn side(&self, _: u8, p: DVec3) -> f64 {
        self.value(p)
    }

    fn intersect(&self, origin: DVec3, direction: DVec3, t_max: f64) -> Option<LocalHit> {
        let t = self.first_crossing(origin, direction, t_max)?;
        Some(for_surface!(self, surface => project(surface, origin + direction * t, direction, t)))
    }

    fn hits(&self, origin: DVec3, direction: DVec3, t_max: f64) -> bool {
        self.first_crossing(origin, direction, t_max).is_some()
    }

    fn curved_faces(&self) -> CurvedFaces {
        CurvedFaces::default()
    }

    fn facets(&self) -> Vec<(DVec3, DVec3)> {
        Vec::new()
    }

    /// Not known: the density of points by area has no closed form.
    fn patches(&self, _: &DAffine3) -> Option<Vec<Patch>> {
        None
    }

    fn parametrization(&self, _: u8, p: DVec3) -> Option<Parametrization> {
        match self {
            Self::Torus(torus) => Some(torus.parametrization(p)),
            Self::Superquadric(_) | Self::Gyroid(_) | Self::SmoothUnion(_) | Self::Tanglecube(_) => None,
        }
    }
}

/// The hit at t: one Newton step along the gradient takes the point to the surface as exactly as f64 can say, which a
/// grazing t alone does not. A singular point keeps its place and gets a normal against the ray.
fn project<F: Field>(surface: &F, p: DVec3, direction: DVec3, t: f64) -> LocalHit {
    let gradient = roots::gradient(surface, p);
    let slope = gradient.length();
    let step = gradient * (roots::value_at(surface, p) / (slope * slope));
    // A step longer than the rounding error of a grazing root would mean that the slope vanishes here.
    let point = if step.length() <= 1e-6 * p.length() { p - step } else { p };
    let normal = if slope > 0.0 && slope.is_finite() { gradient } else { -direction };
    LocalHit { t, point, normal, distance: roots::distance_bound(surface, point, slope), face: 0 }
}

/// An axis-aligned box in f64.
#[derive(Debug, Clone, Copy)]
struct Box3 {
    min: DVec3,
    max: DVec3,
}

impl Box3 {
    fn around(center: DVec3, half: DVec3) -> Self {
        Self { min: center - half, max: center + half }
    }

    fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The part of (0, t_max) in which the line is inside this box, grown a little so that its ends lie off the surface.
    fn clip(&self, origin: DVec3, direction: DVec3, t_max: f64) -> Option<(f64, f64)> {
        let margin = (self.max - self.min) * GROWTH;
        let inverse = direction.recip();
        let (a, b) = ((self.min - margin - origin) * inverse, (self.max + margin - origin) * inverse);
        let (mut t0, mut t1) = (0.0f64, t_max);
        for i in 0..3 {
            if direction[i] == 0.0 {
                if origin[i] < self.min[i] - margin[i] || origin[i] > self.max[i] + margin[i] {
                    return None;
                }
                continue;
            }
            t0 = t0.max(a[i].min(b[i]));
            t1 = t1.min(a[i].max(b[i]));
        }
        (t0 < t1 && t1.is_finite()).then_some((t0, t1))
    }
}

/// Growth of the box relative to its size: above every rounding error in clipping, below anything that costs time.
const GROWTH: f64 = 1.0 / (1u64 << 20) as f64;

/// A parameter that must be a positive number.
fn positive(name: &str, value: f64) -> Result<f64> {
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(Error::new(ErrorKind::OutOfRange, format!("{name} is {value}; expected a positive number")))
    }
}

#[cfg(test)]
mod tests {
    use super::super::random::Rng;
    use super::super::sphere;
    use super::*;

    fn torus(major: f64, minor: f64) -> Implicit {
        Implicit::Torus(Torus::new(major, minor).unwrap())
    }

    fn ray(rng: &mut Rng, size: f64) -> (DVec3, DVec3) {
        let origin = rng.direction() * (3.0 * size);
        let target = DVec3::new(rng.signed(), rng.signed(), rng.signed()) * size;
        (origin, (target - origin).normalize())
    }

    /// Sign changes of the torus's quartic, found by dense sampling and bisection.
    fn torus_by_sampling(major: f64, minor: f64, o: DVec3, d: DVec3, t_max: f64) -> Option<f64> {
        let f = |t: f64| {
            let p = o + d * t;
            let k = p.length_squared() + major * major - minor * minor;
            k * k - 4.0 * major * major * (p.x * p.x + p.z * p.z)
        };
        let steps = 3000;
        let at = |i: i32| t_max * f64::from(i) / f64::from(steps);
        let i = (0..steps).find(|&i| f(at(i)) * f(at(i + 1)) < 0.0)?;
        let (mut a, mut b) = (at(i), at(i + 1));
        for _ in 0..60 {
            let m = 0.5 * (a + b);
            if f(m) * f(a) > 0.0 { a = m } else { b = m }
        }
        Some(0.5 * (a + b))
    }

    #[test]
    fn torus_agrees_with_its_quartic() {
        let surface = torus(0.7, 0.25);
        let mut rng = Rng::new(11);
        let mut thin = 0;
        for _ in 0..5000 {
            let (o, d) = ray(&mut rng, 0.95);
            let expected = torus_by_sampling(0.7, 0.25, o, d, 5.0);
            match (surface.first_crossing(o, d, 5.0), expected) {
                (Some(t), Some(e)) if (t - e).abs() < 1e-9 => {}
                (None, None) => {}
                // A chord that slipped between two samples; it must be real.
                (Some(t), e) if e.is_none_or(|e| t < e) => {
                    thin += 1;
                    assert!(surface.value(o + d * t).abs() < 1e-15);
                }
                other => panic!("{other:?} along {o} {d}"),
            }
        }
        assert!(thin < 20, "{thin}");
    }

    #[test]
    fn round_solids_agree_with_the_sphere() {
        let round = [
            Implicit::Superquadric(Superquadric::new([0.8; 3], 1.0, 1.0).unwrap()),
            Implicit::SmoothUnion(SmoothUnion::new(&[[0.0; 3]], &[0.8], 0.3).unwrap()),
        ];
        for surface in round {
            let mut rng = Rng::new(12);
            for _ in 0..20_000 {
                let (o, d) = ray(&mut rng, 0.8);
                let expected = sphere::first_crossing(o, d, 0.8, f64::MAX);
                match (surface.intersect(o, d, f64::MAX), expected) {
                    (Some(hit), Some(e)) => {
                        let cos_theta = hit.point.normalize().dot(d).abs();
                        assert!((hit.t - e).abs() < 1e-14 / cos_theta, "{} {e}", hit.t);
                        assert!((hit.point.length() - 0.8).abs() < 1e-15);
                        assert!(hit.normal.normalize().distance(hit.point / 0.8) < 1e-14);
                    }
                    (None, None) => {}
                    other => panic!("{other:?}"),
                }
            }
        }
    }

    #[test]
    fn octahedron_agrees_with_its_planes() {
        let surface = Implicit::Superquadric(Superquadric::new([1.0, 1.0, 1.0], 2.0, 2.0).unwrap());
        let mut rng = Rng::new(13);
        for _ in 0..20_000 {
            let (o, d) = ray(&mut rng, 0.9);
            let (mut enter, mut leave) = (0.0f64, f64::MAX);
            for i in 0..8 {
                let sign = |bit: i32| if i & bit == 0 { 1.0 } else { -1.0 };
                let n = DVec3::new(sign(1), sign(2), sign(4));
                let t = (1.0 - n.dot(o)) / n.dot(d);
                if n.dot(d) < 0.0 { enter = enter.max(t) } else { leave = leave.min(t) }
            }
            let expected = (enter < leave).then_some(enter);
            let found = surface.first_crossing(o, d, f64::MAX);
            assert_eq!(found.is_some(), expected.is_some(), "{o} {d}");
            if let (Some(t), Some(e)) = (found, expected) {
                assert!((t - e).abs() < 1e-12, "{t} {e}");
            }
        }
    }

    #[test]
    fn rays_in_faces_and_through_tips_end_soon() {
        let octahedron = Implicit::Superquadric(Superquadric::new([1.0; 3], 2.0, 2.0).unwrap());
        let box_like = Implicit::Superquadric(Superquadric::new([1.0; 3], 0.1, 0.1).unwrap());
        // In a face, along an edge, through a tip, along the axis.
        let start = std::time::Instant::now();
        let (a, b) = (DVec3::new(1.0, 0.0, 0.0), DVec3::new(0.2, 0.3, 0.5));
        for direction in [b - a, DVec3::new(-1.0, 1.0, 0.0), DVec3::new(-1.0, 0.1, 0.2)] {
            let _ = octahedron.first_crossing(a - direction, direction.normalize(), 10.0);
        }
        for surface in [&octahedron, &box_like] {
            for (o, d, t) in
                [(DVec3::Y * 3.0, -DVec3::Y, 2.0), (DVec3::ZERO, DVec3::X, 1.0), (DVec3::ZERO, -DVec3::Y, 1.0)]
            {
                assert!((surface.first_crossing(o, d, 10.0).unwrap() - t).abs() < 1e-14);
            }
            let slanted = DVec3::new(0.3, -1.0, 0.2);
            let t = surface.first_crossing(DVec3::Y - slanted, slanted, 10.0).unwrap();
            assert!((t - 1.0).abs() < 1e-6, "{t}");
        }
        assert!(start.elapsed().as_millis() < 500);
    }

    #[test]
    fn grazing_rays_of_the_torus_decide_by_the_impact_parameter() {
        let (major, minor) = (0.7, 0.25);
        let surface = torus(major, minor);
        let mut rng = Rng::new(14);
        for _ in 0..20_000 {
            // A horizontal line over the tube at height r (1 ± 10^-u) touches at the top circle.
            let relative = crate::math::pow(10.0, -14.0 * rng.uniform());
            let sign = if rng.uniform() < 0.5 { -1.0 } else { 1.0 };
            let height = minor * (1.0 + sign * relative);
            let angle = 6.0 * rng.uniform();
            let d = DVec3::new(crate::math::cos(angle), 0.0, crate::math::sin(angle));
            let side = DVec3::new(-d.z, 0.0, d.x) * (0.9 * major * rng.signed());
            let o = side - d * 3.0 + DVec3::Y * height;
            let found = surface.first_crossing(o, d, 10.0);
            assert_eq!(found.is_some(), height < minor, "{relative:e} {sign}");
            if let Some(hit) = surface.intersect(o, d, 10.0) {
                assert!(surface.value(hit.point).abs() < 1e-15, "{relative:e}");
            }
        }
    }

    #[test]
    fn first_crossings_of_every_surface_are_the_first_sign_change() {
        let surfaces = [
            Implicit::Superquadric(Superquadric::new([0.6, 0.5, 0.4], 0.3, 1.6).unwrap()),
            Implicit::Gyroid(Gyroid::new(0.5, 0.06, 0.7).unwrap()),
            Implicit::SmoothUnion(
                SmoothUnion::new(&[[0.0; 3], [0.4, 0.1, 0.0], [-0.3, 0.3, 0.2]], &[0.3, 0.2, 0.25], 0.2).unwrap(),
            ),
            Implicit::SmoothUnion(SmoothUnion::new(&[[0.0; 3], [0.4, 0.1, 0.0]], &[0.3, 0.2], 0.0).unwrap()),
            Implicit::Tanglecube(Tanglecube::new(0.3, 11.8).unwrap()),
            Implicit::Tanglecube(Tanglecube::new(0.3, 12.5).unwrap()),
        ];
        for surface in surfaces {
            let mut rng = Rng::new(15);
            for _ in 0..1000 {
                let (o, d) = ray(&mut rng, 0.7);
                let found = surface.first_crossing(o, d, 5.0);
                let last = found.unwrap_or(5.0);
                let negative =
                    (0..1000).map(|i| last * f64::from(i) / 1000.0).find(|&t| surface.value(o + d * t) < -1e-13);
                assert_eq!(negative, None, "{surface:?}: inside before {found:?}");
                if let Some(t) = found {
                    assert!(surface.value(o + d * (t - 1e-9)) > 0.0 || surface.value(o + d * (t + 1e-9)) < 0.0);
                }
            }
        }
    }

    #[test]
    fn a_touch_is_a_miss_and_a_start_on_the_surface_is_no_hit() {
        let round = Superquadric::new([1.0, 0.5, 1.0], 1.0, 1.0).unwrap();
        let solids = [
            (torus(0.75, 0.25), DVec3::new(0.75, 0.25, 0.0)),
            (Implicit::Superquadric(round), DVec3::new(0.0, 0.5, 0.0)),
            (Implicit::SmoothUnion(SmoothUnion::new(&[[0.0; 3]], &[0.5], 0.1).unwrap()), DVec3::new(0.0, 0.5, 0.0)),
        ];
        for (surface, top) in solids {
            assert_eq!(surface.value(top), 0.0);
            for d in [DVec3::X, DVec3::Z, DVec3::new(0.6, 0.0, 0.8)] {
                assert_eq!(surface.first_crossing(top - d, d, 5.0), None, "{surface:?} {d}");
                let above = top * (1.0 + 1e-12);
                assert_eq!(surface.first_crossing(above - d, d, 5.0), None, "{surface:?} {d}");
                let below = top - DVec3::Y * 1e-12;
                assert!(surface.first_crossing(below - d, d, 5.0).is_some(), "{surface:?} {d}");
            }
            for d in [DVec3::Y, DVec3::new(0.6, 0.8, 0.0)] {
                assert_eq!(surface.first_crossing(top, d, 5.0), None, "{surface:?}");
                assert!(surface.first_crossing(top, -d, 5.0).unwrap() > 0.1, "{surface:?}");
            }
        }
    }

    #[test]
    fn bounds_hold_the_solid_and_touch_it() {
        for (surface, slack) in [
            (torus(0.7, 0.2), 1e-9),
            (Implicit::Superquadric(Superquadric::new([0.6, 0.5, 0.4], 0.3, 1.6).unwrap()), 1e-9),
            (Implicit::SmoothUnion(SmoothUnion::new(&[[0.1; 3], [0.4, 0.1, 0.0]], &[0.3, 0.2], 0.2).unwrap()), 0.05),
            (Implicit::Tanglecube(Tanglecube::new(0.3, 11.8).unwrap()), 1e-9),
        ] {
            let Box3 { min, max } = surface.object_box();
            let mut rng = Rng::new(16);
            let mut reach = DVec3::NEG_INFINITY;
            for _ in 0..100_000 {
                // Inside the box grown by half of its size.
                let p = min + (max - min) * (0.5 + DVec3::new(rng.signed(), rng.signed(), rng.signed()));
                if surface.value(p) < 0.0 {
                    assert!(p.cmpge(min).all() && p.cmple(max).all(), "{surface:?} {p}");
                    reach = reach.max(p);
                }
            }
            let gap = (max - reach) / (max - min);
            assert!(gap.max_element() < slack + 0.06, "{surface:?} {gap}");
        }
    }

    #[test]
    fn impossible_surfaces_are_errors() {
        let kind = |result: Result<()>| result.unwrap_err().kind;
        let range = ErrorKind::OutOfRange;
        for (major, minor) in [(0.5, 0.5), (0.5, 0.0), (-1.0, 0.1), (f64::NAN, 0.1), (f64::INFINITY, 0.1)] {
            assert_eq!(kind(Torus::new(major, minor).map(drop)), range);
        }
        for (radii, y, xz) in
            [([0.0, 1.0, 1.0], 1.0, 1.0), ([1.0; 3], 0.09, 1.0), ([1.0; 3], 1.0, 2.1), ([1.0; 3], f64::NAN, 1.0)]
        {
            assert_eq!(kind(Superquadric::new(radii, y, xz).map(drop)), range);
        }
        for (period, thickness, radius) in [(1.0, 0.25, 1.0), (1.0, 0.0, 1.0), (1.0, 0.1, 101.0), (-1.0, 0.1, 1.0)] {
            assert_eq!(kind(Gyroid::new(period, thickness, radius).map(drop)), range);
        }
        assert_eq!(kind(SmoothUnion::new(&[], &[], 0.1).map(drop)), range);
        assert_eq!(kind(SmoothUnion::new(&[[0.0; 3]], &[1.0, 2.0], 0.1).map(drop)), range);
        assert_eq!(kind(SmoothUnion::new(&[[0.0; 3]], &[1.0], -0.1).map(drop)), range);
        assert_eq!(kind(SmoothUnion::new(&[[f64::NAN; 3]], &[1.0], 0.1).map(drop)), ErrorKind::NotFinite);
        for (size, level) in [(0.0, 11.8), (1.0, 18.75), (1.0, -101.0)] {
            assert_eq!(kind(Tanglecube::new(size, level).map(drop)), range);
        }
    }
}
