//! What changes during a render.

use super::adaptive::Adaptive;
use super::allocation::Spent;
use super::merging::MergeState;
use super::profile::{Phase, Profile};
use super::schedule::{Segment, Work};
use crate::film::{Film, LIGHT_REPLICATES};
use crate::render::paths::Counters;
use std::time::Instant;

/// Work done so far, and what it has shown.
#[derive(Default)]
pub struct RenderState {
    /// Work that all techniques have done.
    pub done: Work,
    /// The segment under way.
    pub segment: Segment,
    /// Where samples go, if their number differs from pixel to pixel.
    pub adaptive: Option<Adaptive>,
    /// What passes of merging have found.
    pub merging: MergeState,
    /// Passes of merging at the last mark on the film.
    pub marked_passes: u64,
    /// Rays that each technique has traced.
    pub spent: Spent,
    /// Samples of the next pass.
    pub at_once: u64,
    /// Seconds that a sample of all pixels takes.
    pub seconds_per_sample: f64,
    /// The last bound of the relMSE.
    pub error_bound: Option<f64>,
    /// How often the error has been looked at.
    pub looks: u64,
    /// Rays and mishaps.
    pub counters: Counters,
    /// Where the time went.
    pub profile: Profile,
}

/// Why a segment ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// All its samples were taken.
    Done,
    /// There was no time for more.
    Deadline,
    /// The caller stopped it.
    Interrupted,
}

impl RenderState {
    /// Marks what has been merged where it is twice as much as it was at the last mark, and more than nothing in each
    /// replicate.
    pub fn mark_merged(&mut self, film: &mut Film) {
        let passes = self.done.merge_passes();
        if passes >= (2 * self.marked_passes).max(LIGHT_REPLICATES as u64) {
            film.mark_merged();
            self.marked_passes = passes;
        }
    }

    /// Adds the time since `started` and the counts of some work to a phase. Returns the number of rays.
    pub fn book(&mut self, phase: Phase, started: Instant, count: Counters) -> u64 {
        self.counters.add(count);
        self.profile.book(phase, started.elapsed(), count.rays);
        count.rays
    }
}
