//! How the work is split between techniques: with variances V and costs c of their parts of the picture, the error for a given
//! cost is least with numbers in proportion to √(V / c).

use crate::film::Film;

/// Variance of a pixel relative to its brightness squared beyond which it counts as this: the error of a pixel that has
/// hardly been hit says little.
const LARGEST: f64 = 1.0;
/// Most light paths for each camera path.
const MOST_LIGHT_PATHS: f64 = 16.0;
/// Most passes of merging for each sample of a pixel.
const MOST_MERGE_PASSES: f64 = 4.0;
/// Least share of the rays of camera paths that another technique takes, whatever it is found to be worth: what is found
/// rarely must be looked for all the same.
const LEAST_SHARE: f64 = 1.0 / 32.0;

/// A split of the work: light paths and passes of merging relative to camera paths.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Allocation {
    /// Light paths for each camera path.
    pub light: f64,
    /// Passes of merging for each sample of a pixel.
    pub merged: f64,
}

/// Rays that each technique has traced, and the splits of the segments so far.
#[derive(Debug, Clone, Copy, Default)]
pub struct Spent {
    /// Rays of camera paths.
    pub camera: u64,
    /// Rays of light paths.
    pub light: u64,
    /// Rays of merging.
    pub merged: u64,
    /// Samples of a pixel in closed segments.
    samples: f64,
    /// Sums over them of the split, and of the inverse number of light paths, which their variance goes with: in each
    /// segment light paths count as much as camera paths, however few they are.
    allocated: Allocation,
    inverse_light: f64,
}

impl Spent {
    /// Records that a segment of some samples a pixel has ended, with the split that it had.
    pub fn close_segment(&mut self, samples: u64, allocation: Allocation) {
        let samples = samples as f64;
        self.samples += samples;
        self.allocated.light += samples * allocation.light;
        self.allocated.merged += samples * allocation.merged;
        self.inverse_light += samples / allocation.light;
    }
}

impl Allocation {
    /// The split with which a render starts, when nothing is known.
    pub const START: Self = Self { light: 0.5, merged: 0.5 };

    /// Returns the best split by the noise on the film and the rays that it took, both measured with earlier splits.
    pub fn next(self, film: &Film, spent: &Spent) -> Self {
        let Some(variances) = film.relative_variances(LARGEST) else { return self };
        // Variance and cost are those of one path or pass, relative to those of a camera sample.
        let better = |before: f64, variance: f64, cost: f64, most: f64| {
            let least = (LEAST_SHARE / cost).min(most);
            let best = (variance / cost).sqrt();
            if best.is_nan() { before } else { best.clamp(least, most) }
        };
        let cost = |rays: u64, allocated: f64| spent.samples / allocated * rays as f64 / spent.camera as f64;
        let (of_light, of_merged) = (variances.light / variances.camera, variances.merged / variances.camera);
        let of_a_pass = of_merged * spent.allocated.merged / spent.samples;
        Self {
            light: better(
                self.light,
                of_light * spent.samples / spent.inverse_light,
                cost(spent.light, spent.allocated.light),
                MOST_LIGHT_PATHS,
            ),
            merged: better(self.merged, of_a_pass, cost(spent.merged, spent.allocated.merged), MOST_MERGE_PASSES),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Splats, tests::film_of};

    fn film(light: [f64; 2]) -> Film {
        let mut film = film_of(&[[[0.9; 3], [1.1; 3]]]);
        for (replicate, value) in light.into_iter().enumerate() {
            film.add_splats(replicate, 1, 1.0, &Splats::of(&[(0, [value; 3])]));
        }
        film
    }

    fn spent(light: u64, segments: &[(u64, f64)]) -> Spent {
        let mut spent = Spent { camera: 100, light, ..Spent::default() };
        for &(samples, light) in segments {
            spent.close_segment(samples, Allocation { light, merged: 0.5 });
        }
        spent
    }

    /// Equal variances and costs keep the split; four times the variance doubles the number.
    #[test]
    fn follows_variance_and_cost() {
        for ratio in [1.0, 0.25] {
            let spent = spent(100, &[(4, ratio)]);
            let before = Allocation { light: ratio, merged: 0.5 };
            for (light, factor) in [([0.9, 1.1], 1.0), ([0.8, 1.2], 2.0)] {
                let next = before.next(&film(light), &spent);
                assert!((next.light - factor * ratio).abs() < 1e-9, "{next:?}");
                assert_eq!(next.merged, 0.5, "nothing is known of it");
            }
        }
    }

    /// Segments of 1 and of 1/4 light path for each of as many camera paths have the variance of 2/5 path: (1 + 4) / 2 times
    /// that of 1.
    #[test]
    fn earlier_splits_count() {
        let next = Allocation { light: 0.25, merged: 0.5 }.next(&film([0.9, 1.1]), &spent(100, &[(4, 1.0), (4, 0.25)]));
        let (variance, cost) = (0.4, 1.0 / 0.625);
        assert!((next.light - f64::sqrt(variance / cost)).abs() < 1e-9, "{next:?}");
    }

    /// What brings no noise takes a small share of the rays; what brings it all has a bound.
    #[test]
    fn bounds() {
        let before = Allocation { light: 0.5, merged: 0.5 };
        let next = before.next(&film([1.0, 1.0]), &spent(200, &[(4, 0.5)]));
        assert!((next.light * 4.0 - LEAST_SHARE).abs() < 1e-9, "{next:?}");
        assert_eq!(before.next(&film([-99.0, 101.0]), &spent(1, &[(4, 0.5)])).light, MOST_LIGHT_PATHS);
    }
}
