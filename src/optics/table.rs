//! A quantity measured at some wavelengths, piecewise linear between them.

use crate::{Error, ErrorKind, Result};

/// Values over wavelength, piecewise linear, the end values beyond the ends.
///
/// Holds an index of refraction or an extinction coefficient as measured; whether values beyond the ends are allowed is
/// decided by whoever uses it (see [`IndexOfRefraction::checked`](super::ior::IndexOfRefraction::checked)).
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    wavelengths_nm: Vec<f64>,
    values: Vec<f64>,
}

impl Table {
    /// A table of at least one row; wavelengths in nm, positive and strictly ascending.
    ///
    /// # Errors
    /// `Missing` for an empty table or columns of unequal length, `NotFinite` for NaN and infinities, `OutOfRange` for
    /// wavelengths that are not positive or do not ascend. The message counts rows from 1.
    pub fn new(wavelengths_nm: Vec<f64>, values: Vec<f64>) -> Result<Self> {
        let error = |kind, message: String| Err(Error::new(kind, message));
        if wavelengths_nm.is_empty() || wavelengths_nm.len() != values.len() {
            let (rows, found) = (wavelengths_nm.len(), values.len());
            let message = format!("expected one value for each wavelength and at least one, found {found} for {rows}");
            return error(ErrorKind::Missing, message);
        }
        for (i, (&lambda_nm, &value)) in wavelengths_nm.iter().zip(&values).enumerate() {
            let row = i + 1;
            if !lambda_nm.is_finite() || !value.is_finite() {
                let message = format!("row {row} is ({lambda_nm}, {value}): expected finite numbers");
                return error(ErrorKind::NotFinite, message);
            }
            if lambda_nm <= 0.0 {
                let message = format!("row {row} has the wavelength {lambda_nm} nm: expected more than 0");
                return error(ErrorKind::OutOfRange, message);
            }
            if i > 0 && lambda_nm <= wavelengths_nm[i - 1] {
                let before = wavelengths_nm[i - 1];
                let message = format!("row {row} has {lambda_nm} nm after {before} nm: expected ascending wavelengths");
                return error(ErrorKind::OutOfRange, message);
            }
        }
        Ok(Self { wavelengths_nm, values })
    }

    /// Value at a wavelength in nm.
    #[inline]
    pub fn eval(&self, lambda_nm: f64) -> f64 {
        let (x, y) = (&self.wavelengths_nm, &self.values);
        let right = x.partition_point(|&w| w <= lambda_nm);
        if right == 0 {
            return y[0];
        }
        if right == x.len() {
            return y[right - 1];
        }
        let t = (lambda_nm - x[right - 1]) / (x[right] - x[right - 1]);
        y[right - 1] + t * (y[right] - y[right - 1])
    }

    /// Wavelengths, nm, strictly ascending.
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.wavelengths_nm
    }

    /// Values at these wavelengths.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// First and last wavelength, nm.
    pub fn range_nm(&self) -> [f64; 2] {
        [self.wavelengths_nm[0], self.wavelengths_nm[self.wavelengths_nm.len() - 1]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_linear_between_rows_and_constant_beyond() {
        let table = Table::new(vec![400.0, 500.0, 700.0], vec![1.0, 2.0, 1.0]).unwrap();
        let expected =
            [(300.0, 1.0), (400.0, 1.0), (425.0, 1.25), (500.0, 2.0), (600.0, 1.5), (700.0, 1.0), (900.0, 1.0)];
        for (lambda_nm, value) in expected {
            assert_eq!(table.eval(lambda_nm), value, "{lambda_nm} nm");
        }
        assert_eq!(Table::new(vec![500.0], vec![3.0]).unwrap().eval(400.0), 3.0);
    }

    #[test]
    fn bad_tables_are_errors() {
        let kind = |w: &[f64], v: &[f64]| Table::new(w.to_vec(), v.to_vec()).unwrap_err().kind;
        assert_eq!(kind(&[], &[]), ErrorKind::Missing);
        assert_eq!(kind(&[1.0, 2.0], &[1.0]), ErrorKind::Missing);
        assert_eq!(kind(&[1.0, f64::INFINITY], &[1.0, 1.0]), ErrorKind::NotFinite);
        assert_eq!(kind(&[1.0], &[f64::NAN]), ErrorKind::NotFinite);
        assert_eq!(kind(&[0.0], &[1.0]), ErrorKind::OutOfRange);
        assert_eq!(kind(&[2.0, 2.0], &[1.0, 1.0]), ErrorKind::OutOfRange);
        assert_eq!(kind(&[2.0, 1.0], &[1.0, 1.0]), ErrorKind::OutOfRange);
    }
}
