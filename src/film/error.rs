//! The film's own error, from its replicates. Everything is relative to brightness as in relMSE: squares of errors are divided
//! by I² + 0.01 m², with m the mean of the picture, and averaged over pixels and channels.

use super::replicates::Replicates;
use super::{CAMERA_REPLICATES, Film, LIGHT_REPLICATES, Xyz};

/// A number for each part of a film.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Parts {
    /// Camera samples.
    pub camera: f64,
    /// Light paths.
    pub light: f64,
    /// Merging.
    pub merged: f64,
}

/// What is known of the mean square error of a part.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PartError {
    /// Its estimate.
    pub mean: f64,
    /// Standard deviation of the difference between that and the square error of this very picture: both are subject to
    /// chance.
    pub deviation: f64,
    /// Degrees of freedom of Student's t that the deviation stands for.
    pub freedom: f64,
}

/// Errors of all parts.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ErrorParts {
    /// Noise of camera samples: pixels are independent, but for what they share by the filter.
    pub camera: PartError,
    /// Noise of light paths: their errors span pixels, so that only replicates of the whole picture are independent.
    pub light: PartError,
    /// Noise of merging, whose errors span pixels as well.
    pub merged: PartError,
    /// Blur of merging.
    pub blur: PartError,
}

impl ErrorParts {
    /// Lists the errors of all parts.
    pub fn all(&self) -> [PartError; 4] {
        [self.camera, self.light, self.merged, self.blur]
    }
}

impl Film {
    /// Estimates the relative mean square error. The camera part's comes from two half films, that of the others from
    /// eight replicates; the blur of merging is not in it. `None` while a part has samples in fewer than two replicates.
    pub fn estimated_relative_mse(&self) -> Option<f64> {
        self.relative_variances(f64::INFINITY).map(|v| v.camera + v.light + v.merged)
    }

    /// Estimates the relative mean square error part by part. What a part adds in a channel of a pixel counts as at most
    /// `largest`.
    pub fn relative_variances(&self, largest: f64) -> Option<Parts> {
        let (light, merged) = self.replicated()?;
        let scales = self.relative_scales();
        let mut parts = Parts::default();
        for (pixel, scale) in scales.iter().enumerate() {
            let camera = self.camera.variance(pixel);
            for c in 0..3 {
                let of = |variance: f64| (scale[c] * variance).min(largest) / (3 * scales.len()) as f64;
                parts.camera += of(camera[c]);
                parts.light += of(self.light.variance(pixel, c, &light));
                parts.merged += of(self.merged.variance(pixel, c, &merged));
            }
        }
        Some(parts)
    }

    /// Tells what is known of the error, part by part. `decay` is the exponent with which the blur of merging falls with the
    /// number of passes; it is told once merging has been marked, see [`Film::mark_merged`]. `None` while a part has
    /// samples in fewer than two replicates, or there is merging without a mark.
    pub fn error_parts(&self, decay: f64) -> Option<ErrorParts> {
        let (light, merged) = self.replicated()?;
        let scales = self.relative_scales();
        let values = (3 * scales.len()) as f64;
        // A pixel's square error is as uncertain as its estimate, and both are about as large as the estimate. Those of
        // pixels that share samples go together.
        let (mut mean, mut squares) = (0.0, 0.0);
        for (pixel, scale) in scales.iter().enumerate() {
            let variance = self.camera.variance(pixel);
            let of_pixel = (0..3).map(|c| scale[c] * variance[c]).sum::<f64>() / values;
            mean += of_pixel;
            squares += of_pixel * of_pixel * self.camera.correlation;
        }
        let freedom = if squares > 0.0 { (mean * mean / squares).max(1.0) } else { 1.0 };
        let camera = PartError { mean, deviation: (2.0 * squares).sqrt(), freedom };
        let blur = match (&self.merged_before, merged.is_empty()) {
            (_, true) => PartError::default(),
            (None, false) => return None,
            (Some(before), false) => self.merged.blur(before, decay, &scales)?,
        };
        Some(ErrorParts {
            camera,
            light: self.light.noise(&light, &scales),
            merged: self.merged.noise(&merged, &scales),
            blur,
        })
    }

    /// Returns the standard error of the value of a pixel: from few replicates, so only means over pixels are worth much. The blur of
    /// merging is not in it.
    pub fn standard_error(&self, pixel: usize) -> Xyz {
        let camera = self.camera.variance(pixel);
        let (light, merged) = (self.light.used(), self.merged.used());
        let of =
            |part: &Replicates, used: &[usize], c| if used.len() > 1 { part.variance(pixel, c, used) } else { 0.0 };
        std::array::from_fn(|c| {
            let variance = camera[c] + of(&self.light, &light, c) + of(&self.merged, &merged, c);
            self.scale * variance.sqrt()
        })
    }

