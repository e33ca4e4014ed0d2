//! The statistics that error figures need: means, quantiles, Student's t, straight lines.

use crate::math;

/// Computes the arithmetic mean, which is NaN without values.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Computes the sample standard deviation (divisor n − 1), which is NaN for fewer than two values.
pub fn standard_deviation(values: &[f64]) -> f64 {
    let m = mean(values);
    let squares: f64 = values.iter().map(|v| (v - m) * (v - m)).sum();
    if values.len() < 2 { f64::NAN } else { (squares / (values.len() - 1) as f64).sqrt() }
}

/// Computes the quantile at `p` in [0, 1], linear between order statistics (the 7th definition of \[Hyndman1996\]). It is NaN
/// without values. The values need not be sorted.
pub fn quantile(values: &[f64], p: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    quantile_of_sorted(&sorted, p)
}

/// Computes the [`quantile`] of values that are in ascending order.
pub fn quantile_of_sorted(sorted: &[f64], p: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else { return f64::NAN };
    let at = p.clamp(0.0, 1.0) * last as f64;
    let below = (at as usize).min(last);
    let above = (below + 1).min(last);
    sorted[below] + (sorted[above] - sorted[below]) * (at - below as f64)
}

/// Computes the quantile at `p` in (0, 1) of Student's t distribution with `freedom` > 0 degrees of freedom.
pub fn student_t_quantile(p: f64, freedom: f64) -> f64 {
    if p < 0.5 {
        return -student_t_quantile(1.0 - p, freedom);
    }
    // With z = t² / (ν + t²), the probability within ±t is I_z(1/2, ν/2), and that outside I_(1 − z)(ν/2, 1/2). The
    // smaller one is solved for, since it loses no digits.
    if p < 0.75 {
        let z = inverse(|z| incomplete_beta(z, 0.5, 0.5 * freedom), 2.0 * p - 1.0);
        (freedom * z / (1.0 - z)).sqrt()
    } else {
        let x = inverse(|x| incomplete_beta(x, 0.5 * freedom, 0.5), 2.0 * (1.0 - p));
        (freedom * (1.0 - x) / x).sqrt()
    }
}

/// Finds where a rising function on [0, 1] has a value, by bisection.
fn inverse(function: impl Fn(f64) -> f64, value: f64) -> f64 {
    let (mut low, mut high) = (0.0f64, 1.0f64);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if function(middle) < value { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Computes the regularised incomplete beta function I_x(a, b) by its continued fraction \[DLMF\] 8.17.22, with Lentz's method.
fn incomplete_beta(x: f64, a: f64, b: f64) -> f64 {
    if x <= 0.0 || x >= 1.0 {
        return x.clamp(0.0, 1.0);
    }
    // The continued fraction converges fast for x below the mean of the beta distribution; above, the other tail is computed.
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - incomplete_beta(1.0 - x, b, a);
    }
    let log_front =
        math::ln_gamma(a + b) - math::ln_gamma(a) - math::ln_gamma(b) + a * math::ln(x) + b * math::ln(1.0 - x);
    let tiny = f64::MIN_POSITIVE;
    let away_from_zero = |v: f64| if v.abs() < tiny { tiny } else { v };
    let (mut c, mut d) = (1.0, 1.0 / away_from_zero(1.0 - (a + b) * x / (a + 1.0)));
    let mut fraction = d;
    for m in 1..500 {
        let m = f64::from(m);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        let mut factor = 1.0;
        for term in [even, odd] {
            d = 1.0 / away_from_zero(1.0 + term * d);
            c = away_from_zero(1.0 + term / c);
            factor = c * d;
            fraction *= factor;
        }
        if (factor - 1.0).abs() < f64::EPSILON {
            break;
        }
    }
    math::exp(log_front) * fraction / a
}

/// A straight line y = intercept + slope x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// y at x = 0.
    pub intercept: f64,
    /// Change of y for a change of x by 1.
    pub slope: f64,
    /// Standard error of the slope from the residuals; NaN for fewer than three points.
    pub slope_error: f64,
}

