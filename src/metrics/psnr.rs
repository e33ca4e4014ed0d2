//! Peak signal-to-noise ratio of pictures on a display.

use super::{Displayed, Pair};
use crate::math;

/// Computes 10 log₁₀(1 / MSE) in dB, over encoded sRGB in [0, 1]: the pictures as they are shown, with peak 1. It is infinite
/// for pictures that look exactly alike. `pair` says which pixels count.
pub fn psnr(pair: &Pair, test: &Displayed, reference: &Displayed) -> f64 {
    let squares = test.encoded_srgb().zip(reference.encoded_srgb()).map(|(a, b)| (a - b).length_squared());
    let mse = pair.counted_values(squares).sum::<f64>() / (3 * pair.count()) as f64;
    if mse == 0.0 { f64::INFINITY } else { -10.0 * math::ln(mse) / std::f64::consts::LN_10 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Image;
    use crate::color::RgbSpace;

    #[test]
    fn by_hand() {
        let white = RgbSpace::srgb().white_xyz().to_array();
        let image = |pixels: [[f64; 3]; 3]| Image::xyz(3, pixels.into()).unwrap();
        let (test, reference) = (image([[0.0; 3], white, white]), image([white, white, [f64::NAN; 3]]));
        let pair = Pair::new(&test, &reference, None).unwrap();
        let shown = |picture| Displayed::new(picture, 1.0);
        // One of two pixels that count is wholly wrong.
        let expected = 10.0 * 2f64.log10();
        assert!((psnr(&pair, &shown(&test), &shown(&reference)) - expected).abs() < 1e-9);
        let same = Pair::new(&test, &test, None).unwrap();
        assert_eq!(psnr(&same, &shown(&test), &shown(&test)), f64::INFINITY);
    }
}
