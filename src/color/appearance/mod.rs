//! Colour appearance: how a stimulus looks to an observer adapted to a white, a luminance, a background and a surround.
//!
//! One type a model, made from [`ViewingConditions`]: [`Ciecam02`], [`Cam16`], [`Ciecam16`], [`Hellwig2022`], [`Zcam`]. Each
//! turns XYZ into an [`Appearance`] and back. [`ucs`] has the uniform spaces whose distance is the difference ΔE'.
//!
//! ```
//! use abbe::color::appearance::{Cam16, UniformSpace, ViewingConditions};
//! use glam::DVec3;
//! let model = Cam16::new(&ViewingConditions::srgb())?;
//! let seen = model.appearance_from_xyz(DVec3::new(0.1901, 0.2, 0.2178));
//! assert!((model.xyz_from_jch(seen.jch()) - DVec3::new(0.1901, 0.2, 0.2178)).length() < 1e-14);
//! let white = model.appearance_from_xyz(ViewingConditions::srgb().white_xyz);
//! let difference = UniformSpace::UCS.difference(
//!     UniformSpace::UCS.ucs_from_jmh(seen.jmh()),
//!     UniformSpace::UCS.ucs_from_jmh(white.jmh()),
//! );
//! assert!((difference - 50.0).abs() < 5.0);
//! # Ok::<(), abbe::Error>(())
//! ```

mod cam16;
mod ciecam02;
mod ciecam16;
mod hellwig2022;
mod response;
pub mod ucs;
mod zcam;

pub use cam16::Cam16;
pub use ciecam02::Ciecam02;
pub use ciecam16::Ciecam16;
pub use hellwig2022::{Hellwig2022, HelmholtzKohlrausch};
pub use ucs::UniformSpace;
pub use zcam::{Zcam, ZcamScales};

use crate::{Error, ErrorKind, Result};
use glam::DVec3;
use std::f64::consts::PI;

/// How dark the field around the background is: three factors of CIECAM02 \[CIE159\], used by all its descendants.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surround {
    /// F: the largest degree of adaptation, (0, 1].
    pub adaptation: f64,
    /// c: the exponent of lightness; positive.
    pub impact: f64,
    /// N_c: chromatic induction; positive.
    pub chromatic_induction: f64,
}

impl Surround {
    /// Surface colours in a lit room.
    pub const AVERAGE: Self = Self { adaptation: 1.0, impact: 0.69, chromatic_induction: 1.0 };
    /// Television in a dim room.
    pub const DIM: Self = Self { adaptation: 0.9, impact: 0.59, chromatic_induction: 0.9 };
    /// A projector in a dark room.
    pub const DARK: Self = Self { adaptation: 0.8, impact: 0.525, chromatic_induction: 0.8 };

    const NAMED: [(&str, Self); 3] = [("average", Self::AVERAGE), ("dim", Self::DIM), ("dark", Self::DARK)];

    /// Names that [`Self::by_name`] knows.
    pub fn names() -> impl Iterator<Item = &'static str> {
        Self::NAMED.into_iter().map(|(name, _)| name)
    }

    /// `average`, `dim` or `dark`.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] with the nearest name.
    pub fn by_name(name: &str) -> Result<Self> {
        Self::NAMED
            .into_iter()
            .find(|(known, _)| *known == name)
            .map(|(_, surround)| surround)
            .ok_or_else(|| Error::unknown_name("surround", name, Self::names()))
    }
}

/// What an observer is adapted to.
///
/// XYZ and the background are in one scale: Y = 1 for a perfect diffuser in all models but [`Zcam`], which is a model of
/// absolute luminance and wants both in cd/m².
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViewingConditions {
    /// XYZ of the white that is adapted to; Y is positive.
    pub white_xyz: DVec3,
    /// L_A: the luminance adapted to, cd/m²; positive. Often that of the background, a fifth of the white's.
    pub adapting_luminance: f64,
    /// Y of the background, in the scale of the white; positive. Often a fifth of the white's.
    pub background_y: f64,
    /// How dark it is around the background.
    pub surround: Surround,
    /// Whether the observer takes the illuminant wholly into account (D = 1), as for surfaces and in light quality.
    pub discount_illuminant: bool,
}

impl ViewingConditions {
    /// A display of 80 cd/m² and white D65 in a room of 64 lx, as IEC 61966-2-1 has it \[IEC61966\].
    pub fn srgb() -> Self {
        Self {
            white_xyz: crate::color::xyz_from_xy([0.3127, 0.3290]),
            adapting_luminance: 64.0 / PI * 0.2,
            background_y: 0.2,
            surround: Surround::AVERAGE,
            discount_illuminant: false,
        }
    }

