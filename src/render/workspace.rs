//! What a thread keeps from path to path, so that no path allocates: spectra at the path's wavelengths, and the list of
//! transparent objects that it is inside of.

use super::fork::Branches;
use super::profile::TimedRays;
use super::walk::Bundle;
use crate::bsdf::Indices;
use crate::geometry::Ray;
use crate::scene::{MediumId, Parameter, Scene, SpectrumId, Surface};
use crate::spectrum::{LANES, SampledSpectrum, Wavelengths};
use glam::Vec3;

/// One thread's memory and counters.
#[derive(Debug)]
pub struct Workspace {
    /// Spectra at the wavelengths of the current path.
    pub spectra: SpectralCache,
    /// What the path is inside of.
    pub interiors: Interiors,
    /// The same for a shadow ray.
    pub shadow_interiors: Interiors,
    /// The same past the surface at hand.
    pub beyond: Interiors,
    /// Where the path's lanes have parted.
    pub bundle: Bundle,
    /// Where it has forked.
    pub branches: Branches,
    /// What has been counted.
    pub counters: Counters,
}

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
}

impl Counters {
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

impl Workspace {
    /// For a scene.
    pub fn new(scene: &Scene) -> Self {
        Self {
            spectra: SpectralCache::new(scene),
            interiors: Interiors::default(),
            shadow_interiors: Interiors::default(),
            beyond: Interiors::default(),
            bundle: Bundle::default(),
            branches: Branches::default(),
            counters: Counters::default(),
        }
    }
}

/// Spectra and indices of refraction at a path's wavelengths, evaluated when first asked for.
#[derive(Debug)]
pub struct SpectralCache {
    wavelengths: Wavelengths,
    /// The path that an entry belongs to.
    path: u64,
    spectra: Vec<(u64, SampledSpectrum)>,
    media: Vec<(u64, Indices)>,
}

impl SpectralCache {
    fn new(scene: &Scene) -> Self {
        Self {
            wavelengths: Wavelengths { lambda_nm: [550.0; 8], pdf: [1.0; 8] },
            path: 0,
            spectra: vec![(0, SampledSpectrum::ZERO); scene.spectra.len()],
            media: vec![(0, Indices::AIR); scene.media.len()],
        }
    }

    /// Forgets the last path.
    pub fn begin(&mut self, wavelengths: Wavelengths) {
        self.wavelengths = wavelengths;
        self.path += 1;
    }

    /// A spectrum at the path's wavelengths.
    #[inline]
    pub fn spectrum(&mut self, scene: &Scene, id: SpectrumId) -> SampledSpectrum {
        let (path, value) = &mut self.spectra[id.0 as usize];
        if *path != self.path {
            *path = self.path;
            *value = scene.spectra[id.0 as usize].sample(&self.wavelengths);
        }
        *value
    }

    /// A material's quantity at the path's wavelengths.
    #[inline]
    pub fn parameter(&mut self, scene: &Scene, parameter: Parameter) -> SampledSpectrum {
        match parameter {
            Parameter::Spectrum(id) => self.spectrum(scene, id),
        }
    }

    /// The indices of a medium at the path's wavelengths; `None` is air.
    #[inline]
    pub fn indices(&mut self, scene: &Scene, medium: Option<MediumId>) -> Indices {
        let Some(id) = medium else { return Indices::AIR };
        let (path, value) = &mut self.media[id.0 as usize];
        if *path != self.path {
            *path = self.path;
            let medium = &scene.media[id.0 as usize];
            let dispersive = medium.dispersive;
            value.dispersive = dispersive;
            if dispersive {
                value.eta = self.wavelengths.lambda_nm.map(|lambda| medium.ior.eval(f64::from(lambda)));
            } else {
                value.eta = [medium.ior.eval(f64::from(self.wavelengths.lambda_nm[0])); 8];
            }
        }
        *value
    }
}

/// The transparent objects that hold a point, in the order in which they were entered. Where they overlap, the one of
/// highest priority is there, and of equals the one entered last.
#[derive(Debug, Clone, Default)]
pub struct Interiors {
    entries: Vec<(u32, MediumId)>,
}

impl Interiors {
    /// Starts from a known list.
    pub fn reset(&mut self, entries: &[(u32, MediumId)]) {
        self.entries.clear();
        self.entries.extend_from_slice(entries);
    }

    /// Copies another list.
    pub fn copy_from(&mut self, other: &Self) {
        self.reset(&other.entries);
    }

    /// What is there; `None` is air.
    #[inline]
    pub fn medium(&self, scene: &Scene) -> Option<MediumId> {
        top(scene, self.entries.iter().copied())
    }

    /// Becomes what holds the points just past a surface of a transparent object, for a path that comes from where
    /// `before` holds; `false` when leaving an object that was never entered, which changes nothing.
    pub fn set_past(
        &mut self,
        before: &Self,
        scene: &Scene,
        surface: &Surface,
        medium: MediumId,
        direction: Vec3,
    ) -> bool {
        if scene.objects[surface.object as usize].coincident {
            self.reset(&scene.interiors_at(surface.spawn(direction).origin));
            return true;
        }
        self.copy_from(before);
        if surface.geometric.dot(direction.as_dvec3()) < 0.0 {
            self.entries.push((surface.object, medium));
            return true;
        }
        let entered = self.entries.iter().rposition(|(object, _)| *object == surface.object);
        entered.map(|index| self.entries.remove(index)).is_some()
    }
}

fn top(scene: &Scene, entries: impl Iterator<Item = (u32, MediumId)>) -> Option<MediumId> {
    // Of equal maxima `max_by_key` returns the last.
    entries.max_by_key(|(_, medium)| scene.media[medium.0 as usize].priority).map(|(_, medium)| medium)
}
