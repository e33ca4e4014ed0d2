//! 1 − exp(−x), as photographic film saturates.

use crate::math;
use glam::DVec3;

pub fn apply(linear: DVec3) -> DVec3 {
    linear.map(|x| 1.0 - math::exp(-x))
}
