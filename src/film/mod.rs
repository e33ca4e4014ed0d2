//! The film: sums of XYZ in f64, with replicates from which its own error follows. Knows colour and spectra, no scene.

mod error;
mod filter;
mod replicates;
mod sensor;

pub use error::{ErrorParts, PartError, Parts};
pub use filter::Filter;
pub use sensor::Sensor;

use replicates::Replicates;

/// Independently scrambled replicates of the camera part.
pub const CAMERA_REPLICATES: usize = 2;
/// Independently scrambled replicates of the parts whose errors span pixels: light paths, and merging.
pub const LIGHT_REPLICATES: usize = 8;

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

/// Stages of a render whose numbers of samples differ from pixel to pixel, by what earlier stages have shown. The mean of
/// a pixel is that of its means in all stages with weights that do not depend on what was found: so a stage that stopped
/// early because it missed something does not pull the mean down.
#[derive(Debug, Clone, PartialEq)]
struct ClosedStages {
    /// Sums over stages of weight times mean, for each replicate.
    sums: Vec<[Xyz; CAMERA_REPLICATES]>,
    /// Samples of each pixel.
    counts: Vec<u64>,
    weight: f64,
}

/// A picture in the making.
#[derive(Debug, Clone, PartialEq)]
pub struct Film {
    width: u32,
    height: u32,
    camera: Vec<PixelSums>,
    /// What camera samples of closed stages gave, if there are any.
    closed: Option<ClosedStages>,
    /// What the open stage counts in the mean over stages.
    open_weight: f64,
    light: Replicates,
    light_paths: u64,
    merged: Replicates,
    /// The same at an earlier time.
    merged_before: Option<Replicates>,
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
            closed: None,
            open_weight: 0.0,
            light: Replicates::default(),
            light_paths: 0,
            merged: Replicates::default(),
            merged_before: None,
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

    /// Remembers what merging has given so far: how it changes from here on tells how much of it is blur.
    pub fn mark_merged(&mut self) {
        self.merged_before = Some(self.merged.clone());
    }

    /// Adds what a pass of photon merging in a replicate gave for some pixels.
    pub fn add_merged(&mut self, replicate: usize, pixels: impl Iterator<Item = Splat>) {
        self.non_finite_samples += self.merged.add(self.camera.len(), replicate, 1.0, pixels);
    }

    /// Camera samples taken in all.
    pub fn camera_paths(&self) -> u64 {
        (0..self.camera.len()).map(|pixel| self.samples(pixel)).sum()
    }

    /// Camera samples of a pixel.
    pub fn samples(&self, pixel: usize) -> u64 {
        let closed = self.closed.as_ref().map_or(0, |closed| closed.counts[pixel]);
        closed + self.camera[pixel].count.iter().sum::<u64>()
    }

    /// What the camera samples since the last stage count in the mean over stages. Without closed stages it does not matter.
    pub fn weigh_open_stage(&mut self, weight: f64) {
        self.open_weight = weight;
    }

    /// Ends a stage: samples from here on are another. Every pixel must have a sample in each replicate.
    pub fn close_stage(&mut self) {
        let pixels = self.camera.len();
        let empty = || ClosedStages { sums: vec![Default::default(); pixels], counts: vec![0; pixels], weight: 0.0 };
        let closed = self.closed.get_or_insert_with(empty);
        for ((open, sums), count) in self.camera.iter_mut().zip(&mut closed.sums).zip(&mut closed.counts) {
            for (r, sum) in sums.iter_mut().enumerate() {
                let scale = self.open_weight / open.count[r] as f64;
                (0..3).for_each(|c| sum[c] += scale * open.sum[r][c]);
            }
            *count += open.count.iter().sum::<u64>();
            *open = PixelSums::default();
        }
        closed.weight += self.open_weight;
        self.open_weight = 0.0;
    }

    /// Mean of a pixel's camera samples.
    fn camera_mean(&self, pixel: usize) -> Xyz {
        let PixelSums { sum, count } = self.camera[pixel];
        let samples = count.iter().sum::<u64>() as f64;
        let open = |c: usize| if samples > 0.0 { sum.iter().map(|s| s[c]).sum::<f64>() / samples } else { 0.0 };
        let Some(closed) = &self.closed else { return std::array::from_fn(open) };
        let weight = if samples > 0.0 { self.open_weight } else { 0.0 };
        let before = |c: usize| closed.sums[pixel].iter().map(|s| s[c]).sum::<f64>() / CAMERA_REPLICATES as f64;
        std::array::from_fn(|c| (before(c) + weight * open(c)) / (closed.weight + weight))
    }

    /// Means of a pixel's replicates; `None` while one has no samples.
    fn camera_replicates(&self, pixel: usize) -> Option<[Xyz; CAMERA_REPLICATES]> {
        let PixelSums { sum, count } = &self.camera[pixel];
        let open = |r: usize, c: usize| if count[r] > 0 { sum[r][c] / count[r] as f64 } else { 0.0 };
        let Some(closed) = &self.closed else {
            return (!count.contains(&0)).then(|| std::array::from_fn(|r| std::array::from_fn(|c| open(r, c))));
        };
        Some(std::array::from_fn(|r| {
            let weight = if count[r] > 0 { self.open_weight } else { 0.0 };
            std::array::from_fn(|c| (closed.sums[pixel][r][c] + weight * open(r, c)) / (closed.weight + weight))
        }))
    }

    /// Light paths traced in all, those of merging aside.
    pub fn light_paths(&self) -> u64 {
        self.light_paths
    }

    /// XYZ of a pixel: the mean of its camera samples plus the means over light paths and over passes of merging.
    pub fn xyz(&self, pixel: usize) -> Xyz {
        let camera = self.camera_mean(pixel);
        std::array::from_fn(|c| self.scale * (camera[c] + self.light.mean(pixel, c) + self.merged.mean(pixel, c)))
    }

    /// All pixels, row by row.
    pub fn to_xyz(&self) -> Vec<Xyz> {
        (0..self.camera.len()).map(|i| self.xyz(i)).collect()
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
        film.add_splats(2, 10, 0.5, &[Splat { pixel: 1, xyz: [5.0; 3] }, Splat { pixel: 0, xyz: [f64::INFINITY; 3] }]);
        assert_eq!(film.xyz(0), [8.0, 8.0, 8.0]);
        assert_eq!(film.xyz(1), [2.0; 3]);
        assert_eq!((film.non_finite_samples, film.camera_paths(), film.light_paths()), (1, 3, 10));
    }
}
