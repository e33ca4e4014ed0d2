//! Two pictures of the same size and the pixels that count.

use crate::{Error, ErrorKind, Result};

/// Three linear values: X, Y, Z or red, green, blue.
pub type Pixel = [f64; 3];

/// A picture and its reference.
#[derive(Debug, Clone)]
pub struct Pair<'a> {
    width: usize,
    test: &'a [Pixel],
    reference: &'a [Pixel],
    counted: Vec<bool>,
    count: usize,
    non_finite: [usize; 2],
    mean: f64,
}

impl<'a> Pair<'a> {
    /// Both row by row. Where a mask is given, only the pixels at which it is true count.
    ///
    /// # Errors
    /// [`ErrorKind::Degenerate`] for pictures or masks that differ in size, are no rectangle, or leave nothing to compare.
    pub fn new(width: u32, test: &'a [Pixel], reference: &'a [Pixel], mask: Option<&[bool]>) -> Result<Self> {
        let width = width as usize;
        let bad = |message: String| Err(Error::new(ErrorKind::Degenerate, message));
        if width == 0 || test.is_empty() || !test.len().is_multiple_of(width) {
            return bad(format!("{} pixels in rows of {width}; expected a rectangle", test.len()));
        }
        if test.len() != reference.len() {
            return bad(format!(
                "{} pixels against {} of the reference; expected as many",
                test.len(),
                reference.len()
            ));
        }
        if let Some(mask) = mask.filter(|mask| mask.len() != test.len()) {
            return bad(format!("a mask of {} pixels for pictures of {}; expected as many", mask.len(), test.len()));
        }
        let finite = |pixel: &Pixel| pixel.iter().all(|v| v.is_finite());
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
        Ok(Self { width, test, reference, counted, count, non_finite, mean: sum / (3 * count) as f64 })
    }

    /// Pixels a row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Pixels that count.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Mean of the reference over all pixels that count and all channels.
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// Pixels inside the mask that are NaN or infinite, in the picture and in the reference.
    pub fn non_finite(&self) -> [usize; 2] {
        self.non_finite
    }

    /// All pixels, with whether they count.
    pub fn all(&self) -> impl ExactSizeIterator<Item = (bool, &'a Pixel, &'a Pixel)> {
        let pixels = self.test.iter().zip(self.reference);
        self.counted.iter().zip(pixels).map(|(&counted, (test, reference))| (counted, test, reference))
    }

    /// The pixels that count: picture and reference.
    pub fn pixels(&self) -> impl Iterator<Item = (&'a Pixel, &'a Pixel)> {
        self.all().filter(|(counted, ..)| *counted).map(|(_, test, reference)| (test, reference))
    }

    /// A value for each pixel that counts, and 0 elsewhere: a map of the picture's size.
    pub(super) fn map(&self, value: impl Fn(&Pixel, &Pixel) -> f64) -> Vec<f64> {
        self.all().map(|(counted, test, reference)| if counted { value(test, reference) } else { 0.0 }).collect()
    }

    /// The values of a map at the pixels that count.
    pub(super) fn counted_values<'m>(&'m self, map: &'m [f64]) -> impl Iterator<Item = f64> + 'm {
        map.iter().zip(&self.counted).filter(|(_, counted)| **counted).map(|(value, _)| *value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_counts() {
        let (nan, one) = ([0.0, f64::NAN, 0.0], [1.0, 2.0, 3.0]);
        let (test, reference) = ([one, nan, one, one], [one, one, [f64::INFINITY; 3], [4.0; 3]]);
        let pair = Pair::new(2, &test, &reference, None).unwrap();
        assert_eq!((pair.count(), pair.non_finite(), pair.mean()), (2, [1, 1], 3.0));
        let mask = [false, false, true, true];
        let pair = Pair::new(2, &test, &reference, Some(&mask)).unwrap();
        assert_eq!((pair.count(), pair.non_finite(), pair.mean()), (1, [0, 1], 4.0));
        assert_eq!(pair.map(|t, _| t[2]), [0.0, 0.0, 0.0, 3.0]);
    }

    #[test]
    fn refuses_what_cannot_be_compared() {
        let pixels = [[1.0; 3]; 6];
        let message = |result: Result<Pair>| result.unwrap_err().to_string();
        assert!(message(Pair::new(4, &pixels, &pixels, None)).contains("rows of 4"));
        assert!(message(Pair::new(0, &pixels, &pixels, None)).contains("rectangle"));
        assert!(message(Pair::new(3, &pixels, &pixels[..3], None)).contains("6 pixels against 3"));
        assert!(message(Pair::new(3, &pixels, &pixels, Some(&[true; 4]))).contains("mask of 4"));
        assert!(message(Pair::new(3, &pixels, &pixels, Some(&[false; 6]))).contains("the mask leaves"));
        let nothing = [[f64::NAN; 3]; 6];
        assert!(message(Pair::new(3, &pixels, &nothing, None)).contains("no pixel is finite"));
    }
}
