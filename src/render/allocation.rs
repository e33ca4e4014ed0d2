//! How the work is split between techniques: with variances V and costs c of their parts of the picture, the error for a given
//! cost is least with numbers in proportion to √(V / c).

use crate::film::Film;

/// Variance of a pixel relative to its brightness squared beyond which it counts as this: the error of a pixel that has
/// hardly been hit says little.
const LARGEST: f64 = 1.0;
/// Bounds of the number of light paths for each camera path. What is found rarely must be looked for all the same.
const LIGHT_BOUNDS: [f64; 2] = [1.0 / 16.0, 16.0];
/// Bounds of the number of passes of merging for each sample of a pixel.
const MERGED_BOUNDS: [f64; 2] = [1.0 / 32.0, 4.0];

/// Numbers relative to those of camera paths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Allocation {
    /// Light paths for each camera path.
    pub light: f64,
    /// Passes of merging for each sample of a pixel.
    pub merged: f64,
}

/// Rays traced by each technique.
#[derive(Debug, Clone, Copy, Default)]
pub struct Spent {
    /// For camera paths.
    pub camera: u64,
    /// For light paths.
    pub light: u64,
    /// For merging.
    pub merged: u64,
}

impl Allocation {
    /// Before anything is known.
    pub const START: Self = Self { light: 0.5, merged: 0.5 };

    /// The best split, after what has been measured with this one from a film and the rays that it took.
    pub fn next(self, film: &Film, spent: &Spent) -> Self {
        let Some(variances) = film.relative_variances(LARGEST) else { return self };
        // With n samples at cost C in all and variance V of their mean: V n / (C / n) is V n² / C.
        let better = |ratio: f64, variance: f64, rays: u64, [low, high]: [f64; 2]| {
            let squared = ratio * ratio * variance * spent.camera as f64 / (variances.camera * rays as f64);
            if squared.is_nan() { ratio } else { squared.sqrt().clamp(low, high) }
        };
        Self {
            light: better(self.light, variances.light, spent.light, LIGHT_BOUNDS),
            merged: better(self.merged, variances.merged, spent.merged, MERGED_BOUNDS),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::Splat;

    /// Equal variances and costs keep the split; four times the variance doubles the number.
    #[test]
    fn follows_variance_and_cost() {
        let mut film = Film::new(1, 1, 1.0);
        film.camera_mut()[0].add_sample(0, [0.9; 3]);
        film.camera_mut()[0].add_sample(1, [1.1; 3]);
        for (replicate, value) in [(0, 0.8), (1, 1.2)] {
            film.add_splats(replicate, 1, 1.0, &[Splat { pixel: 0, xyz: [value; 3] }]);
        }
        let next = Allocation { light: 1.0, merged: 0.5 }.next(&film, &Spent { camera: 100, light: 100, merged: 0 });
        assert!((next.light - 2.0).abs() < 1e-9, "{next:?}");
        assert_eq!(next.merged, 0.5, "nothing is known of it");
    }
}
