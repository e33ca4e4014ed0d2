//! A short render, thrown away, from which the plan learns: how many lanes are worth following, and where light paths
//! start.

use super::blocks::{block, block_count};
use super::camera_path::camera_sample;
use super::job::Job;
use super::light_pass::light_tracer;
use super::plan::Plan;
use super::streams::pilot_seed;
use super::threads::in_parallel;
use super::tiles::column_and_row;
use crate::bsdf::{Branching, Parting};
use crate::film::{Filter, Splats, Xyz, value};
use crate::render::paths::{Counters, Place};
use crate::render::techniques::{Experience, Splatter, Techniques};
use crate::sampling::{Sobol, mix};
use crate::scene::{FilmSettings, LightId, Scene};

/// Numbers of ways that are tried. Eight have been the best nowhere, and to try them would cost as much as all others.
const WAYS: [u8; 3] = [1, 2, 4];
/// The camera's pilot takes one pixel of each square of this edge.
const SQUARE: u32 = 4;
/// Samples of each of those pixels in each trial.
const SAMPLES: u64 = 4;
/// Samples a pixel from which on a pilot is worth its cost, which is about that of one or two.
const LEAST_SAMPLES: u64 = 32;
/// Most light paths of a trial.
const LIGHT_PATHS: u64 = 1 << 16;
/// Variance of a sample, relative to the square of the pixel's brightness, beyond which it counts as this: what rare
/// samples say about the variance is mostly chance.
const LARGEST_VARIANCE: f64 = 64.0;
/// Cost of a path beside that of its rays, in units of a ray.
const COST_OF_A_PATH: f64 = 1.0;

/// A trial of camera paths: the values of all samples, square by square, and what was counted.
struct CameraTrial {
    squares: Vec<[Xyz; SAMPLES as usize]>,
    counters: Counters,
}

/// A trial of light paths, and what was counted.
#[derive(Default)]
struct LightTrial {
    paths: Vec<LightTrialPath>,
    counters: Counters,
}

/// A light path of a trial.
struct LightTrialPath {
    light: LightId,
    numbers: [f32; 2],
    /// Each pixel that the path reached, with what it added there.
    hits: Vec<(u32, Xyz)>,
}

/// Brightness of a picture as far as the pilot knows it: what camera paths find by squares, what light paths find by pixels,
/// as caustics are sharp.
struct Brightness {
    camera: Vec<Xyz>,
    light: Vec<Xyz>,
    mean: f64,
    size: [u32; 2],
}

impl Brightness {
    fn square_of(&self, pixel: u32) -> usize {
        let [width, _] = self.size;
        (pixel / width / SQUARE * width.div_ceil(SQUARE) + pixel % width / SQUARE) as usize
    }

    /// Squared differences in the channels of a pixel, relative to its brightness as in relMSE.
    fn relative(&self, pixel: u32, squares: Xyz) -> f64 {
        let floor = 0.01 * self.mean * self.mean;
        let (camera, light) = (self.camera[self.square_of(pixel)], self.light[pixel as usize]);
        let relative = |c: usize| squares[c] / ((camera[c] + light[c]) * (camera[c] + light[c]) + floor);
        if self.mean > 0.0 { (0..3).map(relative).sum() } else { 0.0 }
    }
}

/// Improves the plan of a job by a pilot, if one pays. Returns what was counted meanwhile.
pub fn run_pilot<const INTERIORS: bool>(job: &mut Job<INTERIORS>) -> Counters {
    let dispersion = job.scene.features.dispersion;
    let bundles = dispersion && matches!(job.plan.camera.parting, Parting::Ways(_));
    let (light, pays) = match job.plan.techniques {
        Techniques::Path => (false, bundles),
        Techniques::CameraAndLight { .. } => (true, true),
        Techniques::Light { .. } => (false, false),
    };
    if !pays || job.settings.samples_per_pixel < LEAST_SAMPLES {
        return Counters::default();
    }

    // The trials.
    let ways: &[u8] = if dispersion { &WAYS } else { &WAYS[..1] };
    let light_ways = if light { ways } else { &[] };
    let camera: Vec<CameraTrial> = ways.iter().map(|&ways| camera_trial(job, ways)).collect();
    let lights: Vec<LightTrial> = light_ways.iter().map(|&ways| light_trial(job, ways)).collect();

    // What follows from them.
    let brightness = brightness(job.film, &camera, &lights);
    let camera_work =
        |t: &CameraTrial| t.variance(&brightness, |square| pilot_pixel(job.film, square)) * t.cost_of_a_path();
    let best_camera = best(camera.iter().map(camera_work));
    job.plan.camera.parting = Parting::Ways(ways[best_camera]);
    if light {
        let best_light = best(lights.iter().map(|t| t.mean_square(&brightness) * t.cost_of_a_path()));
        job.plan.light.parting = Parting::Ways(ways[best_light]);
        learn_guide(job.scene, &mut job.plan, &lights, &brightness);
    }
    let mut counters = Counters::default();
    camera.iter().map(|t| t.counters).chain(lights.iter().map(|t| t.counters)).for_each(|count| counters.add(count));
    counters
}

