//! Uniform spaces over the appearance models: where equal distances look equally different.

use crate::math::{cos, exp_m1, ln_1p, sin};
use crate::{Error, Result};
use glam::DVec3;
use std::f64::consts::PI;

/// J', a', b' over J, M, h of CIECAM02 \[Luo2006\] or CAM16 \[Li2017\], which share the coefficients: CAM02-UCS of
/// [`super::Ciecam02`], CAM16-UCS of [`super::Cam16`], and their variants for large and small differences.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UniformSpace {
    /// K_L: what the difference of J' is divided by.
    pub lightness_divisor: f64,
    /// c_1: compression of lightness.
    pub lightness_compression: f64,
    /// c_2: compression of colourfulness.
    pub colorfulness_compression: f64,
}

impl UniformSpace {
    /// CAM02-UCS or CAM16-UCS, for differences of any size.
    pub const UCS: Self =
        Self { lightness_divisor: 1.0, lightness_compression: 0.007, colorfulness_compression: 0.0228 };
    /// CAM02-LCD or CAM16-LCD, for large differences.
    pub const LCD: Self =
        Self { lightness_divisor: 0.77, lightness_compression: 0.007, colorfulness_compression: 0.0053 };
    /// CAM02-SCD or CAM16-SCD, for small differences.
    pub const SCD: Self =
        Self { lightness_divisor: 1.24, lightness_compression: 0.007, colorfulness_compression: 0.0363 };

    const NAMED: [(&str, Self); 3] = [("ucs", Self::UCS), ("lcd", Self::LCD), ("scd", Self::SCD)];

    /// Names that [`Self::by_name`] knows.
    pub fn names() -> impl Iterator<Item = &'static str> {
        Self::NAMED.into_iter().map(|(name, _)| name)
    }

    /// `ucs`, `lcd` or `scd`.
    ///
    /// # Errors
    /// [`UnknownName`](crate::ErrorKind::UnknownName) with the nearest name.
    pub fn by_name(name: &str) -> Result<Self> {
        Self::NAMED
            .into_iter()
            .find(|(known, _)| *known == name)
            .map(|(_, space)| space)
            .ok_or_else(|| Error::unknown_name("uniform space", name, Self::names()))
    }

    /// J', a', b' from lightness, colourfulness and hue in degrees.
    ///
    /// J' is 0 for black and 100 for the white; it has a pole at J = −1/c₁ = −143. Negative colourfulness is treated as the
    /// opposite hue.
    pub fn ucs_from_jmh(&self, jmh: DVec3) -> DVec3 {
        let (c1, c2) = (self.lightness_compression, self.colorfulness_compression);
        let lightness = (1.0 + 100.0 * c1) * jmh.x / (1.0 + c1 * jmh.x);
        let radius = (ln_1p(c2 * jmh.y.abs()) / c2).copysign(jmh.y);
        let h = jmh.z * (PI / 180.0);
        DVec3::new(lightness, radius * cos(h), radius * sin(h))
    }

    /// Lightness, colourfulness and hue in degrees from J', a', b'.
    pub fn jmh_from_ucs(&self, ucs: DVec3) -> DVec3 {
        let (c1, c2) = (self.lightness_compression, self.colorfulness_compression);
        let lightness = ucs.x / (1.0 + 100.0 * c1 - c1 * ucs.x);
        let radius = (ucs.y * ucs.y + ucs.z * ucs.z).sqrt();
        DVec3::new(lightness, exp_m1(c2 * radius) / c2, super::response::hue_degrees(ucs.y, ucs.z))
    }

    /// ΔE': the distance of two colours given as J', a', b', with ΔJ' divided by K_L.
    pub fn difference(&self, a: DVec3, b: DVec3) -> f64 {
        let d = a - b;
        DVec3::new(d.x / self.lightness_divisor, d.y, d.z).length()
    }
}
