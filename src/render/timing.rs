//! Times of single rays, a few of all.

use std::time::{Duration, Instant};

/// Times of single rays: looking at the clock costs as much as a short ray, so only a few are timed.
#[derive(Debug, Clone, Copy, Default)]
pub struct TimedRays {
    /// Number of rays timed.
    pub rays: u64,
    /// Time that they took, looks at the clock included.
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

    /// Adds the rays that another thread has timed.
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
