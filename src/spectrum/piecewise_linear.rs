//! Tables of a function of wavelength, read as straight lines between their knots.

use crate::{Error, ErrorKind, Result};

/// Largest magnitude of a tabulated value: far beyond any physical quantity, and products of three still fit in f64.
pub const MAX_TABULATED_VALUE: f64 = 1e100;

/// A continuous function of wavelength that is linear between knots and constant beyond the first and the last.
///
/// Knots ascend strictly; there is at least one. Values have the unit of whatever is tabulated.
///
/// ```
/// use abbe::spectrum::PiecewiseLinear;
/// let ramp = PiecewiseLinear::new(vec![400.0, 500.0], vec![0.0, 1.0])?;
/// assert_eq!(ramp.eval(425.0), 0.25);
/// assert_eq!(ramp.eval(900.0), 1.0);
/// # Ok::<(), abbe::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct PiecewiseLinear {
    lambda_nm: Vec<f64>,
    values: Vec<f64>,
}

impl PiecewiseLinear {
    /// A table from its wavelengths (nm, positive, strictly ascending) and as many values (finite).
    ///
    /// # Errors
    /// Unequal lengths, no knots, NaN or infinity, wavelengths that are not positive or do not ascend, values beyond
    /// [`MAX_TABULATED_VALUE`]. The message names the index, counted from 0.
    pub fn new(lambda_nm: Vec<f64>, values: Vec<f64>) -> Result<Self> {
        if lambda_nm.len() != values.len() {
            let message = format!(
                "{} wavelengths but {} values; expected as many values as wavelengths",
                lambda_nm.len(),
                values.len()
            );
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        if lambda_nm.is_empty() {
            return Err(Error::new(ErrorKind::Missing, "a table without samples; expected at least one wavelength"));
        }
        for (index, (&lambda, &value)) in lambda_nm.iter().zip(&values).enumerate() {
            let before = index.checked_sub(1).map(|i| lambda_nm[i]);
            check_knot(before, lambda, value)
                .map_err(|e| Error { message: format!("sample {index}: {}", e.message), ..e })?;
        }
        Ok(Self { lambda_nm, values })
    }

    /// A table whose knots are known to be valid.
    pub(crate) fn from_valid_knots(lambda_nm: Vec<f64>, values: Vec<f64>) -> Self {
        debug_assert!(!lambda_nm.is_empty() && lambda_nm.len() == values.len());
        debug_assert!(lambda_nm.windows(2).all(|pair| pair[0] < pair[1]));
        Self { lambda_nm, values }
    }

    /// The value at a wavelength in nm.
    pub fn eval(&self, lambda_nm: f64) -> f64 {
        let above = self.lambda_nm.partition_point(|&knot| knot <= lambda_nm);
        self.eval_before(above, lambda_nm)
    }

    /// The values at ascending wavelengths in nm, in one pass.
    pub fn eval_ascending(&self, lambdas_nm: &[f64]) -> Vec<f64> {
        let mut above = 0;
        let eval_next = |&lambda: &f64| {
            while above < self.lambda_nm.len() && self.lambda_nm[above] <= lambda {
                above += 1;
            }
            self.eval_before(above, lambda)
        };
        lambdas_nm.iter().map(eval_next).collect()
    }

    /// The value at a wavelength whose first knot above has the index `above`.
    fn eval_before(&self, above: usize, lambda_nm: f64) -> f64 {
        if above == 0 {
            return self.values[0];
        }
        let Some(&right) = self.values.get(above) else {
            return self.values[above - 1];
        };
        let (knot, left) = (self.lambda_nm[above - 1], self.values[above - 1]);
        let t = (lambda_nm - knot) / (self.lambda_nm[above] - knot);
        // Rounding may step one ulp outside the segment: a table within [0, 1] has to stay there.
        (left + (right - left) * t).clamp(left.min(right), left.max(right))
    }

    /// The knots' wavelengths, nm.
    pub fn lambdas_nm(&self) -> &[f64] {
        &self.lambda_nm
    }

    /// The values at the knots.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Pairs of wavelength (nm) and value.
    pub fn knots(&self) -> impl Iterator<Item = (f64, f64)> {
        self.lambda_nm.iter().copied().zip(self.values.iter().copied())
    }

    /// The function times a number.
    pub fn scaled(mut self, factor: f64) -> Self {
        for value in &mut self.values {
            *value *= factor;
        }
        self
    }

    /// Smallest value.
    pub fn min(&self) -> f64 {
        self.values.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Largest value.
    pub fn max(&self) -> f64 {
        self.values.iter().copied().fold(f64::NEG_INFINITY, f64::max)
    }

    /// The same function on a range: knots at both ends and every knot between. `from_nm < to_nm`.
    pub fn restricted(&self, from_nm: f64, to_nm: f64) -> Self {
        let mut lambda_nm = vec![from_nm];
        lambda_nm.extend(self.lambda_nm.iter().copied().filter(|&knot| from_nm < knot && knot < to_nm));
        lambda_nm.push(to_nm);
        let values = self.eval_ascending(&lambda_nm);
        Self::from_valid_knots(lambda_nm, values)
    }

    /// Integral over a range in nm, exactly (but for rounding). `from_nm < to_nm`.
    pub fn integral(&self, from_nm: f64, to_nm: f64) -> f64 {
        let piece = self.restricted(from_nm, to_nm);
        let trapezoid = |(l, v): (&[f64], &[f64])| 0.5 * (l[1] - l[0]) * (v[0] + v[1]);
        piece.lambda_nm.windows(2).zip(piece.values.windows(2)).map(trapezoid).sum()
    }
}

/// Checks one knot against the wavelength before it; errors carry no place.
pub(crate) fn check_knot(before_nm: Option<f64>, lambda_nm: f64, value: f64) -> Result<()> {
    let error = |kind, message: String| Err(Error::new(kind, message));
    if !lambda_nm.is_finite() || !value.is_finite() {
        return error(ErrorKind::NotFinite, format!("{value} at {lambda_nm} nm; expected finite numbers"));
    }
    if lambda_nm <= 0.0 {
        return error(ErrorKind::OutOfRange, format!("wavelength {lambda_nm} nm; expected a positive one"));
    }
    if value.abs() > MAX_TABULATED_VALUE {
        return error(ErrorKind::OutOfRange, format!("value {value:e}; expected at most {MAX_TABULATED_VALUE:e}"));
    }
    match before_nm {
        Some(before) if lambda_nm == before => {
            error(ErrorKind::Duplicate, format!("wavelength {lambda_nm} nm twice; expected each once"))
        }
        Some(before) if lambda_nm < before => error(
            ErrorKind::OutOfRange,
            format!("wavelength {lambda_nm} nm after {before} nm; expected ascending wavelengths"),
        ),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn tent() -> PiecewiseLinear {
        PiecewiseLinear::new(vec![400.0, 500.0, 700.0], vec![0.0, 2.0, 1.0]).unwrap()
    }

    #[test]
    fn evaluates_knots_segments_and_constant_ends() {
        let f = tent();
        for (lambda, value) in [(400.0, 0.0), (450.0, 1.0), (500.0, 2.0), (600.0, 1.5), (100.0, 0.0), (701.0, 1.0)] {
            assert_eq!(f.eval(lambda), value, "{lambda}");
        }
        assert_eq!((f.min(), f.max()), (0.0, 2.0));
        assert_eq!(f.scaled(3.0).eval(450.0), 3.0);
    }

    #[test]
    fn one_knot_is_a_constant() {
        let f = PiecewiseLinear::new(vec![550.0], vec![0.25]).unwrap();
        assert_eq!([f.eval(1.0), f.eval(550.0), f.eval(9000.0)], [0.25; 3]);
        assert_eq!(f.integral(400.0, 500.0), 25.0);
    }

    #[test]
    fn integrates_exactly_inside_across_and_outside() {
        let f = tent();
        assert_eq!(f.integral(400.0, 700.0), 100.0 + 300.0);
        assert_eq!(f.integral(450.0, 500.0), 75.0);
        assert_eq!(f.integral(300.0, 400.0), 0.0);
        assert_eq!(f.integral(650.0, 800.0), 50.0 * 1.125 + 100.0);
    }

    #[test]
    fn says_what_is_wrong_with_a_table() {
        let cases = [
            (vec![], vec![], ErrorKind::Missing),
            (vec![400.0], vec![], ErrorKind::OutOfRange),
            (vec![400.0, 400.0], vec![1.0, 2.0], ErrorKind::Duplicate),
            (vec![500.0, 400.0], vec![1.0, 2.0], ErrorKind::OutOfRange),
            (vec![-1.0], vec![1.0], ErrorKind::OutOfRange),
            (vec![f64::NAN], vec![1.0], ErrorKind::NotFinite),
            (vec![400.0], vec![f64::INFINITY], ErrorKind::NotFinite),
            (vec![400.0], vec![1e200], ErrorKind::OutOfRange),
        ];
        for (lambda, values, kind) in cases {
            let error = PiecewiseLinear::new(lambda.clone(), values).unwrap_err();
            assert_eq!(error.kind, kind, "{lambda:?}: {error}");
        }
        let error = PiecewiseLinear::new(vec![400.0, 500.0, 450.0], vec![0.0; 3]).unwrap_err();
        assert_eq!(error.to_string(), "sample 2: wavelength 450 nm after 500 nm; expected ascending wavelengths");
    }

    proptest! {
        #[test]
        fn one_pass_equals_single_evaluations_and_stays_within_bounds(
            steps in prop::collection::vec((1e-6..100.0_f64, -1.0..1.0_f64), 1..20),
            mut queries in prop::collection::vec(0.0..3000.0_f64, 1..30),
        ) {
            let lambda = steps.iter().scan(300.0, |at, step| { *at += step.0; Some(*at) }).collect();
            let f = PiecewiseLinear::new(lambda, steps.iter().map(|s| s.1).collect()).unwrap();
            queries.sort_by(f64::total_cmp);
            for (lambda, value) in queries.iter().zip(f.eval_ascending(&queries)) {
                prop_assert_eq!(value, f.eval(*lambda));
                prop_assert!(f.min() <= value && value <= f.max());
            }
        }
    }
}
