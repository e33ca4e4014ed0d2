//! The superquadric.

use glam::DVec3;

use super::number::Number;
use super::roots::Field;
use super::{Box3, positive};
use crate::{Error, ErrorKind, Result};

/// A superellipsoid \[Barr1981\], written with norms: ‖(‖(x/a, z/c)‖_p, y/b)‖_q = 1 with p = 2/e₂ and q = 2/e₁. That is
/// the usual formula's surface, but its slope is bounded everywhere: no power below 1 occurs, even where x, y or z is 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Superquadric {
    radii: DVec3,
    scale: DVec3,
    power_y: f64,
    power_xz: f64,
}

impl Superquadric {
    /// Smallest exponent: a box with edges rounded to about 1/20 of its size.
    pub const MIN_EXPONENT: f64 = 0.1;
    /// Largest exponent: an octahedron. Beyond it the solid is not convex and its tips are cusps.
    pub const MAX_EXPONENT: f64 = 2.0;

    /// A superellipsoid by its half axes and its exponents e₁ (north–south) and e₂ (east–west), both in [0.1, 2].
    pub fn new(radii: [f64; 3], exponent_y: f64, exponent_xz: f64) -> Result<Self> {
        for (name, radius) in ["radii[0]", "radii[1]", "radii[2]"].into_iter().zip(radii) {
            positive(name, radius)?;
        }
        for (name, exponent) in [("exponent_y", exponent_y), ("exponent_xz", exponent_xz)] {
            if !(Self::MIN_EXPONENT..=Self::MAX_EXPONENT).contains(&exponent) {
                return Err(Error::new(
                    ErrorKind::OutOfRange,
                    format!(
                        "{name} is {exponent}; expected {} (boxy) to {} (octahedral), 1 is round",
                        Self::MIN_EXPONENT,
                        Self::MAX_EXPONENT
                    ),
                ));
            }
        }
        let radii = DVec3::from(radii);
        Ok(Self { radii, scale: radii.recip(), power_y: 2.0 / exponent_y, power_xz: 2.0 / exponent_xz })
    }

    pub(super) fn bounds(&self) -> Box3 {
        Box3::around(DVec3::ZERO, self.radii)
    }
}

impl Field for Superquadric {
    /// Norms are convex, and the outer one grows with the inner one.
    const CONVEX: bool = true;

    fn value<N: Number>(&self, [x, y, z]: [N; 3]) -> N {
        let s = self.scale;
        let belt = x.scale(s.x).norm(z.scale(s.z), self.power_xz);
        belt.norm(y.scale(s.y), self.power_y).shift(-1.0)
    }
}
