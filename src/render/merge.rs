//! Progressive photon merging \[HachisukaJensen2009\], \[KnausZwicker2011\] for what no other technique finds: caustics seen
//! through glass or in a mirror, see [`super::techniques`].
//!
//! Each pass traces its photons and one camera path a pixel at the same eight wavelengths, so that lane merges with lane and
//! nothing is blurred in wavelength. The radius shrinks from pass to pass: the mean of all passes converges, with an error
//! that is in part a blur by the radius.

use super::fork::Branching;
use super::light::{Arrival, Collector, First, LightTracer, Start};
use super::passes::{tile_pixels, tiles};
use super::scatter::{Bounce, Met};
use super::techniques::Techniques;
use super::walk::{Crossing, Parting, Walk};
use super::{Renderer, path};
use crate::bsdf::{Bsdf, Indices, Lanes};
use crate::film::{Film, LIGHT_REPLICATES, Splat};
use crate::geometry::Frame;
use crate::sampling::{Sobol, mix};
use crate::scene::{DielectricMaterial, Material, Surface};
use crate::spectrum::{SampledSpectrum, Wavelengths};
use rayon::prelude::*;
use std::f32::consts::FRAC_2_PI;

use super::photons::{Photon, PhotonMap};
use super::workspace::{Counters, Workspace};

/// First radius, in widths of a pixel where photons are seen.
const FIRST_RADIUS_PIXELS: f32 = 3.0;
/// Speed of shrinking: r²ᵢ₊₁ = r²ᵢ (i + α) / (i + 1).
const ALPHA: f64 = 2.0 / 3.0;
/// The blur of the mean over passes falls with r², and so with their number to this power.
pub const BLUR_DECAY: f64 = 1.0 - ALPHA;
/// Camera paths that look for surfaces to merge on before the first pass, along each side of the picture.
const PROBES: u32 = 96;
/// Share of the pixels without such a surface so far that are looked at again in a pass.
const SECOND_LOOK: f32 = 0.125;
/// Passes that look at all pixels.
const FULL_PASSES: u64 = 2;
/// Ways that photons take where lanes part: each serves many pixels.
const PHOTON_WAYS: u8 = 4;
/// Photon paths in a block.
const BLOCK: u64 = 1024;

/// How photons are merged.
#[derive(Debug, Clone)]
pub struct Merging {
    /// Radius of the first pass.
    radius: f32,
    /// Photon paths in each pass.
    pub photon_paths: u64,
}

/// What passes have found out so far.
#[derive(Debug, Default)]
pub struct MergeState {
    /// Pixels in which there was something to merge on.
    seen: Vec<bool>,
}

/// Photons, from paths of light.
struct PhotonCollector {
    photons: Vec<Photon>,
}

impl Collector for PhotonCollector {
    fn leave<const INTERIORS: bool>(&mut self, _: &mut Walk, _: &Start) {}

    fn arrive<const INTERIORS: bool>(&mut self, walk: &mut Walk, start: &Start, arrival: Arrival) {
        // On rough surfaces camera paths find all that they can.
        let has_extent = walk.scene.lights[start.light as usize].has_extent();
        if arrival.bsdf.is_rough() && (arrival.first != First::Specular || has_extent) {
            return;
        }
        self.photons.push(Photon {
            position: arrival.surface.point,
            normal: arrival.frame.geometric.as_vec3(),
            wi: -walk.ray.direction,
            power: (start.power * walk.throughput).lanes(),
            lane: match walk.lanes {
                Lanes::Shared => None,
                Lanes::Bundled(lane) | Lanes::Only(lane) => Some(lane as u8),
            },
            depth: walk.depth,
        });
    }
}

/// A surface that is not specular and that a camera path has reached along specular ones.
struct Vertex<'a> {
    surface: &'a Surface,
    bsdf: &'a Bsdf,
    frame: &'a Frame,
}

/// Follows specular surfaces to the first other one, along every way that lanes take; those seen directly are not visited,
/// nor rough ones where there is nothing to merge.
fn follow_specular<const DISPERSION: bool, const INTERIORS: bool>(
    walk: &mut Walk,
    techniques: &Techniques,
    max_depth: u32,
    visit: &mut impl FnMut(&mut Walk, Vertex),
) {
    while let Some(surface) = walk.advance::<INTERIORS>() {
        if walk.depth >= max_depth {
            return;
        }
        let object = &walk.scene.objects[surface.object as usize];
        let u = walk.random();
        if let Material::Dielectric(DielectricMaterial { medium, alpha: 0.0 }) = object.material {
            match walk.meet_dielectric::<DISPERSION>(&surface, medium, u[2]) {
                Crossing::Passed => continue,
                Crossing::Scattered => {}
                Crossing::Ended => return,
                Crossing::Parted(ways) => {
                    for way in 0..ways {
                        if walk.set_out(way) {
                            follow_specular::<DISPERSION, INTERIORS>(walk, techniques, max_depth, visit);
                        }
                    }
                    return;
                }
            }
        } else {
            let (bsdf, frame) = match walk.meet::<INTERIORS>(object, &surface) {
                Met::Scatterer(bsdf, frame) => (bsdf, frame),
                Met::Nothing => continue,
                Met::Black => return,
            };
            if !bsdf.is_specular() {
                if walk.depth > 0 && (!bsdf.is_rough() || techniques.merges_on_rough(walk.scene)) {
                    visit(walk, Vertex { surface: &surface, bsdf: &bsdf, frame: &frame });
                }
                return;
            }
            if walk.bounce(&surface, &bsdf, &frame, [u[0], u[1], u[2]]) == Bounce::Ended {
                return;
            }
        }
        if !walk.survives(u[3]) {
            return;
        }
    }
}

