//! What is counted while paths are traced.

use crate::geometry::Ray;
use crate::render::timing::TimedRays;
use crate::scene::{Scene, Surface};
use crate::spectrum::LANES;

/// Counts of rays and of what befalls paths.
#[derive(Debug, Clone, Copy, Default)]
pub struct Counters {
    /// Rays traced: segments of paths and shadow rays.
    pub rays: u64,
    /// Shadow rays among them.
    pub shadow_rays: u64,
    /// Segments of paths that all lanes share.
    pub shared_segments: u64,
    /// The time that tracing takes, measured on a few of the rays.
    pub timed: TimedRays,
    /// Rays that left a transparent object they had not entered.
    pub medium_underflows: u64,
}

impl Counters {
    /// Adds what another thread, or another piece of work, has counted.
    pub fn add(&mut self, other: Self) {
        self.rays += other.rays;
        self.shadow_rays += other.shadow_rays;
        self.shared_segments += other.shared_segments;
        self.timed.add(other.timed);
        self.medium_underflows += other.medium_underflows;
    }

    /// Returns the mean share of the lanes that go along a segment of a path, or 1 if there are no segments.
    pub fn lane_occupancy(&self) -> f64 {
        let segments = self.rays - self.shadow_rays;
        let alone = segments - self.shared_segments;
        let lanes = self.shared_segments as f64 + alone as f64 / LANES as f64;
        if segments > 0 { lanes / segments as f64 } else { 1.0 }
    }

    /// Returns the first surface along a ray, before `limit`.
    #[inline]
    pub fn closest(&mut self, scene: &Scene, ray: &Ray, limit: f32) -> Option<Surface> {
        self.rays += 1;
        self.timed.time(self.rays, || scene.closest(ray, limit))
    }

    /// Tells whether there is any surface along a ray, before `limit`.
    #[inline]
    pub fn occluded(&mut self, scene: &Scene, ray: &Ray, limit: f32) -> bool {
        self.rays += 1;
        self.shadow_rays += 1;
        self.timed.time(self.rays, || scene.occluded(ray, limit))
    }
}
