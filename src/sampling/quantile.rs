//! One-dimensional densities that give equal probability to each of many pieces.

/// Pieces of equal probability.
const PIECES: usize = 1024;

/// A probability density, constant on each of 1024 pieces of equal probability: as close to a given one as its quantiles
/// are to each other, and drawn by one look-up and one interpolation.
#[derive(Debug, Clone)]
pub struct QuantileDensity {
    /// Start of each piece, and the density there; then the end of the last, with density 0.
    pieces: Vec<[f32; 2]>,
}

impl QuantileDensity {
    /// The quantiles of the density that is linear between strictly ascending knots, with weights ≥ 0 that have a positive
    /// integral.
    pub fn new(x: &[f64], weights: &[f64]) -> Self {
        assert!(x.len() == weights.len() && x.len() > 1, "a density needs two knots");
        let pieces = || x.windows(2).zip(weights.windows(2));
        let total: f64 = pieces().map(|(x, w)| (x[1] - x[0]) * (w[0] + w[1]) * 0.5).sum();
        assert!(total > 0.0 && total.is_finite(), "a density needs a positive integral");
        let mut quantiles = vec![x[0]];
        let mut below = 0.0;
        for (x, w) in pieces() {
            let mass = (x[1] - x[0]) * (w[0] + w[1]) * 0.5 / total;
            while quantiles.len() < PIECES && below + mass > quantiles.len() as f64 / PIECES as f64 {
                // w₀ t + slope t² / 2 = rest, solved without cancellation.
                let rest = (quantiles.len() as f64 / PIECES as f64 - below) * total;
                let slope = (w[1] - w[0]) / (x[1] - x[0]);
                let root = (w[0] * w[0] + 2.0 * rest * slope).max(0.0).sqrt();
                quantiles.push((x[0] + 2.0 * rest / (w[0] + root)).min(x[1]));
            }
            below += mass;
        }
        quantiles.resize(PIECES + 1, x[x.len() - 1]);
        // The density comes from the widths in f64: a spectral line can be narrower than an f32 tells apart.
        let density =
            |q: &[f64]| (1.0 / (PIECES as f64 * (q[1] - q[0]).max(f64::MIN_POSITIVE))).min(f64::from(f32::MAX));
        let mut pieces: Vec<[f32; 2]> = quantiles.windows(2).map(|q| [q[0] as f32, density(q) as f32]).collect();
        pieces.push([quantiles[PIECES] as f32, 0.0]);
        Self { pieces }
    }

    /// The points where the distribution function is `u`, each in [0, 1), and the densities there.
    #[inline]
    pub fn sample_many<const N: usize>(&self, u: [f32; N]) -> ([f32; N], [f32; N]) {
        let (mut x, mut density) = ([0.0; N], [0.0; N]);
        for lane in 0..N {
            let scaled = u[lane] * PIECES as f32;
            let k = (scaled as usize).min(PIECES - 1);
            let [start, here] = self.pieces[k];
            let width = self.pieces[k + 1][0] - start;
            (x[lane], density[lane]) = (start + width * (scaled - k as f32), here);
        }
        (x, density)
    }

    /// The density at `x`; 0 outside.
    pub fn density(&self, x: f32) -> f32 {
        self.pieces.partition_point(|[start, _]| *start <= x).checked_sub(1).map_or(0.0, |k| self.pieces[k][1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against a closed form: means of x and of 1/p (the length of the support) under the density.
    #[test]
    fn sampling_follows_the_density() {
        let (x, w) = ([0.0, 1.0, 1.5, 4.0, 4.25], [0.0, 2.0, 0.0, 1.0, 8.0]);
        let density = QuantileDensity::new(&x, &w);
        let n = 1 << 16;
        let (mut mean, mut inverse) = (0.0, 0.0);
        for i in 0..n {
            let ([x], [p]) = density.sample_many([(i as f32 + 0.5) / n as f32]);
            assert_eq!(p, density.density(x), "{x}");
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
        assert!((inverse - 4.25).abs() < 1e-4, "{inverse}");
        assert_eq!((density.density(-0.1), density.density(4.3)), (0.0, 0.0));
    }

    /// A line narrower than the spacing of f32 keeps its share and its density.
    #[test]
    fn lines_narrower_than_rounding() {
        let (x, w) = ([400.0, 555.0, 555.0 + 1e-7, 555.0 + 2e-7, 700.0], [1e-3, 1e-3, 1e7, 1e-3, 1e-3]);
        let density = QuantileDensity::new(&x, &w);
        let n = 4096;
        let draws = (0..n).map(|i| density.sample_many([(i as f32 + 0.5) / n as f32]));
        let in_line: Vec<f32> = draws.filter(|([x], _)| (x - 555.0).abs() < 1e-3).map(|(_, [p])| p).collect();
        let share = in_line.len() as f64 / f64::from(n);
        assert!((share - 1.0 / 1.3).abs() < 2e-3, "{share}");
        assert!(in_line.iter().filter(|p| **p > 1e5).count() > n as usize / 2);
    }
}
