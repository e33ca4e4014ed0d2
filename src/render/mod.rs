//! The driver: splits a picture into pieces of work that any number of threads can do in any order with the same bits,
//! and the light transport techniques, one file each.

mod baseline;
mod light;
mod path;
mod techniques;
mod walk;
mod workspace;

pub use workspace::Counters;

use crate::bsdf::{Bsdf, BsdfSample};
use crate::color::Observer;
use crate::film::{CAMERA_REPLICATES, Film, LIGHT_REPLICATES, PixelSums, Sensor, Splat};
use crate::geometry::Frame;
use crate::sampling::{Sobol, mix};
use crate::scene::{FilmSettings, Integrator, RenderSettings, Scene, SceneFeatures, Surface};
use crate::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, LANES, SampledSpectrum, Wavelengths};
use light::LightTracer;
use rayon::prelude::*;
use std::time::Instant;
use techniques::Techniques;
use walk::{Parting, Walk};
use workspace::Workspace;

/// What a render did.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Camera paths traced.
    pub camera_paths: u64,
    /// Light paths traced.
    pub light_paths: u64,
    /// Rays and mishaps.
    pub counters: Counters,
    /// Whether all samples asked for were taken.
    pub complete: bool,
}

/// How far a render is.
#[derive(Debug, Clone, Copy)]
pub struct Progress {
    /// Samples a pixel so far.
    pub samples: u64,
    /// Samples a pixel asked for.
    pub of: u64,
    /// Rays traced so far.
    pub rays: u64,
}

/// Edge of a tile in pixels.
const TILE: u32 = 16;
/// Light paths in a block.
const BLOCK: u64 = 4096;
/// Blocks that are traced before their splats go to the film, in order.
const BLOCKS_AT_ONCE: u64 = 64;
/// Seconds that a pass should take: passes are how often progress is told and interruption looked for.
const SECONDS_PER_PASS: f64 = 0.3;

/// Renders a scene. `proceed` is called between passes and stops the render by returning `false`; what has been done by
/// then is a picture of fewer samples.
///
/// The film's bits depend on the scene, the settings and the number of samples alone, not on threads or passes.
pub fn render(
    scene: &Scene,
    settings: &RenderSettings,
    film: &FilmSettings,
    features: SceneFeatures,
    proceed: &mut dyn FnMut(Progress) -> bool,
) -> (Film, Statistics) {
    // Everything that the scene needs is on, whatever is asked for; more changes no bit.
    let needed = scene.features;
    match (features.dispersion || needed.dispersion, features.interiors || needed.interiors) {
        (false, false) => Renderer::<false, false>::new(scene, settings, film).render(proceed),
        (false, true) => Renderer::<false, true>::new(scene, settings, film).render(proceed),
        (true, false) => Renderer::<true, false>::new(scene, settings, film).render(proceed),
        (true, true) => Renderer::<true, true>::new(scene, settings, film).render(proceed),
    }
}

struct Renderer<'a, const DISPERSION: bool, const INTERIORS: bool> {
    scene: &'a Scene,
    settings: &'a RenderSettings,
    film: &'a FilmSettings,
    sensor: Sensor,
    techniques: Techniques,
    /// What camera paths do where lanes part.
    parting: Parting,
    /// What holds the camera, if that is the same for all its rays.
    camera_interiors: Option<Vec<(u32, crate::scene::MediumId)>>,
}

impl<'a, const DISPERSION: bool, const INTERIORS: bool> Renderer<'a, DISPERSION, INTERIORS> {
    fn new(scene: &'a Scene, settings: &'a RenderSettings, film: &'a FilmSettings) -> Self {
        let techniques = match settings.integrator {
            Integrator::Path | Integrator::Hero => Techniques::Path,
            Integrator::Light => Techniques::Light,
            Integrator::Auto | Integrator::Merge if scene.caustic_table.is_empty() => Techniques::Path,
            Integrator::Auto | Integrator::Merge => {
                Techniques::CameraAndLight { light_paths_per_camera_path: 1.0, merging: false }
            }
        };
        let camera_interiors = if !scene.may_be_inside(&scene.camera.bounds()) {
            Some(Vec::new())
        } else if scene.camera.is_pinhole() {
            Some(scene.interiors_at(scene.camera.position()))
        } else {
            None
        };
        let parting = if settings.integrator == Integrator::Hero { Parting::Terminate } else { Parting::Ways(2) };
        Self { scene, settings, film, sensor: standard_sensor(), techniques, parting, camera_interiors }
    }

