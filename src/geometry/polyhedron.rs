//! Convex solids with flat facets, as the points behind all of their planes: a line is inside from the last plane that it
//! passes inwards to the first that it passes outwards. One such solid costs a ray less than a tree over its triangles, and has no
//! edges to slip through.

use super::Aabb;
use super::hit::{AnalyticHit, F64_CHAIN, HALF_ULP, inflated};
use super::mesh::Mesh;
use glam::DVec3;
use wide::f64x4;

/// Largest number of facets. Measured in balls of diamond, a ray takes 0.45 ns for each, and with 120 as long as in a tree.
const MOST_FACETS: usize = 96;
/// Facets of a packet.
const WIDTH: usize = 4;
/// How far vertices may be off the plane of their facet, relative to the solid's radius: less than what rounding to f32 would
/// move them.
const FLATNESS: f64 = 1.0 / (1 << 24) as f64;

/// A convex solid.
#[derive(Debug, Clone, PartialEq)]
pub struct Polyhedron {
    /// Origin of planes and packets.
    center: DVec3,
    /// Largest distance of a vertex from there.
    radius: f64,
    bounds: Aabb,
    facets: Vec<Facet>,
    packets: Vec<Packet>,
}

/// The plane of a facet.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Facet {
    /// Unit, outward.
    normal: DVec3,
    /// Distance from the centre.
    offset: f64,
}

/// Four facets by component. Where fewer are left at the end, the packet's first is repeated.
#[derive(Debug, Clone, PartialEq)]
struct Packet {
    normal: [f64x4; 3],
    offset: f64x4,
}

impl Facet {
    /// How far a point is behind the plane, negative in front of it.
    fn depth(&self, point: DVec3) -> f64 {
        self.offset - self.normal.dot(point)
    }
}