impl<const DISPERSION: bool, const INTERIORS: bool> Renderer<'_, DISPERSION, INTERIORS> {
    /// How to merge, if the camera sees any diffuse surface through or in something specular.
    pub fn probe_merging(&self) -> (Option<Merging>, Counters) {
        let mut workspace = Workspace::new(self.scene);
        let (width, height) = (self.film.width, self.film.height);
        let (across, down) = (width.min(PROBES), height.min(PROBES));
        let (mut pixels, mut seen, mut footprint) = (0u64, 0u64, 0.0);
        for probe in 0..across * down {
            let (x, y) = (probe % across * width / across, probe / across * height / down);
            let wavelengths = self.scene.wavelengths.sample(0.5);
            let mut found = false;
            self.eye_path(&mut workspace, y * width + x, u64::MAX, wavelengths, &mut |walk, vertex, _| {
                let pixel = self.scene.camera.pixel_width();
                footprint += f64::from(pixel * vertex.surface.point.distance(self.scene.camera.position()));
                found |= !walk.throughput.is_zero();
                seen += 1;
            });
            pixels += u64::from(found);
        }
        if seen == 0 {
            return (None, workspace.counters);
        }
        let share = pixels as f64 / f64::from(across * down);
        let photon_paths = (share * (u64::from(width) * u64::from(height)) as f64) as u64;
        let merging = Merging {
            radius: FIRST_RADIUS_PIXELS * (footprint / seen as f64) as f32,
            photon_paths: photon_paths.max(4 * BLOCK).next_multiple_of(BLOCK),
        };
        (Some(merging), workspace.counters)
    }

    /// One pass: its photons, and what they add to the picture.
    pub fn merge_pass(&self, merging: &Merging, film: &mut Film, pass: u64, state: &mut MergeState) -> Counters {
        // The sequence of all passes' wavelengths; pixels and light paths have others.
        let u = Sobol::new(mix(self.settings.seed) ^ (u64::MAX >> 1)).group(pass, 0);
        let wavelengths = self.scene.wavelengths.sample(u[0]);
        let (map, mut counters) = self.photon_map(merging, pass, wavelengths);
        state.seen.resize((self.film.width * self.film.height) as usize, false);
        let all = &state.seen;
        let results: Vec<(Vec<(Splat, bool)>, Counters)> = tiles(self.film)
            .into_par_iter()
            .map_init(
                || Workspace::new(self.scene),
                |workspace, tile| {
                    workspace.counters = Counters::default();
                    let pixels = tile_pixels(tile, self.film.width, self.film.height);
                    let merged = pixels
                        .filter_map(|pixel| {
                            let weight = self.look_at(all[pixel as usize], pixel, pass)?;
                            Some(self.merge_pixel(workspace, &map, pixel, pass, wavelengths, weight))
                        })
                        .collect();
                    (merged, workspace.counters)
                },
            )
            .collect();
        let mut merged = Vec::new();
        for (tile, count) in results {
            counters.add(count);
            merged.extend(tile);
        }
        for (splat, seen) in &merged {
            state.seen[splat.pixel as usize] |= seen;
        }
        film.add_merged((pass % LIGHT_REPLICATES as u64) as usize, merged.into_iter().map(|(splat, _)| splat));
        counters
    }

    /// Whether a pass looks at a pixel, as the weight of what it finds: pixels that showed nothing to merge on in earlier
    /// passes are looked at now and then.
    fn look_at(&self, seen: bool, pixel: u32, pass: u64) -> Option<f32> {
        if seen || pass < FULL_PASSES {
            return Some(1.0);
        }
        let random = mix(mix(self.settings.seed) ^ mix(u64::from(pixel) << 32 | pass)) >> 40;
        (random as f32 * (1.0 / (1u64 << 24) as f32) < SECOND_LOOK).then_some(1.0 / SECOND_LOOK)
    }

    fn photon_map(&self, merging: &Merging, pass: u64, wavelengths: Wavelengths) -> (PhotonMap, Counters) {
        let Some(guide) = self.plan.techniques.guide() else { return (PhotonMap::default(), Counters::default()) };
        let tracer = LightTracer {
            scene: self.scene,
            guide,
            caustics_only: true,
            branching: Branching { parting: Parting::Ways(PHOTON_WAYS), ..self.plan.light },
            max_depth: self.settings.max_depth,
        };
        let sobol = Sobol::new(mix(self.settings.seed) ^ (u64::MAX >> 2));
        let first = pass * merging.photon_paths;
        let results: Vec<(Vec<Photon>, Counters)> = (0..merging.photon_paths / BLOCK)
            .into_par_iter()
            .map_init(
                || Workspace::new(self.scene),
                |workspace, block| {
                    workspace.counters = Counters::default();
                    let mut collector = PhotonCollector { photons: Vec::new() };
                    for index in first + block * BLOCK..first + (block + 1) * BLOCK {
                        tracer.trace::<DISPERSION, INTERIORS>(
                            workspace,
                            (sobol, index),
                            Some(wavelengths),
                            &mut collector,
                        );
                    }
                    (collector.photons, workspace.counters)
                },
            )
            .collect();
        let mut counters = Counters::default();
        let mut photons = Vec::new();
        for (block, count) in results {
            counters.add(count);
            photons.extend(block);
        }
        (PhotonMap::new(photons, merging.radius_of(pass), merging.photon_paths), counters)
    }

    /// What the photons add to a pixel, and whether there was a surface to merge on.
    fn merge_pixel(
        &self,
        workspace: &mut Workspace,
        map: &PhotonMap,
        pixel: u32,
        pass: u64,
        wavelengths: Wavelengths,
        weight: f32,
    ) -> (Splat, bool) {
        let (mut radiance, mut seen) = (SampledSpectrum::ZERO, false);
        let max_depth = self.settings.max_depth;
        self.eye_path(workspace, pixel, pass, wavelengths, &mut |walk, vertex, camera_indices| {
            seen = true;
            let gathered = map.gather(&vertex, walk, max_depth);
            if !gathered.is_zero() {
                let ratio = path::radiance_ratio::<INTERIORS>(walk, camera_indices);
                radiance += gathered * walk.throughput * ratio * weight;
            }
        });
        (Splat { pixel, xyz: self.xyz(&wavelengths, radiance) }, seen)
    }

    /// Follows a pixel's camera path of a pass to where photons are looked for.
    fn eye_path(
        &self,
        workspace: &mut Workspace,
        pixel: u32,
        pass: u64,
        wavelengths: Wavelengths,
        visit: &mut impl FnMut(&mut Walk, Vertex, &Option<Indices>),
    ) {
        let sobol = Sobol::new(mix(self.settings.seed) ^ (u64::from(pixel) << 8 | MERGE_STREAM));
        let u = sobol.group(pass, 0);
        let place = (self.column_and_row(pixel), self.offset_by_filter(u));
        let mut walk = self.camera_walk(workspace, place, wavelengths, u, (sobol, pass));
        let camera_indices = if INTERIORS { Some(path::medium_indices(&mut walk)) } else { None };
        let (techniques, max_depth) = (&self.plan.techniques, self.settings.max_depth);
        let mut visit = |walk: &mut Walk, vertex: Vertex| visit(walk, vertex, &camera_indices);
        follow_specular::<DISPERSION, INTERIORS>(&mut walk, techniques, max_depth, &mut visit);
        while walk.resume() {
            follow_specular::<DISPERSION, INTERIORS>(&mut walk, techniques, max_depth, &mut visit);
        }
    }
}

