//! Sprague's quintic interpolation, as the CIE recommends it for samples at equal distances.

use super::{Grid, too_few};
use crate::spectrum::PiecewiseLinear;
use crate::{Error, ErrorKind, Result};

/// The two samples that are assumed before the first six, times 209 \[CIE167\]; mirrored, the two after the last six.
const OUTER: [[f64; 6]; 2] =
    [[884.0, -1960.0, 3033.0, -2648.0, 1080.0, -180.0], [508.0, -540.0, 488.0, -367.0, 144.0, -24.0]];
const OUTER_DIVISOR: f64 = 209.0;

/// Coefficients of t, …, t⁵ from the six samples around an interval, times 24.
const INNER: [[f64; 6]; 5] = [
    [2.0, -16.0, 0.0, 16.0, -2.0, 0.0],
    [-1.0, 16.0, -30.0, 16.0, -1.0, 0.0],
    [-9.0, 39.0, -70.0, 66.0, -33.0, 7.0],
    [13.0, -64.0, 126.0, -124.0, 61.0, -12.0],
    [-5.0, 25.0, -50.0, 50.0, -25.0, 5.0],
];
const INNER_DIVISOR: f64 = 24.0;

/// Samples with two more at either end.
pub(super) struct Sprague<'a> {
    samples: &'a PiecewiseLinear,
    extended: Vec<f64>,
}

impl<'a> Sprague<'a> {
    pub(super) fn new(samples: &'a PiecewiseLinear) -> Result<Self> {
        let values = samples.values();
        if values.len() < 6 {
            return Err(too_few(samples, "Sprague's interpolation", 6));
        }
        if Grid::of_samples(samples).is_none() {
            let message = "wavelengths at unequal distances; expected equal distances for Sprague's interpolation \
                           (a cubic spline needs none)";
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        let first: Vec<f64> = values[..6].to_vec();
        let last: Vec<f64> = values[values.len() - 6..].iter().rev().copied().collect();
        let outer = |row: usize, six: &[f64]| dot(&OUTER[row], six) / OUTER_DIVISOR;
        let mut extended = vec![outer(0, &first), outer(1, &first)];
        extended.extend(values);
        extended.extend([outer(1, &last), outer(0, &last)]);
        Ok(Self { samples, extended })
    }

    /// The values at wavelengths inside the range of the samples.
    pub(super) fn eval_all(&self, lambdas_nm: &[f64]) -> Vec<f64> {
        lambdas_nm.iter().map(|&lambda| self.eval(lambda)).collect()
    }

    fn eval(&self, lambda_nm: f64) -> f64 {
        let knots = self.samples.lambdas_nm();
        let i = knots.partition_point(|&knot| knot <= lambda_nm) - 1;
        if knots[i] == lambda_nm {
            return self.samples.values()[i];
        }
        let t = (lambda_nm - knots[i]) / (knots[i + 1] - knots[i]);
        // Samples i − 2 to i + 3, which start at i in the extended list.
        let six = &self.extended[i..i + 6];
        let polynomial = INNER.iter().rev().fold(0.0, |sum, row| t * (sum + dot(row, six)));
        six[2] + polynomial / INNER_DIVISOR
    }
}

fn dot(row: &[f64; 6], six: &[f64]) -> f64 {
    row.iter().zip(six).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_derivatives_are_continuous_at_a_sample() {
        let values = vec![0.1, 0.9, 0.3, 0.35, 0.2, 0.8, 0.7, 0.0];
        let samples = PiecewiseLinear::new((0..8).map(|i| 400.0 + 10.0 * f64::from(i)).collect(), values).unwrap();
        let curve = Sprague::new(&samples).unwrap();
        let h = 0.01;
        for knot in [410.0, 430.0, 460.0] {
            let [a, b, c, d, e] = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| curve.eval(knot + k * h));
            let (left, right) = ((3.0 * c - 4.0 * b + a) / (2.0 * h), (4.0 * d - 3.0 * c - e) / (2.0 * h));
            assert!((left - right).abs() < 1e-6, "{knot}: slopes {left} {right}");
            let (left, right) = ((c - 2.0 * b + a) / (h * h), (e - 2.0 * d + c) / (h * h));
            assert!((left - right).abs() < 1e-4, "{knot}: curvatures {left} {right}");
        }
    }

    #[test]
    fn known_value() {
        // A unit impulse, half way to the next sample: (24 + 0/2 − 30/4 − 70/8 + 126/16 − 50/32) / 24.
        let values = vec![0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0];
        let samples = PiecewiseLinear::new((0..8).map(|i| 400.0 + 10.0 * f64::from(i)).collect(), values).unwrap();
        let found = Sprague::new(&samples).unwrap().eval(435.0);
        assert!((found - 0.585_937_5).abs() < 1e-15, "{found}");
    }
}