/// Fits a line by least squares with given weights. Returns `None` unless two different x have positive weight.
pub fn fit_line(points: &[(f64, f64)], weights: &[f64]) -> Option<Line> {
    let weighted = || points.iter().zip(weights).filter(|(_, w)| **w > 0.0);
    let total: f64 = weighted().map(|(_, w)| w).sum();
    let x_mean = weighted().map(|((x, _), w)| w * x).sum::<f64>() / total;
    let y_mean = weighted().map(|((_, y), w)| w * y).sum::<f64>() / total;
    let xx: f64 = weighted().map(|((x, _), w)| w * (x - x_mean) * (x - x_mean)).sum();
    let xy: f64 = weighted().map(|((x, y), w)| w * (x - x_mean) * (y - y_mean)).sum();
    if !(xx > 0.0 && xy.is_finite()) {
        return None;
    }
    let slope = xy / xx;
    let intercept = y_mean - slope * x_mean;
    let residual = |(x, y): &(f64, f64)| y - intercept - slope * x;
    let n = weighted().count() as f64;
    let squares: f64 = weighted().map(|(point, w)| w * residual(point) * residual(point)).sum();
    let slope_error = if n > 2.0 { (squares / (n - 2.0) / xx).sqrt() } else { f64::NAN };
    Some(Line { intercept, slope, slope_error })
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn moments_and_quantiles() {
        let values = [4.0, 1.0, 3.0, 2.0];
        assert_eq!(
            (mean(&values), quantile(&values, 0.0), quantile(&values, 0.5), quantile(&values, 1.0)),
            (2.5, 1.0, 2.5, 4.0)
        );
        assert_relative_eq!(quantile(&values, 0.9), 3.7, max_relative = 1e-15);
        assert_relative_eq!(standard_deviation(&values), (5.0 / 3.0f64).sqrt(), max_relative = 1e-15);
        assert!(standard_deviation(&[1.0]).is_nan() && quantile(&[], 0.5).is_nan() && mean(&[]).is_nan());
    }

    /// Tabulated everywhere; ν = 1 is Cauchy's distribution, ν = 2 has a closed form.
    #[test]
    fn students_t() {
        assert_relative_eq!(student_t_quantile(0.975, 7.0), 2.364_624_251_592_785, max_relative = 1e-12);
        assert_relative_eq!(student_t_quantile(0.95, 30.0), 1.697_260_886_593_9, max_relative = 1e-12);
        assert_relative_eq!(student_t_quantile(0.75, 1.0), 1.0, max_relative = 1e-12);
        let closed = |p: f64| (2.0 * p - 1.0) * (2.0 / (4.0 * p * (1.0 - p))).sqrt();
        assert_relative_eq!(student_t_quantile(0.99, 2.0), closed(0.99), max_relative = 1e-12);
        assert_relative_eq!(student_t_quantile(0.025, 2.0), closed(0.025), max_relative = 1e-12);
        assert_relative_eq!(student_t_quantile(0.975, 1e6), 1.959_966, max_relative = 1e-6);
        assert!(student_t_quantile(0.5, 3.0).abs() < 1e-12);
    }

    #[test]
    fn lines() {
        let line = fit_line(&[(0.0, 1.0), (1.0, 3.0), (5.0, 11.0), (9.0, 1e9)], &[1.0, 2.0, 0.5, 0.0]).unwrap();
        assert_relative_eq!(line.slope, 2.0, max_relative = 1e-14);
        assert_relative_eq!(line.intercept, 1.0, max_relative = 1e-13);
        assert!(line.slope_error < 1e-7);
        assert_eq!(fit_line(&[(1.0, 1.0), (1.0, 2.0)], &[1.0; 2]), None);
        assert_eq!(fit_line(&[], &[]), None);
        // Residuals ±1 at x = ±1, 0 0: s² = 2 / 2, Σx² = 2.
        let noisy = fit_line(&[(-1.0, 1.0), (1.0, 1.0), (0.0, -1.0), (0.0, -1.0)], &[1.0; 4]).unwrap();
        assert_relative_eq!(noisy.slope_error, (4.0f64 / 2.0 / 2.0).sqrt(), max_relative = 1e-14);
    }
}
