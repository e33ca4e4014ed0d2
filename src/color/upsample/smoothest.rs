//! The smoothest spectrum of a given colour, behind a link that bounds it.
//!
//! A spectrum is `link(z)` at knots 1 nm apart. Of all z with ∑ wⱼ link(zⱼ) = target (three equations, the colour) we
//! take the one with the least ∑ (zⱼ₊₁ − zⱼ)². With the logistic link this is the "least hyperbolic tangent slope
//! squared" of \[Burns2019\]; with the exponential one it is the positive, scale-free curve for emissions. Around a given
//! curve it is z minus that curve which is the smoothest: the least change, in this sense, that gives the colour.
//!
//! Gauss–Newton steps (linear in the number of knots, since the smoothest curve under linear constraints is a double
//! running sum) come near the solution; Newton steps on the whole system (tridiagonal) finish it to rounding.

use super::linear::{solve_dense, solve_tridiagonal};
use crate::math;
use glam::DVec3;

/// Most steps of either kind; solvable colours take 6 on average and under 20.
const MAX_STEPS: usize = 60;
/// Most halvings of a Gauss–Newton step.
const MAX_HALVINGS: usize = 14;
/// Largest accepted error of the colour, relative to its largest component.
const COLOR_TOLERANCE: f64 = 1e-10;
/// Below this relative error of the colour Newton steps are tried.
const NEWTON_REGION: f64 = 1e-2;
/// The system counts as solved at this norm of the gradient (slope units) and colour error.
const SOLVED: f64 = 1e-12;
/// Keeps the tridiagonal matrix regular where the constraints have no curvature (greys); too small to slow Newton.
const REGULARIZATION: f64 = 1e-9;

/// How an unbounded curve becomes a spectrum.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Link {
    /// 1 / (1 + e⁻ᶻ): within [0, 1].
    Logistic,
    /// eᶻ: not negative.
    Exponential,
}

impl Link {
    /// Value, first and second derivative.
    fn eval(self, z: f64) -> [f64; 3] {
        match self {
            Self::Exponential => [math::exp(z); 3],
            Self::Logistic => {
                let e = math::exp(-z.abs());
                let large = 1.0 / (1.0 + e);
                let small = e * large;
                let value = if z < 0.0 { small } else { large };
                let slope = small * large;
                [value, slope, slope * (1.0 - 2.0 * value)]
            }
        }
    }

    /// The values of a curve; those of the logistic link never round to 0 or 1.
    pub(super) fn values(self, z: &[f64]) -> Vec<f64> {
        let bounds = match self {
            Self::Logistic => (f64::MIN_POSITIVE, 1.0 - 0.5 * f64::EPSILON),
            Self::Exponential => (0.0, f64::INFINITY),
        };
        z.iter().map(|&z| self.eval(z)[0].clamp(bounds.0, bounds.1)).collect()
    }

    /// The z of a value inside the link's range.
    pub(super) fn inverse(self, value: f64) -> f64 {
        match self {
            Self::Exponential => math::ln(value),
            Self::Logistic => math::ln(value / (1.0 - value)),
        }
    }

    /// A value well inside the link's range near a mean of the colour's components.
    fn start(self, mean: f64) -> f64 {
        match self {
            Self::Exponential => mean.max(1e-3),
            Self::Logistic => mean.clamp(1e-12, 1.0 - 1e-9),
        }
    }
}

/// The smoothest spectrum, as values at the weights' knots, whose colour ∑ weightⱼ valueⱼ is the target.
///
/// `None` if there is no such spectrum (or none is found): the colour lies outside of what the link can reach.
pub(super) fn solve(weights: &[DVec3], target: DVec3, link: Link) -> Option<Vec<f64>> {
    let z = solve_curve(weights, target, link, None)?;
    Some(link.values(&z))
}

