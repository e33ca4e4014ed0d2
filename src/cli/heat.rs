//! False colours for maps of errors.

use crate::Image;
use crate::develop::Picture;

/// Encoded sRGB at equal steps from 0 to 1; the lightness rises throughout, so that a grey print says the same.
const STOPS: [[f64; 3]; 6] =
    [[0.0, 0.0, 0.0], [0.16, 0.09, 0.42], [0.55, 0.13, 0.50], [0.88, 0.31, 0.31], [0.98, 0.65, 0.20], [1.0, 1.0, 0.88]];

/// Shows one channel of a picture in false colours from 0 to the value that is `white`.
pub fn picture(image: &Image, channel: usize, white: f64) -> Picture {
    let rgb8 = image.plane(channel).map(|value| color(value / white)).collect();
    Picture { width: image.size()[0], rgb8, exposure_ev: 0.0, out_of_gamut: 0.0 }
}

/// The colour of a value in [0, 1]; what is beyond gets the end's.
fn color(value: f64) -> [u8; 3] {
    let at = value.clamp(0.0, 1.0) * (STOPS.len() - 1) as f64;
    let below = (at as usize).min(STOPS.len() - 2);
    let t = at - below as f64;
    [0, 1, 2].map(|c| ((STOPS[below][c] + (STOPS[below + 1][c] - STOPS[below][c]) * t) * 255.0 + 0.5) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::srgb_decode;

    #[test]
    fn brighter_is_worse() {
        let luminance = |i: u32| {
            let rgb = color(f64::from(i) / 100.0).map(|v| srgb_decode(f64::from(v) / 255.0));
            0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]
        };
        assert!((0..100).all(|i| luminance(i) < luminance(i + 1)));
        assert_eq!((color(-1.0), color(7.0), color(f64::NAN)), ([0; 3], color(1.0), [0; 3]));
    }
}
