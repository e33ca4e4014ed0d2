//! Spectra from RGB.
//!
//! A colour leaves open which of infinitely many spectra it is. For reflectances there are the methods of [`Method`];
//! [`reflectance`] is the default, `natural`. Emissions are the smoothest of their colour ([`emission`]) or a lamp's
//! spectrum, tinted ([`emission_of_lamp`]). `natural`, `smoothest` and the emissions have knots 1 nm apart and are solved so
//! that the exact rule of integration gives the colour back to about 1e-12. Textures go through [`Table`].
//!
//! # White
//! A reflectance is lit by CIE D65: [1, 1, 1] is r = 1, whatever the space. Colours of a space with another white are
//! adapted to D65 by the Bradford transform; for reflectances D65 is the white of the integrated table (x, y = 0.31272,
//! 0.32903), which differs in the fifth digit from the (0.3127, 0.3290) of the RGB standards, so that r = 1 and white
//! agree exactly. For emissions it is the white of sRGB, so that [1, 1, 1] of any space develops to sRGB [1, 1, 1].
//!
//! # Colours that no reflectance has
//! They exist in every space wider than sRGB. [`reflectance`] refuses them; [`projected`] says what it made of them.

mod data;
pub mod jakob_hanika;
mod linear;
mod mallett;
pub mod meng;
mod method;
mod natural;
pub mod otsu;
mod projection;
mod smits;
mod smoothest;
mod table;
mod target;

pub use method::Method;
pub use natural::Natural;
pub use projection::{Projected, projected};
pub use table::{Coefficients, Table};

use super::{Observer, RgbSpace, illuminant, normalized_to_unit_luminance, xyz_of_emission, xyz_of_reflectance};
use crate::spectrum::Spectrum;
use crate::{Error, ErrorKind, Result};
use glam::DVec3;
use smoothest::{Link, solve};
use target::{EMISSION, REFLECTANCE, Target, knots_nm, spectrum_of};

/// Largest component of an emission: far beyond any lamp, and its spectrum still fits in f32 tables.
pub const MAX_EMISSION_RGB: f64 = 1e30;

/// How far conversion to sRGB may leave [0, 1] by rounding alone.
const ROUNDING: f64 = 1e-12;

/// The natural reflectance in [0, 1] whose colour under D65 is `rgb` (linear, each in [0, 1]).
///
/// Greys are constants: [0, 0, 0] is exactly 0, [1, 1, 1] exactly 1. All other values lie strictly between 0 and 1.
///
/// # Errors
/// Components that are not finite or outside of [0, 1]; colours that no reflectance has.
///
/// ```
/// use abbe::color::{RgbSpace, upsample};
/// let red = upsample::reflectance([0.6, 0.1, 0.1], RgbSpace::srgb())?;
/// assert!(red.eval(650.0) > 4.0 * red.eval(500.0));
/// # Ok::<(), abbe::Error>(())
/// ```
pub fn reflectance(rgb: [f64; 3], space: &RgbSpace) -> Result<Spectrum> {
    Natural::new().reflectance(rgb, space)
}

/// The reflectance that a method gives to a colour under D65 (linear, each in [0, 1]). Black is 0 with every method.
///
/// The published methods keep their published limits: how far they leave [0, 1] and miss the colour is told at [`Method`]
/// and measured in validation/report.md.
///
/// # Errors
/// Components that are not finite or outside of [0, 1]; colours that the method cannot reach: `mallett`, `smits` and
/// `smits-linear` those outside of sRGB, the others those that no reflectance has. `otsu` and `meng` do not notice.
pub fn reflectance_by(method: Method, rgb: [f64; 3], space: &RgbSpace) -> Result<Spectrum> {
    check_components(rgb, 1.0, "reflectance")?;
    if rgb == [0.0; 3] {
        return Ok(Spectrum::Constant(0.0));
    }
    let color = REFLECTANCE.rgb_from(space) * DVec3::from(rgb);
    let refused = || cannot_be_a_reflectance(rgb, space.name);
    match method {
        Method::Natural => reflectance(rgb, space),
        Method::Smoothest => smoothest_reflectance(rgb, space),
        Method::JakobHanika => match grey(rgb) {
            Some(grey) => Ok(Spectrum::Constant(grey)),
            None => Ok(jakob_hanika::SigmoidPolynomial::solve(color).ok_or_else(refused)?.to_spectrum()),
        },
        Method::Mallett => Ok(mallett::reflectance(within_srgb(color, rgb, space)?)),
        Method::Smits => Ok(smits::binned(within_srgb(color, rgb, space)?)),
        Method::SmitsLinear => Ok(smits::linear(within_srgb(color, rgb, space)?)),
        Method::Otsu => otsu::clipped((REFLECTANCE.xyz_from_rgb * color).to_array()),
        Method::Meng => match grey(rgb) {
            Some(grey) => Ok(Spectrum::Constant(grey)),
            None => meng::solve(color).ok_or_else(refused),
        },
    }
}

fn smoothest_reflectance(rgb: [f64; 3], space: &RgbSpace) -> Result<Spectrum> {
    if let Some(grey) = grey(rgb) {
        return Ok(Spectrum::Constant(grey));
    }
    let color = REFLECTANCE.rgb_from(space) * DVec3::from(rgb);
    let values = solve(&REFLECTANCE.weights, color, Link::Logistic);
    values.map(spectrum_of).ok_or_else(|| cannot_be_a_reflectance(rgb, space.name))
}

