//! The relative mean square error.

use super::Pair;
use crate::Image;

/// Share of m² that keeps dark pixels of the reference from deciding alone.
const FLOOR: f64 = 0.01;
/// Share of the pixels that the trimmed error leaves out.
const TRIMMED: f64 = 0.001;

/// Computes the mean over pixels and channels of (I − R)² / (R² + 0.01 m²), with m the mean of R over all pixels and
/// channels \[Rousselle2011\].
///
/// It is in [0, ∞], and infinite where the reference is black everywhere and the picture is not.
pub fn relative_mse(pair: &Pair) -> f64 {
    let floor = FLOOR * pair.mean() * pair.mean();
    pair.pixels().map(|(test, reference)| pixel_error(test, reference, floor)).sum::<f64>() / pair.count() as f64
}

/// Computes [`relative_mse`] without the worst 0.1 % of the pixels (rounded up, but never all of them), so that a few fireflies
/// do not show in it. m is still the mean over all pixels.
pub fn trimmed_relative_mse(pair: &Pair) -> f64 {
    let floor = FLOOR * pair.mean() * pair.mean();
    let mut errors: Vec<f64> = pair.pixels().map(|(test, reference)| pixel_error(test, reference, floor)).collect();
    let left_out = ((TRIMMED * errors.len() as f64).ceil() as usize).min(errors.len() - 1);
    let kept = errors.len() - left_out;
    if left_out > 0 {
        errors.select_nth_unstable_by(kept, f64::total_cmp);
    }
    errors[..kept].iter().sum::<f64>() / kept as f64
}

/// Computes the relative error of each pixel, the square root of its part in [`relative_mse`], as a picture of one channel. It
/// is 0 where a pixel does not count.
pub fn relative_error_map(pair: &Pair) -> Image {
    let floor = FLOOR * pair.mean() * pair.mean();
    pair.map("relativeError", |test, reference| pixel_error(test, reference, floor).sqrt())
}

fn pixel_error(test: &[f64; 3], reference: &[f64; 3], floor: f64) -> f64 {
    let error = |c: usize| {
        let difference = test[c] - reference[c];
        // A value that is exactly right has no error, also where R and m are 0.
        if difference == 0.0 { 0.0 } else { difference * difference / (reference[c] * reference[c] + floor) }
    };
    (error(0) + error(1) + error(2)) / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn image(width: u32, pixels: &[[f64; 3]]) -> Image {
        Image::xyz(width, pixels.to_vec()).unwrap()
    }

    #[test]
    fn by_hand() {
        let (test, reference) = ([[2.0, 1.0, 0.0], [1.0; 3]], [[1.0, 1.0, 0.0], [1.0; 3]]);
        let (test, reference) = (image(2, &test), image(2, &reference));
        let pair = Pair::new(&test, &reference, None).unwrap();
        let m = 5.0 / 6.0;
        let expected = 1.0 / (1.0 + 0.01 * m * m) / 6.0;
        assert_relative_eq!(relative_mse(&pair), expected, max_relative = 1e-15);
        let map: Vec<f64> = relative_error_map(&pair).plane(0).collect();
        assert_relative_eq!(map[0], (2.0 * expected).sqrt(), max_relative = 1e-15);
        assert_eq!(map[1], 0.0);
        // The one wrong pixel of two is the worst.
        assert_eq!(trimmed_relative_mse(&pair), 0.0);
    }

    #[test]
    fn trims_a_thousandth() {
        let reference = image(100, &[[1.0; 3]; 3000]);
        let mut test = vec![[1.1; 3]; 3000];
        for i in [7, 1200, 2999] {
            test[i] = [1e6; 3];
        }
        let few = image(100, &test);
        let pair = Pair::new(&few, &reference, None).unwrap();
        assert!(relative_mse(&pair) > 1e8);
        assert_relative_eq!(trimmed_relative_mse(&pair), 0.01 / 1.01, max_relative = 1e-12);
        test[8] = [1e6; 3];
        assert!(trimmed_relative_mse(&Pair::new(&image(100, &test), &reference, None).unwrap()) > 1e8);
    }

    #[test]
    fn nothing_to_be_relative_to() {
        let (black, grey) = (image(2, &[[0.0; 3]; 4]), image(2, &[[0.5; 3]; 4]));
        let of = |test, reference| relative_mse(&Pair::new(test, reference, None).unwrap());
        assert_eq!((of(&black, &black), of(&grey, &grey)), (0.0, 0.0));
        assert_eq!(of(&grey, &black), f64::INFINITY);
        assert_relative_eq!(of(&black, &grey), 1.0 / 1.01, max_relative = 1e-15);
        let (black, grey) = (image(1, &[[0.0; 3]]), image(1, &[[0.5; 3]]));
        assert_eq!(trimmed_relative_mse(&Pair::new(&grey, &black, None).unwrap()), f64::INFINITY);
    }
}
