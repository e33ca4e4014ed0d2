use super::super::{TriangleHit, geometric_normal, offset_origin};
use super::*;
use glam::DVec3;
use proptest::prelude::*;
use rayon::prelude::*;
use std::collections::{BTreeMap, HashMap};

impl Bvh {
    /// Checks the tree's structure and gives how often each primitive's key occurs.
    fn validate(&self) -> BTreeMap<u32, usize> {
        let mut keys = BTreeMap::new();
        let mut seen = vec![0; self.nodes.len()];
        let deepest = self.validate_below(self.root, &self.bounds, &mut keys, &mut seen);
        assert!(seen.iter().all(|&times| times == 1), "a node is lost or shared");
        assert_eq!(deepest, self.stack_entries);
        assert!(deepest <= LARGE_STACK);
        keys
    }

    fn validate_below(
        &self,
        reference: Reference,
        bounds: &Aabb,
        keys: &mut BTreeMap<u32, usize>,
        seen: &mut [usize],
    ) -> usize {
        if reference == Reference::EMPTY {
            return 0;
        }
        match reference.target() {
            Target::Node(index) => {
                seen[index] += 1;
                let node = &self.nodes[index];
                let full: Vec<_> = (0..WIDTH).filter(|&lane| node.children[lane] != Reference::EMPTY).collect();
                let below = full.iter().map(|&lane| {
                    let child = node.bounds(lane);
                    assert!(bounds.min.cmple(child.min).all() && bounds.max.cmpge(child.max).all());
                    self.validate_below(node.children[lane], &child, keys, seen)
                });
                below.max().expect("a node has children") + full.len() - 1
            }
            Target::Packet(index) => {
                for &key in self.packets[index].triangles.iter().filter(|&&key| key != u32::MAX) {
                    *keys.entry(key).or_default() += 1;
                }
                0
            }
            Target::Analytic(index) => {
                *keys.entry(self.triangle_count + index).or_default() += 1;
                0
            }
        }
    }
}

struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn unit(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / (1u64 << 24) as f32
    }

    fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    /// Uniform in the cube [−1, 1]³.
    fn point(&mut self) -> Vec3 {
        Vec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0
    }

    fn direction(&mut self) -> Vec3 {
        self.point().normalize_or(Vec3::X)
    }
}

#[derive(Clone, Default)]
struct Soup {
    positions: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
}

impl Soup {
    fn random(count: usize, size: f32, random: &mut Random) -> Self {
        let mut soup = Self::default();
        for i in 0..count as u32 {
            let center = random.point();
            soup.positions.extend((0..3).map(|_| center + random.point() * size));
            soup.triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
        }
        soup
    }

    /// A box around the origin whose faces are grids of n × n quads, closed by shared coordinates.
    fn grid_box(n: u32, half: Vec3) -> Self {
        let mut soup = Self::default();
        for axis in 0..3 {
            for side in [-1.0, 1.0] {
                let base = soup.positions.len() as u32;
                for i in 0..=n {
                    for j in 0..=n {
                        let at = |i: u32| 2.0 * i as f32 / n as f32 - 1.0;
                        let mut p = Vec3::ZERO;
                        (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (side, at(i), at(j));
                        soup.positions.push(p * half);
                    }
                }
                for quad in (0..n * n).map(|q| base + q / n * (n + 1) + q % n) {
                    soup.triangles.push([quad, quad + n + 1, quad + n + 2]);
                    soup.triangles.push([quad, quad + n + 2, quad + 1]);
                }
            }
        }
        soup
    }

    /// A sphere: an octahedron whose faces are split `levels` times.
    fn sphere(levels: u32) -> Self {
        let mut points = vec![Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z];
        let mut faces = vec![[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];
        for _ in 0..levels {
            let mut middles = HashMap::new();
            let mut middle = |a: u32, b: u32| {
                *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    points.push((points[a as usize] + points[b as usize]).normalize());
                    points.len() as u32 - 1
                })
            };
            let split = |[a, b, c]: [u32; 3]| {
                let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            };
            faces = faces.into_iter().flat_map(split).collect();
        }
        Self { positions: points, triangles: faces }
    }

