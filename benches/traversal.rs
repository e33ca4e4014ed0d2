//! Speed of the bounding volume hierarchy, one thread: `cargo bench --bench traversal`.
//!
//! Prints build time and millions of rays a second: coherent (a pinhole camera), incoherent (cosine-distributed from the
//! points that the camera sees) and shadow (from those points to a point light). Icospheres stand in a room of 12
//! triangles, as in the published comparisons; the first scene is the few dozen triangles of a Cornell box. A bundle of 8
//! costs so many single incoherent rays: its rays, one after the other, share what is in the caches. The last scene, 2
//! million triangles, comes only if building that of 330 thousand foretells less than 10 s for it.

use abbe::geometry::{Bvh, Primitive, Ray, TriangleHit, geometric_normal, offset_origin};
use abbe::math;
use glam::Vec3;
use std::collections::HashMap;
use std::time::Instant;

/// Sine and cosine of an angle in radians.
fn sin_cos(angle: f32) -> (f32, f32) {
    (math::sin(f64::from(angle)) as f32, math::cos(f64::from(angle)) as f32)
}

struct Mesh {
    positions: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
}

impl Mesh {
    fn cuboid(&mut self, center: Vec3, half: Vec3) {
        let base = self.positions.len() as u32;
        for corner in 0..8u32 {
            let sign = |bit: u32| if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
            self.positions.push(center + half * Vec3::new(sign(0), sign(1), sign(2)));
        }
        for [a, b, c, d] in [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]] {
            self.triangles.push([base + a, base + b, base + c]);
            self.triangles.push([base + a, base + c, base + d]);
        }
    }

    fn icosphere(&mut self, radius: f32, levels: u32) {
        let g = (1.0 + 5f32.sqrt()) / 2.0;
        let mut points: Vec<Vec3> = [[-1.0, g, 0.0], [1.0, g, 0.0], [-1.0, -g, 0.0], [1.0, -g, 0.0]]
            .into_iter()
            .flat_map(|[x, y, z]: [f32; 3]| [Vec3::new(x, y, z), Vec3::new(z, x, y), Vec3::new(y, z, x)])
            .map(Vec3::normalize)
            .collect();
        let edge = points[0].distance(points[3]).min(points[0].distance(points[6])).min(points[0].distance(points[1]));
        let near = |a: usize, b: usize| points[a].distance(points[b]) < edge * 1.01;
        let mut faces = Vec::new();
        for a in 0..12 {
            for b in a + 1..12 {
                for c in b + 1..12 {
                    if near(a, b) && near(b, c) && near(a, c) {
                        faces.push([a as u32, b as u32, c as u32]);
                    }
                }
            }
        }
        for _ in 0..levels {
            let mut middles = HashMap::new();
            faces = faces
                .into_iter()
                .flat_map(|[a, b, c]| {
                    let mut middle = |a: u32, b: u32| {
                        *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                            points.push((points[a as usize] + points[b as usize]).normalize());
                            points.len() as u32 - 1
                        })
                    };
                    let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
                    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
                })
                .collect();
        }
        let base = self.positions.len() as u32;
        self.positions.extend(points.into_iter().map(|point| point * radius));
        self.triangles.extend(faces.into_iter().map(|face| face.map(|vertex| base + vertex)));
    }
}

impl Mesh {
    /// A sphere with bumps, of 2 n² triangles between circles of latitude and longitude.
    fn bumpy_sphere(&mut self, radius: f32, n: u32) {
        use std::f32::consts::PI;
        let base = self.positions.len() as u32;
        for i in 0..=n {
            for k in 0..=n {
                let (theta, phi) = (PI * i as f32 / n as f32, 2.0 * PI * (k % n) as f32 / n as f32);
                let (sin, cos) = sin_cos(theta);
                let (sin_phi, cos_phi) = sin_cos(phi);
                let bump = 1.0 + 0.02 * sin_cos(40.0 * theta).0 * sin_cos(40.0 * phi).0;
                self.positions.push(Vec3::new(sin * cos_phi, cos, sin * sin_phi) * radius * bump);
            }
        }
        let at = |i: u32, k: u32| base + i * (n + 1) + k;
        for i in 0..n {
            for k in 0..n {
                self.triangles.push([at(i, k), at(i, k + 1), at(i + 1, k)]);
                self.triangles.push([at(i + 1, k), at(i, k + 1), at(i + 1, k + 1)]);
            }
        }
    }
}

struct Random(u64);

impl Random {
    fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 40) as f32 / (1u64 << 24) as f32
    }

    fn direction(&mut self) -> Vec3 {
        loop {
            let v = Vec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0;
            if v.length_squared() < 1.0 && v.length_squared() > 0.01 {
                return v.normalize();
            }
        }
    }
}

/// Seconds that this process has computed, where the system tells (other processes then disturb less), else since `start`.
fn seconds(start: Instant) -> f64 {
    let schedule = std::fs::read_to_string("/proc/self/schedstat").ok();
    let nanoseconds = schedule.and_then(|text| text.split_whitespace().next()?.parse::<f64>().ok());
    // Some systems have the file, but do not count.
    nanoseconds.filter(|n| *n > 0.0).map_or(start.elapsed().as_secs_f64(), |n| n * 1e-9)
}

