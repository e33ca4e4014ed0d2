//! Weights for combining sampling techniques.

/// The balance heuristic \[Veach1997\]: weight of the technique with density `this` against one with density `other`, per
/// sample of each. Written so that huge densities do not overflow.
#[inline]
pub fn balance_heuristic(this: f32, other: f32) -> f32 {
    let (large, small) = if this >= other { (this, other) } else { (other, this) };
    let of_large = 1.0 / (1.0 + small / large);
    if this >= other { of_large } else { 1.0 - of_large }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_sum_to_one() {
        for (a, b) in [(1.0, 1.0), (1e30, 1e-30), (3.0, 0.0), (f32::MAX, f32::MAX), (0.2, 7.0)] {
            assert_eq!(balance_heuristic(a, b) + balance_heuristic(b, a), 1.0);
        }
        assert_eq!(balance_heuristic(3.0, 1.0), 0.75);
    }
}
