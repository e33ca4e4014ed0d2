//! What paths do at surfaces other than smooth boundaries: how the surface scatters, where the path goes on, and what is
//! between it and a light or the camera.

use super::fork::NEVER;
use super::walk::{Crossing, Parting, Walk};
use super::workspace::Workspace;
use crate::bsdf::{
    Bsdf, BsdfSample, Conductor, Diffuse, Ggx, Lanes, Mirror, RoughConductor, RoughDielectric, RoughSample,
};
use crate::geometry::{Frame, Ray};
use crate::optics;
use crate::scene::{
    ConductorMaterial, DielectricMaterial, DiffuseMaterial, Material, MediumId, MirrorMaterial, Object, Parameter,
    Surface,
};
use crate::spectrum::SampledSpectrum;
use glam::Vec3;

/// What a path finds at a surface.
#[allow(clippy::large_enum_variant, reason = "one at a time lives on the stack of a loop: a box would be slower")]
#[derive(Debug)]
pub enum Met {
    /// A boundary that is optically absent; the path is past it.
    Nothing,
    /// Nothing is scattered.
    Black,
    /// A surface, with its normals turned to the path.
    Scatterer(Bsdf, Frame),
}

/// Where a path goes on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bounce {
    /// Nowhere.
    Ended,
    /// Along the ray, which was drawn with this density in solid angle; `None` for a delta distribution.
    Along(Option<f32>),
    /// In a direction for each lane: so many go on, follow them one after the other by [`Walk::set_out`].
    Parted(u8),
}

