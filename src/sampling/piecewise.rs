//! One-dimensional densities that are linear between knots.

/// A probability density, linear between knots, drawn by inverting its distribution function exactly.
#[derive(Debug, Clone)]
pub struct PiecewiseLinearDensity {
    segments: Vec<Segment>,
    /// `guide[i]` is the last segment that starts at or before i / guide.len().
    guide: Vec<u32>,
}

/// The density between two knots.
#[derive(Debug, Clone, Copy)]
struct Segment {
    start: f32,
    width: f32,
    /// Density at the start, and its slope.
    density: f32,
    slope: f32,
    /// Distribution function at the start.
    cdf: f32,
}

impl PiecewiseLinearDensity {
    /// Makes a density of strictly ascending knots and weights ≥ 0 with a positive integral.
    pub fn new(x: &[f64], weights: &[f64]) -> Self {
        assert!(x.len() == weights.len() && x.len() > 1, "a density needs two knots");
        let pieces = || x.windows(2).zip(weights.windows(2));
        let total: f64 = pieces().map(|(x, w)| (x[1] - x[0]) * (w[0] + w[1]) * 0.5).sum();
        assert!(total > 0.0 && total.is_finite(), "a density needs a positive integral");
        let mut sum = 0.0;
        let segments: Vec<Segment> = pieces()
            .map(|(x, w)| {
                let (width, cdf) = (x[1] - x[0], (sum / total).min(1.0) as f32);
                sum += width * (w[0] + w[1]) * 0.5;
                let slope = ((w[1] - w[0]) / (total * width)) as f32;
                Segment { start: x[0] as f32, width: width as f32, density: (w[0] / total) as f32, slope, cdf }
            })
            .collect();
        // So many that most lie in one segment: the search beyond a cell's first is a jump that cannot be foreseen.
        let cells = 8 * segments.len();
        let guide =
            (0..cells).map(|i| segments.partition_point(|s| s.cdf <= i as f32 / cells as f32) as u32 - 1).collect();
        Self { segments, guide }
    }

    /// The point where the distribution function is `u` in [0, 1), and the density there.
    pub fn sample(&self, u: f32) -> (f32, f32) {
        let ([x], [density]) = self.sample_many([u]);
        (x, density)
    }

    /// [`Self::sample`] for several numbers at once: points, and densities there.
    pub fn sample_many<const N: usize>(&self, u: [f32; N]) -> ([f32; N], [f32; N]) {
        let found = u.map(|u| {
            let mut k = self.guide[((u * self.guide.len() as f32) as usize).min(self.guide.len() - 1)] as usize;
            while self.segments.get(k + 1).is_some_and(|next| next.cdf <= u) {
                k += 1;
            }
            self.segments[k]
        });
        // density t + slope t² / 2 = rest, solved without cancellation; one loop a step, for SIMD.
        let mut t = [0.0f32; N];
        let mut density = [0.0f32; N];
        for lane in 0..N {
            let Segment { density: a, slope, cdf, width, .. } = found[lane];
            let rest = (u[lane] - cdf).max(0.0);
            let root = (a * a + 2.0 * rest * slope).max(0.0).sqrt();
            t[lane] = (2.0 * rest / (a + root).max(f32::MIN_POSITIVE)).min(width);
            density[lane] = (a + slope * t[lane]).max(0.0);
        }
        (std::array::from_fn(|lane| found[lane].start + t[lane]), density)
    }

    /// The density at `x`; 0 outside the knots.
    pub fn density(&self, x: f32) -> f32 {
        let k = self.segments.partition_point(|s| s.start <= x);
        let Some(segment) = k.checked_sub(1).map(|k| self.segments[k]) else { return 0.0 };
        let t = x - segment.start;
        if t > segment.width { 0.0 } else { (segment.density + segment.slope * t).max(0.0) }
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
