//! Transparent volumes: which of them hold a point.

use super::{Material, MediumId, ObjectId, Scene};
use crate::geometry::{
    Aabb, Analytic, AnalyticId, Bvh, Primitive, Ray, TriangleHit, TriangleId, geometric_normal, offset_origin,
};
use glam::{DVec3, Vec3};
use std::collections::HashSet;
use std::ops::Range;
use std::sync::OnceLock;

/// A transparent object as a set of points.
#[derive(Debug)]
pub struct Solid {
    /// The object.
    pub object: ObjectId,
    /// What is inside.
    pub medium: MediumId,
    /// Box around it.
    pub bounds: Aabb,
    pub(super) shape: SolidShape,
}

/// How to tell whether a point is inside.
#[derive(Debug)]
pub(super) enum SolidShape {
    /// Count the faces that a ray to infinity crosses. The tree over these triangles alone is built when first needed.
    Triangles(Range<usize>, OnceLock<Bvh>),
    /// Ask the shape's own equation.
    Analytic(AnalyticId),
}

impl SolidShape {
    /// The solid that the triangles with these indices enclose.
    pub fn triangles(range: Range<usize>) -> Self {
        Self::Triangles(range, OnceLock::new())
    }
}

impl Solid {
    /// Whether a point is inside. Faces of other objects, even coincident ones, make no difference.
    pub fn contains(&self, scene: &Scene, point: Vec3) -> bool {
        if !(point.cmpge(self.bounds.min).all() && point.cmple(self.bounds.max).all()) {
            return false;
        }
        match &self.shape {
            SolidShape::Analytic(index) => scene.analytic(*index).contains(point.as_dvec3()),
            SolidShape::Triangles(range, tree) => {
                let triangles = &scene.triangles[range.clone()];
                let tree = tree.get_or_init(|| Bvh::build(&scene.positions, triangles, &[]));
                crossings(tree, &scene.positions, triangles, point) > 0
            }
        }
    }
}

/// How much more often a ray to infinity leaves than it enters.
fn crossings(tree: &Bvh, positions: &[Vec3], triangles: &[[u32; 3]], point: Vec3) -> i32 {
    // An arbitrary direction that no model is likely to be aligned with.
    let mut ray = Ray { origin: point, direction: Vec3::new(0.281_103, 0.873_241, 0.398_014).normalize() };
    let mut balance = 0;
    while let Some(hit) = tree.closest(&ray, f32::INFINITY, |_, _| None) {
        let Primitive::Triangle(TriangleId(index)) = hit.primitive else { break };
        let corners = triangles[index as usize].map(|i| positions[i as usize]);
        let met = TriangleHit::new(&ray, corners).zip(geometric_normal(corners[0], corners[1], corners[2]));
        let Some((met, normal)) = met else { break };
        balance += if normal.dot(ray.direction.as_dvec3()) > 0.0 { 1 } else { -1 };
        ray.origin = offset_origin(met.point, met.error, normal.as_vec3(), ray.direction);
    }
    balance
}

/// Whether a box meets the box of one of these.
pub(super) fn any_overlaps(solids: &[Solid], bounds: &Aabb) -> bool {
    solids.iter().any(|s| s.bounds.overlaps(bounds))
}

impl Scene {
    /// The transparent objects that hold a point, larger ones first: they are taken to have been entered first.
    pub fn interiors_at(&self, point: Vec3) -> Vec<(ObjectId, MediumId)> {
        self.solids.iter().filter(|s| s.contains(self, point)).map(|s| (s.object, s.medium)).collect()
    }

    /// Whether a box meets the box of a transparent object, so that points in it have to ask [`Self::interiors_at`].
    pub fn may_be_inside(&self, bounds: &Aabb) -> bool {
        any_overlaps(&self.solids, bounds)
    }

    /// Marks the transparent objects that have faces in one plane, or may have. A ray meets only one of two such faces,
    /// so that behind them it has to be asked where it is.
    pub(super) fn mark_coincident(&mut self) {
        let mut marked = Vec::new();
        for (i, a) in self.solids.iter().enumerate() {
            for b in &self.solids[i + 1..] {
                if a.bounds.overlaps(&b.bounds) && self.may_coincide(a, b) {
                    marked.extend([a.object, b.object]);
                }
            }
        }
        for ObjectId(index) in marked {
            self.objects[index as usize].coincident = true;
        }
    }

    fn may_coincide(&self, a: &Solid, b: &Solid) -> bool {
        let curved = match (&a.shape, &b.shape) {
            (SolidShape::Analytic(a), SolidShape::Analytic(b)) => self.analytic(*a).may_share_a_face(self.analytic(*b)),
            _ => false,
        };
        let planes = PlaneSet(self.planes(a).map(PlaneSet::cell).collect());
        curved || self.planes(b).any(|plane| planes.contains(plane))
    }

    /// Unit normals and distances from the origin of the planes that a solid has faces in.
    fn planes(&self, solid: &Solid) -> impl Iterator<Item = (DVec3, f64)> {
        let (triangles, analytic) = match &solid.shape {
            SolidShape::Triangles(range, _) => (range.clone(), None),
            SolidShape::Analytic(index) => (0..0, Some(self.analytic(*index))),
        };
        let of_triangle = |triangle: usize| {
            let [a, b, c] = self.triangles[triangle].map(|i| self.positions[i as usize]);
            geometric_normal(a, b, c).map(|n| (n, n.dot(a.as_dvec3())))
        };
        triangles.filter_map(of_triangle).chain(analytic.into_iter().flat_map(Analytic::planes))
    }
}

/// Planes, found again up to a tolerance.
struct PlaneSet(HashSet<[i64; 4]>);

/// Width of a cell: planes that rounding has moved apart lie in the same or in neighbouring ones.
const PLANE_TOLERANCE: f64 = 1.0 / (1 << 16) as f64;

impl PlaneSet {
    /// A plane's normal, turned to one fixed side, and its distance, both counted in cells.
    fn in_cells((normal, distance): (DVec3, f64)) -> [f64; 4] {
        let [x, y, z] = normal.to_array();
        let leading = [x, y, z].into_iter().max_by(|a, b| a.abs().total_cmp(&b.abs()));
        let side = if leading.is_some_and(|x| x < 0.0) { -1.0 } else { 1.0 };
        [x, y, z, distance].map(|v| v * side / PLANE_TOLERANCE)
    }

    fn cell(plane: (DVec3, f64)) -> [i64; 4] {
        Self::in_cells(plane).map(|x| x.floor() as i64)
    }

    fn contains(&self, plane: (DVec3, f64)) -> bool {
        let plane = Self::in_cells(plane);
        // Half a cell to either side of each coordinate reaches every neighbour that is near.
        (0..16).any(|corner| {
            let cell = std::array::from_fn(|i| {
                let side = if corner >> i & 1 == 1 { 0.5 } else { -0.5 };
                (plane[i] + side).floor() as i64
            });
            self.0.contains(&cell)
        })
    }
}

impl Solid {
    pub(super) fn of(object: ObjectId, material: &Material, bounds: Aabb, shape: SolidShape) -> Option<Self> {
        let medium = material.medium()?;
        Some(Self { object, medium, bounds, shape })
    }
}