impl Polyhedron {
    /// The solid that a mesh encloses. `None` if it is not closed, not convex, inside out, flat, or has too many facets.
    pub fn of_mesh(mesh: &Mesh) -> Option<Self> {
        // No triangulation of the facets has more, but for one that splits them for no reason.
        if mesh.indices.len() > 4 * MOST_FACETS || !mesh.is_closed() {
            return None;
        }
        let vertices = || mesh.indices.iter().flatten().map(|&i| mesh.positions[i as usize]);
        let (min, max) = vertices()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(min, max), vertex| (min.min(vertex), max.max(vertex)));
        let center = 0.5 * (min + max);
        let radius = vertices().map(|vertex| vertex.distance(center)).fold(0.0, f64::max);
        let tolerance = radius * FLATNESS;
        let facets = facets(mesh, center, tolerance)?;
        let has_all_behind = |facet: &Facet| {
            let depths = || vertices().map(|vertex| facet.depth(vertex - center));
            depths().all(|depth| depth >= -tolerance) && depths().any(|depth| depth > tolerance)
        };
        facets.iter().all(has_all_behind).then(|| Self {
            center,
            radius,
            bounds: Aabb::enclosing(min - tolerance, max + tolerance),
            packets: facets.chunks(WIDTH).map(Packet::new).collect(),
            facets,
        })
    }

    /// A box around it.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// Whether a point is inside or on the surface.
    pub fn contains(&self, point: DVec3) -> bool {
        self.facets.iter().all(|facet| facet.depth(point - self.center) >= 0.0)
    }

    /// Unit normals of the facets, and the distances of their planes from the origin.
    pub fn planes(&self) -> impl Iterator<Item = (DVec3, f64)> {
        self.facets.iter().map(|facet| (facet.normal, facet.offset + facet.normal.dot(self.center)))
    }

    /// The nearest hit with 0 < t < `t_max`.
    #[inline]
    pub(super) fn intersect(&self, o: DVec3, d: DVec3, t_max: f64) -> Option<AnalyticHit> {
        let o = o - self.center;
        let (t, facet) = self.first_crossing(o, d, t_max)?;
        let Facet { normal, offset } = self.facets[facet];
        let along = o + d * t;
        let point = along + normal * (offset - normal.dot(along)) + self.center;
        let rounding = point.abs() * HALF_ULP + (self.center.abs() + self.radius) * F64_CHAIN;
        Some(AnalyticHit { t, point, normal, error: inflated(rounding), face: 0 })
    }

    /// Whether there is a hit with 0 < t < `t_max`.
    pub(super) fn hits(&self, o: DVec3, d: DVec3, t_max: f64) -> bool {
        self.first_crossing(o - self.center, d, t_max).is_some()
    }

    /// The first t in (0, `t_max`) at which a line enters or leaves, and the facet there.
    #[inline]
    fn first_crossing(&self, o: DVec3, d: DVec3, t_max: f64) -> Option<(f64, usize)> {
        let splat = |v: DVec3| v.to_array().map(f64x4::splat);
        let (o, d, zero) = (splat(o), splat(d), f64x4::ZERO);
        let (mut enters, mut leaves) = (Extreme::at(f64::NEG_INFINITY), Extreme::at(f64::INFINITY));
        let mut number = zero;
        for Packet { normal: [x, y, z], offset } in &self.packets {
            let (depth, rate) = (*offset - (*x * o[0] + *y * o[1] + *z * o[2]), *x * d[0] + *y * d[1] + *z * d[2]);
            let t = depth / rate;
            let in_front = depth.simd_lt(zero);
            if in_front.to_bitmask() != 0 {
                // In front of a plane, and not coming nearer.
                if (in_front & rate.simd_ge(zero)).to_bitmask() != 0 {
                    return None;
                }
                enters.replace(in_front & t.simd_gt(enters.t), t, number);
            }
            leaves.replace(rate.simd_gt(zero) & t.simd_lt(leaves.t), t, number);
            number += f64x4::splat(1.0);
        }
        let (first, last) = (enters.best(|a, b| a > b), leaves.best(|a, b| a < b));
        let (t, facet) = match first {
            (t, _) if t == f64::NEG_INFINITY => last,
            (t, _) if t > last.0 => return None,
            first => first,
        };
        // On a plane counts as just behind it.
        let t = t.max(f64::from(f32::MIN_POSITIVE));
        (t < t_max).then_some((t, if facet < self.facets.len() { facet } else { facet / WIDTH * WIDTH }))
    }
}

/// For each lane of the packets, the plane that a line passes first or last.
struct Extreme {
    t: f64x4,
    /// The packet it is in.
    packet: f64x4,
}

impl Extreme {
    fn at(t: f64) -> Self {
        Self { t: f64x4::splat(t), packet: f64x4::ZERO }
    }

    #[inline(always)]
    fn replace(&mut self, lanes: f64x4, t: f64x4, packet: f64x4) {
        self.t = lanes.select(t, self.t);
        self.packet = lanes.select(packet, self.packet);
    }

    /// The best of the lanes, and the facet.
    #[inline(always)]
    fn best(&self, better: impl Fn(f64, f64) -> bool) -> (f64, usize) {
        let (t, packet) = (self.t.to_array(), self.packet.to_array());
        let lane = (1..WIDTH).fold(0, |best, lane| if better(t[lane], t[best]) { lane } else { best });
        (t[lane], packet[lane] as usize * WIDTH + lane)
    }
}

impl Packet {
    fn new(facets: &[Facet]) -> Self {
        let lanes = |of: &dyn Fn(&Facet) -> f64| {
            f64x4::new(std::array::from_fn(|lane| of(facets.get(lane).unwrap_or(&facets[0]))))
        };
        Self { normal: [0, 1, 2].map(|axis| lanes(&|facet| facet.normal[axis])), offset: lanes(&|facet| facet.offset) }
    }
}

