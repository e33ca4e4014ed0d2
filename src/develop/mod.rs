//! Makes a picture to be shown from a film: exposure, gamut, tone mapping, transfer curve.

mod operators;

pub use operators::{TONEMAPS, Tonemap};

use crate::color::{LinearRgb, RgbSpace, gamut, srgb_encode};
use crate::{Image, math};
use glam::DVec3;

/// A picture ready to be shown: sRGB, 8 bits a channel, row by row from the top left.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Pixels per row.
    pub width: u32,
    /// Red, green and blue of every pixel.
    pub rgb8: Vec<[u8; 3]>,
    /// Stops by which the picture was exposed.
    pub exposure_ev: f64,
    /// Share of pixels whose colour lies outside sRGB by more than a thousandth of its size, and was moved towards grey.
    pub out_of_gamut: f64,
}

/// Luminance that automatic exposure brings the picture's key to: middle grey.
const KEY: f64 = 0.18;
/// Share of the brightest pixels that automatic exposure leaves out of account.
const GLARE: f64 = 0.02;
/// The brightest pixels counted may exceed white by this factor at automatic exposure.
const HEADROOM: f64 = 4.0;
/// Colours count as outside sRGB where a component is further below 0 than this share of the largest: more than rounding.
const OUTSIDE: f64 = 1e-3;

/// Develops a picture in XYZ, with the given exposure in stops or with that of [`automatic_exposure`].
///
/// # Panics
/// If there are other than three channels.
pub fn develop(xyz: &Image, exposure_ev: Option<f64>, tonemap: Tonemap) -> Picture {
    let exposure_ev = exposure_ev.unwrap_or_else(|| automatic_exposure(xyz));
    let factor = math::exp(exposure_ev * std::f64::consts::LN_2);
    let mut outside = 0usize;
    let rgb8: Vec<[u8; 3]> = xyz
        .triples()
        .iter()
        .map(|&xyz| {
            let linear = RgbSpace::srgb().rgb_from_xyz * (DVec3::from(xyz) * factor);
            outside += usize::from(-linear.min_element() > OUTSIDE * linear.max_element());
            encode(tonemap.apply(gamut::without_negatives(RgbSpace::srgb(), LinearRgb(linear)).0))
        })
        .collect();
    let out_of_gamut = outside as f64 / rgb8.len().max(1) as f64;
    Picture { width: xyz.size()[0], rgb8, exposure_ev, out_of_gamut }
}

/// Computes the exposure in stops that brings the geometric mean of the luminance to middle grey, or the largest at which all
/// but the brightest 2 % of the pixels stay below 4 times white, whichever is less. Black pixels do not count: a caustic on
/// black is exposed for the caustic.
pub fn automatic_exposure(xyz: &Image) -> f64 {
    let mut luminance: Vec<f64> = xyz.plane(1).filter(|y| *y > 0.0 && y.is_finite()).collect();
    if luminance.is_empty() {
        return 0.0;
    }
    luminance.sort_by(f64::total_cmp);
    let bright = luminance[((1.0 - GLARE) * (luminance.len() - 1) as f64) as usize];
    // Pixels far below the bright ones are shadow: they count as brighter than they are, so as not to pull the exposure up
    // without bound.
    let floor = bright * 1e-3;
    let log_mean = luminance.iter().map(|y| math::ln(y.max(floor))).sum::<f64>() / luminance.len() as f64;
    let by_key = KEY / math::exp(log_mean);
    math::ln(by_key.min(HEADROOM / bright)) / std::f64::consts::LN_2
}

/// Encodes a colour in 8 bits. One that is too bright is scaled until its largest component is 1, and mixed with white the more
/// the brighter it is.
fn encode(linear: DVec3) -> [u8; 3] {
    let peak = linear.max_element();
    let shown = if peak > 1.0 {
        // What exceeds white bleeds into the other channels, as it does on film.
        let excess = peak - 1.0;
        (linear / peak).lerp(DVec3::ONE, (excess / (excess + 2.0)).clamp(0.0, 1.0))
    } else {
        linear
    };
    shown.to_array().map(|x| (srgb_encode(x.clamp(0.0, 1.0)) * 255.0 + 0.5) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(xyz: [f64; 3], exposure_ev: f64, tonemap: Tonemap) -> Picture {
        develop(&Image::xyz(1, vec![xyz]).unwrap(), Some(exposure_ev), tonemap)
    }

    #[test]
    fn grey_stays_grey_and_white_is_white() {
        let white = RgbSpace::srgb().white_xyz();
        for y in [0.0, 0.18, 0.5, 1.0] {
            let picture = shown((white * y).to_array(), 0.0, Tonemap::Srgb);
            let expected = (srgb_encode(y) * 255.0 + 0.5) as u8;
            assert_eq!(picture.rgb8[0], [expected; 3]);
            assert_eq!(picture.out_of_gamut, 0.0);
        }
        assert_eq!(shown((white * 0.25).to_array(), 2.0, Tonemap::Srgb).rgb8[0], [255; 3]);
    }

    /// A laser line is outside sRGB: it loses saturation, not hue, and is counted.
    #[test]
    fn saturated_colors_are_counted() {
        let picture = shown([0.1, 0.5, 0.05], 0.0, Tonemap::Srgb);
        assert_eq!(picture.out_of_gamut, 1.0);
        let [r, g, b] = picture.rgb8[0];
        assert!(g > r && g > b, "{r} {g} {b}");
    }

    #[test]
    fn automatic_exposure_brings_grey_to_the_key() {
        let exposure = |xyz: Vec<[f64; 3]>| automatic_exposure(&Image::xyz(2, xyz).unwrap());
        assert!((exposure(vec![[0.5; 3]; 100]) - (0.18f64 / 0.5).log2()).abs() < 1e-12);
        assert_eq!(exposure(vec![[0.0; 3]; 4]), 0.0);
    }

    #[test]
    fn operators() {
        let white = RgbSpace::srgb().white_xyz();
        let level = |tonemap| shown(white.to_array(), 0.0, tonemap).rgb8[0][1];
        assert_eq!(level(Tonemap::Reinhard), (srgb_encode(0.5) * 255.0 + 0.5) as u8);
        assert_eq!(level(Tonemap::Exponential), (srgb_encode(1.0 - math::exp(-1.0)) * 255.0 + 0.5) as u8);
    }
}
