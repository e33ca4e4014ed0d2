//! The course of a render: segments, each with one split of the work between techniques, in passes.

use super::adaptive::Adaptive;
use super::allocation::Allocation;
use super::blocks::BLOCK;
use super::camera_pass::{ROUND, camera_pass};
use super::job::Job;
use super::light_pass::light_pass;
use super::merging::{merge_pass, probe_merging};
use super::outcome::{Progress, Rendering, Statistics};
use super::pilot::run_pilot;
use super::profile::Phase;
use super::schedule::{Segment, segment_end};
use super::state::{Ending, RenderState};
use super::stopping::{error_bound, next_look};
use crate::film::Film;
use crate::render::techniques::{BLUR_DECAY, Techniques};
use crate::sampling::mix;
use crate::scene::{FilmSettings, RenderSettings, Scene};
use std::time::Instant;

/// Seconds that a pass should take: passes are how often progress is told and interruption looked for.
const SECONDS_PER_PASS: f64 = 0.3;
/// Seconds that count for a pass that takes less.
const SHORTEST_PASS: f64 = 0.001;

/// Renders a scene with the kernel that keeps what paths are inside of, or with the one that does not.
pub fn run(
    scene: &Scene,
    settings: &RenderSettings,
    film: &FilmSettings,
    interiors: bool,
    proceed: &mut dyn FnMut(Progress) -> bool,
) -> Rendering {
    match interiors {
        false => plan_and_render(Job::<false>::new(scene, settings, film), proceed),
        true => plan_and_render(Job::<true>::new(scene, settings, film), proceed),
    }
}

/// Completes the plan, then renders by it.
fn plan_and_render<const INTERIORS: bool>(
    mut job: Job<INTERIORS>,
    proceed: &mut dyn FnMut(Progress) -> bool,
) -> Rendering {
    let mut state = RenderState::default();
    let started = Instant::now();
    if matches!(job.plan.techniques, Techniques::CameraAndLight { .. }) {
        let (merging, count) = probe_merging(&job);
        state.counters.add(count);
        job.plan.set_merging(merging);
    }
    state.counters.add(run_pilot(&mut job));
    state.profile.book(Phase::Pilot, started.elapsed(), state.counters.rays);
    render(job, state, proceed)
}

/// Renders by the plan of a job: segment after segment, until all samples are taken or something ends the render.
fn render<const INTERIORS: bool>(
    mut job: Job<INTERIORS>,
    mut state: RenderState,
    proceed: &mut dyn FnMut(Progress) -> bool,
) -> Rendering {
    let mut film = new_film(&job);
    let pilot_rays = state.counters.rays;
    if job.settings.adaptive && !matches!(job.plan.techniques, Techniques::Light { .. }) {
        let pixels = (job.film.width * job.film.height) as usize;
        state.adaptive = Some(Adaptive::new(pixels, mix(job.settings.seed)));
    }
    let mut allocation = Allocation::START;
    let mut ending = Ending::Done;
    while ending == Ending::Done && state.done.samples < job.settings.samples_per_pixel {
        start_segment(&mut job, &mut state, &film, allocation);
        ending = segment(&job, &mut film, &mut state, proceed);
        let deciding = Instant::now();
        if reaches_target(&job, &film, &mut state) {
            break;
        }
        if ending == Ending::Done && state.done.samples < job.settings.samples_per_pixel {
            state.spent.close_segment(state.segment.taken(state.done.samples), allocation);
            allocation = allocation.next(&film, &state.spent);
            state.mark_merged(&mut film);
            if state.adaptive.is_some() {
                film.camera_mut().close_stage();
            }
        }
        state.profile.book(Phase::Deciding, deciding.elapsed(), 0);
    }
    if job.settings.target_error.is_none() {
        state.error_bound = film.error_parts(BLUR_DECAY).map(|parts| error_bound(&parts, None));
    }
    let statistics = Statistics {
        samples: state.done.samples,
        camera_paths: film.camera_paths(),
        light_paths: film.light_paths(),
        photon_paths: state.done.merge_passes() * job.plan.merging.as_ref().map_or(0, |m| m.photon_paths),
        decisions: job.plan.decisions(pilot_rays, allocation),
        counters: state.counters,
        error_bound: state.error_bound,
        complete: ending != Ending::Interrupted,
    };
    state.profile.intersections = state.counters.timed;
    Rendering { film, statistics, profile: state.profile }
}

/// Makes the empty film of a job.
fn new_film<const INTERIORS: bool>(job: &Job<INTERIORS>) -> Film {
    let settings = job.film;
    let channels = settings.sensor.channels();
    let film = Film::of_channels(settings.width, settings.height, channels, job.scene.radiance_scale);
    if job.filter_reach() > 0 { film.filtered(&settings.filter) } else { film }
}

