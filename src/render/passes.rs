//! Passes: some samples of every pixel, some light paths. Threads work on tiles and blocks, whose results reach the film in
//! their order.

use super::adaptive::Adaptive;
use super::fork::Branching;
use super::light::{LightTracer, Splatter};
use super::schedule::Segment;
use super::techniques::Techniques;
use super::walk::{Parting, Walk};
use super::workspace::{Counters, Workspace};
use super::{Renderer, baseline, path};
use crate::film::{CAMERA_REPLICATES, Film, LIGHT_REPLICATES, PixelSums, Sensor, Splat};
use crate::sampling::{DIMENSIONS, Sobol, mix};
use crate::scene::FilmSettings;
use crate::spectrum::{LANES, SampledSpectrum, Wavelengths};
use rayon::prelude::*;
use std::ops::Range;

/// Edge of a tile in pixels.
const TILE: u32 = 16;
/// Light paths in a block.
pub const BLOCK: u64 = 512;
/// Blocks that are traced before their splats go to the film, in order.
const BLOCKS_AT_ONCE: usize = 256;

impl<'a, const DISPERSION: bool, const INTERIORS: bool> Renderer<'a, DISPERSION, INTERIORS> {
    /// Takes some samples of every pixel: on average those between two numbers.
    pub fn camera_pass(
        &self,
        film: &mut Film,
        samples: Range<u64>,
        segment: &Segment,
        adaptive: &mut Option<Adaptive>,
    ) -> Counters {
        let (width, height) = (self.film.width, self.film.height);
        let stage = adaptive.as_ref();
        let length = segment.samples.end - segment.samples.start;
        let taken = segment.taken(samples.start)..segment.taken(samples.end);
        let of_pixel =
            |pixel: u32| stage.map_or(samples.clone(), |adaptive| adaptive.samples(pixel, taken.clone(), length));
        // Tiles borrow their rows from the film: each works on a copy of its pixels.
        let all = film.camera_mut();
        let stream = (mix(self.settings.seed), self.plan.camera);
        let results: Vec<TileResult> = tiles(self.film)
            .into_par_iter()
            .map_init(
                || Workspace::new(self.scene),
                |workspace, tile| {
                    workspace.counters = Counters::default();
                    let mut non_finite = 0;
                    let pixels = tile_pixels(tile, width, height)
                        .map(|pixel| {
                            let mut sums = all[pixel as usize];
                            let rays = workspace.counters.rays;
                            for sample in of_pixel(pixel) {
                                non_finite +=
                                    u64::from(!self.camera_sample(workspace, pixel, sample, stream, &mut sums));
                            }
                            (sums, workspace.counters.rays - rays)
                        })
                        .collect();
                    TileResult { pixels, counters: workspace.counters, non_finite }
                },
            )
            .collect();
        let mut counters = Counters::default();
        for (tile, result) in results.into_iter().enumerate() {
            for (pixel, (sums, rays)) in tile_pixels(tile as u32, width, height).zip(result.pixels) {
                film.camera_mut()[pixel as usize] = sums;
                if let Some(adaptive) = adaptive {
                    adaptive.add_rays(pixel, rays);
                }
            }
            counters.add(result.counters);
            film.non_finite_samples += result.non_finite;
        }
        counters
    }

    /// One camera path of the sequences of a seed; `false` if its radiance was not finite.
    pub fn camera_sample(
        &self,
        workspace: &mut Workspace,
        pixel: u32,
        sample: u64,
        (seed, branching): (u64, Branching),
        sums: &mut PixelSums,
    ) -> bool {
        let replicate = (sample % CAMERA_REPLICATES as u64) as usize;
        let index = sample / CAMERA_REPLICATES as u64;
        let sobol = Sobol::new(seed ^ (u64::from(pixel) << 8 | replicate as u64));
        let u = sobol.group(index, 0);
        let baseline = branching.parting == Parting::Terminate;
        let wavelengths = if baseline { baseline::wavelengths(u[2]) } else { self.scene.wavelengths.sample(u[2]) };
        let mut walk = self.camera_walk(workspace, pixel, wavelengths, u, (sobol, index));
        (walk.parting, walk.least_share) = (branching.parting, branching.least_share);
        if baseline {
            (walk.hero, walk.throughput) = (0, baseline::throughput());
        }
        let radiance =
            path::radiance::<DISPERSION, INTERIORS>(&mut walk, &self.plan.techniques, self.settings.max_depth);
        sums.add_sample(replicate, self.xyz(&wavelengths, radiance))
    }

