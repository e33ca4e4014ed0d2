//! Roots of monotone functions.

/// The root of an increasing function between `low` (where it is not positive) and `high` (where it is not negative).
///
/// `f` gives value and derivative. Newton's steps, and bisection wherever one would leave the bracket or gain less than
/// half; ends where the bracket or the step has no more digits.
pub(in crate::color) fn increasing_root(mut low: f64, mut high: f64, f: impl Fn(f64) -> (f64, f64)) -> f64 {
    let mut at = 0.5 * (low + high);
    let mut last_step = high - low;
    // Bisection alone needs less than 64 + 11 halvings for any bracket that does not span 0, Newton a handful.
    for _ in 0..200 {
        let (value, derivative) = f(at);
        match value {
            _ if value > 0.0 => high = at,
            _ if value < 0.0 => low = at,
            _ => return at,
        }
        let newton = at - value / derivative;
        let inside = low < newton && newton < high && (newton - at).abs() < 0.5 * last_step.abs();
        let next = if inside { newton } else { 0.5 * (low + high) };
        last_step = next - at;
        if next == at || next <= low || next >= high {
            return next;
        }
        at = next;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smooth_flat_and_steep() {
        let cube = increasing_root(-10.0, 10.0, |x| (x * x * x - 2.0, 3.0 * x * x));
        assert!((cube * cube * cube - 2.0).abs() < 1e-15);
        // Triple root: Newton gains a third a step.
        let flat = increasing_root(-1.0, 2.0, |x| ((x - 0.3) * (x - 0.3) * (x - 0.3), 3.0 * (x - 0.3) * (x - 0.3)));
        assert!((flat - 0.3).abs() < 1e-9, "{flat}");
        // Newton alone oscillates and diverges at the root of a cube root.
        let steep = increasing_root(-1.0, 3.0, |x: f64| {
            let root = crate::math::cbrt(x - 0.7);
            (root, 1.0 / (3.0 * root * root))
        });
        assert!((steep - 0.7).abs() < 1e-15, "{steep}");
        assert_eq!(increasing_root(0.0, 4.0, |x| (x - 4.0, 1.0)), 4.0);
    }
}