/// Learns from the trials where light paths should start.
fn learn_guide(scene: &Scene, plan: &mut Plan, trials: &[LightTrial], brightness: &Brightness) {
    let Techniques::CameraAndLight { guide, .. } = &mut plan.techniques else { return };
    let mut experience = Experience::new(scene);
    for path in trials.iter().flat_map(|t| &t.paths) {
        experience.add(path.light, path.numbers, path.square(brightness));
    }
    *guide = experience.guide(guide, scene);
}

/// Returns how many squares the picture has across and down.
fn squares(film: &FilmSettings) -> [u32; 2] {
    [film.width, film.height].map(|size| size.div_ceil(SQUARE))
}

/// Returns the pixel of a square that the pilot looks at, at a random place in each square.
fn pilot_pixel(film: &FilmSettings, square: u32) -> u32 {
    let across = squares(film)[0];
    let random = mix(u64::from(square));
    let x = (square % across * SQUARE + random as u32 % SQUARE).min(film.width - 1);
    let y = (square / across * SQUARE + (random >> 32) as u32 % SQUARE).min(film.height - 1);
    y * film.width + x
}

/// Traces a few camera paths in each square, whose lanes part into so many ways.
fn camera_trial<const INTERIORS: bool>(job: &Job<INTERIORS>, ways: u8) -> CameraTrial {
    let [across, down] = squares(job.film);
    let branching = Branching { parting: Parting::Ways(ways), ..job.plan.camera };
    let (rows, counters) = in_parallel(job.scene, 0..down, |workspace, row| {
        let mut weights = Vec::new();
        let squares = (0..across).map(|column| {
            let pixel = pilot_pixel(job.film, row * across + column);
            std::array::from_fn(|sample| {
                let (seed, at) = (pilot_seed(job.settings.seed), column_and_row(job.film, pixel));
                let found = camera_sample(job, workspace, at, sample as u64, seed, branching);
                if found.radiance.is_zero() {
                    return Xyz::default();
                }
                job.film.sensor.weights(&found.wavelengths, &mut weights);
                let xyz: Xyz = std::array::from_fn(|c| value(weights[c], found.radiance));
                if xyz.iter().all(|v| v.is_finite()) { xyz } else { Xyz::default() }
            })
        });
        squares.collect::<Vec<_>>()
    });
    CameraTrial { squares: rows.concat(), counters }
}

/// Traces light paths whose lanes part into so many ways.
fn light_trial<const INTERIORS: bool>(job: &Job<INTERIORS>, ways: u8) -> LightTrial {
    let blocks = block_count((job.scene.camera.pixels() / 2).clamp(1, LIGHT_PATHS));
    let filter = Filter::boxed(0.5);
    let sobol = Sobol::new(mix(pilot_seed(job.settings.seed) ^ u64::from(ways)));
    let branching = Branching { parting: Parting::Ways(ways), ..job.plan.light };
    let Some(tracer) = light_tracer(job, branching) else { return LightTrial::default() };
    let (paths, counters) = in_parallel(job.scene, 0..blocks, |workspace, index| {
        let mut splatter = Splatter::new(&job.film.sensor, &filter, &job.plan.techniques);
        let path = |index| {
            splatter.start = None;
            let place = Place { sobol, index };
            tracer.trace::<INTERIORS>(workspace, place, None, &mut splatter);
            let (light, numbers) = splatter.start?;
            let hits = hits_of(&splatter.splats);
            splatter.splats.clear();
            Some(LightTrialPath { light, numbers, hits })
        };
        block(index).filter_map(path).collect::<Vec<_>>()
    });
    LightTrial { paths: paths.into_iter().flatten().collect(), counters }
}

