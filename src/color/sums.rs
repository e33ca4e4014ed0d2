//! Tristimulus values by sums at equal steps, for parity with other programs; the exact rule is the better one.
//!
//! All functions are read at the wavelengths of a grid: tables by straight lines, held constant beyond their ends. Another
//! interpolation is made beforehand by [`crate::spectrum::resample::align`] to the same grid. At 1 nm over 360–830 nm the
//! sums of smooth spectra are right to 1e-5, those of tabulated lamps to 1e-4; lines narrower than the step are missed.

use super::Observer;
use crate::spectrum::{Spectrum, resample::Grid};
use glam::DVec3;

/// XYZ of an emission: Σ L x̄ / Σ ȳ, so that L = 1 has Y = 1.
///
/// NaN where the observer sees nothing on the grid.
pub fn xyz_of_emission(emission: &Spectrum, observer: &Observer, grid: &Grid) -> DVec3 {
    sum(grid, observer, |lambda| emission.eval(lambda)) / sum(grid, observer, |_| 1.0).y
}

/// XYZ of a reflectance (or transmittance) under an illuminant: Σ R S x̄ / Σ S ȳ, so that R = 1 has Y = 1.
///
/// NaN for an illuminant without luminance on the grid.
pub fn xyz_of_reflectance(reflectance: &Spectrum, illuminant: &Spectrum, observer: &Observer, grid: &Grid) -> DVec3 {
    let y_of_white = sum(grid, observer, |lambda| illuminant.eval(lambda)).y;
    sum(grid, observer, |lambda| reflectance.eval(lambda) * illuminant.eval(lambda)) / y_of_white
}

/// Σ f x̄, Σ f ȳ, Σ f z̄.
fn sum(grid: &Grid, observer: &Observer, f: impl Fn(f64) -> f64) -> DVec3 {
    grid.lambdas_nm().into_iter().map(|lambda| observer.eval(lambda) * f(lambda)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{illuminant, xyz};
    use crate::spectrum::PiecewiseLinear;

    #[test]
    fn a_fine_grid_approaches_the_exact_rule() {
        let observer = Observer::cie_1931_2deg();
        let lamp = illuminant::by_name("FL11").unwrap();
        let table = PiecewiseLinear::new(vec![380.0, 500.0, 620.0, 780.0], vec![0.1, 0.6, 0.2, 0.9]).unwrap();
        let paint = Spectrum::PiecewiseLinear(table);
        let exact = xyz::xyz_of_reflectance(&paint, &lamp, observer);
        let error = |step| {
            let grid = Grid::new(360.0, 830.0, step).unwrap();
            (xyz_of_reflectance(&paint, &lamp, observer, &grid) - exact).abs().max_element()
        };
        let errors = [error(10.0), error(5.0), error(1.0), error(0.1)];
        assert!(errors[0] > 1e-2 && errors[1] < 3e-3 && errors[2] < 3e-4 && errors[3] < 1e-5, "{errors:?}");
    }

    #[test]
    fn white_is_one_and_black_is_zero() {
        let grid = Grid::new(380.0, 780.0, 5.0).unwrap();
        for observer in Observer::names().map(|name| Observer::by_name(name).unwrap()) {
            assert_eq!(xyz_of_emission(&Spectrum::Constant(1.0), observer, &grid).y, 1.0);
            let lamp = illuminant::by_name("HP1").unwrap();
            let white = xyz_of_reflectance(&Spectrum::Constant(1.0), &lamp, observer, &grid);
            assert_eq!(white.y, 1.0);
            assert_eq!(xyz_of_reflectance(&Spectrum::Constant(0.0), &lamp, observer, &grid), DVec3::ZERO);
        }
    }
}
