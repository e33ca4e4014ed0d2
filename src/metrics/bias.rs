//! Whether a picture is too bright or too dark on the whole.

use super::{Pair, stats};

/// Edge of the blocks of pixels whose errors are taken as independent.
const BLOCK: usize = 8;
/// Least number of blocks; where there are fewer, they are made smaller.
const ENOUGH: usize = 30;

/// The mean error of one channel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bias {
    /// Mean of I − R.
    pub mean: f64,
    /// Half the width of its 95 % confidence interval; NaN for fewer than two blocks.
    pub half_width: f64,
    /// Mean of R, by which `mean` can be divided.
    pub reference: f64,
}

impl Bias {
    /// Returns whether 0 lies outside the interval.
    pub fn is_significant(&self) -> bool {
        self.mean.abs() > self.half_width
    }
}

/// Computes the mean error of each channel with the 95 % interval of Student's t over blocks of 8 × 8 pixels (smaller ones
/// in small pictures). Neighbouring pixels share samples through the reconstruction filter, so that single pixels would make
/// the interval too narrow; blocks are nearly independent.
pub fn bias(pair: &Pair) -> [Bias; 3] {
    let [width, height] = pair.size().map(|n| n as usize);
    let mut edge = BLOCK;
    while edge > 1 && width.div_ceil(edge) * height.div_ceil(edge) < ENOUGH {
        edge /= 2;
    }
    let across = width.div_ceil(edge);
    let mut sums = vec![[0.0; 3]; across * height.div_ceil(edge)];
    let mut counts = vec![0usize; sums.len()];
    for (i, (counted, test, reference)) in pair.all().enumerate() {
        if counted {
            let block = i / width / edge * across + i % width / edge;
            (0..3).for_each(|c| sums[block][c] += test[c] - reference[c]);
            counts[block] += 1;
        }
    }
    let blocks: Vec<(usize, [f64; 3])> = counts.into_iter().zip(sums).filter(|(n, _)| *n > 0).collect();
    [0, 1, 2].map(|c| {
        let sums: Vec<(f64, f64)> = blocks.iter().map(|(n, sum)| (*n as f64, sum[c])).collect();
        let reference = pair.pixels().map(|(_, reference)| reference[c]).sum::<f64>() / pair.count() as f64;
        let (mean, half_width) = ratio_interval(&sums);
        Bias { mean, half_width, reference }
    })
}

/// Computes Σ sums / Σ counts and the half width of its 95 % interval. Blocks weigh by their numbers of pixels.
fn ratio_interval(blocks: &[(f64, f64)]) -> (f64, f64) {
    let n = blocks.len() as f64;
    let count: f64 = blocks.iter().map(|b| b.0).sum();
    let mean = blocks.iter().map(|b| b.1).sum::<f64>() / count;
    if blocks.len() < 2 {
        return (mean, f64::NAN);
    }
    let squares: f64 = blocks.iter().map(|b| (b.1 - mean * b.0) * (b.1 - mean * b.0)).sum();
    let standard_error = (squares * n / (n - 1.0)).sqrt() / count;
    (mean, stats::student_t_quantile(0.975, n - 1.0) * standard_error)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Image;

    fn noise(i: u64) -> f64 {
        let mut x = i.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        x = (x ^ x >> 32).wrapping_mul(0xd6e8_feb8_6659_fd93);
        ((x ^ x >> 32) >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    }

    /// Uniform noise in [−1/2, 1/2] around an offset, correlated by averaging 2 × 2 neighbours.
    fn picture(seed: u64, offset: f64) -> Image {
        let at = |x: u64, y: u64, c: u64| noise(((seed * 65 + y) * 65 + x) * 3 + c);
        let mut pixels = Vec::new();
        for y in 0..64 {
            for x in 0..64 {
                let value = |c| (at(x, y, c) + at(x + 1, y, c) + at(x, y + 1, c) + at(x + 1, y + 1, c)) / 4.0;
                pixels.push([0, 1, 2].map(|c| 1.0 + offset + value(c)));
            }
        }
        Image::xyz(64, pixels).unwrap()
    }

    fn grey(side: u32, value: f64) -> Image {
        Image::xyz(side, vec![[value; 3]; (side * side) as usize]).unwrap()
    }

    #[test]
    fn intervals_hold_the_truth_as_often_as_they_say() {
        let reference = grey(64, 1.0);
        let (mut missed, mut widths) = (0, 0.0);
        for seed in 0..200 {
            let test = picture(seed, 0.0);
            for b in bias(&Pair::new(&test, &reference, None).unwrap()) {
                missed += u32::from(b.is_significant());
                widths += b.half_width / 600.0;
            }
        }
        // 600 intervals of 95 %: 30 misses expected; corner blocks still share a border, which costs a little.
        assert!((15..=60).contains(&missed), "{missed} of 600 missed");
        // Standard deviation of the mean: 1/√12/64.
        let expected = 2.0 * (1.0 / 12f64).sqrt() / 64.0;
        assert!((widths / expected - 1.0).abs() < 0.15, "{widths} against {expected}");
    }

    #[test]
    fn a_bias_is_seen() {
        let reference = grey(64, 1.0);
        let test = picture(3, 0.02);
        for b in bias(&Pair::new(&test, &reference, None).unwrap()) {
            assert!(b.is_significant() && (b.mean - 0.02).abs() < 2.0 * b.half_width && b.reference == 1.0);
        }
        let single = bias(&Pair::new(&grey(1, 2.0), &grey(1, 1.0), None).unwrap());
        assert!(single[0].mean == 1.0 && single[0].half_width.is_nan() && !single[0].is_significant());
    }
}
