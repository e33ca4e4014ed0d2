//! Colour differences that an observer would see.

use super::{Displayed, Pair, stats};
use crate::Image;
use crate::color::RgbSpace;
use crate::color::difference::cie2000;
use crate::color::space::lab_from_xyz;

/// CIE ΔE 2000 over the pixels of a picture; about 1 is just noticeable between large patches side by side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColorDifference {
    /// Mean over the pixels.
    pub mean: f64,
    /// Difference that 95 % of the pixels stay below.
    pub percentile_95: f64,
    /// Largest difference of any pixel.
    pub max: f64,
}

/// Computes ΔE 2000 \[CIE15\] of every pixel, in CIE Lab with sRGB's white D65, as a picture of one channel. Both pictures have
/// the same size.
pub fn color_difference_map(test: &Displayed, reference: &Displayed) -> Image {
    let white = RgbSpace::srgb().white_xyz();
    let difference = |(a, b)| cie2000(lab_from_xyz(a, white), lab_from_xyz(b, white));
    Image::new(test.size(), &["deltaE2000"], test.xyz().zip(reference.xyz()).map(difference).collect())
}

/// Sums up a [`color_difference_map`] over the pixels of `pair` that count.
pub fn color_difference(pair: &Pair, map: &Image) -> ColorDifference {
    let mut values: Vec<f64> = pair.counted_values(map.plane(0)).collect();
    values.sort_by(f64::total_cmp);
    ColorDifference {
        mean: stats::mean(&values),
        percentile_95: stats::quantile_of_sorted(&values, 0.95),
        max: values[values.len() - 1],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn greys_differ_by_lightness() {
        let white = RgbSpace::srgb().white_xyz();
        let grey = |y: f64| (white * y).to_array();
        let image = |levels: [f64; 3]| Image::xyz(3, levels.map(grey).into()).unwrap();
        let (test, reference) = (image([0.18, 0.5, 7.0]), image([0.18, 0.6, 1.0]));
        let differences = color_difference_map(&Displayed::new(&test, 1.0), &Displayed::new(&reference, 1.0));
        let map: Vec<f64> = differences.plane(0).collect();
        let [a, b] = [0.5f64, 0.6].map(|y| 116.0 * y.cbrt() - 16.0);
        let middle = 0.5 * (a + b) - 50.0;
        let weight = 1.0 + 0.015 * middle * middle / (20.0 + middle * middle).sqrt();
        assert!((map[1] - (b - a) / weight).abs() < 1e-9, "{map:?}");
        // Both are white on a display.
        assert!(map[0] < 1e-9 && map[2] < 1e-9, "{map:?}");
        let pair = Pair::new(&test, &reference, None).unwrap();
        let all = color_difference(&pair, &differences);
        assert_eq!(all.max, map[1]);
        assert!((all.mean - map[1] / 3.0).abs() < 1e-9 && (all.percentile_95 - 0.9 * map[1]).abs() < 1e-9);
    }
}
