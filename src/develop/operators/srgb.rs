//! No operator: what is brighter than white is clipped when it is encoded.

use glam::DVec3;

pub fn apply(linear: DVec3) -> DVec3 {
    linear
}
