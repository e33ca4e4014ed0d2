//! Passes: some samples of every pixel, some light paths. Threads work on tiles and blocks, whose results reach the film in
//! their order.

use super::adaptive::Adaptive;
use super::renderer::Renderer;
use super::schedule::Segment;
use super::streams::{Stream, render_seed};
use crate::bsdf::{Branching, Carried, Parting};
use crate::film::{CAMERA_REPLICATES, CameraTile, Film, LIGHT_REPLICATES, SamplePlace, Splats};
use crate::render::paths::{Counters, Place, TransportMode, Walk, Workspace};
use crate::render::techniques::{CameraNumbers, LightTracer, Splatter, Techniques, baseline, radiance};
use crate::scene::FilmSettings;
use crate::spectrum::{SampledSpectrum, Wavelengths};
use rayon::prelude::*;
use std::ops::Range;

/// Edge of a tile in pixels.
const TILE: u32 = 16;
/// Tiles that are worked on before they add to the film.
const TILES_AT_ONCE: usize = 1024;
/// Samples of a pixel that tiles take before they add to the film: passes are made of so many, so that sums do not depend on
/// where one ends. One in each replicate.
pub const ROUND: u64 = CAMERA_REPLICATES as u64;
/// Light paths in a block.
pub const BLOCK: u64 = 512;
/// Blocks that are traced before their splats go to the film, in order.
const BLOCKS_AT_ONCE: usize = 256;

impl<'a, const INTERIORS: bool> Renderer<'a, INTERIORS> {
    /// Takes some samples of every pixel: on average those between two numbers, of which the first ends a round.
    pub fn camera_pass(
        &self,
        film: &mut Film,
        samples: Range<u64>,
        segment: &Segment,
        adaptive: &mut Option<Adaptive>,
    ) -> Counters {
        let tiles = self.camera_tiles();
        let mut counters = Counters::default();
        for first in samples.clone().step_by(ROUND as usize) {
            let round = first..(first + ROUND).min(samples.end);
            for tiles in tiles.chunks(TILES_AT_ONCE) {
                let results: Vec<TileResult> = tiles
                    .into_par_iter()
                    .map_init(
                        || Workspace::new(self.scene),
                        |workspace, tile| self.camera_tile(workspace, tile.clone(), &round, segment, adaptive.as_ref()),
                    )
                    .collect();
                add_results(film, adaptive, &results);
                results.iter().for_each(|result| counters.add(result.counters));
            }
        }
        counters
    }

    /// One round in a tile.
    fn camera_tile(
        &self,
        workspace: &mut Workspace,
        [rows, columns]: [Range<i32>; 2],
        round: &Range<u64>,
        segment: &Segment,
        adaptive: Option<&Adaptive>,
    ) -> TileResult {
        workspace.counters = Counters::default();
        let reach = self.filter_reach();
        let size = [columns.len() as u32, rows.len() as u32];
        let mut sums = CameraTile::new([columns.start, rows.start], size, reach, self.film.sensor.channels());
        let mut squares = Vec::with_capacity(columns.len() * rows.len());
        let (seed, branching) = (render_seed(self.settings.seed), self.plan.camera);
        for (y, x) in rows.flat_map(|y| columns.clone().map(move |x| (y, x))) {
            let pixel = self.on_film([x, y]);
            let (samples, weight) = match (adaptive, pixel) {
                (Some(adaptive), Some(pixel)) => adaptive.samples(pixel, round, segment),
                _ => (round.clone(), 1.0),
            };
            let rays = workspace.counters.rays;
            for sample in samples.clone() {
                let CameraSample { offset, replicate, wavelengths, radiance } =
                    self.camera_sample(workspace, [x, y], sample, seed, branching);
                let place = SamplePlace { pixel: [x, y], offset, replicate, weight };
                sums.add(&self.film.sensor, &self.film.filter, &place, &wavelengths, radiance);
            }
            let (samples, rays) = (samples.end - samples.start, workspace.counters.rays - rays);
            squares.push(Square { pixel, samples, rays });
        }
        TileResult { sums, squares, counters: workspace.counters }
    }

    /// Pixels beyond the film in whose squares samples still count. The baseline's count in one pixel alone \[PBRT4\].
    pub fn filter_reach(&self) -> u32 {
        if self.plan.camera.parting == Parting::Terminate { 0 } else { self.film.filter.reach() }
    }

    /// Rows and columns of the tiles of the picture, with what the filter reaches beyond it.
    fn camera_tiles(&self) -> Vec<[Range<i32>; 2]> {
        let reach = self.filter_reach() as i32;
        let parts = |size: u32| -> Vec<Range<i32>> {
            let end = size as i32 + reach;
            (-reach..end).step_by(TILE as usize).map(|first| first..(first + TILE as i32).min(end)).collect()
        };
        let columns = parts(self.film.width);
        parts(self.film.height).iter().flat_map(|rows| columns.iter().map(|c| [rows.clone(), c.clone()])).collect()
    }

    /// The index of a pixel that is one of the film's.
    fn on_film(&self, [x, y]: [i32; 2]) -> Option<usize> {
        let (width, height) = (self.film.width as i32, self.film.height as i32);
        ((0..width).contains(&x) && (0..height).contains(&y)).then(|| (y * width + x) as usize)
    }

    /// Column and row of a pixel of the film.
    pub fn column_and_row(&self, pixel: u32) -> [i32; 2] {
        [pixel % self.film.width, pixel / self.film.width].map(|c| c as i32)
    }