    /// Two cones of n needle-like triangles on one thin ring.
    fn needles(n: u32, radius: f32) -> Self {
        let mut positions = vec![Vec3::new(0.0, 0.0, 1.0), Vec3::new(0.0, 0.0, -1.0)];
        for i in 0..n {
            let (sin, cos) = crate::math::sin_cos_turns(i as f32 / n as f32);
            positions.push(Vec3::new(cos * radius, sin * radius, 0.0));
        }
        let ring = (0..n).map(|i| (2 + i, 2 + (i + 1) % n));
        let triangles = ring.flat_map(|(a, b)| [[a, b, 0], [b, a, 1]]).collect();
        Self { positions, triangles }
    }

    fn moved(mut self, map: impl Fn(Vec3) -> Vec3) -> Self {
        self.positions.iter_mut().for_each(|p| *p = map(*p));
        self
    }

    fn corners(&self, triangle: u32) -> [Vec3; 3] {
        self.triangles[triangle as usize].map(|vertex| self.positions[vertex as usize])
    }

    fn bvh(&self) -> Bvh {
        Bvh::build(&self.positions, &self.triangles, &[])
    }
}

fn closest(bvh: &Bvh, ray: &Ray) -> Option<(u32, f32)> {
    bvh.closest(ray, f32::INFINITY, |_, _| None).map(|hit| match hit.primitive {
        Primitive::Triangle(TriangleId(index)) => (index, hit.t),
        Primitive::Analytic(_) => panic!("there are none"),
    })
}

/// Distance and smallest barycentric weight of the ray's meeting with a triangle's plane, in f64.
fn plane_hit(ray: &Ray, corners: [Vec3; 3]) -> (f64, f64) {
    let [a, b, c] = corners.map(|v| v.as_dvec3() - ray.origin.as_dvec3());
    let d = ray.direction.as_dvec3();
    let weights = DVec3::new(b.cross(c).dot(d), c.cross(a).dot(d), a.cross(b).dot(d));
    let sum = weights.element_sum();
    (a.dot(b.cross(c)) / sum, (weights / sum).min_element())
}

#[test]
fn agrees_with_brute_force_in_f64() {
    let mut random = Random(1);
    let mut undecided = 0;
    for (count, size) in [(1, 1.0), (5, 0.8), (36, 0.5), (700, 0.1), (700, 0.7)] {
        let soup = Soup::random(count, size, &mut random);
        let bvh = soup.bvh();
        assert!(bvh.validate().values().eq(std::iter::repeat_n(&1, count)));
        for _ in 0..2000 {
            let ray = Ray { origin: random.point() * 1.5, direction: random.direction() };
            let (mut near, mut sure) = (f64::INFINITY, true);
            let mut id = None;
            for triangle in 0..count as u32 {
                let (t, inside) = plane_hit(&ray, soup.corners(triangle));
                sure &= !(inside.abs() < 1e-5 || t.abs() < 1e-5 || (t - near).abs() < 1e-5);
                if inside >= 0.0 && t > 0.0 && t < near {
                    (near, id) = (t, Some(triangle));
                }
            }
            if !sure {
                undecided += 1;
                continue;
            }
            let hit = closest(&bvh, &ray);
            assert_eq!(hit.map(|hit| hit.0), id);
            assert!(hit.is_none_or(|hit| (f64::from(hit.1) - near).abs() < 2e-5 * near.max(1.0)), "{hit:?} {near}");
            for t_max in [near as f32 * 0.999, near as f32 * 1.001] {
                let shorter = bvh.closest(&ray, t_max, |_, _| None).is_some();
                assert_eq!(shorter, near < f64::from(t_max));
                assert_eq!(shorter, bvh.occluded(&ray, t_max, |_, _| false));
            }
        }
    }
    assert!(undecided < 500, "{undecided} of 10000 rays said nothing");
}

