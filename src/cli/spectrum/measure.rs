//! The colour of a spectrum for an observer, under a light, in an RGB space.

use super::light::{Lamp, LightFacts};
use crate::Result;
use crate::color::{Observer, RgbSpace, chromaticity, xyz_of_emission, xyz_of_reflectance};
use crate::io::spectrum_file::Quantity;
use crate::spectrum::{PiecewiseLinear, Spectrum};
use glam::DVec3;

/// How spectra are looked at.
#[derive(Debug)]
pub struct Viewing {
    /// What the values are.
    pub quantity: Quantity,
    /// Who looks.
    pub observer: &'static Observer,
    /// Space of RGB values.
    pub space: &'static RgbSpace,
    /// The light on a reflectance; for an emission the white it is seen against.
    pub lamp: Lamp,
    /// The lamp's colour, Y = 1.
    pub white_xyz: DVec3,
    /// What is said about the lamp.
    pub lamp_facts: LightFacts,
}
