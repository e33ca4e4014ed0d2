//! Camera paths with next-event estimation.

use super::walk::{Crossing, Walk};
use super::{Techniques, bounce};
use crate::bsdf::{Bsdf, Indices};
use crate::geometry::Frame;
use crate::sampling::balance_heuristic;
use crate::scene::{Exit, Light, LightSample, Material, Scene, Surface};
use crate::spectrum::SampledSpectrum;
use glam::Vec3;

/// How the ray under way was chosen: what else could have found the light that it runs into.
#[derive(Debug, Clone, Copy)]
enum Origin {
    /// By the camera, or by delta scattering alone since.
    Delta {
        /// Density per unit area with which camera rays reach the first surface, if that was diffuse. Then light paths
        /// can end there too.
        first_diffuse: Option<f32>,
    },
    /// By scattering at `from` with this density in solid angle: next-event estimation could have found it as well.
    Scattered { from: Vec3, pdf: f32, first_diffuse: Option<f32> },
}

/// Radiance that arrives along a camera path, in the camera's medium.
pub fn radiance<const DISPERSION: bool, const INTERIORS: bool>(
    walk: &mut Walk,
    techniques: &Techniques,
    max_depth: u32,
) -> SampledSpectrum {
    let scene = walk.scene;
    let mut radiance = SampledSpectrum::ZERO;
    let mut origin = Origin::Delta { first_diffuse: None };
    let camera_indices = if INTERIORS { Some(medium_indices(walk)) } else { None };
    loop {
        let surface = walk.advance::<INTERIORS>();

        // Emission.
        match &surface {
            None => radiance += escaped::<INTERIORS>(walk, techniques, origin, &camera_indices),
            Some(surface) => radiance += emitted::<INTERIORS>(walk, techniques, surface, origin, &camera_indices),
        }
        let Some(surface) = surface else { break };
        if walk.depth >= max_depth {
            break;
        }

        // Transparent surfaces.
        let object = &scene.objects[surface.object as usize];
        let u = walk.random();
        if let Material::Dielectric { medium } = object.material {
            match walk.meet_dielectric::<DISPERSION>(&surface, medium, u[2]) {
                Crossing::Passed => continue,
                Crossing::Ended => break,
                Crossing::Scattered => origin = origin.after_delta(),
            }
        } else {
            // Opaque surfaces: light that arrives directly, then a new direction.
            let Some((bsdf, frame)) = walk.bsdf::<INTERIORS>(object, &surface) else { break };
            let wo = -walk.ray.direction;
            if !bsdf.is_specular() {
                if walk.depth == 0 {
                    origin = origin.at_first_diffuse(camera_density(scene, &surface, wo));
                }
                let receiver = Receiver { surface: &surface, bsdf: &bsdf, frame: &frame, wo };
                let direct = direct_light::<INTERIORS>(walk, receiver, u);
                radiance += direct * walk.throughput * radiance_ratio::<INTERIORS>(walk, &camera_indices);
            }
            let Some(sample) = bounce(walk, &surface, &bsdf, &frame, [u[0], u[1]]) else { break };
            origin = match sample.pdf {
                None => origin.after_delta(),
                Some(pdf) => origin.after_scattering(surface.point, pdf),
            };
        }
        if !walk.survives(u[3]) {
            break;
        }
    }
    radiance
}

impl Origin {
    fn first_diffuse(self) -> Option<f32> {
        match self {
            Self::Delta { first_diffuse } | Self::Scattered { first_diffuse, .. } => first_diffuse,
        }
    }

    fn at_first_diffuse(self, density: f32) -> Self {
        Self::Delta { first_diffuse: Some(density) }
    }

    fn after_delta(self) -> Self {
        Self::Delta { first_diffuse: self.first_diffuse() }
    }

    fn after_scattering(self, from: Vec3, pdf: f32) -> Self {
        Self::Scattered { from, pdf, first_diffuse: self.first_diffuse() }
    }
}

fn medium_indices(walk: &mut Walk) -> Indices {
    let medium = walk.workspace.interiors.medium(walk.scene);
    walk.workspace.spectra.indices(walk.scene, medium)
}

/// (n_camera / n_here)²: radiance is collected here and recorded there. What refraction changes on the way telescopes to
/// this, so that no path carries it.
fn radiance_ratio<const INTERIORS: bool>(walk: &mut Walk, camera: &Option<Indices>) -> SampledSpectrum {
    let (true, Some(camera)) = (INTERIORS, camera) else { return SampledSpectrum::ONE };
    let here = medium_indices(walk);
    if here == *camera {
        return SampledSpectrum::ONE;
    }
    SampledSpectrum::from_fn(|k| {
        let ratio = camera.eta[k] / here.eta[k];
        (ratio * ratio) as f32
    })
}

