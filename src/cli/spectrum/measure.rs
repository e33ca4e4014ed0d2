//! The colour of a spectrum for an observer, under a light, in an RGB space.

use super::light::{Lamp, LightFacts};
use crate::color::adaptation::ConeTransform;
use crate::color::chroma::{Dominant, dominant_wavelength};
use crate::color::gamut::{self, GamutMapper, GamutMethod};
use crate::color::space::lab_from_xyz;
use crate::color::{LinearRgb, Observer, RgbSpace, chromaticity, xyz_of_emission, xyz_of_reflectance};
use crate::io::spectrum_file::Quantity;
use crate::spectrum::{PiecewiseLinear, Spectrum};
use glam::{DMat3, DVec3};

/// A chromatic adaptation or none, and its name.
pub type Adaptation = (&'static str, Option<ConeTransform>);

/// What reflectances and transmittances are adapted by unless something else is asked for.
pub const BRADFORD: Adaptation = ("bradford", Some(ConeTransform::Bradford));
/// No adaptation.
pub const NO_ADAPTATION: Adaptation = ("none", None);

/// The names of adaptations.
pub fn adaptation_names() -> impl Iterator<Item = &'static str> {
    std::iter::once(NO_ADAPTATION.0).chain(ConeTransform::names())
}

/// An adaptation by its name, or the usual one for a quantity.
pub fn adaptation(name: Option<&str>, quantity: Quantity) -> Adaptation {
    match name.and_then(|name| ConeTransform::names().find(|known| *known == name)) {
        Some(known) => (known, ConeTransform::by_name(known).ok()),
        None if name.is_some() || quantity == Quantity::Emission => NO_ADAPTATION,
        None => BRADFORD,
    }
}

/// How spectra are looked at.
#[derive(Debug)]
pub struct Viewing {
    /// What the values are.
    pub quantity: Quantity,
    /// Observer whose colour-matching functions are used.
    pub observer: &'static Observer,
    /// Space of RGB values.
    pub space: &'static RgbSpace,
    /// How the lamp's white becomes the space's, if it does, with its name.
    pub adaptation: Adaptation,
    /// The light on a reflectance; for an emission the white it is seen against.
    pub lamp: Lamp,
    /// The lamp's colour, Y = 1.
    pub white_xyz: DVec3,
    /// What is said about the lamp.
    pub lamp_facts: LightFacts,
}

/// The colour of one spectrum.
#[derive(Debug, Clone)]
pub struct Measurement {
    /// Tristimulus values: an emission of 1 has Y = 1, a reflectance of 1 that of the lamp's white, Y = 1.
    pub xyz: DVec3,
    /// Chromaticity; `None` for black.
    pub xy: Option<[f64; 2]>,
    /// Factor on an emission that makes its largest linear component 1; 1 for anything else.
    pub shown_scale: f64,
    /// CIE L\*a\*b\* of the shown colour against the lamp's white.
    pub lab: DVec3,
    /// Linear RGB, not shown but as it is, inside the gamut or not.
    pub linear: DVec3,
    /// Encoded RGB of the shown colour, inside the gamut or not.
    pub encoded: DVec3,
    /// Whether the shown colour is inside the gamut, but for rounding.
    pub in_gamut: bool,
    /// The shown colour, moved into the gamut, in 8 bits of the space.
    pub rgb8: [u8; 3],
    /// The shown colour, moved into the gamut of sRGB, in 8 bits: terminals and drawings show this.
    pub srgb8: [u8; 3],
    /// Dominant wavelength and purity against the lamp's white; `None` for colours without a hue.
    pub dominant: Option<Dominant>,
    /// What is said of a light; `None` unless the spectrum is an emission.
    pub light: Option<LightFacts>,
}

impl Viewing {
    /// Gathers what follows from the lamp.
    pub fn new(
        quantity: Quantity,
        observer: &'static Observer,
        space: &'static RgbSpace,
        adaptation: Adaptation,
        lamp: Lamp,
    ) -> Self {
        let white_xyz = xyz_of_reflectance(&Spectrum::Constant(1.0), &lamp.spectrum, observer);
        let lamp_facts = LightFacts::of(&lamp.spectrum);
        Self { quantity, observer, space, adaptation, lamp, white_xyz, lamp_facts }
    }

    /// XYZ to linear RGB of a space.
    fn rgb_from_xyz(&self, space: &RgbSpace) -> DMat3 {
        let adapted = self.adaptation.1.map_or(DMat3::IDENTITY, |a| a.adaptation(self.white_xyz, space.white_xyz()));
        space.rgb_from_xyz * adapted
    }

    /// The colour of a spectrum.
    pub fn measure(&self, table: &PiecewiseLinear) -> Measurement {
        let spectrum = Spectrum::PiecewiseLinear(table.clone());
        let is_light = self.quantity == Quantity::Emission;
        let xyz = match is_light {
            true => xyz_of_emission(&spectrum, self.observer),
            false => xyz_of_reflectance(&spectrum, &self.lamp.spectrum, self.observer),
        };
        let xy = Some(chromaticity(xyz)).filter(|xy| xy[0].is_finite() && xy[1].is_finite());
        let linear = self.rgb_from_xyz(self.space) * xyz;
        let shown_scale = if is_light { scale_to_one(linear) } else { 1.0 };
        let shown = linear * shown_scale;
        Measurement {
            xyz,
            xy,
            shown_scale,
            lab: lab_from_xyz(xyz * shown_scale, self.white_xyz),
            linear,
            encoded: self.space.encode(LinearRgb(shown)).0,
            in_gamut: is_in_gamut(shown),
            rgb8: bytes(self.space, shown),
            srgb8: bytes(RgbSpace::srgb(), self.rgb_from_xyz(RgbSpace::srgb()) * xyz * shown_scale),
            dominant: xy.and_then(|xy| dominant_wavelength(xy, chromaticity(self.white_xyz), self.observer)),
            light: is_light.then(|| LightFacts::of(&spectrum)),
        }
    }
}

fn scale_to_one(linear: DVec3) -> f64 {
    let scale = 1.0 / linear.max_element();
    if scale.is_finite() && scale > 0.0 { scale } else { 1.0 }
}

/// Within the gamut, but for what rounding adds to white or to a primary.
fn is_in_gamut(linear: DVec3) -> bool {
    const ROUNDING: f64 = 1e-9;
    gamut::excess(LinearRgb(linear)) <= ROUNDING
}

/// Encodes a colour in 8 bits. Outside the gamut it gets less chroma at the same lightness and hue.
fn bytes(space: &RgbSpace, linear: DVec3) -> [u8; 3] {
    let mapper = || GamutMapper::new(space, GamutMethod::Desaturate);
    let inside = if is_in_gamut(linear) { linear } else { mapper().map(LinearRgb(linear)).0 };
    let encoded = space.encode(LinearRgb(inside.clamp(DVec3::ZERO, DVec3::ONE)));
    encoded.to_array().map(|code| (255.0 * code).round() as u8)
}
