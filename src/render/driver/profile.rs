//! Where the time of a render goes. No bit of the film depends on it.

use crate::render::timing::TimedRays;
use std::time::Duration;

/// Kinds of work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// Trials from which the plan follows.
    Pilot,
    /// Camera paths.
    Camera,
    /// Light paths.
    Light,
    /// Merging: photons, their map and camera paths that look for them.
    Merging,
    /// Estimating errors and deciding by them.
    Deciding,
}

impl Phase {
    /// All phases, in the order of the profile.
    pub const ALL: [Self; 5] = [Self::Pilot, Self::Camera, Self::Light, Self::Merging, Self::Deciding];

    /// Returns the name of the phase.
    pub fn name(self) -> &'static str {
        ["pilot", "camera", "light", "merging", "deciding"][self as usize]
    }
}

/// Time spent by phases.
#[derive(Debug, Clone, Copy, Default)]
pub struct Profile {
    /// Wall time of each phase, in the order of [`Phase::ALL`].
    pub phases: [Duration; Phase::ALL.len()],
    /// Rays traced in each phase.
    pub rays: [u64; Phase::ALL.len()],
    /// Times of single rays.
    pub intersections: TimedRays,
}

impl Profile {
    /// Adds the time and the rays of some work to its phase.
    pub(crate) fn book(&mut self, phase: Phase, time: Duration, rays: u64) {
        self.phases[phase as usize] += time;
        self.rays[phase as usize] += rays;
    }
}
