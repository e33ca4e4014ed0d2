//! What stays the same during a render: the scene, the settings, the sensor and the plan.

use super::plan::Plan;
use crate::scene::{FilmSettings, MediumId, ObjectId, RenderSettings, Scene};

/// A render's givens and its plan. `INTERIORS` tells whether paths keep what they are inside of.
pub struct Renderer<'a, const INTERIORS: bool> {
    /// The scene.
    pub scene: &'a Scene,
    /// How it is rendered.
    pub settings: &'a RenderSettings,
    /// What the film is like.
    pub film: &'a FilmSettings,
    /// What has been decided.
    pub plan: Plan,
    /// What holds the camera, if that is the same for all its rays.
    pub camera_interiors: Option<Vec<(ObjectId, MediumId)>>,
}

impl<'a, const INTERIORS: bool> Renderer<'a, INTERIORS> {
    /// Plans by the scene alone.
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
}
