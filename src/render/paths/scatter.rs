//! The step from a vertex to the next ray, the same for all kinds of path.

use super::numbers::VertexNumbers;
use super::vertex::{Scattering, Vertex};
use super::walk::{TransportMode, Walk};
use super::workspace::Workspace;
use crate::bsdf::{Density, NEVER, Outgoing, Parting};
use crate::geometry::Frame;
use crate::scene::Surface;
use crate::spectrum::{LANES, SampledSpectrum};
use glam::Vec3;

impl Walk<'_> {
    /// Scatters the path at a vertex.
    #[inline]
    pub fn scatter(&mut self, vertex: &Vertex, numbers: &VertexNumbers) -> Scattering {
        let &Vertex { surface, ref bsdf, ref frame, wo, .. } = vertex;
        // Weights against other techniques are functions of the path up to here: behind it no path forks.
        if !bsdf.is_specular() {
            self.carried.least_share = NEVER;
        }
        let without_shading;
        let frame = match self.mode {
            TransportMode::Radiance => frame,
            TransportMode::Importance => {
                self.carried.throughput *= adjoint(frame, wo);
                without_shading = frame.without_shading();
                &without_shading
            }
        };
        let sample = bsdf.sample(frame, wo, &self.carried, numbers.direction, numbers.choice);
        let Some(sample) = &sample else { return Scattering::Ended };
        if let Some(aside) = &sample.aside {
            self.put_aside(surface.spawn(aside.wi), aside.weight);
        }
        if sample.crosses {
            self.cross_at(vertex);
        }
        if let Some(odds) = sample.odds {
            self.carried.odds = odds;
        }
        self.carried.throughput *= sample.weight;
        self.depth += 1;
        match &sample.wi {
            Outgoing::Shared(wi) => {
                self.ray = surface.spawn(*wi);
                Scattering::Along(sample.pdf.shared())
            }
            Outgoing::PerLane(directions) => {
                let own_pdf = if let Density::PerLane(own_pdf) = sample.pdf { Some(own_pdf) } else { None };
                self.part(surface, directions, own_pdf)
            }
        }
    }

    /// Enters what is past the boundary at a vertex.
    fn cross_at(&mut self, vertex: &Vertex) {
        // At vertices that are not specular shadow rays have used the memory since the encounter.
        if !vertex.bsdf.is_specular()
            && let Some(medium) = self.scene.object(vertex.surface.object).material.medium()
        {
            let direction = self.ray.direction;
            let Workspace { interiors, beyond, .. } = &mut *self.workspace;
            beyond.set_past(interiors, self.scene, vertex.surface, medium, direction);
        }
        self.cross(vertex.entered);
    }

    /// Parts the lanes at a vertex, each into a direction of its own; or leaves them to the hero where one alone goes on.
    fn part(
        &mut self,
        surface: &Surface,
        directions: &[Option<Vec3>; LANES],
        own_pdf: Option<SampledSpectrum>,
    ) -> Scattering {
        let ways = match self.carried.parting {
            Parting::Ways(ways @ 2..) => ways,
            Parting::Ways(_) | Parting::Terminate => {
                self.carried.leave_to_hero();
                let Some(wi) = directions[self.carried.hero] else { return Scattering::Ended };
                self.ray = surface.spawn(wi);
                return Scattering::Along(own_pdf.map(|pdf| pdf.lane(self.carried.hero)));
            }
        };
        let Workspace { interiors, bundle, .. } = &mut *self.workspace;
        bundle.surface = Some(*surface);
        (bundle.directions, bundle.own_pdf) = (*directions, own_pdf);
        bundle.throughput = self.carried.throughput;
        (bundle.hero, bundle.ways) = (self.carried.hero, ways);
        (bundle.depth, bundle.passed) = (self.depth, self.passed);
        bundle.interiors.copy_from(interiors);
        Scattering::Parted
    }
}

/// Correction of light paths where shading and geometric normal differ. Camera paths see a diffuse surface as
/// f |wi·n_s| whatever side of n_s they come from; the adjoint of that is f |wo·n_s| |wi·n_g| / |wo·n_g| with wo towards
/// the light [Veach1997, 5.3]. So light arrives by n_s, which is this factor, and leaves by n_g.
pub fn adjoint(frame: &Frame, wo: Vec3) -> f32 {
    let geometric = frame.geometric.as_vec3();
    if geometric == frame.shading {
        return 1.0;
    }
    let factor = wo.dot(frame.shading).max(0.0) / wo.dot(geometric).abs();
    if factor.is_finite() { factor } else { 0.0 }
}
