//! Shapes with an exact intersection of their own, placed in the world by an affine transform. Everything in f64.

use glam::{DAffine3, DMat3, DVec3, Vec3};

use super::disk::{self, Disk};
use super::implicit::Implicit;
use super::lens::Lens;
use super::sphere::{self, Sphere};
use super::{Aabb, Ray, offset_origin};
use crate::{Error, ErrorKind, Result};

/// The shapes that are intersected by their equations.
#[derive(Debug, Clone, PartialEq)]
pub enum AnalyticShape {
    /// A sphere.
    Sphere(Sphere),
    /// A flat disk.
    Disk(Disk),
    /// A spherical lens.
    Lens(Lens),
    /// An implicit surface.
    Implicit(Implicit),
}

/// A shape in the world.
#[derive(Debug, Clone, PartialEq)]
pub struct Analytic {
    placed: Placed,
}

/// Where a ray meets a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnalyticHit {
    /// Distance along the ray in lengths of its direction, > 0.
    pub t: f64,
    /// The point, in world space, moved onto the surface (it is not origin + t · direction).
    pub point: DVec3,
    /// Unit outward geometric normal; for a disk the side that its normal points to.
    pub normal: DVec3,
    /// Bound of each component of `point.as_vec3()` against the true surface, its curvature included: what
    /// [`offset_origin`] needs to step off the surface on the side asked for.
    pub error: Vec3,
}

/// A hit in object space.
#[derive(Debug, Clone, Copy)]
pub(super) struct LocalHit {
    /// Along the ray, the same as in the world.
    pub t: f64,
    /// On the surface.
    pub point: DVec3,
    /// Outward, of any length.
    pub normal: DVec3,
    /// How far `point` can be from the surface.
    pub distance: f64,
    /// Which surface of the shape.
    pub face: u8,
}

#[derive(Debug, Clone, PartialEq)]
enum Placed {
    /// A sphere that is still one in the world.
    Ball(Sphere),
    /// Anything else.
    Transformed { local: Local, world_from_local: DAffine3, local_from_world: DAffine3 },
}

/// The shapes in the space where their equation is simplest.
#[derive(Debug, Clone, PartialEq)]
enum Local {
    /// The unit sphere about the origin.
    UnitSphere,
    /// The unit disk in z = 0 with normal +z.
    UnitDisk,
    /// A lens.
    Lens(Lens),
    /// An implicit surface.
    Implicit(Implicit),
}

/// Largest condition number of a transform: beyond it f64 cannot tell where the object's surface is.
const MAX_CONDITION: f64 = 1e12;
/// Half the spacing of f32, relative: rounding a coordinate moves it by at most this much of itself.
const HALF_ULP: f64 = f32::EPSILON as f64 / 2.0;
/// Relative error of a few chained f64 operations.
const F64_CHAIN: f64 = 16.0 * f64::EPSILON;
/// Doublings of the error bound until both offset points lie on their sides.
const MAX_DOUBLINGS: u32 = 12;

impl Analytic {
    /// Places a shape. A mirroring transform keeps normals outward.
    ///
    /// Errors: `NotFinite` or `Degenerate` for a transform that is not finite or (numerically) singular.
    pub fn new(shape: AnalyticShape, world_from_object: DAffine3) -> Result<Self> {
        let (local, object_from_local) = match shape {
            AnalyticShape::Sphere(ball) => {
                let matrix = DMat3::from_diagonal(DVec3::splat(ball.radius));
                (Local::UnitSphere, DAffine3::from_mat3_translation(matrix, ball.center))
            }
            AnalyticShape::Disk(disk) => (Local::UnitDisk, disk.from_unit()),
            AnalyticShape::Lens(lens) => (Local::Lens(lens), DAffine3::IDENTITY),
            AnalyticShape::Implicit(surface) => (Local::Implicit(surface), DAffine3::IDENTITY),
        };
        let local_from_world = inverse(&world_from_object)?;
        let world_from_local = world_from_object * object_from_local;
        if local == Local::UnitSphere
            && let Some(radius) = similarity(&world_from_local.matrix3)
        {
            return Ok(Self { placed: Placed::Ball(Sphere { center: world_from_local.translation, radius }) });
        }
        let local_from_world = object_from_local.inverse() * local_from_world;
        Ok(Self { placed: Placed::Transformed { local, world_from_local, local_from_world } })
    }

    /// A box around the shape, rounded outward.
    pub fn bounds(&self) -> Aabb {
        let (min, max) = match &self.placed {
            Placed::Ball(ball) => (ball.center - ball.radius, ball.center + ball.radius),
            Placed::Transformed { local, world_from_local, .. } => local.bounds(world_from_local),
        };
        let slack = min.abs().max(max.abs()) * F64_CHAIN;
        Aabb { min: round_down(min - slack), max: round_up(max + slack) }
    }

