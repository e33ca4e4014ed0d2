//! From a surface on a path to a vertex: how it scatters at the path's wavelengths.

use super::vertex::{Encounter, Vertex};
use super::walk::Walk;
use super::workspace::Workspace;
use crate::bsdf::{Bsdf, Conductor, Dielectric, Diffuse, Ggx, Lanes, Mirror, Parting, RoughConductor, RoughDielectric};
use crate::geometry::Frame;
use crate::scene::{
    ConductorMaterial, DielectricMaterial, DiffuseMaterial, Material, MirrorMaterial, Parameter, Surface,
};
use glam::Vec3;

/// Absent boundaries that a path may cross: they do not count as events, and no path may go on for ever.
const MAX_PASSED: u32 = 1 << 20;

impl Walk<'_> {
    /// Meets the surface at the end of the ray. Boundaries that are optically absent are passed. At others the workspace's
    /// `beyond` is what lies past them, up to the next shadow ray.
    #[inline(always)]
    pub fn encounter<'s, const INTERIORS: bool>(&mut self, surface: &'s Surface) -> Encounter<'s> {
        let object = self.scene.object(surface.object);
        let wo = -self.ray.direction;
        let focuses = object.material.focuses();
        if let Material::Dielectric(DielectricMaterial { medium, alpha }) = object.material {
            let Workspace { spectra, interiors, beyond, .. } = &mut *self.workspace;
            let entered = beyond.set_past(interiors, self.scene, surface, medium, self.ray.direction);
            let (from, to) = (interiors.medium(self.scene), beyond.medium(self.scene));
            // The volume on the other side is the same, or hidden by one of higher priority.
            if from == to {
                return self.pass(surface, entered);
            }
            let [from, to] = spectra.both_indices(self.scene, [from, to]);
            // The boundary is optically absent.
            if from.eta == to.eta {
                return self.pass(surface, entered);
            }
            if self.carried.parting == Parting::Terminate && (from.dispersive || to.dispersive) {
                self.carried.leave_to_hero();
            }
            let frame = turned(surface, surface.geometric.dot(self.ray.direction.as_dvec3()) >= 0.0);
            if alpha == 0.0 {
                let bsdf = Bsdf::Dielectric(Dielectric { from: *from, to: *to });
                return Encounter::Vertex(Vertex { surface, bsdf, frame, wo, focuses, entered });
            }
            let boundary = Dielectric { from: *from, to: *to };
            let bsdf = self.rough_dielectric(boundary, Ggx::new(alpha), &frame, wo);
            return Encounter::Vertex(Vertex { surface, bsdf, frame, wo, focuses, entered });
        }
        let back = surface.geometric.as_vec3().dot(self.ray.direction) > 0.0;
        if back && !object.two_sided {
            return Encounter::Absorbed;
        }
        match self.opaque::<INTERIORS>(object.material) {
            Some(bsdf) => {
                let frame = turned(surface, back);
                Encounter::Vertex(Vertex { surface, bsdf, frame, wo, focuses, entered: true })
            }
            None => Encounter::Absorbed,
        }
    }

    /// Evaluates an opaque material at the path's wavelengths; `None` if it is black.
    #[inline(always)]
    fn opaque<const INTERIORS: bool>(&mut self, material: Material) -> Option<Bsdf> {
        let scene = self.scene;
        let spectra = &mut self.workspace.spectra;
        Some(match material {
            Material::Diffuse(DiffuseMaterial { reflectance }) => {
                Bsdf::Diffuse(Diffuse { reflectance: spectra.parameter(scene, reflectance) })
            }
            Material::Mirror(MirrorMaterial { reflectance }) => {
                Bsdf::Mirror(Mirror { reflectance: spectra.parameter(scene, reflectance) })
            }
            Material::Conductor(ConductorMaterial { eta, k, alpha }) => {
                let facets = self.conductor::<INTERIORS>(eta, k);
                match alpha {
                    0.0 => Bsdf::Conductor(facets),
                    alpha => Bsdf::RoughConductor(RoughConductor { facets, ggx: Ggx::new(alpha) }),
                }
            }
            Material::Black(_) | Material::Dielectric(_) => return None,
        })
    }

    fn conductor<const INTERIORS: bool>(&mut self, eta: Parameter, k: Parameter) -> Conductor {
        let Workspace { spectra, interiors, .. } = &mut *self.workspace;
        let outside = if INTERIORS { interiors.medium(self.scene) } else { None };
        Conductor {
            eta: spectra.parameter(self.scene, eta),
            k: spectra.parameter(self.scene, k),
            eta_outside: spectra.indices(self.scene, outside).eta,
        }
    }

    #[inline(never)]
    fn rough_dielectric(&self, boundary: Dielectric, ggx: Ggx, frame: &Frame, wo: Vec3) -> Bsdf {
        let carried = &self.carried;
        let may_part = carried.lanes == Lanes::Shared && carried.parting.keeps_several();
        let parts = may_part && RoughDielectric::parts(&boundary, ggx, frame, wo);
        let (lanes, hero, odds) = (carried.lanes, carried.hero, carried.odds);
        Bsdf::RoughDielectric(RoughDielectric { boundary, ggx, lanes, hero, odds, parts })
    }

    /// Takes the path into the workspace's `beyond`.
    pub(super) fn cross(&mut self, entered: bool) {
        let Workspace { interiors, beyond, counters, .. } = &mut *self.workspace;
        counters.medium_underflows += u64::from(!entered);
        std::mem::swap(interiors, beyond);
    }

    /// Goes on through a boundary that is optically absent.
    fn pass<'s>(&mut self, surface: &'s Surface, entered: bool) -> Encounter<'s> {
        self.cross(entered);
        self.ray = surface.spawn(self.ray.direction);
        self.passed += 1;
        if self.passed < MAX_PASSED { Encounter::Passed } else { Encounter::Absorbed }
    }
}

/// The normals of a surface, turned round for a path that meets its back.
fn turned(surface: &Surface, back: bool) -> Frame {
    match back {
        true => Frame { geometric: -surface.geometric, shading: -surface.shading },
        false => Frame { geometric: surface.geometric, shading: surface.shading },
    }
}
