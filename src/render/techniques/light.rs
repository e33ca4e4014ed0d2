//! Light paths, splatted where the camera sees them.

use super::camera::{camera_density, rough_camera_density};
use super::guide::Guide;
use super::start_numbers::LightNumbers;
use super::table::{LightPathDensity, Techniques};
use crate::bsdf::{Branching, Carried};
use crate::film::{Filter, Sensor, Splats};
use crate::geometry::Ray;
use crate::render::paths::{Encounter, Layout, Place, Scattering, TransportMode, Vertex, Walk, Workspace, adjoint};
use crate::sampling::{Draw, balance_heuristic};
use crate::scene::{Emission, GuidedPair, LightId, Scene, Surface};
use crate::spectrum::{SampledSpectrum, Wavelengths};
use glam::Vec3;

/// How light paths are traced.
#[derive(Debug)]
pub struct LightTracer<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Where light paths start.
    pub guide: &'a Guide,
    /// Whether they are aimed at what can focus light and followed for what they own, see [`super::table`], or cover
    /// everything.
    pub caustics_only: bool,
    /// Where paths branch.
    pub branching: Branching,
    /// Largest number of scattering events.
    pub max_depth: u32,
}

/// How a light path started.
#[derive(Debug)]
pub struct Start {
    /// Its light.
    pub light: LightId,
    /// Where and how it left the light.
    pub emission: Emission,
    /// The guided pair of random numbers, after the guide has moved it.
    pub numbers: [f32; 2],
    /// The light's spectrum over the probability of drawing this light.
    pub spectrum: SampledSpectrum,
    /// Power that it carries in each lane, before any scattering.
    pub power: SampledSpectrum,
    /// The wavelengths of its lanes.
    pub wavelengths: Wavelengths,
}

/// What a light path met first on its way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum First {
    /// Nothing yet.
    Nothing,
    /// Something specular.
    Specular,
    /// A rough surface that focuses.
    Glossy {
        /// Whether a matte surface has followed.
        then_matte: bool,
    },
    /// Another surface.
    Diffuse,
}

/// A light path at a surface that is not specular.
#[derive(Debug, Clone, Copy)]
pub struct Arrival<'a> {
    /// What the path met first, before this surface.
    pub first: First,
    /// The vertex at this surface.
    pub vertex: &'a Vertex<'a>,
    /// Two random numbers that nothing else uses.
    pub u: [f32; 2],
}

/// What becomes of light paths.
pub trait Collector {
    /// A path leaves its light.
    fn leave<const INTERIORS: bool>(&mut self, walk: &mut Walk, start: &Start);
    /// A path is at a surface that is not specular, in a way that light paths own.
    fn arrive<const INTERIORS: bool>(&mut self, walk: &mut Walk, start: &Start, arrival: Arrival);
}