    fn render(&self, proceed: &mut dyn FnMut(Progress) -> bool) -> (Film, Statistics) {
        let mut film = Film::new(self.film.width, self.film.height, self.scene.radiance_scale);
        let mut statistics = Statistics::default();
        let pixels = self.scene.camera.pixels();
        let (mut done, total) = (0, self.settings.samples_per_pixel);
        let mut light_paths = 0;
        let (mut at_once, mut started) = (1, Instant::now());
        while done < total {
            let next = (done + at_once).min(total);
            if self.techniques != Techniques::Light {
                statistics.counters.add(self.camera_pass(&mut film, done..next));
            }
            let wanted = match self.techniques {
                Techniques::Path => 0,
                _ => (next * pixels).div_ceil(BLOCK),
            };
            statistics.counters.add(self.light_pass(&mut film, light_paths..wanted));
            (done, light_paths) = (next, wanted);
            if !proceed(Progress { samples: done, of: total, rays: statistics.counters.rays }) {
                break;
            }
            // The length of a pass changes no bit: it only decides when to look up.
            let growth = SECONDS_PER_PASS / started.elapsed().as_secs_f64().max(1e-3);
            at_once = ((at_once as f64 * growth.clamp(0.25, 4.0)) as u64).max(1);
            started = Instant::now();
        }
        statistics.camera_paths = film.camera_paths();
        statistics.light_paths = film.light_paths();
        statistics.complete = done == total;
        (film, statistics)
    }

    /// Takes some samples of every pixel.
    fn camera_pass(&self, film: &mut Film, samples: std::ops::Range<u64>) -> Counters {
        let (width, height) = (self.film.width, self.film.height);
        let tiles_across = width.div_ceil(TILE);
        // Tiles borrow their rows from the film: each works on a copy of its pixels.
        let tiles: Vec<u32> = (0..tiles_across * height.div_ceil(TILE)).collect();
        let all = film.camera_mut();
        let results: Vec<(Vec<PixelSums>, Counters, u64)> = tiles
            .par_iter()
            .map_init(
                || Workspace::new(self.scene),
                |workspace, &tile| {
                    workspace.counters = Counters::default();
                    let mut non_finite = 0;
                    let sums = tile_pixels(tile, width, height)
                        .map(|pixel| {
                            let mut sums = all[pixel as usize];
                            for sample in samples.clone() {
                                non_finite += u64::from(!self.camera_sample(workspace, pixel, sample, &mut sums));
                            }
                            sums
                        })
                        .collect();
                    (sums, workspace.counters, non_finite)
                },
            )
            .collect();
        let mut counters = Counters::default();
        let mut non_finite = 0;
        let all = film.camera_mut();
        for (tile, (sums, count, lost)) in results.into_iter().enumerate() {
            for (pixel, sums) in tile_pixels(tile as u32, width, height).zip(sums) {
                all[pixel as usize] = sums;
            }
            counters.add(count);
            non_finite += lost;
        }
        film.non_finite_samples += non_finite;
        counters
    }

    /// One camera path; `false` if its radiance was not finite.
    fn camera_sample(&self, workspace: &mut Workspace, pixel: u32, sample: u64, sums: &mut PixelSums) -> bool {
        let scene = self.scene;
        let replicate = (sample % CAMERA_REPLICATES as u64) as usize;
        let index = sample / CAMERA_REPLICATES as u64;
        let stream = u64::from(pixel) << 8 | replicate as u64;
        let sobol = Sobol::new(mix(self.settings.seed) ^ stream);

        // Pixel, wavelengths and lens share the first group.
        let u = sobol.group(index, 0);
        let [dx, dy] = self.film.filter.sample([u[0], u[1]]);
        let (x, y) = (pixel % self.film.width, pixel / self.film.width);
        let baseline = self.parting == Parting::Terminate;
        let wavelengths = if baseline { baseline::wavelengths(u[2]) } else { scene.wavelengths.sample(u[2]) };
        let ray = scene.camera.ray([x as f32 + 0.5 + dx, y as f32 + 0.5 + dy], [u[3], u[4]]);
        let hero = if baseline { 0 } else { (u[5] * LANES as f32) as usize };

        workspace.spectra.begin(wavelengths);
        if INTERIORS {
            match &self.camera_interiors {
                Some(interiors) => workspace.interiors.reset(interiors),
                None => workspace.interiors.reset(&scene.interiors_at(ray.origin)),
            }
        }
        let mut walk = Walk::start(scene, workspace, ray, (hero, self.parting), (sobol, index));
        if baseline {
            walk.throughput = baseline::throughput();
        }
        let radiance = path::radiance::<DISPERSION, INTERIORS>(&mut walk, &self.techniques, self.settings.max_depth);
        sums.add_sample(replicate, self.xyz(&wavelengths, radiance))
    }

