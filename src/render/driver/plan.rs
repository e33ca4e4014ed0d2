//! What is decided before a render: which techniques run, where light paths start, and how the work is split. It follows
//! from the scene, the settings and a short pilot whose samples are thrown away, so that what is learnt cannot bias what is
//! measured, and from counted operations, never from a clock.

use super::allocation::Allocation;
use crate::bsdf::{Branching, NEVER, Parting};
use crate::render::techniques::{Guide, Merging, Techniques};
use crate::sampling::AliasTable;
use crate::scene::{Integrator, Light, LightKind, Scene};
use crate::spectrum::LANES;
use std::fmt;

/// Ways that a bundle takes where nothing is known of a scene: the best or next to it in all that were measured.
const USUAL_WAYS: u8 = 2;
/// Least shares for which paths fork, see [`crate::bsdf::Branching`]. By experiment, relMSE × CPU time of camera paths is least at 1/16
/// or next to it: against no forks less by 2 in a gem and by 1.3 in nested glass, and the same in scenes that are not mostly
/// seen through glass. What light paths find serves all pixels, and 1/64 is less by 2.5 than no forks for a rainbow.
const CAMERA_LEAST_SHARE: f32 = 1.0 / 16.0;
const LIGHT_LEAST_SHARE: f32 = 1.0 / 64.0;

/// The decisions by which a scene is rendered.
#[derive(Debug, Clone)]
pub struct Plan {
    /// Which technique finds what.
    pub techniques: Techniques,
    /// Where camera paths branch.
    pub camera: Branching,
    /// Where light paths branch.
    pub light: Branching,
    /// How photons are merged, if they are.
    pub merging: Option<Merging>,
}

/// The decisions of a plan in numbers, for people to read.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Decisions {
    /// Lanes that go on where they part, on camera paths.
    pub camera_ways: u32,
    /// Lanes that go on where they part, on light paths.
    pub light_ways: u32,
    /// Light paths for each camera path; 0 without them.
    pub light_paths_per_camera_path: f64,
    /// Passes of merging for each sample of a pixel; 0 without it.
    pub merge_passes_per_sample: f64,
    /// Photon paths of each pass of merging; 0 without it.
    pub photon_paths_per_pass: u64,
    /// Rays traced to decide.
    pub pilot_rays: u64,
}

impl Plan {
    /// Makes the plan that follows from the scene alone.
    pub fn of_scene(scene: &Scene, integrator: Integrator) -> Self {
        let ways = |ways| Parting::Ways(if scene.features.dispersion { ways } else { 1 });
        let techniques = match integrator {
            Integrator::Path | Integrator::Hero => Techniques::Path,
            Integrator::Light => Techniques::Light { guide: Guide::plain(scene.emission_table.clone(), scene) },
            Integrator::Auto => camera_and_light(scene, scene.caustic_table.clone()),
            Integrator::Merge => camera_and_light(scene, every_light(scene)),
        };
        Self {
            camera: match integrator {
                Integrator::Hero => Branching { parting: Parting::Terminate, least_share: NEVER },
                _ => Branching { parting: ways(USUAL_WAYS), least_share: CAMERA_LEAST_SHARE },
            },
            light: match integrator {
                Integrator::Light => Branching { parting: ways(1), least_share: NEVER },
                _ => Branching { parting: ways(USUAL_WAYS), least_share: LIGHT_LEAST_SHARE },
            },
            techniques,
            merging: None,
        }
    }

    /// Sets how photons are merged, if they are, and tells the techniques.
    pub fn set_merging(&mut self, merging: Option<Merging>) {
        if let Techniques::CameraAndLight { merging: merges, .. } = &mut self.techniques {
            *merges = merging.is_some();
        }
        self.merging = merging;
    }

    /// Returns the decisions in numbers.
    pub fn decisions(&self, pilot_rays: u64, allocation: Allocation) -> Decisions {
        let ways = |parting| if let Parting::Ways(ways) = parting { u32::from(ways) } else { 1 };
        Decisions {
            camera_ways: ways(self.camera.parting),
            light_ways: ways(self.light.parting),
            light_paths_per_camera_path: f64::from(self.techniques.light_paths_per_camera_path()),
            merge_passes_per_sample: if self.merging.is_some() { allocation.merged } else { 0.0 },
            photon_paths_per_pass: self.merging.as_ref().map_or(0, |m| m.photon_paths),
            pilot_rays,
        }
    }
}

/// Returns the technique of camera and light paths, or camera paths alone if the table has no lights or nothing in the
/// scene focuses them.
fn camera_and_light(scene: &Scene, lights: AliasTable) -> Techniques {
    if lights.is_empty() || scene.caustic_aim.is_none() {
        return Techniques::Path;
    }
    let guide = Guide::plain(lights, scene);
    Techniques::CameraAndLight { light_paths_per_camera_path: 1.0, guide, merging: false }
}

/// Returns a table of all lights that light paths can start from, by power, without the environment.
fn every_light(scene: &Scene) -> AliasTable {
    let weight = |(index, light): (usize, &Light)| match light.kind {
        LightKind::Environment(_) => 0.0,
        _ => f64::from(scene.emission_table.probability(index)),
    };
    AliasTable::new(&scene.lights.iter().enumerate().map(weight).collect::<Vec<_>>())
}

/// Says what an integrator may miss of a scene; `None` if nothing. The error that is estimated leaves out what is missed.
pub fn blind_spot(scene: &Scene, integrator: Integrator) -> Option<&'static str> {
    let without_extent = |light: &Light| !light.has_extent();
    let focuses = scene.caustic_aim.is_some();
    match integrator {
        Integrator::Path | Integrator::Hero if focuses && scene.lights.iter().any(without_extent) => {
            Some("camera paths never meet lights without extent, so they miss their caustics")
        }
        Integrator::Light if focuses || !scene.infinite_lights.is_empty() => {
            Some("light paths miss what the camera sees in mirrors and through glass, and lights at infinity")
        }
        Integrator::Light if scene.lights.iter().any(|light| !light.can_emit()) => {
            Some("light paths do not start from emitting lenses, ellipsoids, sheared cylinders and implicit surfaces")
        }
        _ => None,
    }
}

impl fmt::Display for Decisions {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "plan: {} of {LANES} lanes go on where they part", self.camera_ways)?;
        if self.light_paths_per_camera_path > 0.0 {
            let ratio = self.light_paths_per_camera_path;
            write!(f, "; {ratio:.2} light paths for each camera path, {} lanes", self.light_ways)?;
        }
        if self.photon_paths_per_pass > 0 {
            let passes = self.merge_passes_per_sample;
            write!(
                f,
                "; {passes:.2} passes of merging for each sample, {} photon paths each",
                self.photon_paths_per_pass
            )?;
        }
        write!(f, "; decided with {} rays", self.pilot_rays)
    }
}
