//! Wavelengths at equal distances.

use crate::spectrum::PiecewiseLinear;
use crate::{Error, ErrorKind, Result};

/// Most wavelengths of a grid.
const MAX_COUNT: f64 = 1e6;
/// Wavelengths written with a few decimals are at equal distances up to this part of the distance.
const EVENNESS: f64 = 1e-6;

/// Wavelengths from one to another at equal distances, both ends included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    from_nm: f64,
    step_nm: f64,
    count: usize,
}

impl Grid {
    /// Makes a grid from the first to the last wavelength in nm, with a step in nm.
    ///
    /// # Errors
    /// Ends that are not positive, finite and ascending (or equal); a step that is not positive, does not lead from one
    /// end to the other in a whole number of steps, or makes more than a million of them.
    pub fn new(from_nm: f64, to_nm: f64, step_nm: f64) -> Result<Self> {
        if !(from_nm > 0.0 && from_nm <= to_nm && to_nm.is_finite()) {
            let message = format!("a grid over {from_nm}–{to_nm} nm; expected positive, ascending ends");
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        let steps = (to_nm - from_nm) / step_nm;
        if !(step_nm > 0.0 && step_nm.is_finite() && steps < MAX_COUNT) {
            let message = format!(
                "a step of {step_nm} nm; expected a positive one, of which {from_nm}–{to_nm} nm has less than {MAX_COUNT}"
            );
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        if (steps - steps.round()).abs() > EVENNESS {
            let message = format!("{steps} steps of {step_nm} nm over {from_nm}–{to_nm} nm; expected a whole number");
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        Ok(Self { from_nm, step_nm, count: steps.round() as usize + 1 })
    }

    /// The grid that the samples are on; `None` for a single sample or unequal distances.
    pub fn of_samples(samples: &PiecewiseLinear) -> Option<Self> {
        let lambdas = samples.lambdas_nm();
        let count = lambdas.len();
        let (first, last) = (lambdas[0], lambdas[count - 1]);
        if count < 2 {
            return None;
        }
        let step_nm = (last - first) / (count - 1) as f64;
        let even = |pair: &[f64]| (pair[1] - pair[0] - step_nm).abs() <= EVENNESS * step_nm;
        lambdas.windows(2).all(even).then_some(Self { from_nm: first, step_nm, count })
    }

    /// First wavelength, nm.
    pub fn from_nm(&self) -> f64 {
        self.from_nm
    }

    /// Last wavelength, nm.
    pub fn to_nm(&self) -> f64 {
        self.lambda_nm(self.count - 1)
    }

    /// Distance of neighbours, nm.
    pub fn step_nm(&self) -> f64 {
        self.step_nm
    }

    /// The wavelengths, nm.
    pub fn lambdas_nm(&self) -> Vec<f64> {
        (0..self.count).map(|i| self.lambda_nm(i)).collect()
    }

    fn lambda_nm(&self, i: usize) -> f64 {
        self.from_nm + i as f64 * self.step_nm
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn has_both_ends() {
        let grid = Grid::new(360.0, 780.0, 20.0).unwrap();
        assert_eq!((grid.from_nm(), grid.to_nm(), grid.step_nm(), grid.lambdas_nm().len()), (360.0, 780.0, 20.0, 22));
        assert_eq!(Grid::new(380.0, 380.6, 0.1).unwrap().lambdas_nm().len(), 7);
        assert_eq!(Grid::new(555.0, 555.0, 1.0).unwrap().lambdas_nm(), [555.0]);
    }

    #[test]
    fn says_what_is_wrong() {
        for (from, to, step) in [
            (400.0, 300.0, 1.0),
            (0.0, 300.0, 1.0),
            (400.0, f64::INFINITY, 1.0),
            (400.0, 700.0, 0.0),
            (400.0, 700.0, -1.0),
            (400.0, 700.0, f64::NAN),
            (400.0, 700.0, 7.0),
            (400.0, 700.0, 1e-5),
        ] {
            let error = Grid::new(from, to, step).unwrap_err();
            assert_eq!(error.kind, ErrorKind::OutOfRange, "{error}");
        }
    }

    #[test]
    fn is_found_in_samples() {
        let of = |lambdas: Vec<f64>| {
            let values = vec![0.0; lambdas.len()];
            Grid::of_samples(&PiecewiseLinear::new(lambdas, values).unwrap())
        };
        let grid = of((0..=40).map(|i| 380.0 + 0.1 * f64::from(i)).collect()).unwrap();
        assert!((grid.step_nm() - 0.1).abs() < 1e-12);
        assert_eq!(of(vec![400.0, 405.0, 411.0]), None);
        assert_eq!(of(vec![400.0]), None);
    }
}
