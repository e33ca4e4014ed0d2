//! Tone mapping operators, one file each: functions from exposed linear sRGB to the linear sRGB that a display shows.

mod exponential;
mod reinhard;
mod srgb;

use glam::DVec3;

/// A tone mapping operator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tonemap {
    /// No operator: linear up to 1, clipped above.
    Srgb,
    /// Maps each channel x to 1 − exp(−x).
    Exponential,
    /// Maps the luminance Y to Y / (1 + Y) and keeps the chromaticity \[Reinhard2002\].
    Reinhard,
}

/// The operators by the names that scenes and the command line give them, with what they do.
#[rustfmt::skip] // one operator a line
pub const TONEMAPS: &[(&str, Tonemap, &str)] = &[
    ("srgb", Tonemap::Srgb, "None: linear up to 1, clipped above."),
    ("exponential", Tonemap::Exponential, "1 − exp(−x) on each channel."),
    ("reinhard", Tonemap::Reinhard, "Reinhard's global operator on luminance [Reinhard2002]."),
];

impl Tonemap {
    /// Maps a colour in exposed linear sRGB without negative components.
    pub(super) fn apply(self, linear: DVec3) -> DVec3 {
        match self {
            Self::Srgb => srgb::apply(linear),
            Self::Exponential => exponential::apply(linear),
            Self::Reinhard => reinhard::apply(linear),
        }
    }
}
