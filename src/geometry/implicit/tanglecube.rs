//! The tanglecube.

use glam::DVec3;

use super::number::Number;
use super::roots::Field;
use super::{Box3, positive};
use crate::{Error, ErrorKind, Result};

/// The quartic x⁴ − 5x² + y⁴ − 5y² + z⁴ − 5z² + level = 0 in units of `size`, as a sum of squares:
/// (x² − 5/2)² + (y² − 5/2)² + (z² − 5/2)² = 75/4 − level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tanglecube {
    size: f64,
    right_side: f64,
}

impl Tanglecube {
    /// Range of the level. From 12.5 to 18.75 there are eight separate blobs; at 18.75 they vanish.
    pub const LEVELS: (f64, f64) = (-100.0, 18.75);

    /// A tanglecube by the length of one unit and the constant term, −100 ≤ level < 18.75 (11.8 is the usual one).
    pub fn new(size: f64, level: f64) -> Result<Self> {
        let size = positive("size", size)?;
        let (least, most) = Self::LEVELS;
        if !(least <= level && level < most) {
            return Err(Error::new(
                ErrorKind::OutOfRange,
                format!("level is {level}; expected at least {least} and below {most}, where the solid vanishes"),
            ));
        }
        Ok(Self { size, right_side: most - level })
    }

    pub(super) fn bounds(&self) -> Box3 {
        let reach = (2.5 + self.right_side.sqrt()).sqrt() * self.size;
        Box3::around(DVec3::ZERO, DVec3::splat(reach))
    }
}

impl Field for Tanglecube {
    fn value<N: Number>(&self, p: [N; 3]) -> N {
        let [x, y, z] = p.map(|v| v.scale(1.0 / self.size).square().shift(-2.5).square());
        (x + y + z).shift(-self.right_side)
    }
}
