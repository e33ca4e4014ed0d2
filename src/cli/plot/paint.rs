//! Colours of the drawing itself: what a screen can show of a chromaticity. Decoration, not measurement.

use crate::color::{RgbSpace, srgb_encode};
use glam::DVec3;

/// `#rrggbb`.
pub fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Of the distance that a colour is outside the gamut, how much is made up by adding white; the rest is cut off. All of it
/// would wash the spectrum out, none would leave bands of one colour.
const WHITENED: f64 = 0.35;

/// Lines of a few curves, told apart on light and dark pages.
pub const LINES: [[u8; 3]; 6] =
    [[14, 135, 204], [226, 115, 0], [34, 160, 84], [205, 58, 148], [134, 92, 214], [168, 138, 16]];

/// The brightest sRGB colour near a chromaticity, times a brightness in [0, 1].
pub fn brightest(xyz: DVec3, brightness: f64) -> [u8; 3] {
    let rgb = RgbSpace::srgb().rgb_from_xyz * xyz;
    let inside = (rgb - WHITENED * rgb.min_element().min(0.0)).max(DVec3::ZERO);
    let largest = inside.max_element();
    if largest.is_nan() || largest <= 0.0 {
        return [0; 3];
    }
    (inside * (brightness / largest)).to_array().map(|linear| (255.0 * srgb_encode(linear)).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Observer, xyz_from_xy};

    #[test]
    fn white_is_white_and_the_ends_have_their_hues() {
        assert_eq!(brightest(xyz_from_xy([0.3127, 0.3290]), 1.0), [255; 3]);
        let line = |lambda_nm| brightest(Observer::cie_1931_2deg().eval(lambda_nm), 1.0);
        let [r, g, b] = line(650.0);
        assert!(r == 255 && g < 60 && b < 60, "{:?}", [r, g, b]);
        let [r, g, b] = line(450.0);
        assert!(b == 255 && g < 60 && r < 150, "{:?}", [r, g, b]);
        assert_eq!(line(530.0)[1], 255);
        assert_eq!(brightest(DVec3::ZERO, 1.0), [0; 3]);
        assert_eq!(hex([255, 136, 0]), "#ff8800");
    }
}
