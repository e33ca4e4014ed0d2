//! What camera paths and light paths have in common: a ray that carries lanes through surfaces and media.

use super::fork::Branching;
use super::workspace::{Interiors, Workspace};
use crate::bsdf::{Dielectric, DielectricSample, Incidence, Lanes};
use crate::geometry::Ray;
use crate::optics;
use crate::sampling::{DIMENSIONS, Sobol};
use crate::scene::{MediumId, Scene, Surface};
use crate::spectrum::{LANES, SampledSpectrum};
use glam::Vec3;

/// Throughput below which a path ends, by a rule instead of by chance: 2⁻¹⁰⁰.
const NEGLIGIBLE: f32 = 1.0 / (1u128 << 100) as f32;
/// Throughput below which Russian roulette sets in: it brings what survives up to this. By experiment, relMSE × rays is near
/// its least from 1/8 to 1/4, in scenes of diffuse surfaces and of glass, and a quarter more with 1.
const ROULETTE_THROUGHPUT: f32 = 0.25;

/// Wavelengths of a path of the baseline `hero` \[PBRT4\].
pub const BASELINE_LANES: usize = 4;

/// Boundaries without effect that a path may cross: they do not count as events, and no path may go on for ever.
const MAX_PASSED: u32 = 1 << 20;

/// A path under way.
#[derive(Debug)]
pub struct Walk<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The thread's memory.
    pub workspace: &'a mut Workspace,
    /// The ray.
    pub ray: Ray,
    /// Flux that the path carries, in units of what it started with.
    pub throughput: SampledSpectrum,
    /// Whether lanes still share the ray. Changed where they part, in [`Self::meet_dielectric`], [`Self::bounce`] and
    /// [`Self::set_out`], and where one of them stands for all from then on, in [`Self::diffused`].
    pub lanes: Lanes,
    /// The lane that goes on where only one does, and that draws directions for all where each would draw its own.
    pub hero: usize,
    /// Number of lanes times the probability of each to be the hero, given the path so far: 1 until the hero draws
    /// directions, see [`crate::bsdf::RoughDielectric`].
    pub odds: SampledSpectrum,
    /// What happens where lanes part.
    pub parting: Parting,
    /// Where the path forks, see [`super::fork`].
    pub least_share: f32,
    /// Scattering events so far.
    pub depth: u32,
    /// Boundaries crossed so far that did nothing.
    pub passed: u32,
    /// Random numbers: those of vertex v are group v + 1.
    pub sobol: Sobol,
    /// Index of the path in its sequence.
    pub index: u64,
}

/// What becomes of lanes that share a ray where a refraction sends them apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parting {
    /// So many of them (1, 2, 4 or 8), evenly spread and the hero among them, go on for all, each its own way, up to
    /// their first diffuse surface. From there the hero stands for all.
    Ways(u8),
    /// The hero stands for all from wherever a dispersive surface is met, whatever happens there: the state of the art that
    /// `hero` is kept for \[PBRT4\].
    Terminate,
}

/// Lanes that have parted: what each of them sets out from. A lane on its own never parts again, so a path has one of these.
#[derive(Debug, Default)]
pub struct Bundle {
    surface: Option<Surface>,
    /// Directions of the lanes that are not reflected totally.
    pub directions: [Option<Vec3>; LANES],
    /// Densities of the directions, if they are not deltas.
    pub own_pdf: Option<[f32; LANES]>,
    throughput: [f32; LANES],
    hero: usize,
    ways: u8,
    depth: u32,
    passed: u32,
    /// What is past the surface.
    interiors: Interiors,
}

/// What a dielectric surface did.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Crossing {
    /// Nothing: the volume on the other side is the same, or hidden by one of higher priority.
    Passed,
    /// Reflected or refracted.
    Scattered,
    /// Refracted into a direction for each lane: so many go on, follow them one after the other by [`Walk::set_out`].
    Parted(u8),
    /// Nothing is left of the path.
    Ended,
}

impl<'a> Walk<'a> {
    /// A path that starts along a ray, with all lanes, in what the workspace's interiors say.
    pub fn start(
        scene: &'a Scene,
        workspace: &'a mut Workspace,
        ray: Ray,
        (hero, Branching { parting, least_share }): (usize, Branching),
        (sobol, index): (Sobol, u64),
    ) -> Self {
        let (throughput, odds, lanes) = (SampledSpectrum::ONE, SampledSpectrum::ONE, Lanes::Shared);
        let (depth, passed) = (0, 0);
        Self { scene, workspace, ray, throughput, lanes, hero, odds, parting, least_share, depth, passed, sobol, index }
    }

