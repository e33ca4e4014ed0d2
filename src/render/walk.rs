//! What camera paths and light paths have in common: a ray that carries lanes through surfaces and media.

use super::workspace::{Interiors, Workspace};
use crate::bsdf::{Bsdf, Conductor, Dielectric, Diffuse, Incidence, Lanes, Mirror};
use crate::geometry::{Frame, Ray};
use crate::optics;
use crate::sampling::{DIMENSIONS, Sobol};
use crate::scene::{Material, MediumId, Object, Scene, Surface};
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
    /// Whether lanes still share the ray. Changed where they part, in [`Self::meet_dielectric`] and [`Self::set_out`], and
    /// where one of them stands for all from then on, in [`Self::diffused`].
    pub lanes: Lanes,
    /// The lane that goes on where only one does.
    pub hero: usize,
    /// What happens where lanes part.
    pub parting: Parting,
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
    directions: [Option<Vec3>; LANES],
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
        (hero, parting): (usize, Parting),
        (sobol, index): (Sobol, u64),
    ) -> Self {
        let (throughput, lanes) = (SampledSpectrum::ONE, Lanes::Shared);
        Self { scene, workspace, ray, throughput, lanes, hero, parting, depth: 0, passed: 0, sobol, index }
    }

    /// The eight random numbers of the current vertex.
    pub fn random(&self) -> [f32; DIMENSIONS] {
        self.sobol.group(self.index, self.depth + 1)
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

    /// Reflection, refraction or passage at the boundary of a transparent object.
    pub fn meet_dielectric<const DISPERSION: bool>(&mut self, surface: &Surface, medium: MediumId, u: f32) -> Crossing {
        let Workspace { spectra, interiors, beyond, .. } = &mut *self.workspace;
        let known = beyond.set_past(interiors, self.scene, surface, medium, self.ray.direction);
        let (from, to) = (interiors.medium(self.scene), beyond.medium(self.scene));
        let boundary = Dielectric { from: spectra.indices(self.scene, from), to: spectra.indices(self.scene, to) };
        let cross = |workspace: &mut Workspace| {
            workspace.counters.medium_underflows += u64::from(!known);
            std::mem::swap(&mut workspace.interiors, &mut workspace.beyond);
        };
        if from == to || boundary.is_invisible() {
            cross(self.workspace);
            self.ray = surface.spawn(self.ray.direction);
            self.passed += 1;
            return if self.passed < MAX_PASSED { Crossing::Passed } else { Crossing::Ended };
        }
        if DISPERSION && self.parting == Parting::Terminate && boundary.is_dispersive() {
            self.leave_to_hero();
        }
        let entering = surface.geometric.dot(self.ray.direction.as_dvec3()) < 0.0;
        let incidence =
            Incidence::new(self.ray.direction, if entering { surface.geometric } else { -surface.geometric });
        let sample = boundary.sample::<DISPERSION>(&incidence, self.lanes, self.throughput, u);
        self.throughput *= sample.weight;
        self.depth += 1;
        if !sample.refracted {
            self.ray = surface.spawn(incidence.reflected());
            return if self.throughput.is_zero() { Crossing::Ended } else { Crossing::Scattered };
        }
        cross(self.workspace);
        if DISPERSION && self.lanes == Lanes::Shared && boundary.is_dispersive() {
            if let Parting::Ways(ways @ 2..) = self.parting {
                let Workspace { interiors, bundle, .. } = &mut *self.workspace;
                bundle.surface = Some(*surface);
                bundle.directions = std::array::from_fn(|lane| boundary.refracted(&incidence, lane));
                bundle.throughput = self.throughput.lanes();
                (bundle.hero, bundle.ways) = (self.hero, ways);
                (bundle.depth, bundle.passed) = (self.depth, self.passed);
                bundle.interiors.copy_from(interiors);
                return Crossing::Parted(ways);
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

    /// From here on the hero stands for all lanes that shared the ray.
    fn leave_to_hero(&mut self) {
        if self.lanes == Lanes::Shared {
            self.lanes = Lanes::Only(self.hero);
            self.throughput = self.throughput.only(self.hero) * self.lanes_at_start();
        }
    }

    /// Lanes that a path starts with.
    pub fn lanes_at_start(&self) -> f32 {
        if self.parting == Parting::Terminate { BASELINE_LANES as f32 } else { LANES as f32 }
    }

    /// Goes back to where lanes parted and follows the `way`-th of those that go on; `false` if nothing of it is left.
    pub fn set_out(&mut self, way: u8) -> bool {
        let Workspace { interiors, bundle, .. } = &mut *self.workspace;
        let stride = LANES / usize::from(bundle.ways);
        let lane = (bundle.hero + usize::from(way) * stride) % LANES;
        let (Some(surface), Some(direction)) = (bundle.surface, bundle.directions[lane]) else { return false };
        self.ray = surface.spawn(direction);
        self.throughput = SampledSpectrum::new(bundle.throughput).only(lane) * stride as f32;
        (self.lanes, self.parting) = (Lanes::Bundled(lane), Parting::Ways(bundle.ways));
        (self.depth, self.passed) = (bundle.depth, bundle.passed);
        interiors.copy_from(&bundle.interiors);
        !self.throughput.is_zero()
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
                self.throughput *= f32::from(ways);
            }
        }
        if self.parting != Parting::Terminate {
            self.parting = Parting::Ways(1);
        }
        true
    }

    /// The scattering model of an opaque surface, with its normals turned to the path; `None` if nothing is reflected.
    pub fn bsdf<const INTERIORS: bool>(&mut self, object: &Object, surface: &Surface) -> Option<(Bsdf, Frame)> {
        let scene = self.scene;
        let back = surface.geometric.as_vec3().dot(self.ray.direction) > 0.0;
        if back && !object.two_sided {
            return None;
        }
        let spectra = &mut self.workspace.spectra;
        let bsdf = match object.material {
            Material::Diffuse { reflectance } => {
                Bsdf::Diffuse(Diffuse { reflectance: spectra.spectrum(scene, reflectance) })
            }
            Material::Mirror { reflectance } => {
                Bsdf::Mirror(Mirror { reflectance: spectra.spectrum(scene, reflectance) })
            }
            Material::Conductor { eta, k } => {
                let outside = if INTERIORS { self.workspace.interiors.medium(scene) } else { None };
                Bsdf::Conductor(Conductor {
                    eta: spectra.spectrum(scene, eta),
                    k: spectra.spectrum(scene, k),
                    eta_outside: spectra.indices(scene, outside).eta,
                })
            }
            Material::Black | Material::Dielectric { .. } => return None,
        };
        let frame = if back {
            Frame { geometric: -surface.geometric, shading: -surface.shading }
        } else {
            Frame { geometric: surface.geometric, shading: surface.shading }
        };
        Some((bsdf, frame))
    }

    /// Share of light that arrives at `target` (or, without one, from infinity) from a surface in the direction `wi`;
    /// `None` if something is in the way. Boundaries that bend or reflect nothing are no obstacle.
    pub fn visibility<const INTERIORS: bool>(
        &mut self,
        surface: &Surface,
        wi: Vec3,
        target: Option<Vec3>,
    ) -> Option<SampledSpectrum> {
        let mut ray = surface.spawn(wi);
        // Up to a target the ray's direction is the whole way, and distances end at 1.
        let limit = match target {
            Some(target) => {
                ray.direction = target - ray.origin;
                1.0 - 16.0 * f32::EPSILON
            }
            None => f32::INFINITY,
        };
        if !INTERIORS {
            let occluded = self.workspace.counters.occluded(self.scene, &ray, limit);
            return (!occluded).then_some(SampledSpectrum::ONE);
        }
        self.visibility_through_media(ray, limit, target)
    }

    fn visibility_through_media(&mut self, mut ray: Ray, limit: f32, target: Option<Vec3>) -> Option<SampledSpectrum> {
        let Workspace { spectra, interiors, shadow_interiors, beyond, counters, .. } = &mut *self.workspace;
        shadow_interiors.copy_from(interiors);
        let mut transmittance = SampledSpectrum::ONE;
        loop {
            counters.shadow_rays += 1;
            let hit = counters.closest(self.scene, &ray, limit);
            let medium = shadow_interiors.medium(self.scene);
            let distance =
                hit.map_or(if target.is_some() { 1.0 } else { f32::INFINITY }, |h| h.t) * ray.direction.length();
            if let Some(absorption) = medium.and_then(|m| self.scene.media[m.0 as usize].absorption) {
                transmittance *= optics::transmittance(spectra.spectrum(self.scene, absorption), distance);
            }
            let Some(surface) = hit else { return Some(transmittance) };
            let object = &self.scene.objects[surface.object as usize];
            let Material::Dielectric { medium: inside } = object.material else { return None };
            beyond.set_past(shadow_interiors, self.scene, &surface, inside, ray.direction);
            let past = beyond.medium(self.scene);
            if medium != past && spectra.indices(self.scene, medium).eta != spectra.indices(self.scene, past).eta {
                return None;
            }
            std::mem::swap(shadow_interiors, beyond);
            ray = surface.spawn(ray.direction);
            if let Some(target) = target {
                ray.direction = target - ray.origin;
            }
        }
    }

    /// Ends paths that carry next to nothing, and by chance those that carry little; `false` at the end. `u` is a random
    /// number of the vertex that has just been left.
    pub fn survives(&mut self, u: f32) -> bool {
        self.throughput = self.throughput.without_denormals();
        if self.throughput.max() < NEGLIGIBLE {
            return false;
        }
        // The mean over lanes counts a lane that stands for all like all that share the ray. One of a bundle is followed as
        // often as it would be if it were alone.
        let carried = match self.lanes {
            Lanes::Shared | Lanes::Only(_) => self.throughput.mean(),
            Lanes::Bundled(lane) => self.throughput.lane(lane),
        };
        let survival = carried * (1.0 / ROULETTE_THROUGHPUT);
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
