//! Solids with flat facets, made of triangles.

mod brilliant;
mod prism;

use glam::DVec3;

pub use brilliant::{BrilliantCut, brilliant};
pub use prism::prism;

/// Triangles with shared vertices: closed, each edge shared by two triangles, counter-clockwise seen from outside.
#[derive(Debug, Clone, PartialEq)]
pub struct TriangleSoup {
    /// Vertices, metres.
    pub positions: Vec<DVec3>,
    /// Vertex triples.
    pub indices: Vec<[u32; 3]>,
}

/// A convex solid around the origin from its flat facets, each a loop of vertices in either direction.
fn convex_solid(positions: Vec<DVec3>, facets: &[Vec<u32>]) -> TriangleSoup {
    let at = |i: u32| positions[i as usize];
    let mut indices = Vec::new();
    for facet in facets {
        let normal = (at(facet[1]) - at(facet[0])).cross(at(facet[2]) - at(facet[0]));
        let outward = normal.dot(at(facet[0])) > 0.0;
        for pair in facet[1..].windows(2) {
            indices.push(if outward { [facet[0], pair[0], pair[1]] } else { [facet[0], pair[1], pair[0]] });
        }
    }
    TriangleSoup { positions, indices }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use std::collections::HashMap;

    impl TriangleSoup {
        pub(crate) fn normal(&self, triangle: [u32; 3]) -> DVec3 {
            let [a, b, c] = triangle.map(|i| self.positions[i as usize]);
            (b - a).cross(c - a)
        }

        pub(crate) fn volume(&self) -> f64 {
            let sixth = |t: &[u32; 3]| self.normal(*t).dot(self.positions[t[0] as usize]) / 6.0;
            self.indices.iter().map(sixth).sum()
        }

        /// Number of different facet planes.
        pub(crate) fn facet_count(&self) -> usize {
            let mut normals: Vec<DVec3> = Vec::new();
            for triangle in &self.indices {
                let n = self.normal(*triangle).normalize();
                if !normals.iter().any(|m| m.distance(n) < 1e-9) {
                    normals.push(n);
                }
            }
            normals.len()
        }
    }

    /// Closed, 2-manifold, of genus 0, convex, no triangle without area, no vertex unused.
    pub fn check(solid: &TriangleSoup) {
        let mut edges = HashMap::new();
        for t in &solid.indices {
            for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
                assert!(edges.insert((a, b), ()).is_none(), "edge {a}-{b} twice in the same direction");
            }
        }
        assert!(edges.keys().all(|&(a, b)| edges.contains_key(&(b, a))), "an open edge");
        let euler = solid.positions.len() as i64 - edges.len() as i64 / 2 + solid.indices.len() as i64;
        assert_eq!(euler, 2);
        let size = solid.positions.iter().map(|p| p.length()).fold(0.0, f64::max);
        for t in &solid.indices {
            let n = solid.normal(*t);
            assert!(n.length() > 1e-8 * size * size, "a triangle without area");
            let n = n.normalize();
            for p in &solid.positions {
                let height = n.dot(*p - solid.positions[t[0] as usize]);
                assert!(height < 1e-14 * size, "vertex {p} lies {height} outside of a facet");
            }
        }
        assert!(solid.volume() > 0.0);
    }
}
