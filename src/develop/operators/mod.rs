//! Tone mapping operators, one file each: functions from exposed linear sRGB to what the display shows.

mod exponential;
mod reinhard;
mod srgb;

use glam::DVec3;

/// The operators.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tonemap {
    /// None: linear up to 1, clipped above.
    Srgb,
    /// 1 − exp(−x) on each channel.
    Exponential,
    /// Y / (1 + Y) on luminance, colour kept \[Reinhard2002\].
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
    /// Maps exposed linear sRGB, none of it negative.
    pub(super) fn apply(self, linear: DVec3) -> DVec3 {
        match self {
            Self::Srgb => srgb::apply(linear),
            Self::Exponential => exponential::apply(linear),
            Self::Reinhard => reinhard::apply(linear),
        }
    }
}
