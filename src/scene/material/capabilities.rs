//! What the rest of the crate asks of a material.

use crate::scene::MediumId;

/// What every material states. No method has a default, so that a new material cannot inherit a wrong answer.
pub(super) trait Capabilities {
    /// Whether light is scattered into single directions only.
    fn is_specular(&self) -> bool;

    /// Whether light is scattered into so small a part of all directions that it can make caustics.
    fn focuses(&self) -> bool;

    /// Whether it scatters about interpolated normals where a mesh has them.
    fn uses_shading_normals(&self) -> bool;

    /// What is inside, if this is the boundary of a transparent volume.
    fn medium(&self) -> Option<MediumId>;
}

/// Roughness from which on a surface no longer counts as focusing light: lobes as wide as that are found by camera paths
/// as well as by light paths.
pub(super) const LARGEST_FOCUSING_ALPHA: f32 = 0.5;
