//! Lights and reflectances at the wavelengths of a grid, and tristimulus values as sums over it.

use crate::color::{Observer, table};
use crate::spectrum::resample::{Extrapolation, Grid, Interpolation, align};
use crate::spectrum::{PiecewiseLinear, Spectrum};
use crate::{Error, ErrorKind, Result};
use glam::DVec3;

/// Wavelengths written with a few decimals are 1 nm apart up to this.
const EVENNESS_NM: f64 = 1e-6;

/// The values of a light at the wavelengths of a grid, as the module says.
pub(super) fn sample(light: &Spectrum, grid: &Grid, beyond: Extrapolation) -> Result<Vec<f64>> {
    match light {
        Spectrum::Constant(_) | Spectrum::Blackbody { .. } => {
            Ok(grid.lambdas_nm().into_iter().map(|lambda| light.eval(lambda)).collect())
        }
        Spectrum::PiecewiseLinear(samples) if is_fine(samples) => Ok(means(samples, grid, beyond)),
        Spectrum::PiecewiseLinear(samples) => {
            Ok(align(samples, grid, Interpolation::Linear, beyond)?.values().to_vec())
        }
        Spectrum::Line { .. } => Ok(means(&light.tabulate(), grid, Extrapolation::Zero)),
    }
}

/// Whether sums at 1 nm could miss something between two samples.
fn is_fine(samples: &PiecewiseLinear) -> bool {
    samples.lambdas_nm().windows(2).any(|pair| pair[1] - pair[0] < 1.0 - EVENNESS_NM)
}

/// Means around the wavelengths, weighted by triangles that reach to the neighbours.
fn means(table: &PiecewiseLinear, grid: &Grid, beyond: Extrapolation) -> Vec<f64> {
    let knots = table.lambdas_nm();
    let (first, last) = match beyond {
        Extrapolation::Zero => (knots[0], knots[knots.len() - 1]),
        _ => (0.0, f64::INFINITY),
    };
    let step = grid.step_nm();
    let mean = |lambda: f64| {
        // Beyond the grid there is nobody to see it: half a triangle at each end.
        let (from, to) = ((lambda - step).max(grid.from_nm()), (lambda + step).min(grid.to_nm()));
        let weight = |from: f64, to: f64| 0.5 * (to - from);
        let mut sum = 0.0;
        for (a, b) in [(from, lambda), (lambda, to)] {
            let (a_inside, b_inside) = (a.max(first), b.min(last));
            if a_inside < b_inside {
                sum += integral_under_ramp(table, a_inside, b_inside, lambda, step);
            }
        }
        sum / weight(from, to)
    };
    grid.lambdas_nm().into_iter().map(mean).collect()
}

/// ∫ f (1 − |λ − centre| / step) dλ on one side of the centre.
fn integral_under_ramp(f: &PiecewiseLinear, from_nm: f64, to_nm: f64, center_nm: f64, step_nm: f64) -> f64 {
    let piece = f.restricted(from_nm, to_nm);
    let height = |lambda: f64| 1.0 - (lambda - center_nm).abs() / step_nm;
    let segment = |(l, v): (&[f64], &[f64])| {
        crate::color::integration::segment_2(l[1] - l[0], [v[0], v[1]], [height(l[0]), height(l[1])])
    };
    piece.lambdas_nm().windows(2).zip(piece.values().windows(2)).map(segment).sum()
}

/// Reflectances of a file of data/quality at the wavelengths of a grid, by Sprague's interpolation, constant beyond the ends.
pub(super) fn reflectances(text: &str, grid: &Grid) -> Result<Vec<Vec<f64>>> {
    let sampled = |name| {
        let column = table::column(text, name)?;
        Ok(align(&column, grid, Interpolation::Sprague, Extrapolation::Constant)?.values().to_vec())
    };
    table::column_names(text).map(sampled).collect()
}

/// A light as an observer sees it: the colour-matching functions times its power, so that the white has Y = 1.
pub(super) struct Lamp {
    weights: Vec<DVec3>,
    /// XYZ of the light itself; Y = 1.
    pub white: DVec3,
}

