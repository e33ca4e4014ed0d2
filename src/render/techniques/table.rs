//! Which technique finds which paths: a partition, so that nothing is counted twice and nothing is missed.
//!
//! A path is written from the camera E to a light L, with M for matte surfaces (Lambertian), R for rough ones (facets),
//! D for either and S for specular ones; * is any number, + at least one, X any of them. r is a rough surface that counts
//! as focusing, see [`Material::focuses`](crate::scene::Material::focuses). The first that fits applies. "Light paths" and
//! "merging" mean lights that they start from; all else is the camera's.
//!
//! | path | found by |
//! |---|---|
//! | E S* L | camera paths |
//! | E D X* S+ L: a caustic on a surface seen directly | light paths; camera paths too if the light has extent, balanced |
//! | E S+ M X* S+ L: the same through glass or in a mirror | merging; without it camera paths, if the light has extent |
//! | E S+ R X* S+ L: the same on a rough surface | camera paths if the light has extent, else merging |
//! | E D X* D L, local light: what bounces off the spot of a beam | light paths |
//! | E S+ M X* D L, local light | merging; without it camera paths |
//! | E M X* r L: a glossy caustic on a matte surface seen directly | light paths |
//! | E S+ M X* r L: the same through glass or in a mirror | merging; without it camera paths |
//! | E R X* M X* r L: the same through or in something rough | light paths |
//! | E X* D L, light with extent | camera paths: scattering into it and next-event estimation, balanced |
//! | E X* D L, light without | camera paths: next-event estimation |
//!
//! So a rough surface that the camera looks at, or through, is lit by camera paths: its lobe is sampled from there, and
//! lights are asked on both sides of it. What it casts on matte surfaces is for paths from the light.

use super::guide::Guide;
use crate::sampling::balance_heuristic;
use crate::scene::{Exit, LightId, Scene};
use crate::spectrum::SampledSpectrum;
use std::f32::consts::FRAC_1_PI;

/// Which techniques take part.
#[derive(Debug, Clone)]
pub enum Techniques {
    /// Camera paths alone.
    Path,
    /// Camera paths, and light paths for what they hardly find.
    CameraAndLight {
        /// Light paths traced for each camera path.
        light_paths_per_camera_path: f32,
        /// Where they start.
        guide: Guide,
        /// Whether photons are merged where the camera sees a diffuse surface through specular ones.
        merging: bool,
    },
    /// Light paths alone.
    Light {
        /// Where they start.
        guide: Guide,
    },
}

/// The first surface of a camera path that is not specular.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Seen {
    /// There is none yet.
    Nothing,
    /// Matte, seen without anything specular in between: camera rays reach it with this density per unit area.
    Directly(f32),
    /// Matte, seen through or in something specular.
    ThroughSpecular,
    /// Rough, seen without anything specular in between.
    RoughDirectly {
        /// Density per unit of area and projected solid angle with which camera paths leave it as this one does, lane by
        /// lane.
        density: SampledSpectrum,
        /// Whether a matte surface has followed.
        then_matte: bool,
    },
    /// Rough, seen through or in something specular.
    RoughThroughSpecular,
}

impl Techniques {
    /// Light paths traced for each camera path; 1 where there are no camera paths.
    pub fn light_paths_per_camera_path(&self) -> f32 {
        match self {
            Self::Path => 0.0,
            Self::CameraAndLight { light_paths_per_camera_path, .. } => *light_paths_per_camera_path,
            Self::Light { .. } => 1.0,
        }
    }

    /// Returns where light paths start, if there are any.
    pub fn guide(&self) -> Option<&Guide> {
        match self {
            Self::Path => None,
            Self::CameraAndLight { guide, .. } | Self::Light { guide } => Some(guide),
        }
    }

    /// Whether light paths start from a light.
    fn draws(&self, light: LightId) -> bool {
        matches!(self, Self::CameraAndLight { guide, .. } if guide.probability(light) > 0.0)
    }

    fn merges(&self) -> bool {
        matches!(self, Self::CameraAndLight { merging: true, .. })
    }

