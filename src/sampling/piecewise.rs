//! One-dimensional densities that are linear between knots.

/// A probability density, linear between knots, drawn by inverting its distribution function exactly.
#[derive(Debug, Clone)]
pub struct PiecewiseLinearDensity {
    /// Knots, ascending.
    x: Vec<f32>,
    /// Density at the knots.
    density: Vec<f32>,
    /// Distribution function at the knots, from 0 to 1.
    cdf: Vec<f32>,
    /// `guide[i]` is the last segment that starts at or before i / guide.len().
    guide: Vec<u32>,
}

impl PiecewiseLinearDensity {
    /// From strictly ascending knots and weights ≥ 0 with a positive integral.
    pub fn new(x: &[f64], weights: &[f64]) -> Self {
        assert!(x.len() == weights.len() && x.len() > 1, "a density needs two knots");
        let areas = x.windows(2).zip(weights.windows(2)).map(|(x, w)| (x[1] - x[0]) * (w[0] + w[1]) * 0.5);
        let total: f64 = areas.clone().sum();
        assert!(total > 0.0 && total.is_finite(), "a density needs a positive integral");
        let mut sum = 0.0;
        let inner = areas.map(|area| {
            sum += area;
            ((sum / total) as f32).min(1.0)
        });
        let mut cdf: Vec<f32> = std::iter::once(0.0).chain(inner).collect();
        *cdf.last_mut().expect("two knots") = 1.0;
        let segments = x.len() - 1;
        let guide = (0..2 * segments)
            .map(|i| (cdf.partition_point(|&c| c <= i as f32 / (2 * segments) as f32) - 1).min(segments - 1) as u32)
            .collect();
        Self {
            x: x.iter().map(|&x| x as f32).collect(),
            density: weights.iter().map(|w| (w / total) as f32).collect(),
            cdf,
            guide,
        }
    }

    /// The point where the distribution function is `u` in [0, 1), and the density there.
    pub fn sample(&self, u: f32) -> (f32, f32) {
        let last = self.x.len() - 2;
        let mut k = self.guide[((u * self.guide.len() as f32) as usize).min(self.guide.len() - 1)] as usize;
        while k < last && self.cdf[k + 1] <= u {
            k += 1;
        }
        let (a, b, h) = (self.density[k], self.density[k + 1], self.x[k + 1] - self.x[k]);
        let rest = (u - self.cdf[k]).max(0.0);
        // a t + (b − a) t² / 2h = rest, solved without cancellation.
        let root = (a * a + 2.0 * rest * (b - a) / h).max(0.0).sqrt();
        let t = if a + root > 0.0 { (2.0 * rest / (a + root)).min(h) } else { 0.0 };
        (self.x[k] + t, a + (b - a) * (t / h))
    }

    /// The density at `x`; 0 outside the knots.
    pub fn density(&self, x: f32) -> f32 {
        let k = self.x.partition_point(|&knot| knot <= x);
        if k == 0 || (k == self.x.len() && x > self.x[k - 1]) {
            return 0.0;
        }
        let k = k.min(self.x.len() - 1);
        let t = (x - self.x[k - 1]) / (self.x[k] - self.x[k - 1]);
        self.density[k - 1] + (self.density[k] - self.density[k - 1]) * t
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sampling_inverts_the_distribution_function() {
        let x = [0.0, 1.0, 1.5, 4.0, 4.25];
        let w = [0.0, 2.0, 0.0, 1.0, 8.0];
        let density = PiecewiseLinearDensity::new(&x, &w);
        let n = 1 << 16;
        // E[1/p] over the support is its length; the mean is a closed form.
        let (mut mean, mut inverse) = (0.0, 0.0);
        for i in 0..n {
            let (x, p) = density.sample((i as f32 + 0.5) / n as f32);
            assert!((p - density.density(x)).abs() <= 1e-4 * p.max(0.01), "{x} {p} {}", density.density(x));
            mean += f64::from(x) / f64::from(n);
            inverse += 1.0 / f64::from(p) / f64::from(n);
        }
        let total: f64 = x.windows(2).zip(w.windows(2)).map(|(x, w)| (x[1] - x[0]) * (w[0] + w[1]) / 2.0).sum();
        let moment: f64 = x
            .windows(2)
            .zip(w.windows(2))
            .map(|(x, w)| (x[1] - x[0]) * (w[0] * (2.0 * x[0] + x[1]) + w[1] * (x[0] + 2.0 * x[1])) / 6.0)
            .sum();
        assert!((mean - moment / total).abs() < 1e-4, "{mean} {}", moment / total);
        assert!((inverse - 4.25).abs() < 2e-2, "{inverse}");
    }
}
