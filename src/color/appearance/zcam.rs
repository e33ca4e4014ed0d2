//! ZCAM.

use super::response::{UniqueHues, degree_of_adaptation, hue_degrees, ratio_or_zero, signed_pow};
use super::{Appearance, ViewingConditions};
use crate::color::adaptation::{ConeTransform, zhai2018};
use crate::color::xyz_from_xy;
use crate::math::{cos, exp, pow, sin};
use crate::{Error, ErrorKind, Result};
use glam::{DMat3, DVec3};
use std::f64::consts::PI;

/// The stretch of XYZ that makes the lines of constant blue straight \[Safdar2017\].
const STRETCH: DMat3 =
    DMat3::from_cols(DVec3::new(1.15, 1.0 - 0.66, 0.0), DVec3::new(0.0, 0.66, 0.0), DVec3::new(1.0 - 1.15, 0.0, 1.0));

/// Cone responses from stretched XYZ \[Safdar2017\].
const LMS_FROM_STRETCHED: DMat3 = DMat3::from_cols(
    DVec3::new(0.41478972, -0.20151, -0.0166008),
    DVec3::new(0.579999, 1.120649, 0.2648),
    DVec3::new(0.0146480, 0.0531008, 0.6684799),
);

/// I_z, a_z, b_z from compressed cone responses \[Safdar2021\].
const IZAZBZ_FROM_LMS: DMat3 = DMat3::from_cols(
    DVec3::new(0.0, 3.524000, 0.199076),
    DVec3::new(1.0, -4.066708, 1.096799),
    DVec3::new(0.0, 0.542708, -1.295875),
);

/// What I_z of black is lowered by, so that it is 0.
const BLACK_I_Z: f64 = 3.703_522_621_019_000_6e-11;

/// Constants of the perceptual quantiser, the second exponent times 1.7 \[Safdar2017\].
const PQ_C: [f64; 3] = [3424.0 / 4096.0, 2413.0 / 128.0, 2392.0 / 128.0];
const PQ_M: [f64; 2] = [2610.0 / 16384.0, 1.7 * 2523.0 / 32.0];

const UNIQUE_HUES: UniqueHues =
    UniqueHues { degrees: [33.44, 89.29, 146.30, 238.36], eccentricities: [0.68, 0.64, 1.52, 0.77] };

/// The quantiser's code of a cone response in cd/m². Below 0, where the published curve has a pole, it goes on
/// point-symmetrically about its value there.
fn compress(x: f64) -> f64 {
    let p = pow(x.abs() / 10_000.0, PQ_M[0]);
    let code = pow((PQ_C[0] + PQ_C[1] * p) / (PQ_C[2] * p + 1.0), PQ_M[1]);
    if x < 0.0 { 2.0 * code_of_black() - code } else { code }
}

/// Inverse of [`compress`]; NaN for codes that no response reaches.
fn decompress(code: f64) -> f64 {
    let from_black = code - code_of_black();
    let root = pow(code_of_black() + from_black.abs(), 1.0 / PQ_M[1]);
    let p = (root - PQ_C[0]).max(0.0) / (PQ_C[1] - PQ_C[2] * root);
    (10_000.0 * pow(p, 1.0 / PQ_M[0])).copysign(from_black)
}

fn code_of_black() -> f64 {
    pow(PQ_C[0], PQ_M[1])
}

/// ZCAM under viewing conditions \[Safdar2021\]: a model for high dynamic range, in which light is absolute.
///
/// XYZ, the white and the background are in cd/m² (Y of the white is its luminance). Responses to more than 10⁴ cd/m² are
/// extrapolated, those below 0 mirrored; defined for every finite XYZ.
#[derive(Debug, Clone, PartialEq)]
pub struct Zcam {
    lms_from_xyz: DMat3,
    xyz_from_lms: DMat3,
    izazbz_from_lms: DMat3,
    lms_from_izazbz: DMat3,
    /// Exponent of I_z in brightness.
    exponent: f64,
    /// Factor of brightness: 2700 F_s^2.2 F_b^0.5 F_L^0.2.
    factor: f64,
    white_brightness: f64,
    /// Factor of colourfulness, without that of hue.
    colorfulness_factor: f64,
    saturation_factor: f64,
}

/// Correlates that ZCAM adds: the two dimensions of painters and physicists' scales of purity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ZcamScales {
    /// V: distance from a dark grey.
    pub vividness: f64,
    /// K: 100 for black.
    pub blackness: f64,
    /// W: 100 for the white.
    pub whiteness: f64,
}

