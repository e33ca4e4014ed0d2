//! Camera paths with next-event estimation.

use super::table::{Seen, Techniques};
use crate::bsdf::{Bsdf, Density, Lanes, Parting};
use crate::geometry::Frame;
use crate::render::paths::{Encounter, Layout, Scattering, Vertex, Walk};
use crate::sampling::balance_heuristic;
use crate::scene::{Exit, Light, LightId, LightSample, MediumId, Scene, Surface};
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

/// What is known of a path at the start of a ray.
#[derive(Debug, Clone, Copy)]
struct Past {
    origin: Origin,
    /// The first surface that is not specular.
    seen: Seen,
}

impl Past {
    /// A path that has met nothing but specular surfaces.
    const SPECULAR: Self = Self { origin: Origin::Delta, seen: Seen::Nothing };
}

/// What stays the same along a path.
struct Context<'a> {
    techniques: &'a Techniques,
    max_depth: u32,
    /// The medium that holds the camera; `None` is air.
    camera_medium: Option<MediumId>,
}

/// Returns the radiance that arrives along a camera path, in the camera's medium.
pub fn radiance<const INTERIORS: bool>(walk: &mut Walk, techniques: &Techniques, max_depth: u32) -> SampledSpectrum {
    let camera_medium = if INTERIORS { walk.medium() } else { None };
    let context = Context { techniques, max_depth, camera_medium };
    let mut radiance = follow::<INTERIORS>(walk, &context, Past::SPECULAR, None);
    while walk.resume() {
        let numbers = walk.last_numbers(Layout::AskLights).next_connection;
        radiance += follow::<INTERIORS>(walk, &context, Past::SPECULAR, Some(numbers));
    }
    radiance
}

/// Returns the radiance that arrives along the rest of a path. `connection` draws the point on a light that the next vertex
/// asks, where the vertex before it has numbers for that.
fn follow<const INTERIORS: bool>(
    walk: &mut Walk,
    context: &Context,
    mut past: Past,
    mut connection: Option<[f32; 2]>,
) -> SampledSpectrum {
    let mut radiance = SampledSpectrum::ZERO;
    loop {
        // Light that the ray runs into.
        let Some(surface) = walk.advance::<INTERIORS>() else {
            return radiance + escaped::<INTERIORS>(walk, context, past);
        };
        radiance += emitted::<INTERIORS>(walk, context, &surface, past);
        if walk.depth >= context.max_depth {
            return radiance;
        }

        // The next vertex.
        let lanes = walk.carried.lanes;
        let encounter = walk.encounter::<INTERIORS>(&surface);
        let vertex = match &encounter {
            Encounter::Vertex(vertex) => vertex,
            Encounter::Passed => continue,
            Encounter::Absorbed => return radiance,
        };
        let numbers = walk.numbers(Layout::AskLights);
        keep_with_lanes(walk, lanes, &mut radiance);

        // Light that arrives there directly.
        let before = past.seen;
        if !vertex.bsdf.is_specular() {
            past.seen = seen_with(before, walk, vertex);
            let numbers = connection.unwrap_or(numbers.connection);
            radiance += direct_light::<INTERIORS>(walk, context, before, vertex, numbers);
            if !vertex.bsdf.is_rough() && !walk.carried.end_bundle() {
                return radiance;
            }
        }

        // The next ray.
        let depth = walk.depth;
        let glossy = vertex.is_glossy() && !matches!(before, Seen::Nothing);
        let onward = |walk: &Walk, pdf: Option<f32>| {
            let Some(pdf) = pdf else { return Past { origin: Origin::Delta, ..past } };
            // The first rough surface seen is known by how likely the path leaves it as it does.
            let first = vertex.bsdf.is_rough() && matches!(before, Seen::Nothing);
            let seen = if first { seen_rough(walk, context.techniques, vertex, depth) } else { past.seen };
            Past { origin: Origin::Scattered { from: surface.point, pdf, glossy }, seen }
        };
        let next_connection = Some(numbers.next_connection);
        match walk.scatter(vertex, &numbers) {
            Scattering::Ended => return radiance,
            Scattering::Along(pdf) => past = onward(walk, pdf),
            Scattering::Parted => {
                walk.each_way(|walk| {
                    let past = onward(walk, walk.density_of_way());
                    radiance += follow::<INTERIORS>(walk, context, past, next_connection);
                });
                return radiance;
            }
        }
        if !walk.survives(numbers.roulette) {
            return radiance;
        }
        connection = next_connection;
    }
}