impl LightTracer<'_> {
    /// Traces path `index` of a sequence, at given wavelengths or at those that its light prefers.
    pub fn trace<const INTERIORS: bool>(
        &self,
        workspace: &mut Workspace,
        place: Place,
        wavelengths: Option<Wavelengths>,
        collector: &mut impl Collector,
    ) {
        // The light and the wavelengths.
        let scene = self.scene;
        let numbers = LightNumbers::of(place);
        let Some(Draw { index, probability, .. }) = self.guide.sample_light(numbers.light) else { return };
        let id = LightId(index as u32);
        let light = scene.light(id);
        let wavelengths = wavelengths.unwrap_or_else(|| light.wavelengths.sample(numbers.wavelengths));

        // The point and the direction in which the path leaves the light.
        let aim = if self.caustics_only { scene.caustic_aim } else { None }.unwrap_or(scene.everything());
        let LightNumbers { mut point, mut direction, .. } = numbers;
        let pair = light.guided_pair();
        let density = self.guide.warp(id, pair, &mut point, &mut direction);
        let Some(mut emission) = light.emit(scene, &aim, point, direction) else { return };
        emission.weight /= density;

        // What the path carries from there.
        workspace.spectra.begin(wavelengths);
        let origin = emission.start.origin(emission.direction);
        let inside = match INTERIORS && light.may_be_inside {
            true => scene.interiors_at(scene.clear_of_contacts(&emission.start, origin)),
            false => Vec::new(),
        };
        workspace.interiors.reset(&inside);
        let spectrum = workspace.spectra.spectrum(scene, light.spectrum) * (1.0 / probability);
        let start = Start {
            light: id,
            numbers: if pair == Some(GuidedPair::Point) { point } else { direction },
            spectrum,
            power: spectrum * emission.weight,
            wavelengths,
            emission,
        };
        let ray = Ray { origin, direction: emission.direction };
        let carried = Carried::new(numbers.hero, self.branching);
        let mut walk = Walk::start(scene, workspace, ray, TransportMode::Importance, carried, place);
        collector.leave::<INTERIORS>(&mut walk, &start);
        self.follow::<INTERIORS>(&mut walk, &start, First::Nothing, collector);
        while walk.resume() {
            self.follow::<INTERIORS>(&mut walk, &start, First::Specular, collector);
        }
    }

    /// Follows a path from surface to surface.
    fn follow<const INTERIORS: bool>(
        &self,
        walk: &mut Walk,
        start: &Start,
        mut first: First,
        collector: &mut impl Collector,
    ) {
        while walk.depth < self.max_depth {
            // The next vertex.
            let Some(surface) = walk.advance::<INTERIORS>() else { return };
            let encounter = walk.encounter::<INTERIORS>(&surface);
            let vertex = match &encounter {
                Encounter::Vertex(vertex) => vertex,
                Encounter::Passed => continue,
                Encounter::Absorbed => return,
            };
            let numbers = walk.numbers(Layout::Plain);

            // Light that arrives there.
            if !vertex.bsdf.is_specular() {
                let arrival = Arrival { first, vertex, u: numbers.connection };
                if self.owns(start, &arrival) {
                    collector.arrive::<INTERIORS>(walk, start, arrival);
                }
                first = first.then(vertex);
                // What is lit directly belongs to camera paths, and all that follows from it.
                let local = self.scene.light(start.light).is_local();
                if self.caustics_only && first == First::Diffuse && !local {
                    return;
                }
                if !vertex.bsdf.is_rough() && !walk.carried.end_bundle() {
                    return;
                }
            }

            // The next ray.
            let scattering = walk.scatter(vertex, &numbers);
            if first == First::Nothing {
                first = First::Specular;
            }
            match scattering {
                Scattering::Ended => return,
                Scattering::Along(_) => {}
                Scattering::Parted => {
                    walk.each_way(|walk| self.follow::<INTERIORS>(walk, start, first, collector));
                    return;
                }
            }
            if !walk.survives(numbers.roulette) {
                return;
            }
        }
    }

    /// Whether light paths find what arrives, by the table of [`super::table`].
    fn owns(&self, start: &Start, arrival: &Arrival) -> bool {
        let local = self.scene.light(start.light).is_local();
        !self.caustics_only
            || match arrival.first {
                First::Nothing => false,
                First::Specular => true,
                First::Glossy { then_matte } => local || then_matte || !arrival.vertex.bsdf.is_rough(),
                First::Diffuse => local,
            }
    }
}

impl First {
    /// What a path met first, with a vertex that is not specular.
    fn then(self, vertex: &Vertex) -> Self {
        match self {
            Self::Nothing if vertex.is_glossy() => Self::Glossy { then_matte: false },
            Self::Nothing => Self::Diffuse,
            Self::Glossy { .. } if !vertex.bsdf.is_rough() => Self::Glossy { then_matte: true },
            _ => self,
        }
    }
}

/// Collects what the camera sees of light paths.
#[derive(Debug)]
pub struct Splatter<'a> {
    /// What the film records.
    pub sensor: &'a Sensor,
    /// The reconstruction filter.
    pub filter: &'a Filter,
    /// Who else finds the same paths.
    pub techniques: &'a Techniques,
    /// What the film gets.
    pub splats: Splats,
    /// Light and guided numbers of the last path that left one.
    pub start: Option<(LightId, [f32; 2])>,
    /// Density of the path under way, see [`Techniques::light_path_density`].
    density: Option<LightPathDensity>,
    /// The sensor's weights at the wavelengths of the path under way.
    weights: Vec<SampledSpectrum>,
}