impl Zcam {
    /// The model under viewing conditions in cd/m².
    ///
    /// # Errors
    /// A condition that is not a positive finite number, or a white whose sharpened responses are not all positive.
    pub fn new(conditions: &ViewingConditions) -> Result<Self> {
        conditions.check()?;
        let adaptation = adaptation_to_d65(conditions)?;
        let lms_from_xyz = LMS_FROM_STRETCHED * STRETCH * adaptation;
        // The white's I_z is that of its XYZ as they are, not adapted.
        let white_i_z = (LMS_FROM_STRETCHED * STRETCH * conditions.white_xyz).map(compress).y - BLACK_I_Z;
        let f_s = conditions.surround.impact;
        let f_b = (conditions.background_y / conditions.white_xyz.y).sqrt();
        let l_a = conditions.adapting_luminance;
        let f_l = 0.171 * pow(l_a, 1.0 / 3.0) * (1.0 - exp(-48.0 / 9.0 * l_a));
        let exponent = 1.6 * f_s / pow(f_b, 0.12);
        let factor = 2700.0 * pow(f_s, 2.2) * f_b.sqrt() * pow(f_l, 0.2);
        Ok(Self {
            lms_from_xyz,
            xyz_from_lms: lms_from_xyz.inverse(),
            izazbz_from_lms: IZAZBZ_FROM_LMS,
            lms_from_izazbz: IZAZBZ_FROM_LMS.inverse(),
            exponent,
            factor,
            white_brightness: factor * signed_pow(white_i_z, exponent),
            colorfulness_factor: 100.0 * pow(f_l, 0.2) / (pow(f_b, 0.1) * signed_pow(white_i_z, 0.78)),
            saturation_factor: 100.0 * pow(f_l, 0.6),
        })
    }

    /// The appearance of XYZ in cd/m².
    pub fn appearance_from_xyz(&self, xyz: DVec3) -> Appearance {
        let DVec3 { x: i_z, y: a, z: b } = self.izazbz_from_lms * (self.lms_from_xyz * xyz).map(compress);
        let hue_degrees = hue_degrees(a, b);
        let brightness = self.factor * signed_pow(i_z - BLACK_I_Z, self.exponent);
        let colorfulness = self.colorfulness_factor * hue_factor(hue_degrees) * pow(a * a + b * b, 0.37);
        Appearance {
            lightness: 100.0 * brightness / self.white_brightness,
            chroma: 100.0 * colorfulness / self.white_brightness,
            hue_degrees,
            saturation: self.saturation_factor * signed_pow(ratio_or_zero(colorfulness, brightness), 0.5),
            brightness,
            colorfulness,
            hue_quadrature: UNIQUE_HUES.quadrature(hue_degrees),
        }
    }

    /// Vividness, blackness and whiteness of an appearance.
    pub fn scales(appearance: &Appearance) -> ZcamScales {
        let (j, c) = (appearance.lightness, appearance.chroma);
        ZcamScales {
            vividness: ((j - 58.0) * (j - 58.0) + 3.4 * c * c).sqrt(),
            blackness: 100.0 - 0.8 * (j * j + 8.0 * c * c).sqrt(),
            whiteness: 100.0 - ((100.0 - j) * (100.0 - j) + c * c).sqrt(),
        }
    }

    /// XYZ in cd/m² from lightness J, chroma C and hue h in degrees.
    pub fn xyz_from_jch(&self, jch: DVec3) -> DVec3 {
        self.xyz_from_jmh(DVec3::new(jch.x, jch.y * self.white_brightness / 100.0, jch.z))
    }

    /// XYZ in cd/m² from lightness J, colourfulness M and hue h in degrees.
    pub fn xyz_from_jmh(&self, jmh: DVec3) -> DVec3 {
        let brightness = jmh.x / 100.0 * self.white_brightness;
        let i_z = signed_pow(brightness / self.factor, 1.0 / self.exponent) + BLACK_I_Z;
        let length = signed_pow(jmh.y / (self.colorfulness_factor * hue_factor(jmh.z)), 1.0 / 0.74);
        let h = jmh.z * (PI / 180.0);
        let response = self.lms_from_izazbz * DVec3::new(i_z, length * cos(h), length * sin(h));
        self.xyz_from_lms * response.map(decompress)
    }
}

/// e_z^0.068: how strongly a hue's opponent signals count.
fn hue_factor(hue_degrees: f64) -> f64 {
    pow(1.015 + cos((89.038 + hue_degrees) * (PI / 180.0)), 0.068)
}

/// XYZ under the white to XYZ under D65 of Y = 1, over the equal-energy illuminant in two steps \[Zhai2018\].
///
/// # Errors
/// A white whose sharpened responses are not all positive.
fn adaptation_to_d65(conditions: &ViewingConditions) -> Result<DMat3> {
    let white = ConeTransform::Cat02.cone_from_xyz() * conditions.white_xyz;
    if !(white.min_element() > 0.0 && white.is_finite()) {
        let message = format!("cone responses {white} of the white; expected positive finite ones");
        return Err(Error::new(ErrorKind::OutOfRange, message).at("white_xyz"));
    }
    let (degree, d65) = (degree_of_adaptation(conditions), xyz_from_xy([0.3127, 0.3290]));
    Ok(zhai2018(conditions.white_xyz, d65, [degree; 2], DVec3::ONE, ConeTransform::Cat02))
}
