//! Triangle meshes as files give them, before the scene is compiled.

use glam::{DVec2, DVec3};
use std::collections::HashMap;

/// An indexed triangle mesh in the file's own units, in f64.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Vertices.
    pub positions: Vec<DVec3>,
    /// Triangles, counter-clockwise as seen from outside.
    pub indices: Vec<[u32; 3]>,
    /// Shading normals as in the file (not normalised): empty, or one per vertex.
    pub normals: Vec<DVec3>,
    /// Texture coordinates: empty, or one per vertex.
    pub uvs: Vec<DVec2>,
}

/// What tells vertices apart: position, normal, texture coordinate.
type VertexKey = ([u64; 3], Option<[u64; 3]>, Option<[u64; 2]>);

/// The bits that equal positions share: −0 counts as 0.
fn position_key(position: DVec3) -> [u64; 3] {
    position.to_array().map(|x| (x + 0.0).to_bits())
}

impl Mesh {
    /// For each vertex, the first vertex at exactly the same position.
    pub(crate) fn first_at_same_position(&self) -> Vec<u32> {
        let mut first = HashMap::with_capacity(self.positions.len());
        self.positions
            .iter()
            .zip(0u32..)
            .map(|(&position, index)| *first.entry(position_key(position)).or_insert(index))
            .collect()
    }

    /// Merges vertices that are equal in position, normal and texture coordinate, and drops those that no triangle uses.
    /// Triangles keep their order and winding; indices have to be in range.
    pub fn weld(&mut self) {
        let mut welded = Mesh { indices: Vec::with_capacity(self.indices.len()), ..Mesh::default() };
        let mut numbers: HashMap<VertexKey, u32> = HashMap::new();
        for triangle in &self.indices {
            let corners = triangle.map(|corner| {
                let vertex = corner as usize;
                let normal = self.normals.get(vertex).copied();
                let uv = self.uvs.get(vertex).copied();
                let key = (
                    position_key(self.positions[vertex]),
                    normal.map(position_key),
                    uv.map(|uv| uv.to_array().map(|x| (x + 0.0).to_bits())),
                );
                *numbers.entry(key).or_insert_with(|| {
                    welded.positions.push(self.positions[vertex]);
                    welded.normals.extend(normal);
                    welded.uvs.extend(uv);
                    (welded.positions.len() - 1) as u32
                })
            });
            welded.indices.push(corners);
        }
        *self = welded;
    }

    /// Whether the surface has no border and one consistent winding: every directed edge, by position, occurs as often
    /// as its opposite. Edges without length (of degenerate triangles) do not count; an empty mesh is not closed.
    pub fn is_closed(&self) -> bool {
        let vertex = self.first_at_same_position();
        let mut balance: HashMap<(u32, u32), i64> = HashMap::new();
        for &triangle in &self.indices {
            let [a, b, c] = triangle.map(|corner| vertex[corner as usize]);
            for (from, to) in [(a, b), (b, c), (c, a)] {
                if from < to {
                    *balance.entry((from, to)).or_default() += 1;
                } else if to < from {
                    *balance.entry((to, from)).or_default() -= 1;
                }
            }
        }
        !balance.is_empty() && balance.values().all(|&difference| difference == 0)
    }

    /// The enclosed volume of a closed mesh, in cubed units of the file: positive if the triangles face outwards,
    /// negative if inwards. Of an open mesh, the volume between it and its first vertex, which says little.
    pub fn signed_volume(&self) -> f64 {
        let Some(&reference) = self.positions.first() else { return 0.0 };
        let corner = |index: u32| self.positions[index as usize] - reference;
        let determinants = self.indices.iter().map(|&[a, b, c]| corner(a).dot(corner(b).cross(corner(c))));
        determinants.sum::<f64>() / 6.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A unit cube at (1e3, 0, 0) with a vertex of its own for each corner of each triangle.
    fn cube() -> Mesh {
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let mut mesh = Mesh::default();
        for [a, b, c, d] in quads {
            for corner in [a, b, c, a, c, d] {
                let bit = |bit: u32| f64::from(corner >> bit & 1u32);
                mesh.positions.push(DVec3::new(1e3 + bit(0), bit(1), bit(2)));
            }
        }
        mesh.indices = (0..12).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        mesh
    }

    #[test]
    fn a_cube_is_closed_and_has_volume() {
        let mut mesh = cube();
        assert!(mesh.is_closed());
        assert_eq!(mesh.signed_volume(), 1.0);
        mesh.weld();
        assert_eq!(mesh.positions.len(), 8);
        assert!(mesh.is_closed());
        assert_eq!(mesh.signed_volume(), 1.0);
        for triangle in &mut mesh.indices {
            triangle.swap(0, 1);
        }
        assert!(mesh.is_closed());
        assert_eq!(mesh.signed_volume(), -1.0);
    }

    #[test]
    fn holes_and_turned_faces_open_a_mesh() {
        let mut hole = cube();
        hole.indices.pop();
        assert!(!hole.is_closed());
        let mut turned = cube();
        turned.indices[3].swap(0, 1);
        assert!(!turned.is_closed());
        assert!(!Mesh::default().is_closed());
        assert_eq!(Mesh::default().signed_volume(), 0.0);
    }

    #[test]
    fn welding_keeps_seams() {
        let mut mesh = cube();
        mesh.uvs = (0..36).map(|i| DVec2::new(f64::from(i / 6), 0.0)).collect();
        mesh.weld();
        assert_eq!(mesh.positions.len(), 24);
        assert_eq!(mesh.uvs.len(), 24);
        assert!(mesh.is_closed());
    }

    #[test]
    fn negative_zero_is_the_same_place() {
        let mut mesh = cube();
        for position in &mut mesh.positions[..9] {
            if position.y == 0.0 {
                position.y = -0.0;
            }
        }
        assert!(mesh.is_closed());
    }
}
