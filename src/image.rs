//! Pictures of numbers.

use crate::{Error, ErrorKind, Result};

/// A picture with any number of named channels: one value for each of them in every pixel, row by row from the top left.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    size: [u32; 2],
    channels: Vec<String>,
    values: Vec<f64>,
}

impl Image {
    /// Makes a picture of `size` = \[width, height\] from all values of its first pixel, then all of the second, …
    ///
    /// # Panics
    /// If there are not as many values as pixels times channels.
    pub fn new(size: [u32; 2], channels: &[&str], values: Vec<f64>) -> Self {
        let [width, height] = size.map(|n| n as usize);
        assert_eq!(values.len(), width * height * channels.len(), "values of {width}x{height} pixels in {channels:?}");
        Self { size, channels: channels.iter().map(|&name| name.to_owned()).collect(), values }
    }

    /// Makes a picture with the channels X, Y and Z from its pixels.
    ///
    /// # Errors
    /// [`ErrorKind::Degenerate`] for pixels that do not fill rows of this width, or that are none.
    pub fn xyz(width: u32, pixels: Vec<[f64; 3]>) -> Result<Self> {
        if width == 0 || pixels.is_empty() || !pixels.len().is_multiple_of(width as usize) {
            let message = format!("{} pixels in rows of {width}; expected a rectangle", pixels.len());
            return Err(Error::new(ErrorKind::Degenerate, message));
        }
        let height = (pixels.len() / width as usize) as u32;
        Ok(Self::new([width, height], &["X", "Y", "Z"], pixels.into_flattened()))
    }

    /// Returns the numbers of pixels in a row and of rows.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Returns the names of the channels.
    pub fn channels(&self) -> &[String] {
        &self.channels
    }

    /// Iterates over the pixels, each with a value for every channel.
    pub fn pixels(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.values.chunks_exact(self.channels.len())
    }

    /// Returns the pixels of a picture with three channels.
    ///
    /// # Panics
    /// If there is another number of channels.
    pub fn triples(&self) -> &[[f64; 3]] {
        assert_eq!(self.channels.len(), 3, "channels {:?}", self.channels);
        self.values.as_chunks().0
    }

    /// Iterates over the values of one channel, given by its index.
    pub fn plane(&self, channel: usize) -> impl ExactSizeIterator<Item = f64> {
        self.pixels().map(move |pixel| pixel[channel])
    }

    /// Makes a picture by applying a function to every value.
    pub fn map(&self, value: impl Fn(f64) -> f64) -> Self {
        Self {
            size: self.size,
            channels: self.channels.clone(),
            values: self.values.iter().map(|v| value(*v)).collect(),
        }
    }

    /// Makes a picture by applying a function to every value and the one at its place in another picture of the same size and
    /// number of channels.
    ///
    /// # Panics
    /// If the other picture has another size or number of channels.
    pub fn zip_with(&self, other: &Self, value: impl Fn(f64, f64) -> f64) -> Self {
        assert_eq!(
            (self.size, self.channels.len()),
            (other.size, other.channels.len()),
            "sizes and numbers of channels"
        );
        let values = self.values.iter().zip(&other.values).map(|(a, b)| value(*a, *b)).collect();
        Self { size: self.size, channels: self.channels.clone(), values }
    }

    /// Makes a picture that has the channels of this one and then those of another of the same size.
    ///
    /// # Panics
    /// If the other picture has another size.
    pub fn beside(&self, other: &Self) -> Self {
        assert_eq!(self.size, other.size, "sizes");
        let values = self.pixels().zip(other.pixels()).flat_map(|(a, b)| a.iter().chain(b)).copied().collect();
        Self { size: self.size, channels: [self.channels.as_slice(), &other.channels].concat(), values }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channels_and_values_stay_together() {
        let depth = Image::new([2, 2], &["Z"], vec![1.0, 2.0, 3.0, 4.0]);
        let both = depth.beside(&Image::new([2, 2], &["U", "V"], (10..18).map(f64::from).collect()));
        assert_eq!((both.size(), both.channels()), ([2, 2], ["Z", "U", "V"].map(String::from).as_slice()));
        assert_eq!(both.triples()[2], [3.0, 14.0, 15.0]);
        assert_eq!(both.plane(1).collect::<Vec<_>>(), [10.0, 12.0, 14.0, 16.0]);
        assert_eq!(depth.map(|v| v * v).pixels().collect::<Vec<_>>(), [[1.0], [4.0], [9.0], [16.0]]);
        assert_eq!(depth.zip_with(&depth, |a, b| a - b), depth.map(|_| 0.0));
    }

    #[test]
    fn refuses_what_is_no_rectangle() {
        let message = |width, count| Image::xyz(width, vec![[1.0; 3]; count]).unwrap_err().to_string();
        assert!(message(4, 6).contains("6 pixels in rows of 4"));
        assert!(message(0, 6).contains("rectangle") && message(4, 0).contains("rectangle"));
        assert_eq!(Image::xyz(3, vec![[1.0; 3]; 6]).unwrap().size(), [3, 2]);
    }
}
