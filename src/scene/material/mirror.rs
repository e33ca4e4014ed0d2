//! The perfect mirror.

use super::capabilities::Capabilities;
use super::parameter::Parameter;
use crate::scene::MediumId;

/// Perfect mirror.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MirrorMaterial {
    /// Reflectance.
    pub reflectance: Parameter,
}

impl Capabilities for MirrorMaterial {
    fn is_specular(&self) -> bool {
        true
    }

    fn focuses(&self) -> bool {
        true
    }

    fn uses_shading_normals(&self) -> bool {
        false
    }

    fn medium(&self) -> Option<MediumId> {
        None
    }
}