/// Density per unit area with which the camera's rays, all pixels taken together, reach a surface seen directly.
pub fn camera_density(scene: &Scene, surface: &Surface, wo: Vec3) -> f32 {
    let cos = surface.geometric.as_vec3().dot(wo).abs();
    let seen = scene.camera.connect(surface.point, [0.5; 2], f32::INFINITY);
    seen.map_or(0.0, |seen| seen.importance * cos / scene.camera.pixels() as f32)
}

/// Light met by a ray that leaves the scene.
fn escaped<const INTERIORS: bool>(
    walk: &mut Walk,
    techniques: &Techniques,
    origin: Origin,
    camera: &Option<Indices>,
) -> SampledSpectrum {
    let scene = walk.scene;
    let mut radiance = SampledSpectrum::ZERO;
    for &index in &scene.infinite_lights {
        let light = &scene.lights[index as usize];
        let Some((factor, pdf)) = light.escaped(walk.ray.direction) else { continue };
        let exit = Exit { point: walk.ray.origin, cos: 1.0 };
        let weight = hit_weight(scene, techniques, index, origin, &exit, |_| pdf);
        radiance += walk.workspace.spectra.spectrum(scene, light.spectrum) * (factor * weight);
    }
    if radiance.is_zero() {
        return radiance;
    }
    radiance * walk.throughput * radiance_ratio::<INTERIORS>(walk, camera)
}

/// Light emitted by a surface that a ray has met.
fn emitted<const INTERIORS: bool>(
    walk: &mut Walk,
    techniques: &Techniques,
    surface: &Surface,
    origin: Origin,
    camera: &Option<Indices>,
) -> SampledSpectrum {
    let scene = walk.scene;
    let Some(index) = scene.objects[surface.object as usize].light else { return SampledSpectrum::ZERO };
    let light = &scene.lights[index as usize];
    if !light.emits(surface, walk.ray.direction) {
        return SampledSpectrum::ZERO;
    }
    let direction = walk.ray.direction;
    let exit = Exit { point: surface.point, cos: surface.geometric.as_vec3().dot(direction).abs() };
    let weight =
        hit_weight(scene, techniques, index, origin, &exit, |from| light.pdf_surface(from, direction, surface));
    let emission = walk.workspace.spectra.spectrum(scene, light.spectrum);
    emission * walk.throughput * weight * radiance_ratio::<INTERIORS>(walk, camera)
}

/// Weight of a light found by running into it, against the other techniques that could have found the same path.
fn hit_weight(
    scene: &Scene,
    techniques: &Techniques,
    index: u32,
    origin: Origin,
    exit: &Exit,
    light_pdf: impl Fn(Vec3) -> f32,
) -> f32 {
    match origin {
        Origin::Scattered { from, pdf, .. } => {
            balance_heuristic(pdf, scene.light_table.probability(index as usize) * light_pdf(from))
        }
        Origin::Delta { first_diffuse: Some(camera) } => {
            techniques.light_path_density(scene, index, exit).map_or(1.0, |light| balance_heuristic(camera, light))
        }
        Origin::Delta { first_diffuse: None } => 1.0,
    }
}

/// A diffuse surface that asks for light.
#[derive(Clone, Copy)]
struct Receiver<'a> {
    surface: &'a Surface,
    bsdf: &'a Bsdf,
    frame: &'a Frame,
    wo: Vec3,
}

/// Next-event estimation: light that arrives at a surface directly from one light drawn by its power, and from each local
/// one.
fn direct_light<const INTERIORS: bool>(walk: &mut Walk, receiver: Receiver, u: [f32; 8]) -> SampledSpectrum {
    let scene = walk.scene;
    let mut radiance = SampledSpectrum::ZERO;
    if let Some(draw) = scene.light_table.sample(u[4]) {
        radiance += light_from::<INTERIORS>(walk, receiver, &scene.lights[draw.index], draw.probability, [u[5], u[6]]);
    }
    for &light in &scene.local_lights {
        radiance += light_from::<INTERIORS>(walk, receiver, &scene.lights[light as usize], 1.0, [u[5], u[6]]);
    }
    radiance
}

/// Radiance towards `wo` that one light causes, by a sample of it.
fn light_from<const INTERIORS: bool>(
    walk: &mut Walk,
    receiver: Receiver,
    light: &Light,
    probability: f32,
    u: [f32; 2],
) -> SampledSpectrum {
    let Receiver { surface, bsdf, frame, wo } = receiver;
    let Some(LightSample { target, wi, weight, pdf }) = light.sample(walk.scene, surface.point, u) else {
        return SampledSpectrum::ZERO;
    };
    let reflected = bsdf.eval(frame, wo, wi);
    if reflected.is_zero() {
        return SampledSpectrum::ZERO;
    }
    let Some(transmittance) = walk.visibility::<INTERIORS>(surface, wi, target) else { return SampledSpectrum::ZERO };
    let mis = pdf.map_or(1.0, |pdf| balance_heuristic(probability * pdf, bsdf.pdf(frame, wo, wi)));
    let emission = walk.workspace.spectra.spectrum(walk.scene, light.spectrum);
    reflected * emission * transmittance * (weight * mis / probability)
}
