//! The cubic spline with "not a knot" ends.

use super::too_few;
use crate::Result;
use crate::spectrum::PiecewiseLinear;

/// Samples and the slopes of the spline at them.
pub(super) struct CubicSpline<'a> {
    samples: &'a PiecewiseLinear,
    slopes: Vec<f64>,
}

/// The rows `below · s[i−1] + on · s[i] + above · s[i+1] = right` of a tridiagonal system.
#[derive(Clone, Copy)]
struct Row {
    below: f64,
    on: f64,
    above: f64,
    right: f64,
}

impl<'a> CubicSpline<'a> {
    pub(super) fn new(samples: &'a PiecewiseLinear) -> Result<Self> {
        if samples.values().len() < 4 {
            return Err(too_few(samples, "a cubic spline", 4));
        }
        let widths: Vec<f64> = samples.lambdas_nm().windows(2).map(|l| l[1] - l[0]).collect();
        let chords: Vec<f64> = samples.values().windows(2).zip(&widths).map(|(v, h)| (v[1] - v[0]) / h).collect();
        Ok(Self { samples, slopes: solve(rows(&widths, &chords)) })
    }

    /// The values at wavelengths inside the range of the samples.
    pub(super) fn eval_all(&self, lambdas_nm: &[f64]) -> Vec<f64> {
        lambdas_nm.iter().map(|&lambda| self.eval(lambda)).collect()
    }

    fn eval(&self, lambda_nm: f64) -> f64 {
        let (knots, values) = (self.samples.lambdas_nm(), self.samples.values());
        let i = (knots.partition_point(|&knot| knot <= lambda_nm) - 1).min(knots.len() - 2);
        let h = knots[i + 1] - knots[i];
        let (t, s) = ((lambda_nm - knots[i]) / h, (knots[i + 1] - lambda_nm) / h);
        // Hermite's form: the line's values, corrected by how the slopes differ from the chord's.
        let chord = values[i + 1] - values[i];
        let (left, right) = (h * self.slopes[i] - chord, chord - h * self.slopes[i + 1]);
        s * values[i] + t * values[i + 1] + t * s * (s * left + t * right)
    }
}

/// Continuity of the second derivative at inner samples, of the third at the second and the last but one.
fn rows(widths: &[f64], chords: &[f64]) -> Vec<Row> {
    let n = widths.len();
    let mut rows = Vec::with_capacity(n + 1);
    let (on, above, right) = end_row([widths[0], widths[1]], [chords[0], chords[1]]);
    rows.push(Row { below: 0.0, on, above, right });
    for i in 1..n {
        let (h, d) = (&widths[i - 1..=i], &chords[i - 1..=i]);
        rows.push(Row { below: h[1], on: 2.0 * (h[0] + h[1]), above: h[0], right: 3.0 * (h[1] * d[0] + h[0] * d[1]) });
    }
    let (on, below, right) = end_row([widths[n - 1], widths[n - 2]], [chords[n - 1], chords[n - 2]]);
    rows.push(Row { below, on, above: 0.0, right });
    rows
}

/// The end's slope, that of its neighbour and the right side, from the two outermost widths and chords.
fn end_row(h: [f64; 2], d: [f64; 2]) -> (f64, f64, f64) {
    let both = h[0] + h[1];
    (h[1], both, ((h[0] + 2.0 * both) * h[1] * d[0] + h[0] * h[0] * d[1]) / both)
}

/// Gauss elimination without pivots: after the first step every pivot is larger than what is above it.
fn solve(mut rows: Vec<Row>) -> Vec<f64> {
    for i in 1..rows.len() {
        let factor = rows[i].below / rows[i - 1].on;
        rows[i].on -= factor * rows[i - 1].above;
        rows[i].right -= factor * rows[i - 1].right;
    }
    let mut solution = vec![0.0; rows.len()];
    let mut next = 0.0;
    for (row, value) in rows.iter().zip(&mut solution).rev() {
        *value = (row.right - row.above * next) / row.on;
        next = *value;
    }
    solution
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn second_derivative_is_continuous_at_uneven_samples() {
        let samples =
            PiecewiseLinear::new(vec![400.0, 410.0, 413.0, 440.0, 441.0, 470.0], vec![0.1, 0.9, 0.3, 0.35, 0.2, 0.8])
                .unwrap();
        let curve = CubicSpline::new(&samples).unwrap();
        let h = 1e-3;
        for knot in [410.0, 413.0, 440.0, 441.0] {
            let at = |k: f64| curve.eval(knot + k * h);
            let (left, right) = (at(-2.0) - 2.0 * at(-1.0) + at(0.0), at(0.0) - 2.0 * at(1.0) + at(2.0));
            let scale = left.abs().max(1e-8);
            assert!((left - right).abs() < 2e-2 * scale, "{knot}: {left:e} {right:e}");
        }
    }

    #[test]
    fn four_samples_are_one_cubic() {
        let cubic = |l: f64| {
            let x = (l - 410.0) / 10.0;
            x * x * x - x + 0.5
        };
        let lambda = vec![400.0, 401.0, 420.0, 425.0];
        let samples = PiecewiseLinear::new(lambda.clone(), lambda.iter().map(|&l| cubic(l)).collect()).unwrap();
        let curve = CubicSpline::new(&samples).unwrap();
        for l in [400.0, 400.5, 411.0, 423.0, 425.0] {
            assert!((curve.eval(l) - cubic(l)).abs() < 1e-13, "{l}");
        }
    }
}