    /// Weight of a camera path that ran into a light along specular surfaces.
    pub fn camera_weight_of_caustic(&self, scene: &Scene, light: LightId, seen: Seen, exit: &Exit) -> SampledSpectrum {
        let weight = match seen {
            Seen::Nothing | Seen::RoughThroughSpecular => 1.0,
            Seen::Directly(camera) => self
                .light_path_density(scene, light, exit)
                .map_or(1.0, |light| balance_heuristic(camera, light.matte())),
            Seen::RoughDirectly { density: camera, .. } => {
                return self.light_path_density(scene, light, exit).map_or(SampledSpectrum::ONE, |light| {
                    let camera = camera.lanes();
                    SampledSpectrum::from_fn(|lane| balance_heuristic(camera[lane], light.0))
                });
            }
            Seen::ThroughSpecular if self.merges() && self.draws(light) => 0.0,
            Seen::ThroughSpecular => 1.0,
        };
        SampledSpectrum::splat(weight)
    }

    /// Whether camera paths ask a local light at a diffuse surface, having seen what they have before it.
    pub fn camera_owns_local_light(&self, light: LightId, seen: Seen) -> bool {
        match seen {
            Seen::Nothing | Seen::RoughThroughSpecular => true,
            Seen::Directly(_) | Seen::RoughDirectly { .. } => !self.draws(light),
            Seen::ThroughSpecular => !(self.merges() && self.draws(light)),
        }
    }

    /// Whether camera paths look for a light that is no local one at a rough surface that focuses, having seen what they
    /// have before it.
    pub fn camera_owns_glossy_caustic(&self, light: LightId, seen: Seen) -> bool {
        match seen {
            Seen::Nothing | Seen::RoughDirectly { then_matte: false, .. } | Seen::RoughThroughSpecular => true,
            Seen::Directly(_) | Seen::RoughDirectly { then_matte: true, .. } => !self.draws(light),
            Seen::ThroughSpecular => !(self.merges() && self.draws(light)),
        }
    }

    /// Whether there is something for merging to find on rough surfaces: caustics of lights without extent.
    pub fn merges_on_rough(&self, scene: &Scene) -> bool {
        self.guide().is_some_and(|guide| {
            (0..scene.lights.len()).any(|i| guide.probability(LightId(i as u32)) > 0.0 && !scene.lights[i].has_extent())
        })
    }

    /// Density of light paths at a surface that is not specular and seen by the camera, relative to one camera path.
    /// `None` if no light path starts from this light, or it has no extent that camera paths could meet.
    ///
    /// A path of camera, diffuse surfaces, a chain of specular ones and light is found from both ends. Its densities per
    /// unit of étendue differ in their first step alone: the camera's density per area times that of the direction in
    /// which it goes on per projected solid angle (at a matte surface 1/π), against the light's density of point and
    /// direction. Everything between is shared (for specular vertices étendue is conserved, and reflection is chosen with
    /// the same probability both ways; at rough vertices the densities there and back differ by the masking of the two
    /// directions alone, which is left out), so the ratio needs no bookkeeping along the path. Weights are right whatever
    /// is left out, as both sides leave it out: they are functions of the path and the lane.
    pub fn light_path_density(&self, scene: &Scene, light: LightId, exit: &Exit) -> Option<LightPathDensity> {
        let (Self::CameraAndLight { light_paths_per_camera_path, guide, .. }, Some(aim)) = (self, &scene.caustic_aim)
        else {
            return None;
        };
        let drawn = guide.probability(light) * light_paths_per_camera_path;
        if drawn == 0.0 {
            return None;
        }
        let source = scene.light(light);
        let density = source.emission_density(exit, aim)? * guide.density(light, source, exit, aim);
        Some(LightPathDensity(drawn * density))
    }
}

/// A density of light paths per unit of area and projected solid angle.
#[derive(Debug, Clone, Copy)]
pub struct LightPathDensity(pub f32);

impl LightPathDensity {
    /// Per unit area, to be compared with the camera's at a matte surface, where the Lambertian density 1/π is shared.
    pub fn matte(self) -> f32 {
        self.0 / FRAC_1_PI
    }
}
