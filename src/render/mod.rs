//! Rendering, in three rooms: `paths` is what all paths have in common, `techniques` what sets camera paths, light paths
//! and merging apart, and `driver` the order of the work.

mod driver;
mod paths;
mod techniques;
mod timing;

pub use driver::{Decisions, Phase, Profile, Progress, Rendering, Statistics, blind_spot};
pub use paths::Counters;
pub use timing::TimedRays;

use crate::scene::{FilmSettings, RenderSettings, Scene};

/// Renders a scene. `proceed` is called between passes and stops the render by returning `false`; what has been done by
/// then is a picture of fewer samples.
///
/// The film's bits depend on the scene, the settings and the number of samples alone, not on threads or passes. Where a
/// clock or a target error stops the render, that number is told, and is all that depends on the clock (a render asked for
/// fewer than 32 samples spares the pilot, and is another).
pub fn render(
    scene: &Scene,
    settings: &RenderSettings,
    film: &FilmSettings,
    proceed: &mut dyn FnMut(Progress) -> bool,
) -> Rendering {
    driver::run(scene, settings, film, scene.features.interiors, proceed)
}

/// Renders as [`render`] does, with mechanisms that the scene can do without. For the test that they change no bit.
#[doc(hidden)]
pub fn render_with_everything(
    scene: &Scene,
    settings: &RenderSettings,
    film: &FilmSettings,
    proceed: &mut dyn FnMut(Progress) -> bool,
) -> Rendering {
    driver::run(scene, settings, film, true, proceed)
}
