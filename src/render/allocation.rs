//! How the work is split between techniques: with variances V and costs c of their parts of the picture, the error for a given
//! cost is least with numbers in proportion to √(V / c). And within camera paths, see [`super::split`].

use super::schedule::Work;
use super::split::Behind;
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

/// Numbers relative to those of camera paths.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Allocation {
    /// Light paths for each camera path.
    pub light: f64,
    /// Passes of merging for each sample of a pixel.
    pub merged: f64,
    /// Paths that go on from the first matte surface of a camera path.
    pub splits: u8,
}

/// Rays traced by each technique, and what else the next split depends on.
#[derive(Debug, Clone, Copy, Default)]
pub struct Spent {
    /// For camera paths.
    pub camera: u64,
    /// For light paths.
    pub light: u64,
    /// For merging.
    pub merged: u64,
    /// Sum over samples of closed segments of the inverse number of light paths for each, which their variance goes with: in
    /// each segment light paths count as much as camera paths, however few they are.
    inverse_light: f64,
    /// The same of the variance and the cost of camera paths, relative to those of paths that are not split.
    camera_variance: f64,
    camera_cost: f64,
}

impl Spent {
    /// Ends a segment of some samples of a pixel.
    pub fn close_segment(&mut self, samples: u64, allocation: Allocation, behind: Behind) {
        let samples = samples as f64;
        self.inverse_light += samples / allocation.light;
        self.camera_variance += samples * behind.variance_of(allocation.splits);
        self.camera_cost += samples * behind.cost_of(allocation.splits);
    }
}

impl Allocation {
    /// Before anything is known.
    pub const START: Self = Self { light: 0.5, merged: 0.5, splits: 0 };

    /// The best split, after what has been measured with earlier ones: a film, the work that has made it, and the rays that
    /// this took; `behind` is what is known of splits.
    pub fn next(self, film: &Film, done: Work, spent: &Spent, behind: Behind) -> Self {
        let Some(variances) = film.relative_variances(LARGEST) else { return self };
        // Of one path or pass, in units of those of a sample.
        let better = |before: f64, [variance, cost]: [f64; 2], most: f64| {
            let least = (LEAST_SHARE / cost).min(most);
            let best = (variance / cost).sqrt();
            if best.is_nan() { before } else { best.clamp(least, most) }
        };
        let samples = done.samples as f64;
        let pixels = f64::from(film.width()) * f64::from(film.height());
        // Light paths for each camera path, and passes for each sample of a pixel, over all that was done.
        let (light, merged) = (done.light_paths as f64 / (pixels * samples), done.merging / samples);
        let cost = |rays: u64, number: f64| rays as f64 / (spent.camera as f64 * number);
        let of_a_light_path = variances.light / variances.camera * samples / spent.inverse_light;
        let of_a_pass = variances.merged / variances.camera * merged;
        let (of_light, of_merged) =
            ([of_a_light_path, cost(spent.light, light)], [of_a_pass, cost(spent.merged, merged)]);
        let light = better(self.light, of_light, MOST_LIGHT_PATHS);
        let merged = better(self.merged, of_merged, MOST_MERGE_PASSES);
        // Of both with that split, in units of those of a sample that is not split.
        let part = |[variance, cost]: [f64; 2], number: f64| {
            if cost > 0.0 {
                [variance / number * spent.camera_variance, cost * number * spent.camera_cost]
            } else {
                [0.0; 2]
            }
        };
        let (of_light, of_merged) = (part(of_light, light), part(of_merged, merged));
        let others = [0, 1].map(|i| (of_light[i] + of_merged[i]) / samples);
        Self { light, merged, splits: behind.best_splits(others).max(self.splits) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::Splat;

    fn film(light: [f64; 2]) -> Film {
        let mut film = Film::new(1, 1, 1.0);
        film.camera_mut()[0].add_sample(0, [0.9; 3]);
        film.camera_mut()[0].add_sample(1, [1.1; 3]);
        for (replicate, value) in light.into_iter().enumerate() {
            film.add_splats(replicate, 1, 1.0, &[Splat { pixel: 0, xyz: [value; 3] }]);
        }
        film
    }

    /// The split that follows segments of so many samples, each with so many light paths for each of them, if all light
    /// paths take `light` rays and all camera paths 100.
    fn next(values: [f64; 2], light: u64, segments: &[(u64, f64)]) -> Allocation {
        let mut spent = Spent { camera: 100, light, ..Spent::default() };
        let mut done = Work::default();
        let mut split = Allocation::START;
        for &(samples, light) in segments {
            split.light = light;
            spent.close_segment(samples, split, Behind::default());
            done.samples += samples;
            done.light_paths += (samples as f64 * light) as u64;
            done.merging += samples as f64 * split.merged;
        }
        split.next(&film(values), done, &spent, Behind::default())
    }

    /// Equal variances and costs keep the split; four times the variance doubles the number.
    #[test]
    fn follows_variance_and_cost() {
        for ratio in [1.0, 0.25] {
            for (light, factor) in [([0.9, 1.1], 1.0), ([0.8, 1.2], 2.0)] {
                let next = next(light, 100, &[(4, ratio)]);
                assert!((next.light - factor * ratio).abs() < 1e-9, "{next:?}");
                assert_eq!(next.merged, 0.5, "nothing is known of it");
            }
        }
    }

    /// Segments of 1 and of 1/4 light path for each of as many camera paths have the variance of 2/5 path: (1 + 4) / 2 times
    /// that of 1.
    #[test]
    fn earlier_splits_count() {
        let next = next([0.9, 1.1], 100, &[(4, 1.0), (4, 0.25)]);
        let (variance, cost) = (0.4, 1.0 / 0.625);
        assert!((next.light - f64::sqrt(variance / cost)).abs() < 1e-9, "{next:?}");
    }

    /// What brings no noise takes a small share of the rays; what brings it all has a bound.
    #[test]
    fn bounds() {
        let least = next([1.0, 1.0], 200, &[(4, 0.5)]);
        assert!((least.light * 4.0 - LEAST_SHARE).abs() < 1e-9, "{least:?}");
        assert_eq!(next([-99.0, 101.0], 1, &[(4, 0.5)]).light, MOST_LIGHT_PATHS);
    }
}
