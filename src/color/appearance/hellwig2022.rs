//! Hellwig and Fairchild's revision of CAM16.

use super::cam16::adapted_response_from_xyz;
use super::response::{
    Setting, UNIQUE_HUES, achromatic, hue_degrees, opponent, ratio_or_zero, response_from_opponent, signed_pow,
};
use super::{Appearance, ViewingConditions};
use crate::Result;
use crate::math::{cos, sin};
use glam::{DMat3, DVec3};
use std::f64::consts::PI;

/// Hellwig and Fairchild's model under viewing conditions \[Hellwig2022\]: CAM16 with simpler correlates of brightness,
/// colourfulness, chroma and saturation that follow the data of their definitions.
///
/// XYZ has Y = 1 for a perfect diffuser. [`Self::helmholtz_kohlrausch`] adds the effect that a colourful light looks brighter
/// than a white one of its luminance \[Hellwig2022a\].
#[derive(Debug, Clone, PartialEq)]
pub struct Hellwig2022 {
    response_from_xyz: DMat3,
    xyz_from_response: DMat3,
    setting: Setting,
    white_achromatic: f64,
}

/// Lightness and brightness with the Helmholtz–Kohlrausch effect \[Hellwig2022a\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HelmholtzKohlrausch {
    /// J_HK; 100 for the white.
    pub lightness: f64,
    /// Q_HK.
    pub brightness: f64,
}

/// How strongly opponent signals of a hue count: a Fourier series.
fn eccentricity(hue_degrees: f64) -> f64 {
    let h = hue_degrees * (PI / 180.0);
    -0.0582 * cos(h) - 0.0258 * cos(2.0 * h) - 0.1347 * cos(3.0 * h) + 0.0289 * cos(4.0 * h)
        - 0.1475 * sin(h)
        - 0.0308 * sin(2.0 * h)
        + 0.0385 * sin(3.0 * h)
        + 0.0096 * sin(4.0 * h)
        + 1.0
}

/// J_HK − J for a chroma and a hue.
fn lightness_gain(chroma: f64, hue_degrees: f64) -> f64 {
    let h = hue_degrees * (PI / 180.0);
    let of_hue = -0.160 * cos(h) + 0.132 * cos(2.0 * h) - 0.405 * sin(h) + 0.080 * sin(2.0 * h) + 0.792;
    of_hue * signed_pow(chroma, 0.587)
}

impl Hellwig2022 {
    /// The model under viewing conditions.
    ///
    /// # Errors
    /// A condition that is not a positive finite number, or a white whose responses are not all positive.
    pub fn new(conditions: &ViewingConditions) -> Result<Self> {
        let (response_from_xyz, setting) = adapted_response_from_xyz(conditions, 100.0 * conditions.white_xyz.y)?;
        let white_response = (response_from_xyz * conditions.white_xyz).map(|x| setting.compress(x));
        let white_achromatic = achromatic(white_response);
        Ok(Self { response_from_xyz, xyz_from_response: response_from_xyz.inverse(), setting, white_achromatic })
    }

    fn brightness(&self, lightness: f64) -> f64 {
        2.0 / self.setting.surround.impact * (lightness / 100.0) * self.white_achromatic
    }

    fn weight(&self, hue_degrees: f64) -> f64 {
        43.0 * self.setting.surround.chromatic_induction * eccentricity(hue_degrees)
    }

    fn lightness_exponent(&self) -> f64 {
        self.setting.surround.impact * self.setting.z
    }

    /// The appearance of XYZ, without the Helmholtz–Kohlrausch effect.
    pub fn appearance_from_xyz(&self, xyz: DVec3) -> Appearance {
        let response = (self.response_from_xyz * xyz).map(|x| self.setting.compress(x));
        let [a, b] = opponent(response);
        let hue_degrees = hue_degrees(a, b);
        let relative = achromatic(response) / self.white_achromatic;
        let lightness = 100.0 * signed_pow(relative, self.lightness_exponent());
        let brightness = self.brightness(lightness);
        let colorfulness = self.weight(hue_degrees) * (a * a + b * b).sqrt();
        Appearance {
            lightness,
            chroma: 35.0 * colorfulness / self.white_achromatic,
            hue_degrees,
            saturation: 100.0 * ratio_or_zero(colorfulness, brightness),
            brightness,
            colorfulness,
            hue_quadrature: UNIQUE_HUES.quadrature(hue_degrees),
        }
    }

    /// Lightness and brightness of an appearance with the Helmholtz–Kohlrausch effect.
    pub fn helmholtz_kohlrausch(&self, appearance: &Appearance) -> HelmholtzKohlrausch {
        let lightness = appearance.lightness + lightness_gain(appearance.chroma, appearance.hue_degrees);
        HelmholtzKohlrausch { lightness, brightness: self.brightness(lightness) }
    }

    /// XYZ from lightness J, chroma C and hue h in degrees. NaN where the response exceeds what a cone can give.
    pub fn xyz_from_jch(&self, jch: DVec3) -> DVec3 {
        self.xyz_from_jmh(DVec3::new(jch.x, jch.y * self.white_achromatic / 35.0, jch.z))
    }

    /// XYZ from lightness J_HK with the Helmholtz–Kohlrausch effect, chroma C and hue h in degrees.
    pub fn xyz_from_jch_hk(&self, jch: DVec3) -> DVec3 {
        self.xyz_from_jch(DVec3::new(jch.x - lightness_gain(jch.y, jch.z), jch.y, jch.z))
    }

    /// XYZ from lightness J, colourfulness M and hue h in degrees; else as [`Self::xyz_from_jch`].
    pub fn xyz_from_jmh(&self, jmh: DVec3) -> DVec3 {
        let achromatic = self.white_achromatic * signed_pow(jmh.x / 100.0, 1.0 / self.lightness_exponent());
        let length = jmh.y / self.weight(jmh.z);
        let (sin_h, cos_h) = (sin(jmh.z * (PI / 180.0)), cos(jmh.z * (PI / 180.0)));
        let response = response_from_opponent(achromatic, length * cos_h, length * sin_h);
        self.xyz_from_response * response.map(|x| self.setting.decompress(x))
    }
}
