//! The boundary of a transparent volume, such as glass or water.

use super::capabilities::{Capabilities, LARGEST_FOCUSING_ALPHA};
use crate::scene::MediumId;

/// The boundary of a transparent volume, smooth or rough.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DielectricMaterial {
    /// What is inside.
    pub medium: MediumId,
    /// GGX α; 0 is smooth.
    pub alpha: f32,
}

impl Capabilities for DielectricMaterial {
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
        Some(self.medium)
    }
}
