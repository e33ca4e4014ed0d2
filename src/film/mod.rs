//! The film: sums in f64 of what a sensor makes of radiance, with replicates from which its own error follows. It knows
//! colour and spectra, but no scene.
//!
//! A sensor has any number of channels. The first three are an observer's X, Y and Z: the picture is made of them, and all
//! errors are judged by them. Sums are flat, pixel by pixel.

mod camera;
mod error;
mod filter;
mod replicates;
mod sensor;
mod splats;
mod tile;

pub use camera::{CameraPart, CameraSamples};
pub use error::{ErrorParts, PartError, Parts};
pub use filter::Filter;
pub use sensor::{PICTURE_CHANNELS, Sensor, value};
pub use splats::Splats;
pub use tile::{CameraTile, SamplePlace};

use crate::Image;
use replicates::Replicates;

/// Independently scrambled replicates of the camera part.
pub const CAMERA_REPLICATES: usize = 2;
/// Independently scrambled replicates of the parts whose errors span pixels: light paths, and merging.
pub const LIGHT_REPLICATES: usize = 8;

/// CIE XYZ; 1 everywhere is a spectral radiance of 1 W·m⁻²·sr⁻¹·nm⁻¹.
pub type Xyz = [f64; 3];

/// A picture while it is rendered: sums of samples, and the numbers of samples that they are of.
#[derive(Debug, Clone, PartialEq)]
pub struct Film {
    width: u32,
    height: u32,
    channels: usize,
    camera: CameraPart,
    light: Replicates,
    light_paths: u64,
    merged: Replicates,
    /// What merging had given when [`Film::mark_merged`] was last called.
    merged_before: Option<Replicates>,
    /// Number of samples that were not finite. They are left out of the sums; a healthy renderer has none.
    pub non_finite_samples: u64,
    /// Radiance of the scene that one unit of the sums stands for.
    scale: f64,
}

impl Film {
    /// Makes a black film for an observer's X, Y and Z. Its sums are in units of `scale`, a power of two.
    pub fn new(width: u32, height: u32, scale: f64) -> Self {
        Self::of_channels(width, height, PICTURE_CHANNELS, scale)
    }

    /// Makes a black film with as many channels as its sensor has, see [`Sensor::channels`].
    pub fn of_channels(width: u32, height: u32, channels: usize, scale: f64) -> Self {
        Self {
            width,
            height,
            channels,
            camera: CameraPart::new(width as usize * height as usize, channels),
            light: Replicates::new(channels),
            light_paths: 0,
            merged: Replicates::new(channels),
            merged_before: None,
            non_finite_samples: 0,
            scale,
        }
    }

    /// Tells the film that camera samples count in all pixels that this filter reaches, which correlates the pixels' errors.
    pub fn filtered(mut self, filter: &Filter) -> Self {
        self.camera.correlation = filter.correlation();
        self
    }

    /// Returns how many bytes each pixel takes, in a film with light paths and merging and in the picture made from it.
    pub const fn bytes_per_pixel(channels: usize) -> usize {
        let numbers = tile::stride(channels) + 2 * LIGHT_REPLICATES * channels + 2 * PICTURE_CHANNELS;
        size_of::<u64>() + numbers * size_of::<f64>()
    }

    /// Returns the number of pixels in a row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Returns the number of rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    fn pixels(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// Returns how many camera samples were taken in all pixels together.
    pub fn camera_paths(&self) -> u64 {
        self.camera.paths()
    }

    /// Returns the part of the film that camera samples gave.
    pub fn camera(&self) -> &CameraPart {
        &self.camera
    }

    /// Adds what camera samples gave in some tiles. Tiles are added in the order given, so that the sums do not depend on the
    /// number of threads.
    pub fn add_tiles(&mut self, tiles: &[&CameraTile]) {
        self.camera.add_tiles(self.width as usize, tiles);
        self.non_finite_samples += tiles.iter().map(|tile| tile.non_finite).sum::<u64>();
    }

