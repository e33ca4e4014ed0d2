//! Camera samples of a part of the picture, on their way to the film.

use super::{CAMERA_REPLICATES, Filter, PICTURE_CHANNELS, Sensor, sensor};
use crate::spectrum::{SampledSpectrum, Wavelengths};

/// Numbers that a pixel has in the sums of camera samples: what samples count in it times their value, by replicate and
/// channel, and behind them what samples count, by replicate.
pub(super) const fn stride(channels: usize) -> usize {
    CAMERA_REPLICATES * (channels + 1)
}

/// Where a camera sample belongs.
#[derive(Debug, Clone, Copy)]
pub struct SamplePlace {
    /// Column and row of the pixel in whose square it was taken; may lie beyond the film.
    pub pixel: [i32; 2],
    /// Where, from the corner of the pixel; `None` if the sample was placed by the pixel's filter and counts there alone.
    pub offset: Option<[f32; 2]>,
    /// Its replicate.
    pub replicate: usize,
    /// What it counts.
    pub weight: f64,
}

/// Sums of camera samples in the pixels that they count in: those of a rectangle of the film, and what their filter reaches.
#[derive(Debug, Clone)]
pub struct CameraTile {
    /// The first pixel, which may lie beyond the film.
    pub(super) corner: [i32; 2],
    pub(super) size: [u32; 2],
    pub(super) sums: Vec<f64>,
    /// Memory for the values of a sample and the sensor's weights.
    values: Vec<f64>,
    weights: Vec<SampledSpectrum>,
    /// Samples that were not finite, and left out.
    pub non_finite: u64,
}

impl CameraTile {
    /// For samples of so many channels in the squares of `size` pixels from `corner` on, and a filter that reaches so far
    /// beyond.
    pub fn new(corner: [i32; 2], size: [u32; 2], reach: u32, channels: usize) -> Self {
        let size = size.map(|size| size + 2 * reach);
        Self {
            corner: corner.map(|first| first - reach as i32),
            size,
            sums: vec![0.0; (size[0] * size[1]) as usize * stride(channels)],
            values: vec![0.0; channels],
            weights: Vec::with_capacity(channels),
            non_finite: 0,
        }
    }

    /// Adds the radiance that a sample has found. Every pixel whose filter reaches it gets its share.
    #[inline]
    pub fn add(
        &mut self,
        sensor: &Sensor,
        filter: &Filter,
        place: &SamplePlace,
        wavelengths: &Wavelengths,
        radiance: SampledSpectrum,
    ) {
        if radiance.is_zero() {
            self.values.fill(0.0);
        } else {
            sensor.weights(wavelengths, &mut self.weights);
            let values = self.values.iter_mut().zip(&self.weights);
            values.for_each(|(value, &weights)| *value = sensor::value(weights, radiance));
        }
        self.add_values(filter, place);
    }

    /// Adds the values in `self.values`.
    #[inline]
    fn add_values(&mut self, filter: &Filter, place: &SamplePlace) {
        // A sample that is not finite counts, but its light is lost.
        if !self.values.iter().all(|v| v.is_finite()) {
            self.non_finite += 1;
            self.values.fill(0.0);
        }
        match <[f64; PICTURE_CHANNELS]>::try_from(self.values.as_slice()) {
            Ok(values) => deposit(&mut self.sums, self.corner, self.size, &values, filter, place),
            Err(_) => deposit(&mut self.sums, self.corner, self.size, self.values.as_slice(), filter, place),
        }
    }
}

/// Adds values to the pixels that they count in. Their number is known to the compiler where they come as an array.
#[inline(always)]
fn deposit(
    sums: &mut [f64],
    corner: [i32; 2],
    size: [u32; 2],
    values: &(impl AsRef<[f64]> + ?Sized),
    filter: &Filter,
    place: &SamplePlace,
) {
    let values = values.as_ref();
    let (channels, stride) = (values.len(), stride(values.len()));
    let mut add = |pixel: usize, weight: f64| {
        let sums = &mut sums[pixel * stride..][..stride];
        let of_replicate = &mut sums[place.replicate * channels..][..channels];
        of_replicate.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
        sums[CAMERA_REPLICATES * channels + place.replicate] += weight;
    };
    let pixel = [0, 1].map(|axis| place.pixel[axis] - corner[axis]);
    let Some(offset) = place.offset else {
        return add(pixel[1] as usize * size[0] as usize + pixel[0] as usize, place.weight);
    };
    let position = [0, 1].map(|axis| pixel[axis] as f32 + offset[axis]);
    filter.splat(position, size[0], size[1], |x, y, share| {
        add((y * size[0] + x) as usize, place.weight * f64::from(share));
    });
}

#[cfg(test)]
impl CameraTile {
    /// Adds a sample whose values are known.
    pub fn add_known(&mut self, filter: &Filter, place: SamplePlace, values: &[f64]) {
        self.values.copy_from_slice(values);
        self.add_values(filter, &place);
    }

    /// Adds a sample whose values are known to one pixel.
    pub fn add_to_pixel(&mut self, pixel: [i32; 2], replicate: usize, values: &[f64]) {
        let place = SamplePlace { pixel, offset: None, replicate, weight: 1.0 };
        self.add_known(&Filter::boxed(0.5), place, values);
    }
}