/// Millions of rays a second, and how many hit.
fn speed(rays: &[(Ray, f32)], mut trace: impl FnMut(&Ray, f32) -> bool) -> (f64, usize) {
    let mut pass = || rays.iter().filter(|(ray, t_max)| trace(ray, *t_max)).count();
    let hits = pass();
    let start = Instant::now();
    let before = seconds(start);
    let mut passes = 0;
    while seconds(start) - before < 0.5 {
        assert_eq!(pass(), hits);
        passes += 1;
    }
    (rays.len() as f64 * f64::from(passes) / (seconds(start) - before) * 1e-6, hits)
}

/// Prints a line; returns the seconds of building.
fn measure(name: &str, mesh: &Mesh, eye: Vec3) -> f64 {
    let start = Instant::now();
    let bvh = Bvh::build(&mesh.positions, &mesh.triangles, &[]);
    let build = start.elapsed().as_secs_f64() * 1e3;
    let side = 400;
    let mut coherent = Vec::new();
    for y in 0..side {
        for x in 0..side {
            let at = |i: u32| (i as f32 + 0.5) / side as f32 - 0.5;
            coherent.push((Ray { origin: eye, direction: Vec3::new(at(x), at(y), -0.8).normalize() }, f32::INFINITY));
        }
    }
    let light = Vec3::new(0.3, 0.8, 0.2);
    let (mut secondary, mut shadow, mut random) = (Vec::new(), Vec::new(), Random(1));
    for (ray, t_max) in &coherent {
        let Some(hit) = bvh.closest(ray, *t_max, |_, _| None) else { continue };
        let Primitive::Triangle(index) = hit.primitive else { continue };
        let corners = mesh.triangles[index.0 as usize].map(|vertex| mesh.positions[vertex as usize]);
        let (Some(point), Some(normal)) =
            (TriangleHit::new(ray, corners), geometric_normal(corners[0], corners[1], corners[2]))
        else {
            continue;
        };
        let normal = normal.as_vec3();
        let normal = if normal.dot(ray.direction) > 0.0 { -normal } else { normal };
        let direction = (normal + random.direction()).normalize_or(normal);
        let origin = offset_origin(point.point, point.error, normal, normal);
        secondary.push((Ray { origin, direction }, f32::INFINITY));
        let to_light = light - origin;
        shadow.push((Ray { origin, direction: to_light.normalize() }, to_light.length()));
    }
    // The lanes of a path behind a prism: eight rays from a point within three degrees, one after the other.
    let lane =
        |ray: &Ray, k: usize| Ray { direction: (ray.direction + Vec3::Y * (0.007 * k as f32)).normalize(), ..*ray };
    let bundles: Vec<(Ray, f32)> =
        secondary.iter().step_by(8).flat_map(|(ray, t_max)| (0..8).map(move |k| (lane(ray, k), *t_max))).collect();
    let closest = |ray: &Ray, t_max: f32| bvh.closest(ray, t_max, |_, _| None).is_some();
    let (primary, seen) = speed(&coherent, closest);
    let (incoherent, bounced) = speed(&secondary, closest);
    let (bundled, _) = speed(&bundles, closest);
    let (any, blocked) = speed(&shadow, |ray, t_max| bvh.occluded(ray, t_max, |_, _| false));
    println!(
        "{name:10} {:7} triangles, build {build:6.1} ms, {:5.1} MB: {primary:6.2} / {incoherent:6.2} / {any:6.2} Mrays/s \
         ({seen}, {bounced}, {blocked} hits); a bundle of 8 costs {:.2} rays",
        mesh.triangles.len(),
        bvh.memory_bytes() as f64 * 1e-6,
        8.0 * incoherent / bundled
    );
    build * 1e-3
}

fn main() {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("the first and only pool");
    let eye = Vec3::new(0.05, 0.1, 0.95);
    let mut cornell = Mesh { positions: vec![], triangles: vec![] };
    cornell.cuboid(Vec3::ZERO, Vec3::ONE);
    cornell.cuboid(Vec3::new(-0.35, -0.4, -0.3), Vec3::new(0.3, 0.6, 0.3));
    cornell.cuboid(Vec3::new(0.35, -0.7, 0.3), Vec3::new(0.3, 0.3, 0.3));
    measure("cornell", &cornell, eye);
    let mut seconds_per_triangle = 0.0;
    for (name, levels) in [("ico5k", 4), ("ico20k", 5), ("ico82k", 6), ("ico330k", 7)] {
        let mut mesh = Mesh { positions: vec![], triangles: vec![] };
        mesh.icosphere(0.5, levels);
        mesh.cuboid(Vec3::ZERO, Vec3::ONE);
        seconds_per_triangle = measure(name, &mesh, eye) / mesh.triangles.len() as f64;
    }
    if seconds_per_triangle * 2e6 < 10.0 {
        let mut mesh = Mesh { positions: vec![], triangles: vec![] };
        mesh.bumpy_sphere(0.5, 1000);
        mesh.cuboid(Vec3::ZERO, Vec3::ONE);
        measure("bumpy2M", &mesh, eye);
    }
}
