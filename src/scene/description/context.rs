//! What reading a value needs to know of the rest of the file, and what it leaves for the end.

use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::path::PathBuf;

use super::text::quote;
use crate::{Error, ErrorKind, Result};

/// Longest name that is compared with the valid ones: the comparison's time grows with the square of it.
const MAX_COMPARED: usize = 64;

/// Names, folder and warnings of a file.
#[derive(Debug, Default)]
pub struct Context {
    /// Folder of the scene file.
    pub folder: PathBuf,
    /// Names of spectra.
    pub spectra: RefCell<Names>,
    /// What each named spectrum spans, as far as that is known without reading files.
    pub extents: RefCell<Vec<Option<Extent>>>,
    /// Names of materials.
    pub materials: RefCell<Names>,
    /// Values of all tables so far.
    pub knots: Cell<usize>,
    /// What deserves a look but is no error.
    pub warnings: RefCell<Vec<String>>,
}

/// The span of a spectrum's values.
#[derive(Debug, Clone)]
pub struct Extent {
    /// Least value.
    pub low: f64,
    /// Greatest value.
    pub high: f64,
    /// Place of the least value.
    pub low_at: String,
    /// Place of the greatest value.
    pub high_at: String,
    /// Whether it is a colour to be upsampled.
    pub is_rgb: bool,
}

/// The user's names of one kind of thing.
#[derive(Debug, Default)]
pub struct Names {
    names: Vec<String>,
    index: HashMap<String, usize>,
    used: Vec<bool>,
}

impl Names {
    /// Takes names in file order; each is given once.
    pub fn new(names: impl Iterator<Item = String>) -> Self {
        let names: Vec<String> = names.collect();
        let index = names.iter().enumerate().map(|(i, name)| (name.clone(), i)).collect();
        Self { used: vec![false; names.len()], names, index }
    }

    /// Finds a name and marks it as used; `what` is "spectrum", `of` the key that holds the names.
    pub fn find(&mut self, name: &str, what: &str, of: &str, at: &str) -> Result<usize> {
        if let Some(&index) = self.index.get(name) {
            self.used[index] = true;
            return Ok(index);
        }
        let expected = match self.names.is_empty() {
            true => format!("the file has no `{of}`"),
            false => format!("expected one of `{of}`"),
        };
        let message = format!("no {what} named {}; {expected}", quote(name));
        let error = Error::new(ErrorKind::UnknownName, message).at(at);
        Err(with_nearest(error, name, self.names.iter().map(String::as_str)))
    }

    /// Indices of the names that nothing refers to.
    pub fn unused(&self) -> impl Iterator<Item = usize> {
        self.used.iter().enumerate().filter(|(_, used)| !**used).map(|(i, _)| i)
    }
}

/// Adds the candidate nearest to `name`, if the name is short enough to be one with a slip in it.
pub fn with_nearest<'a>(error: Error, name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Error {
    if name.len() <= MAX_COMPARED { error.nearest(name, candidates) } else { error }
}