    /// Whether the shape encloses a volume.
    pub fn is_closed(&self) -> bool {
        !matches!(self.placed, Placed::Transformed { local: Local::UnitDisk, .. })
    }

    /// Whether a point is inside; `false` for a disk.
    pub fn contains(&self, point: DVec3) -> bool {
        match &self.placed {
            Placed::Ball(ball) => point.distance_squared(ball.center) < ball.radius * ball.radius,
            Placed::Transformed { local, local_from_world, .. } => {
                local.contains(local_from_world.transform_point3(point))
            }
        }
    }

    /// The nearest hit with 0 < t < `t_max`. There is no smallest t: a ray that starts off the surface by as little as
    /// [`offset_origin`] moves it meets only what lies ahead.
    #[inline]
    pub fn intersect(&self, ray: &Ray, t_max: f32) -> Option<AnalyticHit> {
        let (o, d, t_max) = (ray.origin.as_dvec3(), ray.direction.as_dvec3(), f64::from(t_max));
        match &self.placed {
            Placed::Ball(ball) => intersect_ball(ball, o, d, t_max),
            Placed::Transformed { local, world_from_local, local_from_world } => {
                // The direction keeps its length, so that t means the same in both spaces.
                let (o, d) = (local_from_world.transform_point3(o), local_from_world.transform_vector3(d));
                let hit = local.intersect(o, d, t_max)?;
                Some(to_world(local, world_from_local, local_from_world, &hit))
            }
        }
    }

    /// Whether there is a hit with 0 < t < `t_max`: the same answer as [`Analytic::intersect`], for less work.
    #[inline]
    pub fn hits(&self, ray: &Ray, t_max: f32) -> bool {
        let (o, d, t_max) = (ray.origin.as_dvec3(), ray.direction.as_dvec3(), f64::from(t_max));
        match &self.placed {
            Placed::Ball(ball) => sphere::first_crossing(o - ball.center, d, ball.radius, t_max).is_some(),
            Placed::Transformed { local, local_from_world, .. } => {
                let (o, d) = (local_from_world.transform_point3(o), local_from_world.transform_vector3(d));
                local.first_crossing(o, d, t_max)
            }
        }
    }
}

impl Local {
    fn bounds(&self, world_from_local: &DAffine3) -> (DVec3, DVec3) {
        let DAffine3 { matrix3: m, translation: center } = *world_from_local;
        // Half extents of the transformed unit disk in z = 0, and of the unit segment along z.
        let disk = (m.x_axis * m.x_axis + m.y_axis * m.y_axis).map(f64::sqrt);
        match self {
            Local::UnitSphere => {
                let half = (m.x_axis * m.x_axis + m.y_axis * m.y_axis + m.z_axis * m.z_axis).map(f64::sqrt);
                (center - half, center + half)
            }
            Local::UnitDisk => (center - disk, center + disk),
            Local::Lens(lens) => {
                let (rim, least, most) = lens.extent();
                let (a, b) = (center + m.z_axis * least, center + m.z_axis * most);
                (a.min(b) - disk * rim, a.max(b) + disk * rim)
            }
            Local::Implicit(surface) => {
                let (min, max) = surface.bounds();
                let (middle, half) = (world_from_local.transform_point3(0.5 * (min + max)), 0.5 * (max - min));
                let half = m.x_axis.abs() * half.x + m.y_axis.abs() * half.y + m.z_axis.abs() * half.z;
                (middle - half, middle + half)
            }
        }
    }

    fn contains(&self, p: DVec3) -> bool {
        match self {
            Local::UnitSphere => p.length_squared() < 1.0,
            Local::UnitDisk => false,
            Local::Lens(lens) => lens.contains(p),
            Local::Implicit(surface) => surface.value(p) < 0.0,
        }
    }

    /// Negative on the inner side of one of the shape's surfaces, positive on the outer one.
    fn side(&self, face: u8, p: DVec3) -> f64 {
        match self {
            // (|p| − 1)(|p| + 1)
            Local::UnitSphere => p.length_squared() - 1.0,
            Local::UnitDisk => p.z,
            Local::Lens(lens) => lens.side(face, p),
            Local::Implicit(surface) => surface.value(p),
        }
    }

    fn intersect(&self, o: DVec3, d: DVec3, t_max: f64) -> Option<LocalHit> {
        let hit = |t, point, normal| LocalHit { t, point, normal, distance: F64_CHAIN, face: 0 };
        match self {
            Local::UnitSphere => sphere::first_crossing(o, d, 1.0, t_max).map(|t| {
                let normal = (o + d * t).normalize();
                hit(t, normal, normal)
            }),
            Local::UnitDisk => {
                disk::first_crossing(o, d, t_max).map(|t| hit(t, (o + d * t).with_z(0.0), DVec3::Z))
            }
            Local::Lens(lens) => lens.intersect(o, d, t_max),
            Local::Implicit(surface) => surface.intersect(o, d, t_max),
        }
    }

