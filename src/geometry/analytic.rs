//! Shapes with an exact intersection of their own, placed in the world by an affine transform. Everything in f64.

use glam::{DAffine3, DMat3, DVec3, Vec3};

use super::disk::{self, Disk};
use super::implicit::Implicit;
use super::lens::Lens;
use super::polyhedron::Polyhedron;
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
    /// A convex solid with flat facets.
    Polyhedron(Box<Polyhedron>),
    /// Anything else.
    Transformed(Box<Transformed>),
}

/// A shape in a space of its own.
#[derive(Debug, Clone, PartialEq)]
struct Transformed {
    local: Local,
    world_from_local: DAffine3,
    local_from_world: DAffine3,
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
pub(super) const HALF_ULP: f64 = f32::EPSILON as f64 / 2.0;
/// Relative error of a few chained f64 operations.
pub(super) const F64_CHAIN: f64 = 16.0 * f64::EPSILON;
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
            AnalyticShape::Disk(disk) => (Local::UnitDisk, disk.object_from_unit()),
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
        Ok(Self { placed: Placed::Transformed(Box::new(Transformed { local, world_from_local, local_from_world })) })
    }

    /// A box around the shape, rounded outward.
    pub fn bounds(&self) -> Aabb {
        let (min, max) = match &self.placed {
            Placed::Ball(ball) => (ball.center - ball.radius, ball.center + ball.radius),
            Placed::Polyhedron(solid) => return solid.bounds(),
            Placed::Transformed(shape) => shape.local.bounds(&shape.world_from_local),
        };
        let slack = min.abs().max(max.abs()) * F64_CHAIN;
        Aabb::enclosing(min - slack, max + slack)
    }

    /// Whether the shape encloses a volume.
    pub fn is_closed(&self) -> bool {
        match &self.placed {
            Placed::Ball(_) | Placed::Polyhedron(_) => true,
            Placed::Transformed(shape) => shape.local != Local::UnitDisk,
        }
    }

    /// Whether a point is inside; `false` for a disk.
    pub fn contains(&self, point: DVec3) -> bool {
        match &self.placed {
            Placed::Ball(ball) => point.distance_squared(ball.center) < ball.radius * ball.radius,
            Placed::Polyhedron(solid) => solid.contains(point),
            Placed::Transformed(shape) => shape.local.contains(shape.local_from_world.transform_point3(point)),
        }
    }

    /// Whether a curved part of the surface may lie on the other's: balls and lenses can share a cap, other shapes can only
    /// be the same. Of flat parts, see [`Self::planes`].
    pub fn may_share_a_face(&self, other: &Self) -> bool {
        let spherical = |placed: &Placed| match placed {
            Placed::Ball(_) => true,
            Placed::Polyhedron(_) => false,
            Placed::Transformed(shape) => matches!(shape.local, Local::Lens(_) | Local::UnitSphere),
        };
        match (&self.placed, &other.placed) {
            (Placed::Ball(a), Placed::Ball(b)) => a == b,
            (a, b) => (spherical(a) && spherical(b)) || a == b,
        }
    }

    /// Unit normals of flat facets, and the distances of their planes from the origin.
    pub fn planes(&self) -> impl Iterator<Item = (DVec3, f64)> {
        let facets = match &self.placed {
            Placed::Polyhedron(solid) => Some(solid.planes()),
            _ => None,
        };
        facets.into_iter().flatten()
    }

    /// The nearest hit with 0 < t < `t_max`. There is no smallest t: a ray that starts off the surface by as little as
    /// [`offset_origin`] moves it meets only what lies ahead.
    #[inline]
    pub fn intersect(&self, ray: &Ray, t_max: f32) -> Option<AnalyticHit> {
        let (o, d, t_max) = (ray.origin.as_dvec3(), ray.direction.as_dvec3(), f64::from(t_max));
        match &self.placed {
            Placed::Ball(ball) => intersect_ball(ball, o, d, t_max),
            Placed::Polyhedron(solid) => solid.intersect(o, d, t_max),
            Placed::Transformed(shape) => {
                let (o, d) = shape.line_to_local(o, d);
                Some(shape.hit_to_world(&shape.local.intersect(o, d, t_max)?))
            }
        }
    }

    /// Whether there is a hit with 0 < t < `t_max`: the same answer as [`Analytic::intersect`], for less work.
    #[inline]
    pub fn hits(&self, ray: &Ray, t_max: f32) -> bool {
        let (o, d, t_max) = (ray.origin.as_dvec3(), ray.direction.as_dvec3(), f64::from(t_max));
        match &self.placed {
            Placed::Ball(ball) => sphere::first_crossing(o - ball.center, d, ball.radius, t_max).is_some(),
            Placed::Polyhedron(solid) => solid.hits(o, d, t_max),
            Placed::Transformed(shape) => {
                let (o, d) = shape.line_to_local(o, d);
                shape.local.first_crossing(o, d, t_max)
            }
        }
    }
}

