//! Spectra from RGB: the smoothest reflectance and the smoothest emission of a colour.
//!
//! A reflectance is the r in [0, 1] with the smoothest logit (\[Burns2019\], "least hyperbolic tangent slope squared"),
//! an emission the positive curve with the smoothest logarithm. Both are tables with knots 1 nm apart, solved so that
//! the exact rule of integration gives the colour back to about 1e-12.
//!
//! # White
//! A reflectance is lit by CIE D65: [1, 1, 1] is r = 1, whatever the space. Colours of a space with another white are
//! adapted to D65 by the Bradford transform; for reflectances D65 is the white of the integrated table (x, y = 0.31272,
//! 0.32903), which differs in the fifth digit from the (0.3127, 0.3290) of the RGB standards, so that r = 1 and white
//! agree exactly. For emissions it is the white of sRGB, so that [1, 1, 1] of any space develops to sRGB [1, 1, 1].

use super::adaptation::bradford;
use super::integration::{segment_2, segment_3};
use super::smoothest::{Link, solve};
use super::{Observer, RgbSpace, illuminant, xyz_of_emission, xyz_of_reflectance};
use crate::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, PiecewiseLinear, Spectrum};
use crate::{Error, ErrorKind, Result};
use glam::{DMat3, DVec3};
use std::sync::LazyLock;

/// Knots of upsampled spectra: 360, 361, …, 830 nm.
const KNOTS: usize = 471;

/// Largest component of an emission: far beyond any lamp, and its spectrum still fits in f32 tables.
pub const MAX_EMISSION_RGB: f64 = 1e30;

static REFLECTANCE: LazyLock<Target> = LazyLock::new(|| {
    let white = xyz_of_reflectance(&Spectrum::Constant(1.0), illuminant::d65(), Observer::cie_1931_2deg());
    Target::new(white, illuminant::d65())
});

static EMISSION: LazyLock<Target> =
    LazyLock::new(|| Target::new(RgbSpace::srgb().white_xyz(), &Spectrum::Constant(1.0)));

/// What a knot's value adds to the colour, in linear sRGB whose white is `white`.
struct Target {
    /// White that all spaces are adapted to, XYZ.
    white: DVec3,
    /// XYZ to the RGB of `weights`.
    rgb_from_xyz: DMat3,
    /// RGB of a spectrum that is 1 at one knot and 0 at all others.
    weights: Vec<DVec3>,
}

impl Target {
    fn new(white: DVec3, illuminant: &Spectrum) -> Self {
        let srgb = RgbSpace::srgb();
        let rgb_from_xyz = (bradford(srgb.white_xyz(), white) * srgb.xyz_from_rgb).inverse();
        let weights = xyz_weights(illuminant, Observer::cie_1931_2deg());
        Self { white, rgb_from_xyz, weights: weights.into_iter().map(|w| rgb_from_xyz * w).collect() }
    }

    /// Linear RGB of a space to the RGB of `weights`.
    fn rgb_from(&self, space: &RgbSpace) -> DMat3 {
        self.rgb_from_xyz * bradford(space.white_xyz(), self.white) * space.xyz_from_rgb
    }

    fn solve(&self, rgb: DVec3, space: &RgbSpace, link: Link) -> Option<Spectrum> {
        let values = solve(&self.weights, self.rgb_from(space) * rgb, link)?;
        Some(Spectrum::PiecewiseLinear(PiecewiseLinear::from_valid_knots(knots_nm(), values)))
    }
}

/// The reflectance in [0, 1] with the smoothest logit whose colour under D65 is `rgb` (linear, each in [0, 1]).
///
/// Greys are constants: [0, 0, 0] is exactly 0, [1, 1, 1] exactly 1.
///
/// # Errors
/// Components that are not finite or outside of [0, 1]; colours that no reflectance has, which exist in every space
/// wider than sRGB.
///
/// ```
/// use abbe::color::{RgbSpace, upsample};
/// let red = upsample::reflectance([0.6, 0.1, 0.1], RgbSpace::srgb())?;
/// assert!(red.eval(650.0) > 4.0 * red.eval(500.0));
/// # Ok::<(), abbe::Error>(())
/// ```
pub fn reflectance(rgb: [f64; 3], space: &RgbSpace) -> Result<Spectrum> {
    check_components(rgb, 1.0, "reflectance")?;
    if let Some(grey) = grey(rgb) {
        return Ok(Spectrum::Constant(grey));
    }
    REFLECTANCE.solve(rgb.into(), space, Link::Logistic).ok_or_else(|| {
        let message = format!(
            "the colour {rgb:?} of {} cannot be a reflectance: nothing that reflects at most all light has it under \
             D65; expected a darker or less saturated colour (every colour of srgb can be one)",
            space.name
        );
        Error::new(ErrorKind::OutOfRange, message)
    })
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
    let largest = rgb.into_iter().fold(0.0, f64::max);
    if largest == 0.0 {
        return Ok(Spectrum::Constant(0.0));
    }
    let unit = DVec3::from(rgb) / largest;
    let spectrum = EMISSION.solve(unit, space, Link::Exponential).ok_or_else(|| {
        let message = format!(
            "the colour {rgb:?} of {} cannot be an emission: it is not, or barely, inside the spectral locus; \
             expected a less saturated colour",
            space.name
        );
        Error::new(ErrorKind::OutOfRange, message)
    })?;
    Ok(spectrum.scaled(largest))
}

