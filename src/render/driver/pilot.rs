//! A short render, thrown away, from which the plan learns: how many lanes are worth following, and where light paths
//! start.

use super::passes::{block, block_count};
use super::plan::Plan;
use super::renderer::Renderer;
use super::streams::pilot_seed;
use crate::bsdf::{Branching, Parting};
use crate::film::{Filter, Xyz, value};
use crate::render::paths::{Counters, Place, Workspace};
use crate::render::techniques::{Experience, LightTracer, Splatter, Techniques};
use crate::sampling::{Sobol, mix};
use rayon::prelude::*;

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
/// What a path costs beside its rays, in rays.
const COST_OF_A_PATH: f64 = 1.0;

/// A trial of camera paths: of each square the samples' values.
struct CameraTrial {
    squares: Vec<[Xyz; SAMPLES as usize]>,
    rays: u64,
}

/// A trial of light paths.
struct LightTrial {
    paths: Vec<LightTrialPath>,
    rays: u64,
}

/// A light path of a trial.
struct LightTrialPath {
    light: u32,
    numbers: [f32; 2],
    /// Pixels with what they got.
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

impl<const INTERIORS: bool> Renderer<'_, INTERIORS> {
    /// The plan of this renderer, bettered by a pilot if that pays.
    pub fn piloted(self) -> (Self, Counters) {
        let light = matches!(self.plan.techniques, Techniques::CameraAndLight { .. });
        let bundles = self.scene.features.dispersion && matches!(self.plan.camera.parting, Parting::Ways(_));
        if self.settings.samples_per_pixel < LEAST_SAMPLES || !(light || bundles) || self.light_only() {
            return (self, Counters::default());
        }
        let mut counters = Counters::default();
        let ways: &[u8] = if self.scene.features.dispersion { &WAYS } else { &WAYS[..1] };
        let camera: Vec<CameraTrial> = ways.iter().map(|&ways| self.camera_trial(ways)).collect();
        let lights: Vec<LightTrial> =
            if light { ways.iter().map(|&ways| self.light_trial(ways)).collect() } else { Vec::new() };
        counters.rays += camera.iter().map(|t| t.rays).chain(lights.iter().map(|t| t.rays)).sum::<u64>();
        let brightness = self.brightness(&camera, &lights);

        let best_camera = best(
            camera.iter().map(|t| t.variance(&brightness, |square| self.pilot_pixel(square)) * t.cost_of_a_path()),
        );
        let mut plan = self.plan.clone();
        plan.camera.parting = Parting::Ways(ways[best_camera]);
        if light {
            let best_light = best(lights.iter().map(|t| t.mean_square(&brightness) * t.cost_of_a_path()));
            plan.light.parting = Parting::Ways(ways[best_light]);
            self.learn_guide(&mut plan, &lights, &brightness);
        }
        (Self { plan, ..self }, counters)
    }

    fn light_only(&self) -> bool {
        matches!(self.plan.techniques, Techniques::Light { .. })
    }

    /// Learns where light paths start.
    fn learn_guide(&self, plan: &mut Plan, trials: &[LightTrial], brightness: &Brightness) {
        let Techniques::CameraAndLight { guide, .. } = &mut plan.techniques else { return };
        let mut experience = Experience::new(self.scene);
        for path in trials.iter().flat_map(|t| &t.paths) {
            experience.add(path.light as usize, path.numbers, path.square(brightness));
        }
        *guide = experience.guide(guide, self.scene);
    }

    /// Squares of the picture across and down.
    fn squares(&self) -> [u32; 2] {
        [self.film.width, self.film.height].map(|size| size.div_ceil(SQUARE))
    }

    /// The pixel of a square that the pilot looks at: another in each.
    fn pilot_pixel(&self, square: u32) -> u32 {
        let across = self.squares()[0];
        let random = mix(u64::from(square));
        let x = (square % across * SQUARE + random as u32 % SQUARE).min(self.film.width - 1);
        let y = (square / across * SQUARE + (random >> 32) as u32 % SQUARE).min(self.film.height - 1);
        y * self.film.width + x
    }

