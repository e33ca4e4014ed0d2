//! hdr-CIELAB and hdr-IPT: the shapes of Lab and IPT over lightness that follows the Michaelis-Menten curve, so that
//! colours brighter than white have a place.

use super::power::ipt_matrices;
use crate::color::lightness::{HdrEdition, hdr_lightness, hdr_luminance};
use crate::math;
use glam::DVec3;

/// Viewing conditions and edition of the hdr spaces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HdrConditions {
    /// Luminance of the surround relative to white, 0 to below 0.92, where the formula for the exponent ends.
    pub surround: f64,
    /// Absolute luminance of white, cd/m²; above 1.
    pub white_cd_m2: f64,
    /// Which of the two papers.
    pub edition: HdrEdition,
}

impl Default for HdrConditions {
    /// A grey surround of 0.2 and a white of 100 cd/m², by the later paper.
    fn default() -> Self {
        Self { surround: 0.2, white_cd_m2: 100.0, edition: HdrEdition::Fairchild2011 }
    }
}

impl HdrConditions {
    /// The exponent ε from its value at the reference conditions in the two papers.
    fn exponent(&self, of_2010: f64, of_2011: f64) -> f64 {
        let surround = 1.25 - 0.25 * (self.surround / 0.184);
        let luminance = math::ln(318.0) / math::ln(self.white_cd_m2);
        match self.edition {
            HdrEdition::Fairchild2010 => of_2010 * (surround * luminance),
            HdrEdition::Fairchild2011 => of_2011 / (surround * luminance),
        }
    }

    /// Exponent of hdr-CIELAB.
    pub fn cielab_exponent(&self) -> f64 {
        self.exponent(1.5, 0.58)
    }

    /// Exponent of hdr-IPT.
    pub fn ipt_exponent(&self) -> f64 {
        self.exponent(1.38, 0.59)
    }
}

/// Largest lightness of hdr-CIELAB.
fn cielab_maximum(edition: HdrEdition) -> f64 {
    match edition {
        HdrEdition::Fairchild2010 => 100.0,
        HdrEdition::Fairchild2011 => 247.0,
    }
}

/// Largest response of hdr-IPT.
fn ipt_maximum(edition: HdrEdition) -> f64 {
    match edition {
        HdrEdition::Fairchild2010 => 100.0,
        HdrEdition::Fairchild2011 => 246.0,
    }
}

/// hdr-CIELAB L, a, b of XYZ for a white \[Fairchild2010\] \[Fairchild2011\]; white is near (100, 0, 0), black 0.02.
///
/// Negative components go point-symmetrically to lightness below 0.02.
pub fn hdr_cielab_from_xyz(xyz: DVec3, white_xyz: DVec3, conditions: HdrConditions) -> DVec3 {
    let (exponent, maximum) = (conditions.cielab_exponent(), cielab_maximum(conditions.edition));
    let lightness = |ratio| hdr_lightness(ratio, exponent, maximum, conditions.edition);
    let [x, y, z] = (xyz / white_xyz).to_array().map(lightness);
    DVec3::new(y, 5.0 * (x - y), 2.0 * (y - z))
}

/// Inverse of [`hdr_cielab_from_xyz`]; infinite or NaN for lightness that no luminance reaches.
pub fn xyz_from_hdr_cielab(lab: DVec3, white_xyz: DVec3, conditions: HdrConditions) -> DVec3 {
    let (exponent, maximum) = (conditions.cielab_exponent(), cielab_maximum(conditions.edition));
    let luminance = |lightness| hdr_luminance(lightness, exponent, maximum, conditions.edition);
    let lightness = [lab.x + lab.y / 5.0, lab.x, lab.x - lab.z / 2.0];
    DVec3::from(lightness.map(luminance)) * white_xyz
}

/// hdr-IPT I, P, T of XYZ under D65 \[Fairchild2010\] \[Fairchild2011\].
///
/// Negative cone responses go point-symmetrically below that of black, which is 0.02.
pub fn hdr_ipt_from_xyz(xyz: DVec3, conditions: HdrConditions) -> DVec3 {
    let (exponent, maximum) = (conditions.ipt_exponent(), ipt_maximum(conditions.edition));
    let response = |cone| hdr_lightness(cone, exponent, maximum, conditions.edition);
    let [cones_from_xyz, ipt_from_responses] = ipt_matrices();
    ipt_from_responses * DVec3::from((cones_from_xyz * xyz).to_array().map(response))
}

/// Inverse of [`hdr_ipt_from_xyz`]; infinite or NaN for coordinates that no light reaches.
pub fn xyz_from_hdr_ipt(ipt: DVec3, conditions: HdrConditions) -> DVec3 {
    let (exponent, maximum) = (conditions.ipt_exponent(), ipt_maximum(conditions.edition));
    let cone = |response| hdr_luminance(response, exponent, maximum, conditions.edition);
    let [cones_from_xyz, ipt_from_responses] = ipt_matrices();
    cones_from_xyz.inverse() * DVec3::from((ipt_from_responses.inverse() * ipt).to_array().map(cone))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::xyz_from_xy;
    use proptest::prelude::*;

    fn conditions() -> impl Strategy<Value = HdrConditions> {
        let edition = prop_oneof![Just(HdrEdition::Fairchild2010), Just(HdrEdition::Fairchild2011)];
        (0.0..0.5_f64, 10.0..4000.0_f64, edition).prop_map(|(surround, white_cd_m2, edition)| HdrConditions {
            surround,
            white_cd_m2,
            edition,
        })
    }

    #[test]
    fn white_grey_and_black() {
        let white = xyz_from_xy([0.3127, 0.3290]);
        let lab = hdr_cielab_from_xyz(white, white, HdrConditions::default());
        assert!((lab - DVec3::new(100.0, 0.0, 0.0)).abs().max_element() < 5.0, "{lab}");
        // A diffuse grey of 18.4 % is half of the scale in the paper of 2010, whatever the exponent.
        let conditions = HdrConditions { edition: HdrEdition::Fairchild2010, ..HdrConditions::default() };
        let grey = hdr_cielab_from_xyz(white * 0.184, white, conditions);
        assert!((grey - DVec3::new(50.02, 0.0, 0.0)).abs().max_element() < 1e-12, "{grey}");
        let black = hdr_cielab_from_xyz(DVec3::ZERO, white, conditions);
        assert_eq!(black, DVec3::new(0.02, 0.0, 0.0));
        assert_eq!(xyz_from_hdr_cielab(black, white, conditions), DVec3::ZERO);
    }

    proptest! {
        #[test]
        fn round_trips(x in -0.2..4.0_f64, y in -0.2..4.0_f64, z in -0.2..4.0_f64, conditions in conditions()) {
            let (xyz, white) = (DVec3::new(x, y, z), xyz_from_xy([0.3457, 0.3585]));
            let back = xyz_from_hdr_cielab(hdr_cielab_from_xyz(xyz, white, conditions), white, conditions);
            // The curve of 2010 is nearly flat far above white, the steeper the exponent.
            prop_assert!((back - xyz).abs().max_element() < 1e-8, "{back} {xyz}");
            let back = xyz_from_hdr_ipt(hdr_ipt_from_xyz(xyz, conditions), conditions);
            prop_assert!((back - xyz).abs().max_element() < 1e-7, "{back} {xyz}");
        }
    }
}
