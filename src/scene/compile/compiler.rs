//! What every step of compiling a scene works with.

use super::normalize::Normalization;
use super::spectra::Spectra;
use crate::scene::description::SceneDescription;

/// A scene in the making: the description, what it is normalised by, its spectra, and what deserves a look.
pub struct Compiler<'a> {
    pub description: &'a SceneDescription,
    pub normalization: Normalization,
    pub spectra: Spectra<'a>,
    pub warnings: Vec<String>,
}

impl<'a> Compiler<'a> {
    /// Starts with the warnings that there are already.
    pub fn new(description: &'a SceneDescription, normalization: Normalization, warnings: Vec<String>) -> Self {
        Self { description, normalization, spectra: Spectra::new(description), warnings }
    }

    /// Warns about a place of the description.
    pub fn warn(&mut self, at: &str, text: &str) {
        self.warnings.push(format!("{}: {at}: {text}", self.description.file.display()));
    }
}