    /// Returns the part of the film that camera samples gave, to count samples and to end stages.
    pub fn camera_mut(&mut self) -> &mut CameraPart {
        &mut self.camera
    }

    /// Adds what `paths` light paths of a replicate left. Each counts `weight` in the mean over all.
    pub fn add_splats(&mut self, replicate: usize, paths: u64, weight: f64, splats: &Splats) {
        self.non_finite_samples += self.light.add(self.pixels(), replicate, paths as f64 * weight, weight, splats);
        self.light_paths += paths;
    }

    /// Remembers what merging has given so far: how it changes from here on tells how much of it is blur.
    pub fn mark_merged(&mut self) {
        self.merged_before = Some(self.merged.clone());
    }

    /// Adds what a pass of photon merging in a replicate gave for some pixels.
    pub fn add_merged(&mut self, replicate: usize, splats: &Splats) {
        self.non_finite_samples += self.merged.add(self.pixels(), replicate, 1.0, 1.0, splats);
    }

    /// Returns how many light paths were traced, without those of merging.
    pub fn light_paths(&self) -> u64 {
        self.light_paths
    }

    /// Returns the value of a pixel in one channel: the mean of its camera samples plus the means over light paths and over
    /// passes of merging.
    pub fn value(&self, pixel: usize, channel: usize) -> f64 {
        let [value] = self.values(pixel, channel);
        value
    }

    /// Returns the values of a pixel in `N` channels from `first` on.
    fn values<const N: usize>(&self, pixel: usize, first: usize) -> [f64; N] {
        let camera = self.camera.mean::<N>(pixel, first);
        std::array::from_fn(|c| {
            let light = self.light.mean(pixel, first + c);
            self.scale * (camera[c] + light + self.merged.mean(pixel, first + c))
        })
    }

    /// Returns the number of channels.
    pub fn channels(&self) -> usize {
        self.channels
    }

    /// Returns X, Y and Z of a pixel.
    pub fn xyz(&self, pixel: usize) -> Xyz {
        self.values(pixel, 0)
    }