    /// Returns the variance of the camera part of each pixel relative to its brightness: the sum over channels.
    pub fn relative_camera_variances(&self) -> Vec<f64> {
        let scales = self.relative_scales().into_iter().enumerate();
        let sum = |scale: Xyz, variance: Xyz| (0..3).map(|c| scale[c] * variance[c]).sum();
        scales.map(|(pixel, scale)| sum(scale, self.camera.variance(pixel))).collect()
    }

    /// Returns the replicates of light paths and of merging that have samples; `None` if an error cannot be told from them.
    fn replicated(&self) -> Option<(Vec<usize>, Vec<usize>)> {
        let (light, merged) = (self.light.used(), self.merged.used());
        (light.len() != 1 && merged.len() != 1 && self.camera.replicated()).then_some((light, merged))
    }

    /// Returns the factors from squares of film sums to relative ones. A pixel's own value is no measure of its brightness where its
    /// error is large: what stands out by chance would make its error look small. The geometric mean of it and of what
    /// both replicates of camera samples have found comes close, on average, to what the true brightness gives.
    fn relative_scales(&self) -> Vec<Xyz> {
        let image = self.to_image();
        let image = image.triples();
        let mean = image.iter().flatten().sum::<f64>() / (3 * image.len()) as f64;
        let of_pixel = |(pixel, xyz): (usize, &Xyz)| {
            let of_camera: Xyz = self.camera.mean(pixel, 0);
            let [a, b] = self.camera.replicates(pixel, 0).unwrap_or([of_camera; CAMERA_REPLICATES]);
            std::array::from_fn(|c| {
                let found_twice = xyz[c] - self.scale * (of_camera[c] - a[c].min(b[c]));
                let brightness = (xyz[c] * found_twice).max(0.0) + 0.01 * mean * mean;
                self.scale * self.scale / brightness.max(f64::MIN_POSITIVE)
            })
        };
        image.iter().enumerate().map(of_pixel).collect()
    }
}

impl Replicates {
    /// Estimates the noise of the mean over replicates.
    fn noise(&self, used: &[usize], scales: &[Xyz]) -> PartError {
        let n = used.len() as f64;
        if used.len() < 2 {
            return PartError::default();
        }
        // The square distance of a replicate from the mean, brought to the expectation of the mean's square error.
        let of_replicate = |&r: &usize| {
            let distance = |pixel: usize, c: usize| {
                let d = self.sum(r, pixel, c) / self.counts[r] - self.mean(pixel, c);
                scales[pixel][c] * d * d
            };
            let sum: f64 = (0..scales.len()).map(|p| (0..3).map(|c| distance(p, c)).sum::<f64>()).sum();
            sum / (3 * scales.len()) as f64 / (n - 1.0)
        };
        PartError::of(&used.iter().map(of_replicate).collect::<Vec<_>>(), 1.0 + 1.0 / n)
    }

    /// Estimates the blur of the mean over passes, which falls with the number of passes to the power of −`decay`: so it follows from
    /// the change since there were fewer. The noise of that change is kept out of its square by multiplying the changes of
    /// different replicates. `None` if not all replicates have gone on.
    fn blur(&self, before: &Self, decay: f64, scales: &[Xyz]) -> Option<PartError> {
        let passes = |part: &Self| part.counts.iter().sum::<f64>();
        let goes_on = (0..LIGHT_REPLICATES).all(|r| before.counts[r] > 0.0 && self.counts[r] > before.counts[r]);
        if !goes_on {
            return None;
        }
        let ratio = crate::math::pow(passes(self) / passes(before), decay);
        let amplification = 1.0 / (ratio - 1.0);
        let change = |r: usize, pixel: usize, c: usize| {
            self.sum(r, pixel, c) / self.counts[r] - before.sum(r, pixel, c) / before.counts[r]
        };
        // Of each replicate with the mean of the others.
        let n = LIGHT_REPLICATES as f64;
        let product = |r: usize| {
            let of_value = |p: usize, c: usize| {
                let (own, total) = (change(r, p, c), (0..LIGHT_REPLICATES).map(|r| change(r, p, c)).sum::<f64>());
                scales[p][c] * own * (total - own) / (n - 1.0)
            };
            let sum: f64 = (0..scales.len()).map(|p| (0..3).map(|c| of_value(p, c)).sum::<f64>()).sum();
            amplification * amplification * sum / (3 * scales.len()) as f64
        };
        // Each pair is in two of the products.
        let error = PartError::of(&(0..LIGHT_REPLICATES).map(product).collect::<Vec<_>>(), 2.0 / n);
        Some(PartError { mean: error.mean.max(0.0), ..error })
    }
}

