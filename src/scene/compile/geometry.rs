//! Placed shapes become the triangles and analytic shapes of a scene, at unit size.

use super::compiler::Compiler;
use super::materials::Materials;
use super::normalize::Normalization;
use super::place::Placed;
use crate::Result;
use crate::geometry::{Aabb, Analytic, AnalyticId, AnalyticShape, Mesh, Polyhedron};
use crate::scene::solid::SolidShape;
use crate::scene::{Black, Material, Object, ObjectId, Solid};
use glam::{DAffine3, Vec2, Vec3};
use std::ops::Range;

/// All primitives of a scene, normalised.
#[derive(Default)]
pub struct Geometry {
    pub positions: Vec<Vec3>,
    pub triangles: Vec<[u32; 3]>,
    pub normals: Vec<Vec3>,
    pub uvs: Vec<Vec2>,
    pub triangle_objects: Vec<ObjectId>,
    pub analytic: Vec<Analytic>,
    pub analytic_objects: Vec<ObjectId>,
    pub objects: Vec<Object>,
    /// What each object has become.
    pub sources: Vec<Source>,
}

/// The primitives of an object.
pub enum Source {
    /// Indices of its triangles.
    Triangles(Range<u32>),
    /// A shape with its transform into the compiled scene.
    Analytic(AnalyticShape, DAffine3),
    /// One convex solid with flat facets.
    Polyhedron,
}

impl Geometry {
    pub fn compile(compiler: &Compiler, placed: Vec<Placed>, materials: &Materials) -> Result<Self> {
        let normalization = &compiler.normalization;
        let mut geometry = Self::default();
        for (object, placed) in compiler.description.objects.iter().zip(placed) {
            let index = ObjectId(geometry.objects.len() as u32);
            let (material, two_sided) =
                object.material.map_or((Material::Black(Black), false), |m| materials.materials[m]);
            let (bounds, source) = match placed {
                Placed::Mesh(mesh) => {
                    let is_glass = material.medium().is_some() && object.emission.is_none();
                    geometry.add_mesh(mesh, is_glass, index, normalization)
                }
                Placed::Analytic(shape, transform, _) => {
                    let transform = normalization.after(transform);
                    let analytic = Analytic::new(shape.clone(), transform)
                        .map_err(|e| e.at(format!("{}.transform", object.at)))?;
                    (geometry.add_analytic(analytic, index), Source::Analytic(shape, transform))
                }
            };
            geometry.objects.push(Object {
                material,
                two_sided,
                light: None,
                bounds,
                touched: false,
                coincident: false,
            });
            geometry.sources.push(source);
        }
        if geometry.normals.iter().all(|n| *n == Vec3::ZERO) {
            geometry.normals = Vec::new();
        }
        if geometry.uvs.iter().all(|uv| uv.is_nan()) {
            geometry.uvs = Vec::new();
        }
        Ok(geometry)
    }

    fn add_analytic(&mut self, analytic: Analytic, object: ObjectId) -> Aabb {
        let bounds = analytic.bounds();
        self.analytic.push(analytic);
        self.analytic_objects.push(object);
        bounds
    }

    /// Convex glass is intersected as a whole.
    fn add_mesh(
        &mut self,
        mut mesh: Mesh,
        is_glass: bool,
        object: ObjectId,
        normalization: &Normalization,
    ) -> (Aabb, Source) {
        mesh.positions.iter_mut().for_each(|p| *p = normalization.point(*p));
        if let Some(solid) = is_glass.then(|| Polyhedron::of_mesh(&mesh)).flatten() {
            return (self.add_analytic(solid.into(), object), Source::Polyhedron);
        }
        let (first_vertex, first) = (self.positions.len() as u32, self.triangles.len() as u32);
        self.positions.extend(mesh.positions.iter().map(|p| p.as_vec3()));
        self.triangles.extend(mesh.indices.iter().map(|t| t.map(|i| i + first_vertex)));
        self.triangle_objects.resize(self.triangles.len(), object);
        let normal = |i: usize| mesh.normals.get(i).map_or(Vec3::ZERO, |n| n.normalize_or_zero().as_vec3());
        self.normals.extend((0..mesh.positions.len()).map(normal));
        let uv = |i: usize| mesh.uvs.get(i).map_or(Vec2::NAN, |uv| uv.as_vec2());
        self.uvs.extend((0..mesh.positions.len()).map(uv));
        let bounds = Aabb::from_points(self.positions[first_vertex as usize..].iter().copied());
        (bounds, Source::Triangles(first..self.triangles.len() as u32))
    }

    /// Transparent objects, the largest first.
    pub fn solids(&self) -> Vec<Solid> {
        let mut analytic = 0;
        let mut solids: Vec<Solid> = Vec::new();
        for ((object, source), index) in self.objects.iter().zip(&self.sources).zip(0..) {
            let shape = match source {
                Source::Triangles(range) => SolidShape::triangles(range.start as usize..range.end as usize),
                Source::Analytic(..) | Source::Polyhedron => {
                    analytic += 1;
                    SolidShape::Analytic(AnalyticId(analytic - 1))
                }
            };
            solids.extend(Solid::of(ObjectId(index), &object.material, object.bounds, shape));
        }
        solids.sort_by(|a, b| b.bounds.half_area().total_cmp(&a.bounds.half_area()));
        solids
    }

    pub fn analytic_bounds(&self) -> Vec<Aabb> {
        self.analytic.iter().map(Analytic::bounds).collect()
    }
}
