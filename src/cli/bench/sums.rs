//! Sums over the pictures of several runs, from which mean and spread follow.

use crate::Image;

/// Sums of the values of pictures, and of the squares of these values.
#[derive(Debug)]
pub struct Sums {
    /// Number of pictures.
    pub runs: u32,
    /// Sum of the values.
    pub values: Image,
    /// Sum of the squares of the values.
    pub squares: Image,
}

impl Sums {
    /// Starts with no picture of a size.
    pub fn new([width, height]: [u32; 2]) -> Self {
        let zero = Image::new([width, height], &["X", "Y", "Z"], vec![0.0; 3 * width as usize * height as usize]);
        Self { runs: 0, values: zero.clone(), squares: zero }
    }

    /// Adds a picture in XYZ.
    pub fn add(&mut self, picture: &Image) {
        self.runs += 1;
        self.values = self.values.zip_with(picture, |sum, v| sum + v);
        self.squares = self.squares.zip_with(picture, |sum, v| sum + v * v);
    }

    /// Returns the mean of the pictures.
    pub fn mean(&self) -> Image {
        self.values.map(|sum| sum / f64::from(self.runs))
    }
}
