//! What camera paths and light paths have in common: a ray that carries lanes through surfaces and media.

use super::workspace::Workspace;
use crate::bsdf::{Bsdf, Conductor, Dielectric, Diffuse, Lanes, Mirror};
use crate::geometry::{Frame, Ray};
use crate::optics;
use crate::sampling::{DIMENSIONS, Sobol};
use crate::scene::{Material, MediumId, Object, Scene, Surface};
use crate::spectrum::{LANES, SampledSpectrum};
use glam::Vec3;

/// Throughput below which a path ends, by a rule instead of by chance: 2⁻¹⁰⁰.
const NEGLIGIBLE: f32 = 1.0 / (1u128 << 100) as f32;
/// Scattering events before Russian roulette.
const ROULETTE_DEPTH: u32 = 4;

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
    /// Whether lanes still share the ray. Changed in [`Self::meet_dielectric`] alone.
    pub lanes: Lanes,
    /// The lane that goes on where lanes part.
    pub hero: usize,
    /// Scattering events so far.
    pub depth: u32,
    /// Boundaries crossed so far that did nothing.
    pub passed: u32,
    /// Random numbers: those of vertex v are group v + 1.
    pub sobol: Sobol,
    /// Index of the path in its sequence.
    pub index: u64,
}

/// What a dielectric surface did.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Crossing {
    /// Nothing: the volume on the other side is the same, or hidden by one of higher priority.
    Passed,
    /// Reflected or refracted.
    Scattered,
    /// Nothing is left of the path.
    Ended,
}

impl<'a> Walk<'a> {
    /// A path that starts along a ray, with all lanes, in what the workspace's interiors say.
    pub fn start(
        scene: &'a Scene,
        workspace: &'a mut Workspace,
        ray: Ray,
        hero: usize,
        (sobol, index): (Sobol, u64),
    ) -> Self {
        let (throughput, lanes) = (SampledSpectrum::ONE, Lanes::Shared);
        Self { scene, workspace, ray, throughput, lanes, hero, depth: 0, passed: 0, sobol, index }
    }

    /// The eight random numbers of the current vertex.
    pub fn random(&self) -> [f32; DIMENSIONS] {
        self.sobol.group(self.index, self.depth + 1)
    }

    /// The first surface ahead; light is absorbed on the way there.
    #[inline]
    pub fn advance<const INTERIORS: bool>(&mut self) -> Option<Surface> {
        self.workspace.counters.rays += 1;
        let surface = self.scene.closest(&self.ray, f32::INFINITY);
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
        let Workspace { spectra, interiors, beyond, counters, .. } = &mut *self.workspace;
        let known = beyond.set_past(interiors, self.scene, surface, medium, self.ray.direction);
        let (from, to) = (interiors.medium(self.scene), beyond.medium(self.scene));
        let boundary = Dielectric { from: spectra.indices(self.scene, from), to: spectra.indices(self.scene, to) };
        let mut cross = || {
            counters.medium_underflows += u64::from(!known);
            std::mem::swap(interiors, beyond);
        };
        if from == to || boundary.is_invisible() {
            cross();
            self.ray = surface.spawn(self.ray.direction);
            self.passed += 1;
            return if self.passed < MAX_PASSED { Crossing::Passed } else { Crossing::Ended };
        }
        let entering = surface.geometric.dot(self.ray.direction.as_dvec3()) < 0.0;
        let normal = if entering { surface.geometric } else { -surface.geometric };
        let sample =
            boundary.sample::<DISPERSION>(self.ray.direction, normal, self.lanes, self.hero, self.throughput, u);
        self.throughput *= sample.weight;
        if sample.parts_lanes && self.lanes == Lanes::Shared {
            self.lanes = Lanes::Only(self.hero);
            self.throughput = self.throughput.only(self.hero) * LANES as f32;
        }
        if sample.refracted {
            cross();
        }
        self.depth += 1;
        self.ray = surface.spawn(sample.direction);
        if self.throughput.is_zero() { Crossing::Ended } else { Crossing::Scattered }
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
            self.workspace.counters.rays += 1;
            return (!self.scene.occluded(&ray, limit)).then_some(SampledSpectrum::ONE);
        }
        self.visibility_through_media(ray, limit, target)
    }

    fn visibility_through_media(&mut self, mut ray: Ray, limit: f32, target: Option<Vec3>) -> Option<SampledSpectrum> {
        let Workspace { spectra, interiors, shadow_interiors, beyond, counters } = &mut *self.workspace;
        shadow_interiors.copy_from(interiors);
        let mut transmittance = SampledSpectrum::ONE;
        loop {
            counters.rays += 1;
            let hit = self.scene.closest(&ray, limit);
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
        if self.depth < ROULETTE_DEPTH {
            return true;
        }
        // The mean over lanes counts a parted lane, which stands for eight, like eight that share the ray.
        let survival = self.throughput.mean().min(1.0);
        if u >= survival {
            return false;
        }
        self.throughput *= 1.0 / survival;
        true
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
