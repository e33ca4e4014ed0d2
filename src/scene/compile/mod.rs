//! SceneDescription → [`Scene`]: names become indices, spectra become tables, shapes become primitives in one tree, and
//! all lengths and radiances are brought to about unit size by powers of two, so that no scale is special.

mod compiler;
mod geometry;
mod lights;
mod materials;
mod normalize;
mod place;
mod spectra;

use super::Integrator;
use super::contact::Contacts;
use super::description::{FilterKind, FovAxis, SceneDescription};
use super::{Camera, Scene, SceneFeatures};
use crate::color::Observer;
use crate::film::{Filter, Sensor};
use crate::geometry::Bvh;
use crate::math;
use crate::{Error, ErrorKind, Result};
use compiler::Compiler;
use geometry::Geometry;
use glam::DVec3;
use materials::Materials;
use normalize::Normalization;
pub use place::world_mesh;
use std::time::Instant;

/// What a scene file asks for, ready to render.
#[derive(Debug)]
pub struct Compiled {
    /// The scene.
    pub scene: Scene,
    /// Settings of the renderer.
    pub render: RenderSettings,
    /// Settings of the film.
    pub film: FilmSettings,
    /// Warnings, one line each.
    pub warnings: Vec<String>,
}

/// Settings of the renderer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RenderSettings {
    /// Camera paths per pixel, on average; the most of them where something else stops the render.
    pub samples_per_pixel: u64,
    /// relMSE below which the render stops.
    pub target_error: Option<f64>,
    /// Time at which the render stops.
    pub deadline: Option<Instant>,
    /// Whether pixels that have converged get fewer samples, and the others more.
    pub adaptive: bool,
    /// Largest number of scattering events on a path.
    pub max_depth: u32,
    /// Seed of all sequences.
    pub seed: u64,
    /// Light transport technique.
    pub integrator: Integrator,
}

/// Size of the picture, and the filter by which samples belong to pixels.
#[derive(Debug, Clone)]
pub struct FilmSettings {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Reconstruction filter.
    pub filter: Filter,
    /// What is recorded of radiance.
    pub sensor: Sensor,
}

/// Compiles a description. Reads the files it names.
///
/// # Errors
/// Whatever can be wrong with a scene beyond its syntax, with the scene's file and the JSON path of the place.
pub fn compile(description: &SceneDescription) -> Result<Compiled> {
    compile_parts(description).map_err(|error| error.in_file(&description.file))
}

fn compile_parts(description: &SceneDescription) -> Result<Compiled> {
    let integrator = description.render.integrator;
    let mut warnings = Vec::new();
    let placed = place::place(description, &mut warnings)?;
    let mut compiler = Compiler::new(description, Normalization::of(description, &placed), warnings);
    let materials = Materials::compile(&mut compiler)?;
    let mut geometry = Geometry::compile(&compiler, placed, &materials)?;
    let bvh = Bvh::build(&geometry.positions, &geometry.triangles, &geometry.analytic_bounds());
    let solids = geometry.solids();
    let observer = Observer::by_name(&description.film.observer).map_err(|error| error.at("film.observer"))?;
    let lights = lights::compile(&mut compiler, observer, &mut geometry, &solids)?;
    let Compiler { normalization, spectra, mut warnings, .. } = compiler;
    warnings.extend(spectra.take_warnings());
    if lights.lights.is_empty() {
        let missing =
            "nothing gives light, so the picture is black; expected `lights`, an `environment` or an `emission`";
        warnings.push(format!("{}: {missing}", description.file.display()));
    }
    let features = SceneFeatures {
        dispersion: materials.media.iter().any(|m| m.dispersive),
        interiors: !materials.media.is_empty(),
    };
    let mut scene = Scene {
        bvh,
        positions: geometry.positions,
        triangles: geometry.triangles,
        normals: geometry.normals,
        uvs: geometry.uvs,
        triangle_objects: geometry.triangle_objects,
        analytic: geometry.analytic,
        analytic_objects: geometry.analytic_objects,
        contacts: None,
        objects: geometry.objects,
        solids,
        spectra: spectra.into_tables(),
        media: materials.media,
        light_table: lights.sampled,
        caustic_table: lights.caustic,
        caustic_aim: lights.caustic_aim,
        emission_table: lights.emitting,
        infinite_lights: lights.infinite,
        local_lights: lights.local,
        lights: lights.lights,
        camera: camera(description, &normalization)?,
        wavelengths: lights.wavelengths,
        features,
        radius: normalization.radius,
        meters_per_unit: normalization.meters_per_unit,
        radiance_scale: lights.radiance_scale,
    };
    scene.mark_coincident();
    scene.contacts = Contacts::find(&mut scene);
    let film = &description.film;
    let filter = match film.filter {
        FilterKind::Box => Filter::boxed(film.filter_radius),
        FilterKind::Gaussian => Filter::gaussian(film.filter_radius),
        FilterKind::BlackmanHarris => Filter::blackman_harris(film.filter_radius),
    };
    Ok(Compiled {
        scene,
        render: RenderSettings {
            samples_per_pixel: description.render.samples_per_pixel,
            target_error: None,
            deadline: None,
            adaptive: false,
            max_depth: description.render.max_depth,
            seed: description.render.seed,
            integrator,
        },
        film: FilmSettings { width: film.width, height: film.height, filter, sensor: Sensor::of_observer(observer) },
        warnings,
    })
}

fn camera(description: &SceneDescription, normalization: &Normalization) -> Result<Camera> {
    let c = &description.camera;
    let (width, height) = (f64::from(description.film.width), f64::from(description.film.height));
    let forward = (DVec3::from(c.to) - DVec3::from(c.from)).normalize();
    let right = forward.cross(DVec3::from(c.up)).normalize();
    if !(forward.is_finite() && right.is_finite()) {
        let message = "the view direction or the direction up vanishes; expected from ≠ to, and up not along the view";
        return Err(Error::new(ErrorKind::Degenerate, message).at(c.at.clone()));
    }
    let half = math::tan(0.5 * c.fov_degrees.to_radians());
    let (half_x, half_y) = match c.fov_axis {
        FovAxis::X => (half, half * height / width),
        FovAxis::Y => (half * width / height, half),
    };
    Ok(Camera {
        position: normalization.point(DVec3::from(c.from)).as_vec3(),
        right: right.as_vec3(),
        up: right.cross(forward).as_vec3(),
        forward: forward.as_vec3(),
        half_extent: [half_x as f32, half_y as f32],
        size: [description.film.width, description.film.height],
        lens_radius: normalization.length(c.aperture_radius) as f32,
        focus_distance: normalization.length(c.focus_distance) as f32,
    })
}