    fn first_crossing(&self, o: DVec3, d: DVec3, t_max: f64) -> bool {
        match self {
            Local::UnitSphere => sphere::first_crossing(o, d, 1.0, t_max).is_some(),
            Local::UnitDisk => disk::first_crossing(o, d, t_max).is_some(),
            Local::Lens(lens) => lens.first_crossing(o, d, t_max).is_some(),
            Local::Implicit(surface) => surface.first_crossing(o, d, t_max).is_some(),
        }
    }
}

/// The hit of a ball. The error is that of rounding the point to f32, of f64, and the depth by which a tangent plane
/// touched off its point leaves the sphere: e²/2r for a tangential error e.
fn intersect_ball(ball: &Sphere, o: DVec3, d: DVec3, t_max: f64) -> Option<AnalyticHit> {
    let o = o - ball.center;
    let t = sphere::first_crossing(o, d, ball.radius, t_max)?;
    let normal = (o + d * t).normalize();
    let point = ball.center + normal * ball.radius;
    let rounding = point.abs() * HALF_ULP + (ball.center.abs() + ball.radius) * F64_CHAIN;
    let error = rounding + 2.0 * rounding.length_squared() / ball.radius;
    Some(AnalyticHit { t, point, normal, error: round_up(error) })
}

/// Takes a hit to the world. The bound of its error starts from rounding and grows until the points that
/// [`offset_origin`] makes of it lie on their sides of the exact surface, which covers curvature of any kind.
fn to_world(local: &Local, world_from_local: &DAffine3, local_from_world: &DAffine3, hit: &LocalHit) -> AnalyticHit {
    let m = &world_from_local.matrix3;
    let point = world_from_local.transform_point3(hit.point);
    let normal = (local_from_world.matrix3.transpose() * hit.normal).normalize();
    let reach = m.x_axis.abs() + m.y_axis.abs() + m.z_axis.abs();
    let f64_error = reach * (hit.distance + hit.point.length() * F64_CHAIN) + point.abs() * F64_CHAIN;
    let mut error = round_up(point.abs() * HALF_ULP + f64_error);
    let (p, n) = (point.as_vec3(), normal.as_vec3());
    let side = |direction: Vec3, error: Vec3| {
        let start = offset_origin(p, error, n, direction);
        local.side(hit.face, local_from_world.transform_point3(start.as_dvec3()))
    };
    let mut doubled = error;
    for _ in 0..=MAX_DOUBLINGS {
        if side(n, doubled) > 0.0 && side(-n, doubled) < 0.0 {
            error = doubled;
            break;
        }
        doubled *= 2.0;
    }
    AnalyticHit { t: hit.t, point, normal, error }
}

/// The inverse of a transform that has one.
fn inverse(transform: &DAffine3) -> Result<DAffine3> {
    if !transform.is_finite() {
        return Err(Error::new(ErrorKind::NotFinite, format!("transform {transform} is not finite")));
    }
    let inverse = transform.inverse();
    let size = |m: &DMat3| m.to_cols_array().into_iter().map(f64::abs).fold(0.0, f64::max);
    let condition = size(&transform.matrix3) * size(&inverse.matrix3);
    if !inverse.is_finite() || !(condition < MAX_CONDITION) {
        let message = format!("the transform is singular (condition {condition:.1e}); expected below {MAX_CONDITION:.0e}");
        return Err(Error::new(ErrorKind::Degenerate, message));
    }
    Ok(inverse)
}

/// The factor of a matrix that is a rotation (or reflection) times a factor, up to the rounding of a long product.
fn similarity(m: &DMat3) -> Option<f64> {
    let tolerance = 4096.0 * f64::EPSILON;
    let gram = m.transpose() * *m;
    let square = (gram.x_axis.x + gram.y_axis.y + gram.z_axis.z) / 3.0;
    let difference = (gram - DMat3::from_diagonal(DVec3::splat(square))).to_cols_array();
    difference.into_iter().all(|x| x.abs() <= tolerance * square).then(|| square.sqrt())
}

fn round_up(v: DVec3) -> Vec3 {
    let up = |x: f64| {
        let rounded = x as f32;
        if f64::from(rounded) < x { rounded.next_up() } else { rounded }
    };
    Vec3::new(up(v.x), up(v.y), up(v.z))
}

fn round_down(v: DVec3) -> Vec3 {
    -round_up(-v)
}