    /// The start of a camera path. Pixel, wavelengths and lens share the first group of random numbers.
    pub fn camera_walk<'w>(
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
        Walk::start(self.scene, workspace, ray, (hero, self.plan.camera), random)
    }

    pub fn xyz(&self, wavelengths: &Wavelengths, radiance: SampledSpectrum) -> [f64; 3] {
        if radiance.is_zero() { [0.0; 3] } else { Sensor::xyz(&self.sensor.weights(wavelengths), radiance) }
    }

    /// How light paths are traced, by the plan.
    pub fn light_tracer(&self) -> LightTracer<'_> {
        let techniques = &self.plan.techniques;
        LightTracer {
            scene: self.scene,
            guide: techniques.guide().expect("a plan with light paths"),
            caustics_only: !matches!(techniques, Techniques::Light { .. }),
            branching: self.plan.light,
            max_depth: self.settings.max_depth,
        }
    }

    /// Traces some light paths. Splats reach the film in their order.
    pub fn light_pass(&self, film: &mut Film, paths: Range<u64>, weight: f64) -> Counters {
        let mut counters = Counters::default();
        for blocks in blocks_of(paths).chunks(BLOCKS_AT_ONCE) {
            let results: Vec<(Vec<Splat>, Counters)> = blocks
                .into_par_iter()
                .map_init(|| Workspace::new(self.scene), |workspace, block| self.light_block(workspace, block.clone()))
                .collect();
            for (block, (splats, count)) in blocks.iter().zip(results) {
                film.add_splats(replicate_of(block), block.end - block.start, weight, &splats);
                counters.add(count);
            }
        }
        counters
    }

    /// Light paths of one block: replicates have blocks in turns, each with a sequence of its own.
    fn light_block(&self, workspace: &mut Workspace, paths: Range<u64>) -> (Vec<Splat>, Counters) {
        workspace.counters = Counters::default();
        // Pixels number fewer than 2⁵⁶: their sequences are others.
        let sobol = Sobol::new(mix(self.settings.seed) ^ (u64::MAX - replicate_of(&paths) as u64));
        let tracer = self.light_tracer();
        let mut splatter = Splatter::new(&self.sensor, &self.film.filter, &self.plan.techniques);
        let before = paths.start / BLOCK / LIGHT_REPLICATES as u64 * BLOCK;
        for path in paths {
            let index = before + path % BLOCK;
            tracer.trace::<DISPERSION, INTERIORS>(workspace, (sobol, index), None, &mut splatter);
        }
        (splatter.splats, workspace.counters)
    }
}

/// What was found in a tile.
struct TileResult {
    /// Sums of each pixel, and the rays that it has cost.
    pixels: Vec<(PixelSums, u64)>,
    counters: Counters,
    non_finite: u64,
}

/// Light paths by blocks, of which the first and the last may be parts.
fn blocks_of(paths: Range<u64>) -> Vec<Range<u64>> {
    let blocks = paths.start / BLOCK..paths.end.div_ceil(BLOCK);
    let block = |block: u64| (block * BLOCK).max(paths.start)..((block + 1) * BLOCK).min(paths.end);
    blocks.map(block).filter(|paths| !paths.is_empty()).collect()
}

/// The replicate that a block, or a part of one, belongs to.
fn replicate_of(block: &Range<u64>) -> usize {
    (block.start / BLOCK % LIGHT_REPLICATES as u64) as usize
}

/// Blocks that hold so many light paths.
pub fn block_count(paths: u64) -> u64 {
    paths.div_ceil(BLOCK)
}

/// Light paths of a block.
pub fn block(block: u64) -> Range<u64> {
    block * BLOCK..(block + 1) * BLOCK
}

/// All tiles of a picture.
pub fn tiles(film: &FilmSettings) -> Range<u32> {
    0..film.width.div_ceil(TILE) * film.height.div_ceil(TILE)
}

/// The pixels of a tile, row by row.
pub fn tile_pixels(tile: u32, width: u32, height: u32) -> impl Iterator<Item = u32> {
    let tiles_across = width.div_ceil(TILE);
    let (x0, y0) = (tile % tiles_across * TILE, tile / tiles_across * TILE);
    let (x1, y1) = ((x0 + TILE).min(width), (y0 + TILE).min(height));
    (y0..y1).flat_map(move |y| (x0..x1).map(move |x| y * width + x))
}