/// Looks at the error, if there is a target for it, and tells whether the target is reached.
fn reaches_target<const INTERIORS: bool>(job: &Job<INTERIORS>, film: &Film, state: &mut RenderState) -> bool {
    let Some(target) = job.settings.target_error else { return false };
    state.looks += 1;
    state.error_bound = film.error_parts(BLUR_DECAY).map(|parts| error_bound(&parts, Some(state.looks)));
    state.error_bound.is_some_and(|bound| bound < target)
}

/// Starts the next segment: fixes its end and its split of the work.
fn start_segment<const INTERIORS: bool>(
    job: &mut Job<INTERIORS>,
    state: &mut RenderState,
    film: &Film,
    allocation: Allocation,
) {
    let samples = state.done.samples;
    let mut end = segment_end(samples);
    if let (Some(target), Some(bound)) = (job.settings.target_error, state.error_bound) {
        end = next_look(samples, bound / target, end);
    }
    let mut split = allocation;
    match &mut job.plan.techniques {
        Techniques::Path => split.light = 0.0,
        Techniques::Light { .. } => split.light = 1.0,
        Techniques::CameraAndLight { light_paths_per_camera_path, .. } => {
            *light_paths_per_camera_path = split.light as f32;
        }
    }
    if job.plan.merging.is_none() {
        split.merged = 0.0;
    }
    state.segment = Segment::new(state.done, end, job.scene.camera.pixels(), split);
    if let (Some(adaptive), 1..) = (&mut state.adaptive, samples) {
        adaptive.start_stage(film, end - samples);
    }
}

/// Renders a segment in passes, or as much of it as there is time for.
fn segment<const INTERIORS: bool>(
    job: &Job<INTERIORS>,
    film: &mut Film,
    state: &mut RenderState,
    proceed: &mut dyn FnMut(Progress) -> bool,
) -> Ending {
    let end = state.segment.samples.end.min(job.settings.samples_per_pixel);
    let mut ending = Ending::Done;
    let mut started = Instant::now();
    while ending == Ending::Done && state.done.samples < end {
        let samples = state.at_once.clamp(1, end - state.done.samples).min(samples_in_time(job, state));
        if samples == 0 {
            ending = Ending::Deadline;
            break;
        }
        let next = (state.done.samples + samples).next_multiple_of(ROUND).min(end);
        let samples = next - state.done.samples;
        passes(job, film, state, next, next == end);
        let progress = Progress {
            samples: next,
            of: job.settings.samples_per_pixel,
            rays: state.counters.rays,
            error_bound: state.error_bound,
        };
        if !proceed(progress) {
            ending = Ending::Interrupted;
        }
        // The length of a pass changes no bit: it only decides when to look up.
        let seconds = started.elapsed().as_secs_f64();
        started = Instant::now();
        let growth = SECONDS_PER_PASS / seconds.max(SHORTEST_PASS);
        state.at_once = ((samples as f64 * growth.clamp(0.25, 4.0)) as u64).max(1);
        state.seconds_per_sample = seconds / samples as f64;
    }
    if state.done.samples < end {
        passes(job, film, state, state.done.samples, true);
    }
    ending
}

/// Returns the samples for which there is time until the deadline, and one round if none has been taken yet.
fn samples_in_time<const INTERIORS: bool>(job: &Job<INTERIORS>, state: &RenderState) -> u64 {
    let Some(deadline) = job.settings.deadline else { return u64::MAX };
    let left = deadline.saturating_duration_since(Instant::now()).as_secs_f64();
    match state.seconds_per_sample {
        0.0 => ROUND,
        seconds => (left / seconds).round() as u64,
    }
}

/// Does the work of all techniques up to `samples`. Light paths come in whole blocks, the rest of which is traced where the
/// film is to be `exact`: at the end of a segment, and wherever a render stops.
fn passes<const INTERIORS: bool>(
    job: &Job<INTERIORS>,
    film: &mut Film,
    state: &mut RenderState,
    samples: u64,
    exact: bool,
) {
    let done = state.done;
    let mut next = state.segment.work(samples);
    if !exact {
        next.light_paths = (next.light_paths / BLOCK * BLOCK).max(done.light_paths);
    }
    let camera = !matches!(job.plan.techniques, Techniques::Light { .. });
    if camera && samples > done.samples {
        let started = Instant::now();
        let count = camera_pass(job, film, done.samples..samples, &state.segment, &mut state.adaptive);
        let stage = if state.adaptive.is_some() { state.segment.samples.start } else { 0 };
        let taken = samples - stage;
        film.camera_mut().weigh_open_stage([taken.div_ceil(2), taken / 2].map(|samples| samples as f64), taken as f64);
        state.spent.camera += state.book(Phase::Camera, started, count);
    }
    let started = Instant::now();
    let count = light_pass(job, film, done.light_paths..next.light_paths, state.segment.light_weight);
    state.spent.light += state.book(Phase::Light, started, count);
    if let Some(merging) = &job.plan.merging {
        for pass in done.merge_passes()..next.merge_passes() {
            let started = Instant::now();
            let count = merge_pass(job, merging, film, pass, &mut state.merging);
            state.spent.merged += state.book(Phase::Merging, started, count);
        }
    }
    state.done = next;
}