    /// An offset from the corner of a pixel, drawn from its filter.
    pub fn offset_by_filter(&self, u: [f32; 2]) -> [f32; 2] {
        self.film.filter.sample(u).map(|d| 0.5 + d)
    }

    /// One camera path of the sequences of a seed, in the square of a pixel of the film or just beyond.
    pub fn camera_sample(
        &self,
        workspace: &mut Workspace,
        pixel: [i32; 2],
        sample: u64,
        seed: u64,
        branching: Branching,
    ) -> CameraSample {
        let replicate = (sample % CAMERA_REPLICATES as u64) as usize;
        let index = sample / CAMERA_REPLICATES as u64;
        let stream = Stream::Camera { square: self.square(pixel), replicate: replicate as u8 };
        let place = Place { sobol: stream.sequence(seed), index };
        let numbers = CameraNumbers::of(place);
        let baseline = branching.parting == Parting::Terminate;
        let wavelengths = if baseline {
            baseline::wavelengths(numbers.wavelengths)
        } else {
            self.scene.wavelengths.sample(numbers.wavelengths)
        };
        let offset = if baseline { self.offset_by_filter(numbers.film) } else { numbers.film };
        let start = CameraStart { pixel, offset, wavelengths, numbers };
        let mut walk = self.camera_walk(workspace, start, branching, place);
        if baseline {
            (walk.carried.hero, walk.carried.throughput) = (0, baseline::throughput());
        }
        let radiance = radiance::<INTERIORS>(&mut walk, &self.plan.techniques, self.settings.max_depth);
        CameraSample { offset: (!baseline).then_some(offset), replicate, wavelengths, radiance }
    }

    /// A number for each pixel of the film, and beyond it as far as the filter reaches.
    fn square(&self, [x, y]: [i32; 2]) -> u64 {
        let reach = self.film.filter.reach() as i32;
        (y + reach) as u64 * (u64::from(self.film.width) + 2 * reach as u64) + (x + reach) as u64
    }

    /// The start of a camera path at an offset from the corner of a pixel. Pixel, wavelengths and lens share the first group of
    /// random numbers.
    pub fn camera_walk<'w>(
        &self,
        workspace: &'w mut Workspace,
        CameraStart { pixel: [x, y], offset, wavelengths, numbers }: CameraStart,
        branching: Branching,
        place: Place,
    ) -> Walk<'w>
    where
        'a: 'w,
    {
        let ray = self.scene.camera.ray([x as f32 + offset[0], y as f32 + offset[1]], numbers.lens);
        workspace.spectra.begin(wavelengths);
        if INTERIORS {
            match &self.camera_interiors {
                Some(interiors) => workspace.interiors.reset(interiors),
                None => workspace.interiors.reset(&self.scene.interiors_at(ray.origin)),
            }
        }
        let carried = Carried::new(numbers.hero, branching);
        Walk::start(self.scene, workspace, ray, TransportMode::Radiance, carried, place)
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
            let results: Vec<(Splats, Counters)> = blocks
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
    fn light_block(&self, workspace: &mut Workspace, paths: Range<u64>) -> (Splats, Counters) {
        workspace.counters = Counters::default();
        let stream = Stream::Light { replicate: replicate_of(&paths) as u8 };
        let sobol = stream.sequence(render_seed(self.settings.seed));
        let tracer = self.light_tracer();
        let mut splatter = Splatter::new(&self.film.sensor, &self.film.filter, &self.plan.techniques);
        let before = paths.start / BLOCK / LIGHT_REPLICATES as u64 * BLOCK;
        for path in paths {
            let place = Place { sobol, index: before + path % BLOCK };
            tracer.trace::<INTERIORS>(workspace, place, None, &mut splatter);
        }
        (splatter.splats, workspace.counters)
    }
}

/// Where a camera path starts.
pub struct CameraStart {
    /// Column and row of its pixel.
    pub pixel: [i32; 2],
    /// Where, from the corner of the pixel.
    pub offset: [f32; 2],
    /// Its wavelengths.
    pub wavelengths: Wavelengths,
    /// The random numbers of its start.
    pub numbers: CameraNumbers,
}

/// What a camera path has found.
pub struct CameraSample {
    /// Where, from the corner of its pixel; `None` where it counts in that pixel alone.
    offset: Option<[f32; 2]>,
    replicate: usize,
    /// The wavelengths of its lanes.
    pub wavelengths: Wavelengths,
    /// The radiance that it has found at each of them.
    pub radiance: SampledSpectrum,
}

/// What was found in a tile.
struct TileResult {
    sums: CameraTile,
    squares: Vec<Square>,
    counters: Counters,
}

/// What was done in the square of a pixel.
struct Square {
    /// Its index, if it is one of the film's.
    pixel: Option<usize>,
    samples: u64,
    /// What the samples have cost.
    rays: u64,
}

/// Adds what was found in some tiles to the film, and what it has cost to what adaptive sampling knows.
fn add_results(film: &mut Film, adaptive: &mut Option<Adaptive>, results: &[TileResult]) {
    film.add_tiles(&results.iter().map(|result| &result.sums).collect::<Vec<_>>());
    for &Square { pixel, samples, rays } in results.iter().flat_map(|result| &result.squares) {
        film.camera_mut().count_samples(pixel, samples);
        if let (Some(adaptive), Some(pixel)) = (adaptive.as_mut(), pixel) {
            adaptive.add_rays(pixel, rays);
        }
    }
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
