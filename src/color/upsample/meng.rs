//! The smoothest spectrum of a colour that is nowhere negative \[Meng2015\]: a quadratic programme with knots 5 nm apart.
//!
//! Nothing bounds it from above, so light saturated colours exceed 1: as published.

use super::linear::{solve_dense, solve_tridiagonal};
use super::target::{COARSE_STEP, REFLECTANCE};
use crate::spectrum::{LAMBDA_MIN_NM, PiecewiseLinear, Spectrum};
use crate::{Error, ErrorKind, Result};
use glam::DVec3;

/// Most steps of the interior-point method; 15 are usual.
const MAX_STEPS: usize = 100;
/// Largest accepted error of the colour, relative to its largest component.
const COLOR_TOLERANCE: f64 = 1e-10;
/// Mean product of value and multiplier at which the programme counts as solved, relative to the mean squared value.
const SOLVED: f64 = 1e-15;
/// Share of the way to the nearest bound that a step may take.
const TO_THE_BOUND: f64 = 0.995;

/// The spectrum of XYZ under D65, where white has Y = 1.
///
/// # Errors
/// Components that are not finite; colours that no light has.
pub fn from_xyz(xyz: [f64; 3]) -> Result<Spectrum> {
    let xyz = DVec3::from(xyz);
    solve(REFLECTANCE.rgb_from_xyz * xyz).ok_or_else(|| {
        let message = format!("no spectrum that is nowhere negative has XYZ {xyz}; expected a colour inside the locus");
        Error::new(ErrorKind::OutOfRange, message)
    })
}

/// The spectrum of linear RGB of the sRGB primaries.
pub(super) fn solve(rgb: DVec3) -> Option<Spectrum> {
    let scale = rgb.abs().max_element();
    if !(scale > 0.0 && scale.is_finite()) {
        return None;
    }
    let programme = Programme { weights: &REFLECTANCE.coarse_weights, target: rgb / scale };
    let values = programme.solve()?;
    let knots = (0..values.len()).map(|i| LAMBDA_MIN_NM + (COARSE_STEP * i) as f64).collect();
    let values = values.into_iter().map(|value| value * scale).collect();
    Some(Spectrum::PiecewiseLinear(PiecewiseLinear::from_valid_knots(knots, values)))
}

/// Least ½ ∑ (rⱼ₊₁ − rⱼ)² with ∑ weightⱼ rⱼ = target and r ≥ 0, for a target of about unit size.
struct Programme<'a> {
    weights: &'a [DVec3],
    target: DVec3,
}

/// Values, multipliers of the three equations and of the bounds.
struct Iterate {
    values: Vec<f64>,
    multipliers: DVec3,
    bounds: Vec<f64>,
}