    fn camera_trial(&self, ways: u8) -> CameraTrial {
        let [across, down] = self.squares();
        let rows: Vec<(Vec<[Xyz; SAMPLES as usize]>, u64)> = (0..down)
            .into_par_iter()
            .map_init(
                || Workspace::new(self.scene),
                |workspace, row| {
                    workspace.counters = Counters::default();
                    let mut weights = Vec::new();
                    let squares = (0..across).map(|column| {
                        let pixel = self.pilot_pixel(row * across + column);
                        std::array::from_fn(|sample| {
                            let branching = Branching { parting: Parting::Ways(ways), ..self.plan.camera };
                            let (seed, at) = (pilot_seed(self.settings.seed), self.column_and_row(pixel));
                            let found = self.camera_sample(workspace, at, sample as u64, seed, branching);
                            if found.radiance.is_zero() {
                                return Xyz::default();
                            }
                            self.film.sensor.weights(&found.wavelengths, &mut weights);
                            let xyz: Xyz = std::array::from_fn(|c| value(weights[c], found.radiance));
                            if xyz.iter().all(|v| v.is_finite()) { xyz } else { Xyz::default() }
                        })
                    });
                    (squares.collect(), workspace.counters.rays)
                },
            )
            .collect();
        let rays = rows.iter().map(|(_, rays)| rays).sum();
        CameraTrial { squares: rows.into_iter().flat_map(|(squares, _)| squares).collect(), rays }
    }

    fn light_trial(&self, ways: u8) -> LightTrial {
        let blocks = block_count((self.scene.camera.pixels() / 2).clamp(1, LIGHT_PATHS));
        let filter = Filter::boxed(0.5);
        let sobol = Sobol::new(mix(pilot_seed(self.settings.seed) ^ u64::from(ways)));
        let results: Vec<(Vec<LightTrialPath>, u64)> = (0..blocks)
            .into_par_iter()
            .map_init(
                || Workspace::new(self.scene),
                |workspace, index| {
                    workspace.counters = Counters::default();
                    let branching = Branching { parting: Parting::Ways(ways), ..self.plan.light };
                    let tracer = LightTracer { branching, ..self.light_tracer() };
                    let mut splatter = Splatter::new(&self.film.sensor, &filter, &self.plan.techniques);
                    let paths = block(index)
                        .filter_map(|index| {
                            splatter.start = None;
                            let place = Place { sobol, index };
                            tracer.trace::<INTERIORS>(workspace, place, None, &mut splatter);
                            let (light, numbers) = splatter.start?;
                            let picture = |values: &[f64]| std::array::from_fn(|c| values[c]);
                            let hits = splatter.splats.iter().map(|(pixel, values)| (pixel, picture(values))).collect();
                            splatter.splats.clear();
                            Some(LightTrialPath { light, numbers, hits })
                        })
                        .collect();
                    (paths, workspace.counters.rays)
                },
            )
            .collect();
        let rays = results.iter().map(|(_, rays)| rays).sum();
        LightTrial { paths: results.into_iter().flat_map(|(paths, _)| paths).collect(), rays }
    }

    fn brightness(&self, camera: &[CameraTrial], light: &[LightTrial]) -> Brightness {
        let [across, down] = self.squares();
        let mut squares = vec![[0.0; 3]; (across * down) as usize];
        let share = 1.0 / (camera.len() as u64 * SAMPLES) as f64;
        for trial in camera {
            for (square, samples) in squares.iter_mut().zip(&trial.squares) {
                samples.iter().for_each(|xyz| (0..3).for_each(|c| square[c] += share * xyz[c]));
            }
        }
        let mut pixels = vec![[0.0; 3]; (self.film.width * self.film.height) as usize];
        let share = 1.0 / light.iter().map(|t| t.paths.len()).sum::<usize>() as f64;
        for (pixel, xyz) in light.iter().flat_map(|t| &t.paths).flat_map(|p| &p.hits) {
            (0..3).for_each(|c| pixels[*pixel as usize][c] += share * xyz[c]);
        }
        let mean = |values: &[Xyz]| values.iter().flatten().sum::<f64>() / (3 * values.len()) as f64;
        let mean = mean(&squares) + mean(&pixels);
        Brightness { camera: squares, light: pixels, mean, size: [self.film.width, self.film.height] }
    }
}

impl CameraTrial {
    /// Mean relative variance of a sample of a pixel.
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
        COST_OF_A_PATH + self.rays as f64 / (self.squares.len() as u64 * SAMPLES) as f64
    }
}

impl LightTrial {
    /// Mean over paths of the sum of relative squares of what pixels got: where pixels are hit rarely, that is the variance.
    fn mean_square(&self, brightness: &Brightness) -> f64 {
        let total: f64 = self.paths.iter().map(|p| p.square(brightness)).sum();
        total / self.paths.len().max(1) as f64
    }

    fn cost_of_a_path(&self) -> f64 {
        COST_OF_A_PATH + self.rays as f64 / self.paths.len().max(1) as f64
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

/// The least of some numbers, the first of equals.
fn best(values: impl Iterator<Item = f64>) -> usize {
    values.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(index, _)| index)
}
