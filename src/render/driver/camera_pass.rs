//! The camera pass: takes some samples of every pixel. Threads work on tiles, which reach the film in their order.

use super::adaptive::Adaptive;
use super::camera_path::{CameraSample, camera_sample};
use super::job::Job;
use super::schedule::Segment;
use super::streams::render_seed;
use super::threads::in_parallel;
use super::tiles::{camera_tiles, on_film};
use crate::film::{CAMERA_REPLICATES, CameraTile, Film, SamplePlace};
use crate::render::paths::{Counters, Workspace};
use std::ops::Range;

/// Tiles that are worked on before they add to the film.
const TILES_AT_ONCE: usize = 1024;
/// Samples of a pixel that tiles take before they add to the film: passes are made of so many, so that sums do not depend on
/// where one ends. One in each replicate.
pub const ROUND: u64 = CAMERA_REPLICATES as u64;

/// What was found in a tile.
struct TileResult {
    sums: CameraTile,
    squares: Vec<Square>,
}

/// What was done in the square of a pixel.
struct Square {
    /// Its index, if it is one of the film's.
    pixel: Option<usize>,
    samples: u64,
    /// Rays traced for the samples.
    rays: u64,
}

/// Takes some samples of every pixel: on average those between two numbers, of which the first ends a round.
pub fn camera_pass<const INTERIORS: bool>(
    job: &Job<INTERIORS>,
    film: &mut Film,
    samples: Range<u64>,
    segment: &Segment,
    adaptive: &mut Option<Adaptive>,
) -> Counters {
    let tiles = camera_tiles(job.film, job.filter_reach());
    let mut counters = Counters::default();
    for first in samples.clone().step_by(ROUND as usize) {
        let round = first..(first + ROUND).min(samples.end);
        for tiles in tiles.chunks(TILES_AT_ONCE) {
            let (results, count) = in_parallel(job.scene, tiles, |workspace, tile| {
                camera_tile(job, workspace, tile.clone(), &round, segment, adaptive.as_ref())
            });
            add_results(film, adaptive, &results);
            counters.add(count);
        }
    }
    counters
}

/// Takes the samples of one round in a tile.
fn camera_tile<const INTERIORS: bool>(
    job: &Job<INTERIORS>,
    workspace: &mut Workspace,
    [rows, columns]: [Range<i32>; 2],
    round: &Range<u64>,
    segment: &Segment,
    adaptive: Option<&Adaptive>,
) -> TileResult {
    let reach = job.filter_reach();
    let size = [columns.len() as u32, rows.len() as u32];
    let mut sums = CameraTile::new([columns.start, rows.start], size, reach, job.film.sensor.channels());
    let mut squares = Vec::with_capacity(columns.len() * rows.len());
    let (seed, branching) = (render_seed(job.settings.seed), job.plan.camera);
    for (y, x) in rows.flat_map(|y| columns.clone().map(move |x| (y, x))) {
        let pixel = on_film(job.film, [x, y]);
        let (samples, weight) = match (adaptive, pixel) {
            (Some(adaptive), Some(pixel)) => adaptive.samples(pixel, round, segment),
            _ => (round.clone(), 1.0),
        };
        let rays = workspace.counters.rays;
        for sample in samples.clone() {
            let CameraSample { offset, replicate, wavelengths, radiance } =
                camera_sample(job, workspace, [x, y], sample, seed, branching);
            let place = SamplePlace { pixel: [x, y], offset, replicate, weight };
            sums.add(&job.film.sensor, &job.film.filter, &place, &wavelengths, radiance);
        }
        let (samples, rays) = (samples.end - samples.start, workspace.counters.rays - rays);
        squares.push(Square { pixel, samples, rays });
    }
    TileResult { sums, squares }
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
