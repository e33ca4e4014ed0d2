//! Camera samples of a part of the picture, on their way to the film.

use super::{CAMERA_REPLICATES, Filter, PICTURE_CHANNELS, Sensor, sensor};
use crate::spectrum::{SampledSpectrum, Wavelengths};

/// Numbers that a pixel has in the sums of camera samples: for each replicate what samples count in it, and behind that what
/// they count times their value in each channel.
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
    /// Memory for 1 and the values of a sample, and for the sensor's weights.
    sample: Vec<f64>,
    weights: Vec<SampledSpectrum>,
    /// Samples that were not finite, and left out.
    pub non_finite: u64,
}

impl CameraTile {
    /// Makes room for samples of so many channels in the squares of `size` pixels from `corner` on, and a filter that reaches so far
    /// beyond.
    pub fn new(corner: [i32; 2], size: [u32; 2], reach: u32, channels: usize) -> Self {
        let size = size.map(|size| size + 2 * reach);
        Self {
            corner: corner.map(|first| first - reach as i32),
            size,
            sums: vec![0.0; (size[0] * size[1]) as usize * stride(channels)],
            sample: vec![1.0; channels + 1],
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
            self.sample[1..].fill(0.0);
        } else {
            sensor.weights(wavelengths, &mut self.weights);
            let values = self.sample[1..].iter_mut().zip(&self.weights);
            values.for_each(|(value, &weights)| *value = sensor::value(weights, radiance));
        }
        self.add_sample(filter, place);
    }

    /// Adds the values in `self.sample`.
    #[inline]
    fn add_sample(&mut self, filter: &Filter, place: &SamplePlace) {
        // A sample that is not finite counts, but its light is lost.
        if !self.sample.iter().all(|v| v.is_finite()) {
            self.non_finite += 1;
            self.sample[1..].fill(0.0);
        }
        match <[f64; PICTURE_CHANNELS + 1]>::try_from(self.sample.as_slice()) {
            Ok(sample) => deposit(&mut self.sums, self.corner, self.size, &sample, filter, place),
            Err(_) => deposit(&mut self.sums, self.corner, self.size, self.sample.as_slice(), filter, place),
        }
    }
}

/// Adds a sample to the pixels that it counts in. The number of its values is known to the compiler where it comes as an array.
#[inline(always)]
fn deposit(
    sums: &mut [f64],
    corner: [i32; 2],
    size: [u32; 2],
    sample: &(impl AsRef<[f64]> + ?Sized),
    filter: &Filter,
    place: &SamplePlace,
) {
    let sample = sample.as_ref();
    let mut add = |pixel: usize, weight: f64| {
        let first = (pixel * CAMERA_REPLICATES + place.replicate) * sample.len();
        let sums = &mut sums[first..][..sample.len()];
        sums.iter_mut().zip(sample).for_each(|(sum, value)| *sum += weight * value);
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
        self.sample[1..].copy_from_slice(values);
        self.add_sample(filter, &place);
    }

    /// Adds a sample whose values are known to one pixel.
    pub fn add_to_pixel(&mut self, pixel: [i32; 2], replicate: usize, values: &[f64]) {
        let place = SamplePlace { pixel, offset: None, replicate, weight: 1.0 };
        self.add_known(&Filter::boxed(0.5), place, values);
    }
}
