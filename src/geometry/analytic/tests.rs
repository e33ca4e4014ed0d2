//! Walks through every shape, and what all of them have in common.

use super::super::implicit::{Gyroid, Implicit, SmoothUnion, Superquadric, Tanglecube, Torus};
use super::super::random::Rng;
use super::super::solids::{BrilliantCut, TriangleSoup, brilliant, prism};
use super::super::{Cuboid, Cylinder, Disk, Lens, Mesh, Sphere, offset_origin};
use super::*;
use crate::ErrorKind;
use glam::{DMat3, Vec3};

impl Analytic {
    /// Whether the shape encloses a volume.
    pub fn is_closed(&self) -> bool {
        match &self.placed {
            Placed::Ball(_) | Placed::Polyhedron(_) => true,
            Placed::Transformed(shape) => shape.shape().is_closed(),
        }
    }
}

/// One of every shape, about unit size.
fn shapes() -> Vec<(&'static str, AnalyticShape)> {
    let lens = |radii, thickness| AnalyticShape::Lens(Lens::new(radii, thickness, 1.0).unwrap());
    let quadric =
        |y, xz| AnalyticShape::Implicit(Implicit::Superquadric(Superquadric::new([0.6, 0.5, 0.4], y, xz).unwrap()));
    let centers = [[0.0, 0.0, 0.0], [0.4, 0.1, 0.0], [-0.2, 0.3, 0.2]];
    vec![
        ("sphere", AnalyticShape::Sphere(Sphere::new(DVec3::new(0.1, -0.2, 0.05), 0.4).unwrap())),
        ("disk", AnalyticShape::Disk(Disk::new(DVec3::new(0.1, 0.2, 0.0), DVec3::new(1.0, 2.0, -1.0), 0.5).unwrap())),
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
        ("box", AnalyticShape::Cuboid(Cuboid::new(DVec3::new(-0.4, -0.2, -0.5), DVec3::new(0.3, 0.1, 0.2)).unwrap())),
        ("cylinder", AnalyticShape::Cylinder(Cylinder::new(0.3, 0.8, false).unwrap())),
        ("open cylinder", AnalyticShape::Cylinder(Cylinder::new(0.3, 0.8, true).unwrap())),
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
        transforms().map(|m| (format!("{name}, {}", m.matrix3.determinant()), Analytic::new(shape.clone(), m).unwrap()))
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
        if ["disk", "lens", "meniscus", "octahedron", "mixed", "gyroid", "box", "cylinder"]
            .iter()
            .any(|edged| name.contains(edged))
        {
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
