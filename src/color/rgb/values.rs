//! Linear and encoded colours as different types.

use glam::DVec3;

/// A colour proportional to light: red, green, blue of some [`RgbSpace`], where [1, 1, 1] is its white.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LinearRgb(pub DVec3);

/// A colour as files and signals hold it: red, green, blue of some [`RgbSpace`] after its transfer function.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct EncodedRgb(pub DVec3);

impl LinearRgb {
    /// Makes a colour of its components.
    pub const fn new(red: f64, green: f64, blue: f64) -> Self {
        Self(DVec3::new(red, green, blue))
    }

    /// Red, green, blue.
    pub fn to_array(self) -> [f64; 3] {
        self.0.to_array()
    }
}

impl EncodedRgb {
    /// Makes a colour of its components.
    pub const fn new(red: f64, green: f64, blue: f64) -> Self {
        Self(DVec3::new(red, green, blue))
    }

    /// Red, green, blue.
    pub fn to_array(self) -> [f64; 3] {
        self.0.to_array()
    }
}

impl From<[f64; 3]> for LinearRgb {
    fn from(rgb: [f64; 3]) -> Self {
        Self(rgb.into())
    }
}

impl From<[f64; 3]> for EncodedRgb {
    fn from(rgb: [f64; 3]) -> Self {
        Self(rgb.into())
    }
}
