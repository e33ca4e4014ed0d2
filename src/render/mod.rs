//! The driver: splits a picture into pieces of work that any number of threads can do in any order with the same bits,
//! and the light transport techniques, one file each.

mod allocation;
mod baseline;
mod guide;
mod light;
mod merge;
mod path;
mod photons;
mod pilot;
mod plan;
mod scatter;
mod techniques;
mod walk;
mod workspace;

pub use plan::Decisions;
pub use workspace::Counters;

use crate::color::Observer;
use crate::film::{CAMERA_REPLICATES, Film, LIGHT_REPLICATES, PixelSums, Sensor, Splat};
use crate::sampling::{DIMENSIONS, Sobol, mix};
use crate::scene::{FilmSettings, RenderSettings, Scene, SceneFeatures};
use crate::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, LANES, SampledSpectrum, Wavelengths};
use allocation::{Allocation, Spent, segment_end};
use light::{LightTracer, Splatter};
use merge::MergeState;
use plan::Plan;
use rayon::prelude::*;
use std::ops::Range;
use std::time::Instant;
use techniques::Techniques;
use walk::{Parting, Walk};
use workspace::Workspace;

/// What a render did.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Statistics {
    /// Camera paths traced.
    pub camera_paths: u64,
    /// Light paths traced, those of merging aside.
    pub light_paths: u64,
    /// Light paths traced for merging.
    pub photon_paths: u64,
    /// What was decided before.
    pub decisions: Decisions,
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
const BLOCKS_AT_ONCE: u64 = 32;
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
        (false, false) => Renderer::<false, false>::new(scene, settings, film).run(proceed),
        (false, true) => Renderer::<false, true>::new(scene, settings, film).run(proceed),
        (true, false) => Renderer::<true, false>::new(scene, settings, film).run(proceed),
        (true, true) => Renderer::<true, true>::new(scene, settings, film).run(proceed),
    }
}

/// How far a render is.
#[derive(Default)]
struct RenderState {
    /// Samples of each pixel.
    samples: u64,
    /// Blocks of light paths.
    light_blocks: u64,
    /// Passes of merging.
    merge_passes: u64,
    segment: Segment,
    merging: MergeState,
    spent: Spent,
    /// Samples of a pass.
    at_once: u64,
}

/// A stretch of a render with one split of the work.
#[derive(Clone, Default)]
struct Segment {
    samples: Range<u64>,
    light_blocks: Range<u64>,
    /// What each light path counts.
    light_weight: f64,
    merge_passes: Range<u64>,
}

struct Renderer<'a, const DISPERSION: bool, const INTERIORS: bool> {
    scene: &'a Scene,
    settings: &'a RenderSettings,
    film: &'a FilmSettings,
    sensor: Sensor,
    plan: Plan,
    /// What holds the camera, if that is the same for all its rays.
    camera_interiors: Option<Vec<(u32, crate::scene::MediumId)>>,
}

impl<'a, const DISPERSION: bool, const INTERIORS: bool> Renderer<'a, DISPERSION, INTERIORS> {
    fn new(scene: &'a Scene, settings: &'a RenderSettings, film: &'a FilmSettings) -> Self {
        let plan = Plan::of_scene(scene, settings.integrator);
        let camera_interiors = if !scene.may_be_inside(&scene.camera.bounds()) {
            Some(Vec::new())
        } else if scene.camera.is_pinhole() {
            Some(scene.interiors_at(scene.camera.position()))
        } else {
            None
        };
        Self { scene, settings, film, sensor: standard_sensor(), plan, camera_interiors }
    }

    /// Plans, then renders.
    fn run(mut self, proceed: &mut dyn FnMut(Progress) -> bool) -> (Film, Statistics) {
        let mut counters = Counters::default();
        if let Techniques::CameraAndLight { merging, .. } = &mut self.plan.techniques {
            *merging = true;
            let (probed, count) = self.probe_merging();
            counters.add(count);
            if let Techniques::CameraAndLight { merging, .. } = &mut self.plan.techniques {
                *merging = probed.is_some();
            }
            self.plan.merging = probed;
        }
        let (renderer, count) = self.piloted();
        counters.add(count);
        renderer.render(counters, proceed)
    }

    fn render(mut self, pilot: Counters, proceed: &mut dyn FnMut(Progress) -> bool) -> (Film, Statistics) {
        let mut film = Film::new(self.film.width, self.film.height, self.scene.radiance_scale);
        let mut statistics = Statistics { counters: pilot, ..Statistics::default() };
        let total = self.settings.samples_per_pixel;
        let mut allocation = Allocation::START;
        let mut state = RenderState::default();
        while state.samples < total {
            let end = segment_end(state.samples, total);
            self.start_segment(&mut state, end, allocation);
            let complete = self.segment(&mut film, &mut state, &mut statistics.counters, proceed);
            if !complete {
                break;
            }
            allocation = allocation.next(&film, &state.spent);
        }
        statistics.decisions = self.plan.decisions(pilot.rays, allocation);
        statistics.camera_paths = film.camera_paths();
        statistics.light_paths = film.light_paths();
        statistics.photon_paths = state.merge_passes * self.plan.merging.as_ref().map_or(0, |m| m.photon_paths);
        statistics.complete = state.samples == total;
        (film, statistics)
    }

