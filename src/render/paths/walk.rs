//! A path under way.

use super::numbers::{Layout, VertexNumbers};
use super::workspace::Workspace;
use crate::bsdf::{Carried, Lanes, Parting, lane_of_way};
use crate::geometry::Ray;
use crate::optics;
use crate::sampling::Sobol;
use crate::scene::{MediumId, Scene, Surface};
use crate::spectrum::{LANES, SampledSpectrum};

/// Throughput below which a path ends, by a rule instead of by chance: 2⁻¹⁰⁰.
const NEGLIGIBLE: f32 = 1.0 / (1u128 << 100) as f32;
/// Throughput below which Russian roulette sets in: it brings what survives up to this. By experiment, relMSE × rays is near
/// its least from 1/8 to 1/4, in scenes of diffuse surfaces and of glass, and a quarter more with 1.
const ROULETTE_THROUGHPUT: f32 = 0.25;

/// What a path transports.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TransportMode {
    /// Radiance, collected by a path from the camera.
    Radiance,
    /// Importance, met by a path from a light.
    Importance,
}

/// A path under way: a ray that carries lanes through surfaces and media.
#[derive(Debug)]
pub struct Walk<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The thread's memory.
    pub workspace: &'a mut Workspace,
    /// The ray.
    pub ray: Ray,
    /// Flux and state of the lanes. Changed at vertices alone: in [`Self::encounter`], [`Self::scatter`],
    /// [`Self::each_way`] and [`Carried::end_bundle`].
    pub carried: Carried,
    /// What the path transports.
    pub mode: TransportMode,
    /// Scattering events so far.
    pub depth: u32,
    /// Absent boundaries crossed so far.
    pub passed: u32,
    /// Random numbers: those of vertex v are group v + 1.
    pub sobol: Sobol,
    /// Index of the path in its sequence.
    pub index: u64,
}

/// The place of a path in a sequence of random numbers.
#[derive(Debug, Clone, Copy)]
pub struct Place {
    /// The sequence.
    pub sobol: Sobol,
    /// Index of the path in it.
    pub index: u64,
}

impl<'a> Walk<'a> {
    /// Starts a path along a ray, with all lanes, inside of what the workspace's interiors say.
    pub fn start(
        scene: &'a Scene,
        workspace: &'a mut Workspace,
        ray: Ray,
        mode: TransportMode,
        carried: Carried,
        Place { sobol, index }: Place,
    ) -> Self {
        Self { scene, workspace, ray, carried, mode, depth: 0, passed: 0, sobol, index }
    }

    /// Draws the random numbers of the current vertex.
    #[inline]
    pub fn numbers(&self, layout: Layout) -> VertexNumbers {
        VertexNumbers::new(layout, self.sobol.group(self.index, self.depth + 1))
    }

    /// Draws those of the vertex that the ray under way left.
    pub fn last_numbers(&self, layout: Layout) -> VertexNumbers {
        VertexNumbers::new(layout, self.sobol.group(self.index, self.depth))
    }

    /// Finds the first surface ahead. Light is absorbed on the way there.
    #[inline]
    pub fn advance<const INTERIORS: bool>(&mut self) -> Option<Surface> {
        let counters = &mut self.workspace.counters;
        counters.shared_segments += u64::from(self.carried.lanes == Lanes::Shared);
        let surface = counters.closest(self.scene, &self.ray, f32::INFINITY);
        if INTERIORS {
            let medium = self.medium();
            let distance = surface.map_or(f32::INFINITY, |s| s.t);
            if let Some(transmittance) = self.workspace.transmittance(self.scene, medium, distance) {
                self.carried.throughput *= transmittance;
            }
        }
        surface
    }

    /// Returns the medium that the path is in; `None` is air.
    pub fn medium(&self) -> Option<MediumId> {
        self.workspace.interiors.medium(self.scene)
    }

    /// Follows each of the lanes that have parted, one after the other, if anything of it is left.
    pub fn each_way(&mut self, mut follow: impl FnMut(&mut Self)) {
        for way in 0..self.workspace.bundle.ways {
            if self.set_out(way) {
                follow(self);
            }
        }
    }

    /// Goes back to where lanes parted and takes one of the ways; `false` if nothing of it is left.
    fn set_out(&mut self, way: u8) -> bool {
        let ways = self.workspace.bundle.ways;
        let odds_of_any = self.carried.odds_of_any(ways);
        let Workspace { interiors, bundle, .. } = &mut *self.workspace;
        let lane = lane_of_way(bundle.hero, ways, way);
        let (Some(surface), Some(direction)) = (bundle.surface, bundle.directions[lane]) else { return false };
        self.ray = surface.spawn(direction);
        self.carried.throughput = bundle.throughput.only(lane) * (LANES as f32 / odds_of_any);
        self.carried.lanes = Lanes::Bundled(lane);
        self.carried.parting = Parting::Ways(ways);
        (self.depth, self.passed) = (bundle.depth, bundle.passed);
        interiors.copy_from(&bundle.interiors);
        !self.carried.throughput.is_zero()
    }

    /// Density with which the direction of the way that has just set out was drawn; `None` for a delta.
    pub fn density_of_way(&self) -> Option<f32> {
        let (Lanes::Bundled(lane), Some(own_pdf)) = (self.carried.lanes, self.workspace.bundle.own_pdf) else {
            return None;
        };
        Some(own_pdf.lane(lane))
    }

    /// Ends paths that carry next to nothing, and by chance those that carry little; returns `false` at the end. `u` is a
    /// random number of the vertex that has just been left.
    pub fn survives(&mut self, u: f32) -> bool {
        let carried = &mut self.carried;
        carried.throughput = carried.throughput.without_denormals();
        if carried.throughput.max() < NEGLIGIBLE {
            return false;
        }
        let survival = carried.share() / carried.least_share.min(ROULETTE_THROUGHPUT);
        if survival >= 1.0 {
            return true;
        }
        carried.throughput *= 1.0 / survival;
        u < survival
    }
}

impl Workspace {
    /// Returns what a medium lets through over a distance; `None` if everything.
    #[inline]
    fn transmittance(&mut self, scene: &Scene, medium: Option<MediumId>, distance: f32) -> Option<SampledSpectrum> {
        let absorption = scene.medium(medium?).absorption?;
        Some(optics::transmittance(self.spectra.spectrum(scene, absorption), distance))
    }
}
