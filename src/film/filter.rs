//! Reconstruction filters.
//!
//! A pixel is ∫ f(x − pixel centre) L(x) dx. Samples that are spread evenly over the film, of the camera's or where light paths
//! arrive, count in every pixel whose filter reaches them. Those that are placed by the filter belong to one pixel with
//! weight 1: with a filter wider than a pixel as many of them make more noise, by (∫f)² / ∫f², 2.2 for
//! Blackman–Harris of radius 1.5.

use crate::math;
use crate::sampling::PiecewiseLinearDensity;
use std::f64::consts::PI;

/// A separable filter around a pixel's centre.
#[derive(Debug, Clone)]
pub struct Filter {
    radius: f32,
    /// The profile along one axis; `None` for a box, which needs no table.
    profile: Option<Profile>,
}

/// A filter's values along one axis, linear between evenly spaced knots, and the distribution that offsets are drawn from.
#[derive(Debug, Clone)]
struct Profile {
    density: PiecewiseLinearDensity,
    values: Vec<f32>,
}

/// Number of knots of a tabulated profile.
const KNOTS: u32 = 128;

impl Filter {
    /// Makes a filter that is constant within `radius` pixels along each axis.
    pub fn boxed(radius: f64) -> Self {
        Self { radius: radius as f32, profile: None }
    }

    /// Makes a Gaussian with standard deviation `radius` / 3, lowered so that it is 0 at `radius`, and cut there.
    pub fn gaussian(radius: f64) -> Self {
        Self::tabulated(radius, |x| math::exp(-4.5 * x * x) - math::exp(-4.5))
    }

    /// Makes the four-term Blackman–Harris window \[Harris1978\], stretched to `radius`.
    pub fn blackman_harris(radius: f64) -> Self {
        Self::tabulated(radius, |x| {
            let cos = |k: f64| math::cos(k * PI * (x + 1.0));
            (0.35875 - 0.48829 * cos(1.0) + 0.14128 * cos(2.0) - 0.01168 * cos(3.0)).max(0.0)
        })
    }

    /// Tabulates a profile that is given over [−1, 1].
    fn tabulated(radius: f64, profile: impl Fn(f64) -> f64) -> Self {
        let unit = |i: u32| 2.0 * f64::from(i) / f64::from(KNOTS) - 1.0;
        let x: Vec<f64> = (0..=KNOTS).map(|i| radius * unit(i)).collect();
        let y: Vec<f64> = (0..=KNOTS).map(|i| profile(unit(i))).collect();
        let density = PiecewiseLinearDensity::new(&x, &y);
        let total = y.iter().sum::<f64>() - 0.5 * (y[0] + y[KNOTS as usize]);
        let to_density = f64::from(KNOTS) / (2.0 * radius * total);
        let values = y.iter().map(|y| (y * to_density) as f32).collect();
        Self { radius: radius as f32, profile: Some(Profile { density, values }) }
    }

    /// Returns the radius in pixels.
    pub fn radius(&self) -> f32 {
        self.radius
    }

    /// Returns how many pixels the filter reaches beyond a pixel's own square.
    pub fn reach(&self) -> u32 {
        (self.radius - 0.5).ceil().max(0.0) as u32
    }

    /// Returns the sum of the squares of the correlations of a pixel's noise with that of all pixels, where samples are spread
    /// evenly and count in all pixels that they reach. It is 1 for a filter that reaches its own pixel only.
    pub(crate) fn correlation(&self) -> f64 {
        let steps = 64 * KNOTS;
        let offset = |i: u32| self.radius * (2.0 * (f64::from(i) + 0.5) / f64::from(steps) - 1.0) as f32;
        let weight = |offset: f32| if offset.abs() <= self.radius { f64::from(self.weight(offset)) } else { 0.0 };
        let overlap =
            |shift: u32| -> f64 { (0..steps).map(offset).map(|x| weight(x) * weight(x + shift as f32)).sum() };
        let shifted: f64 = (1..=2 * self.reach()).map(overlap).map(|o| o * o).sum();
        let along_an_axis = 1.0 + 2.0 * shifted / (overlap(0) * overlap(0));
        along_an_axis * along_an_axis
    }

    /// Draws an offset from the pixel's centre, in pixels, with the filter as its density.
    pub fn sample(&self, u: [f32; 2]) -> [f32; 2] {
        u.map(|u| match &self.profile {
            None => (2.0 * u - 1.0) * self.radius,
            Some(profile) => profile.density.sample(u).0,
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
            // A box belongs to exactly one pixel, also on the line between two.
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

    /// Evaluates the filter along one axis, at an offset up to its radius.
    #[inline]
    pub(super) fn weight(&self, offset: f32) -> f32 {
        match &self.profile {
            None => 0.5 / self.radius,
            Some(Profile { values, .. }) => {
                let at = (offset + self.radius) * (KNOTS as f32 / (2.0 * self.radius));
                let knot = (at.max(0.0) as usize).min(KNOTS as usize - 1);
                let (a, b) = (values[knot], values[knot + 1]);
                (a + (b - a) * (at - knot as f32)).max(0.0)
            }
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

    /// Twice as many samples in all but name: a box of twice the pixel's edge shares half of its samples with each neighbour, a
    /// quarter with each across a corner.
    #[test]
    fn correlations() {
        assert_eq!((Filter::boxed(0.5).correlation(), Filter::boxed(0.5).reach()), (1.0, 0));
        let wide = Filter::boxed(1.0);
        assert!((wide.correlation() - 1.5 * 1.5).abs() < 1e-3 && wide.reach() == 1, "{}", wide.correlation());
        let window = Filter::blackman_harris(1.5);
        assert!((1.1..2.0).contains(&window.correlation()) && window.reach() == 1, "{}", window.correlation());
    }

    #[test]
    fn splats_stay_on_the_film() {
        let filter = Filter::gaussian(1.5);
        for at in [[-1.2, 3.0], [0.0, 0.0], [15.99, 15.99], [40.0, 2.0], [-1e9, 1e9]] {
            filter.splat(at, 16, 16, |x, y, w| assert!(x < 16 && y < 16 && w >= 0.0));
        }
    }
}
