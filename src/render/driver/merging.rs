//! Passes of merging: each traces its photons and looks for them along one camera path a pixel.

use super::camera_path::{CameraStart, camera_walk, offset_by_filter};
use super::job::Job;
use super::light_pass::light_tracer;
use super::streams::{Stream, render_seed};
use super::threads::in_parallel;
use super::tiles::{column_and_row, tile_pixels, tiles};
use crate::bsdf::{Branching, Parting};
use crate::film::{Film, LIGHT_REPLICATES, Splats};
use crate::render::paths::{Counters, Place, Vertex, Walk, Workspace};
use crate::render::techniques::{CameraNumbers, Merging, PhotonCollector, PhotonMap, follow_specular, radiance_ratio};
use crate::sampling::mix;
use crate::scene::MediumId;
use crate::spectrum::{SampledSpectrum, Wavelengths};

/// First radius, in widths of a pixel where photons are seen.
const FIRST_RADIUS_PIXELS: f32 = 3.0;
/// Camera paths that look for surfaces to merge on before the first pass, along each side of the picture.
const PROBES: u32 = 96;
/// Share of the pixels without such a surface so far that are looked at again in a pass.
const SECOND_LOOK: f32 = 0.125;
/// Passes that look at all pixels.
const FULL_PASSES: u64 = 2;
/// Ways that photons take where lanes part: each serves many pixels.
const PHOTON_WAYS: u8 = 4;
/// Photon paths in a block.
const BLOCK: u64 = 1024;

/// What a pass of merging has found in a tile.
struct MergedTile {
    splats: Splats,
    /// Each pixel that was looked at, with whether there was a surface to merge on.
    looked_at: Vec<(u32, bool)>,
}

impl MergedTile {
    fn new(channels: usize) -> Self {
        Self { splats: Splats::new(channels), looked_at: Vec::new() }
    }
}

/// What the passes of merging have learnt so far.
#[derive(Debug, Default)]
pub struct MergeState {
    /// Whether there was a surface to merge on in each pixel, in any pass so far.
    seen: Vec<bool>,
}

/// Decides how to merge by a few camera paths; `None` if none of them meets a diffuse surface through or in something
/// specular.
pub fn probe_merging<const INTERIORS: bool>(job: &Job<INTERIORS>) -> (Option<Merging>, Counters) {
    let mut workspace = Workspace::new(job.scene);
    let (width, height) = (job.film.width, job.film.height);
    let (across, down) = (width.min(PROBES), height.min(PROBES));
    let (mut pixels, mut seen, mut footprint) = (0u64, 0u64, 0.0);
    for probe in 0..across * down {
        let (x, y) = (probe % across * width / across, probe / across * height / down);
        let wavelengths = job.scene.wavelengths.sample(0.5);
        let mut found = false;
        eye_path(job, &mut workspace, y * width + x, u64::MAX, wavelengths, &mut |walk, vertex, _| {
            let pixel = job.scene.camera.pixel_width();
            footprint += f64::from(pixel * vertex.surface.point.distance(job.scene.camera.position()));
            found |= !walk.carried.throughput.is_zero();
            seen += 1;
        });
        pixels += u64::from(found);
    }
    if seen == 0 {
        return (None, workspace.counters);
    }
    let share = pixels as f64 / f64::from(across * down);
    let photon_paths = (share * (u64::from(width) * u64::from(height)) as f64) as u64;
    let merging = Merging {
        radius: FIRST_RADIUS_PIXELS * (footprint / seen as f64) as f32,
        photon_paths: photon_paths.max(4 * BLOCK).next_multiple_of(BLOCK),
    };
    (Some(merging), workspace.counters)
}

/// Renders one pass: traces its photons and adds what they bring to the picture.
pub fn merge_pass<const INTERIORS: bool>(
    job: &Job<INTERIORS>,
    merging: &Merging,
    film: &mut Film,
    pass: u64,
    state: &mut MergeState,
) -> Counters {
    let u = Stream::MergingWavelengths.sequence(render_seed(job.settings.seed)).group(pass, 0);
    let wavelengths = job.scene.wavelengths.sample(u[0]);
    let (map, mut counters) = photon_map(job, merging, pass, wavelengths);
    state.seen.resize((job.film.width * job.film.height) as usize, false);
    let all = &state.seen;
    let mut weights = Vec::new();
    job.film.sensor.weights(&wavelengths, &mut weights);
    let weights = weights.as_slice();
    let (results, count) = in_parallel(job.scene, tiles(job.film), |workspace, tile| {
        let pixels = tile_pixels(tile, job.film.width, job.film.height);
        let mut tile = MergedTile::new(weights.len());
        for pixel in pixels {
            let Some(weight) = look_at(job, all[pixel as usize], pixel, pass) else { continue };
            let (radiance, seen) = merge_pixel(job, workspace, &map, pixel, pass, wavelengths, weight);
            tile.splats.begin(weights, radiance);
            tile.splats.share(pixel, 1.0);
            tile.looked_at.push((pixel, seen));
        }
        tile
    });
    counters.add(count);
    let mut merged = Splats::new(weights.len());
    for tile in results {
        merged.append(tile.splats);
        tile.looked_at.into_iter().for_each(|(pixel, seen)| state.seen[pixel as usize] |= seen);
    }
    film.add_merged((pass % LIGHT_REPLICATES as u64) as usize, &merged);
    counters
}

