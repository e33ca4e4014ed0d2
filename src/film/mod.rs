//! The film: sums of XYZ in f64, with replicates from which its own error follows. Knows colour and spectra, no scene.

mod filter;
mod sensor;

pub use filter::Filter;
pub use sensor::Sensor;

/// Independently scrambled replicates of the camera part.
pub const CAMERA_REPLICATES: usize = 2;
/// Independently scrambled replicates of the parts whose errors span pixels: light paths, and merging.
pub const LIGHT_REPLICATES: usize = 4;

/// CIE XYZ; 1 everywhere is a spectral radiance of 1 W·m⁻²·sr⁻¹·nm⁻¹.
pub type Xyz = [f64; 3];

/// Sums of one pixel's camera samples.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PixelSums {
    /// XYZ of each replicate.
    pub sum: [Xyz; CAMERA_REPLICATES],
    /// Samples of each replicate.
    pub count: [u64; CAMERA_REPLICATES],
}

/// One contribution of a light path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Splat {
    /// Row-major pixel index.
    pub pixel: u32,
    /// Already weighted by filter and wavelength density.
    pub xyz: Xyz,
}

/// A part of the picture that is estimated as a whole, with a sum for each replicate.
#[derive(Debug, Clone, PartialEq, Default)]
struct Replicates {
    /// Pixel sums; empty until there is something to add.
    sums: [Vec<Xyz>; LIGHT_REPLICATES],
    /// What to divide the sums by.
    counts: [f64; LIGHT_REPLICATES],
}

/// A picture in the making.
#[derive(Debug, Clone, PartialEq)]
pub struct Film {
    width: u32,
    height: u32,
    camera: Vec<PixelSums>,
    light: Replicates,
    light_paths: u64,
    merged: Replicates,
    /// Samples that were not finite. Dropped, and counted: a healthy renderer has none.
    pub non_finite_samples: u64,
    /// Radiance of the scene that one unit of the sums stands for.
    scale: f64,
}

impl Film {
    /// A black film; sums are in units of `scale` (a power of two).
    pub fn new(width: u32, height: u32, scale: f64) -> Self {
        Self {
            width,
            height,
            camera: vec![PixelSums::default(); width as usize * height as usize],
            light: Replicates::default(),
            light_paths: 0,
            merged: Replicates::default(),
            non_finite_samples: 0,
            scale,
        }
    }

    /// Memory of a film with light paths and merging, and of the XYZ picture made from it, bytes a pixel.
    pub const BYTES_PER_PIXEL: usize = size_of::<PixelSums>() + (2 * LIGHT_REPLICATES + 2) * size_of::<Xyz>();

    /// Pixels per row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The sums of the camera part, row by row.
    pub fn camera_mut(&mut self) -> &mut [PixelSums] {
        &mut self.camera
    }

    /// Adds what `paths` light paths of a replicate left. Each counts `weight` in the mean over all.
    pub fn add_splats(&mut self, replicate: usize, paths: u64, weight: f64, splats: &[Splat]) {
        let weighted = splats.iter().map(|s| Splat { pixel: s.pixel, xyz: s.xyz.map(|v| v * weight) });
        self.non_finite_samples += self.light.add(self.camera.len(), replicate, paths as f64 * weight, weighted);
        self.light_paths += paths;
    }

    /// Adds what a pass of photon merging in a replicate gave for some pixels.
    pub fn add_merged(&mut self, replicate: usize, pixels: impl Iterator<Item = Splat>) {
        self.non_finite_samples += self.merged.add(self.camera.len(), replicate, 1.0, pixels);
    }

    /// Camera samples taken in all.
    pub fn camera_paths(&self) -> u64 {
        self.camera.iter().flat_map(|p| p.count).sum()
    }

    /// Light paths traced in all, those of merging aside.
    pub fn light_paths(&self) -> u64 {
        self.light_paths
    }

    /// XYZ of a pixel: the mean of its camera samples plus the means over light paths and over passes of merging.
    pub fn xyz(&self, pixel: usize) -> Xyz {
        let PixelSums { sum, count } = self.camera[pixel];
        let total: Xyz = std::array::from_fn(|c| sum.iter().map(|s| s[c]).sum());
        let samples = count.iter().sum::<u64>() as f64;
        std::array::from_fn(|c| {
            let camera = if samples > 0.0 { total[c] / samples } else { 0.0 };
            self.scale * (camera + self.light.mean(pixel, c) + self.merged.mean(pixel, c))
        })
    }

    /// All pixels, row by row.
    pub fn to_xyz(&self) -> Vec<Xyz> {
        (0..self.camera.len()).map(|i| self.xyz(i)).collect()
    }

    /// Estimate of the relative mean square error: the mean over pixels and channels of Var / (I² + 0.01 m²), with m the
    /// mean of the picture. The camera part's variance comes from two half films, that of the others from four replicates;
    /// the bias of merging is not in it. `None` while a part has samples in fewer than two replicates.
    pub fn estimated_relative_mse(&self) -> Option<f64> {
        self.relative_variances(f64::INFINITY).map(|v| v.camera + v.light + v.merged)
    }