    fn xyz(&self, wavelengths: &Wavelengths, radiance: SampledSpectrum) -> [f64; 3] {
        if radiance.is_zero() { [0.0; 3] } else { Sensor::xyz(&self.sensor.weights(wavelengths), radiance) }
    }

    /// Traces some blocks of light paths. Splats reach the film in the order of the blocks.
    fn light_pass(&self, film: &mut Film, blocks: std::ops::Range<u64>) -> Counters {
        let tracer = LightTracer {
            scene: self.scene,
            sensor: &self.sensor,
            filter: &self.film.filter,
            techniques: &self.techniques,
            max_depth: self.settings.max_depth,
        };
        let mut counters = Counters::default();
        let mut start = blocks.start;
        while start < blocks.end {
            let end = (start + BLOCKS_AT_ONCE).min(blocks.end);
            let results: Vec<(Vec<Splat>, Counters)> = (start..end)
                .into_par_iter()
                .map_init(|| Workspace::new(self.scene), |workspace, block| self.light_block(&tracer, workspace, block))
                .collect();
            for (block, (splats, count)) in (start..end).zip(results) {
                film.add_splats((block % LIGHT_REPLICATES as u64) as usize, BLOCK, &splats);
                counters.add(count);
            }
            start = end;
        }
        counters
    }

    fn light_block(&self, tracer: &LightTracer, workspace: &mut Workspace, block: u64) -> (Vec<Splat>, Counters) {
        workspace.counters = Counters::default();
        let replicate = block % LIGHT_REPLICATES as u64;
        // Pixels number fewer than 2⁵⁶: their sequences are others.
        let sobol = Sobol::new(mix(self.settings.seed) ^ (u64::MAX - replicate));
        let first = block / LIGHT_REPLICATES as u64 * BLOCK;
        let mut splats = Vec::new();
        for index in first..first + BLOCK {
            tracer.trace::<DISPERSION, INTERIORS>(workspace, sobol, index, &mut splats);
        }
        (splats, workspace.counters)
    }
}

/// The pixels of a tile, row by row.
fn tile_pixels(tile: u32, width: u32, height: u32) -> impl Iterator<Item = u32> {
    let tiles_across = width.div_ceil(TILE);
    let (x0, y0) = (tile % tiles_across * TILE, tile / tiles_across * TILE);
    let (x1, y1) = ((x0 + TILE).min(width), (y0 + TILE).min(height));
    (y0..y1).flat_map(move |y| (x0..x1).map(move |x| y * width + x))
}

/// The CIE 1931 observer.
fn standard_sensor() -> Sensor {
    let observer = Observer::cie_1931_2deg();
    let matching: Vec<[f64; 3]> =
        (LAMBDA_MIN_NM as u32..=LAMBDA_MAX_NM as u32).map(|l| observer.eval(f64::from(l)).to_array()).collect();
    Sensor::new(LAMBDA_MIN_NM, &matching)
}

/// Scatters a path at an opaque surface.
fn bounce(walk: &mut Walk, surface: &Surface, bsdf: &Bsdf, frame: &Frame, u: [f32; 2]) -> Option<BsdfSample> {
    let sample = bsdf.sample(frame, -walk.ray.direction, u)?;
    walk.throughput *= sample.weight;
    walk.ray = surface.spawn(sample.wi);
    walk.depth += 1;
    Some(sample)
}
