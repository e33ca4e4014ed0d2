//! Discrete distributions drawn in constant time.

/// What an [`AliasTable`] drew.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Draw {
    /// Index that was drawn.
    pub index: usize,
    /// Probability of that index.
    pub probability: f32,
    /// Rest of the random number, uniform in [0, 1) and independent of the index.
    pub rest: f32,
}

/// Draws an index in proportion to weights \[Vose1991\].
#[derive(Debug, Clone, Default)]
pub struct AliasTable {
    /// For each column the share that belongs to its own index, and the index of the rest.
    columns: Vec<(f32, u32)>,
    probabilities: Vec<f32>,
}

impl AliasTable {
    /// Makes a table of weights ≥ 0. With no positive weight nothing can be drawn.
    pub fn new(weights: &[f64]) -> Self {
        let total: f64 = weights.iter().sum();
        if !(total > 0.0 && total.is_finite()) {
            return Self::default();
        }
        let n = weights.len();
        let mut share: Vec<f64> = weights.iter().map(|w| w / total * n as f64).collect();
        let mut columns = vec![(1.0, 0); n];
        let (mut small, mut large): (Vec<usize>, Vec<usize>) = (0..n).partition(|&i| share[i] < 1.0);
        while let (Some(&s), Some(&l)) = (small.last(), large.last()) {
            small.pop();
            columns[s] = (share[s] as f32, l as u32);
            share[l] -= 1.0 - share[s];
            if share[l] < 1.0 {
                large.pop();
                small.push(l);
            }
        }
        // What rounding left over keeps its whole column.
        for i in small.into_iter().chain(large) {
            columns[i] = (1.0, i as u32);
        }
        Self { columns, probabilities: weights.iter().map(|w| (w / total) as f32).collect() }
    }

    /// Whether nothing can be drawn.
    pub fn is_empty(&self) -> bool {
        self.columns.is_empty()
    }

    /// Draws with `u` in [0, 1); `None` if nothing can be drawn.
    pub fn sample(&self, u: f32) -> Option<Draw> {
        let n = self.columns.len();
        if n == 0 {
            return None;
        }
        let scaled = u * n as f32;
        let column = (scaled as usize).min(n - 1);
        let (own, alias) = self.columns[column];
        let x = scaled - column as f32;
        let (index, rest) = if x < own { (column, x / own) } else { (alias as usize, (x - own) / (1.0 - own)) };
        Some(Draw { index, probability: self.probabilities[index], rest: rest.min(1.0 - f32::EPSILON * 0.5) })
    }

    /// The probability of an index; 0 beyond the table.
    pub fn probability(&self, index: usize) -> f32 {
        self.probabilities.get(index).copied().unwrap_or(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frequencies_follow_the_weights() {
        let weights = [0.0, 3.0, 1.0, 0.5, 5.5, 0.0];
        let table = AliasTable::new(&weights);
        let n = 1 << 16;
        let (mut counts, mut rest) = ([0u32; 6], [0.0; 6]);
        for i in 0..n {
            let draw = table.sample((i as f32 + 0.5) / n as f32).unwrap();
            assert_eq!(draw.probability, table.probability(draw.index));
            assert!((0.0..1.0).contains(&draw.rest));
            rest[draw.index] += f64::from(draw.rest);
            counts[draw.index] += 1;
        }
        for ((count, weight), rest) in counts.iter().zip(weights).zip(rest) {
            assert!(weight == 0.0 || (rest / f64::from(*count) - 0.5).abs() < 1e-2);
            assert!((f64::from(*count) / f64::from(n) - weight / 10.0).abs() < 1e-3);
        }
    }

    #[test]
    fn nothing_to_draw() {
        assert!(AliasTable::new(&[]).sample(0.5).is_none());
        assert!(AliasTable::new(&[0.0, 0.0]).sample(0.5).is_none());
    }
}
