//! The film: sums of XYZ in f64, with replicates from which its own error follows. Knows colour and spectra, no scene.

mod filter;
mod sensor;

pub use filter::Filter;
pub use sensor::Sensor;

/// Independently scrambled replicates of the camera part.
pub const CAMERA_REPLICATES: usize = 2;
/// Independently scrambled replicates of the light part.
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

/// A picture in the making.
#[derive(Debug, Clone, PartialEq)]
pub struct Film {
    width: u32,
    height: u32,
    camera: Vec<PixelSums>,
    /// Pixel sums of each replicate; empty until there are light paths.
    light: [Vec<Xyz>; LIGHT_REPLICATES],
    light_paths: [u64; LIGHT_REPLICATES],
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
            light: Default::default(),
            light_paths: [0; LIGHT_REPLICATES],
            non_finite_samples: 0,
            scale,
        }
    }

    /// Memory of a film with light paths, and of the XYZ picture made from it, bytes a pixel.
    pub const BYTES_PER_PIXEL: usize = size_of::<PixelSums>() + (LIGHT_REPLICATES + 2) * size_of::<Xyz>();

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

    /// Adds what `paths` light paths of a replicate left.
    pub fn add_splats(&mut self, replicate: usize, paths: u64, splats: &[Splat]) {
        let sums = &mut self.light[replicate];
        if sums.is_empty() {
            sums.resize(self.camera.len(), [0.0; 3]);
        }
        for splat in splats {
            if splat.xyz.iter().all(|v| v.is_finite()) {
                let pixel = &mut sums[splat.pixel as usize];
                for (sum, v) in pixel.iter_mut().zip(splat.xyz) {
                    *sum += v;
                }
            } else {
                self.non_finite_samples += 1;
            }
        }
        self.light_paths[replicate] += paths;
    }

    /// Camera samples taken in all.
    pub fn camera_paths(&self) -> u64 {
        self.camera.iter().flat_map(|p| p.count).sum()
    }

    /// Light paths traced in all.
    pub fn light_paths(&self) -> u64 {
        self.light_paths.iter().sum()
    }

    /// XYZ of a pixel: the mean of its camera samples plus the mean over light paths.
    pub fn xyz(&self, pixel: usize) -> Xyz {
        let PixelSums { sum, count } = self.camera[pixel];
        let total: Xyz = std::array::from_fn(|c| sum.iter().map(|s| s[c]).sum());
        let (samples, paths) = (count.iter().sum::<u64>() as f64, self.light_paths() as f64);
        std::array::from_fn(|c| {
            let camera = if samples > 0.0 { total[c] / samples } else { 0.0 };
            let light: f64 = self.light.iter().filter(|l| !l.is_empty()).map(|l| l[pixel][c]).sum();
            self.scale * (camera + if paths > 0.0 { light / paths } else { 0.0 })
        })
    }

    /// All pixels, row by row.
    pub fn to_xyz(&self) -> Vec<Xyz> {
        (0..self.camera.len()).map(|i| self.xyz(i)).collect()
    }

    /// Estimate of the relative mean square error: the mean over pixels and channels of Var / (I² + 0.01 m²), with m the
    /// mean of the picture. The camera part's variance comes from two half films, the light part's from four replicates.
    /// `None` while a part has samples in fewer than two replicates.
    pub fn estimated_relative_mse(&self) -> Option<f64> {
        let image = self.to_xyz();
        let mean = image.iter().flatten().sum::<f64>() / (3 * image.len()) as f64;
        let light_replicates: Vec<usize> = (0..LIGHT_REPLICATES).filter(|&r| self.light_paths[r] > 0).collect();
        if light_replicates.len() == 1 {
            return None;
        }
        let mut total = 0.0;
        for (i, (pixel, xyz)) in self.camera.iter().zip(&image).enumerate() {
            for (c, value) in xyz.iter().enumerate() {
                let mut variance = self.light_variance(i, c, &light_replicates);
                if pixel.count.iter().any(|&n| n > 0) {
                    if pixel.count.contains(&0) {
                        return None;
                    }
                    let [a, b] = [0, 1].map(|r| self.scale * pixel.sum[r][c] / pixel.count[r] as f64);
                    variance += (a - b) * (a - b) / 4.0;
                }
                total += variance / (value * value + 0.01 * mean * mean).max(f64::MIN_POSITIVE);
            }
        }
        Some(total / (3 * image.len()) as f64)
    }

    /// Variance of the light part's mean in one channel of a pixel.
    fn light_variance(&self, pixel: usize, channel: usize, replicates: &[usize]) -> f64 {
        let n = replicates.len() as f64;
        if replicates.is_empty() {
            return 0.0;
        }
        let mean_of = |r: usize| self.scale * self.light[r][pixel][channel] / self.light_paths[r] as f64;
        let mean = replicates.iter().map(|&r| mean_of(r)).sum::<f64>() / n;
        replicates.iter().map(|&r| (mean_of(r) - mean) * (mean_of(r) - mean)).sum::<f64>() / (n * (n - 1.0))
    }
}

impl PixelSums {
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
        film.add_splats(2, 10, &[Splat { pixel: 1, xyz: [5.0; 3] }, Splat { pixel: 0, xyz: [f64::INFINITY; 3] }]);
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
