//! Lights and reflectances at the wavelengths of a grid, and tristimulus values as sums over it.

use crate::color::{Observer, table};
use crate::spectrum::resample::{Extrapolation, Grid, Interpolation, align};
use crate::spectrum::{PiecewiseLinear, Spectrum};
use crate::{Error, ErrorKind, Result};
use glam::DVec3;

/// Steps of tables that are taken for measurements, nm.
const MEASURED_STEPS_NM: (f64, f64) = (1.0, 20.0);
/// Fewest samples that Sprague's interpolation takes.
const SPRAGUE_SAMPLES: usize = 6;

/// The values of a light at the wavelengths of a grid, as the module says.
///
/// # Errors
/// None for valid spectra; those of interpolation.
pub(super) fn sample(
    light: &Spectrum,
    grid: &Grid,
    interpolation: Interpolation,
    beyond: Extrapolation,
) -> Result<Vec<f64>> {
    match light {
        Spectrum::Constant(_) | Spectrum::Blackbody { .. } => {
            Ok(grid.lambdas_nm().into_iter().map(|lambda| light.eval(lambda)).collect())
        }
        Spectrum::PiecewiseLinear(samples) => sample_table(samples, grid, interpolation, beyond),
        Spectrum::Line { .. } => Ok(means(&light.tabulate(), grid, Extrapolation::Zero)),
    }
}

fn sample_table(
    samples: &PiecewiseLinear,
    grid: &Grid,
    interpolation: Interpolation,
    beyond: Extrapolation,
) -> Result<Vec<f64>> {
    if samples.lambdas_nm().windows(2).any(|pair| pair[1] - pair[0] < grid.step_nm().min(1.0) * (1.0 - 1e-9)) {
        return Ok(means(samples, grid, beyond));
    }
    let step_nm = Grid::of_samples(samples).map_or(0.0, |own| own.step_nm());
    let measured = (MEASURED_STEPS_NM.0..=MEASURED_STEPS_NM.1).contains(&(step_nm * (1.0 + 1e-9)))
        && samples.values().len() >= SPRAGUE_SAMPLES;
    let interpolation = if measured { interpolation } else { Interpolation::Linear };
    Ok(align(samples, grid, interpolation, beyond)?.values().to_vec())
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