    /// Fixes the split of the work up to sample `end`. Within a segment the numbers of light paths and camera paths are in
    /// the proportion that their combination reckons with, and the segment counts as its camera samples in the means of both.
    fn start_segment(&mut self, state: &mut RenderState, end: u64, allocation: Allocation) {
        let camera_paths = (end - state.samples) * self.scene.camera.pixels();
        let blocks = match &mut self.plan.techniques {
            Techniques::Path => 0,
            Techniques::Light { .. } => block_count(camera_paths),
            Techniques::CameraAndLight { light_paths_per_camera_path, .. } => {
                let blocks = block_count((camera_paths as f64 * allocation.light).ceil() as u64);
                *light_paths_per_camera_path = ((blocks * BLOCK) as f64 / camera_paths as f64) as f32;
                blocks
            }
        };
        let passes = if self.plan.merging.is_some() { (end - state.samples) as f64 * allocation.merged } else { 0.0 };
        state.segment = Segment {
            samples: state.samples..end,
            light_blocks: state.light_blocks..state.light_blocks + blocks,
            light_weight: camera_paths as f64 / (blocks * BLOCK).max(1) as f64,
            merge_passes: state.merge_passes..state.merge_passes + passes.ceil() as u64,
        };
    }

    /// Renders a segment in passes; `false` if it was interrupted.
    fn segment(
        &self,
        film: &mut Film,
        state: &mut RenderState,
        counters: &mut Counters,
        proceed: &mut dyn FnMut(Progress) -> bool,
    ) -> bool {
        let segment = state.segment.clone();
        let mut started = Instant::now();
        while state.samples < segment.samples.end {
            let next = (state.samples + state.at_once.max(1)).min(segment.samples.end);
            // Every technique is as far in its part of the segment as camera paths are in theirs.
            let progress = |range: &Range<u64>| {
                let part = u128::from(next - segment.samples.start) * u128::from(range.end - range.start);
                range.start + part.div_ceil(u128::from(segment.samples.end - segment.samples.start)) as u64
            };
            let (light_blocks, merge_passes) = (progress(&segment.light_blocks), progress(&segment.merge_passes));
            if !matches!(self.plan.techniques, Techniques::Light { .. }) {
                state.spent.camera += counters.count(self.camera_pass(film, state.samples..next));
            }
            let light = self.light_pass(film, state.light_blocks..light_blocks, segment.light_weight);
            state.spent.light += counters.count(light);
            if let Some(merging) = &self.plan.merging {
                for pass in state.merge_passes..merge_passes {
                    let merged = self.merge_pass(merging, film, pass, &mut state.merging);
                    state.spent.merged += counters.count(merged);
                }
            }
            (state.samples, state.light_blocks, state.merge_passes) = (next, light_blocks, merge_passes);
            if !proceed(Progress { samples: next, of: self.settings.samples_per_pixel, rays: counters.rays }) {
                return false;
            }
            // The length of a pass changes no bit: it only decides when to look up.
            let growth = SECONDS_PER_PASS / started.elapsed().as_secs_f64().max(1e-3);
            state.at_once = ((state.at_once as f64 * growth.clamp(0.25, 4.0)) as u64).max(1);
            started = Instant::now();
        }
        true
    }

