//! What a thread keeps from path to path, so that no path allocates.

use super::counters::Counters;
use super::interiors::Interiors;
use super::spectral_cache::SpectralCache;
use crate::bsdf::Carried;
use crate::geometry::Ray;
use crate::scene::{Scene, Surface};
use crate::spectrum::{LANES, SampledSpectrum};
use glam::Vec3;

/// One thread's memory and counters.
#[derive(Debug)]
pub struct Workspace {
    /// Spectra at the wavelengths of the current path.
    pub spectra: SpectralCache,
    /// What the path is inside of.
    pub interiors: Interiors,
    /// What the shadow ray under way is inside of.
    pub shadow_interiors: Interiors,
    /// What lies past the surface at hand.
    pub beyond: Interiors,
    /// The vertex where the lanes of the path have parted.
    pub bundle: Bundle,
    /// Branches that are still to be followed.
    pub branches: Branches,
    /// What has been counted.
    pub counters: Counters,
}

impl Workspace {
    /// Memory for the paths of a scene.
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

/// The vertex where lanes have parted, and what each of them sets out with. A lane on its own never parts again, so a path
/// has one of these.
#[derive(Debug, Default)]
pub struct Bundle {
    /// The surface of the vertex; `None` before the first parting.
    pub surface: Option<Surface>,
    /// Direction of each lane that goes on.
    pub directions: [Option<Vec3>; LANES],
    /// Density of each direction, if they are not deltas.
    pub own_pdf: Option<SampledSpectrum>,
    /// Flux of each lane.
    pub throughput: SampledSpectrum,
    /// The lane that stands for all from the first matte surface on.
    pub hero: usize,
    /// How many lanes go on.
    pub ways: u8,
    /// Scattering events up to the vertex and with it.
    pub depth: u32,
    /// Absent boundaries crossed up to the vertex.
    pub passed: u32,
    /// What holds the points past the surface.
    pub interiors: Interiors,
}

/// A reflection that is to be followed later.
#[derive(Debug)]
pub struct Branch {
    /// The ray that it sets out on.
    pub ray: Ray,
    /// What it carries.
    pub carried: Carried,
    /// Scattering events up to the fork and with it.
    pub depth: u32,
    /// Absent boundaries crossed up to the fork.
    pub passed: u32,
    /// What it is inside of.
    pub interiors: Interiors,
}

/// Branches that are to be followed later, the last first. Their memory is kept from path to path.
#[derive(Debug, Default)]
pub struct Branches {
    /// Branches, of which the first [`Self::pending`] are to be followed; the others are memory for later ones.
    pub stack: Vec<Branch>,
    /// How many are to be followed.
    pub pending: usize,
}
