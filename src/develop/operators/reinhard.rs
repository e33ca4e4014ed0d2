//! Reinhard's global operator \[Reinhard2002\].

use crate::color::RgbSpace;
use glam::DVec3;

/// Divides by 1 + Y, which keeps the chromaticity.
pub fn apply(linear: DVec3) -> DVec3 {
    let luminance = RgbSpace::srgb().xyz_from_rgb.row(1).dot(linear);
    linear / (1.0 + luminance)
}
