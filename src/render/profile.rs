//! Where the time of a render goes. No bit of the film depends on it.

use std::time::{Duration, Instant};

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
    /// All, in the order of the profile.
    pub const ALL: [Self; 5] = [Self::Pilot, Self::Camera, Self::Light, Self::Merging, Self::Deciding];

    /// Its name.
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
    /// What was timed of single rays.
    pub intersections: TimedRays,
}

impl Profile {
    /// Books some work.
    pub fn book(&mut self, phase: Phase, time: Duration, rays: u64) {
        self.phases[phase as usize] += time;
        self.rays[phase as usize] += rays;
    }
}

/// Times of single rays: looking at the clock costs as much as a short ray, so only a few are timed.
#[derive(Debug, Clone, Copy, Default)]
pub struct TimedRays {
    /// Rays timed.
    pub rays: u64,
    /// What they took, with the look at the clock.
    pub total: Duration,
}

/// One ray of so many is timed.
const ONE_OF: u64 = 256;
/// No ray takes so long: something else had the processor meanwhile.
const INTERRUPTED: Duration = Duration::from_micros(50);

impl TimedRays {
    /// Traces the `number`-th ray, and times it if it is its turn.
    #[inline]
    pub fn time<T>(&mut self, number: u64, trace: impl FnOnce() -> T) -> T {
        if !number.is_multiple_of(ONE_OF) {
            return trace();
        }
        let started = Instant::now();
        let result = trace();
        let time = started.elapsed();
        if time < INTERRUPTED {
            self.total += time;
            self.rays += 1;
        }
        result
    }

    /// Adds another thread's.
    pub fn add(&mut self, other: Self) {
        self.rays += other.rays;
        self.total += other.total;
    }

    /// Mean time of a ray without the look at the clock, seconds; 0 if none was timed.
    pub fn seconds_per_ray(&self) -> f64 {
        if self.rays == 0 {
            return 0.0;
        }
        (self.total.as_secs_f64() / self.rays as f64 - look_at_the_clock()).max(0.0)
    }
}

/// What timing nothing takes, seconds.
fn look_at_the_clock() -> f64 {
    let looks = 1000;
    let total: Duration = (0..looks).map(|_| Instant::now().elapsed()).sum();
    total.as_secs_f64() / f64::from(looks)
}
