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
