//! Small systems of linear equations.

/// Solves T x = r with T of the given diagonal and −1 beside it, for four right-hand sides; `None` if T is singular.
pub(super) fn solve_tridiagonal(mut diagonal: Vec<f64>, mut right: Vec<[f64; 4]>) -> Option<Vec<[f64; 4]>> {
    // The diagonal becomes the reciprocals of the pivots.
    for j in 0..diagonal.len() {
        if j > 0 {
            let factor = diagonal[j - 1];
            diagonal[j] -= factor;
            right[j] = std::array::from_fn(|k| right[j][k] + factor * right[j - 1][k]);
        }
        diagonal[j] = 1.0 / diagonal[j];
    }
    for j in (0..diagonal.len()).rev() {
        let after = right.get(j + 1).copied().unwrap_or_default();
        right[j] = std::array::from_fn(|k| (right[j][k] + after[k]) * diagonal[j]);
    }
    right.iter().flatten().all(|x| x.is_finite()).then_some(right)
}

/// Solves N equations, each a row of N coefficients and the right-hand side, with column pivoting.
pub(super) fn solve_dense<const N: usize, const M: usize>(mut rows: [[f64; M]; N]) -> Option<[f64; N]> {
    for column in 0..N {
        let pivot = (column..N).max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs()))?;
        rows.swap(column, pivot);
        let pivot_row = rows[column];
        for row in &mut rows[column + 1..] {
            let factor = row[column] / pivot_row[column];
            for (entry, above) in row.iter_mut().zip(pivot_row) {
                *entry -= factor * above;
            }
        }
    }
    let mut x = [0.0; N];
    for i in (0..N).rev() {
        let known: f64 = (i + 1..N).map(|k| rows[i][k] * x[k]).sum();
        x[i] = (rows[i][N] - known) / rows[i][i];
    }
    x.iter().all(|x| x.is_finite()).then_some(x)
}

/// A factor of a symmetric positive definite matrix: its lower triangle, row by row.
pub(super) struct Cholesky {
    rows: Vec<Vec<f64>>,
}

/// Smallest pivot relative to its row's diagonal entry: below it a row counts as dependent on those before.
const SMALLEST_PIVOT: f64 = 1e-10;

impl Cholesky {
    /// Factors the matrix of a size and of entries by row and column, of which those right of the diagonal are not asked for.
    /// The error is the first row that depends on those before it.
    pub(super) fn new(size: usize, entry: impl Fn(usize, usize) -> f64) -> Result<Self, usize> {
        let mut rows: Vec<Vec<f64>> = Vec::with_capacity(size);
        for i in 0..size {
            let mut row = Vec::with_capacity(i + 1);
            for j in 0..i {
                let above: &Vec<f64> = &rows[j];
                row.push((entry(i, j) - dot(&row, &above[..j])) / above[j]);
            }
            let diagonal = entry(i, i);
            let pivot = diagonal - dot(&row, &row);
            // NaN fails as well.
            if pivot.is_nan() || pivot <= SMALLEST_PIVOT * diagonal {
                return Err(i);
            }
            row.push(pivot.sqrt());
            rows.push(row);
        }
        Ok(Self { rows })
    }

    /// Replaces a right-hand side by the solution.
    pub(super) fn solve(&self, x: &mut [f64]) {
        for (i, row) in self.rows.iter().enumerate() {
            x[i] = (x[i] - dot(&x[..i], &row[..i])) / row[i];
        }
        for (i, row) in self.rows.iter().enumerate().rev() {
            x[i] /= row[i];
            let (before, known) = x.split_at_mut(i);
            before.iter_mut().zip(row).for_each(|(x, entry)| *x -= entry * known[0]);
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn small_systems() {
        let x = solve_dense([[0.0, 2.0, 4.0], [3.0, 1.0, 5.0]]).unwrap();
        assert_eq!(x, [1.0, 2.0]);
        assert_eq!(solve_dense([[1.0, 2.0, 1.0], [2.0, 4.0, 1.0]]), None);
        let x = solve_tridiagonal(vec![2.0, 2.0, 2.0], vec![[1.0; 4], [0.0; 4], [1.0; 4]]).unwrap();
        for row in x {
            assert_relative_eq!(row[0], 1.0, max_relative = 1e-15);
        }
        assert_eq!(solve_tridiagonal(vec![1.0, 1.0], vec![[1.0; 4]; 2]), None);
    }

    #[test]
    fn symmetric_systems() {
        let matrix = [[4.0, 2.0, 0.5], [2.0, 5.0, -1.0], [0.5, -1.0, 3.0]];
        let mut x = [1.0, -2.0, 0.25];
        Cholesky::new(3, |i, j| matrix[i][j]).unwrap_or_else(|i| panic!("row {i}")).solve(&mut x);
        for (row, right) in matrix.iter().zip([1.0, -2.0, 0.25]) {
            assert_relative_eq!(dot(row, &x), right, max_relative = 1e-14);
        }
        assert_eq!(Cholesky::new(3, |i, j| if i == j { 1.0 } else { f64::from(i + j == 3) }).err(), Some(2));
        assert!(Cholesky::new(0, |_, _| 1.0).is_ok());
    }
}
