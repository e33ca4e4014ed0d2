//! Forks: where a smooth boundary divides the flux of a path, both parts may be followed instead of one drawn by chance, so
//! that what is seen by a faint reflection, or lit by one, is found by every path. What is left to chance otherwise, which
//! way to go, is most of the noise of glass; what forks cost is a few more rays. A part that carries less than the plan's
//! least share is drawn by chance as ever.
//!
//! Paths fork along specular surfaces alone, up to the first other one: weights against other techniques are functions of
//! the path that they share, and nothing behind that surface is worth more rays than one path has.

use super::interiors::Interiors;
use super::walk::Walk;
use super::workspace::{Branch, Branches};
use crate::geometry::Ray;
use crate::spectrum::SampledSpectrum;

impl Walk<'_> {
    /// Puts a reflection aside that goes on along `ray` with `share` of the flux; see [`Self::resume`].
    pub(super) fn put_aside(&mut self, ray: Ray, share: SampledSpectrum) {
        let mut carried = self.carried;
        carried.throughput *= share;
        let (depth, passed) = (self.depth + 1, self.passed);
        let Branches { stack, pending } = &mut self.workspace.branches;
        let mut interiors =
            if *pending < stack.len() { std::mem::take(&mut stack[*pending].interiors) } else { Interiors::default() };
        interiors.copy_from(&self.workspace.interiors);
        let branch = Branch { ray, carried, depth, passed, interiors };
        if *pending < stack.len() {
            stack[*pending] = branch;
        } else {
            stack.push(branch);
        }
        *pending += 1;
    }

    /// Goes on with what was put aside last; returns `false` if nothing is. Call it until then, when all ways of a bundle
    /// have been followed.
    pub fn resume(&mut self) -> bool {
        let Branches { stack, pending } = &mut self.workspace.branches;
        if *pending == 0 {
            return false;
        }
        *pending -= 1;
        let branch = &stack[*pending];
        self.workspace.interiors.copy_from(&branch.interiors);
        (self.ray, self.carried) = (branch.ray, branch.carried);
        (self.depth, self.passed) = (branch.depth, branch.passed);
        true
    }
}
