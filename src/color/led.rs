//! Model spectra of light-emitting diodes.

use crate::math;
use crate::spectrum::{FWHM_PER_SIGMA, PiecewiseLinear, resample::Grid};
use crate::{Error, ErrorKind, Result};

/// A Gaussian of peak 1: centre, standard deviation in nm.
pub fn gaussian(lambda_nm: f64, mean_nm: f64, sigma_nm: f64) -> f64 {
    let x = (lambda_nm - mean_nm) / sigma_nm;
    math::exp(-0.5 * x * x)
}

/// A Gaussian of peak 1: centre, full width at half maximum in nm.
pub fn gaussian_of_fwhm(lambda_nm: f64, peak_nm: f64, fwhm_nm: f64) -> f64 {
    gaussian(lambda_nm, peak_nm, fwhm_nm / FWHM_PER_SIGMA)
}

/// A diode by the model of Ohno \[Ohno2005\]: (g + 2g⁵) / 3 with a Gaussian g, times its peak power.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Led {
    /// Wavelength of the peak, nm.
    pub peak_nm: f64,
    /// Half spectral width, nm: where g is 1/e. The full width at half maximum is 0.92 times as much.
    pub half_width_nm: f64,
    /// Power at the peak.
    pub power: f64,
}

impl Led {
    /// A diode of peak power 1.
    ///
    /// # Errors
    /// A peak that is not finite, a width that is not positive and finite.
    pub fn new(peak_nm: f64, half_width_nm: f64) -> Result<Self> {
        if !(peak_nm.is_finite() && half_width_nm > 0.0 && half_width_nm.is_finite()) {
            let message =
                format!("a diode at {peak_nm} nm, {half_width_nm} nm wide; expected finite numbers, a positive width");
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        Ok(Self { peak_nm, half_width_nm, power: 1.0 })
    }

    /// Returns the diode with another power at its peak.
    pub fn with_power(self, power: f64) -> Self {
        Self { power, ..self }
    }

    /// Spectral power at a wavelength in nm.
    pub fn eval(&self, lambda_nm: f64) -> f64 {
        let x = (lambda_nm - self.peak_nm) / self.half_width_nm;
        let g = math::exp(-x * x);
        let g_2 = g * g;
        self.power * (g + 2.0 * g_2 * g_2 * g) / 3.0
    }
}

/// The spectral power of several diodes together, on a grid.
///
/// # Errors
/// A power that is not finite or too large for a table.
pub fn tabulate(leds: &[Led], grid: &Grid) -> Result<PiecewiseLinear> {
    let lambdas = grid.lambdas_nm();
    let values = lambdas.iter().map(|&lambda| leds.iter().map(|led| led.eval(lambda)).sum()).collect();
    PiecewiseLinear::new(lambdas, values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gaussian_is_half_at_half_its_width() {
        assert_eq!(gaussian_of_fwhm(555.0, 555.0, 25.0), 1.0);
        assert!((gaussian_of_fwhm(567.5, 555.0, 25.0) - 0.5).abs() < 1e-15);
        assert!((gaussian(560.0, 550.0, 10.0) - 0.606_530_659_712_633_4).abs() < 1e-15);
    }

    #[test]
    fn a_diode_has_its_peak_and_its_width() {
        let led = Led::new(455.0, 20.0).unwrap();
        assert_eq!(led.eval(455.0), 1.0);
        // (g + 2 g⁵) / 3 = 1/2 at g = 0.8087, which is 0.4608 half spectral widths away.
        let half = (0..2000).map(|i| 0.01 * f64::from(i)).find(|d| led.eval(455.0 + d) < 0.5).unwrap();
        assert!((half / 20.0 - 0.4608).abs() < 1e-3, "{half}");
        assert!(led.eval(415.0) < 0.01 && (led.eval(440.0) - led.eval(470.0)).abs() < 1e-15);
    }

    #[test]
    fn several_add_up() {
        let grid = Grid::new(380.0, 780.0, 1.0).unwrap();
        let leds = [Led::new(457.0, 20.0).unwrap(), Led::new(605.0, 28.0).unwrap().with_power(2.5)];
        let together = tabulate(&leds, &grid).unwrap();
        for (lambda, value) in together.knots() {
            assert_eq!(value, leds[0].eval(lambda) + leds[1].eval(lambda));
        }
        assert!(tabulate(&[leds[0].with_power(f64::NAN)], &grid).is_err());
        assert!(tabulate(&[], &grid).unwrap().max() == 0.0);
        for (peak, width) in [(f64::NAN, 20.0), (455.0, 0.0), (455.0, -1.0), (455.0, f64::INFINITY)] {
            assert_eq!(Led::new(peak, width).unwrap_err().kind, ErrorKind::OutOfRange);
        }
    }
}
