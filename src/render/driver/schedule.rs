//! The order of the work: segments, at whose ends all that is learnt during a render changes, and nowhere else. Which part of
//! each technique's work belongs to a number of samples depends on that number alone, so that a render stopped there,
//! by a clock or a target, has the bits of one that was asked for so many.

use super::allocation::Allocation;
use std::ops::Range;

/// Camera samples a pixel of the first segment; each of the following is as long as all before it.
const FIRST_SEGMENT: u64 = 4;

/// A stretch of a render with one split of the work.
#[derive(Debug, Clone, Default)]
pub struct Segment {
    /// Samples of each pixel, on average.
    pub samples: Range<u64>,
    /// The first light path.
    first_light_path: u64,
    /// Light paths for each sample of a pixel, all pixels taken together.
    light_paths_per_sample: f64,
    /// Weight of each light path, by which those of a segment count as much as its camera paths.
    pub light_weight: f64,
    /// Passes of merging that earlier segments have done, with the share of the next that is due.
    merged_before: f64,
    merge_passes_per_sample: f64,
}

/// Work done so far, or to be done.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Work {
    /// Samples of each pixel, on average.
    pub samples: u64,
    /// Light paths.
    pub light_paths: u64,
    /// Passes of merging, and the share of the next that is due.
    pub merging: f64,
}

impl Work {
    /// Passes of merging, of which none is late.
    pub fn merge_passes(&self) -> u64 {
        self.merging.ceil() as u64
    }
}

impl Segment {
    /// Makes the segment that goes from the work done so far to sample `end`.
    pub fn new(done: Work, end: u64, pixels: u64, allocation: Allocation) -> Self {
        Self {
            samples: done.samples..end,
            first_light_path: done.light_paths,
            light_paths_per_sample: pixels as f64 * allocation.light,
            light_weight: 1.0 / allocation.light,
            merged_before: done.merging,
            merge_passes_per_sample: allocation.merged,
        }
    }

    /// Samples that have been taken of this segment.
    pub fn taken(&self, samples: u64) -> u64 {
        samples - self.samples.start
    }

    /// Returns the work of all techniques that belongs to some samples a pixel.
    pub fn work(&self, samples: u64) -> Work {
        let taken = self.taken(samples) as f64;
        Work {
            samples,
            light_paths: self.first_light_path + (taken * self.light_paths_per_sample).round() as u64,
            merging: self.merged_before + taken * self.merge_passes_per_sample,
        }
    }
}

/// Returns the sample at which the segment ends that starts after `done` samples.
pub fn segment_end(done: u64) -> u64 {
    let mut end = FIRST_SEGMENT;
    while end <= done {
        end *= 2;
    }
    end
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segments() {
        let ends: Vec<u64> = [0, 3, 4, 7, 8, 31, 32, 99].into_iter().map(segment_end).collect();
        assert_eq!(ends, [4, 4, 8, 8, 16, 32, 64, 128]);
    }

    /// Light paths are in proportion to camera paths up to half a path, and passes of merging are never late; what is due of
    /// one at the end of a segment is not forgotten in the next.
    #[test]
    fn work_follows_samples() {
        let done = Work { samples: 8, light_paths: 100, merging: 1.625 };
        let segment = Segment::new(done, 16, 10, Allocation { light: 0.33, merged: 0.25 });
        assert_eq!(segment.work(8), done);
        assert_eq!(segment.work(9), Work { samples: 9, light_paths: 103, merging: 1.875 });
        assert_eq!(segment.work(16), Work { samples: 16, light_paths: 126, merging: 3.625 });
        let passes = [8, 9, 10, 13, 14, 16].map(|samples| segment.work(samples).merge_passes());
        assert_eq!(passes, [2, 2, 3, 3, 4, 4]);
    }
}
