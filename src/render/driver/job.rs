//! The givens of a render: the scene, the settings, the film and the plan.

use super::plan::Plan;
use crate::bsdf::Parting;
use crate::scene::{FilmSettings, MediumId, ObjectId, RenderSettings, Scene};

/// What is fixed while paths are traced. Only the plan changes, and only between segments. `INTERIORS` tells whether paths
/// keep track of the objects that they are inside of.
pub struct Job<'a, const INTERIORS: bool> {
    /// The scene to render.
    pub scene: &'a Scene,
    /// The settings of the render.
    pub settings: &'a RenderSettings,
    /// The size, the filter and the sensor of the film.
    pub film: &'a FilmSettings,
    /// What has been decided so far.
    pub plan: Plan,
    /// The objects that hold the camera, if they are the same for all its rays.
    pub camera_interiors: Option<Vec<(ObjectId, MediumId)>>,
}

impl<'a, const INTERIORS: bool> Job<'a, INTERIORS> {
    /// Gathers the givens, with a plan that follows from the scene alone.
    pub fn new(scene: &'a Scene, settings: &'a RenderSettings, film: &'a FilmSettings) -> Self {
        let plan = Plan::of_scene(scene, settings.integrator);
        let camera_interiors = if !scene.may_be_inside(&scene.camera.bounds()) {
            Some(Vec::new())
        } else if scene.camera.is_pinhole() {
            Some(scene.interiors_at(scene.camera.position()))
        } else {
            None
        };
        Self { scene, settings, film, plan, camera_interiors }
    }

    /// Returns how many pixels beyond the film samples still count in it. Those of the baseline count in one pixel alone
    /// \[PBRT4\].
    pub fn filter_reach(&self) -> u32 {
        if self.plan.camera.parting == Parting::Terminate { 0 } else { self.film.filter.reach() }
    }
}
