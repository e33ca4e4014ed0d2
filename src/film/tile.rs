//! Camera samples of a part of the picture, on their way to the film.

use super::{CAMERA_REPLICATES, Filter, Xyz};

/// Sums of XYZ in each replicate.
pub type CameraSums = [Xyz; CAMERA_REPLICATES];

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

    /// Adds a sample at an offset from the corner of a pixel's square. Every pixel whose filter reaches it gets its share.
    #[inline]
    pub fn add(&mut self, filter: &Filter, pixel: [i32; 2], offset: [f32; 2], replicate: usize, xyz: Xyz) {
        if !self.check(xyz) {
            return;
        }
        let position = [0, 1].map(|axis| (pixel[axis] - self.corner[axis]) as f32 + offset[axis]);
        let ([width, height], sums) = (self.size, &mut self.sums);
        filter.splat(position, width, height, |x, y, weight| {
            let sum = &mut sums[(y * width + x) as usize][replicate];
            (0..3).for_each(|c| sum[c] += f64::from(weight) * xyz[c]);
        });
    }

    /// Adds a sample that was placed by a pixel's filter: to that pixel alone.
    pub fn add_to_pixel(&mut self, pixel: [i32; 2], replicate: usize, xyz: Xyz) {
        if self.check(xyz) {
            let [x, y] = [0, 1].map(|axis| (pixel[axis] - self.corner[axis]) as u32);
            let sum = &mut self.sums[(y * self.size[0] + x) as usize][replicate];
            (0..3).for_each(|c| sum[c] += xyz[c]);
        }
    }

    fn check(&mut self, xyz: Xyz) -> bool {
        let finite = xyz.iter().all(|v| v.is_finite());
        self.non_finite += u64::from(!finite);
        finite
    }
}
