//! Metal.

use super::capabilities::{Capabilities, LARGEST_FOCUSING_ALPHA};
use super::parameter::Parameter;
use crate::scene::MediumId;

/// Metal, smooth or rough.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConductorMaterial {
    /// Real part of the index of refraction.
    pub eta: Parameter,
    /// Imaginary part.
    pub k: Parameter,
    /// GGX α; 0 is smooth.
    pub alpha: f32,
}

impl Capabilities for ConductorMaterial {
    fn is_specular(&self) -> bool {
        self.alpha == 0.0
    }

    fn focuses(&self) -> bool {
        self.alpha < LARGEST_FOCUSING_ALPHA
    }

    fn uses_shading_normals(&self) -> bool {
        false
    }

    fn medium(&self) -> Option<MediumId> {
        None
    }
}