impl PartError {
    /// Makes the error of independent values that have the same expectation; `variances` is the variance of the deviation in units of theirs.
    fn of(values: &[f64], variances: f64) -> Self {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let variance = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / (n - 1.0);
        Self { mean, deviation: (variance * variances).sqrt(), freedom: n - 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::Splats;

    fn film_of(pixels: &[[f64; 2]]) -> Film {
        crate::film::tests::film_of(&pixels.iter().map(|values| values.map(|v| [v; 3])).collect::<Vec<_>>())
    }

    #[test]
    fn estimate_from_replicates() {
        let mut film = film_of(&[[1.0, 3.0]]);
        film.camera_mut().weigh_open_stage([1.0, 0.0], 1.0);
        assert_eq!(film.estimated_relative_mse(), None);
        film.camera_mut().weigh_open_stage([1.0, 1.0], 1.0);
        // Mean 2, of which both have found 1; variance of the mean (3 − 1)² / 4 = 1, relative to 2 · 1 + 0.01 · 4.
        assert!((film.estimated_relative_mse().unwrap() - 1.0 / 2.04).abs() < 1e-12);
        assert_eq!(film.standard_error(0), [1.0; 3]);
    }

    /// A pixel may stand out by chance, and is not to make its own error look small then.
    #[test]
    fn a_spike_does_not_hide_its_error() {
        let film = film_of(&[[1.0; 2], [1.0; 2], [0.0, 200.0], [1.0; 2], [1.0; 2]]);
        // Mean 20.8; variance of the spike 100², relative to 0.01 · 20.8² alone: only one replicate has found anything.
        let expected = 1e4 / (0.01 * 20.8 * 20.8) / 5.0;
        assert!((film.estimated_relative_mse().unwrap() / expected - 1.0).abs() < 1e-12);
    }

    /// Equal pixels share the uncertainty; one that holds all of the error leaves a single degree of freedom.
    #[test]
    fn freedom_of_the_camera_part() {
        let even = film_of(&[[0.9, 1.1]; 64]).error_parts(0.0).unwrap().camera;
        assert!((even.freedom - 64.0).abs() < 1e-9, "{even:?}");
        assert!((even.deviation / even.mean - (2.0f64 / 64.0).sqrt()).abs() < 1e-9);
        let mut pixels = vec![[1.0, 1.0]; 64];
        pixels[9] = [0.9, 1.1];
        assert!((film_of(&pixels).error_parts(0.0).unwrap().camera.freedom - 1.0).abs() < 1e-9);
    }

    /// Replicates 1 ± 0.1 of one value: variance of their mean 0.01 / 7.
    #[test]
    fn noise_of_light_paths() {
        let mut film = Film::new(1, 1, 1.0);
        for r in 0..LIGHT_REPLICATES {
            let value = if r % 2 == 0 { 0.9 } else { 1.1 };
            film.add_splats(r, 1, 1.0, &Splats::of(&[(0, [value; 3])]));
        }
        let light = film.error_parts(0.0).unwrap().light;
        assert!((light.mean - 0.01 / 7.0 / 1.01).abs() < 1e-12, "{light:?}");
        assert!(light.deviation < 1e-12 && light.freedom == 7.0);
    }

    /// A blur of 0.3 after 8 passes, and so of 0.15 after 64 with decay 1/3, is found from the change.
    #[test]
    fn blur_of_merging() {
        let mut film = Film::new(1, 1, 1.0);
        // The mean over n passes is 1 + 0.6 n^(-1/3).
        let total = |passes: f64| passes + 0.6 * crate::math::pow(passes, 2.0 / 3.0);
        let add = |film: &mut Film, from: f64, to: f64| {
            for r in 0..LIGHT_REPLICATES {
                let value = (total(to) - total(from)) / 8.0;
                film.merged.add(1, r, (to - from) / 8.0, 1.0, &Splats::of(&[(0, [value; 3])]));
            }
        };
        add(&mut film, 0.0, 8.0);
        assert_eq!(film.error_parts(1.0 / 3.0), None, "not marked yet");
        film.mark_merged();
        add(&mut film, 8.0, 64.0);
        let blur = film.error_parts(1.0 / 3.0).unwrap().blur;
        let expected = 0.15 * 0.15 / (1.01 * 1.15 * 1.15);
        assert!((blur.mean / expected - 1.0).abs() < 1e-9, "{blur:?} {expected}");
    }

    /// Two stages count by their weights alone, whatever their numbers of samples.
    #[test]
    fn stages() {
        let mut film = film_of(&[[1.0, 3.0], [5.0, 5.0]]);
        film.camera_mut().weigh_open_stage([1.0; 2], 2.0);
        film.camera_mut().close_stage();
        assert_eq!(film.xyz(1), [5.0; 3], "no samples yet in the open stage");
        (0..10).for_each(|_| crate::film::tests::add_row(&mut film, &[[[4.0; 3], [8.0; 3]], [[6.0; 3]; 2]]));
        film.camera_mut().weigh_open_stage([10.0; 2], 6.0);
        // (2 · 2 + 6 · 6) / 8, and (2 · 5 + 6 · 6) / 8.
        assert_eq!((film.xyz(0), film.xyz(1)), ([5.0; 3], [5.75; 3]));
        assert_eq!((film.camera().samples(0), film.camera_paths()), (22, 44));
        // Replicates (2 · 1 + 6 · 4) / 8 and (2 · 3 + 6 · 8) / 8.
        assert_eq!(film.standard_error(0), [0.5 * (6.75 - 3.25); 3]);
    }
}
