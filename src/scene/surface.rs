//! Where a ray meets a surface, and the coordinates of that point on it.

use super::{EmissionStart, Scene};
use crate::geometry::{AnalyticHit, Parametrization, Primitive, Ray, TriangleHit, geometric_normal, offset_origin};
use glam::{DVec2, DVec3, Vec2, Vec3};

/// A hit on a surface.
#[derive(Debug, Clone, Copy)]
pub struct Surface {
    /// Distance.
    pub t: f32,
    /// The point, on the surface within `error`.
    pub point: Vec3,
    /// Bound of the error of each component of `point`.
    pub error: Vec3,
    /// Unit outward normal.
    pub geometric: DVec3,
    /// Interpolated normal, on the same side.
    pub shading: Vec3,
    /// Index of the object.
    pub object: u32,
    /// Which primitive was hit, and where; `None` for a point that no ray has met.
    pub place: Option<Place>,
}

/// A place on a primitive: what [`Scene::uv`] and [`Scene::parametrization`] start from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Place {
    /// On a triangle.
    Triangle {
        /// Index of the triangle.
        index: u32,
        /// Weights of the second and of the third vertex.
        barycentrics: [f32; 2],
    },
    /// On an analytic shape.
    Analytic {
        /// Index of the shape.
        index: u32,
        /// Which of the shape's surfaces.
        face: u8,
    },
}

impl Surface {
    /// A ray that leaves the surface.
    pub fn spawn(&self, direction: Vec3) -> Ray {
        Ray { origin: offset_origin(self.point, self.error, self.geometric.as_vec3(), direction), direction }
    }

    /// The point just off a light from which a light path starts. It belongs to no object.
    pub fn of_emission(start: &EmissionStart) -> Self {
        Self {
            t: 0.0,
            point: offset_origin(start.point, start.error, start.normal, start.normal),
            error: Vec3::ZERO,
            geometric: start.normal.as_dvec3(),
            shading: start.normal,
            object: u32::MAX,
            place: None,
        }
    }
}

impl Scene {
    /// The first surface on a ray.
    pub fn closest(&self, ray: &Ray, t_max: f32) -> Option<Surface> {
        let mut last: Option<(u32, AnalyticHit)> = None;
        let hit = self.bvh.closest(ray, t_max, |index, t_max| {
            let hit = self.analytic[index as usize].intersect(ray, t_max)?;
            last = Some((index, hit));
            Some(hit.t as f32)
        })?;
        match hit.primitive {
            Primitive::Triangle(index) => self.triangle_surface(ray, index, hit.t),
            Primitive::Analytic(index) => {
                let hit = match last {
                    Some((i, hit)) if i == index => hit,
                    _ => self.analytic[index as usize].intersect(ray, t_max)?,
                };
                Some(Surface {
                    t: hit.t as f32,
                    point: hit.point.as_vec3(),
                    error: hit.error,
                    geometric: hit.normal,
                    shading: hit.normal.as_vec3(),
                    object: self.analytic_objects[index as usize],
                    place: Some(Place::Analytic { index, face: hit.face }),
                })
            }
        }
    }

    /// Whether anything is in the way.
    pub fn occluded(&self, ray: &Ray, t_max: f32) -> bool {
        self.bvh.occluded(ray, t_max, |index, t_max| self.analytic[index as usize].hits(ray, t_max))
    }

    fn triangle_surface(&self, ray: &Ray, index: u32, t: f32) -> Option<Surface> {
        let [a, b, c] = self.triangles[index as usize];
        let vertices = [a, b, c].map(|i| self.positions[i as usize]);
        let hit = TriangleHit::new(ray, vertices)?;
        let geometric = geometric_normal(vertices[0], vertices[1], vertices[2])?;
        let object = self.triangle_objects[index as usize];
        let mut shading = geometric.as_vec3();
        let [wa, wb, wc] = hit.barycentrics;
        if !self.normals.is_empty() && self.objects[object as usize].material.uses_shading_normals() {
            let [na, nb, nc] = [a, b, c].map(|i| self.normals[i as usize]);
            let smooth = (na * wa + nb * wb + nc * wc).normalize_or_zero();
            if smooth.dot(shading) > 0.0 {
                shading = smooth;
            }
        }
        let place = Some(Place::Triangle { index, barycentrics: [wb, wc] });
        Some(Surface { t, point: hit.point, error: hit.error, geometric, shading, object, place })
    }

    /// Texture coordinates at a surface: those of the mesh, or the natural ones of the shape. `None` for a mesh without, for
    /// most implicit surfaces, for points that no ray has met, and for convex glass that is kept as a polyhedron.
    pub fn uv(&self, surface: &Surface) -> Option<Vec2> {
        match surface.place? {
            Place::Triangle { index, barycentrics: [b, c] } => {
                let [uv_a, uv_b, uv_c] = self.triangle_uvs(index)?;
                Some(uv_a * (1.0 - b - c) + uv_b * b + uv_c * c)
            }
            Place::Analytic { .. } => Some(self.parametrization(surface)?.uv.as_vec2()),
        }
    }

    /// Texture coordinates at a surface with the derivatives of the point by them, for the footprint of a texture lookup.
    /// `None` where [`Self::uv`] is, and where the coordinates of a triangle have no area.
    pub fn parametrization(&self, surface: &Surface) -> Option<Parametrization> {
        match surface.place? {
            Place::Triangle { index, .. } => {
                let [a, b, c] = self.triangles[index as usize].map(|i| self.positions[i as usize].as_dvec3());
                let [uv_a, uv_b, uv_c] = self.triangle_uvs(index)?.map(|uv| uv.as_dvec2());
                let (p, q) = (b - a, c - a);
                let (s, t): (DVec2, DVec2) = (uv_b - uv_a, uv_c - uv_a);
                let determinant = s.perp_dot(t);
                let (dp_du, dp_dv) = ((p * t.y - q * s.y) / determinant, (q * s.x - p * t.x) / determinant);
                let uv = self.uv(surface)?.as_dvec2();
                (determinant != 0.0).then_some(Parametrization { uv, dp_du, dp_dv })
            }
            Place::Analytic { index, face } => {
                self.analytic[index as usize].parametrization(face, surface.point.as_dvec3())
            }
        }
    }

    /// Texture coordinates of a triangle's corners, if its mesh has any.
    fn triangle_uvs(&self, index: u32) -> Option<[Vec2; 3]> {
        let [a, b, c] = self.triangles[index as usize].map(|i| self.uvs.get(i as usize).copied());
        let uvs = [a?, b?, c?];
        uvs.iter().all(|uv| uv.is_finite()).then_some(uvs)
    }
}
