//! Camera paths with next-event estimation.

use super::scatter::{Bounce, Met};
use super::techniques::{Seen, Techniques};
use super::walk::{Crossing, Parting, Walk};
use crate::bsdf::{Bsdf, Indices, Lanes, RoughDielectric};
use crate::geometry::Frame;
use crate::sampling::balance_heuristic;
use crate::scene::{DielectricMaterial, Exit, Light, LightSample, Material, Scene, Surface};
use crate::spectrum::SampledSpectrum;
use glam::Vec3;

/// How the ray under way was chosen: what else could have found the light that it runs into.
#[derive(Debug, Clone, Copy)]
enum Origin {
    /// By the camera, or by delta scattering alone since the last diffuse surface.
    Delta,
    /// By scattering at `from` with this density in solid angle: next-event estimation could have found it as well.
    /// `glossy` is whether light from there makes a glossy caustic on what the camera has seen before.
    Scattered { from: Vec3, pdf: f32, glossy: bool },
}

/// Radiance that arrives along a camera path, in the camera's medium.
pub fn radiance<const DISPERSION: bool, const INTERIORS: bool>(
    walk: &mut Walk,
    techniques: &Techniques,
    max_depth: u32,
) -> SampledSpectrum {
    let camera_indices = if INTERIORS { Some(medium_indices(walk)) } else { None };
    let context = Context { techniques, max_depth, camera_indices };
    let mut radiance = follow::<DISPERSION, INTERIORS>(walk, &context, Origin::Delta, Seen::Nothing, None);
    while walk.resume() {
        let [_, _, a, b, ..] = walk.last_random();
        radiance += follow::<DISPERSION, INTERIORS>(walk, &context, Origin::Delta, Seen::Nothing, Some([a, b]));
    }
    radiance
}

/// What stays the same along a path.
struct Context<'a> {
    techniques: &'a Techniques,
    max_depth: u32,
    /// Of the medium that holds the camera.
    camera_indices: Option<Indices>,
}

/// Radiance that arrives along the rest of a path.
///
/// The eight numbers of a vertex: 0 and 1 draw the direction that leaves it, 2 and 3 (`towards_light`) the point on a light
/// that the next vertex asks, so that the two, whose effects multiply, are well spread jointly; 4 and 5 are for the point on
/// a light that the first vertex asks, 6 for roulette, 7 for the choice of reflection or refraction.
fn follow<const DISPERSION: bool, const INTERIORS: bool>(
    walk: &mut Walk,
    context: &Context,
    mut origin: Origin,
    mut seen: Seen,
    mut towards_light: Option<[f32; 2]>,
) -> SampledSpectrum {
    let scene = walk.scene;
    let mut radiance = SampledSpectrum::ZERO;
    loop {
        let surface = walk.advance::<INTERIORS>();

        // Emission.
        match &surface {
            None => radiance += escaped::<INTERIORS>(walk, context, origin, seen),
            Some(surface) => radiance += emitted::<INTERIORS>(walk, context, surface, origin, seen),
        }
        let Some(surface) = surface else { break };
        if walk.depth >= context.max_depth {
            break;
        }

        // Smooth transparent surfaces.
        let object = &scene.objects[surface.object as usize];
        let u = walk.random();
        let lanes = walk.lanes;
        if let Material::Dielectric(DielectricMaterial { medium, alpha: 0.0 }) = object.material {
            let crossing = walk.meet_dielectric::<DISPERSION>(&surface, medium, u[7]);
            keep_with_lanes(walk, lanes, &mut radiance);
            match crossing {
                Crossing::Passed => continue,
                Crossing::Ended => break,
                Crossing::Scattered => origin = Origin::Delta,
                Crossing::Parted(ways) => {
                    for way in 0..ways {
                        if walk.set_out(way) {
                            let numbers = Some([u[2], u[3]]);
                            radiance += follow::<DISPERSION, INTERIORS>(walk, context, Origin::Delta, seen, numbers);
                        }
                    }
                    break;
                }
            }
        } else {
            // Other surfaces: light that arrives directly, then a new direction.
            let (bsdf, frame) = match walk.meet::<INTERIORS>(object, &surface) {
                Met::Scatterer(bsdf, frame) => (bsdf, frame),
                Met::Nothing => continue,
                Met::Black => break,
            };
            keep_with_lanes(walk, lanes, &mut radiance);
            let wo = -walk.ray.direction;
            let (before, depth) = (seen, walk.depth);
            let glossy = bsdf.is_rough() && object.material.focuses() && !matches!(before, Seen::Nothing);
            if !bsdf.is_specular() {
                seen = match seen {
                    Seen::Nothing if bsdf.is_rough() => Seen::Nothing,
                    Seen::Nothing if depth == 0 => Seen::Directly(camera_density(scene, &surface, wo)),
                    Seen::Nothing => Seen::ThroughSpecular,
                    Seen::RoughDirectly { density, .. } if !bsdf.is_rough() => {
                        Seen::RoughDirectly { density, then_matte: true }
                    }
                    _ => seen,
                };
                let receiver = Receiver { surface: &surface, bsdf: &bsdf, frame: &frame, wo, glossy };
                let numbers = towards_light.unwrap_or([u[4], u[5]]);
                let direct = direct_light::<INTERIORS>(walk, context.techniques, before, receiver, numbers);
                radiance += direct * walk.throughput * radiance_ratio::<INTERIORS>(walk, &context.camera_indices);
                if !bsdf.is_rough() && !walk.diffused() {
                    break;
                }
            }
            // The first surface seen that is rough is known by how likely the path leaves it as it does.
            let first =
                (bsdf.is_rough() && matches!(before, Seen::Nothing)).then_some((&surface, &bsdf, &frame, wo, depth));
            match walk.bounce(&surface, &bsdf, &frame, [u[0], u[1], u[7]]) {
                Bounce::Ended => break,
                Bounce::Along(None) => origin = Origin::Delta,
                Bounce::Along(Some(pdf)) => {
                    seen = first.map_or(seen, |first| seen_rough(walk, context.techniques, first));
                    origin = Origin::Scattered { from: surface.point, pdf, glossy };
                }
                Bounce::Parted(ways) => {
                    for way in 0..ways {
                        if walk.set_out(way) {
                            let seen = first.map_or(seen, |first| seen_rough(walk, context.techniques, first));
                            let pdf = walk.density_of_way().unwrap_or(0.0);
                            let origin = Origin::Scattered { from: surface.point, pdf, glossy };
                            let numbers = Some([u[2], u[3]]);
                            radiance += follow::<DISPERSION, INTERIORS>(walk, context, origin, seen, numbers);
                        }
                    }
                    break;
                }
            }
        }
        if !walk.survives(u[6]) {
            break;
        }
        towards_light = Some([u[2], u[3]]);
    }
    radiance
}

