//! A surface that reflects nothing, such as that of a light.

use super::capabilities::Capabilities;
use crate::scene::MediumId;

/// Reflects nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Black;

impl Capabilities for Black {
    fn is_specular(&self) -> bool {
        false
    }

    fn focuses(&self) -> bool {
        false
    }

    fn uses_shading_normals(&self) -> bool {
        false
    }

    fn medium(&self) -> Option<MediumId> {
        None
    }
}
