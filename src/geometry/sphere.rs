//! The sphere: exact roots in f64 and a hit point on the surface, however far the ray comes from.

use glam::DVec3;

use crate::{Error, ErrorKind, Result};

/// A sphere in object space; under an affine transform an ellipsoid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// Centre.
    pub center: DVec3,
    /// Radius, > 0.
    pub radius: f64,
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
/// is within rounding error of the surface \[Haines2019\].
pub(super) fn ball_span(o: DVec3, d: DVec3, radius: f64) -> Option<(f64, f64)> {
    let a = d.dot(d);
    let inverse = 1.0 / a;
    let b = o.dot(d);
    let perpendicular = o - d * (b * inverse);
    let discriminant = radius * radius - perpendicular.dot(perpendicular);
    if discriminant <= 0.0 {
        return None;
    }
    let c = o.dot(o) - radius * radius;
    let q = (a * discriminant).sqrt();
    if b < 0.0 { Some((c / (q - b), (q - b) * inverse)) } else { Some(((-b - q) * inverse, -c / (b + q))) }
}

/// The first t in (0, t_max) at which the line crosses the sphere.
pub(super) fn first_crossing(o: DVec3, d: DVec3, radius: f64, t_max: f64) -> Option<f64> {
    let (t0, t1) = ball_span(o, d, radius)?;
    let t = if t0 > 0.0 { t0 } else { t1 };
    (t > 0.0 && t < t_max).then_some(t)
}

#[cfg(test)]
mod tests {
    use super::super::analytic::tests::Rng;
    use super::super::{Analytic, AnalyticShape, Ray};
    use super::*;
    use glam::{DAffine3, Vec3};

    fn ball(center: DVec3, radius: f64) -> Analytic {
        Analytic::new(AnalyticShape::Sphere(Sphere::new(center, radius).unwrap()), DAffine3::IDENTITY).unwrap()
    }

    /// A ray from distance `far` that passes the unit sphere at an impact parameter of about 1 ± 10^−U(0, 7).
    fn near_grazing(rng: &mut Rng, far: f64) -> Ray {
        let sign = if rng.uniform() < 0.5 { -1.0 } else { 1.0 };
        let impact = 1.0 + sign * crate::math::pow(10.0, -7.0 * rng.uniform());
        let direction = rng.direction();
        let side = direction.cross(rng.direction()).normalize();
        let origin = (side * impact - direction * far).as_vec3();
        Ray { origin, direction: ((side * impact).as_vec3() - origin).normalize() }
    }

    /// Whether a ray truly meets the unit sphere, in exact integers: b² − a c > 0 on coordinates in units of 2⁻ᵏ.
    fn truly_hits(ray: &Ray, radius: i128, origin_unit: f64, direction_unit: f64) -> bool {
        let exact = |v: Vec3, unit: f64| {
            v.to_array().map(|x| {
                let scaled = f64::from(x) / unit;
                assert_eq!(scaled, scaled.trunc());
                scaled as i128
            })
        };
        let (o, d) = (exact(ray.origin, origin_unit), exact(ray.direction, direction_unit));
        let dot = |a: [i128; 3], b: [i128; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        dot(o, d) * dot(o, d) > dot(d, d) * (dot(o, o) - radius * radius)
    }

    #[test]
    fn hits_and_misses_agree_with_exact_integers() {
        let sphere = ball(DVec3::ZERO, 1.0);
        let mut rng = Rng::new(1);
        for (far, allowed) in [(1.5, 0), (10.0, 0), (1e2, 0), (1e3, 0), (1e5, 0)] {
            let (origin_unit, direction_unit) = (1.0 / f64::from(1 << 23), 1.0 / f64::from(1 << 28));
            let mut flips = 0;
            for _ in 0..50_000 {
                let mut ray = near_grazing(&mut rng, far);
                let round = |v: Vec3, unit: f64| v.as_dvec3().map(|x| (x / unit).round() * unit).as_vec3();
                ray = Ray { origin: round(ray.origin, origin_unit), direction: round(ray.direction, direction_unit) };
                let truth = truly_hits(&ray, 1 << 23, origin_unit, direction_unit);
                flips += i32::from(truth != sphere.hits(&ray, f32::INFINITY));
            }
            assert!(flips <= allowed, "{flips} flips at distance {far}");
        }
    }

    #[test]
    fn hit_points_lie_on_the_sphere_within_their_error() {
        let mut rng = Rng::new(2);
        for far in [1.5, 10.0, 1e2, 1e3, 1e5] {
            let sphere = ball(DVec3::ZERO, 1.0);
            let mut hits = 0;
            for _ in 0..20_000 {
                let ray = near_grazing(&mut rng, far);
                let Some(hit) = sphere.intersect(&ray, f32::INFINITY) else { continue };
                hits += 1;
                assert!((hit.point.length() - 1.0).abs() < 1e-15);
                let rounded = hit.point.as_vec3().as_dvec3();
                assert!(((rounded - hit.point).abs().cmple(hit.error.as_dvec3())).all());
                assert!((rounded.length() - 1.0).abs() < 1e-7);
                assert!(hit.normal.dot(ray.direction.as_dvec3()) < 1e-6);
            }
            assert!(hits > 5000);
        }
    }

    #[test]
    fn roots_keep_their_side_at_the_surface() {
        // Just outside and leaving; just inside and leaving; just inside, crossing.
        let up = DVec3::Y;
        for gap in [1e-3, 1e-8, 1e-12, f64::EPSILON] {
            assert_eq!(first_crossing(up * (1.0 + gap), up, 1.0, 10.0), None);
            assert!(first_crossing(up * (1.0 - gap), up, 1.0, 10.0).unwrap() < 1.01 * gap);
            let across = first_crossing(up * (1.0 - gap), -up, 1.0, 10.0).unwrap();
            assert!((across - 2.0 + gap).abs() < 1e-15);
        }
        // On it: nothing behind, nothing at 0.
        assert_eq!(first_crossing(up, up, 1.0, 10.0), None);
        assert_eq!(first_crossing(up, -up, 1.0, 10.0), Some(2.0));
        // A touch is a miss.
        assert_eq!(first_crossing(DVec3::new(-5.0, 1.0, 0.0), DVec3::X, 1.0, 10.0), None);
    }

    #[test]
    fn impossible_spheres_are_errors() {
        for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(Sphere::new(DVec3::ZERO, radius).unwrap_err().kind, ErrorKind::OutOfRange);
        }
        assert_eq!(Sphere::new(DVec3::NAN, 1.0).unwrap_err().kind, ErrorKind::NotFinite);
    }
}