/// Rays from inside at points of edges and at vertices; gives how many of `count` miss.
fn misses(soup: &Soup, count: u64, inside: impl Fn(&mut Random) -> Vec3 + Sync) -> usize {
    let bvh = soup.bvh();
    let blocks = (0..count / 1000).into_par_iter();
    let misses = blocks.map(|block| {
        let mut random = Random(block * 7919);
        let missed = |_: &u32| {
            let corners = soup.corners(random.below(soup.triangles.len()) as u32);
            let target = match random.below(4) {
                0 => corners[0],
                1 => (corners[0] + corners[1]) * 0.5,
                _ => corners[0].lerp(corners[1], random.unit()),
            };
            let origin = inside(&mut random);
            let ray = Ray { origin, direction: (target - origin).normalize() };
            let missed = closest(&bvh, &ray).is_none();
            assert_eq!(missed, !bvh.occluded(&ray, f32::INFINITY, |_, _| false));
            missed
        };
        (0..1000u32).filter(missed).count()
    });
    misses.sum()
}

#[test]
fn closed_meshes_do_not_leak() {
    let sphere = Soup::sphere(6);
    let shift = Vec3::new(1000.0, -500.0, 300.0);
    assert_eq!(misses(&sphere, 3_000_000, |random| random.point() * 0.3), 0);
    assert_eq!(misses(&sphere.clone().moved(|p| p + shift), 2_000_000, |random| random.point() * 0.3 + shift), 0);
    let cuboid = Soup::grid_box(1, Vec3::new(1.0, 0.7, 0.3));
    assert_eq!(misses(&cuboid, 1_500_000, |random| random.point() * 0.29), 0);
    let grid = Soup::grid_box(40, Vec3::ONE);
    assert_eq!(misses(&grid, 2_000_000, |random| random.point() * 0.9), 0);
    let needles = Soup::needles(1000, 1e-3);
    assert_eq!(misses(&needles, 1_500_000, |random| random.point() * 2e-4), 0);
}

#[test]
fn axis_parallel_rays_along_vertices_do_not_leak() {
    let n = 32;
    let bvh = Soup::grid_box(n, Vec3::ONE).bvh();
    let at = |i: u32| 2.0 * i as f32 / n as f32 - 1.0;
    for axis in 0..3 {
        for (i, j, sign) in
            (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j))).flat_map(|(i, j)| [(i, j, 1.0), (i, j, -1.0)])
        {
            for zero in [0.0, -0.0] {
                let (mut origin, mut direction) = (Vec3::ZERO, Vec3::splat(zero));
                (origin[(axis + 1) % 3], origin[(axis + 2) % 3], direction[axis]) = (at(i), at(j), sign);
                let (_, t) = closest(&bvh, &Ray { origin, direction }).expect("a hit");
                assert_eq!(t, 1.0);
            }
        }
    }
}

#[test]
fn rays_in_the_plane_of_a_flat_tree_are_not_lost() {
    // The boxes have no thickness before they grow; the ray enters through their border at a slant.
    let bvh = Soup::grid_box(8, Vec3::new(1.0, 1.0, 0.0)).bvh();
    let ray = Ray { origin: Vec3::new(0.3, 0.2, 1.0), direction: -Vec3::Z };
    assert_eq!(closest(&bvh, &ray).map(|hit| hit.1), Some(1.0));
}

#[test]
fn hits_have_these_bits_on_every_machine() {
    let mut random = Random(6);
    let soup = Soup::random(400, 0.3, &mut random);
    let bvh = soup.bvh();
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for _ in 0..5000 {
        let (origin, target) = (random.point(), random.point());
        let hit = closest(&bvh, &Ray { origin, direction: target - origin });
        let (id, t) = hit.map_or((u32::MAX, 0), |(id, t)| (id, t.to_bits()));
        hash = (hash ^ (u64::from(id) << 32 | u64::from(t))).wrapping_mul(0x0100_0000_01b3);
    }
    assert_eq!(hash, 0xeb49_5547_b574_205b, "{hash:#x}");
}

/// Every bit of the tree.
fn bits(bvh: &Bvh) -> String {
    format!("{bvh:?}")
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let soup = Soup::sphere(7);
    assert!(soup.triangles.len() > 3 * 32_768, "long enough for every parallel path");
    let rays: Vec<_> = {
        let mut random = Random(5);
        (0..2000).map(|_| Ray { origin: random.point(), direction: random.direction() }).collect()
    };
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            let bvh = soup.bvh();
            let hits: Vec<_> = rays.par_iter().map(|ray| closest(&bvh, ray).map(|(id, t)| (id, t.to_bits()))).collect();
            (bits(&bvh), hits)
        })
    };
    let one = run(1);
    assert!(run(2) == one && run(8) == one);
}

