//! The driver: splits a picture into pieces of work that any number of threads can do in any order with the same bits,
//! and the light transport techniques, one file each.

mod adaptive;
mod allocation;
mod baseline;
mod fork;
mod guide;
mod light;
mod merge;
mod passes;
mod path;
mod photons;
mod pilot;
mod plan;
mod profile;
mod scatter;
mod schedule;
mod stopping;
mod techniques;
mod walk;
mod workspace;

pub use plan::{Decisions, blind_spot};
pub use profile::{Phase, Profile, TimedRays};
pub use workspace::Counters;

use crate::color::Observer;
use crate::film::{Film, LIGHT_REPLICATES, Sensor};
use crate::sampling::mix;
use crate::scene::{FilmSettings, RenderSettings, Scene, SceneFeatures};
use crate::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM};
use adaptive::Adaptive;
use allocation::{Allocation, Spent};
use merge::{BLUR_DECAY, MergeState};
use passes::ROUND;
use plan::Plan;
use schedule::{Segment, Work, segment_end};
use std::time::Instant;
use stopping::{error_bound, next_look};
use techniques::Techniques;

/// A render and what is known of it.
#[derive(Debug, Clone)]
pub struct Rendering {
    /// The picture.
    pub film: Film,
    /// What was done.
    pub statistics: Statistics,
    /// Where the time went.
    pub profile: Profile,
}

/// What a render did.
#[derive(Debug, Clone, Copy, Default)]
pub struct Statistics {
    /// Samples of each pixel, on average: asking for so many gives the same picture, whatever stopped this one.
    pub samples: u64,
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
    /// An upper bound of the relMSE of the picture, exceeded in 5 renders of 100. `None` if nothing is known of it.
    pub error_bound: Option<f64>,
    /// Whether the render ended by itself: with all samples, at the target error, or at the deadline.
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
    /// The last bound of the relMSE, if there is a target for it.
    pub error_bound: Option<f64>,
}

/// Seconds that a pass should take: passes are how often progress is told and interruption looked for.
const SECONDS_PER_PASS: f64 = 0.3;
/// Seconds that count for a pass that takes less.
const SHORTEST_PASS: f64 = 0.001;

/// Renders a scene. `proceed` is called between passes and stops the render by returning `false`; what has been done by
/// then is a picture of fewer samples.
///
/// The film's bits depend on the scene, the settings and the number of samples alone, not on threads or passes. Where a
/// clock or a target error stops the render, that number is told, and is all that depends on the clock (a render asked for
/// fewer than 32 samples spares the pilot, and is another).
pub fn render(
    scene: &Scene,
    settings: &RenderSettings,
    film: &FilmSettings,
    features: SceneFeatures,
    proceed: &mut dyn FnMut(Progress) -> bool,
) -> Rendering {
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
    done: Work,
    segment: Segment,
    adaptive: Option<Adaptive>,
    merging: MergeState,
    /// Passes of merging at the last mark on the film.
    marked_passes: u64,
    spent: Spent,
    /// Samples of a pass, and what one of them takes in seconds.
    at_once: u64,
    seconds_per_sample: f64,
    error_bound: Option<f64>,
    looks: u64,
    counters: Counters,
    profile: Profile,
}

