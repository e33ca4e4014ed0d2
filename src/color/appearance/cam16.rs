//! CAM16.

use super::response::{Correlates, Setting};
use super::{Appearance, ViewingConditions};
use crate::Result;
use crate::color::adaptation::ConeTransform;
use glam::{DMat3, DVec3};

/// XYZ to adapted responses of CAT16 (100 for white), and the setting; `neutral` is what a white's response becomes.
///
/// # Errors
/// As the models'.
pub(super) fn adapted_response_from_xyz(conditions: &ViewingConditions, neutral: f64) -> Result<(DMat3, Setting)> {
    let setting = Setting::new(conditions)?;
    let cat16 = ConeTransform::Cat16.cone_from_xyz();
    let gains = setting.gains(cat16 * (100.0 * conditions.white_xyz), neutral)?;
    Ok((DMat3::from_diagonal(gains * 100.0) * cat16, setting))
}

/// CAM16 under viewing conditions \[Li2017\]: CIECAM02 with one space for adaptation and compression.
///
/// Defined for every finite XYZ: the compression is odd, powers keep the sign of their base. XYZ has Y = 1 for a perfect
/// diffuser.
#[derive(Debug, Clone, PartialEq)]
pub struct Cam16 {
    response_from_xyz: DMat3,
    xyz_from_response: DMat3,
    correlates: Correlates,
}

impl Cam16 {
    /// The model under viewing conditions.
    ///
    /// # Errors
    /// A condition that is not a positive finite number, or a white whose responses are not all positive.
    pub fn new(conditions: &ViewingConditions) -> Result<Self> {
        let (response_from_xyz, setting) = adapted_response_from_xyz(conditions, 100.0 * conditions.white_xyz.y)?;
        let white_response = (response_from_xyz * conditions.white_xyz).map(|x| setting.compress(x));
        let correlates = Correlates::new(setting, white_response);
        Ok(Self { response_from_xyz, xyz_from_response: response_from_xyz.inverse(), correlates })
    }

    /// The appearance of XYZ.
    pub fn appearance_from_xyz(&self, xyz: DVec3) -> Appearance {
        self.correlates.appearance((self.response_from_xyz * xyz).map(|x| self.correlates.setting.compress(x)))
    }

    /// XYZ from lightness J, chroma C and hue h in degrees. NaN where the response exceeds what a cone can give.
    pub fn xyz_from_jch(&self, jch: DVec3) -> DVec3 {
        self.xyz_from_response * self.correlates.response(jch).map(|x| self.correlates.setting.decompress(x))
    }

    /// XYZ from lightness J, colourfulness M and hue h in degrees; else as [`Self::xyz_from_jch`].
    pub fn xyz_from_jmh(&self, jmh: DVec3) -> DVec3 {
        self.xyz_from_jch(DVec3::new(jmh.x, self.correlates.chroma(jmh.y), jmh.z))
    }
}