/// Linear RGB of a reflectance under D65, the inverse of [`reflectance`]: r = 1 is [1, 1, 1].
pub fn rgb_of_reflectance(reflectance: &Spectrum, space: &RgbSpace) -> [f64; 3] {
    let xyz = xyz_of_reflectance(reflectance, illuminant::d65(), Observer::cie_1931_2deg());
    (space.rgb_from_xyz * bradford(REFLECTANCE.white, space.white_xyz()) * xyz).into()
}

/// Linear RGB of an emission, the inverse of [`emission`].
pub fn rgb_of_emission(emission: &Spectrum, space: &RgbSpace) -> [f64; 3] {
    let xyz = xyz_of_emission(emission, Observer::cie_1931_2deg());
    (space.rgb_from_xyz * bradford(EMISSION.white, space.white_xyz()) * xyz).into()
}

fn grey(rgb: [f64; 3]) -> Option<f64> {
    (rgb[0] == rgb[1] && rgb[1] == rgb[2]).then_some(rgb[0])
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

fn knots_nm() -> Vec<f64> {
    (0..KNOTS).map(|i| LAMBDA_MIN_NM + i as f64).collect()
}

/// XYZ of the tent functions of the knots under an illuminant, by the exact rule; they sum to its white of Y = 1.
fn xyz_weights(illuminant: &Spectrum, observer: &Observer) -> Vec<DVec3> {
    let table = illuminant.tabulate();
    let mut weights = vec![DVec3::ZERO; KNOTS];
    for cell in 0..KNOTS - 1 {
        let (from, to) = (LAMBDA_MIN_NM + cell as f64, LAMBDA_MIN_NM + (cell + 1) as f64);
        // The observer is linear inside a cell; the illuminant may have knots there.
        for (axis, curve) in observer.curves().into_iter().enumerate() {
            let part = table.restricted(from, to);
            let (knots, lamp) = (part.lambdas_nm(), part.values());
            let curve = curve.eval_ascending(knots);
            for k in 0..knots.len() - 1 {
                let (lamp, curve) = ([lamp[k], lamp[k + 1]], [curve[k], curve[k + 1]]);
                let right = [knots[k] - from, knots[k + 1] - from];
                let to_right = segment_3(knots[k + 1] - knots[k], lamp, curve, right);
                weights[cell][axis] += segment_2(knots[k + 1] - knots[k], lamp, curve) - to_right;
                weights[cell + 1][axis] += to_right;
            }
        }
    }
    debug_assert_eq!(LAMBDA_MIN_NM + (KNOTS - 1) as f64, LAMBDA_MAX_NM);
    let y_of_white: f64 = weights.iter().map(|w| w.y).sum();
    weights.into_iter().map(|w| w / y_of_white).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::srgb_decode;
    use proptest::prelude::*;

    /// n³ colours uniform in encoded sRGB.
    fn cube(n: usize) -> Vec<[f64; 3]> {
        let level = |i: usize| srgb_decode(i as f64 / (n - 1) as f64);
        (0..n * n * n).map(|i| [level(i / n / n), level(i / n % n), level(i % n)]).collect()
    }

    fn largest_difference(a: [f64; 3], b: [f64; 3]) -> f64 {
        (DVec3::from(a) - DVec3::from(b)).abs().max_element()
    }

    #[test]
    fn the_srgb_cube_makes_the_round_trip_within_bounds() {
        let mut worst = 0.0_f64;
        for rgb in cube(9) {
            let spectrum = reflectance(rgb, RgbSpace::srgb()).unwrap();
            let (least, most) = spectrum.range();
            assert!(0.0 <= least && most <= 1.0, "{rgb:?}: {least} {most}");
            worst = worst.max(largest_difference(rgb_of_reflectance(&spectrum, RgbSpace::srgb()), rgb));
        }
        assert!(worst < 1e-10, "{worst:e}");
    }

    #[test]
    fn greys_are_constant_and_the_ends_exact() {
        for grey in [0.0, 1e-9, 0.18, 0.5, 1.0] {
            for space in RgbSpace::all() {
                assert_eq!(reflectance([grey; 3], space).unwrap(), Spectrum::Constant(grey));
            }
        }
        let white = rgb_of_reflectance(&Spectrum::Constant(1.0), RgbSpace::srgb());
        assert!(largest_difference(white, [1.0; 3]) < 1e-14);
    }

    #[test]
    fn dark_and_light_colours_are_solved_relative_to_their_size() {
        let nearly = 1.0 - 1e-7;
        for rgb in [[1e-9, 0.0, 0.0], [0.0, 1e-7, 1e-7], [1.0, 1.0, nearly], [nearly, 1.0, 1.0], [1.0, nearly, 1.0]] {
            let spectrum = reflectance(rgb, RgbSpace::srgb()).unwrap();
            let back = rgb_of_reflectance(&spectrum, RgbSpace::srgb());
            let largest = rgb.into_iter().fold(0.0, f64::max);
            assert!(largest_difference(back, rgb) < 1e-9 * largest, "{rgb:?} {back:?}");
        }
    }

    #[test]
    fn neighbouring_colours_have_neighbouring_spectra() {
        // A step of 1e-4 in colour moves r by no more than 60 times that anywhere, saturated corners included.
        for rgb in cube(5) {
            let near = rgb.map(|c| if c > 0.5 { c - 1e-4 } else { c + 1e-4 });
            let near = [near[0], rgb[1], near[2]];
            let [a, b] = [rgb, near].map(|rgb| reflectance(rgb, RgbSpace::srgb()).unwrap());
            let change = knots_nm().into_iter().map(|l| (a.eval(l) - b.eval(l)).abs()).fold(0.0, f64::max);
            assert!(change < 6e-3, "{rgb:?}: {change}");
        }
    }

    #[test]
    fn emissions_have_the_colour_and_are_positive() {
        let mut worst = 0.0_f64;
        for rgb in cube(6) {
            let spectrum = emission(rgb, RgbSpace::srgb()).unwrap();
            assert!(spectrum.range().0 >= 0.0);
            let xyz = xyz_of_emission(&spectrum, Observer::cie_1931_2deg());
            let expected = RgbSpace::srgb().xyz_from_rgb * DVec3::from(rgb);
            worst = worst.max((xyz - expected).abs().max_element());
        }
        assert!(worst < 1e-10, "{worst:e}");
    }

    #[test]
    fn emissions_scale() {
        let unit = emission([0.2, 1.0, 0.4], RgbSpace::srgb()).unwrap();
        let bright = emission([2e6, 1e7, 4e6], RgbSpace::srgb()).unwrap();
        for lambda in [360.0, 450.0, 555.5, 830.0] {
            assert!((bright.eval(lambda) / unit.eval(lambda) - 1e7).abs() < 1.0);
        }
        assert_eq!(emission([0.0; 3], RgbSpace::srgb()).unwrap(), Spectrum::Constant(0.0));
    }

    #[test]
    fn other_spaces_are_adapted_to_d65() {
        for space in RgbSpace::all() {
            let rgb = [0.35, 0.3, 0.25];
            let back = rgb_of_reflectance(&reflectance(rgb, space).unwrap(), space);
            assert!(largest_difference(back, rgb) < 1e-10, "{}: {back:?}", space.name);
            let back = rgb_of_emission(&emission(rgb, space).unwrap(), space);
            assert!(largest_difference(back, rgb) < 1e-10, "{}: {back:?}", space.name);
            let white = rgb_of_emission(&emission([1.0; 3], space).unwrap(), RgbSpace::srgb());
            assert!(largest_difference(white, [1.0; 3]) < 1e-10, "{}: {white:?}", space.name);
        }
    }

    #[test]
    fn impossible_colours_are_errors() {
        let rec2020 = RgbSpace::by_name("rec2020").unwrap();
        let error = reflectance([0.0, 1.0, 0.0], rec2020).unwrap_err();
        assert_eq!(error.kind, ErrorKind::OutOfRange);
        assert!(error.message.contains("cannot be a reflectance"), "{error}");
        let prophoto = RgbSpace::by_name("prophoto-rgb").unwrap();
        assert!(emission([0.0, 0.0, 1.0], prophoto).unwrap_err().message.contains("cannot be an emission"));
        for bad in [1.5, -0.1, f64::NAN, f64::INFINITY] {
            assert!(reflectance([0.5, bad, 0.5], RgbSpace::srgb()).is_err());
        }
        for bad in [-1e-12, f64::NAN, f64::INFINITY, 1e31] {
            assert!(emission([0.5, bad, 0.5], RgbSpace::srgb()).is_err());
        }
    }

    proptest! {
        #[test]
        fn any_srgb_colour_makes_the_round_trip(rgb in prop::array::uniform3(0.0..=1.0_f64)) {
            let spectrum = reflectance(rgb, RgbSpace::srgb()).unwrap();
            prop_assert!(largest_difference(rgb_of_reflectance(&spectrum, RgbSpace::srgb()), rgb) < 1e-9);
            let spectrum = emission(rgb, RgbSpace::srgb()).unwrap();
            prop_assert!(largest_difference(rgb_of_emission(&spectrum, RgbSpace::srgb()), rgb) < 1e-9);
        }
    }
}
