//! Colours of the drawing itself: what a screen can show of a chromaticity. Decoration, not measurement.

use crate::color::{RgbSpace, srgb_encode};
use glam::DVec3;

/// `#rrggbb`.
pub fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// The brightest sRGB colour of a chromaticity; what lies outside the gamut is moved towards white until it is inside.
pub fn brightest(xyz: DVec3) -> [u8; 3] {
    let rgb = RgbSpace::srgb().rgb_from_xyz * xyz;
    let inside = rgb - DVec3::splat(rgb.min_element().min(0.0));
    let largest = inside.max_element();
    if largest.is_nan() || largest <= 0.0 {
        return [0; 3];
    }
    (inside / largest).to_array().map(|linear| (255.0 * srgb_encode(linear)).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Observer, xyz_from_xy};

    #[test]
    fn white_is_white_and_the_ends_have_their_hues() {
        assert_eq!(brightest(xyz_from_xy([0.3127, 0.3290])), [255; 3]);
        let line = |lambda_nm| brightest(Observer::cie_1931_2deg().eval(lambda_nm));
        let [r, g, b] = line(650.0);
        assert!(r == 255 && g < 10 && b < 50, "{:?}", [r, g, b]);
        let [r, g, b] = line(450.0);
        assert!(b == 255 && g == 0 && r < 150, "{:?}", [r, g, b]);
        assert_eq!(line(530.0)[1], 255);
        assert_eq!(brightest(DVec3::ZERO), [0; 3]);
        assert_eq!(hex([255, 136, 0]), "#ff8800");
    }
}
