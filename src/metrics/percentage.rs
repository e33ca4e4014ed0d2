//! Mean absolute percentage errors, as fractions: less swayed by outliers than squares are.

use super::Pair;

/// Share of m that keeps dark pixels of the reference from deciding alone.
const FLOOR: f64 = 0.01;

/// Computes the mean over pixels and channels of |I − R| / (|R| + 0.01 m), with m the mean of R; a fraction, not per cent.
///
/// It is in [0, ∞], and infinite where the reference is black everywhere and the picture is not.
pub fn mape(pair: &Pair) -> f64 {
    let floor = (FLOOR * pair.mean()).abs();
    mean(pair, |test, reference| quotient((test - reference).abs(), reference.abs() + floor))
}

/// Computes the mean over pixels and channels of 2 |I − R| / (|I| + |R|), where 0 / 0 is 0. It is in [0, 2], and the same when
/// picture and reference are exchanged.
pub fn smape(pair: &Pair) -> f64 {
    mean(pair, |test, reference| quotient(2.0 * (test - reference).abs(), test.abs() + reference.abs()))
}

fn mean(pair: &Pair, error: impl Fn(f64, f64) -> f64) -> f64 {
    let pixel = |(test, reference): (&[f64; 3], &[f64; 3])| (0..3).map(|c| error(test[c], reference[c])).sum::<f64>();
    pair.pixels().map(pixel).sum::<f64>() / (3 * pair.count()) as f64
}

fn quotient(error: f64, size: f64) -> f64 {
    if error == 0.0 { 0.0 } else { error / size }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Image;
    use approx::assert_relative_eq;

    fn image(pixel: [f64; 3]) -> Image {
        Image::xyz(1, vec![pixel]).unwrap()
    }

    #[test]
    fn by_hand() {
        let (test, reference) = (image([2.0, 3.0, 0.0]), image([1.0, 4.0, 1.0]));
        let pair = Pair::new(&test, &reference, None).unwrap();
        assert_relative_eq!(mape(&pair), (1.0 / 1.02 + 1.0 / 4.02 + 1.0 / 1.02) / 3.0, max_relative = 1e-15);
        assert_relative_eq!(smape(&pair), (2.0 / 3.0 + 2.0 / 7.0 + 2.0) / 3.0, max_relative = 1e-15);
        let exchanged = Pair::new(&reference, &test, None).unwrap();
        assert_eq!(smape(&exchanged), smape(&pair));
    }

    #[test]
    fn black() {
        let (black, grey) = (image([0.0; 3]), image([0.5; 3]));
        let pair = |test, reference| Pair::new(test, reference, None).unwrap();
        assert_eq!((mape(&pair(&black, &black)), smape(&pair(&black, &black))), (0.0, 0.0));
        assert_eq!((mape(&pair(&grey, &black)), smape(&pair(&grey, &black))), (f64::INFINITY, 2.0));
    }
}
