//! When to stop: the claim that the error of the picture at hand is below a bound, true in 95 renders of 100.

use crate::film::{ErrorParts, PartError};
use crate::metrics::stats::student_t_quantile;

/// Share of renders whose error may exceed the bound that they claim.
const LEVEL: f64 = 0.05;
/// Looks at the error that get equal shares of the level; later ones share what one of them gets.
const LOOKS: u64 = 32;
/// The next look comes when the target is reached by the falling of the bound with 1 / samples, with so much to spare.
const MARGIN: f64 = 1.05;
/// The least share of samples to add before looking again.
const LEAST_STEP: f64 = 0.125;

/// Level of the `look`-th look, from 1: their sum is [`LEVEL`], so that looking often does not make chance pass for success.
fn level_of(look: u64) -> f64 {
    let look = look.max(1);
    if look < LOOKS { LEVEL / LOOKS as f64 } else { LEVEL * LOOKS as f64 / (LOOKS * look * (look + 1)) as f64 }
}

/// The upper bound of the relMSE of a picture with known errors of its parts, in a render that has looked `look` times, or
/// once and for all.
pub fn error_bound(parts: &ErrorParts, look: Option<u64>) -> f64 {
    let level = look.map_or(LEVEL, level_of);
    // Parts are independent: their deviations add up in squares, each widened by how little is known of it.
    let widened = |part: &PartError| {
        let t = if part.deviation > 0.0 { student_t_quantile(1.0 - level, part.freedom) } else { 0.0 };
        (t * part.deviation) * (t * part.deviation)
    };
    let parts = parts.all();
    parts.iter().map(|part| part.mean).sum::<f64>() + parts.iter().map(widened).sum::<f64>().sqrt()
}

/// Where to look next, after `samples` with a bound that is too high by some factor: at the latest at `latest`.
pub fn next_look(samples: u64, excess: f64, latest: u64) -> u64 {
    let step = (samples as f64 * (excess * MARGIN - 1.0).max(LEAST_STEP)).min((latest - samples) as f64);
    // Two replicates get samples in turns.
    (samples + (step.ceil() as u64).next_multiple_of(2)).min(latest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_sum_to_one_in_twenty() {
        let sum: f64 = (1..1_000_000).map(level_of).sum();
        assert!((sum - LEVEL).abs() < 1e-6, "{sum}");
    }

    #[test]
    fn bounds() {
        let known = PartError { mean: 0.01, deviation: 0.0, freedom: 1.0 };
        let none = PartError::default();
        let exact = ErrorParts { camera: known, light: known, merged: none, blur: none };
        assert_eq!(error_bound(&exact, None), 0.02);
        // The 95 % quantile of t with 7 degrees of freedom is 1.8946.
        let light = PartError { mean: 0.01, deviation: 0.001, freedom: 7.0 };
        let parts = ErrorParts { light, ..exact };
        assert!((error_bound(&parts, None) - 0.02 - 0.0018946).abs() < 1e-6);
        assert!(error_bound(&parts, Some(3)) > error_bound(&parts, None));
    }

    #[test]
    fn looks() {
        assert_eq!(next_look(64, 3.0, 128), 128);
        assert_eq!(next_look(64, 1.5, 128), 102);
        assert_eq!(next_look(64, 1.0, 128), 72);
        assert_eq!(next_look(1 << 62, f64::INFINITY, 1 << 63), 1 << 63);
    }
}