/// The planes of a mesh about a centre; `None` if there are too many. Large triangles tell them first, as they tell best.
fn facets(mesh: &Mesh, center: DVec3, tolerance: f64) -> Option<Vec<Facet>> {
    let mut triangles: Vec<([DVec3; 3], DVec3)> = mesh
        .indices
        .iter()
        .map(|triangle| {
            let [a, b, c] = triangle.map(|i| mesh.positions[i as usize] - center);
            ([a, b, c], (b - a).cross(c - a))
        })
        .filter(|(_, normal)| *normal != DVec3::ZERO)
        .collect();
    triangles.sort_by(|(_, a), (_, b)| b.length_squared().total_cmp(&a.length_squared()));
    let mut facets: Vec<Facet> = Vec::new();
    for (corners, normal) in triangles {
        let lies_in = |facet: &Facet| {
            facet.normal.dot(normal) > 0.0 && corners.iter().all(|&corner| facet.depth(corner).abs() <= tolerance)
        };
        if facets.iter().any(lies_in) {
            continue;
        }
        if facets.len() == MOST_FACETS {
            return None;
        }
        let normal = normal.normalize();
        facets.push(Facet { normal, offset: normal.dot(corners[0]) });
    }
    Some(facets)
}

#[cfg(test)]
mod tests {
    use super::super::random::Rng;
    use super::super::solids::{BrilliantCut, TriangleSoup, brilliant, prism};
    use super::super::{Analytic, Bvh, Primitive, Ray, TriangleId, geometric_normal};
    use super::*;
    use crate::math;

    fn mesh(soup: TriangleSoup) -> Mesh {
        Mesh { positions: soup.positions, indices: soup.indices, ..Mesh::default() }
    }

    fn gem() -> Mesh {
        mesh(brilliant(&BrilliantCut { radius: 0.4, ..BrilliantCut::default() }).unwrap())
    }

    fn wedge() -> Mesh {
        mesh(prism(8.0, 0.7, 0.5).unwrap())
    }

    /// What the tree over the triangles says, for rays from anywhere, through the middle and past it.
    #[test]
    fn agrees_with_a_tree_over_its_triangles() {
        for (mesh, facets) in [(gem(), 73), (wedge(), 5)] {
            let solid = Polyhedron::of_mesh(&mesh).unwrap();
            assert_eq!(solid.facets.len(), facets);
            let positions: Vec<_> = mesh.positions.iter().map(|p| p.as_vec3()).collect();
            let (tree, solid) = (Bvh::build(&positions, &mesh.indices, &[]), Analytic::from(solid));
            let mut rng = Rng::new(1);
            let (mut hits, mut from_inside, mut odd) = (0, 0, 0);
            for _ in 0..200_000 {
                let origin = 0.6 * DVec3::new(rng.signed(), rng.signed(), rng.signed());
                let ray = Ray { origin: origin.as_vec3(), direction: rng.direction().as_vec3() };
                let expected = tree.closest(&ray, f32::INFINITY, |_, _| None);
                let found = solid.intersect(&ray, f32::INFINITY);
                assert_eq!(found.is_some(), solid.hits(&ray, f32::INFINITY));
                let (Some(expected), Some(found)) = (expected, found) else {
                    // Rounded vertices move edges a little.
                    odd += u32::from(expected.is_some() != found.is_some());
                    continue;
                };
                hits += 1;
                from_inside += u32::from(solid.contains(ray.origin.as_dvec3()));
                let Primitive::Triangle(TriangleId(index)) = expected.primitive else { panic!("{expected:?}") };
                let [a, b, c] = mesh.indices[index as usize].map(|i| positions[i as usize]);
                let normal = geometric_normal(a, b, c).unwrap();
                let same = (found.t - f64::from(expected.t)).abs() < 1e-5 && normal.distance(found.normal) < 1e-5;
                odd += u32::from(!same);
            }
            assert!(hits > 5_000 && from_inside > 1_000, "{hits} {from_inside}");
            assert!(odd <= 4, "{odd} of {hits}");
        }
    }