    /// Takes some samples of every pixel.
    fn camera_pass(&self, film: &mut Film, samples: Range<u64>) -> Counters {
        let (width, height) = (self.film.width, self.film.height);
        // Tiles borrow their rows from the film: each works on a copy of its pixels.
        let all = film.camera_mut();
        let stream = (mix(self.settings.seed), self.plan.camera_parting);
        let results: Vec<(Vec<PixelSums>, Counters, u64)> = tiles(self.film)
            .into_par_iter()
            .map_init(
                || Workspace::new(self.scene),
                |workspace, tile| {
                    workspace.counters = Counters::default();
                    let mut non_finite = 0;
                    let sums = tile_pixels(tile, width, height)
                        .map(|pixel| {
                            let mut sums = all[pixel as usize];
                            for sample in samples.clone() {
                                non_finite +=
                                    u64::from(!self.camera_sample(workspace, pixel, sample, stream, &mut sums));
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

    /// One camera path of the sequences of a seed; `false` if its radiance was not finite.
    fn camera_sample(
        &self,
        workspace: &mut Workspace,
        pixel: u32,
        sample: u64,
        (seed, parting): (u64, Parting),
        sums: &mut PixelSums,
    ) -> bool {
        let replicate = (sample % CAMERA_REPLICATES as u64) as usize;
        let index = sample / CAMERA_REPLICATES as u64;
        let sobol = Sobol::new(seed ^ (u64::from(pixel) << 8 | replicate as u64));
        let u = sobol.group(index, 0);
        let baseline = parting == Parting::Terminate;
        let wavelengths = if baseline { baseline::wavelengths(u[2]) } else { self.scene.wavelengths.sample(u[2]) };
        let mut walk = self.camera_walk(workspace, pixel, wavelengths, u, (sobol, index));
        walk.parting = parting;
        if baseline {
            (walk.hero, walk.throughput) = (0, baseline::throughput());
        }
        let radiance =
            path::radiance::<DISPERSION, INTERIORS>(&mut walk, &self.plan.techniques, self.settings.max_depth);
        sums.add_sample(replicate, self.xyz(&wavelengths, radiance))
    }

    /// The start of a camera path. Pixel, wavelengths and lens share the first group of random numbers.
    fn camera_walk<'w>(
        &self,
        workspace: &'w mut Workspace,
        pixel: u32,
        wavelengths: Wavelengths,
        u: [f32; DIMENSIONS],
        random: (Sobol, u64),
    ) -> Walk<'w>
    where
        'a: 'w,
    {
        let [dx, dy] = self.film.filter.sample([u[0], u[1]]);
        let (x, y) = (pixel % self.film.width, pixel / self.film.width);
        let ray = self.scene.camera.ray([x as f32 + 0.5 + dx, y as f32 + 0.5 + dy], [u[3], u[4]]);
        let hero = (u[5] * LANES as f32) as usize;
        workspace.spectra.begin(wavelengths);
        if INTERIORS {
            match &self.camera_interiors {
                Some(interiors) => workspace.interiors.reset(interiors),
                None => workspace.interiors.reset(&self.scene.interiors_at(ray.origin)),
            }
        }
        Walk::start(self.scene, workspace, ray, (hero, self.plan.camera_parting), random)
    }

    fn xyz(&self, wavelengths: &Wavelengths, radiance: SampledSpectrum) -> [f64; 3] {
        if radiance.is_zero() { [0.0; 3] } else { Sensor::xyz(&self.sensor.weights(wavelengths), radiance) }
    }

    /// How light paths are traced, by the plan.
    fn light_tracer(&self) -> LightTracer<'_> {
        let techniques = &self.plan.techniques;
        LightTracer {
            scene: self.scene,
            guide: techniques.guide().expect("a plan with light paths"),
            caustics_only: !matches!(techniques, Techniques::Light { .. }),
            parting: self.plan.light_parting,
            max_depth: self.settings.max_depth,
        }
    }

    /// Traces some blocks of light paths. Splats reach the film in the order of the blocks.
    fn light_pass(&self, film: &mut Film, blocks: Range<u64>, weight: f64) -> Counters {
        let mut counters = Counters::default();
        let mut start = blocks.start;
        while start < blocks.end {
            let end = (start + BLOCKS_AT_ONCE).min(blocks.end);
            let results: Vec<(Vec<Splat>, Counters)> = (start..end)
                .into_par_iter()
                .map_init(|| Workspace::new(self.scene), |workspace, block| self.light_block(workspace, block))
                .collect();
            for (block, (splats, count)) in (start..end).zip(results) {
                film.add_splats((block % LIGHT_REPLICATES as u64) as usize, BLOCK, weight, &splats);
                counters.add(count);
            }
            start = end;
        }
        counters
    }

    fn light_block(&self, workspace: &mut Workspace, block: u64) -> (Vec<Splat>, Counters) {
        workspace.counters = Counters::default();
        let replicate = block % LIGHT_REPLICATES as u64;
        // Pixels number fewer than 2⁵⁶: their sequences are others.
        let sobol = Sobol::new(mix(self.settings.seed) ^ (u64::MAX - replicate));
        let tracer = self.light_tracer();
        let mut splatter = Splatter::new(&self.sensor, &self.film.filter, &self.plan.techniques);
        for index in self::block(block / LIGHT_REPLICATES as u64) {
            tracer.trace::<DISPERSION, INTERIORS>(workspace, (sobol, index), None, &mut splatter);
        }
        (splatter.splats, workspace.counters)
    }
}

/// Blocks that hold so many light paths.
fn block_count(paths: u64) -> u64 {
    paths.div_ceil(BLOCK)
}

/// Indices of the light paths of a block.
fn block(block: u64) -> Range<u64> {
    block * BLOCK..(block + 1) * BLOCK
}

/// All tiles of a picture.
fn tiles(film: &FilmSettings) -> Range<u32> {
    0..film.width.div_ceil(TILE) * film.height.div_ceil(TILE)
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