/// Lists the pixels that get something, each with what it gets.
fn hits_of(splats: &Splats) -> Vec<(u32, Xyz)> {
    let of = |values: &[f64], share: f32| std::array::from_fn(|c| values[c] * f64::from(share));
    let contributions = splats.iter();
    contributions.flat_map(|(values, shares)| shares.iter().map(|s| (s.pixel, of(values, s.share)))).collect()
}

/// Puts together what all trials have seen of the picture.
fn brightness(film: &FilmSettings, camera: &[CameraTrial], light: &[LightTrial]) -> Brightness {
    let [across, down] = squares(film);
    let mut squares = vec![[0.0; 3]; (across * down) as usize];
    let share = 1.0 / (camera.len() as u64 * SAMPLES) as f64;
    for trial in camera {
        for (square, samples) in squares.iter_mut().zip(&trial.squares) {
            samples.iter().for_each(|xyz| (0..3).for_each(|c| square[c] += share * xyz[c]));
        }
    }
    let mut pixels = vec![[0.0; 3]; (film.width * film.height) as usize];
    let share = 1.0 / light.iter().map(|t| t.paths.len()).sum::<usize>() as f64;
    for (pixel, xyz) in light.iter().flat_map(|t| &t.paths).flat_map(|p| &p.hits) {
        (0..3).for_each(|c| pixels[*pixel as usize][c] += share * xyz[c]);
    }
    let mean = |values: &[Xyz]| values.iter().flatten().sum::<f64>() / (3 * values.len()) as f64;
    let mean = mean(&squares) + mean(&pixels);
    Brightness { camera: squares, light: pixels, mean, size: [film.width, film.height] }
}

impl CameraTrial {
    /// Returns the variance of a sample, relative to the brightness of its pixel and averaged over the picture.
    fn variance(&self, brightness: &Brightness, pixel_of: impl Fn(u32) -> u32) -> f64 {
        let of_square = |(square, samples): (usize, &[Xyz; SAMPLES as usize])| {
            let n = SAMPLES as f64;
            let variance = std::array::from_fn(|c| {
                let mean = samples.iter().map(|s| s[c]).sum::<f64>() / n;
                samples.iter().map(|s| (s[c] - mean) * (s[c] - mean)).sum::<f64>() / (n - 1.0)
            });
            brightness.relative(pixel_of(square as u32), variance).min(LARGEST_VARIANCE)
        };
        self.squares.iter().enumerate().map(of_square).sum::<f64>() / self.squares.len() as f64
    }

    fn cost_of_a_path(&self) -> f64 {
        COST_OF_A_PATH + self.counters.rays as f64 / (self.squares.len() as u64 * SAMPLES) as f64
    }
}

impl LightTrial {
    /// Mean over paths of the sum of relative squares of what pixels got: where pixels are hit rarely, that is the variance.
    fn mean_square(&self, brightness: &Brightness) -> f64 {
        let total: f64 = self.paths.iter().map(|p| p.square(brightness)).sum();
        total / self.paths.len().max(1) as f64
    }

    fn cost_of_a_path(&self) -> f64 {
        COST_OF_A_PATH + self.counters.rays as f64 / self.paths.len().max(1) as f64
    }
}

impl LightTrialPath {
    /// Sum over pixels of the relative square of what they got.
    fn square(&self, brightness: &Brightness) -> f64 {
        // Lanes that meet in a pixel add up before they are squared.
        let mut total = 0.0;
        for (i, (pixel, _)) in self.hits.iter().enumerate() {
            if self.hits[..i].iter().any(|(earlier, _)| earlier == pixel) {
                continue;
            }
            let in_pixel = self.hits[i..].iter().filter(|(other, _)| other == pixel);
            let sum = in_pixel.fold([0.0; 3], |sum: Xyz, (_, xyz)| std::array::from_fn(|c| sum[c] + xyz[c]));
            total += brightness.relative(*pixel, sum.map(|v| v * v));
        }
        total
    }
}

/// Returns the index of the least of some numbers, and of equal ones the first.
fn best(values: impl Iterator<Item = f64>) -> usize {
    values.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(index, _)| index)
}
