//! Which technique finds which paths: a partition, so that nothing is counted twice and nothing is missed.
//!
//! A path is written from the camera E to a light L, with D for diffuse and S for specular surfaces; * is any number, + at
//! least one, X either. "Light paths" and "merging" mean lights that they start from; all else is the camera's.
//!
//! | path | found by |
//! |---|---|
//! | E S* L | camera paths |
//! | E X* D L, light with extent | camera paths: scattering into it and next-event estimation, balanced |
//! | E X* D L, light without | camera paths: next-event estimation |
//! | E D X* S+ L: a caustic on a surface seen directly | light paths; camera paths too if the light has extent, balanced |
//! | E S+ D X* S+ L: the same through glass or in a mirror | merging; without it camera paths, if the light has extent |
//! | E D X* D L, local light: what bounces off the spot of a beam | light paths |
//! | E S+ D X* D L, local light | merging; without it camera paths |

use super::guide::Guide;
use crate::sampling::balance_heuristic;
use crate::scene::{Exit, Scene};
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

/// The first diffuse surface of a camera path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Seen {
    /// There is none yet.
    Nothing,
    /// Seen without anything specular in between: camera rays reach it with this density per unit area.
    Directly(f32),
    /// Seen through or in something specular.
    ThroughSpecular,
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

    /// Where light paths start, if there are any.
    pub fn guide(&self) -> Option<&Guide> {
        match self {
            Self::Path => None,
            Self::CameraAndLight { guide, .. } | Self::Light { guide } => Some(guide),
        }
    }

    /// Whether light paths start from a light.
    fn draws(&self, light: u32) -> bool {
        matches!(self, Self::CameraAndLight { guide, .. } if guide.probability(light) > 0.0)
    }

    fn merges(&self) -> bool {
        matches!(self, Self::CameraAndLight { merging: true, .. })
    }

    /// Weight of a camera path that ran into a light along specular surfaces.
    pub fn camera_weight_of_caustic(&self, scene: &Scene, light: u32, seen: Seen, exit: &Exit) -> f32 {
        match seen {
            Seen::Nothing => 1.0,
            Seen::Directly(camera) => {
                self.light_path_density(scene, light, exit).map_or(1.0, |light| balance_heuristic(camera, light))
            }
            Seen::ThroughSpecular if self.merges() && self.draws(light) => 0.0,
            Seen::ThroughSpecular => 1.0,
        }
    }

    /// Whether camera paths ask a local light at a diffuse surface, having seen what they have before it.
    pub fn camera_owns_local_light(&self, light: u32, seen: Seen) -> bool {
        match seen {
            Seen::Nothing => true,
            Seen::Directly(_) => !self.draws(light),
            Seen::ThroughSpecular => !(self.merges() && self.draws(light)),
        }
    }

    /// Density of light paths per unit area at a diffuse surface seen by the camera, relative to one camera path, after
    /// division by the Lambertian density 1/π that both directions of such a path share. `None` if no light path
    /// starts from this light, or it has no extent that camera paths could meet.
    ///
    /// A path of camera, diffuse surfaces, a chain of specular ones and light is found from both ends. Its densities per
    /// unit of étendue differ in their first step alone: the camera's density per area times 1/π, against the light's
    /// density of point and direction. Everything between is shared (for specular vertices étendue is conserved, and
    /// reflection is chosen with the same probability both ways), so the ratio needs no bookkeeping along the path.
    pub fn light_path_density(&self, scene: &Scene, light: u32, exit: &Exit) -> Option<f32> {
        let (Self::CameraAndLight { light_paths_per_camera_path, guide, .. }, Some(aim)) = (self, &scene.caustic_aim)
        else {
            return None;
        };
        let drawn = guide.probability(light) * light_paths_per_camera_path;
        if drawn == 0.0 {
            return None;
        }
        let source = &scene.lights[light as usize];
        let density = source.emission_density(exit, aim)? * guide.density(light, source, exit, aim);
        Some(drawn * density / FRAC_1_PI)
    }
}
