//! Values beyond the ends of samples.

use super::named;
use crate::Result;
use crate::spectrum::PiecewiseLinear;

/// Values that are taken beyond the first and the last sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extrapolation {
    /// The value of the nearest sample.
    Constant,
    /// The line through the two nearest samples.
    Linear,
    /// The value 0.
    Zero,
}

impl Extrapolation {
    const NAMED: [(&'static str, Self); 3] =
        [("constant", Self::Constant), ("linear", Self::Linear), ("zero", Self::Zero)];

    /// "constant", "linear" or "zero".
    ///
    /// # Errors
    /// [`crate::ErrorKind::UnknownName`] with the nearest name.
    pub fn by_name(name: &str) -> Result<Self> {
        named(&Self::NAMED, "extrapolation", name)
    }

    /// The names that [`Extrapolation::by_name`] knows.
    pub fn names() -> impl Iterator<Item = &'static str> {
        Self::NAMED.into_iter().map(|(name, _)| name)
    }

    /// The values at wavelengths outside the range of the samples.
    pub(super) fn eval_all(self, samples: &PiecewiseLinear, lambdas_nm: &[f64]) -> Vec<f64> {
        lambdas_nm.iter().map(|&lambda| self.eval(samples, lambda)).collect()
    }

    fn eval(self, samples: &PiecewiseLinear, lambda_nm: f64) -> f64 {
        let (lambdas, values) = (samples.lambdas_nm(), samples.values());
        let last = lambdas.len() - 1;
        let (end, inner) = if lambda_nm < lambdas[0] { (0, 1.min(last)) } else { (last, last.saturating_sub(1)) };
        match self {
            Self::Zero => 0.0,
            Self::Linear if inner != end => {
                let slope = (values[inner] - values[end]) / (lambdas[inner] - lambdas[end]);
                values[end] + slope * (lambda_nm - lambdas[end])
            }
            Self::Linear | Self::Constant => values[end],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn follows_its_name() {
        let samples = PiecewiseLinear::new(vec![400.0, 410.0, 500.0], vec![1.0, 2.0, 2.9]).unwrap();
        let at = [390.0, 600.0];
        assert_eq!(Extrapolation::Constant.eval_all(&samples, &at), [1.0, 2.9]);
        assert_eq!(Extrapolation::Zero.eval_all(&samples, &at), [0.0, 0.0]);
        let linear = Extrapolation::Linear.eval_all(&samples, &at);
        assert!(linear[0].abs() < 1e-15 && (linear[1] - 3.9).abs() < 1e-14, "{linear:?}");
    }

    #[test]
    fn one_sample_has_no_slope() {
        let samples = PiecewiseLinear::new(vec![400.0], vec![1.5]).unwrap();
        assert_eq!(Extrapolation::Linear.eval_all(&samples, &[300.0, 500.0]), [1.5, 1.5]);
    }

    #[test]
    fn names() {
        for name in Extrapolation::names() {
            assert!(Extrapolation::by_name(name).is_ok());
        }
        assert_eq!(Extrapolation::by_name("const").unwrap_err().nearest.as_deref(), Some("constant"));
    }
}
