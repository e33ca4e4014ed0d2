//! Forks: where a smooth boundary divides the flux of a path, both parts may be followed instead of one drawn by chance, so
//! that what is seen by a faint reflection, or lit by one, is found by every path. What is left to chance otherwise, which
//! way to go, is most of the noise of glass; what forks cost is a few more rays. A part that carries less than the plan's
//! least share is drawn by chance as ever.
//!
//! Paths fork along specular surfaces alone, up to the first other one: weights against other techniques are functions of
//! the path that they share, and nothing behind that surface is worth more rays than one path has.

use super::walk::{Parting, Walk};
use super::workspace::Interiors;
use crate::bsdf::Lanes;
use crate::geometry::Ray;
use crate::spectrum::SampledSpectrum;

/// A least share that no part has: paths never fork.
pub const NEVER: f32 = 2.0;

/// Where a path branches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branching {
    /// What becomes of lanes where a refraction sends them apart.
    pub parting: Parting,
    /// The path forks where both parts carry at least this share of what it started with.
    pub least_share: f32,
}

/// A reflection that is to be followed later.
#[derive(Debug)]
struct Branch {
    ray: Ray,
    throughput: SampledSpectrum,
    lanes: Lanes,
    parting: Parting,
    least_share: f32,
    depth: u32,
    passed: u32,
    interiors: Interiors,
}

/// What is to be followed later, the last first. Memory is kept from path to path.
#[derive(Debug, Default)]
pub struct Branches {
    stack: Vec<Branch>,
    pending: usize,
}

impl Walk<'_> {
    /// Share of what the path started with that it carries. The mean over lanes counts a lane that stands for all like all
    /// that share the ray. One of a bundle counts as it would if it were alone.
    pub fn carried(&self) -> f32 {
        match (self.lanes, self.parting) {
            (Lanes::Bundled(_), Parting::Ways(ways)) => self.throughput.mean() * f32::from(ways),
            _ => self.throughput.mean(),
        }
    }

    /// Whether both parts of a path are followed, of which one is the share `reflected` of its flux.
    pub fn forks(&self, reflected: f32) -> bool {
        self.least_share < NEVER && self.carried() * reflected.min(1.0 - reflected) >= self.least_share
    }

    /// Puts a reflection aside that goes on along `ray` with `share` of the flux; see [`Self::resume`].
    pub fn put_aside(&mut self, ray: Ray, share: SampledSpectrum) {
        let throughput = self.throughput * share;
        let &mut Self { lanes, parting, least_share, passed, .. } = self;
        let depth = self.depth + 1;
        let Branches { stack, pending } = &mut self.workspace.branches;
        let mut interiors =
            if *pending < stack.len() { std::mem::take(&mut stack[*pending].interiors) } else { Interiors::default() };
        interiors.copy_from(&self.workspace.interiors);
        let branch = Branch { ray, throughput, lanes, parting, least_share, depth, passed, interiors };
        if *pending < stack.len() {
            stack[*pending] = branch;
        } else {
            stack.push(branch);
        }
        *pending += 1;
    }

    /// Goes on with what was put aside last; `false` if nothing is. To be called until then, when all ways of a bundle
    /// have been followed.
    pub fn resume(&mut self) -> bool {
        let Branches { stack, pending } = &mut self.workspace.branches;
        if *pending == 0 {
            return false;
        }
        *pending -= 1;
        let branch = &stack[*pending];
        self.workspace.interiors.copy_from(&branch.interiors);
        self.ray = branch.ray;
        self.throughput = branch.throughput;
        (self.lanes, self.parting, self.least_share) = (branch.lanes, branch.parting, branch.least_share);
        (self.depth, self.passed) = (branch.depth, branch.passed);
        // Only rough surfaces change the odds, and nothing forks behind one.
        self.odds = SampledSpectrum::ONE;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::{path, techniques::Techniques, workspace::Workspace};
    use crate::sampling::{Sobol, mix};
    use crate::scene::Compiled;
    use std::path::Path;

    /// A ball of glass with a core of another in a furnace.
    fn furnace(core: &str) -> Compiled {
        let text = format!(
            r#"{{
            "camera": {{ "type": "perspective", "from": [0, 0, 5], "to": [0, 0, 0], "fov_degrees": 25 }},
            "film": {{ "width": 16, "height": 16 }},
            "materials": {{
                "shell": {{ "type": "dielectric", "ior": {{ "glass": "SF11" }} }},
                "core": {{ "type": "dielectric", "ior": {core}, "priority": 1 }}
            }},
            "objects": [
                {{ "shape": {{ "type": "sphere", "center": [0, 0, 0], "radius": 1 }}, "material": "shell" }},
                {{ "shape": {{ "type": "sphere", "center": [0.1, 0.2, 0], "radius": 0.5 }}, "material": "core" }}
            ],
            "environment": {{ "radiance": 1 }}
        }}"#
        );
        let parsed = crate::scene::description::parse_str(&text, Path::new("furnace.json")).unwrap();
        crate::scene::compile(&parsed.description).unwrap()
    }

    /// Parts make a whole: whatever a path forks for, its branches together bring what one path would, here 1 in every lane
    /// that stands for itself, and the mean of 1 where one stands for others.
    #[test]
    fn branches_bring_what_one_path_does() {
        for core in [r#"{ "glass": "N-BK7" }"#, "2.4"] {
            let compiled = furnace(core);
            let scene = &compiled.scene;
            let mut workspace = Workspace::new(scene);
            let mut rays = [0; 2];
            for (trial, least_share) in [NEVER, 1.0 / 256.0].into_iter().enumerate() {
                for i in 0..4000 {
                    let sobol = Sobol::new(mix(i));
                    let u = sobol.group(0, 0);
                    let ray = scene.camera.ray([16.0 * u[0], 16.0 * u[1]], [0.5; 2]);
                    workspace.spectra.begin(scene.wavelengths.sample(u[2]));
                    workspace.interiors.reset(&[]);
                    workspace.counters = Default::default();
                    let branching = Branching { parting: Parting::Ways(8), least_share };
                    let mut walk = Walk::start(scene, &mut workspace, ray, (0, branching), (sobol, 0));
                    let radiance = path::radiance::<true, true>(&mut walk, &Techniques::Path, 4096);
                    rays[trial] += workspace.counters.rays;
                    let radiance = radiance * scene.radiance_scale as f32;
                    assert!((radiance.mean() - 1.0).abs() < 1e-4, "{core} {least_share} {i}: {radiance:?}");
                    assert_eq!(workspace.branches.pending, 0);
                }
            }
            assert!(rays[1] > 2 * rays[0], "paths fork: {rays:?} rays");
        }
    }
}