    /// The same by parts. What a part adds in a channel of a pixel counts as at most `largest`.
    pub fn relative_variances(&self, largest: f64) -> Option<Parts> {
        let image = self.to_xyz();
        let values = (3 * image.len()) as f64;
        let mean = image.iter().flatten().sum::<f64>() / values;
        let (light, merged) = (self.light.used(), self.merged.used());
        let halves = self.camera.iter().all(|p| p.count.iter().all(|&n| n == 0) || !p.count.contains(&0));
        if light.len() == 1 || merged.len() == 1 || !halves {
            return None;
        }
        let mut parts = Parts::default();
        for (i, (pixel, xyz)) in self.camera.iter().zip(&image).enumerate() {
            for (c, value) in xyz.iter().enumerate() {
                let scale = self.scale * self.scale / (value * value + 0.01 * mean * mean).max(f64::MIN_POSITIVE);
                let of = |variance: f64| (scale * variance).min(largest) / values;
                parts.camera += of(pixel.variance(c));
                parts.light += of(self.light.variance(i, c, &light));
                parts.merged += of(self.merged.variance(i, c, &merged));
            }
        }
        Some(parts)
    }
}

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

impl Replicates {
    /// Adds to pixels and to the count; the number of values that were not finite, and left out.
    fn add(&mut self, pixels: usize, replicate: usize, count: f64, splats: impl Iterator<Item = Splat>) -> u64 {
        let sums = &mut self.sums[replicate];
        if sums.is_empty() {
            sums.resize(pixels, [0.0; 3]);
        }
        let mut lost = 0;
        for splat in splats {
            if splat.xyz.iter().all(|v| v.is_finite()) {
                let pixel = &mut sums[splat.pixel as usize];
                for (sum, v) in pixel.iter_mut().zip(splat.xyz) {
                    *sum += v;
                }
            } else {
                lost += 1;
            }
        }
        self.counts[replicate] += count;
        lost
    }

    /// Replicates that have samples.
    fn used(&self) -> Vec<usize> {
        (0..LIGHT_REPLICATES).filter(|&r| self.counts[r] > 0.0).collect()
    }

    fn mean(&self, pixel: usize, channel: usize) -> f64 {
        let sum: f64 = self.sums.iter().filter(|s| !s.is_empty()).map(|s| s[pixel][channel]).sum();
        let count: f64 = self.counts.iter().sum();
        if count > 0.0 { sum / count } else { 0.0 }
    }

    /// Variance of the mean in one channel of a pixel.
    fn variance(&self, pixel: usize, channel: usize, used: &[usize]) -> f64 {
        let n = used.len() as f64;
        if used.is_empty() {
            return 0.0;
        }
        let mean_of = |r: usize| self.sums[r][pixel][channel] / self.counts[r];
        let mean = used.iter().map(|&r| mean_of(r)).sum::<f64>() / n;
        used.iter().map(|&r| (mean_of(r) - mean) * (mean_of(r) - mean)).sum::<f64>() / (n * (n - 1.0))
    }
}

impl PixelSums {
    /// Variance of the mean in one channel, from two replicates; 0 without samples.
    fn variance(&self, channel: usize) -> f64 {
        if self.count.contains(&0) {
            return 0.0;
        }
        let [a, b] = [0, 1].map(|r| self.sum[r][channel] / self.count[r] as f64);
        (a - b) * (a - b) / 4.0
    }

    /// Adds a camera sample; `false` if it was not finite and has been left out (its count stays, the light is lost).
    pub fn add_sample(&mut self, replicate: usize, xyz: Xyz) -> bool {
        self.count[replicate] += 1;
        let finite = xyz.iter().all(|v| v.is_finite());
        if finite {
            for (sum, v) in self.sum[replicate].iter_mut().zip(xyz) {
                *sum += v;
            }
        }
        finite
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_of_both_parts() {
        let mut film = Film::new(2, 1, 4.0);
        assert!(film.camera_mut()[0].add_sample(0, [1.0, 2.0, 3.0]));
        assert!(film.camera_mut()[0].add_sample(1, [3.0, 2.0, 1.0]));
        assert!(!film.camera_mut()[1].add_sample(0, [f64::NAN, 0.0, 0.0]));
        film.add_splats(2, 10, 0.5, &[Splat { pixel: 1, xyz: [5.0; 3] }, Splat { pixel: 0, xyz: [f64::INFINITY; 3] }]);
        assert_eq!(film.xyz(0), [8.0, 8.0, 8.0]);
        assert_eq!(film.xyz(1), [2.0; 3]);
        assert_eq!((film.non_finite_samples, film.camera_paths(), film.light_paths()), (1, 3, 10));
    }

    #[test]
    fn error_estimate_from_replicates() {
        let mut film = Film::new(1, 1, 1.0);
        assert!(film.camera_mut()[0].add_sample(0, [1.0; 3]));
        assert_eq!(film.estimated_relative_mse(), None);
        film.camera_mut()[0].add_sample(1, [3.0; 3]);
        // Mean 2, variance of the mean (3 − 1)² / 4 = 1, relative to 4 + 0.01 · 4.
        assert!((film.estimated_relative_mse().unwrap() - 1.0 / 4.04).abs() < 1e-12);
    }
}