impl<'a> Splatter<'a> {
    /// Makes a collector without any splats yet.
    pub fn new(sensor: &'a Sensor, filter: &'a Filter, techniques: &'a Techniques) -> Self {
        let splats = Splats::new(sensor.channels());
        Self { sensor, filter, techniques, splats, start: None, density: None, weights: Vec::new() }
    }

    fn deposit(&mut self, scene: &Scene, film: [f32; 2], radiance: SampledSpectrum) {
        let [width, height] = scene.camera.size();
        self.splats.begin(&self.weights, radiance);
        self.filter.splat(film, width, height, |x, y, share| self.splats.share(y * width + x, share));
    }

    /// A light that the camera sees directly: its own surface is where the path "ends".
    fn splat_emitter<const INTERIORS: bool>(&mut self, walk: &mut Walk, start: &Start) {
        let scene = walk.scene;
        let Some(area) = scene.light(start.light).emitting_area() else { return };
        let from = start.emission.start;
        let Some(seen) = scene.camera.connect(from.point, [0.5; 2], self.filter.radius()) else { return };
        let to_camera = seen.lens - from.point;
        let cos = from.normal.dot(to_camera.normalize_or_zero());
        if cos <= 0.0 {
            return;
        }
        let surface = Surface::of_emission(&from);
        if let Some(transmittance) = walk.visibility::<INTERIORS>(&surface, to_camera, Some(seen.lens), false) {
            self.deposit(scene, seen.film, start.spectrum * transmittance * (area * cos * seen.importance));
        }
    }
}

impl Collector for Splatter<'_> {
    fn leave<const INTERIORS: bool>(&mut self, walk: &mut Walk, start: &Start) {
        self.start = Some((start.light, start.numbers));
        self.sensor.weights(&start.wavelengths, &mut self.weights);
        self.density = self.techniques.light_path_density(walk.scene, start.light, &start.emission.exit());
        if matches!(self.techniques, Techniques::Light { .. }) {
            self.splat_emitter::<INTERIORS>(walk, start);
        }
    }

    /// What the camera sees of the light that a path brings to a diffuse surface.
    fn arrive<const INTERIORS: bool>(&mut self, walk: &mut Walk, start: &Start, arrival: Arrival) {
        let &Vertex { surface, ref bsdf, frame, wo, .. } = arrival.vertex;
        let scene = walk.scene;
        let Some(seen) = scene.camera.connect(surface.point, arrival.u, self.filter.radius()) else { return };
        let wi = (seen.lens - surface.point).normalize_or_zero();
        let reflected = bsdf.eval(&frame.without_shading(), wo, wi) * adjoint(&frame, wo);
        if reflected.is_zero() {
            return;
        }
        let crosses = !frame.same_side(wo, wi);
        let Some(transmittance) = walk.visibility::<INTERIORS>(surface, wi, Some(seen.lens), crosses) else { return };
        let radiance = start.power * walk.carried.throughput * reflected * transmittance;
        let weight = self.weight(scene, &arrival, wi);
        self.deposit(scene, seen.film, radiance * (weight * seen.importance));
    }
}

impl Splatter<'_> {
    /// Weight of a light path that goes on to the camera along `wi`, against the camera path that comes from there.
    fn weight(&self, scene: &Scene, arrival: &Arrival, wi: Vec3) -> SampledSpectrum {
        let (First::Specular, Some(density)) = (arrival.first, self.density) else { return SampledSpectrum::ONE };
        let &Vertex { surface, ref bsdf, ref frame, wo, .. } = arrival.vertex;
        if !bsdf.is_rough() {
            return SampledSpectrum::splat(balance_heuristic(density.matte(), camera_density(scene, surface, wi)));
        }
        let (reversed, frame) = bsdf.reversed(frame, !frame.same_side(wo, wi));
        let camera = rough_camera_density(scene, surface, &reversed, &frame, wi, wo).lanes();
        SampledSpectrum::from_fn(|lane| balance_heuristic(density.0, camera[lane]))
    }
}