    /// Makes a picture of X, Y and Z. Further channels of the sensor are not in it.
    pub fn to_image(&self) -> Image {
        Image::new(
            [self.width, self.height],
            &["X", "Y", "Z"],
            (0..self.pixels()).flat_map(|pixel| self.xyz(pixel)).collect(),
        )
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::color::Observer;
    use crate::spectrum::{SampledSpectrum, WavelengthDensity};

    /// A film of one row with samples of its own in each pixel, one in each replicate.
    pub fn film_of(pixels: &[[Xyz; 2]]) -> Film {
        let mut film = Film::new(pixels.len() as u32, 1, 1.0);
        add_row(&mut film, pixels);
        film.camera_mut().weigh_open_stage([1.0; 2], 1.0);
        film
    }

    /// Adds to a film of one row a sample of its own for each pixel and replicate.
    pub fn add_row(film: &mut Film, pixels: &[[Xyz; 2]]) {
        let mut tile = CameraTile::new([0, 0], [pixels.len() as u32, 1], 0, 3);
        for (x, sums) in pixels.iter().enumerate() {
            (0..2).for_each(|r| tile.add_to_pixel([x as i32, 0], r, &sums[r]));
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
            let mut tile = CameraTile::new([-1, -1], [3, 3], 1, 3);
            for (i, replicate) in (0..9).flat_map(|i| [(i, 0), (i, 1)]) {
                let (x, offset) = (i % 3 - 1, [uniform(), uniform()]);
                let at = x as f32 + offset[0];
                let place = SamplePlace { pixel: [x, i / 3 - 1], offset: Some(offset), replicate, weight: 1.0 };
                tile.add_known(&filter, place, &[2.0, light(at), 0.0]);
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
        film.add_splats(2, 10, 0.5, &Splats::of(&[(1, [5.0; 3]), (0, [f64::INFINITY; 3])]));
        assert_eq!(film.xyz(0), [8.0, 8.0, 8.0]);
        assert_eq!(film.xyz(1), [2.0; 3]);
        assert_eq!((film.non_finite_samples, film.camera_paths(), film.light_paths()), (2, 4, 10));
    }

    /// A sensor of an observer and seven bands, under a spectrum that rises with the wavelength: every band holds its mean,
    /// from camera samples, splats and merging alike, and the picture and its error are what they are without bands.
    #[test]
    fn bands_beside_the_picture() {
        let observer = Sensor::of_observer(Observer::cie_1931_2deg());
        let edges = |band: usize| (400.0 + 40.0 * band as f64, 440.0 + 40.0 * band as f64);
        let response = |band: usize, nm: f64| {
            let (low, high) = edges(band);
            if nm > low && nm <= high { 1.0 / 40.0 } else { 0.0 }
        };
        let sensor = observer.clone().with_channels(7, response);
        assert_eq!((sensor.channels(), Film::bytes_per_pixel(10) - Film::bytes_per_pixel(3)), (10, 7 * 18 * 8));
        let nm: Vec<f64> = (360..=830).map(f64::from).collect();
        let density = WavelengthDensity::new(&nm, &vec![1.0; nm.len()], &vec![1.0; nm.len()]);
        let filter = Filter::boxed(0.5);
        let film_of = |sensor: &Sensor| {
            let mut film = Film::of_channels(1, 1, sensor.channels(), 1.0);
            let mut tile = CameraTile::new([0, 0], [1, 1], 0, sensor.channels());
            let (mut splats, mut weights) = (Splats::new(sensor.channels()), Vec::new());
            let n = 4096;
            for i in 0..n {
                let wavelengths = density.sample((i as f32 + 0.5) / n as f32);
                let radiance = SampledSpectrum::from_fn(|k| wavelengths.lambda_nm[k] / 1000.0);
                let place = SamplePlace { pixel: [0, 0], offset: None, replicate: i % 2, weight: 1.0 };
                tile.add(sensor, &filter, &place, &wavelengths, radiance);
                sensor.weights(&wavelengths, &mut weights);
                splats.begin(&weights, radiance);
                splats.share(0, 1.0);
            }
            film.add_tiles(&[&tile]);
            film.camera_mut().weigh_open_stage([n as f64 / 2.0; 2], 1.0);
            (0..2).for_each(|r| film.add_splats(r, n as u64, 1.0, &splats));
            film.add_merged(0, &splats);
            film.add_merged(1, &splats);
            film
        };
        let (with, without) = (film_of(&sensor), film_of(&observer));
        assert_eq!((with.xyz(0), with.standard_error(0)), (without.xyz(0), without.standard_error(0)));
        assert_eq!(with.estimated_relative_mse(), without.estimated_relative_mse());
        for band in 0..7 {
            let (low, high) = edges(band);
            // Camera samples and light paths bring the mean once each, merging by passes of 4096 samples each.
            let mean = (low + high) / 2000.0;
            let found = with.value(0, PICTURE_CHANNELS + band);
            assert!((found / (mean * (2.0 + 4096.0)) - 1.0).abs() < 0.02, "band {band}: {found}");
        }
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
                let mut tile = CameraTile::new([-reach, rows.start], size, reach as u32, 3);
                for (y, x) in rows.flat_map(|y| (-reach..width as i32 + reach).map(move |x| (y, x))) {
                    for i in 0..n * n {
                        let offset = [i % n, i / n].map(|i| (i as f32 + 0.5) / n as f32);
                        let (px, py) = (x as f32 + offset[0], y as f32 + offset[1]);
                        let place = SamplePlace { pixel: [x, y], offset: Some(offset), replicate: i % 2, weight: 1.0 };
                        tile.add_known(&filter, place, &[1.0, light(px, py), 0.0]);
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
