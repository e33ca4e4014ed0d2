//! RGB spaces by primaries and white; the sRGB transfer function.

use super::xyz_from_xy;
use crate::{Error, ErrorKind, Result, math};
use glam::{DMat3, DVec3};
use std::sync::LazyLock;

/// Chromaticity of D65 as the RGB standards give it.
const WHITE_D65: [f64; 2] = [0.3127, 0.3290];
/// Chromaticity of D50 as ROMM RGB gives it.
const WHITE_D50: [f64; 2] = [0.3457, 0.3585];
/// Chromaticity of the ACES white, near D60.
const WHITE_ACES: [f64; 2] = [0.32168, 0.33767];

static SPACES: LazyLock<[RgbSpace; 7]> = LazyLock::new(|| {
    let new = RgbSpace::new;
    [
        new("srgb", [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]], WHITE_D65),
        new("display-p3", [[0.680, 0.320], [0.265, 0.690], [0.150, 0.060]], WHITE_D65),
        new("rec2020", [[0.708, 0.292], [0.170, 0.797], [0.131, 0.046]], WHITE_D65),
        new("adobe-rgb", [[0.64, 0.33], [0.21, 0.71], [0.15, 0.06]], WHITE_D65),
        new("acescg", [[0.713, 0.293], [0.165, 0.830], [0.128, 0.044]], WHITE_ACES),
        new("aces2065-1", [[0.7347, 0.2653], [0.0, 1.0], [0.0001, -0.0770]], WHITE_ACES),
        new("prophoto-rgb", [[0.7347, 0.2653], [0.1596, 0.8404], [0.0366, 0.0001]], WHITE_D50),
    ]
});

/// A linear RGB space. Its matrices follow from primaries and white in f64, not from rounded published ones.
#[derive(Debug, Clone, PartialEq)]
pub struct RgbSpace {
    /// Name in scene files.
    pub name: &'static str,
    /// Chromaticities x, y of red, green and blue.
    pub primaries: [[f64; 2]; 3],
    /// Chromaticity x, y of the white [1, 1, 1].
    pub white: [f64; 2],
    /// Linear RGB to XYZ; white has Y = 1.
    pub xyz_from_rgb: DMat3,
    /// XYZ to linear RGB.
    pub rgb_from_xyz: DMat3,
}

impl RgbSpace {
    /// A space from its primaries (which must not lie on one line) and white.
    fn new(name: &'static str, primaries: [[f64; 2]; 3], white: [f64; 2]) -> Self {
        let directions = primaries.map(|[x, y]| DVec3::new(x, y, 1.0 - x - y));
        let [r, g, b] = directions;
        // The amounts of the primaries that add up to white.
        let amounts = DMat3::from_cols(r, g, b).inverse() * xyz_from_xy(white);
        let xyz_from_rgb = DMat3::from_cols(r * amounts.x, g * amounts.y, b * amounts.z);
        Self { name, primaries, white, xyz_from_rgb, rgb_from_xyz: xyz_from_rgb.inverse() }
    }

    /// All spaces.
    pub fn all() -> &'static [RgbSpace] {
        SPACES.as_slice()
    }

    /// IEC 61966-2-1 sRGB, the space of Rec. 709 \[IEC61966\].
    pub fn srgb() -> &'static RgbSpace {
        &SPACES[0]
    }

    /// A space by its name: `srgb`, `display-p3`, `rec2020`, `adobe-rgb`, `acescg`, `aces2065-1`, `prophoto-rgb`.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] with the nearest name.
    pub fn by_name(name: &str) -> Result<&'static RgbSpace> {
        Self::all().iter().find(|space| space.name == name).ok_or_else(|| {
            let names = || Self::all().iter().map(|space| space.name);
            let known = names().collect::<Vec<_>>().join(", ");
            let message = format!("unknown RGB space {name:?}; expected one of {known}");
            Error::new(ErrorKind::UnknownName, message).nearest(name, names())
        })
    }

    /// XYZ of the white at Y = 1.
    pub fn white_xyz(&self) -> DVec3 {
        xyz_from_xy(self.white)
    }
}