/// Where the baseline has left all lanes but one, it keeps one of all that it has gathered before, too.
fn keep_with_lanes(walk: &Walk, lanes: Lanes, radiance: &mut SampledSpectrum) {
    if walk.parting == Parting::Terminate && walk.lanes != lanes {
        *radiance = radiance.only(walk.hero) * walk.lanes_at_start();
    }
}

/// What is known of a rough surface, the first that is not specular, once the path has left it: met at `depth` and seen
/// from `wo`.
#[inline(never)]
fn seen_rough(
    walk: &Walk,
    techniques: &Techniques,
    (surface, bsdf, frame, wo, depth): (&Surface, &Bsdf, &Frame, Vec3, u32),
) -> Seen {
    if depth > 0 {
        return Seen::RoughThroughSpecular;
    }
    let density = match techniques.guide() {
        None => SampledSpectrum::ZERO,
        Some(_) => rough_camera_density(walk.scene, surface, bsdf, frame, (wo, walk.ray.direction)),
    };
    Seen::RoughDirectly { density, then_matte: false }
}

/// Density per unit of area and projected solid angle with which each lane's camera paths, all pixels taken together, see
/// a rough surface from `wo` and leave it along `wi`.
pub fn rough_camera_density(
    scene: &Scene,
    surface: &Surface,
    bsdf: &Bsdf,
    frame: &Frame,
    (wo, wi): (Vec3, Vec3),
) -> SampledSpectrum {
    let cos = frame.geometric.as_vec3().dot(wi).abs();
    bsdf.own_pdf(frame, wo, wi) * (camera_density(scene, surface, wo) / cos)
}

/// Indices of what the path is in.
pub fn medium_indices(walk: &mut Walk) -> Indices {
    let medium = walk.workspace.interiors.medium(walk.scene);
    walk.workspace.spectra.indices(walk.scene, medium)
}

