//! Camera samples of a part of the picture, on their way to the film.

use super::{CAMERA_REPLICATES, Filter, Xyz};

/// Sums of camera samples in a pixel, by replicate.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct CameraSums {
    /// What samples count in the pixel, times their XYZ.
    pub xyz: [Xyz; CAMERA_REPLICATES],
    /// What they count.
    pub weights: [f64; CAMERA_REPLICATES],
}

impl CameraSums {
    #[inline]
    fn add_sample(&mut self, replicate: usize, weight: f64, xyz: Xyz) {
        let sum = &mut self.xyz[replicate];
        (0..3).for_each(|c| sum[c] += weight * xyz[c]);
        self.weights[replicate] += weight;
    }

    /// Adds other samples of the pixel.
    pub fn add(&mut self, other: &Self) {
        for r in 0..CAMERA_REPLICATES {
            (0..3).for_each(|c| self.xyz[r][c] += other.xyz[r][c]);
            self.weights[r] += other.weights[r];
        }
    }
}

/// Sums of camera samples in the pixels that they count in: those of a rectangle of the film, and what their filter reaches.
#[derive(Debug, Clone)]
pub struct CameraTile {
    /// The first pixel, which may lie beyond the film.
    pub(super) corner: [i32; 2],
    pub(super) size: [u32; 2],
    pub(super) sums: Vec<CameraSums>,
    /// Samples that were not finite, and left out.
    pub non_finite: u64,
}

impl CameraTile {
    /// For samples in the squares of `size` pixels from `corner` on, and a filter that reaches so far beyond.
    pub fn new(corner: [i32; 2], size: [u32; 2], reach: u32) -> Self {
        let size = size.map(|size| size + 2 * reach);
        Self {
            corner: corner.map(|first| first - reach as i32),
            size,
            sums: vec![CameraSums::default(); (size[0] * size[1]) as usize],
            non_finite: 0,
        }
    }

    /// Adds a sample that counts `weight`, at an offset from the corner of a pixel's square. Every pixel whose filter reaches it
    /// gets its share.
    #[inline]
    pub fn add(
        &mut self,
        filter: &Filter,
        (pixel, offset): ([i32; 2], [f32; 2]),
        replicate: usize,
        (weight, xyz): (f64, Xyz),
    ) {
        let xyz = self.checked(xyz);
        let position = [0, 1].map(|axis| (pixel[axis] - self.corner[axis]) as f32 + offset[axis]);
        let ([width, height], sums) = (self.size, &mut self.sums);
        filter.splat(position, width, height, |x, y, share| {
            sums[(y * width + x) as usize].add_sample(replicate, weight * f64::from(share), xyz);
        });
    }

    /// Adds a sample that was placed by a pixel's filter: to that pixel alone.
    pub fn add_to_pixel(&mut self, pixel: [i32; 2], replicate: usize, (weight, xyz): (f64, Xyz)) {
        let xyz = self.checked(xyz);
        let [x, y] = [0, 1].map(|axis| (pixel[axis] - self.corner[axis]) as u32);
        self.sums[(y * self.size[0] + x) as usize].add_sample(replicate, weight, xyz);
    }

    /// The light of a sample, none if it is not finite: it counts, but its light is lost.
    fn checked(&mut self, xyz: Xyz) -> Xyz {
        let finite = xyz.iter().all(|v| v.is_finite());
        self.non_finite += u64::from(!finite);
        if finite { xyz } else { Xyz::default() }
    }
}