/// The z whose difference from `around` (or from 0) is the smoothest, with link(z) of the target's colour.
pub(super) fn solve_curve(weights: &[DVec3], target: DVec3, link: Link, around: Option<&[f64]>) -> Option<Vec<f64>> {
    let scale = target.abs().max_element();
    if !(scale > 0.0 && scale.is_finite()) {
        return None;
    }
    // Everything is relative to the target's size, so that dark colours are solved as well as bright ones.
    let weights: Vec<DVec3> = weights.iter().map(|&w| w / scale).collect();
    let start = match around {
        Some(_) => 0.0,
        None => link.inverse(link.start(target.element_sum() / 3.0)),
    };
    let problem = Problem { weights: &weights, target: target / scale, link, around };
    let y = problem.solve(vec![start; weights.len()])?;
    Some(problem.curve(&y).collect())
}

/// Weights and target divided by the target's largest component.
struct Problem<'a> {
    weights: &'a [DVec3],
    target: DVec3,
    link: Link,
    around: Option<&'a [f64]>,
}

/// The constraints near a curve.
struct Linearization {
    /// Target minus colour.
    residual: DVec3,
    /// Derivative of the colour by zⱼ.
    slopes: Vec<DVec3>,
    /// Second derivative by zⱼ.
    curvatures: Vec<DVec3>,
}

/// A difference from the curve around which to be smooth, with the multipliers of the three constraints.
struct Iterate {
    y: Vec<f64>,
    multipliers: DVec3,
    lin: Linearization,
}

impl Problem<'_> {
    fn solve(&self, y: Vec<f64>) -> Option<Vec<f64>> {
        let mut at = self.iterate(y, DVec3::ZERO);
        for step in 0..MAX_STEPS {
            if step > 0 && at.color_error() < NEWTON_REGION {
                let norm = at.optimality();
                if norm < SOLVED {
                    break;
                }
                if let Some(next) = self.newton_step(&at, norm) {
                    at = next;
                    continue;
                }
            }
            match self.gauss_newton_step(&at) {
                Some(next) => at = next,
                None => break,
            }
        }
        (at.color_error() <= COLOR_TOLERANCE).then_some(at.y)
    }

    /// z at the knots.
    fn curve(&self, y: &[f64]) -> impl Iterator<Item = f64> {
        y.iter().enumerate().map(|(j, y)| self.around.map_or(*y, |around| around[j] + y))
    }

    fn iterate(&self, y: Vec<f64>, multipliers: DVec3) -> Iterate {
        let mut color = DVec3::ZERO;
        let (mut slopes, mut curvatures) = (Vec::with_capacity(y.len()), Vec::with_capacity(y.len()));
        for (&weight, z) in self.weights.iter().zip(self.curve(&y)) {
            let [value, slope, curvature] = self.link.eval(z);
            color += weight * value;
            slopes.push(weight * slope);
            curvatures.push(weight * curvature);
        }
        Iterate { y, multipliers, lin: Linearization { residual: self.target - color, slopes, curvatures } }
    }

    /// The smoothest curve under the linearised constraints, approached as far as it lowers the error.
    fn gauss_newton_step(&self, at: &Iterate) -> Option<Iterate> {
        let (goal, multipliers) = smoothest_under_linear_constraints(&at.y, &at.lin)?;
        let mut fraction = 1.0;
        for _ in 0..MAX_HALVINGS {
            let y = at.y.iter().zip(&goal).map(|(y, goal)| y + fraction * (goal - y)).collect();
            let next = self.iterate(y, at.multipliers.lerp(multipliers, fraction));
            if next.color_error() < at.color_error() * (1.0 - 1e-4 * fraction) {
                return Some(next);
            }
            fraction *= 0.5;
        }
        None
    }

    /// A full Newton step, if it halves the norm of the optimality conditions.
    fn newton_step(&self, at: &Iterate, norm: f64) -> Option<Iterate> {
        let lin = &at.lin;
        // H = (second differences) − ∑ multiplier · curvature; the right-hand sides are −gradient and the three slopes.
        let last = at.y.len() - 1;
        let diagonal = lin.curvatures.iter().enumerate().map(|(j, c)| {
            let neighbours = if j == 0 || j == last { 1.0 } else { 2.0 };
            neighbours + REGULARIZATION - at.multipliers.dot(*c)
        });
        let right = at.gradient().zip(&lin.slopes).map(|(g, s)| [-g, s.x, s.y, s.z]);
        let solution = solve_tridiagonal(diagonal.collect(), right.collect())?;
        // Multipliers such that the step meets the linearised constraints.
        let mut system = [[0.0; 4]; 3];
        for (slope, x) in lin.slopes.iter().zip(&solution) {
            for (row, s) in system.iter_mut().zip(slope.to_array()) {
                for (entry, column) in row.iter_mut().zip([x[1], x[2], x[3], -x[0]]) {
                    *entry += s * column;
                }
            }
        }
        for (row, residual) in system.iter_mut().zip(lin.residual.to_array()) {
            row[3] += residual;
        }
        let change = DVec3::from(solve_dense(system)?);
        let step = |x: &[f64; 4]| x[0] + DVec3::new(x[1], x[2], x[3]).dot(change);
        let y = at.y.iter().zip(&solution).map(|(y, x)| y + step(x)).collect();
        let next = self.iterate(y, at.multipliers + change);
        (next.optimality() < 0.5 * norm).then_some(next)
    }
}

