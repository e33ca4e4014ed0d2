//! CIECAM16.

use super::cam16::adapted_response_from_xyz;
use super::response::{Correlates, Setting};
use super::{Appearance, ViewingConditions};
use crate::Result;
use crate::math::pow;
use glam::{DMat3, DVec3};

/// Below this signal (100 for white) the compression is a straight line through 0 \[CIE248\].
const LOW: f64 = 0.26;
/// Above this signal it is a straight line too.
const HIGH: f64 = 150.0;

/// CIECAM16 under viewing conditions \[CIE248\]: CAM16 with a compression that is straight at both ends.
///
/// Defined for every finite XYZ, and invertible for those of finite appearance; dark and negative responses do not
/// have the infinite slope that CAM16 has at 0. XYZ has Y = 1 for a perfect diffuser. The white is adapted to a response of
/// 100 whatever its Y, where CAM16 takes its Y.
#[derive(Debug, Clone, PartialEq)]
pub struct Ciecam16 {
    response_from_xyz: DMat3,
    xyz_from_response: DMat3,
    compression: Compression,
    correlates: Correlates,
}

/// The extended compression: values at the ends of its curved part, and the slope of the upper line.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Compression {
    low: f64,
    high: f64,
    high_slope: f64,
}

impl Compression {
    fn new(setting: &Setting) -> Self {
        let scaled = setting.f_l * HIGH / 100.0;
        let denominator = 27.13 + pow(scaled, 0.42);
        let high_slope = 1.68 * 27.13 * setting.f_l * pow(scaled, -0.58) / (denominator * denominator);
        Self { low: setting.compress(LOW), high: setting.compress(HIGH), high_slope }
    }

    fn compress(&self, setting: &Setting, x: f64) -> f64 {
        if x > HIGH {
            self.high + self.high_slope * (x - HIGH)
        } else if x < LOW {
            self.low * x / LOW
        } else {
            setting.compress(x)
        }
    }

    fn decompress(&self, setting: &Setting, response: f64) -> f64 {
        if response > self.high {
            HIGH + (response - self.high) / self.high_slope
        } else if response < self.low {
            LOW * response / self.low
        } else {
            setting.decompress(response)
        }
    }
}

impl Ciecam16 {
    /// The model under viewing conditions.
    ///
    /// # Errors
    /// A condition that is not a positive finite number, or a white whose responses are not all positive.
    pub fn new(conditions: &ViewingConditions) -> Result<Self> {
        let (response_from_xyz, setting) = adapted_response_from_xyz(conditions, 100.0)?;
        let white_response = (response_from_xyz * conditions.white_xyz).map(|x| setting.compress(x));
        let correlates = Correlates::new(setting, white_response);
        let compression = Compression::new(&setting);
        Ok(Self { response_from_xyz, xyz_from_response: response_from_xyz.inverse(), compression, correlates })
    }

    /// The appearance of XYZ.
    pub fn appearance_from_xyz(&self, xyz: DVec3) -> Appearance {
        let compress = |x| self.compression.compress(&self.correlates.setting, x);
        self.correlates.appearance((self.response_from_xyz * xyz).map(compress))
    }

    /// XYZ from lightness J, chroma C and hue h in degrees.
    pub fn xyz_from_jch(&self, jch: DVec3) -> DVec3 {
        let decompress = |x| self.compression.decompress(&self.correlates.setting, x);
        self.xyz_from_response * self.correlates.response(jch).map(decompress)
    }

    /// XYZ from lightness J, colourfulness M and hue h in degrees.
    pub fn xyz_from_jmh(&self, jmh: DVec3) -> DVec3 {
        self.xyz_from_jch(DVec3::new(jmh.x, self.correlates.chroma(jmh.y), jmh.z))
    }
}