/// Linear component to encoded sRGB component \[IEC61966\]; 0 and 1 map to themselves.
///
/// Below 0 the straight segment goes on, above 1 the power.
pub fn srgb_encode(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * math::pow(linear, 1.0 / 2.4) - 0.055 }
}

/// Encoded sRGB component to linear component, the inverse of [`srgb_encode`].
pub fn srgb_decode(encoded: f64) -> f64 {
    if encoded <= 0.040_45 { encoded / 12.92 } else { math::pow((encoded + 0.055) / 1.055, 2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Observer, xyz_of_emission};
    use crate::spectrum::Spectrum;
    use approx::assert_relative_eq;

    #[test]
    fn srgb_has_the_published_matrices() {
        // IEC 61966-2-1 prints four digits, of white D65 with the same rounding.
        let published = DMat3::from_cols_array(&[
            3.2406, -0.9689, 0.0557, //
            -1.5372, 1.8758, -0.2040, //
            -0.4986, 0.0415, 1.0570,
        ]);
        assert!(RgbSpace::srgb().rgb_from_xyz.abs_diff_eq(published, 5e-4));
        let published = DMat3::from_cols_array(&[
            0.4124, 0.2126, 0.0193, //
            0.3576, 0.7152, 0.1192, //
            0.1805, 0.0722, 0.9505,
        ]);
        assert!(RgbSpace::srgb().xyz_from_rgb.abs_diff_eq(published, 5e-5));
    }

    #[test]
    fn matrices_cancel_and_take_one_to_white() {
        for space in RgbSpace::all() {
            let identity = space.rgb_from_xyz * space.xyz_from_rgb;
            assert!(identity.abs_diff_eq(DMat3::IDENTITY, 1e-14), "{}", space.name);
            let white = space.xyz_from_rgb * DVec3::ONE;
            assert!((white - space.white_xyz()).abs().max_element() < 1e-15, "{}", space.name);
        }
    }

    #[test]
    fn unit_radiance_develops_to_the_documented_rgb() {
        let xyz = xyz_of_emission(&Spectrum::Constant(1.0), Observer::cie_1931_2deg());
        let rgb = RgbSpace::srgb().rgb_from_xyz * xyz;
        assert!((rgb - DVec3::new(1.205, 0.948, 0.909)).abs().max_element() < 5e-4, "{rgb}");
    }

    #[test]
    fn transfer_function_is_inverse_monotone_and_continuous() {
        assert_eq!((srgb_encode(0.0), srgb_decode(0.0)), (0.0, 0.0));
        assert_relative_eq!(srgb_encode(1.0), 1.0, max_relative = 1e-15);
        assert_relative_eq!(srgb_encode(0.5), 0.735_356_983_052_449_6, max_relative = 1e-14);
        let mut before = f64::NEG_INFINITY;
        for i in -100..1600 {
            let linear = f64::from(i) / 1000.0;
            let encoded = srgb_encode(linear);
            assert!(encoded > before);
            assert_relative_eq!(srgb_decode(encoded), linear, epsilon = 1e-14, max_relative = 1e-13);
            before = encoded;
        }
        // The standard's rounded constants leave a step of 3e-8 at the joint.
        assert!((srgb_encode(0.003_130_8) - srgb_encode(0.003_130_800_001)).abs() < 1e-7);
    }

    #[test]
    fn an_unknown_space_suggests_the_nearest() {
        assert_eq!(RgbSpace::by_name("rec2020").unwrap().white, WHITE_D65);
        let error = RgbSpace::by_name("sRGB").unwrap_err();
        assert_eq!((error.kind, error.nearest.as_deref()), (ErrorKind::UnknownName, Some("srgb")));
    }
}
