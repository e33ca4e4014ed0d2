//! Scenes: [`description`] (the file's words) → [`compile`] → [`Scene`] (what the renderer sees: indices, flat tables,
//! coordinates recentred and scaled by a power of two to about unit size).

mod camera;
mod compile;
mod contact;
pub mod description;
mod features;
mod ids;
mod integrator;
mod light;
mod material;
mod solid;
mod surface;

pub use camera::Camera;
pub use compile::{Compiled, FilmSettings, RenderSettings, compile, world_mesh};
pub use features::SceneFeatures;
pub use ids::{LightId, MediumId, ObjectId, SpectrumId};
pub use integrator::Integrator;
pub use light::{
    Aim, AreaLight, AreaShape, BeamLight, DirectionalLight, Emission, EmissionStart, EnvironmentLight, Exit,
    GuidedPair, Light, LightKind, LightSample, PointLight, SpotLight,
};
pub use material::{
    Black, ConductorMaterial, DielectricMaterial, DiffuseMaterial, Material, Medium, MirrorMaterial, Parameter,
};
pub use solid::Solid;
pub use surface::{Place, Surface};

use crate::geometry::{Aabb, Analytic, Bvh};
use crate::sampling::AliasTable;
use crate::spectrum::{SpectrumTable, WavelengthDensity};
use glam::{Vec2, Vec3};

/// A compiled scene. Immutable; everything is found by index.
#[derive(Debug)]
pub struct Scene {
    pub(crate) bvh: Bvh,
    pub(crate) positions: Vec<Vec3>,
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Vertex normals, one a position or none at all.
    pub(crate) normals: Vec<Vec3>,
    /// Texture coordinates, one a position or none at all; not finite where a mesh has none.
    pub(crate) uvs: Vec<Vec2>,
    /// The object of each triangle.
    pub(crate) triangle_objects: Vec<ObjectId>,
    pub(crate) analytic: Vec<Analytic>,
    pub(crate) analytic_objects: Vec<ObjectId>,
    /// Opaque surfaces that may touch transparent objects; `None` if there are none.
    contacts: Option<contact::Contacts>,
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
    pub infinite_lights: Vec<LightId>,
    /// Lights that are asked at every point; see [`Light::is_local`].
    pub local_lights: Vec<LightId>,
    /// The camera.
    pub camera: Camera,
    /// Wavelengths of camera paths.
    pub wavelengths: WavelengthDensity,
    /// Mechanisms that rendering the scene needs.
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
    /// Its light if it emits.
    pub light: Option<LightId>,
    /// Box around it.
    pub bounds: Aabb,
    /// Whether it is transparent and an opaque surface may touch it.
    pub touched: bool,
    /// Whether it may have a face in common with another transparent object; see [`Scene::interiors_at`].
    pub coincident: bool,
}

impl Scene {
    /// A sphere around everything.
    pub fn everything(&self) -> Aim {
        Aim { center: Vec3::ZERO, radius: self.radius }
    }

    /// Returns an object by its index.
    #[inline]
    pub fn object(&self, ObjectId(index): ObjectId) -> &Object {
        &self.objects[index as usize]
    }

    /// Returns a light by its index.
    #[inline]
    pub fn light(&self, LightId(index): LightId) -> &Light {
        &self.lights[index as usize]
    }

    /// Returns a spectrum by its index.
    #[inline]
    pub fn spectrum(&self, SpectrumId(index): SpectrumId) -> &SpectrumTable {
        &self.spectra[index as usize]
    }

    /// Returns a medium by its index.
    #[inline]
    pub fn medium(&self, MediumId(index): MediumId) -> &Medium {
        &self.media[index as usize]
    }
}