/// (n_camera / n_here)²: radiance is collected here and recorded there. What refraction changes on the way telescopes to
/// this, so that no path carries it.
pub fn radiance_ratio<const INTERIORS: bool>(walk: &mut Walk, camera: &Option<Indices>) -> SampledSpectrum {
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
fn escaped<const INTERIORS: bool>(walk: &mut Walk, context: &Context, origin: Origin, seen: Seen) -> SampledSpectrum {
    let scene = walk.scene;
    let mut radiance = SampledSpectrum::ZERO;
    for &index in &scene.infinite_lights {
        let light = &scene.lights[index as usize];
        let Some((factor, pdf)) = light.escaped(walk.ray.direction) else { continue };
        let exit = Exit { point: walk.ray.origin, direction: -walk.ray.direction, cos: 1.0 };
        let weight = hit_weight(scene, context.techniques, index, (origin, seen), &exit, |_| pdf);
        radiance += walk.workspace.spectra.spectrum(scene, light.spectrum) * (weight * factor);
    }
    if radiance.is_zero() {
        return radiance;
    }
    radiance * walk.throughput * radiance_ratio::<INTERIORS>(walk, &context.camera_indices)
}

/// Light emitted by a surface that a ray has met.
fn emitted<const INTERIORS: bool>(
    walk: &mut Walk,
    context: &Context,
    surface: &Surface,
    origin: Origin,
    seen: Seen,
) -> SampledSpectrum {
    let scene = walk.scene;
    let Some(index) = scene.objects[surface.object as usize].light else { return SampledSpectrum::ZERO };
    let light = &scene.lights[index as usize];
    if !light.emits(surface, walk.ray.direction) {
        return SampledSpectrum::ZERO;
    }
    let direction = walk.ray.direction;
    let cos = surface.geometric.as_vec3().dot(direction).abs();
    let exit = Exit { point: surface.point, direction: -direction, cos };
    let pdf = |from| light.pdf_surface(from, direction, surface);
    let weight = hit_weight(scene, context.techniques, index, (origin, seen), &exit, pdf);
    let emission = walk.workspace.spectra.spectrum(scene, light.spectrum);
    emission * walk.throughput * weight * radiance_ratio::<INTERIORS>(walk, &context.camera_indices)
}

/// Weight of a light found by running into it, against the other techniques that could have found the same path.
fn hit_weight(
    scene: &Scene,
    techniques: &Techniques,
    light: u32,
    (origin, seen): (Origin, Seen),
    exit: &Exit,
    light_pdf: impl Fn(Vec3) -> f32,
) -> SampledSpectrum {
    match origin {
        Origin::Scattered { glossy: true, .. } if !techniques.camera_owns_glossy_caustic(light, seen) => {
            SampledSpectrum::ZERO
        }
        Origin::Scattered { from, pdf, .. } => SampledSpectrum::splat(balance_heuristic(
            pdf,
            scene.light_table.probability(light as usize) * light_pdf(from),
        )),
        Origin::Delta => techniques.camera_weight_of_caustic(scene, light, seen, exit),
    }
}

/// A surface that asks for light.
#[derive(Clone, Copy)]
struct Receiver<'a> {
    surface: &'a Surface,
    bsdf: &'a Bsdf,
    frame: &'a Frame,
    wo: Vec3,
    /// Whether light from here makes a glossy caustic on what has been seen before.
    glossy: bool,
}

/// Next-event estimation: light that arrives at a surface directly from one light drawn by its power, and from each local
/// one. `seen` is what the camera has seen before this surface.
fn direct_light<const INTERIORS: bool>(
    walk: &mut Walk,
    techniques: &Techniques,
    seen: Seen,
    receiver: Receiver,
    u: [f32; 2],
) -> SampledSpectrum {
    let scene = walk.scene;
    let mut radiance = SampledSpectrum::ZERO;
    if let Some(draw) = scene.light_table.sample(u[0])
        && (!receiver.glossy || techniques.camera_owns_glossy_caustic(draw.index as u32, seen))
    {
        let light = &scene.lights[draw.index];
        radiance += light_from::<INTERIORS>(walk, receiver, light, draw.probability, [draw.rest, u[1]]);
    }
    for &light in &scene.local_lights {
        if techniques.camera_owns_local_light(light, seen) {
            radiance += light_from::<INTERIORS>(walk, receiver, &scene.lights[light as usize], 1.0, u);
        }
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
    let Receiver { surface, bsdf, frame, wo, .. } = receiver;
    let Some(sample) = light.sample(walk.scene, surface.point, u) else { return SampledSpectrum::ZERO };
    if let Bsdf::RoughDielectric(boundary) = bsdf {
        return light_at_boundary::<INTERIORS>(walk, receiver, boundary, light, probability, sample);
    }
    let LightSample { target, wi, weight, pdf } = sample;
    let reflected = bsdf.eval(frame, wo, wi);
    if reflected.is_zero() {
        return SampledSpectrum::ZERO;
    }
    let Some(transmittance) = walk.visibility::<INTERIORS>(surface, wi, target, false) else {
        return SampledSpectrum::ZERO;
    };
    let mis = pdf.map_or(1.0, |pdf| balance_heuristic(probability * pdf, bsdf.pdf(frame, wo, wi)));
    let emission = walk.workspace.spectra.spectrum(walk.scene, light.spectrum);
    reflected * emission * transmittance * (weight * mis / probability)
}

/// The same at a rough boundary, from either side of it, as radiance on the side of `wo`.
#[inline(never)]
fn light_at_boundary<const INTERIORS: bool>(
    walk: &mut Walk,
    Receiver { surface, frame, wo, .. }: Receiver,
    boundary: &RoughDielectric,
    light: &Light,
    probability: f32,
    LightSample { target, wi, weight, pdf }: LightSample,
) -> SampledSpectrum {
    let Some(lobe) = boundary.lobe(frame, wo, wi) else { return SampledSpectrum::ZERO };
    let Some(transmittance) = walk.visibility::<INTERIORS>(surface, wi, target, lobe.crosses) else {
        return SampledSpectrum::ZERO;
    };
    let scattered = lobe.value * boundary.radiance_change(lobe.crosses);
    let mis = pdf.map_or(SampledSpectrum::ONE, |pdf| {
        let other = boundary.balance_pdf(&lobe).lanes();
        SampledSpectrum::from_fn(|lane| balance_heuristic(probability * pdf, other[lane]))
    });
    let emission = walk.workspace.spectra.spectrum(walk.scene, light.spectrum);
    scattered * emission * transmittance * mis * (weight / probability)
}