    /// # Errors
    /// [`ErrorKind::OutOfRange`] for anything that is not a positive finite number, naming the field.
    fn check(&self) -> Result<()> {
        let checked = [
            ("white_xyz: Y", self.white_xyz.y),
            ("adapting_luminance", self.adapting_luminance),
            ("background_y", self.background_y),
            ("surround: adaptation", self.surround.adaptation),
            ("surround: impact", self.surround.impact),
            ("surround: chromatic_induction", self.surround.chromatic_induction),
        ];
        for (name, value) in checked {
            if !(value > 0.0 && value.is_finite()) {
                let message = format!("{name} is {value}; expected a positive finite number");
                return Err(Error::new(ErrorKind::OutOfRange, message));
            }
        }
        Ok(())
    }
}

/// Correlates of a colour's appearance. Lightness and chroma are relative to the white, brightness and colourfulness are
/// not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Appearance {
    /// J: 0 for black, 100 for the white.
    pub lightness: f64,
    /// C: colourfulness relative to the white's brightness; 0 for greys.
    pub chroma: f64,
    /// h: angle of the hue, degrees in [0, 360); 0 where there is no hue at all.
    pub hue_degrees: f64,
    /// s: colourfulness relative to the colour's own brightness; 0 where that is 0.
    pub saturation: f64,
    /// Q: how bright it looks, absolutely.
    pub brightness: f64,
    /// M: how colourful it looks, absolutely.
    pub colorfulness: f64,
    /// H: the hue between the unique hues red 0, yellow 100, green 200, blue 300 and red 400.
    pub hue_quadrature: f64,
}

impl Appearance {
    /// Lightness, chroma, hue in degrees.
    pub fn jch(&self) -> DVec3 {
        DVec3::new(self.lightness, self.chroma, self.hue_degrees)
    }

    /// Lightness, colourfulness, hue in degrees.
    pub fn jmh(&self) -> DVec3 {
        DVec3::new(self.lightness, self.colorfulness, self.hue_degrees)
    }
}

/// A model chosen by name, for programs that let their users choose.
#[derive(Debug, Clone, PartialEq)]
pub enum AppearanceModel {
    /// `ciecam02`
    Ciecam02(Ciecam02),
    /// `cam16`
    Cam16(Cam16),
    /// `ciecam16`
    Ciecam16(Ciecam16),
    /// `hellwig2022`
    Hellwig2022(Hellwig2022),
    /// `zcam`; its XYZ is in cd/m²
    Zcam(Zcam),
}

impl AppearanceModel {
    const NAMES: [&str; 5] = ["ciecam02", "cam16", "ciecam16", "hellwig2022", "zcam"];

    /// Names that [`Self::by_name`] knows.
    pub fn names() -> impl Iterator<Item = &'static str> {
        Self::NAMES.into_iter()
    }

    /// A model under viewing conditions.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] with the nearest name; conditions out of range.
    pub fn by_name(name: &str, conditions: &ViewingConditions) -> Result<Self> {
        match name {
            "ciecam02" => Ciecam02::new(conditions).map(Self::Ciecam02),
            "cam16" => Cam16::new(conditions).map(Self::Cam16),
            "ciecam16" => Ciecam16::new(conditions).map(Self::Ciecam16),
            "hellwig2022" => Hellwig2022::new(conditions).map(Self::Hellwig2022),
            "zcam" => Zcam::new(conditions).map(Self::Zcam),
            _ => Err(Error::unknown_name("appearance model", name, Self::names())),
        }
    }

    /// The appearance of XYZ.
    pub fn appearance_from_xyz(&self, xyz: DVec3) -> Appearance {
        match self {
            Self::Ciecam02(model) => model.appearance_from_xyz(xyz),
            Self::Cam16(model) => model.appearance_from_xyz(xyz),
            Self::Ciecam16(model) => model.appearance_from_xyz(xyz),
            Self::Hellwig2022(model) => model.appearance_from_xyz(xyz),
            Self::Zcam(model) => model.appearance_from_xyz(xyz),
        }
    }

    /// XYZ from lightness, chroma and hue in degrees.
    pub fn xyz_from_jch(&self, jch: DVec3) -> DVec3 {
        match self {
            Self::Ciecam02(model) => model.xyz_from_jch(jch),
            Self::Cam16(model) => model.xyz_from_jch(jch),
            Self::Ciecam16(model) => model.xyz_from_jch(jch),
            Self::Hellwig2022(model) => model.xyz_from_jch(jch),
            Self::Zcam(model) => model.xyz_from_jch(jch),
        }
    }

    /// XYZ from lightness, colourfulness and hue in degrees.
    pub fn xyz_from_jmh(&self, jmh: DVec3) -> DVec3 {
        match self {
            Self::Ciecam02(model) => model.xyz_from_jmh(jmh),
            Self::Cam16(model) => model.xyz_from_jmh(jmh),
            Self::Ciecam16(model) => model.xyz_from_jmh(jmh),
            Self::Hellwig2022(model) => model.xyz_from_jmh(jmh),
            Self::Zcam(model) => model.xyz_from_jmh(jmh),
        }
    }
}

#[cfg(test)]
mod tests;