impl Walk<'_> {
    /// How a surface scatters that is not the smooth boundary of a transparent object.
    pub fn meet<const INTERIORS: bool>(&mut self, object: &Object, surface: &Surface) -> Met {
        let back = surface.geometric.as_vec3().dot(self.ray.direction) > 0.0;
        let frame = if back {
            Frame { geometric: -surface.geometric, shading: -surface.shading }
        } else {
            Frame { geometric: surface.geometric, shading: surface.shading }
        };
        if let Material::Dielectric(DielectricMaterial { medium, alpha }) = object.material {
            return self.meet_rough_dielectric(surface, medium, Ggx::new(alpha), frame);
        }
        if back && !object.two_sided {
            return Met::Black;
        }
        let scene = self.scene;
        let spectra = &mut self.workspace.spectra;
        let bsdf = match object.material {
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
            Material::Black(_) | Material::Dielectric(_) => return Met::Black,
        };
        Met::Scatterer(bsdf, frame)
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
    fn meet_rough_dielectric(&mut self, surface: &Surface, medium: MediumId, ggx: Ggx, frame: Frame) -> Met {
        let (boundary, known) = self.boundary(surface, medium);
        let Some(boundary) = boundary else {
            return if self.pass(surface, known) == Crossing::Passed { Met::Nothing } else { Met::Black };
        };
        if self.parting == Parting::Terminate && boundary.is_dispersive() {
            self.leave_to_hero();
        }
        let may_part = self.lanes == Lanes::Shared && matches!(self.parting, Parting::Ways(2..));
        let parts = may_part && RoughDielectric::parts(&boundary, ggx, &frame, -self.ray.direction);
        let (lanes, hero, odds) = (self.lanes, self.hero, self.odds);
        Met::Scatterer(Bsdf::RoughDielectric(RoughDielectric { boundary, ggx, lanes, hero, odds, parts }), frame)
    }

    /// Scatters the path at a surface.
    pub fn bounce(&mut self, surface: &Surface, bsdf: &Bsdf, frame: &Frame, u: [f32; 3]) -> Bounce {
        if !bsdf.is_specular() {
            self.least_share = NEVER;
        }
        if let Bsdf::RoughDielectric(boundary) = bsdf {
            return self.bounce_off_boundary(surface, boundary, frame, u);
        }
        match bsdf.sample(frame, -self.ray.direction, [u[0], u[1]]) {
            Some(sample) => self.go_on(surface, &sample),
            None => Bounce::Ended,
        }
    }

    fn go_on(&mut self, surface: &Surface, sample: &BsdfSample) -> Bounce {
        self.throughput *= sample.weight;
        self.ray = surface.spawn(sample.wi);
        self.depth += 1;
        Bounce::Along(sample.pdf)
    }

    #[inline(never)]
    fn bounce_off_boundary(
        &mut self,
        surface: &Surface,
        boundary: &RoughDielectric,
        frame: &Frame,
        u: [f32; 3],
    ) -> Bounce {
        match boundary.sample(frame, -self.ray.direction, self.throughput, u) {
            None => Bounce::Ended,
            Some(RoughSample::Together { sample, crosses, odds }) => {
                if crosses {
                    self.cross_again(surface);
                }
                self.odds = odds;
                self.go_on(surface, &sample)
            }
            Some(RoughSample::Parted { directions, weight, own_pdf }) => {
                let Parting::Ways(ways) = self.parting else { return Bounce::Ended };
                self.cross_again(surface);
                self.throughput *= weight;
                self.depth += 1;
                self.part(surface, directions, Some(own_pdf), ways);
                Bounce::Parted(ways)
            }
        }
    }

    /// Crosses a boundary whose other side has been looked at before; shadow rays have used the memory since.
    fn cross_again(&mut self, surface: &Surface) {
        let Some(medium) = self.scene.objects[surface.object as usize].material.medium() else { return };
        let (_, known) = self.boundary(surface, medium);
        self.cross(known);
    }

    /// The density with which the way that has just set out was drawn; `None` for a delta distribution.
    pub fn density_of_way(&self) -> Option<f32> {
        let (Lanes::Bundled(lane), Some(own_pdf)) = (self.lanes, self.workspace.bundle.own_pdf) else { return None };
        Some(own_pdf[lane])
    }

    /// Share of light that arrives at `target` (or, without one, from infinity) from a surface in the direction `wi`;
    /// `None` if something is in the way. Boundaries that bend or reflect nothing are no obstacle. `crosses` is whether `wi`
    /// is past the surface, which is a boundary then.
    pub fn visibility<const INTERIORS: bool>(
        &mut self,
        surface: &Surface,
        wi: Vec3,
        target: Option<Vec3>,
        crosses: bool,
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
        let Workspace { interiors, shadow_interiors, .. } = &mut *self.workspace;
        match self.scene.objects.get(surface.object as usize).map(|object| object.material) {
            Some(Material::Dielectric(DielectricMaterial { medium, .. })) if crosses => {
                shadow_interiors.set_past(interiors, self.scene, surface, medium, wi);
            }
            _ => shadow_interiors.copy_from(interiors),
        }
        self.visibility_through_media(ray, limit, target)
    }

    fn visibility_through_media(&mut self, mut ray: Ray, limit: f32, target: Option<Vec3>) -> Option<SampledSpectrum> {
        let Workspace { spectra, shadow_interiors, beyond, counters, .. } = &mut *self.workspace;
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
            let inside = object.material.medium()?;
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::{fork::Branching, path, techniques::Techniques, workspace::Workspace};
    use crate::sampling::{Sobol, mix};
    use crate::scene::Compiled;
    use crate::spectrum::LANES;
    use std::path::Path;

    /// A prism of flint in front of a lamp and a coloured wall, rough by `alpha`.
    fn prism(alpha: f32) -> Compiled {
        let text = format!(
            r#"{{
            "camera": {{ "type": "perspective", "from": [0.0, 0.02, 0.5], "to": [0, 0, 0], "fov_degrees": 8 }},
            "film": {{ "width": 16, "height": 16 }},
            "materials": {{
                "flint": {{ "type": "dielectric", "ior": {{ "glass": "N-SF66", "extrapolate": "hold" }}, "roughness": {alpha} }},
                "wall": {{ "type": "diffuse", "reflectance": {{ "wavelengths_nm": [400, 700], "values": [0.2, 0.8] }} }}
            }},
            "objects": [
                {{ "shape": {{ "type": "prism", "apex_degrees": 40, "side": 0.1, "length": 0.1 }}, "material": "flint" }},
                {{ "shape": {{ "type": "quad", "origin": [-1, -1, -1], "u": [2, 0, 0], "v": [0, 2, 0] }}, "material": "wall" }},
                {{ "shape": {{ "type": "quad", "origin": [-0.3, -0.1, -0.6], "u": [0.25, 0, 0], "v": [0, 0.2, 0] }},
                   "emission": {{ "illuminant": "D65" }} }}
            ]
        }}"#
        );
        let parsed = crate::scene::description::parse_str(&text, Path::new("prism.json")).unwrap();
        crate::scene::compile(&parsed.description).unwrap()
    }

    /// Ways of treating lanes.
    #[derive(Debug, Clone, Copy, PartialEq)]
    enum Treatment {
        /// One is followed from the start and stands for all.
        Single,
        /// They stay together wherever a rough surface lets them.
        Together,
        /// They may part at facets.
        Parting,
    }

    /// Mean and variance of what paths bring: of all lanes together, and of the long waves' lead over the short ones.
    fn moments(compiled: &Compiled, treatment: Treatment, n: u64) -> [[f64; 2]; 2] {
        let scene = &compiled.scene;
        let mut workspace = Workspace::new(scene);
        let (mut sum, mut squares) = ([0.0; 2], [0.0; 2]);
        for i in 0..n {
            // Independent numbers: each path has a sequence of its own.
            let sobol = Sobol::new(mix(i ^ (treatment as u64) << 40));
            let u = sobol.group(0, 0);
            let ray = scene.camera.ray([16.0 * u[0], 16.0 * u[1]], [0.5; 2]);
            workspace.spectra.begin(scene.wavelengths.sample(u[2]));
            workspace.interiors.reset(&[]);
            let hero = (u[5] * LANES as f32) as usize;
            let ways = if treatment == Treatment::Parting { 8 } else { 1 };
            let branching = Branching { parting: Parting::Ways(ways), least_share: NEVER };
            let mut walk = Walk::start(scene, &mut workspace, ray, (hero, branching), (sobol, 0));
            if treatment == Treatment::Single {
                walk.leave_to_hero();
            }
            let radiance = path::radiance::<true, true>(&mut walk, &Techniques::Path, 12);
            let lanes = radiance.lanes().map(f64::from);
            let (short, long): (f64, f64) = (lanes[..4].iter().sum(), lanes[4..].iter().sum());
            for (k, value) in [short + long, long - short].into_iter().enumerate() {
                sum[k] += value;
                squares[k] += value * value;
            }
        }
        let n = n as f64;
        [0, 1].map(|k| [sum[k] / n, squares[k] / n - sum[k] * sum[k] / (n * n)])
    }

    /// Lanes that share rays through rough glass bring what each brings alone. Most of the variance is that of finding the
    /// lamp, which all share; that of colour is less by far, also where lobes hardly overlap any more, and less still where
    /// the lanes part then.
    #[test]
    fn lanes_together_and_alone() {
        let n = 30_000;
        for (alpha, together, parting) in
            [(0.4, 100.0, 100.0), (0.1, 50.0, 50.0), (0.02, 7.0, 20.0), (0.002, 6.0, 40.0)]
        {
            let compiled = prism(alpha);
            let single = moments(&compiled, Treatment::Single, n);
            for (treatment, gain) in [(Treatment::Together, together), (Treatment::Parting, parting)] {
                let all = moments(&compiled, treatment, n);
                for (k, gain) in [0.9, gain].into_iter().enumerate() {
                    let ([mean, variance], [single, single_variance]) = (all[k], single[k]);
                    let sigma = ((variance + single_variance) / n as f64).sqrt();
                    let ratio = single_variance / variance;
                    println!(
                        "α = {alpha}, {treatment:?}: {mean:.4}, alone {single:.4} ± {sigma:.4}; variance / {ratio:.2}"
                    );
                    assert!((mean - single).abs() < 4.0 * sigma, "{alpha} {treatment:?}: {mean} {single} ± {sigma}");
                    assert!(ratio > gain, "{alpha} {treatment:?}: variance {variance}, alone {single_variance}");
                }
            }
        }
    }
}