/// The emission with the smoothest logarithm whose XYZ is that of `rgb` (linear, not negative, unbounded).
///
/// The spectrum's unit is that of a radiance: [1, 1, 1] has Y = 1, as the constant radiance 1 has.
/// Multiples of a colour are multiples of its spectrum; black is the constant 0.
///
/// # Errors
/// Components that are not finite, negative or above [`MAX_EMISSION_RGB`]; colours on or outside the spectral locus,
/// and those so near to it that no curve of finite slope is found.
pub fn emission(rgb: [f64; 3], space: &RgbSpace) -> Result<Spectrum> {
    check_components(rgb, MAX_EMISSION_RGB, "emission")?;
    emission_towards(&EMISSION, rgb, space)
}

/// A lamp's spectrum times the factor with the smoothest logarithm that gives it the colour `rgb`.
///
/// [1, 1, 1] is the lamp itself at Y = 1, whatever its white: this tints a light instead of naming its colour. The factor
/// has no upper bound; other colours are tables of the lamp's values at whole nanometres. Multiples of a colour are
/// multiples of its spectrum; black is the constant 0.
///
/// # Errors
/// Those of [`emission`]; a lamp with negative values or without luminance.
pub fn emission_of_lamp(rgb: [f64; 3], space: &RgbSpace, lamp: &Spectrum) -> Result<Spectrum> {
    check_components(rgb, MAX_EMISSION_RGB, "emission")?;
    if lamp.range().0 < 0.0 {
        let message = format!("a lamp with values down to {}; expected none below 0", lamp.range().0);
        return Err(Error::new(ErrorKind::OutOfRange, message));
    }
    let lamp = normalized_to_unit_luminance(lamp.clone(), Observer::cie_1931_2deg())?;
    if let Some(grey) = grey(rgb) {
        return Ok(lamp.scaled(grey));
    }
    let tents = EMISSION.weights.iter().map(|&w| EMISSION.xyz_from_rgb * w);
    let values: Vec<f64> = knots_nm().into_iter().map(|lambda| lamp.eval(lambda)).collect();
    let weights: Vec<DVec3> = tents.zip(&values).map(|(tent, value)| tent * value).collect();
    let target = Target::new(weights.iter().copied().sum(), weights);
    let factor = emission_towards(&target, rgb, space)?;
    Ok(spectrum_of(knots_nm().into_iter().zip(values).map(|(lambda, value)| value * factor.eval(lambda)).collect()))
}

fn emission_towards(target: &Target, rgb: [f64; 3], space: &RgbSpace) -> Result<Spectrum> {
    let largest = rgb.into_iter().fold(0.0, f64::max);
    if largest == 0.0 {
        return Ok(Spectrum::Constant(0.0));
    }
    let unit = target.rgb_from(space) * (DVec3::from(rgb) / largest);
    let values = solve(&target.weights, unit, Link::Exponential).ok_or_else(|| {
        let message = format!(
            "the colour {rgb:?} of {} cannot be an emission: it is not, or barely, inside the spectral locus; \
             expected a less saturated colour",
            space.name
        );
        Error::new(ErrorKind::OutOfRange, message)
    })?;
    Ok(spectrum_of(values).scaled(largest))
}

/// Linear RGB of a reflectance under D65, the inverse of [`reflectance`]: r = 1 is [1, 1, 1].
pub fn rgb_of_reflectance(reflectance: &Spectrum, space: &RgbSpace) -> [f64; 3] {
    let xyz = xyz_of_reflectance(reflectance, illuminant::d65(), Observer::cie_1931_2deg());
    (REFLECTANCE.space_from_rgb(space) * (REFLECTANCE.rgb_from_xyz * xyz)).into()
}

/// Linear RGB of an emission, the inverse of [`emission`].
pub fn rgb_of_emission(emission: &Spectrum, space: &RgbSpace) -> [f64; 3] {
    let xyz = xyz_of_emission(emission, Observer::cie_1931_2deg());
    (EMISSION.space_from_rgb(space) * (EMISSION.rgb_from_xyz * xyz)).into()
}

fn grey(rgb: [f64; 3]) -> Option<f64> {
    (rgb[0] == rgb[1] && rgb[1] == rgb[2]).then_some(rgb[0])
}

/// A colour as components of sRGB within [0, 1].
fn within_srgb(color: DVec3, rgb: [f64; 3], space: &RgbSpace) -> Result<DVec3> {
    if color.min_element() < -ROUNDING || color.max_element() > 1.0 + ROUNDING {
        let message = format!(
            "the colour {rgb:?} of {} is {color} in srgb; expected components within [0, 1], for which the method is made",
            space.name
        );
        return Err(Error::new(ErrorKind::OutOfRange, message));
    }
    Ok(color.clamp(DVec3::ZERO, DVec3::ONE))
}

fn cannot_be_a_reflectance(rgb: [f64; 3], space: &str) -> Error {
    let message = format!(
        "the colour {rgb:?} of {space} cannot be a reflectance: nothing that reflects at most all light has it under \
         D65; expected a darker or less saturated colour (every colour of srgb can be one)"
    );
    Error::new(ErrorKind::OutOfRange, message)
}

fn check_components(rgb: [f64; 3], most: f64, what: &str) -> Result<()> {
    for component in rgb {
        if !component.is_finite() {
            let message = format!("{component} in {rgb:?}; expected finite components");
            return Err(Error::new(ErrorKind::NotFinite, message));
        }
        if !(0.0..=most).contains(&component) {
            let range = if most == 1.0 { "[0, 1]".to_owned() } else { format!("[0, {most:e}]") };
            let message = format!("{component} in {rgb:?}; expected components of a {what} within {range}");
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