    /// Rays along facets and edges, through vertices, and from points on them: whatever is met, an end is met.
    #[test]
    fn nothing_leaks_at_edges_and_vertices() {
        for mesh in [gem(), wedge()] {
            let solid = Analytic::from(Polyhedron::of_mesh(&mesh).unwrap());
            let inside = mesh.positions.iter().sum::<DVec3>() / mesh.positions.len() as f64;
            assert!(solid.contains(inside));
            let mut rng = Rng::new(2);
            for _ in 0..100_000 {
                let triangle = mesh.indices[(rng.uniform() * mesh.indices.len() as f64) as usize];
                let [a, b, _] = triangle.map(|i| mesh.positions[i as usize]);
                let share = [0.0, 1.0, rng.uniform()][(rng.uniform() * 3.0) as usize];
                let ray = |from: DVec3, to: DVec3| Ray { origin: from.as_vec3(), direction: (to - from).as_vec3() };
                let to_edge = solid.intersect(&ray(inside, a.lerp(b, share)), f32::INFINITY);
                assert!(to_edge.is_some_and(|hit| (hit.t - 1.0).abs() < 1e-5), "{to_edge:?}");
                let from_edge = solid.intersect(&ray(a.lerp(b, share).lerp(inside, 1e-5), inside), f32::INFINITY);
                assert!(from_edge.is_some_and(|hit| hit.t > 1.0), "{from_edge:?}");
            }
        }
    }

    #[test]
    fn only_closed_convex_meshes_with_few_facets_are_solids() {
        assert!(Polyhedron::of_mesh(&gem()).is_some());
        let change = |change: &dyn Fn(&mut Mesh)| {
            let mut mesh = gem();
            change(&mut mesh);
            Polyhedron::of_mesh(&mesh)
        };
        assert!(change(&|mesh| mesh.indices.clear()).is_none(), "empty");
        assert!(change(&|mesh| mesh.indices.truncate(mesh.indices.len() - 1)).is_none(), "open");
        assert!(change(&|mesh| mesh.indices.iter_mut().for_each(|t| t.swap(0, 1))).is_none(), "inside out");
        assert!(change(&|mesh| mesh.positions[0] *= 0.99).is_none(), "dented");
        let twice = change(&|mesh| {
            let count = mesh.positions.len() as u32;
            mesh.positions.extend_from_within(..);
            mesh.positions[count as usize..].iter_mut().for_each(|p| p.x += 2.0);
            mesh.indices.extend(mesh.indices.clone().iter().map(|t| t.map(|i| i + count)));
        });
        assert!(twice.is_none(), "two solids");
        let flat = Mesh { positions: vec![DVec3::ZERO; 3], indices: vec![[0, 1, 2], [0, 2, 1]], ..Mesh::default() };
        assert!(Polyhedron::of_mesh(&flat).is_none(), "no area");
        let sheet = Mesh { positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y], ..flat };
        assert!(sheet.is_closed() && Polyhedron::of_mesh(&sheet).is_none(), "no volume");
        assert!(Polyhedron::of_mesh(&ball(6)).is_some());
        assert!(Polyhedron::of_mesh(&ball(7)).is_none(), "too many facets");
    }

    /// A ball of 2 n² facets about, from poles and rings.
    fn ball(n: u32) -> Mesh {
        let at = |ring: u32, i: u32| {
            let (polar, around) = (f64::from(ring) / f64::from(n), f64::from(i % (2 * n)) / f64::from(n));
            let [polar, around] = [polar, around].map(|share| share * std::f64::consts::PI);
            let sin = math::sin(polar);
            DVec3::new(sin * math::cos(around), sin * math::sin(around), math::cos(polar))
        };
        let mut mesh = Mesh::default();
        for (ring, i) in (0..n).flat_map(|ring| (0..2 * n).map(move |i| (ring, i))) {
            let corners = [at(ring, i), at(ring + 1, i), at(ring + 1, i + 1), at(ring, i + 1)];
            let first = mesh.positions.len() as u32;
            mesh.positions.extend(corners.map(|p| if p.x.hypot(p.y) < 1e-9 { DVec3::new(0.0, 0.0, p.z) } else { p }));
            mesh.indices.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        }
        mesh
    }
}
