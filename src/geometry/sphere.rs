//! The sphere: exact roots in f64 and a hit point on the surface, however far the ray comes from.

use super::hit::{AnalyticHit, F64_CHAIN, HALF_ULP, LocalHit, inflated};
use super::shape::{CurvedFaces, LocalShape, Parametrization, Patch, turns};
use crate::math;
use crate::{Error, ErrorKind, Result};
use glam::{DAffine3, DMat3, DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// A sphere in object space; under an affine transform an ellipsoid. Local space has it about the origin with radius 1.
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

impl LocalShape for Sphere {
    fn object_from_local(&self) -> DAffine3 {
        DAffine3::from_mat3_translation(DMat3::from_diagonal(DVec3::splat(self.radius)), self.center)
    }

    fn bounds(&self, world_from_local: &DAffine3) -> (DVec3, DVec3) {
        let DAffine3 { matrix3: m, translation: center } = *world_from_local;
        let half = (m.x_axis * m.x_axis + m.y_axis * m.y_axis + m.z_axis * m.z_axis).map(f64::sqrt);
        (center - half, center + half)
    }

    fn is_closed(&self) -> bool {
        true
    }

    fn contains(&self, p: DVec3) -> bool {
        p.length_squared() < 1.0
    }

    fn side(&self, _: u8, p: DVec3) -> f64 {
        // (|p| − 1)(|p| + 1)
        p.length_squared() - 1.0
    }

    fn intersect(&self, o: DVec3, d: DVec3, t_max: f64) -> Option<LocalHit> {
        let t = first_crossing(o, d, 1.0, t_max)?;
        let normal = (o + d * t).normalize();
        Some(LocalHit { t, point: normal, normal, distance: F64_CHAIN, face: 0 })
    }

    fn hits(&self, o: DVec3, d: DVec3, t_max: f64) -> bool {
        first_crossing(o, d, 1.0, t_max).is_some()
    }

    fn curved_faces(&self) -> CurvedFaces {
        CurvedFaces { spherical: true, ..CurvedFaces::default() }
    }

    fn facets(&self) -> Vec<(DVec3, DVec3)> {
        Vec::new()
    }

    /// Exact while the sphere stays one.
    fn patches(&self, world_from_object: &DAffine3) -> Option<Vec<Patch>> {
        let DMat3 { x_axis: x, y_axis: y, z_axis: z } = world_from_object.matrix3;
        let scale2 = x.length_squared();
        let tolerance = 1024.0 * f64::EPSILON * scale2;
        let similar = [y.length_squared() - scale2, z.length_squared() - scale2, x.dot(y), y.dot(z), z.dot(x)]
            .into_iter()
            .all(|difference| difference.abs() <= tolerance);
        let center = world_from_object.transform_point3(self.center);
        similar.then(|| vec![Patch::Sphere { center, radius: self.radius * scale2.sqrt() }])
    }

    /// u is the turn about +y from +x, v runs from the pole at −y to that at +y by angle.
    fn parametrization(&self, _: u8, p: DVec3) -> Option<Parametrization> {
        let p = p.normalize_or_zero();
        let across = math::hypot(p.x, p.z);
        let (cos, sin) = if across > 0.0 { (p.x / across, -p.z / across) } else { (1.0, 0.0) };
        Some(Parametrization {
            uv: DVec2::new(turns(-p.z, p.x), math::atan2(across, -p.y) / PI),
            dp_du: TAU * DVec3::new(p.z, 0.0, -p.x),
            dp_dv: PI * DVec3::new(-p.y * cos, across, p.y * sin),
        })
    }
}

/// A sphere that is still one in the world.
#[derive(Debug, Clone)]
pub(super) struct PlacedBall {
    sphere: Sphere,
    /// Where the unit sphere's axes have gone; needed for surface coordinates alone.
    axes: Box<DMat3>,
}

/// How a ball is turned makes no difference to the set of points that it is.
impl PartialEq for PlacedBall {
    fn eq(&self, other: &Self) -> bool {
        self.sphere == other.sphere
    }
}

impl PlacedBall {
    pub fn new(sphere: Sphere, axes: DMat3) -> Self {
        Self { sphere, axes: Box::new(axes) }
    }

    pub fn bounds(&self) -> (DVec3, DVec3) {
        let Sphere { center, radius } = self.sphere;
        (center - radius, center + radius)
    }

    pub fn contains(&self, point: DVec3) -> bool {
        let Sphere { center, radius } = self.sphere;
        point.distance_squared(center) < radius * radius
    }

    /// The error is that of rounding the point to f32, of f64, and the depth by which a tangent plane touched off its point
    /// leaves the sphere: e²/2r for a tangential error e.
    #[inline]
    pub fn intersect(&self, o: DVec3, d: DVec3, t_max: f64) -> Option<AnalyticHit> {
        let Sphere { center, radius } = self.sphere;
        let o = o - center;
        let t = first_crossing(o, d, radius, t_max)?;
        let normal = (o + d * t).normalize();
        let point = center + normal * radius;
        let rounding = point.abs() * HALF_ULP + (center.abs() + radius) * F64_CHAIN;
        let error = rounding + 2.0 * rounding.length_squared() / radius;
        Some(AnalyticHit { t, point, normal, error: inflated(error), face: 0 })
    }

    #[inline]
    pub fn hits(&self, o: DVec3, d: DVec3, t_max: f64) -> bool {
        first_crossing(o - self.sphere.center, d, self.sphere.radius, t_max).is_some()
    }

    pub fn parametrization(&self, point: DVec3) -> Option<Parametrization> {
        // Orthogonal axes of one length: the transpose is the inverse up to a factor, which does not count here.
        let local = self.sphere.parametrization(0, self.axes.transpose() * (point - self.sphere.center))?;
        let (dp_du, dp_dv) = (*self.axes * local.dp_du, *self.axes * local.dp_dv);
        Some(Parametrization { uv: local.uv, dp_du, dp_dv })
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
    use super::super::random::Rng;
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
