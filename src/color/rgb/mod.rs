//! RGB spaces: primaries, white and transfer function; linear and encoded colours as different types.

mod published;
mod spaces;
mod values;

use super::adaptation::ConeTransform;
use super::{Transfer, xyz_from_xy};
use crate::{Error, ErrorKind, Result};
use glam::{DMat3, DVec3};
pub use values::{EncodedRgb, LinearRgb};

/// An RGB space.
///
/// The matrices of [`RgbSpace::all`] follow from primaries and white in f64; those of [`RgbSpace::published`] are the
/// rounded ones that standards print.
#[derive(Debug, Clone, PartialEq)]
pub struct RgbSpace {
    /// Lower-case name with hyphens, as in scene files.
    pub name: &'static str,
    /// Chromaticities x, y of red, green and blue.
    pub primaries: [[f64; 2]; 3],
    /// Chromaticity x, y of the white [1, 1, 1].
    pub white: [f64; 2],
    /// How linear components are encoded.
    pub transfer: Transfer,
    /// Linear RGB to XYZ; white has Y = 1.
    pub xyz_from_rgb: DMat3,
    /// XYZ to linear RGB.
    pub rgb_from_xyz: DMat3,
}

impl RgbSpace {
    /// A space of one's own, from chromaticities x, y.
    ///
    /// # Errors
    /// Numbers that are not finite; a white with y not above 0; primaries on one line, or so near to one that the
    /// matrix cannot be inverted.
    pub fn new(name: &'static str, primaries: [[f64; 2]; 3], white: [f64; 2], transfer: Transfer) -> Result<Self> {
        let wrong = |kind, message: String| Err(Error::new(kind, format!("RGB space {name:?}: {message}")));
        if primaries.into_iter().flatten().chain(white).any(|number| !number.is_finite()) {
            return wrong(ErrorKind::NotFinite, "expected finite chromaticities".to_owned());
        }
        if white[1] <= 0.0 {
            return wrong(ErrorKind::OutOfRange, format!("white with y = {}; expected y above 0", white[1]));
        }
        let space = Self::derived(name, primaries, white, transfer);
        if space.xyz_from_rgb.is_finite() && space.rgb_from_xyz.is_finite() {
            return Ok(space);
        }
        wrong(ErrorKind::Degenerate, format!("primaries {primaries:?}; expected corners of a triangle"))
    }

    fn derived(name: &'static str, primaries: [[f64; 2]; 3], white: [f64; 2], transfer: Transfer) -> Self {
        let [r, g, b] = primaries.map(|[x, y]| DVec3::new(x, y, 1.0 - x - y));
        // The amounts of the primaries that add up to white.
        let amounts = DMat3::from_cols(r, g, b).inverse() * xyz_from_xy(white);
        let xyz_from_rgb = DMat3::from_cols(r * amounts.x, g * amounts.y, b * amounts.z);
        Self { name, primaries, white, transfer, xyz_from_rgb, rgb_from_xyz: xyz_from_rgb.inverse() }
    }

    /// All spaces with derived matrices.
    pub fn all() -> &'static [RgbSpace] {
        spaces::all()
    }

    /// Spaces with the rounded matrices that their standards print; names end in `-published`.
    ///
    /// Where a standard prints both directions both are taken, and they cancel only to the digits printed.
    pub fn published() -> &'static [RgbSpace] {
        published::all()
    }

    /// Names that [`RgbSpace::by_name`] knows.
    pub fn names() -> impl Iterator<Item = &'static str> {
        let derived = Self::all().iter().map(|space| space.name);
        let other_names = spaces::OTHER_NAMES.iter().map(|(name, _)| *name);
        derived.chain(other_names).chain(Self::published().iter().map(|space| space.name))
    }

    /// A space by its name: `srgb`, `display-p3`, `rec2020`, `acescg`, …
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] with the nearest name.
    pub fn by_name(name: &str) -> Result<&'static RgbSpace> {
        let canonical = spaces::OTHER_NAMES.iter().find(|(other, _)| *other == name).map_or(name, |(_, same)| *same);
        let found = Self::all().iter().chain(Self::published()).find(|space| space.name == canonical);
        found.ok_or_else(|| Error::unknown_name("RGB space", name, Self::names()))
    }

    /// IEC 61966-2-1 sRGB, whose primaries are those of Rec. 709 \[IEC61966\].
    pub fn srgb() -> &'static RgbSpace {
        &Self::all()[0]
    }

    /// XYZ of the white at Y = 1.
    pub fn white_xyz(&self) -> DVec3 {
        xyz_from_xy(self.white)
    }

    /// Applies the transfer function.
    pub fn encode(&self, linear: LinearRgb) -> EncodedRgb {
        EncodedRgb(linear.0.map(|component| self.transfer.encode(component)))
    }

    /// Undoes the transfer function.
    pub fn decode(&self, encoded: EncodedRgb) -> LinearRgb {
        LinearRgb(encoded.0.map(|code| self.transfer.decode(code)))
    }

    /// XYZ of a linear colour, unadapted.
    pub fn xyz_from_linear(&self, linear: LinearRgb) -> DVec3 {
        self.xyz_from_rgb * linear.0
    }

    /// The linear colour of XYZ, unadapted.
    pub fn linear_from_xyz(&self, xyz: DVec3) -> LinearRgb {
        LinearRgb(self.rgb_from_xyz * xyz)
    }

    /// Y of a linear colour.
    pub fn luminance(&self, linear: LinearRgb) -> f64 {
        self.xyz_from_rgb.row(1).dot(linear.0)
    }

    /// Linear RGB of another space to linear RGB of this one; white goes to white if there is an adaptation.
    pub fn rgb_from(&self, other: &RgbSpace, adaptation: Option<ConeTransform>) -> DMat3 {
        let adapted = adaptation.map_or(DMat3::IDENTITY, |a| a.adaptation(other.white_xyz(), self.white_xyz()));
        self.rgb_from_xyz * adapted * other.xyz_from_rgb
    }
}

#[cfg(test)]
mod tests;
