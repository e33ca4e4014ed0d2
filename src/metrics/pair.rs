//! Two pictures of the same size and the pixels that count.

use crate::{Error, ErrorKind, Image, Result};

/// A picture and its reference, of three linear values each pixel: X, Y, Z or red, green, blue.
#[derive(Debug, Clone)]
pub struct Pair<'a> {
    size: [u32; 2],
    test: &'a [[f64; 3]],
    reference: &'a [[f64; 3]],
    counted: Vec<bool>,
    count: usize,
    non_finite: [usize; 2],
    mean: f64,
}

impl<'a> Pair<'a> {
    /// Compares two pictures. Where a mask is given, row by row, only the pixels at which it is true count.
    ///
    /// # Errors
    /// [`ErrorKind::Degenerate`] for pictures of other than three channels, for pictures or masks that differ in size, and where
    /// nothing is left to compare.
    pub fn new(test: &'a Image, reference: &'a Image, mask: Option<&[bool]>) -> Result<Self> {
        let bad = |message: String| Err(Error::new(ErrorKind::Degenerate, message));
        if let Some(odd) = [test, reference].into_iter().find(|picture| picture.channels().len() != 3) {
            return bad(format!("the channels {}; expected three", odd.channels().join(", ")));
        }
        let size = test.size();
        if size != reference.size() {
            let [[a, b], [c, d]] = [size, reference.size()];
            return bad(format!("{a}x{b} pixels against {c}x{d} of the reference; expected as many"));
        }
        let (test, reference) = (test.triples(), reference.triples());
        if let Some(mask) = mask.filter(|mask| mask.len() != test.len()) {
            return bad(format!("a mask of {} pixels for pictures of {}; expected as many", mask.len(), test.len()));
        }
        let finite = |pixel: &[f64; 3]| pixel.iter().all(|v| v.is_finite());
        let wanted = |i: usize| mask.is_none_or(|mask| mask[i]);
        let mut non_finite = [0; 2];
        let counted: Vec<bool> = (0..test.len())
            .map(|i| {
                let good = [test, reference].map(|picture| finite(&picture[i]));
                (0..2).for_each(|p| non_finite[p] += usize::from(wanted(i) && !good[p]));
                wanted(i) && good == [true; 2]
            })
            .collect();
        let count = counted.iter().filter(|&&c| c).count();
        if count == 0 {
            let why =
                if mask.is_some() { "the mask leaves no finite pixel" } else { "no pixel is finite in both pictures" };
            return bad(format!("{why}; expected something to compare"));
        }
        let sum: f64 = reference.iter().zip(&counted).filter(|(_, c)| **c).flat_map(|(r, _)| r).sum();
        Ok(Self { size, test, reference, counted, count, non_finite, mean: sum / (3 * count) as f64 })
    }

    /// Returns the numbers of pixels in a row and of rows.
    pub(super) fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Returns the number of pixels that count.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Returns the mean of the reference over all pixels that count and all channels.
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// Returns how many pixels inside the mask are NaN or infinite, in the picture and in the reference.
    pub fn non_finite(&self) -> [usize; 2] {
        self.non_finite
    }

    /// Iterates over all pixels of picture and reference, each with whether it counts.
    pub fn all(&self) -> impl ExactSizeIterator<Item = (bool, &'a [f64; 3], &'a [f64; 3])> {
        let pixels = self.test.iter().zip(self.reference);
        self.counted.iter().zip(pixels).map(|(&counted, (test, reference))| (counted, test, reference))
    }

    /// Iterates over the pixels of picture and reference that count.
    pub fn pixels(&self) -> impl Iterator<Item = (&'a [f64; 3], &'a [f64; 3])> {
        self.all().filter(|(counted, ..)| *counted).map(|(_, test, reference)| (test, reference))
    }

    /// Makes a picture of one channel from a value for each pixel that counts; the other pixels are 0.
    pub(super) fn map(&self, channel: &str, value: impl Fn(&[f64; 3], &[f64; 3]) -> f64) -> Image {
        let values = self.all().map(|(counted, test, reference)| if counted { value(test, reference) } else { 0.0 });
        Image::new(self.size, &[channel], values.collect())
    }

    /// Chooses the values at the pixels that count from values of all pixels.
    pub(super) fn counted_values(&self, values: impl Iterator<Item = f64>) -> impl Iterator<Item = f64> {
        values.zip(&self.counted).filter(|(_, counted)| **counted).map(|(value, _)| value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_counts() {
        let (nan, one) = ([0.0, f64::NAN, 0.0], [1.0, 2.0, 3.0]);
        let image = |pixels| Image::xyz(2, pixels).unwrap();
        let (test, reference) = ([one, nan, one, one], [one, one, [f64::INFINITY; 3], [4.0; 3]]);
        let (test, reference) = (image(test.into()), image(reference.into()));
        let pair = Pair::new(&test, &reference, None).unwrap();
        assert_eq!((pair.count(), pair.non_finite(), pair.mean()), (2, [1, 1], 3.0));
        let mask = [false, false, true, true];
        let pair = Pair::new(&test, &reference, Some(&mask)).unwrap();
        assert_eq!((pair.count(), pair.non_finite(), pair.mean()), (1, [0, 1], 4.0));
        assert_eq!(pair.map("Z", |t, _| t[2]), Image::new([2, 2], &["Z"], vec![0.0, 0.0, 0.0, 3.0]));
    }

    #[test]
    fn refuses_what_cannot_be_compared() {
        let image = |value: f64, count| Image::xyz(3, vec![[value; 3]; count]).unwrap();
        let (one, short, grey) = (image(1.0, 6), image(1.0, 3), Image::new([3, 2], &["Y"], vec![1.0; 6]));
        let message = |result: Result<Pair>| result.unwrap_err().to_string();
        assert!(message(Pair::new(&one, &grey, None)).contains("the channels Y; expected three"));
        assert!(message(Pair::new(&one, &short, None)).contains("3x2 pixels against 3x1"));
        assert!(message(Pair::new(&one, &one, Some(&[true; 4]))).contains("mask of 4"));
        assert!(message(Pair::new(&one, &one, Some(&[false; 6]))).contains("the mask leaves"));
        assert!(message(Pair::new(&one, &image(f64::NAN, 6), None)).contains("no pixel is finite"));
    }
}
