//! What CIECAM02 and its descendants share: adaptation to luminance, the compressed response, opponent signals, correlates.
//!
//! The compressed responses here are the textbook's minus 0.1, so that black is 0; the constants of the textbook's
//! formulas are moved accordingly (A loses its −0.305, the denominator of t gains 0.305).

use super::{Appearance, Surround, ViewingConditions};
use crate::math::{atan2, cos, exp, pow, sin};
use crate::{Error, ErrorKind, Result};
use glam::DVec3;
use std::f64::consts::PI;

/// 2·0.1 + 0.1 + 0.1/20 and 0.1 + 0.1 + 21/20·0.1: what the textbook's 0.1 adds to both sums.
const OFFSET_SUM: f64 = 0.305;

/// x^p with the sign of x.
pub(super) fn signed_pow(x: f64, p: f64) -> f64 {
    pow(x.abs(), p).copysign(x)
}

/// a / b, and 0 where b is 0.
pub(super) fn ratio_or_zero(a: f64, b: f64) -> f64 {
    if b == 0.0 { 0.0 } else { a / b }
}

/// Hue angle in degrees, [0, 360).
pub(super) fn hue_degrees(a: f64, b: f64) -> f64 {
    let degrees = atan2(b, a) * (180.0 / PI);
    let positive = if degrees < 0.0 { degrees + 360.0 } else { degrees };
    // A tiny negative angle rounds up to a full turn.
    if positive >= 360.0 { 0.0 } else { positive }
}

/// The degree of adaptation D to the white, [0, 1]; 1 where the illuminant is discounted.
pub(super) fn degree_of_adaptation(conditions: &ViewingConditions) -> f64 {
    if conditions.discount_illuminant {
        return 1.0;
    }
    let degree = conditions.surround.adaptation * (1.0 - exp((-conditions.adapting_luminance - 42.0) / 92.0) / 3.6);
    degree.clamp(0.0, 1.0)
}

/// The four unique hues, red, yellow, green and blue, with their eccentricities.
pub(super) struct UniqueHues {
    /// Degrees; ascending.
    pub degrees: [f64; 4],
    /// Eccentricities.
    pub eccentricities: [f64; 4],
}

/// Compression of CIECAM02 \[CIE159\].
pub(super) const UNIQUE_HUES: UniqueHues =
    UniqueHues { degrees: [20.14, 90.0, 164.25, 237.53], eccentricities: [0.8, 0.7, 1.0, 1.2] };

impl UniqueHues {
    /// H, [0, 400): 100 for each unique hue passed since red, and the share of the next.
    pub(super) fn quadrature(&self, hue_degrees: f64) -> f64 {
        let hue = if hue_degrees < self.degrees[0] { hue_degrees + 360.0 } else { hue_degrees };
        let passed = self.degrees.iter().rposition(|&unique| unique <= hue).unwrap_or(0);
        let next = (passed + 1) % 4;
        let next_degrees = if next == 0 { self.degrees[0] + 360.0 } else { self.degrees[next] };
        let since = (hue - self.degrees[passed]) / self.eccentricities[passed];
        let until = (next_degrees - hue) / self.eccentricities[next];
        100.0 * (passed as f64 + since / (since + until))
    }
}

/// What the viewing conditions make of luminance, background and surround.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Setting {
    /// D: degree of adaptation to the white.
    pub degree: f64,
    /// F_L: adaptation to luminance.
    pub f_l: f64,
    /// z: exponent that the background adds to lightness.
    pub z: f64,
    /// N_bb = N_cb: induction by the background.
    pub induction: f64,
    /// (1.64 − 0.29ⁿ)^0.73: how the background changes chroma.
    pub chroma_factor: f64,
    pub surround: Surround,
}

impl Setting {
    /// # Errors
    /// Conditions out of range.
    pub(super) fn new(conditions: &ViewingConditions) -> Result<Self> {
        conditions.check()?;
        let n = conditions.background_y / conditions.white_xyz.y;
        let five_l = 5.0 * conditions.adapting_luminance;
        let k = 1.0 / (five_l + 1.0);
        let k4 = (k * k) * (k * k);
        Ok(Self {
            degree: degree_of_adaptation(conditions),
            f_l: 0.2 * k4 * five_l + 0.1 * (1.0 - k4) * (1.0 - k4) * pow(five_l, 1.0 / 3.0),
            z: 1.48 + n.sqrt(),
            induction: 0.725 * pow(1.0 / n, 0.2),
            chroma_factor: pow(1.64 - pow(0.29, n), 0.73),
            surround: conditions.surround,
        })
    }

    /// Gains of adaptation in the space of `white` (100 for Y = 1), which they take D of the way to `neutral`.
    ///
    /// # Errors
    /// A white whose responses are not all positive.
    pub(super) fn gains(&self, white: DVec3, neutral: f64) -> Result<DVec3> {
        if !(white.min_element() > 0.0 && white.is_finite()) {
            let message = format!("cone responses {white} of the white; expected positive finite ones");
            return Err(Error::new(ErrorKind::OutOfRange, message).at("white_xyz"));
        }
        Ok(self.degree * neutral / white + (1.0 - self.degree))
    }

