//! What a render reports: its progress between passes, and its outcome at the end.

use super::plan::Decisions;
use super::profile::Profile;
use crate::film::Film;
use crate::render::paths::Counters;

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

/// What was done in a render, in numbers.
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
    /// What the plan of the render decided, in numbers.
    pub decisions: Decisions,
    /// Rays and mishaps.
    pub counters: Counters,
    /// An upper bound of the relMSE of the picture, exceeded in 5 renders of 100. `None` if nothing is known of it.
    pub error_bound: Option<f64>,
    /// Whether the render ended by itself: with all samples, at the target error, or at the deadline.
    pub complete: bool,
}

/// How much of a render is done, told between passes.
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