/// Where the baseline has left all lanes but one, it keeps one of all that it has gathered before, too.
fn keep_with_lanes(walk: &Walk, lanes: Lanes, radiance: &mut SampledSpectrum) {
    if walk.carried.parting == Parting::Terminate && walk.carried.lanes != lanes {
        *radiance = radiance.only(walk.carried.hero) * walk.carried.lanes_at_start();
    }
}

/// What the camera has seen, with a vertex that is not specular.
fn seen_with(before: Seen, walk: &Walk, vertex: &Vertex) -> Seen {
    match before {
        Seen::Nothing if vertex.bsdf.is_rough() => Seen::Nothing,
        Seen::Nothing if walk.depth == 0 => Seen::Directly(camera_density(walk.scene, vertex.surface, vertex.wo)),
        Seen::Nothing => Seen::ThroughSpecular,
        Seen::RoughDirectly { density, .. } if !vertex.bsdf.is_rough() => {
            Seen::RoughDirectly { density, then_matte: true }
        }
        _ => before,
    }
}

/// What is known of a rough surface, the first that is not specular, once the path has left it: met at `depth`.
#[inline(never)]
fn seen_rough(walk: &Walk, techniques: &Techniques, vertex: &Vertex, depth: u32) -> Seen {
    if depth > 0 {
        return Seen::RoughThroughSpecular;
    }
    let &Vertex { surface, ref bsdf, ref frame, wo, .. } = vertex;
    let density = match techniques.guide() {
        None => SampledSpectrum::ZERO,
        Some(_) => rough_camera_density(walk.scene, surface, bsdf, frame, wo, walk.ray.direction),
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
    wo: Vec3,
    wi: Vec3,
) -> SampledSpectrum {
    let cos = frame.geometric.as_vec3().dot(wi).abs();
    bsdf.own_pdf(frame, wo, wi) * (camera_density(scene, surface, wo) / cos)
}

/// (n_camera / n_here)²: radiance is collected here and recorded there. What refraction changes on the way telescopes to
/// this, so that no path carries it.
#[inline]
pub fn radiance_ratio<const INTERIORS: bool>(walk: &mut Walk, camera: Option<MediumId>) -> SampledSpectrum {
    let here = if INTERIORS { walk.medium() } else { camera };
    if here == camera {
        return SampledSpectrum::ONE;
    }
    let [camera, here] = walk.workspace.spectra.both_indices(walk.scene, [camera, here]);
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
fn escaped<const INTERIORS: bool>(walk: &mut Walk, context: &Context, past: Past) -> SampledSpectrum {
    let scene = walk.scene;
    let mut radiance = SampledSpectrum::ZERO;
    for &index in &scene.infinite_lights {
        let light = scene.light(index);
        let Some((factor, pdf)) = light.escaped(walk.ray.direction) else { continue };
        let exit = Exit { point: walk.ray.origin, direction: -walk.ray.direction, cos: 1.0 };
        let weight = hit_weight(scene, context.techniques, index, past, &exit, |_| pdf);
        radiance += walk.workspace.spectra.spectrum(scene, light.spectrum) * (weight * factor);
    }
    if radiance.is_zero() {
        return radiance;
    }
    radiance * walk.carried.throughput * radiance_ratio::<INTERIORS>(walk, context.camera_medium)
}

/// Light emitted by a surface that a ray has met.
fn emitted<const INTERIORS: bool>(
    walk: &mut Walk,
    context: &Context,
    surface: &Surface,
    past: Past,
) -> SampledSpectrum {
    let scene = walk.scene;
    let Some(index) = scene.object(surface.object).light else { return SampledSpectrum::ZERO };
    let light = scene.light(index);
    if !light.emits(surface, walk.ray.direction) {
        return SampledSpectrum::ZERO;
    }
    let direction = walk.ray.direction;
    let cos = surface.geometric.as_vec3().dot(direction).abs();
    let exit = Exit { point: surface.point, direction: -direction, cos };
    let pdf = |from| light.pdf_surface(from, direction, surface);
    let weight = hit_weight(scene, context.techniques, index, past, &exit, pdf);
    let emission = walk.workspace.spectra.spectrum(scene, light.spectrum);
    emission * walk.carried.throughput * weight * radiance_ratio::<INTERIORS>(walk, context.camera_medium)
}

/// Weight of a light found by running into it, against the other techniques that could have found the same path.
fn hit_weight(
    scene: &Scene,
    techniques: &Techniques,
    light: LightId,
    Past { origin, seen }: Past,
    exit: &Exit,
    light_pdf: impl Fn(Vec3) -> f32,
) -> SampledSpectrum {
    match origin {
        Origin::Scattered { glossy: true, .. } if !techniques.camera_owns_glossy_caustic(light, seen) => {
            SampledSpectrum::ZERO
        }
        Origin::Scattered { from, pdf, .. } => SampledSpectrum::splat(balance_heuristic(
            pdf,
            scene.light_table.probability(light.0 as usize) * light_pdf(from),
        )),
        Origin::Delta => techniques.camera_weight_of_caustic(scene, light, seen, exit),
    }
}

/// Next-event estimation: light that arrives at a vertex directly from one light drawn by its power, and from each local
/// one. `seen` is what the camera has seen before this vertex.
fn direct_light<const INTERIORS: bool>(
    walk: &mut Walk,
    context: &Context,
    seen: Seen,
    vertex: &Vertex,
    u: [f32; 2],
) -> SampledSpectrum {
    let (scene, techniques) = (walk.scene, context.techniques);
    let mut radiance = SampledSpectrum::ZERO;
    let glossy = vertex.is_glossy() && !matches!(seen, Seen::Nothing);
    if let Some(draw) = scene.light_table.sample(u[0])
        && (!glossy || techniques.camera_owns_glossy_caustic(LightId(draw.index as u32), seen))
    {
        let light = &scene.lights[draw.index];
        radiance += light_from::<INTERIORS>(walk, vertex, light, draw.probability, [draw.rest, u[1]]);
    }
    for &light in &scene.local_lights {
        if techniques.camera_owns_local_light(light, seen) {
            radiance += light_from::<INTERIORS>(walk, vertex, scene.light(light), 1.0, u);
        }
    }
    radiance * walk.carried.throughput * radiance_ratio::<INTERIORS>(walk, context.camera_medium)
}

/// Radiance towards the path that one light causes, by a sample of it, on the side of the vertex where the path comes from.
fn light_from<const INTERIORS: bool>(
    walk: &mut Walk,
    vertex: &Vertex,
    light: &Light,
    probability: f32,
    u: [f32; 2],
) -> SampledSpectrum {
    let &Vertex { surface, ref bsdf, ref frame, wo, .. } = vertex;
    let Some(LightSample { target, wi, weight, pdf }) = light.sample(walk.scene, surface.point, u) else {
        return SampledSpectrum::ZERO;
    };
    let Some(scattered) = bsdf.evaluate(frame, wo, wi) else { return SampledSpectrum::ZERO };
    let Some(transmittance) = walk.visibility::<INTERIORS>(surface, wi, target, scattered.crosses) else {
        return SampledSpectrum::ZERO;
    };
    let mut value = scattered.value;
    if scattered.crosses {
        value *= bsdf.radiance_change(true);
    }
    let emission = walk.workspace.spectra.spectrum(walk.scene, light.spectrum);
    let arriving = value * emission * transmittance;
    match scattered.pdf {
        Density::PerLane(other) => {
            let other = other.lanes();
            let balanced = |pdf| SampledSpectrum::from_fn(|lane| balance_heuristic(probability * pdf, other[lane]));
            arriving * pdf.map_or(SampledSpectrum::ONE, balanced) * (weight / probability)
        }
        Density::Shared(other) => {
            let mis = pdf.map_or(1.0, |pdf| balance_heuristic(probability * pdf, other));
            arriving * (weight * mis / probability)
        }
        Density::Delta => SampledSpectrum::ZERO,
    }
}