    /// The compressed response to a cone's signal (100 for white), odd in it.
    pub(super) fn compress(&self, x: f64) -> f64 {
        let p = pow(self.f_l * x.abs() / 100.0, 0.42);
        (400.0 * p / (27.13 + p)).copysign(x)
    }

    /// The signal of a compressed response; NaN from ±400 on, which no signal reaches.
    pub(super) fn decompress(&self, response: f64) -> f64 {
        let size = response.abs();
        if size >= 400.0 {
            return f64::NAN;
        }
        (100.0 / self.f_l * pow(27.13 * size / (400.0 - size), 1.0 / 0.42)).copysign(response)
    }
}

/// Opponent signals (a: red–green, b: yellow–blue) of compressed responses.
pub(super) fn opponent(response: DVec3) -> [f64; 2] {
    let DVec3 { x: r, y: g, z: b } = response;
    [r - 12.0 * g / 11.0 + b / 11.0, (r + g - 2.0 * b) / 9.0]
}

/// 2 R' + G' + B'/20: the achromatic signal, before induction.
pub(super) fn achromatic(response: DVec3) -> f64 {
    2.0 * response.x + response.y + 0.05 * response.z
}

/// Compressed responses of an achromatic signal and opponent signals: the inverse of [`achromatic`] and [`opponent`].
pub(super) fn response_from_opponent(achromatic: f64, a: f64, b: f64) -> DVec3 {
    DVec3::new(
        460.0 * achromatic + 451.0 * a + 288.0 * b,
        460.0 * achromatic - 891.0 * a - 261.0 * b,
        460.0 * achromatic - 220.0 * a - 6300.0 * b,
    ) / 1403.0
}

/// Turns compressed responses into appearance and back, as CIECAM02, CAM16 and CIECAM16 have it in common.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Correlates {
    pub setting: Setting,
    /// A_w: the white's achromatic response, with induction.
    pub white_achromatic: f64,
}

impl Correlates {
    pub(super) fn new(setting: Setting, white_response: DVec3) -> Self {
        Self { setting, white_achromatic: achromatic(white_response) * setting.induction }
    }

    /// e_t · 50000/13 N_c N_cb: how strongly a hue's opponent signals count.
    fn hue_weight(&self, hue_degrees: f64) -> f64 {
        let eccentricity = 0.25 * (cos(2.0 + hue_degrees * (PI / 180.0)) + 3.8);
        50_000.0 / 13.0 * self.setting.surround.chromatic_induction * self.setting.induction * eccentricity
    }

    /// J from an achromatic signal without induction.
    fn lightness(&self, achromatic: f64) -> f64 {
        let relative = achromatic * self.setting.induction / self.white_achromatic;
        100.0 * signed_pow(relative, self.setting.surround.impact * self.setting.z)
    }

    pub(super) fn appearance(&self, response: DVec3) -> Appearance {
        let [a, b] = opponent(response);
        let hue_degrees = hue_degrees(a, b);
        let lightness = self.lightness(achromatic(response));
        let sum = response.x + response.y + 1.05 * response.z + OFFSET_SUM;
        let t = self.hue_weight(hue_degrees) * (a * a + b * b).sqrt() / sum;
        let root = signed_pow(lightness / 100.0, 0.5);
        let chroma = signed_pow(t, 0.9) * root * self.setting.chroma_factor;
        let f_l_root = pow(self.setting.f_l, 0.25);
        let brightness = 4.0 / self.setting.surround.impact * root * (self.white_achromatic + 4.0) * f_l_root;
        let colorfulness = chroma * f_l_root;
        Appearance {
            lightness,
            chroma,
            hue_degrees,
            saturation: 100.0 * signed_pow(ratio_or_zero(colorfulness, brightness), 0.5),
            brightness,
            colorfulness,
            hue_quadrature: UNIQUE_HUES.quadrature(hue_degrees),
        }
    }

    /// C from M.
    pub(super) fn chroma(&self, colorfulness: f64) -> f64 {
        colorfulness / pow(self.setting.f_l, 0.25)
    }

    /// Compressed responses from lightness, chroma and hue. Where J = 0 chroma says nothing: black.
    pub(super) fn response(&self, jch: DVec3) -> DVec3 {
        let (j, chroma, hue) = (jch.x, jch.y, jch.z);
        if j == 0.0 {
            return DVec3::ZERO;
        }
        let root = signed_pow(j / 100.0, 0.5);
        let t = signed_pow(chroma / (root * self.setting.chroma_factor), 1.0 / 0.9);
        let exponent = 1.0 / (self.setting.surround.impact * self.setting.z);
        let achromatic = self.white_achromatic * signed_pow(j / 100.0, exponent) / self.setting.induction;
        let (sin_h, cos_h) = (sin(hue * (PI / 180.0)), cos(hue * (PI / 180.0)));
        // The length of (a, b) solves t = weight · length / (R' + G' + 21/20 B' + 0.305), where the sum is linear in it.
        let length =
            23.0 * (achromatic + OFFSET_SUM) * t / (23.0 * self.hue_weight(hue) + 11.0 * t * cos_h + 108.0 * t * sin_h);
        response_from_opponent(achromatic, length * cos_h, length * sin_h)
    }
}