impl Programme<'_> {
    /// Primal-dual interior-point steps.
    fn solve(&self) -> Option<Vec<f64>> {
        let n = self.weights.len();
        let mut at = Iterate { values: vec![1.0; n], multipliers: DVec3::ZERO, bounds: vec![0.1; n] };
        for _ in 0..MAX_STEPS {
            let products: f64 = at.values.iter().zip(&at.bounds).map(|(r, s)| r * s).sum();
            let squares: f64 = at.values.iter().map(|r| r * r).sum();
            if products <= SOLVED * squares && self.residual(&at).abs().max_element() <= COLOR_TOLERANCE {
                return Some(at.values);
            }
            self.step(&mut at, 0.1 * products / n as f64)?;
        }
        None
    }

    /// Target minus colour.
    fn residual(&self, at: &Iterate) -> DVec3 {
        self.target - self.weights.iter().zip(&at.values).map(|(&w, &r)| w * r).sum::<DVec3>()
    }

    /// One Newton step towards rⱼ sⱼ = `product`, as far as r and s stay positive.
    fn step(&self, at: &mut Iterate, product: f64) -> Option<()> {
        let last = at.values.len() - 1;
        let r = &at.values;
        let right = |j: usize| {
            let left = if j > 0 { r[j] - r[j - 1] } else { 0.0 };
            let right = if j < last { r[j + 1] - r[j] } else { 0.0 };
            let gradient = left - right - at.multipliers.dot(self.weights[j]);
            let w = self.weights[j];
            [product / r[j] - gradient, w.x, w.y, w.z]
        };
        let diagonal = |j: usize| if j == 0 || j == last { 1.0 } else { 2.0 } + at.bounds[j] / r[j];
        let solution = solve_tridiagonal((0..=last).map(diagonal).collect(), (0..=last).map(right).collect())?;
        // Multipliers such that the step meets the equations.
        let residual = self.residual(at).to_array();
        let mut system: [[f64; 4]; 3] = std::array::from_fn(|k| [0.0, 0.0, 0.0, residual[k]]);
        for (w, x) in self.weights.iter().zip(&solution) {
            for (row, w) in system.iter_mut().zip(w.to_array()) {
                for (entry, column) in row.iter_mut().zip([x[1], x[2], x[3], -x[0]]) {
                    *entry += w * column;
                }
            }
        }
        let change = DVec3::from(solve_dense(system)?);
        let values = solution.iter().map(|x| x[0] + DVec3::new(x[1], x[2], x[3]).dot(change));
        let values: Vec<f64> = values.collect();
        let bounds = |j: usize| (product - at.bounds[j] * (r[j] + values[j])) / r[j];
        let bounds: Vec<f64> = (0..=last).map(bounds).collect();
        let length = longest(&at.values, &values).min(longest(&at.bounds, &bounds));
        let advance = |at: &mut [f64], by: &[f64]| at.iter_mut().zip(by).for_each(|(x, d)| *x += length * d);
        advance(&mut at.values, &values);
        advance(&mut at.bounds, &bounds);
        at.multipliers += length * change;
        Some(())
    }
}

/// The part of a step, at most all of it, that keeps numbers positive.
fn longest(at: &[f64], step: &[f64]) -> f64 {
    at.iter().zip(step).filter(|(_, d)| **d < 0.0).map(|(x, d)| -TO_THE_BOUND * x / d).fold(1.0, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::RgbSpace;
    use crate::color::upsample::rgb_of_reflectance;

    #[test]
    fn has_the_colour_is_not_negative_and_meets_the_conditions() {
        for rgb in [[0.3, 0.2, 0.1], [0.9, 0.02, 0.02], [0.0, 0.0, 1.0], [1.0, 1.0, 0.0], [1e-7, 3e-7, 0.0]] {
            let spectrum = solve(rgb.into()).unwrap();
            let back = DVec3::from(rgb_of_reflectance(&spectrum, RgbSpace::srgb()));
            assert!((back - DVec3::from(rgb)).abs().max_element() < 1e-9 * rgb[0].max(rgb[1]).max(rgb[2]), "{back}");
            assert!(spectrum.range().0 >= 0.0);
            assert_optimal(&spectrum);
        }
    }

    /// Where a value is positive, second differences are a combination of the weights.
    fn assert_optimal(spectrum: &Spectrum) {
        let (weights, table) = (&REFLECTANCE.coarse_weights, spectrum.tabulate());
        let r = table.values();
        let most = table.max();
        let free: Vec<usize> = (1..r.len() - 1).filter(|&j| r[j] > 1e-6 * most).collect();
        let second = |j: usize| (2.0 * r[j] - r[j - 1] - r[j + 1]) / most;
        // Least squares by the normal equations.
        let mut system = [[0.0; 4]; 3];
        for &j in &free {
            let w = weights[j].to_array();
            for (k, row) in system.iter_mut().enumerate() {
                for (entry, column) in row.iter_mut().zip([w[0], w[1], w[2], second(j)]) {
                    *entry += w[k] * column;
                }
            }
        }
        let m = DVec3::from(solve_dense(system).unwrap());
        let worst = free.iter().map(|&j| (second(j) - m.dot(weights[j])).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-7, "{worst:e}");
    }

    #[test]
    fn greys_are_flat_and_impossible_colours_have_none() {
        let (least, most) = solve(DVec3::splat(0.4)).unwrap().range();
        assert!((least - 0.4).abs() < 1e-9 && (most - 0.4).abs() < 1e-9);
        assert_eq!(solve(DVec3::new(-1.0, 0.2, 0.2)), None);
        assert_eq!(solve(DVec3::ZERO), None);
        assert!(from_xyz([f64::NAN; 3]).is_err());
    }
}
