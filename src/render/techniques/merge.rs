//! Progressive photon merging \[HachisukaJensen2009\], \[KnausZwicker2011\] for what no other technique finds: caustics seen
//! through glass or in a mirror, see [`super::table`].
//!
//! Each pass traces its photons and one camera path a pixel at the same eight wavelengths, so that lane merges with lane and
//! nothing is blurred in wavelength. The radius shrinks from pass to pass: the mean of all passes converges, with an error
//! that is in part a blur by the radius.

use super::light::{Arrival, Collector, First, Start};
use super::photons::{Photon, PhotonMap};
use super::table::Techniques;
use crate::render::paths::{Encounter, Layout, Scattering, Vertex, Walk};
use crate::spectrum::SampledSpectrum;
use std::f32::consts::FRAC_2_PI;

/// Speed of shrinking: r²ᵢ₊₁ = r²ᵢ (i + α) / (i + 1).
const ALPHA: f64 = 2.0 / 3.0;
/// The blur of the mean over passes falls with r², and so with their number to this power.
pub const BLUR_DECAY: f64 = 1.0 - ALPHA;

/// How photons are merged.
#[derive(Debug, Clone)]
pub struct Merging {
    /// Radius of the first pass.
    pub radius: f32,
    /// Photon paths in each pass.
    pub photon_paths: u64,
}

/// Collects the photons of light paths.
#[derive(Debug, Default)]
pub struct PhotonCollector {
    /// Photons collected so far.
    pub photons: Vec<Photon>,
}

impl Collector for PhotonCollector {
    fn leave<const INTERIORS: bool>(&mut self, _: &mut Walk, _: &Start) {}

    fn arrive<const INTERIORS: bool>(&mut self, walk: &mut Walk, start: &Start, arrival: Arrival) {
        let vertex = arrival.vertex;
        // On rough surfaces camera paths find all that they can.
        let has_extent = walk.scene.light(start.light).has_extent();
        if vertex.bsdf.is_rough() && (arrival.first != First::Specular || has_extent) {
            return;
        }
        self.photons.push(Photon {
            position: vertex.surface.point,
            normal: vertex.frame.geometric.as_vec3(),
            wi: vertex.wo,
            power: (start.power * walk.carried.throughput).lanes(),
            lane: walk.carried.lanes.single().map(|lane| lane as u8),
            depth: walk.depth,
        });
    }
}

/// Follows specular surfaces to the first other one, along every way that lanes take, and calls `visit` there. Surfaces that
/// are seen directly are not visited, nor rough ones where there is nothing to merge.
pub fn follow_specular<const INTERIORS: bool>(
    walk: &mut Walk,
    techniques: &Techniques,
    max_depth: u32,
    visit: &mut impl FnMut(&mut Walk, &Vertex),
) {
    while let Some(surface) = walk.advance::<INTERIORS>() {
        if walk.depth >= max_depth {
            return;
        }
        let encounter = walk.encounter::<INTERIORS>(&surface);
        let vertex = match &encounter {
            Encounter::Vertex(vertex) => vertex,
            Encounter::Passed => continue,
            Encounter::Absorbed => return,
        };
        if !vertex.bsdf.is_specular() {
            if walk.depth > 0 && (!vertex.bsdf.is_rough() || techniques.merges_on_rough(walk.scene)) {
                visit(walk, vertex);
            }
            return;
        }
        let numbers = walk.numbers(Layout::Plain);
        match walk.scatter(vertex, &numbers) {
            Scattering::Ended => return,
            Scattering::Along(_) => {}
            Scattering::Parted => {
                walk.each_way(|walk| follow_specular::<INTERIORS>(walk, techniques, max_depth, visit));
                return;
            }
        }
        if !walk.survives(numbers.roulette) {
            return;
        }
    }
}

impl Merging {
    /// Returns the radius of a pass; passes count from 0.
    pub fn radius_of(&self, pass: u64) -> f32 {
        let shrunk: f64 = (1..=pass).map(|i| (i as f64 + ALPHA) / (i as f64 + 1.0)).product();
        self.radius * shrunk.sqrt() as f32
    }
}

impl PhotonMap {
    /// Radiance towards the path by the photons around a vertex: Σ f Φ K / N, with Epanechnikov's kernel
    /// K = 2 / (π r²) (1 − d² / r²).
    pub fn gather(&self, vertex: &Vertex, walk: &Walk, max_depth: u32) -> SampledSpectrum {
        let wo = vertex.wo;
        let own_lane = walk.carried.lanes.single().map(|lane| lane as u8);
        let normal = vertex.frame.geometric.as_vec3();
        let mut sum = SampledSpectrum::ZERO;
        self.near(vertex.surface.point, |photon, distance2| {
            let other_lane = matches!((photon.lane, own_lane), (Some(a), Some(b)) if a != b);
            // Through a rough boundary light comes from its other side.
            let through = vertex.bsdf.transmits() && photon.normal.dot(normal) < 0.0;
            let side = if through { -normal } else { normal };
            if other_lane
                || walk.depth + 1 + photon.depth > max_depth
                || !photon.lies_on(vertex.surface.point, side, self.radius())
            {
                return;
            }
            // `eval` holds the cosine to the shading normal; photons arrive by the geometric one.
            let cos = side.dot(photon.wi);
            if cos <= 0.0 {
                return;
            }
            let mut f = vertex.bsdf.eval(&vertex.frame, wo, photon.wi) * (1.0 / cos);
            if through {
                f *= vertex.bsdf.radiance_change(true);
            }
            sum += f * SampledSpectrum::new(photon.power) * (1.0 - distance2 / (self.radius() * self.radius()));
        });
        sum * (FRAC_2_PI / (self.radius() * self.radius() * self.paths() as f32))
    }
}
