//! What is counted while paths are traced.

use crate::geometry::Ray;
use crate::render::timing::TimedRays;
use crate::scene::{Scene, Surface};
use crate::spectrum::LANES;

/// Things that are counted.
#[derive(Debug, Clone, Copy, Default)]
pub struct Counters {
    /// Rays traced: segments of paths and shadow rays.
    pub rays: u64,
    /// Shadow rays among them.
    pub shadow_rays: u64,
    /// Segments of paths that all lanes share.
    pub shared_segments: u64,
    /// What tracing takes.
    pub timed: TimedRays,
    /// Rays that left a transparent object they had not entered.
    pub medium_underflows: u64,
}

impl Counters {
    /// Adds another thread's, and tells its rays.
    pub fn count(&mut self, other: Self) -> u64 {
        self.add(other);
        other.rays
    }

    /// Adds another thread's.
    pub fn add(&mut self, other: Self) {
        self.rays += other.rays;
        self.shadow_rays += other.shadow_rays;
        self.shared_segments += other.shared_segments;
        self.timed.add(other.timed);
        self.medium_underflows += other.medium_underflows;
    }

    /// Mean share of lanes that go along with a segment of a path; 1 without segments.
    pub fn lane_occupancy(&self) -> f64 {
        let segments = self.rays - self.shadow_rays;
        let alone = segments - self.shared_segments;
        let lanes = self.shared_segments as f64 + alone as f64 / LANES as f64;
        if segments > 0 { lanes / segments as f64 } else { 1.0 }
    }

    /// The first surface along a ray, before `limit`.
    #[inline]
    pub fn closest(&mut self, scene: &Scene, ray: &Ray, limit: f32) -> Option<Surface> {
        self.rays += 1;
        self.timed.time(self.rays, || scene.closest(ray, limit))
    }

    /// Whether there is any surface along a ray, before `limit`.
    #[inline]
    pub fn occluded(&mut self, scene: &Scene, ray: &Ray, limit: f32) -> bool {
        self.rays += 1;
        self.shadow_rays += 1;
        self.timed.time(self.rays, || scene.occluded(ray, limit))
    }
}
