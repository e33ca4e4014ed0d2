//! CIECAM02.

use super::response::{Correlates, Setting};
use super::{Appearance, ViewingConditions};
use crate::Result;
use crate::color::adaptation::ConeTransform;
use glam::{DMat3, DVec3};

/// Cone responses of Hunt, Pointer and Estévez, for equal-energy white \[CIE159\].
const HUNT_POINTER_ESTEVEZ: DMat3 = DMat3::from_cols(
    DVec3::new(0.38971, -0.22981, 0.0),
    DVec3::new(0.68898, 1.18340, 0.0),
    DVec3::new(-0.07868, 0.04641, 1.0),
);

/// CIECAM02 under viewing conditions \[CIE159\].
///
/// It adapts in CAT02's space and compresses in that of the cones. XYZ has Y = 1 for a perfect diffuser.
///
/// Defined for every finite XYZ: the compression is odd, powers keep the sign of their base. Saturated blues give
/// negative responses, where lightness and chroma lose their meaning. hue_quadrature follows the table of CIE 159, also
/// across the red hue, where colour-science uses Hunt's older constants.
#[derive(Debug, Clone, PartialEq)]
pub struct Ciecam02 {
    cones_from_xyz: DMat3,
    xyz_from_cones: DMat3,
    correlates: Correlates,
}

impl Ciecam02 {
    /// The model under viewing conditions.
    ///
    /// # Errors
    /// A condition that is not a positive finite number, or a white whose sharpened responses are not all positive.
    pub fn new(conditions: &ViewingConditions) -> Result<Self> {
        let setting = Setting::new(conditions)?;
        let cat02 = ConeTransform::Cat02.cone_from_xyz();
        let white = cat02 * (100.0 * conditions.white_xyz);
        let gains = setting.gains(white, 100.0 * conditions.white_xyz.y)?;
        let adaptation = cat02.inverse() * DMat3::from_diagonal(gains) * cat02;
        let cones_from_xyz = HUNT_POINTER_ESTEVEZ * adaptation * 100.0;
        let xyz_from_cones = cones_from_xyz.inverse();
        let white_response = (cones_from_xyz * conditions.white_xyz).map(|x| setting.compress(x));
        Ok(Self { cones_from_xyz, xyz_from_cones, correlates: Correlates::new(setting, white_response) })
    }

    /// The appearance of XYZ.
    pub fn appearance_from_xyz(&self, xyz: DVec3) -> Appearance {
        self.correlates.appearance((self.cones_from_xyz * xyz).map(|x| self.correlates.setting.compress(x)))
    }

    /// XYZ from lightness J, chroma C and hue h in degrees. NaN where the response exceeds what a cone can give.
    pub fn xyz_from_jch(&self, jch: DVec3) -> DVec3 {
        self.xyz_from_cones * self.correlates.response(jch).map(|x| self.correlates.setting.decompress(x))
    }

    /// XYZ from lightness J, colourfulness M and hue h in degrees; else as [`Self::xyz_from_jch`].
    pub fn xyz_from_jmh(&self, jmh: DVec3) -> DVec3 {
        self.xyz_from_jch(DVec3::new(jmh.x, self.correlates.chroma(jmh.y), jmh.z))
    }
}
