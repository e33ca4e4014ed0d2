//! The course of a render: segments, each with one split of the work between techniques, in passes.

use super::adaptive::Adaptive;
use super::allocation::Allocation;
use super::outcome::{Progress, Rendering, Statistics};
use super::passes::{BLOCK, ROUND};
use super::profile::Phase;
use super::renderer::Renderer;
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
        false => Renderer::<false>::new(scene, settings, film).run(proceed),
        true => Renderer::<true>::new(scene, settings, film).run(proceed),
    }
}

impl<const INTERIORS: bool> Renderer<'_, INTERIORS> {
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
        let mut film = Film::of_channels(
            self.film.width,
            self.film.height,
            self.film.sensor.channels(),
            self.scene.radiance_scale,
        );
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
            next.light_paths = (next.light_paths / BLOCK * BLOCK).max(done.light_paths);
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