#[test]
fn powers_of_two_change_nothing() {
    let mut random = Random(2);
    let soup = Soup::random(500, 0.3, &mut random);
    let bvh = soup.bvh();
    for scale in [power_of_two(20), power_of_two(-20)] {
        let scaled = soup.clone().moved(|p| p * scale).bvh();
        for _ in 0..3000 {
            let ray = Ray { origin: random.point(), direction: random.direction() };
            let far = Ray { origin: ray.origin * scale, ..ray };
            let expected = closest(&bvh, &ray).map(|(id, t)| (id, (t * scale).to_bits()));
            assert_eq!(closest(&scaled, &far).map(|(id, t)| (id, t.to_bits())), expected);
        }
    }
}

fn power_of_two(exponent: i32) -> f32 {
    f32::from_bits(((127 + exponent) as u32) << 23)
}

#[test]
fn degenerate_input_is_harmless() {
    let ray = Ray { origin: Vec3::new(0.25, 0.25, 1.0), direction: -Vec3::Z };
    let empty = Bvh::build(&[], &[], &[]);
    assert_eq!(closest(&empty, &ray), None);
    assert!(!empty.occluded(&ray, 1e9, |_, _| true));
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
    let one = Bvh::build(&corners, &[[0, 1, 2]], &[]);
    assert_eq!(closest(&one, &ray), Some((0, 1.0)));
    let same = Bvh::build(&corners, &vec![[0, 1, 2]; 5000], &[]);
    same.validate();
    assert_eq!(closest(&same, &ray), Some((0, 1.0)));
    let flat = Bvh::build(&[Vec3::ZERO, Vec3::X, Vec3::X * 3.0], &[[0, 1, 2], [0, 0, 1], [1, 1, 1]], &[]);
    assert!(flat.validate().is_empty());
    let bad = [Vec3::ZERO, Vec3::X, Vec3::NAN, Vec3::INFINITY];
    assert!(Bvh::build(&bad, &[[0, 1, 2], [0, 1, 3], [0, 1, 4]], &[Aabb::EMPTY]).validate().is_empty());
    // One centre for all, different sizes.
    let mut nested = Soup::default();
    for i in 0..3000u32 {
        let size = 1.0 + i as f32;
        nested.positions.extend([Vec3::new(-size, -size, 0.0), Vec3::new(size, -size, 0.0), Vec3::new(0.0, size, 0.0)]);
        nested.triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    let bvh = nested.bvh();
    assert_eq!(bvh.validate().len(), 3000);
    assert_eq!(closest(&bvh, &Ray { origin: Vec3::new(0.0, 0.0, 1.0), ..ray }), Some((0, 1.0)));
}

#[test]
fn a_tree_that_wants_to_be_deep_is_bounded() {
    // Triangles at exponentially shrinking places: the heuristic would split them off one by one.
    let mut soup = Soup::default();
    for i in 0..2000u32 {
        let x = power_of_two(-((i / 20) as i32)) * (1.0 + (i % 20) as f32 * 0.02);
        soup.positions.extend([Vec3::new(x, 0.0, 0.0), Vec3::new(x * 1.01, 0.0, 0.0), Vec3::new(x, x, x * 0.01)]);
        soup.triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    let bvh = soup.bvh();
    assert_eq!(bvh.validate().len(), 2000);
    assert!(bvh.stack_entries <= LARGE_STACK);
}

fn with_negative_zeros(v: Vec3) -> Vec3 {
    Vec3::from_array(v.to_array().map(|x| if x == 0.0 { -0.0 } else { x }))
}

#[test]
fn a_plane_through_the_origin_does_not_constrain() {
    let unit = Aabb { min: Vec3::ZERO, max: Vec3::ONE };
    let node = Node::new(&[(unit, Reference::analytic(0))]);
    for (origin, direction) in [(Vec3::ZERO, Vec3::X), (Vec3::ONE, -Vec3::Y), (Vec3::new(0.0, 1.0, -3.0), Vec3::Z)] {
        for ray in [Ray { origin, direction }, Ray { origin, direction: with_negative_zeros(direction) }] {
            let lanes = RayLanes::new(&ray).expect("a ray");
            assert_eq!(node.intersect(&lanes, f32::INFINITY).1, 1, "{ray:?}");
        }
    }
    for origin in [Vec3::new(0.5, 1.5, 0.5), Vec3::new(0.5, 0.5, -1e-30), Vec3::new(2.0, 0.5, 0.5)] {
        let lanes = RayLanes::new(&Ray { origin, direction: Vec3::X }).expect("a ray");
        assert_eq!(node.intersect(&lanes, f32::INFINITY).1, 0, "{origin}");
    }
}

#[test]
fn rays_without_a_direction_hit_nothing() {
    let bvh = Soup::sphere(3).bvh();
    for direction in [Vec3::ZERO, -Vec3::ZERO, Vec3::NAN, Vec3::new(1.0, f32::NAN, 0.0), Vec3::INFINITY] {
        assert_eq!(closest(&bvh, &Ray { origin: Vec3::ZERO, direction }), None);
    }
    let ray = Ray { origin: Vec3::ZERO, direction: Vec3::X };
    assert!(closest(&bvh, &Ray { origin: Vec3::NAN, ..ray }).is_none());
    for t_max in [0.0, -1.0, f32::NAN, f32::NEG_INFINITY] {
        assert!(bvh.closest(&ray, t_max, |_, _| None).is_none());
    }
}

/// Nearest distance > 0 to a sphere.
fn sphere_hit(ray: &Ray, center: Vec3, radius: f32) -> Option<f32> {
    let offset = ray.origin - center;
    let (b, c) = (offset.dot(ray.direction), offset.length_squared() - radius * radius);
    let root = (b * b - c).sqrt();
    [-b - root, -b + root].into_iter().find(|&t| t > 0.0)
}

#[test]
fn analytic_primitives_mix_with_triangles() {
    let mut random = Random(3);
    let soup = Soup::random(200, 0.2, &mut random);
    let spheres: Vec<_> = (0..60).map(|_| (random.point(), 0.02 + 0.2 * random.unit())).collect();
    let boxes: Vec<_> = spheres.iter().map(|&(c, r)| Aabb { min: c - r * 1.001, max: c + r * 1.001 }).collect();
    let bvh = Bvh::build(&soup.positions, &soup.triangles, &boxes);
    assert_eq!(bvh.validate().len(), 260);
    let triangles = soup.bvh();
    for _ in 0..5000 {
        let ray = Ray { origin: random.point(), direction: random.direction() };
        let hit = |AnalyticId(index)| sphere_hit(&ray, spheres[index as usize].0, spheres[index as usize].1);
        let mut expected = closest(&triangles, &ray).map(|(id, t)| (Primitive::Triangle(TriangleId(id)), t));
        for index in (0..60).map(AnalyticId) {
            if let Some(t) = hit(index)
                && expected.is_none_or(|(_, near)| t < near)
            {
                expected = Some((Primitive::Analytic(index), t));
            }
        }
        let closest = bvh.closest(&ray, f32::INFINITY, |index, t_max| hit(index).filter(|&t| t < t_max));
        assert_eq!(closest.map(|hit| (hit.primitive, hit.t)), expected);
        assert_eq!(bvh.occluded(&ray, f32::INFINITY, |index, _| hit(index).is_some()), expected.is_some());
    }
}

#[test]
fn the_first_of_equally_near_primitives_wins() {
    let mut random = Random(4);
    // A far-flung tree in which many primitives meet the ray at t = 1 exactly, in shuffled order.
    let mut soup = Soup::default();
    let mut analytic = Vec::new();
    for i in 0..64u32 {
        let reach = 1.0 + 50.0 * random.unit();
        soup.positions.extend([Vec3::new(-reach, -1.0, 1.0), Vec3::new(reach, -1.0, 1.0), Vec3::new(0.0, reach, 1.0)]);
        soup.triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
        analytic.push(Aabb { min: Vec3::new(-reach, -1.0, 1.0), max: Vec3::new(1.0, reach, 1.0) });
    }
    let ray = Ray { origin: Vec3::ZERO, direction: Vec3::Z };
    let both = Bvh::build(&soup.positions, &soup.triangles, &analytic);
    let meets = |_: AnalyticId, t_max: f32| (t_max > 1.0).then_some(1.0);
    assert_eq!(both.closest(&ray, 9.0, meets), Some(BvhHit { primitive: Primitive::Triangle(TriangleId(0)), t: 1.0 }));
    let alone = Bvh::build(&[], &[], &analytic);
    assert_eq!(alone.closest(&ray, 9.0, meets), Some(BvhHit { primitive: Primitive::Analytic(AnalyticId(0)), t: 1.0 }));
    assert_eq!(alone.closest(&ray, 1.0, meets), None);
}

#[test]
fn a_ray_that_leaves_a_surface_does_not_meet_it_again() {
    // The slabs are wide and thin: seen obliquely, their vertices are far away along the ray and the plane is not.
    let (slab, sheet) = (Soup::grid_box(1, Vec3::new(1.0, 1e-2, 1.0)), Soup::grid_box(1, Vec3::new(1.0, 1.0, 1e-4)));
    for (soup, reach) in [(Soup::sphere(4), 1.0), (Soup::grid_box(1, Vec3::ONE), 1.0), (slab, 1e-3), (sheet, 1e-5)] {
        let shift = Vec3::new(0.3, 0.1, -0.2);
        let soup = soup.moved(|p| p * 0.4 + shift);
        let bvh = soup.bvh();
        let mut random = Random(8);
        for _ in 0..100_000 {
            let ray = Ray { origin: shift + random.point() * 0.1 * reach, direction: random.direction() };
            let (id, _) = closest(&bvh, &ray).expect("a hit from inside");
            let corners = soup.corners(id);
            let hit = TriangleHit::new(&ray, corners).expect("the same hit");
            let [a, b, c] = corners;
            let normal = geometric_normal(a, b, c).expect("a normal").as_vec3();
            let outwards = if normal.dot(ray.direction) > 0.0 { normal } else { -normal };
            let direction = random.direction();
            let direction = if direction.dot(outwards) < 0.0 { -direction } else { direction };
            let origin = offset_origin(hit.point, hit.error, normal, direction);
            assert_eq!(closest(&bvh, &Ray { origin, direction }), None, "a convex body is left for good");
        }
    }
}

/// Floats of any bits, ordinary ones and a few special ones.
fn wild() -> impl Strategy<Value = f32> {
    let special = [0.0, -0.0, 1.0, -1.0, f32::MAX, f32::MIN, f32::MIN_POSITIVE, f32::INFINITY, f32::NAN, 1e-45];
    prop_oneof![any::<u32>().prop_map(f32::from_bits), -2.0f32..2.0, prop::sample::select(special.to_vec())]
}

fn wild_point() -> impl Strategy<Value = Vec3> {
    (wild(), wild(), wild()).prop_map(|(x, y, z)| Vec3::new(x, y, z))
}

proptest! {
    #[test]
    fn any_bits_are_survived(
        positions in prop::collection::vec(wild_point(), 1..40),
        triangles in prop::collection::vec(prop::array::uniform3(0u32..42), 0..64),
        boxes in prop::collection::vec((wild_point(), wild_point()), 0..8),
        rays in prop::collection::vec((wild_point(), wild_point(), wild()), 1..20),
    ) {
        let boxes: Vec<_> = boxes.into_iter().map(|(min, max)| Aabb { min, max }).collect();
        let bvh = Bvh::build(&positions, &triangles, &boxes);
        prop_assert!(bvh.validate().values().all(|&times| times == 1));
        for (origin, direction, t_max) in rays {
            let ray = Ray { origin, direction };
            let hit = bvh.closest(&ray, t_max, |_, t_max| Some(t_max * 0.5).filter(|&t| t > 0.0 && t < t_max));
            prop_assert!(hit.is_none_or(|hit| hit.t > 0.0 && hit.t < t_max));
            let any = bvh.occluded(&ray, t_max, |_, t_max| t_max * 0.5 > 0.0 && t_max * 0.5 < t_max);
            prop_assert_eq!(hit.is_some(), any);
        }
    }
}