impl From<Polyhedron> for Analytic {
    fn from(solid: Polyhedron) -> Self {
        Self { placed: Placed::Polyhedron(Box::new(solid)) }
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
            Local::UnitDisk => disk::first_crossing(o, d, t_max).map(|t| hit(t, (o + d * t).with_z(0.0), DVec3::Z)),
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
    Some(AnalyticHit { t, point, normal, error: inflated(error) })
}

impl Transformed {
    /// A ray in local space. The direction keeps its length, so that t means the same in both spaces.
    fn line_to_local(&self, o: DVec3, d: DVec3) -> (DVec3, DVec3) {
        (self.local_from_world.transform_point3(o), self.local_from_world.transform_vector3(d))
    }

    /// Takes a hit to the world. The bound of its error starts from rounding and grows until the points that
    /// [`offset_origin`] makes of it lie on their sides of the exact surface, which covers curvature of any kind.
    fn hit_to_world(&self, hit: &LocalHit) -> AnalyticHit {
        let m = &self.world_from_local.matrix3;
        let point = self.world_from_local.transform_point3(hit.point);
        let normal = (self.local_from_world.matrix3.transpose() * hit.normal).normalize();
        let reach = m.x_axis.abs() + m.y_axis.abs() + m.z_axis.abs();
        let f64_error = reach * (hit.distance + hit.point.length() * F64_CHAIN) + point.abs() * F64_CHAIN;
        let mut error = inflated(point.abs() * HALF_ULP + f64_error);
        let (p, n) = (point.as_vec3(), normal.as_vec3());
        let side = |direction: Vec3, error: Vec3| {
            let start = offset_origin(p, error, n, direction).as_dvec3();
            self.local.side(hit.face, self.local_from_world.transform_point3(start))
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
}

/// The inverse of a transform that has one.
fn inverse(transform: &DAffine3) -> Result<DAffine3> {
    if !transform.is_finite() {
        return Err(Error::new(ErrorKind::NotFinite, format!("transform {transform} is not finite")));
    }
    let inverse = transform.inverse();
    let size = |m: &DMat3| m.to_cols_array().into_iter().map(f64::abs).fold(0.0, f64::max);
    let condition = size(&transform.matrix3) * size(&inverse.matrix3);
    if !inverse.is_finite() || condition >= MAX_CONDITION {
        let message =
            format!("the transform is singular (condition {condition:.1e}); expected below {MAX_CONDITION:.0e}");
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

/// A bound of non-negative components in f32, up to 2⁻²² larger: cheaper than rounding up exactly.
pub(super) fn inflated(bound: DVec3) -> Vec3 {
    (bound * (1.0 + f64::from(f32::EPSILON)) + f64::from(f32::MIN_POSITIVE)).as_vec3()
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::Mesh;
    use super::super::implicit::{Gyroid, SmoothUnion, Superquadric, Tanglecube, Torus};
    use super::super::solids::{BrilliantCut, TriangleSoup, brilliant, prism};
    use super::*;

    /// A small generator of random numbers (splitmix64).
    pub struct Rng(u64);

    impl Rng {
        pub fn new(seed: u64) -> Self {
            Self(seed)
        }

        /// In [0, 1).
        pub fn uniform(&mut self) -> f64 {
            self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
        }

        /// In [−1, 1).
        pub fn signed(&mut self) -> f64 {
            2.0 * self.uniform() - 1.0
        }

        pub fn direction(&mut self) -> DVec3 {
            loop {
                let v = DVec3::new(self.signed(), self.signed(), self.signed());
                if (0.01..1.0).contains(&v.length_squared()) {
                    return v.normalize();
                }
            }
        }
    }

    /// One of every shape, about unit size.
    pub fn shapes() -> Vec<(&'static str, AnalyticShape)> {
        let lens = |radii, thickness| AnalyticShape::Lens(Lens::new(radii, thickness, 1.0).unwrap());
        let quadric =
            |y, xz| AnalyticShape::Implicit(Implicit::Superquadric(Superquadric::new([0.6, 0.5, 0.4], y, xz).unwrap()));
        let centers = [[0.0, 0.0, 0.0], [0.4, 0.1, 0.0], [-0.2, 0.3, 0.2]];
        vec![
            ("sphere", AnalyticShape::Sphere(Sphere::new(DVec3::new(0.1, -0.2, 0.05), 0.4).unwrap())),
            (
                "disk",
                AnalyticShape::Disk(Disk::new(DVec3::new(0.1, 0.2, 0.0), DVec3::new(1.0, 2.0, -1.0), 0.5).unwrap()),
            ),
            ("biconvex lens", lens([0.8, 1.2], 0.4)),
            ("biconcave lens", lens([-0.7, -0.9], 0.1)),
            ("meniscus", lens([0.6, -0.9], 0.2)),
            ("planoconvex lens", lens([f64::INFINITY, 0.5], 0.6)),
            ("torus", AnalyticShape::Implicit(Implicit::Torus(Torus::new(0.5, 0.2).unwrap()))),
            ("round superquadric", quadric(1.0, 1.0)),
            ("boxy superquadric", quadric(0.1, 0.1)),
            ("octahedron", quadric(2.0, 2.0)),
            ("mixed superquadric", quadric(1.7, 0.4)),
            ("gyroid", AnalyticShape::Implicit(Implicit::Gyroid(Gyroid::new(0.4, 0.05, 0.6).unwrap()))),
            (
                "smooth union",
                AnalyticShape::Implicit(Implicit::SmoothUnion(
                    SmoothUnion::new(&centers, &[0.3, 0.2, 0.25], 0.15).unwrap(),
                )),
            ),
            ("tanglecube", AnalyticShape::Implicit(Implicit::Tanglecube(Tanglecube::new(0.25, 11.8).unwrap()))),
        ]
    }

    /// A shift with a rotation; a mirror with shear and unequal factors.
    fn transforms() -> [DAffine3; 2] {
        let turn = DAffine3::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.7);
        let shear = DMat3::from_cols(DVec3::new(-0.8, 0.1, 0.0), DVec3::new(0.3, 0.5, 0.1), DVec3::new(0.0, -0.2, 1.1));
        [DAffine3::from_translation(DVec3::new(0.3, -0.1, 0.2)) * turn, DAffine3::from_mat3(shear)]
    }

    fn placed() -> Vec<(String, Analytic)> {
        let all = shapes().into_iter().flat_map(|(name, shape)| {
            transforms()
                .map(|m| (format!("{name}, {}", m.matrix3.determinant()), Analytic::new(shape.clone(), m).unwrap()))
        });
        let solids = [
            ("brilliant", brilliant(&BrilliantCut { radius: 0.4, ..BrilliantCut::default() }).unwrap()),
            ("prism", prism(50.0, 0.7, 0.5).unwrap()),
        ];
        let solids = solids.map(|(name, TriangleSoup { positions, indices })| {
            let solid = Polyhedron::of_mesh(&Mesh { positions, indices, ..Mesh::default() }).unwrap();
            (name.to_string(), Analytic::from(solid))
        });
        all.chain(solids).collect()
    }

    /// A ray from outside towards a random point of the box.
    fn random_ray(rng: &mut Rng, bounds: &Aabb) -> Ray {
        let (center, size) = (bounds.center().as_dvec3(), (bounds.max - bounds.min).as_dvec3());
        let target = center + size * 0.5 * DVec3::new(rng.signed(), rng.signed(), rng.signed());
        let origin = center + rng.direction() * size.length();
        Ray { origin: origin.as_vec3(), direction: (target - origin).normalize().as_vec3() }
    }

    /// Walks rays through a shape: starts that [`offset_origin`] moved to either side of a hit lie on that side, the next
    /// hit from outside is an entry and from inside an exit, and rays end outside. No self-hits, no leaks.
    fn walk(name: &str, shape: &Analytic, hits_wanted: u32) {
        let mut rng = Rng::new(4);
        let (bounds, mut hits) = (shape.bounds(), 0);
        while hits < hits_wanted {
            let mut ray = random_ray(&mut rng, &bounds);
            let mut inside = false;
            while let Some(hit) = shape.intersect(&ray, f32::INFINITY) {
                hits += 1;
                let d = ray.direction.as_dvec3();
                assert_eq!(hit.normal.dot(d) > 0.0, inside, "{name}: {ray:?} {hit:?}");
                let (p, n) = (hit.point.as_vec3(), hit.normal.as_vec3());
                assert!((p.as_dvec3() - hit.point).abs().cmple(hit.error.as_dvec3()).all());
                assert!(!shape.contains(offset_origin(p, hit.error, n, n).as_dvec3()), "{name}: {hit:?}");
                assert!(shape.contains(offset_origin(p, hit.error, n, -n).as_dvec3()), "{name}: {hit:?}");
                assert!(bounds.overlaps(&Aabb { min: p, max: p }), "{name}: {p} outside of {bounds:?}");
                // Reflect now and then, else go on.
                let mirrored = (d - hit.normal * (2.0 * hit.normal.dot(d))).as_vec3();
                let turns = rng.uniform() < 0.4;
                let direction = if turns { mirrored } else { ray.direction };
                if direction.dot(n).abs() < 1e-6 || hits % 64 == 0 {
                    inside = false;
                    break;
                }
                inside ^= !turns;
                ray = Ray { origin: offset_origin(p, hit.error, n, direction), direction };
            }
            assert!(!inside, "{name}: a leak along {ray:?}");
        }
    }

    #[test]
    fn rays_enter_and_leave_in_turn() {
        for (name, shape) in placed().into_iter().filter(|(_, shape)| shape.is_closed()) {
            walk(&name, &shape, 20_000);
        }
    }

    /// The same with 10⁶ hits a shape, and at sizes and proportions near the limits of f32 positions for shapes without
    /// edges (within rounding error of an edge, a step off one face can pass another):
    /// `cargo test --release -- --ignored a_million_times`.
    #[test]
    #[ignore = "takes minutes"]
    fn rays_enter_and_leave_in_turn_a_million_times() {
        let far = DAffine3::from_translation(DVec3::new(0.7, -0.5, 0.3));
        for (name, shape) in placed().into_iter().filter(|(_, shape)| shape.is_closed()) {
            walk(&name, &shape, 1_000_000);
        }
        for (name, shape) in shapes() {
            if ["disk", "lens", "meniscus", "octahedron", "mixed", "gyroid"].iter().any(|edged| name.contains(edged)) {
                continue;
            }
            let [turn, mirror] = transforms();
            for scale in [DVec3::splat(1e-3), DVec3::new(1.0, 1e-2, 1.0)] {
                let world_from_object = far * mirror * turn * DAffine3::from_scale(scale);
                let shape = Analytic::new(shape.clone(), world_from_object).unwrap();
                walk(&format!("{name}, {scale}"), &shape, 100_000);
            }
        }
    }

    #[test]
    fn any_hit_and_limits_agree_with_the_nearest_hit() {
        for (name, shape) in placed() {
            let (mut rng, bounds) = (Rng::new(5), shape.bounds());
            for _ in 0..2000 {
                let ray = random_ray(&mut rng, &bounds);
                let hit = shape.intersect(&ray, f32::INFINITY);
                assert_eq!(hit.is_some(), shape.hits(&ray, f32::INFINITY), "{name}");
                let Some(hit) = hit else { continue };
                let (before, after) = ((hit.t as f32).next_down(), (hit.t as f32).next_up());
                assert!(shape.intersect(&ray, before).is_none() && !shape.hits(&ray, before), "{name}");
                assert!(shape.intersect(&ray, after).is_some() && shape.hits(&ray, after), "{name}");
                let along = ray.origin.as_dvec3() + ray.direction.as_dvec3() * hit.t;
                assert!(along.distance(hit.point) < 1e-6, "{name}");
            }
        }
    }

    #[test]
    fn ellipsoid_agrees_with_a_unit_sphere_in_its_own_space() {
        let mut rng = Rng::new(6);
        let m = transforms()[1] * DAffine3::from_scale(DVec3::new(1.0, 0.01, 1.0));
        let unit = AnalyticShape::Sphere(Sphere::new(DVec3::ZERO, 1.0).unwrap());
        let shape = Analytic::new(unit, m).unwrap();
        let inverse = m.inverse();
        for _ in 0..20_000 {
            let ray = random_ray(&mut rng, &shape.bounds());
            let Some(hit) = shape.intersect(&ray, f32::INFINITY) else { continue };
            assert!((inverse.transform_point3(hit.point).length() - 1.0).abs() < 1e-13);
            let outward = inverse.matrix3.transpose() * inverse.transform_point3(hit.point);
            assert!(outward.normalize().distance(hit.normal) < 1e-9);
        }
    }

    #[test]
    fn bounds_of_ellipsoids_and_disks_are_tight() {
        for (name, shape) in placed().into_iter().filter(|(name, _)| name.contains("sphere") || name.contains("disk")) {
            let (bounds, mut found) = (shape.bounds(), Aabb::EMPTY);
            let mut rng = Rng::new(7);
            for _ in 0..100_000 {
                if let Some(hit) = shape.intersect(&random_ray(&mut rng, &bounds), f32::INFINITY) {
                    found = found.with_point(hit.point.as_vec3());
                }
            }
            let gap = (found.min - bounds.min).max(bounds.max - found.max);
            assert!(gap.min_element() >= 0.0 && gap.max_element() < 0.02, "{name}: {gap}");
        }
    }

    #[test]
    fn disk_is_met_from_both_sides_inside_its_edge() {
        let disk = Disk::new(DVec3::ZERO, DVec3::Y, 0.5).unwrap();
        let shape = Analytic::new(AnalyticShape::Disk(disk), DAffine3::from_scale(DVec3::new(1.0, -1.0, 2.0))).unwrap();
        let at = |x: f32, z: f32, y: f32| {
            shape.intersect(&Ray { origin: Vec3::new(x, y, z), direction: Vec3::new(0.0, -y, 0.0) }, 10.0)
        };
        for y in [1.0, -2.0] {
            let hit = at(0.2, 0.8, y).unwrap();
            assert!((hit.t - 1.0).abs() < 1e-15 && hit.point.y.abs() < 1e-16);
            assert!(hit.normal.distance(-DVec3::Y) < 1e-15);
            assert!(at(0.51, 0.0, y).is_none() && at(0.0, 1.01, y).is_none() && at(0.0, 0.99, y).is_some());
        }
        assert!(!shape.is_closed() && !shape.contains(DVec3::ZERO));
        let parallel = Ray { origin: Vec3::new(-1.0, 0.0, 0.0), direction: Vec3::X };
        assert!(shape.intersect(&parallel, 10.0).is_none());
    }

    #[test]
    fn singular_and_infinite_transforms_are_errors() {
        let shape = shapes()[0].1.clone();
        let kind = |m: DAffine3| Analytic::new(shape.clone(), m).unwrap_err().kind;
        assert_eq!(kind(DAffine3::from_scale(DVec3::new(1.0, 0.0, 1.0))), ErrorKind::Degenerate);
        assert_eq!(kind(DAffine3::from_scale(DVec3::new(1.0, 1e-13, 1.0))), ErrorKind::Degenerate);
        assert_eq!(kind(DAffine3::from_translation(DVec3::NAN)), ErrorKind::NotFinite);
        assert!(Analytic::new(shape.clone(), DAffine3::from_scale(DVec3::splat(1e-9))).is_ok());
    }

    /// Prints the time of a ray against each shape: `cargo test --release -- --ignored --nocapture time_of_rays`.
    #[test]
    #[ignore = "a measurement"]
    fn time_of_rays() {
        for (name, shape) in placed() {
            let (mut rng, bounds) = (Rng::new(8), shape.bounds());
            let rays: Vec<Ray> = (0..2000).map(|_| random_ray(&mut rng, &bounds)).collect();
            let mut hits = 0;
            let mut round = || {
                let start = std::time::Instant::now();
                hits = rays.iter().filter(|ray| shape.intersect(ray, f32::INFINITY).is_some()).count();
                start.elapsed().as_nanos()
            };
            // The shortest of many rounds is the one that nothing else disturbed.
            let nanoseconds = (0..60).map(|_| round()).min().unwrap_or(0) as f64 / rays.len() as f64;
            let share = 100.0 * hits as f64 / rays.len() as f64;
            println!("{name:40} {nanoseconds:9.1} ns/ray, {share:.0} % hit");
        }
    }
}
