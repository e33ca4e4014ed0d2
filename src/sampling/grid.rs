//! A piecewise constant density on the unit square.

/// A density on a grid of equal cells, drawn from by inversion: rows first, then within the row, so that stratified numbers
/// stay stratified.
#[derive(Debug, Clone, PartialEq)]
pub struct GridDensity {
    side: usize,
    /// Cumulative probability of the rows, from 0 to 1.
    rows: Vec<f32>,
    /// Cumulative probability of the cells within each row: `side` + 1 numbers a row.
    cells: Vec<f32>,
}

impl GridDensity {
    /// Makes a density of the weights of `side`² cells, row by row; not negative, and not all 0 in any row.
    pub fn new(side: usize, weights: &[f64]) -> Self {
        let row_sums: Vec<f64> = weights.chunks(side).map(|row| row.iter().sum()).collect();
        let cells = weights.chunks(side).flat_map(cumulative).collect();
        Self { side, rows: cumulative(&row_sums), cells }
    }

    /// Draws a point with two random numbers.
    pub fn sample(&self, [u, v]: [f32; 2]) -> [f32; 2] {
        let (row, y) = invert(&self.rows, u);
        let (column, x) = invert(self.row(row), v);
        [(row as f32 + y) / self.side as f32, (column as f32 + x) / self.side as f32].map(|c| c.min(ONE_MINUS_EPSILON))
    }

    /// Density at a point.
    pub fn density(&self, point: [f32; 2]) -> f32 {
        let [row, column] = point.map(|c| ((c * self.side as f32) as usize).min(self.side - 1));
        let cells = self.row(row);
        let share = (self.rows[row + 1] - self.rows[row]) * (cells[column + 1] - cells[column]);
        share * (self.side * self.side) as f32
    }

    fn row(&self, row: usize) -> &[f32] {
        &self.cells[row * (self.side + 1)..(row + 1) * (self.side + 1)]
    }
}

/// The largest f32 below 1.
const ONE_MINUS_EPSILON: f32 = 1.0 - 0.5 * f32::EPSILON;

/// Adds up weights into sums from 0 to exactly 1.
fn cumulative(weights: &[f64]) -> Vec<f32> {
    let total: f64 = weights.iter().sum();
    let mut sum = 0.0;
    let mut sums = vec![0.0];
    for weight in weights {
        sum += weight;
        sums.push((sum / total) as f32);
    }
    sums[weights.len()] = 1.0;
    sums
}

/// The piece of cumulative probabilities that a number falls into, and how far along it is.
fn invert(cumulative: &[f32], u: f32) -> (usize, f32) {
    let piece = cumulative.partition_point(|&c| c <= u).clamp(1, cumulative.len() - 1) - 1;
    let (from, to) = (cumulative[piece], cumulative[piece + 1]);
    (piece, if to > from { ((u - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::Sobol;

    /// Cells are drawn as often as their density says, and the density integrates to 1.
    #[test]
    fn samples_follow_the_density() {
        let side = 8;
        let weights: Vec<f64> = (0..side * side).map(|i| if i % 5 == 0 { 4.0 } else { 0.1 * (i % 3) as f64 }).collect();
        let grid = GridDensity::new(side, &weights);
        let (n, sobol) = (1 << 14, Sobol::new(1));
        let mut counts = vec![0u32; side * side];
        let mut inverse = 0.0;
        for i in 0..n {
            let u = sobol.group(i, 0);
            let point = grid.sample([u[0], u[1]]);
            let [row, column] = point.map(|c| (c * side as f32) as usize);
            counts[row * side + column] += 1;
            inverse += 1.0 / f64::from(grid.density(point));
        }
        let total: f64 = weights.iter().sum();
        for (count, weight) in counts.into_iter().zip(&weights) {
            let expected = weight / total * n as f64;
            assert!((f64::from(count) - expected).abs() <= 4.0 + 0.02 * expected, "{count} {expected}");
        }
        // ∫ 1 over the support, which is all cells of positive weight.
        let support = weights.iter().filter(|&&w| w > 0.0).count() as f64 / (side * side) as f64;
        assert!((inverse / n as f64 / support - 1.0).abs() < 2e-2, "{inverse}");
    }

    #[test]
    fn ends_stay_inside() {
        let grid = GridDensity::new(2, &[1.0, 0.0, 0.0, 3.0]);
        for u in [0.0, 0.25, ONE_MINUS_EPSILON] {
            for v in [0.0, ONE_MINUS_EPSILON] {
                let point = grid.sample([u, v]);
                assert!(point.iter().all(|&c| (0.0..1.0).contains(&c)), "{point:?}");
                assert!(grid.density(point) > 0.0, "{point:?}");
            }
        }
    }
}
