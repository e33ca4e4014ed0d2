//! Reconstruction filters.
//!
//! Camera samples are placed by the filter (importance sampling), so that each belongs to one pixel with weight 1; light
//! paths arrive where they arrive and are spread with the same filter. Both estimate ∫ f(x − pixel centre) L(x) dx.

use crate::math;
use crate::sampling::PiecewiseLinearDensity;
use std::f64::consts::PI;

/// A separable filter around a pixel's centre.
#[derive(Debug, Clone)]
pub struct Filter {
    radius: f32,
    /// The profile along one axis; `None` for a box, which needs no table.
    profile: Option<PiecewiseLinearDensity>,
}

/// Knots of a tabulated profile.
const KNOTS: u32 = 128;

impl Filter {
    /// Constant within `radius` pixels along each axis.
    pub fn boxed(radius: f64) -> Self {
        Self { radius: radius as f32, profile: None }
    }

    /// A Gaussian with standard deviation `radius` / 3, cut (and lowered to 0) at `radius`.
    pub fn gaussian(radius: f64) -> Self {
        Self::tabulated(radius, |x| math::exp(-4.5 * x * x) - math::exp(-4.5))
    }

    /// The four-term Blackman–Harris window \[Harris1978\] stretched to `radius`.
    pub fn blackman_harris(radius: f64) -> Self {
        Self::tabulated(radius, |x| {
            let cos = |k: f64| math::cos(k * PI * (x + 1.0));
            (0.35875 - 0.48829 * cos(1.0) + 0.14128 * cos(2.0) - 0.01168 * cos(3.0)).max(0.0)
        })
    }

    /// From a profile over [−1, 1].
    fn tabulated(radius: f64, profile: impl Fn(f64) -> f64) -> Self {
        let unit = |i: u32| 2.0 * f64::from(i) / f64::from(KNOTS) - 1.0;
        let x: Vec<f64> = (0..=KNOTS).map(|i| radius * unit(i)).collect();
        let y: Vec<f64> = (0..=KNOTS).map(|i| profile(unit(i))).collect();
        Self { radius: radius as f32, profile: Some(PiecewiseLinearDensity::new(&x, &y)) }
    }

    /// Radius in pixels.
    pub fn radius(&self) -> f32 {
        self.radius
    }

    /// An offset from the pixel's centre, in pixels, drawn from the filter.
    pub fn sample(&self, u: [f32; 2]) -> [f32; 2] {
        u.map(|u| match &self.profile {
            None => (2.0 * u - 1.0) * self.radius,
            Some(profile) => profile.sample(u).0,
        })
    }

    /// Calls `deposit(column, row, weight)` for every pixel of a `width` × `height` film that a splat at `position`
    /// (pixels; centres at half-integers) belongs to.
    pub fn splat(&self, position: [f32; 2], width: u32, height: u32, mut deposit: impl FnMut(u32, u32, f32)) {
        let range = |p: f32, size: u32| {
            let first = (p - self.radius - 0.5).ceil().max(0.0);
            let last = (p + self.radius - 0.5).floor().min(size as f32 - 1.0);
            (first as u32, if last < first { None } else { Some(last as u32) })
        };
        if self.profile.is_none() && self.radius == 0.5 {
            // Exactly one pixel, also on the line between two.
            let [x, y] = position.map(f32::floor);
            if x >= 0.0 && y >= 0.0 && x < width as f32 && y < height as f32 {
                deposit(x as u32, y as u32, 1.0);
            }
            return;
        }
        let ((x0, Some(x1)), (y0, Some(y1))) = (range(position[0], width), range(position[1], height)) else { return };
        for y in y0..=y1 {
            let wy = self.weight(position[1] - (y as f32 + 0.5));
            for x in x0..=x1 {
                deposit(x, y, wy * self.weight(position[0] - (x as f32 + 0.5)));
            }
        }
    }

    fn weight(&self, offset: f32) -> f32 {
        match &self.profile {
            None => 0.5 / self.radius,
            Some(profile) => profile.density(offset),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Both uses of a filter have unit weight: samples by construction, splats over a uniform field.
    #[test]
    fn splats_integrate_to_one() {
        for filter in [Filter::boxed(0.5), Filter::boxed(1.25), Filter::gaussian(1.5), Filter::blackman_harris(2.0)] {
            let n = 200;
            let mut sum = 0.0;
            for i in 0..n * n {
                let at = [i % n, i / n].map(|k| 8.0 + (k as f32 + 0.5) / n as f32);
                filter.splat(at, 16, 16, |_, _, w| sum += f64::from(w) / f64::from(n * n));
            }
            assert!((sum - 1.0).abs() < 5e-3, "{filter:?}: {sum}");
        }
    }

    #[test]
    fn splats_stay_on_the_film() {
        let filter = Filter::gaussian(1.5);
        for at in [[-1.2, 3.0], [0.0, 0.0], [15.99, 15.99], [40.0, 2.0], [-1e9, 1e9]] {
            filter.splat(at, 16, 16, |x, y, w| assert!(x < 16 && y < 16 && w >= 0.0));
        }
    }
}