    /// The eight random numbers of the current vertex.
    pub fn random(&self) -> [f32; DIMENSIONS] {
        self.sobol.group(self.index, self.depth + 1)
    }

    /// Those of the vertex that the ray under way left.
    pub fn last_random(&self) -> [f32; DIMENSIONS] {
        self.sobol.group(self.index, self.depth)
    }

    /// The first surface ahead; light is absorbed on the way there.
    #[inline]
    pub fn advance<const INTERIORS: bool>(&mut self) -> Option<Surface> {
        let counters = &mut self.workspace.counters;
        counters.shared_segments += u64::from(self.lanes == Lanes::Shared);
        let surface = counters.closest(self.scene, &self.ray, f32::INFINITY);
        if INTERIORS {
            let medium = self.workspace.interiors.medium(self.scene);
            let distance = surface.map_or(f32::INFINITY, |s| s.t);
            if let Some(transmittance) = self.workspace.transmittance(self.scene, medium, distance) {
                self.throughput *= transmittance;
            }
        }
        surface
    }

    /// The boundary at the surface of a transparent object; `None` if it is optically absent: the volume on the other side
    /// is the same, or hidden by one of higher priority. The workspace's `beyond` is what is past it then; with whether
    /// that is known, see [`Interiors::set_past`].
    pub fn boundary(&mut self, surface: &Surface, medium: MediumId) -> (Option<Dielectric>, bool) {
        let Workspace { spectra, interiors, beyond, .. } = &mut *self.workspace;
        let known = beyond.set_past(interiors, self.scene, surface, medium, self.ray.direction);
        let (from, to) = (interiors.medium(self.scene), beyond.medium(self.scene));
        let boundary = Dielectric { from: spectra.indices(self.scene, from), to: spectra.indices(self.scene, to) };
        ((from != to && !boundary.is_invisible()).then_some(boundary), known)
    }

    /// The path is in the workspace's `beyond` from here on.
    pub fn cross(&mut self, known: bool) {
        let Workspace { interiors, beyond, counters, .. } = &mut *self.workspace;
        counters.medium_underflows += u64::from(!known);
        std::mem::swap(interiors, beyond);
    }

    /// Goes on through a boundary that is optically absent.
    pub fn pass(&mut self, surface: &Surface, known: bool) -> Crossing {
        self.cross(known);
        self.ray = surface.spawn(self.ray.direction);
        self.passed += 1;
        if self.passed < MAX_PASSED { Crossing::Passed } else { Crossing::Ended }
    }

    /// Reflection, refraction or passage at the smooth boundary of a transparent object.
    pub fn meet_dielectric<const DISPERSION: bool>(&mut self, surface: &Surface, medium: MediumId, u: f32) -> Crossing {
        let (boundary, known) = self.boundary(surface, medium);
        let Some(boundary) = boundary else { return self.pass(surface, known) };
        if DISPERSION && self.parting == Parting::Terminate && boundary.is_dispersive() {
            self.leave_to_hero();
        }
        let entering = surface.geometric.dot(self.ray.direction.as_dvec3()) < 0.0;
        let incidence =
            Incidence::new(self.ray.direction, if entering { surface.geometric } else { -surface.geometric });
        let division = boundary.divide::<DISPERSION>(&incidence, self.lanes, self.throughput);
        let sample = if self.forks(division.reflected) {
            self.put_aside(surface.spawn(incidence.reflected()), division.reflectance);
            DielectricSample { refracted: true, weight: division.transmittance() }
        } else {
            division.choose(u)
        };
        self.throughput *= sample.weight;
        self.depth += 1;
        if !sample.refracted {
            self.ray = surface.spawn(incidence.reflected());
            return if self.throughput.is_zero() { Crossing::Ended } else { Crossing::Scattered };
        }
        self.cross(known);
        if DISPERSION && self.lanes == Lanes::Shared && boundary.is_dispersive() {
            if let Parting::Ways(ways @ 2..) = self.parting {
                let directions = std::array::from_fn(|lane| boundary.refracted(&incidence, lane));
                return self.part(surface, directions, None, ways);
            }
            self.leave_to_hero();
        }
        let lane = match self.lanes {
            Lanes::Shared => 0,
            Lanes::Bundled(lane) | Lanes::Only(lane) => lane,
        };
        match boundary.refracted(&incidence, lane) {
            Some(direction) if !self.throughput.is_zero() => {
                self.ray = surface.spawn(direction);
                Crossing::Scattered
            }
            _ => Crossing::Ended,
        }
    }