/// Returns the weight of what a pass finds in a pixel, or `None` if it does not look there. Pixels that showed nothing to
/// merge on in earlier passes are looked at now and then, with a weight that makes up for it.
fn look_at<const INTERIORS: bool>(job: &Job<INTERIORS>, seen: bool, pixel: u32, pass: u64) -> Option<f32> {
    if seen || pass < FULL_PASSES {
        return Some(1.0);
    }
    let random = mix(render_seed(job.settings.seed) ^ mix(u64::from(pixel) << 32 | pass)) >> 40;
    (random as f32 * (1.0 / (1u64 << 24) as f32) < SECOND_LOOK).then_some(1.0 / SECOND_LOOK)
}

/// Traces the photons of a pass and sorts them by place.
fn photon_map<const INTERIORS: bool>(
    job: &Job<INTERIORS>,
    merging: &Merging,
    pass: u64,
    wavelengths: Wavelengths,
) -> (PhotonMap, Counters) {
    let branching = Branching { parting: Parting::Ways(PHOTON_WAYS), ..job.plan.light };
    let Some(tracer) = light_tracer(job, branching) else { return (PhotonMap::default(), Counters::default()) };
    let sobol = Stream::Photons.sequence(render_seed(job.settings.seed));
    let first = pass * merging.photon_paths;
    let (photons, counters) = in_parallel(job.scene, 0..merging.photon_paths / BLOCK, |workspace, block| {
        let mut collector = PhotonCollector::default();
        for index in first + block * BLOCK..first + (block + 1) * BLOCK {
            let place = Place { sobol, index };
            tracer.trace::<INTERIORS>(workspace, place, Some(wavelengths), &mut collector);
        }
        collector.photons
    });
    (PhotonMap::new(photons.concat(), merging.radius_of(pass), merging.photon_paths), counters)
}

/// Returns the radiance that the photons add to a pixel, and whether there was a surface to merge on.
fn merge_pixel<const INTERIORS: bool>(
    job: &Job<INTERIORS>,
    workspace: &mut Workspace,
    map: &PhotonMap,
    pixel: u32,
    pass: u64,
    wavelengths: Wavelengths,
    weight: f32,
) -> (SampledSpectrum, bool) {
    let (mut radiance, mut seen) = (SampledSpectrum::ZERO, false);
    let max_depth = job.settings.max_depth;
    eye_path(job, workspace, pixel, pass, wavelengths, &mut |walk, vertex, camera_medium| {
        seen = true;
        let gathered = map.gather(vertex, walk, max_depth);
        if !gathered.is_zero() {
            let ratio = radiance_ratio::<INTERIORS>(walk, camera_medium);
            radiance += gathered * walk.carried.throughput * ratio * weight;
        }
    });
    (radiance, seen)
}

/// Follows a pixel's camera path of a pass to where photons are looked for.
fn eye_path<const INTERIORS: bool>(
    job: &Job<INTERIORS>,
    workspace: &mut Workspace,
    pixel: u32,
    pass: u64,
    wavelengths: Wavelengths,
    visit: &mut impl FnMut(&mut Walk, &Vertex, Option<MediumId>),
) {
    let sobol = Stream::Eye { pixel }.sequence(render_seed(job.settings.seed));
    let place = Place { sobol, index: pass };
    let numbers = CameraNumbers::of(place);
    let (at, offset) = (column_and_row(job.film, pixel), offset_by_filter(job.film, numbers.film));
    let start = CameraStart { pixel: at, offset, wavelengths, numbers };
    let mut walk = camera_walk(job, workspace, start, job.plan.camera, place);
    let camera_medium = if INTERIORS { walk.medium() } else { None };
    let (techniques, max_depth) = (&job.plan.techniques, job.settings.max_depth);
    let mut visit = |walk: &mut Walk, vertex: &Vertex| visit(walk, vertex, camera_medium);
    follow_specular::<INTERIORS>(&mut walk, techniques, max_depth, &mut visit);
    while walk.resume() {
        follow_specular::<INTERIORS>(&mut walk, techniques, max_depth, &mut visit);
    }
}