/// Why a segment ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Ending {
    Done,
    Deadline,
    Interrupted,
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
    fn run(mut self, proceed: &mut dyn FnMut(Progress) -> bool) -> Rendering {
        let mut state = RenderState::default();
        let started = Instant::now();
        if let Techniques::CameraAndLight { merging, .. } = &mut self.plan.techniques {
            *merging = true;
            let (probed, count) = self.probe_merging();
            state.counters.add(count);
            if let Techniques::CameraAndLight { merging, .. } = &mut self.plan.techniques {
                *merging = probed.is_some();
            }
            self.plan.merging = probed;
        }
        let (renderer, count) = self.piloted();
        state.counters.add(count);
        state.profile.book(Phase::Pilot, started.elapsed(), state.counters.rays);
        renderer.render(state, proceed)
    }

    fn render(mut self, mut state: RenderState, proceed: &mut dyn FnMut(Progress) -> bool) -> Rendering {
        let mut film = Film::new(self.film.width, self.film.height, self.scene.radiance_scale);
        if self.filter_reach() > 0 {
            film = film.filtered(&self.film.filter);
        }
        let pilot_rays = state.counters.rays;
        if self.settings.adaptive && !matches!(self.plan.techniques, Techniques::Light { .. }) {
            let pixels = (self.film.width * self.film.height) as usize;
            state.adaptive = Some(Adaptive::new(pixels, mix(self.settings.seed)));
        }
        let mut allocation = Allocation::START;
        let mut ending = Ending::Done;
        while ending == Ending::Done && state.done.samples < self.settings.samples_per_pixel {
            self.start_segment(&mut state, &film, allocation);
            ending = self.segment(&mut film, &mut state, proceed);
            let deciding = Instant::now();
            if self.reaches_target(&film, &mut state) {
                break;
            }
            if ending == Ending::Done && state.done.samples < self.settings.samples_per_pixel {
                state.spent.close_segment(state.segment.taken(state.done.samples), allocation);
                allocation = allocation.next(&film, &state.spent);
                state.mark_merged(&mut film);
                if state.adaptive.is_some() {
                    film.camera_mut().close_stage();
                }
            }
            state.profile.book(Phase::Deciding, deciding.elapsed(), 0);
        }
        if self.settings.target_error.is_none() {
            state.error_bound = film.error_parts(BLUR_DECAY).map(|parts| error_bound(&parts, None));
        }
        let statistics = Statistics {
            samples: state.done.samples,
            camera_paths: film.camera_paths(),
            light_paths: film.light_paths(),
            photon_paths: state.done.merge_passes() * self.plan.merging.as_ref().map_or(0, |m| m.photon_paths),
            decisions: self.plan.decisions(pilot_rays, allocation),
            counters: state.counters,
            error_bound: state.error_bound,
            complete: ending != Ending::Interrupted,
        };
        state.profile.intersections = state.counters.timed;
        Rendering { film, statistics, profile: state.profile }
    }

    /// Looks at the error, if there is a target for it.
    fn reaches_target(&self, film: &Film, state: &mut RenderState) -> bool {
        let Some(target) = self.settings.target_error else { return false };
        state.looks += 1;
        state.error_bound = film.error_parts(BLUR_DECAY).map(|parts| error_bound(&parts, Some(state.looks)));
        state.error_bound.is_some_and(|bound| bound < target)
    }

    /// Fixes the split of the work up to the end of the next segment.
    fn start_segment(&mut self, state: &mut RenderState, film: &Film, allocation: Allocation) {
        let samples = state.done.samples;
        let mut end = segment_end(samples);
        if let (Some(target), Some(bound)) = (self.settings.target_error, state.error_bound) {
            end = next_look(samples, bound / target, end);
        }
        let mut split = allocation;
        match &mut self.plan.techniques {
            Techniques::Path => split.light = 0.0,
            Techniques::Light { .. } => split.light = 1.0,
            Techniques::CameraAndLight { light_paths_per_camera_path, .. } => {
                *light_paths_per_camera_path = split.light as f32;
            }
        }
        if self.plan.merging.is_none() {
            split.merged = 0.0;
        }
        state.segment = Segment::new(state.done, end, self.scene.camera.pixels(), split);
        if let (Some(adaptive), 1..) = (&mut state.adaptive, samples) {
            adaptive.start_stage(film, end - samples);
        }
    }

    /// Renders a segment in passes, or what of it there is time for.
    fn segment(&self, film: &mut Film, state: &mut RenderState, proceed: &mut dyn FnMut(Progress) -> bool) -> Ending {
        let end = state.segment.samples.end.min(self.settings.samples_per_pixel);
        let mut ending = Ending::Done;
        let mut started = Instant::now();
        while ending == Ending::Done && state.done.samples < end {
            let samples = state.at_once.clamp(1, end - state.done.samples).min(self.samples_in_time(state));
            if samples == 0 {
                ending = Ending::Deadline;
                break;
            }
            let next = (state.done.samples + samples).next_multiple_of(ROUND).min(end);
            let samples = next - state.done.samples;
            self.passes(film, state, next, next == end);
            let progress = Progress {
                samples: next,
                of: self.settings.samples_per_pixel,
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
            self.passes(film, state, state.done.samples, true);
        }
        ending
    }

    /// Samples for which there is time until the deadline; a round at least where none has been taken yet.
    fn samples_in_time(&self, state: &RenderState) -> u64 {
        let Some(deadline) = self.settings.deadline else { return u64::MAX };
        let left = deadline.saturating_duration_since(Instant::now()).as_secs_f64();
        match state.seconds_per_sample {
            0.0 => ROUND,
            seconds => (left / seconds).round() as u64,
        }
    }

    /// The work of all techniques up to `samples`. Light paths come in whole blocks, the rest of which is traced where the
    /// film is to be `exact`: at the end of a segment, and wherever a render stops.
    fn passes(&self, film: &mut Film, state: &mut RenderState, samples: u64, exact: bool) {
        let done = state.done;
        let mut next = state.segment.work(samples);
        if !exact {
            next.light_paths = (next.light_paths / passes::BLOCK * passes::BLOCK).max(done.light_paths);
        }
        let camera = !matches!(self.plan.techniques, Techniques::Light { .. });
        if camera && samples > done.samples {
            let started = Instant::now();
            let count = self.camera_pass(film, done.samples..samples, &state.segment, &mut state.adaptive);
            let stage = if state.adaptive.is_some() { state.segment.samples.start } else { 0 };
            let taken = samples - stage;
            film.camera_mut()
                .weigh_open_stage([taken.div_ceil(2), taken / 2].map(|samples| samples as f64), taken as f64);
            state.spent.camera += state.book(Phase::Camera, started, count);
        }
        let started = Instant::now();
        let count = self.light_pass(film, done.light_paths..next.light_paths, state.segment.light_weight);
        state.spent.light += state.book(Phase::Light, started, count);
        if let Some(merging) = &self.plan.merging {
            for pass in done.merge_passes()..next.merge_passes() {
                let started = Instant::now();
                let count = self.merge_pass(merging, film, pass, &mut state.merging);
                state.spent.merged += state.book(Phase::Merging, started, count);
            }
        }
        state.done = next;
    }
}

impl RenderState {
    /// Marks what has been merged where it is twice as much as it was at the last mark, and more than nothing in each
    /// replicate.
    fn mark_merged(&mut self, film: &mut Film) {
        let passes = self.done.merge_passes();
        if passes >= (2 * self.marked_passes).max(LIGHT_REPLICATES as u64) {
            film.mark_merged();
            self.marked_passes = passes;
        }
    }

    /// Books the time since `started` and the rays of some work, and tells the rays.
    fn book(&mut self, phase: Phase, started: Instant, count: Counters) -> u64 {
        self.counters.add(count);
        self.profile.book(phase, started.elapsed(), count.rays);
        count.rays
    }
}

/// The CIE 1931 observer.
fn standard_sensor() -> Sensor {
    let observer = Observer::cie_1931_2deg();
    let matching: Vec<[f64; 3]> =
        (LAMBDA_MIN_NM as u32..=LAMBDA_MAX_NM as u32).map(|l| observer.eval(f64::from(l)).to_array()).collect();
    Sensor::new(LAMBDA_MIN_NM, &matching)
}