/// Number of the stream of a pixel's random numbers that merging uses.
const MERGE_STREAM: u64 = 0xff;

impl Merging {
    /// Radius of a pass, from 0 on.
    fn radius_of(&self, pass: u64) -> f32 {
        let shrunk: f64 = (1..=pass).map(|i| (i as f64 + ALPHA) / (i as f64 + 1.0)).product();
        self.radius * shrunk.sqrt() as f32
    }
}

impl PhotonMap {
    /// Radiance towards the path by the photons around a vertex: Σ f Φ K / N, with Epanechnikov's kernel
    /// K = 2 / (π r²) (1 − d² / r²).
    fn gather(&self, vertex: &Vertex, walk: &Walk, max_depth: u32) -> SampledSpectrum {
        let wo = -walk.ray.direction;
        let own_lane = match walk.lanes {
            Lanes::Shared => None,
            Lanes::Bundled(lane) | Lanes::Only(lane) => Some(lane as u8),
        };
        let normal = vertex.frame.geometric.as_vec3();
        let mut sum = SampledSpectrum::ZERO;
        self.near(vertex.surface.point, |photon, distance2| {
            let other_lane = matches!((photon.lane, own_lane), (Some(a), Some(b)) if a != b);
            // Through a rough boundary light comes from its other side.
            let through = match vertex.bsdf {
                Bsdf::RoughDielectric(boundary) if photon.normal.dot(normal) < 0.0 => Some(boundary),
                _ => None,
            };
            let side = if through.is_some() { -normal } else { normal };
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
            let mut f = vertex.bsdf.eval(vertex.frame, wo, photon.wi) * (1.0 / cos);
            if let Some(boundary) = through {
                f *= boundary.radiance_change(true);
            }
            sum += f * SampledSpectrum::new(photon.power) * (1.0 - distance2 / (self.radius() * self.radius()));
        });
        sum * (FRAC_2_PI / (self.radius() * self.radius() * self.paths() as f32))
    }
}