    /// Lanes part at a surface, each into a direction of its own.
    pub fn part(
        &mut self,
        surface: &Surface,
        directions: [Option<Vec3>; LANES],
        own_pdf: Option<[f32; LANES]>,
        ways: u8,
    ) -> Crossing {
        let Workspace { interiors, bundle, .. } = &mut *self.workspace;
        bundle.surface = Some(*surface);
        (bundle.directions, bundle.own_pdf) = (directions, own_pdf);
        bundle.throughput = self.throughput.lanes();
        (bundle.hero, bundle.ways) = (self.hero, ways);
        (bundle.depth, bundle.passed) = (self.depth, self.passed);
        bundle.interiors.copy_from(interiors);
        Crossing::Parted(ways)
    }

    /// From here on the hero stands for all lanes that shared the ray.
    pub fn leave_to_hero(&mut self) {
        if self.lanes == Lanes::Shared {
            self.lanes = Lanes::Only(self.hero);
            self.throughput = self.throughput.only(self.hero) * (self.lanes_at_start() / self.odds.lane(self.hero));
        }
    }

    /// Lanes that a path starts with.
    pub fn lanes_at_start(&self) -> f32 {
        if self.parting == Parting::Terminate { BASELINE_LANES as f32 } else { LANES as f32 }
    }

    /// Goes back to where lanes parted and follows the `way`-th of those that go on; `false` if nothing of it is left.
    pub fn set_out(&mut self, way: u8) -> bool {
        let odds_of_any = self.odds_of_any(self.workspace.bundle.ways);
        let Workspace { interiors, bundle, .. } = &mut *self.workspace;
        let stride = LANES / usize::from(bundle.ways);
        let lane = (bundle.hero + usize::from(way) * stride) % LANES;
        let (Some(surface), Some(direction)) = (bundle.surface, bundle.directions[lane]) else { return false };
        self.ray = surface.spawn(direction);
        self.throughput = SampledSpectrum::new(bundle.throughput).only(lane) * (LANES as f32 / odds_of_any);
        (self.lanes, self.parting) = (Lanes::Bundled(lane), Parting::Ways(bundle.ways));
        (self.depth, self.passed) = (bundle.depth, bundle.passed);
        interiors.copy_from(&bundle.interiors);
        !self.throughput.is_zero()
    }

    /// Sum of the odds of the lanes that go on where `ways` do, each of which would have led to the same ways: as many as
    /// there are ways, where lanes are equally likely.
    fn odds_of_any(&self, ways: u8) -> f32 {
        let stride = LANES / usize::from(ways);
        let odds = self.odds.lanes();
        (0..usize::from(ways)).map(|way| odds[(self.hero + way * stride) % LANES]).sum()
    }

    /// To be told of every diffuse surface, before the path goes on from it: ways that a bundle took end there, but for
    /// the hero's, which stands for all from then on. `false` if this one ends.
    pub fn diffused(&mut self) -> bool {
        if let Lanes::Bundled(lane) = self.lanes {
            if lane != self.hero {
                return false;
            }
            self.lanes = Lanes::Only(lane);
            if let Parting::Ways(ways) = self.parting {
                self.throughput *= self.odds_of_any(ways) / self.odds.lane(lane);
            }
        }
        if self.parting != Parting::Terminate {
            self.parting = Parting::Ways(1);
        }
        true
    }

    /// Ends paths that carry next to nothing, and by chance those that carry little; `false` at the end. `u` is a random
    /// number of the vertex that has just been left.
    pub fn survives(&mut self, u: f32) -> bool {
        self.throughput = self.throughput.without_denormals();
        if self.throughput.max() < NEGLIGIBLE {
            return false;
        }
        let survival = self.carried() / self.least_share.min(ROULETTE_THROUGHPUT);
        if survival >= 1.0 {
            return true;
        }
        self.throughput *= 1.0 / survival;
        u < survival
    }
}

impl Workspace {
    /// What a medium lets through over a distance; `None` if everything.
    #[inline]
    fn transmittance(&mut self, scene: &Scene, medium: Option<MediumId>, distance: f32) -> Option<SampledSpectrum> {
        let absorption = scene.media[medium?.0 as usize].absorption?;
        Some(optics::transmittance(self.spectra.spectrum(scene, absorption), distance))
    }
}