impl Iterate {
    fn color_error(&self) -> f64 {
        self.lin.residual.abs().max_element()
    }

    /// Gradient of ½ ∑ (yⱼ₊₁ − yⱼ)² − multipliers · colour.
    fn gradient(&self) -> impl Iterator<Item = f64> {
        let last = self.y.len() - 1;
        (0..=last).map(move |j| {
            let left = if j > 0 { self.y[j] - self.y[j - 1] } else { 0.0 };
            let right = if j < last { self.y[j + 1] - self.y[j] } else { 0.0 };
            left - right - self.multipliers.dot(self.lin.slopes[j])
        })
    }

    /// Distance from the optimality conditions: norm of the gradient plus colour error.
    fn optimality(&self) -> f64 {
        self.gradient().map(|g| g * g).sum::<f64>().sqrt() + self.color_error()
    }
}

/// The y of least ∑ (yⱼ₊₁ − yⱼ)² that meets the linearised constraints, and its multipliers.
///
/// Its second differences are a combination of the slopes, so it is a combination of their double running sums plus
/// a constant: four unknowns, from three constraints and the condition that the slopes' combination sums to 0.
fn smoothest_under_linear_constraints(y: &[f64], lin: &Linearization) -> Option<(Vec<f64>, DVec3)> {
    let mut basis = Vec::with_capacity(y.len());
    let (mut height, mut slope_sum) = (DVec3::ZERO, DVec3::ZERO);
    for &slope in &lin.slopes {
        basis.push(height);
        slope_sum += slope;
        height -= slope_sum;
    }
    let mean = basis.iter().copied().sum::<DVec3>() / basis.len() as f64;
    let mut right = lin.residual;
    let mut matrix = [DVec3::ZERO; 3];
    for ((basis, &slope), &y) in basis.iter_mut().zip(&lin.slopes).zip(y) {
        *basis -= mean;
        right += slope * y;
        for (row, s) in matrix.iter_mut().zip(slope.to_array()) {
            *row += *basis * s;
        }
    }
    let [m, s, r] = [matrix, [slope_sum; 3], [right; 3]];
    let x = solve_dense([
        [m[0].x, m[0].y, m[0].z, s[0].x, r[0].x],
        [m[1].x, m[1].y, m[1].z, s[1].y, r[1].y],
        [m[2].x, m[2].y, m[2].z, s[2].z, r[2].z],
        [slope_sum.x, slope_sum.y, slope_sum.z, 0.0, 0.0],
    ])?;
    let multipliers = DVec3::new(x[0], x[1], x[2]);
    Some((basis.iter().map(|b| b.dot(multipliers) + x[3]).collect(), multipliers))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Three overlapping bumps on a short grid, each of unit sum.
    fn bumps(n: usize) -> Vec<DVec3> {
        let bump = |j: usize, center: f64| {
            let x = (j as f64 / (n - 1) as f64 - center) / 0.15;
            math::exp(-0.5 * x * x)
        };
        let raw: Vec<DVec3> = (0..n).map(|j| DVec3::new(bump(j, 0.8), bump(j, 0.5), bump(j, 0.2))).collect();
        let sum: DVec3 = raw.iter().copied().sum();
        raw.into_iter().map(|w| w / sum).collect()
    }

    fn roughness(values: &[f64], link: Link) -> f64 {
        values.windows(2).map(|v| link.inverse(v[1]) - link.inverse(v[0])).map(|d| d * d).sum()
    }

    #[test]
    fn meets_the_colour_and_no_neighbour_is_smoother() {
        let weights = bumps(41);
        let target = DVec3::new(0.7, 0.2, 0.4);
        for link in [Link::Logistic, Link::Exponential] {
            let values = solve(&weights, target, link).unwrap();
            let color: DVec3 = weights.iter().zip(&values).map(|(&w, &v)| w * v).sum();
            assert!((color - target).abs().max_element() < 1e-12);
            // Changes that keep the colour to first order: four random ones combined so that the three sums vanish.
            for seed in 0..20_usize {
                let bump = |k: usize, j: usize| math::sin(((seed * 7 + k * 3 + 1) * (j + 1)) as f64);
                let effect = |k: usize| -> DVec3 { (0..41).map(|j| weights[j] * bump(k, j) * values[j]).sum() };
                let (a, b, c, d) = (effect(0), effect(1), effect(2), effect(3));
                let Some(x) = solve_dense([[a.x, b.x, c.x, -d.x], [a.y, b.y, c.y, -d.y], [a.z, b.z, c.z, -d.z]]) else {
                    continue;
                };
                let change =
                    |j: usize| (x[0] * bump(0, j) + x[1] * bump(1, j) + x[2] * bump(2, j) + bump(3, j)) * values[j];
                let largest = (0..41).map(|j| (change(j) / (values[j] * (1.0 - values[j]).abs())).abs());
                let size = 1e-4 / largest.fold(0.0, f64::max);
                let moved: Vec<f64> = (0..41).map(|j| values[j] + size * change(j)).collect();
                assert!(roughness(&moved, link) > roughness(&values, link) * (1.0 - 1e-9), "{link:?} {seed}");
            }
        }
    }

    #[test]
    fn an_impossible_colour_has_no_solution() {
        let weights = bumps(41);
        assert_eq!(solve(&weights, DVec3::new(0.5, 1.2, 0.5), Link::Logistic), None);
        assert_eq!(solve(&weights, DVec3::new(0.5, -0.1, 0.5), Link::Exponential), None);
        assert_eq!(solve(&weights, DVec3::ZERO, Link::Exponential), None);
        assert_eq!(solve(&weights, DVec3::NAN, Link::Logistic), None);
    }

    #[test]
    fn link_derivatives_are_differences() {
        for link in [Link::Logistic, Link::Exponential] {
            for z in [-12.0, -1.5, 0.0, 0.3, 6.0] {
                let h = 1e-5;
                let [above, below, here] = [z + h, z - h, z].map(|z| link.eval(z));
                assert_relative_eq!(here[1], (above[0] - below[0]) / (2.0 * h), max_relative = 1e-6);
                assert_relative_eq!(here[2], (above[1] - below[1]) / (2.0 * h), max_relative = 1e-6, epsilon = 1e-10);
                assert_relative_eq!(link.inverse(here[0]), z, max_relative = 1e-9, epsilon = 1e-15);
            }
        }
        assert_eq!(Link::Logistic.eval(800.0), [1.0, 0.0, 0.0]);
        assert_eq!(Link::Logistic.eval(-800.0), [0.0, 0.0, 0.0]);
    }
}
