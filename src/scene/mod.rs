//! Scenes: [`description`] (the file's words) → [`compile`] → [`Scene`] (what the renderer sees: indices, flat tables,
//! coordinates recentred and scaled by a power of two to about unit size).

mod camera;
mod compile;
pub mod description;
mod features;
mod integrator;
mod light;
mod material;
mod solid;

pub use camera::{Camera, Connection};
pub use compile::{Compiled, FilmSettings, RenderSettings, compile, world_mesh};
pub use features::SceneFeatures;
pub use integrator::Integrator;
pub use light::{Aim, AreaShape, Emission, EmissionStart, Exit, GuidedPair, Light, LightKind, LightSample};
pub use material::{Material, Medium, MediumId, SpectrumId};
pub use solid::Solid;

use crate::geometry::{Aabb, Analytic, AnalyticHit, Bvh, Primitive, Ray, TriangleHit, geometric_normal, offset_origin};
use crate::sampling::AliasTable;
use crate::spectrum::{SpectrumTable, WavelengthDensity};
use glam::{DVec3, Vec3};

/// A compiled scene. Immutable; everything is found by index.
#[derive(Debug)]
pub struct Scene {
    pub(crate) bvh: Bvh,
    pub(crate) positions: Vec<Vec3>,
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Vertex normals, one a position or none at all.
    pub(crate) normals: Vec<Vec3>,
    /// The object of each triangle.
    pub(crate) triangle_objects: Vec<u32>,
    pub(crate) analytic: Vec<Analytic>,
    pub(crate) analytic_objects: Vec<u32>,
    /// Objects, in the file's order.
    pub objects: Vec<Object>,
    /// Transparent objects, the largest first.
    pub solids: Vec<Solid>,
    /// Spectra, by [`SpectrumId`].
    pub spectra: Vec<SpectrumTable>,
    /// Transparent media, by [`MediumId`].
    pub media: Vec<Medium>,
    /// All lights; the environment is one of them.
    pub lights: Vec<Light>,
    /// Draws a light for next-event estimation, by luminous power.
    pub light_table: AliasTable,
    /// Draws a light for light paths that make caustics, by the power that can take part in them.
    pub caustic_table: AliasTable,
    /// A sphere around everything that scatters light into single directions; without such a thing there are no caustics.
    pub caustic_aim: Option<Aim>,
    /// Draws a light for light paths of all kinds.
    pub emission_table: AliasTable,
    /// Lights at infinity that a ray can run into: the environment and discs like the sun's.
    pub infinite_lights: Vec<u32>,
    /// Lights that are asked at every point; see [`Light::is_local`].
    pub local_lights: Vec<u32>,
    /// The camera.
    pub camera: Camera,
    /// Wavelengths of camera paths.
    pub wavelengths: WavelengthDensity,
    /// What the scene needs.
    pub features: SceneFeatures,
    /// Radius of a sphere about the origin that holds everything.
    pub radius: f32,
    /// Length in metres of one unit of the compiled scene, a power of two.
    pub meters_per_unit: f64,
    /// Radiance of one unit in the compiled scene, a power of two.
    pub radiance_scale: f64,
}

/// A shape with its material.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    /// Surface.
    pub material: Material,
    /// Whether the back reflects as the front does.
    pub two_sided: bool,
    /// Index of its light if it emits.
    pub light: Option<u32>,
    /// Box around it.
    pub bounds: Aabb,
    /// Whether it may have a face in common with another transparent object; see [`Scene::interiors_at`].
    pub coincident: bool,
}

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
}

impl Surface {
    /// A ray that leaves the surface.
    pub fn spawn(&self, direction: Vec3) -> Ray {
        Ray { origin: offset_origin(self.point, self.error, self.geometric.as_vec3(), direction), direction }
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
        if !self.normals.is_empty() && matches!(self.objects[object as usize].material, Material::Diffuse { .. }) {
            let [na, nb, nc] = [a, b, c].map(|i| self.normals[i as usize]);
            let [wa, wb, wc] = hit.barycentrics;
            let smooth = (na * wa + nb * wb + nc * wc).normalize_or_zero();
            if smooth.dot(shading) > 0.0 {
                shading = smooth;
            }
        }
        Some(Surface { t, point: hit.point, error: hit.error, geometric, shading, object })
    }

    /// A sphere around everything.
    pub fn everything(&self) -> Aim {
        Aim { center: Vec3::ZERO, radius: self.radius }
    }
}
