//! The matte material.

use super::capabilities::Capabilities;
use super::parameter::Parameter;
use crate::scene::MediumId;

/// Lambertian reflection.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiffuseMaterial {
    /// Reflectance.
    pub reflectance: Parameter,
}

impl Capabilities for DiffuseMaterial {
    fn is_specular(&self) -> bool {
        false
    }

    fn focuses(&self) -> bool {
        false
    }

    fn uses_shading_normals(&self) -> bool {
        true
    }

    fn medium(&self) -> Option<MediumId> {
        None
    }
}