impl Lamp {
    /// # Errors
    /// A light whose luminance is not positive.
    pub(super) fn new(values: &[f64], grid: &Grid, observer: &Observer) -> Result<Self> {
        let curves = grid.lambdas_nm().into_iter().map(|lambda| observer.eval(lambda));
        let mut weights: Vec<DVec3> = curves.zip(values).map(|(curve, value)| curve * *value).collect();
        let sum: DVec3 = weights.iter().sum();
        if !(sum.y > 0.0 && (1.0 / sum.y).is_finite()) {
            let message = format!("a light of luminance {:e}; expected a positive one", sum.y);
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        for weight in &mut weights {
            *weight /= sum.y;
        }
        Ok(Self { weights, white: sum / sum.y })
    }

    /// XYZ of a reflectance, whose values are on the lamp's grid.
    pub(super) fn xyz_of(&self, reflectance: &[f64]) -> DVec3 {
        self.weights.iter().zip(reflectance).map(|(weight, r)| *weight * *r).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn grid() -> Grid {
        Grid::new(400.0, 500.0, 1.0).unwrap()
    }

    #[test]
    fn a_line_keeps_its_power_and_its_centre() {
        for (center, width) in [(432.0, 0.01), (432.5, 0.01), (447.123, 0.7), (450.0, 8.0)] {
            let values = sample(&Spectrum::line(center, width).unwrap(), &grid(), Extrapolation::Zero).unwrap();
            let power: f64 = values.iter().sum();
            assert_relative_eq!(power, 1.0, max_relative = 1e-9);
            let mean: f64 = grid().lambdas_nm().iter().zip(&values).map(|(l, v)| l * v).sum();
            assert_relative_eq!(mean, center, max_relative = 1e-9);
        }
    }

    #[test]
    fn tables_are_straight_between_samples() {
        let table = PiecewiseLinear::new(vec![380.0, 410.0, 470.0], vec![0.0, 30.0, 0.0]).unwrap();
        let values = sample(&Spectrum::PiecewiseLinear(table.clone()), &grid(), Extrapolation::Zero).unwrap();
        assert_eq!((values[0], values[10], values[40], values[71]), (20.0, 30.0, 15.0, 0.0));
        let high = PiecewiseLinear::new(vec![420.0, 450.0], vec![2.0, 3.0]).unwrap();
        let values = sample(&Spectrum::PiecewiseLinear(high), &grid(), Extrapolation::Constant).unwrap();
        assert_eq!((values[0], values[100]), (2.0, 3.0));
    }

    #[test]
    fn means_of_fine_tables() {
        let lambdas: Vec<f64> = (0..=1000).map(|i| 400.0 + 0.1 * f64::from(i)).collect();
        let ramp = PiecewiseLinear::new(lambdas.clone(), lambdas.clone()).unwrap();
        let values = sample(&Spectrum::PiecewiseLinear(ramp), &grid(), Extrapolation::Constant).unwrap();
        assert_relative_eq!(values[0], 400.0 + 1.0 / 3.0, max_relative = 1e-12);
        assert_relative_eq!(values[50], 450.0, max_relative = 1e-12);
        // Half of the triangle around 450 nm lies beyond the end.
        let short: Vec<f64> = lambdas.iter().copied().filter(|l| *l < 450.05).collect();
        let flat = Spectrum::PiecewiseLinear(PiecewiseLinear::new(short.clone(), vec![1.0; short.len()]).unwrap());
        let values = sample(&flat, &grid(), Extrapolation::Zero).unwrap();
        assert_relative_eq!(values[49], 1.0, max_relative = 1e-12);
        assert_relative_eq!(values[50], 0.5, max_relative = 1e-6);
        assert_eq!(values[51], 0.0);
        assert_eq!(sample(&flat, &grid(), Extrapolation::Constant).unwrap()[51], 1.0);
    }

    #[test]
    fn a_lamp_has_unit_luminance() {
        let observer = Observer::cie_1931_2deg();
        let values = vec![7.0; grid().lambdas_nm().len()];
        let lamp = Lamp::new(&values, &grid(), observer).unwrap();
        assert_eq!(lamp.white.y, 1.0);
        assert_relative_eq!(lamp.xyz_of(&vec![0.5; values.len()]).y, 0.5, max_relative = 1e-14);
        assert!(Lamp::new(&vec![0.0; values.len()], &grid(), observer).is_err());
    }
}
