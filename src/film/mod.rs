//! The film: sums of XYZ in f64, with replicates from which its own error follows. Knows colour and spectra, no scene.

mod camera;
mod error;
mod filter;
mod replicates;
mod sensor;
mod tile;

pub use camera::{CameraPart, CameraSamples};
pub use error::{ErrorParts, PartError, Parts};
pub use filter::Filter;
pub use sensor::Sensor;
pub use tile::{CameraSums, CameraTile};

use replicates::Replicates;

/// Independently scrambled replicates of the camera part.
pub const CAMERA_REPLICATES: usize = 2;
/// Independently scrambled replicates of the parts whose errors span pixels: light paths, and merging.
pub const LIGHT_REPLICATES: usize = 8;

/// CIE XYZ; 1 everywhere is a spectral radiance of 1 W·m⁻²·sr⁻¹·nm⁻¹.
pub type Xyz = [f64; 3];

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
    camera: CameraPart,
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
            camera: CameraPart::new(width as usize * height as usize),
            light: Replicates::default(),
            light_paths: 0,
            merged: Replicates::default(),
            merged_before: None,
            non_finite_samples: 0,
            scale,
        }
    }

    /// For camera samples that count in all pixels that the filter reaches.
    pub fn filtered(mut self, filter: &Filter) -> Self {
        self.camera.correlation = filter.correlation();
        self
    }

    /// Memory of a film with light paths and merging, and of the XYZ picture made from it, bytes a pixel.
    pub const BYTES_PER_PIXEL: usize =
        size_of::<CameraSums>() + size_of::<u64>() + (2 * LIGHT_REPLICATES + 2) * size_of::<Xyz>();

    /// Pixels per row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    fn pixels(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// Camera samples taken in all.
    pub fn camera_paths(&self) -> u64 {
        self.camera.paths()
    }

    /// What camera samples have given.
    pub fn camera(&self) -> &CameraPart {
        &self.camera
    }

    /// Adds what camera samples gave in some tiles, in their order whatever the number of threads.
    pub fn add_tiles(&mut self, tiles: &[&CameraTile]) {
        self.camera.add_tiles(self.width as usize, tiles);
        self.non_finite_samples += tiles.iter().map(|tile| tile.non_finite).sum::<u64>();
    }

    /// What camera samples have given, to count them and to order them in stages.
    pub fn camera_mut(&mut self) -> &mut CameraPart {
        &mut self.camera
    }

    /// Adds what `paths` light paths of a replicate left. Each counts `weight` in the mean over all.
    pub fn add_splats(&mut self, replicate: usize, paths: u64, weight: f64, splats: &[Splat]) {
        let weighted = splats.iter().map(|s| Splat { pixel: s.pixel, xyz: s.xyz.map(|v| v * weight) });
        self.non_finite_samples += self.light.add(self.pixels(), replicate, paths as f64 * weight, weighted);
        self.light_paths += paths;
    }

    /// Remembers what merging has given so far: how it changes from here on tells how much of it is blur.
    pub fn mark_merged(&mut self) {
        self.merged_before = Some(self.merged.clone());
    }

    /// Adds what a pass of photon merging in a replicate gave for some pixels.
    pub fn add_merged(&mut self, replicate: usize, pixels: impl Iterator<Item = Splat>) {
        self.non_finite_samples += self.merged.add(self.pixels(), replicate, 1.0, pixels);
    }

    /// Light paths traced in all, those of merging aside.
    pub fn light_paths(&self) -> u64 {
        self.light_paths
    }

    /// XYZ of a pixel: the mean of its camera samples plus the means over light paths and over passes of merging.
    pub fn xyz(&self, pixel: usize) -> Xyz {
        let camera = self.camera.mean(pixel);
        std::array::from_fn(|c| self.scale * (camera[c] + self.light.mean(pixel, c) + self.merged.mean(pixel, c)))
    }

    /// All pixels, row by row.
    pub fn to_xyz(&self) -> Vec<Xyz> {
        (0..self.pixels()).map(|i| self.xyz(i)).collect()
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A film of one row with samples of its own in each pixel, one in each replicate.
    pub fn film_of(pixels: &[[Xyz; 2]]) -> Film {
        let mut film = Film::new(pixels.len() as u32, 1, 1.0);
        add_row(&mut film, pixels);
        film.camera_mut().weigh_open_stage([1.0; 2], 1.0);
        film
    }

    /// Adds to a film of one row a sample of its own for each pixel and replicate.
    pub fn add_row(film: &mut Film, pixels: &[[Xyz; 2]]) {
        let mut tile = CameraTile::new([0, 0], [pixels.len() as u32, 1], 0);
        for (x, sums) in pixels.iter().enumerate() {
            (0..2).for_each(|r| tile.add_to_pixel([x as i32, 0], r, (1.0, sums[r])));
            film.camera_mut().count_samples(Some(x), 2);
        }
        film.add_tiles(&[&tile]);
    }

    /// Few samples of different weights: the mean over many films is right, where light changes within a filter too, and an even
    /// picture has no noise.
    #[test]
    fn weights_bring_neither_bias_nor_noise() {
        let (filter, runs) = (Filter::blackman_harris(1.5), 40_000);
        let (mut sum, mut squares, mut exact) = (0.0, 0.0, 0.0);
        let light = |x: f32| f64::from((x - 0.2).max(0.0));
        let mut random = 1u64;
        let mut uniform = || {
            random = crate::sampling::mix(random);
            (random >> 40) as f32 / (1u64 << 24) as f32
        };
        for _ in 0..runs {
            let mut film = Film::new(1, 1, 1.0);
            let mut tile = CameraTile::new([-1, -1], [3, 3], 1);
            for (i, replicate) in (0..9).flat_map(|i| [(i, 0), (i, 1)]) {
                let (x, offset) = (i % 3 - 1, [uniform(), uniform()]);
                let at = x as f32 + offset[0];
                tile.add(&filter, ([x, i / 3 - 1], offset), replicate, (1.0, [2.0, light(at), 0.0]));
                exact += f64::from(filter.weight(at - 0.5)) * light(at) / f64::from(6 * runs);
            }
            film.add_tiles(&[&tile]);
            film.camera_mut().weigh_open_stage([1.0; 2], 1.0);
            let [even, uneven, _] = film.xyz(0);
            assert!((even - 2.0).abs() < 1e-12, "{even}");
            (sum, squares) = (sum + uneven, squares + uneven * uneven);
        }
        let (n, mean) = (f64::from(runs), sum / f64::from(runs));
        let error = ((squares / n - mean * mean) / n).sqrt();
        assert!((mean - exact).abs() < 3.0 * error && error < 2e-3 * exact, "{mean} ± {error}, not {exact}");
    }

    #[test]
    fn means_of_both_parts() {
        let mut film = Film::new(2, 1, 4.0);
        add_row(&mut film, &[[[1.0, 2.0, 3.0], [3.0, 2.0, 1.0]], [[f64::NAN, 0.0, 0.0], [0.0; 3]]]);
        film.camera_mut().weigh_open_stage([1.0; 2], 1.0);
        film.add_splats(2, 10, 0.5, &[Splat { pixel: 1, xyz: [5.0; 3] }, Splat { pixel: 0, xyz: [f64::INFINITY; 3] }]);
        assert_eq!(film.xyz(0), [8.0, 8.0, 8.0]);
        assert_eq!(film.xyz(1), [2.0; 3]);
        assert_eq!((film.non_finite_samples, film.camera_paths(), film.light_paths()), (2, 4, 10));
    }

    /// Samples all over the film and as far beyond as the filter reaches: a constant stays one up to the edges, whatever the
    /// tiles, and every pixel is what the filter makes of the samples.
    #[test]
    fn samples_count_in_all_pixels_that_they_reach() {
        let (width, height, filter) = (7, 20, Filter::gaussian(1.4));
        let reach = filter.reach() as i32;
        let (mut film, n) = (Film::new(width, height, 1.0), 16);
        let mut expected = vec![0.0; (width * height) as usize];
        let light = |x: f32, y: f32| f64::from(1.0 + 0.1 * x * y);
        let rows = [-reach..3, 3..17, 17..height as i32 + reach];
        let tiles: Vec<CameraTile> = rows
            .into_iter()
            .map(|rows| {
                let size = [width + 2 * reach as u32, rows.len() as u32];
                let mut tile = CameraTile::new([-reach, rows.start], size, reach as u32);
                for (y, x) in rows.flat_map(|y| (-reach..width as i32 + reach).map(move |x| (y, x))) {
                    for i in 0..n * n {
                        let offset = [i % n, i / n].map(|i| (i as f32 + 0.5) / n as f32);
                        let (px, py) = (x as f32 + offset[0], y as f32 + offset[1]);
                        tile.add(&filter, ([x, y], offset), i % 2, (1.0, [1.0, light(px, py), 0.0]));
                        filter.splat([px, py], width, height, |column, row, weight| {
                            expected[(row * width + column) as usize] += f64::from(weight) * light(px, py);
                        });
                    }
                }
                tile
            })
            .collect();
        film.add_tiles(&tiles.iter().collect::<Vec<_>>());
        let samples = (n * n) as f64;
        film.camera_mut().weigh_open_stage([samples / 2.0; 2], 1.0);
        for (pixel, expected) in expected.into_iter().enumerate() {
            let [x, y, z] = film.xyz(pixel);
            assert!((x - 1.0).abs() < 1e-12 && z == 0.0, "{pixel}: {x}");
            assert!((y / (expected / samples) - 1.0).abs() < 1e-3, "{pixel}: {y}");
        }
    }
}
