//! Finds the channels of a file that are its picture.

use super::spectral;
use crate::{Error, ErrorKind, Result};
use exr::meta::header::Header;
use std::collections::BTreeMap;

/// What to read where a file describes the same picture several times, by different channels.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Preference {
    /// X, Y, Z if they are there, else the spectral layout, else R, G, B.
    #[default]
    Xyz,
    /// R, G, B if they are there, else X, Y, Z, else the spectral layout.
    Rgb,
}

/// The channels that a picture is made of, by their index in a part.
#[derive(Debug, Clone, PartialEq)]
pub enum Colors {
    /// X, Y, Z.
    Xyz([usize; 3]),
    /// R, G, B.
    Rgb([usize; 3]),
    /// Emissive spectral channels, by ascending wavelength.
    Spectral {
        /// Indices of the channels.
        indices: Vec<usize>,
        /// Wavelengths of the channels, in nm.
        lambdas_nm: Vec<f64>,
    },
}

/// A picture that a file could mean.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// Index of the part.
    pub part: usize,
    /// What stands before the channels' names: empty or `layer.`.
    pub prefix: String,
    /// Channels that the picture is made of.
    pub colors: Colors,
}

impl Candidate {
    /// Iterates over the indices of the candidate's channels.
    pub fn indices(&self) -> impl Iterator<Item = usize> + '_ {
        let indices: &[usize] = match &self.colors {
            Colors::Xyz(indices) | Colors::Rgb(indices) => indices,
            Colors::Spectral { indices, .. } => indices,
        };
        indices.iter().copied()
    }

    /// Ranks the kind of channels by a preference; the lowest rank is read.
    fn rank(&self, preference: Preference) -> usize {
        match (&self.colors, preference) {
            (Colors::Xyz(_), Preference::Xyz) | (Colors::Rgb(_), Preference::Rgb) => 0,
            (Colors::Spectral { .. }, Preference::Xyz) | (Colors::Xyz(_), Preference::Rgb) => 1,
            _ => 2,
        }
    }
}

/// Chooses the one picture of a file, or of the layer of it that is named.
pub fn choose(parts: &[Header], preference: Preference, layer: Option<&str>) -> Result<Candidate> {
    let part_name = |part: usize| parts[part].own_attributes.layer_name.as_ref().map(|name| name.to_string());
    let mut all: Vec<Candidate> = (0..parts.len()).flat_map(|part| candidates(parts, part)).collect();
    match layer {
        Some(name) => all.retain(|c| c.prefix == format!("{name}.") || part_name(c.part).as_deref() == Some(name)),
        // X, Y, Z with a name before them are vectors, such as normals, unless asked for.
        None => all.retain(|c| c.prefix.is_empty() || !matches!(c.colors, Colors::Xyz(_))),
    }
    // A picture without a name before its channels is the main one.
    if all.iter().any(|c| c.prefix.is_empty()) {
        all.retain(|c| c.prefix.is_empty());
    }
    let mut places: Vec<(usize, &str)> = all.iter().map(|c| (c.part, c.prefix.as_str())).collect();
    places.dedup();
    if places.len() > 1 {
        let name = |&(part, prefix): &(usize, &str)| match prefix.strip_suffix('.') {
            Some(prefix) => prefix.to_owned(),
            None => part_name(part).unwrap_or_else(|| format!("(part {part} without a name)")),
        };
        let names: Vec<String> = places.iter().map(name).collect();
        let message = format!("several pictures: {}; expected one of them to be asked for", names.join(", "));
        return Err(Error::new(ErrorKind::Usage, message));
    }
    all.into_iter().min_by_key(|c| c.rank(preference)).ok_or_else(|| nothing(parts, layer))
}

/// Lists the pictures that one part could mean. Those with the same prefix are next to each other.
fn candidates(parts: &[Header], part: usize) -> Vec<Candidate> {
    let names: Vec<String> = parts[part].channels.list.iter().map(|c| c.name.to_string()).collect();
    let mut found = Vec::new();
    for (kind, letters) in [["X", "Y", "Z"], ["R", "G", "B"]].into_iter().enumerate() {
        for prefix in names.iter().filter_map(|name| name.strip_suffix(letters[0])) {
            let whole_word = prefix.is_empty() || prefix.ends_with('.');
            let index = |letter: &str| names.iter().position(|name| *name == format!("{prefix}{letter}"));
            if let ([Some(a), Some(b), Some(c)], true) = (letters.map(index), whole_word) {
                let colors = if kind == 0 { Colors::Xyz([a, b, c]) } else { Colors::Rgb([a, b, c]) };
                found.push(Candidate { part, prefix: prefix.to_owned(), colors });
            }
        }
    }
    let mut bands: BTreeMap<String, Vec<(f64, usize)>> = BTreeMap::new();
    for (index, name) in names.iter().enumerate() {
        if let Some((prefix, lambda_nm)) = spectral::emissive_channel(name) {
            bands.entry(prefix.to_owned()).or_default().push((lambda_nm, index));
        }
    }
    for (prefix, mut bands) in bands {
        bands.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (lambdas_nm, indices) = bands.into_iter().unzip();
        found.push(Candidate { part, prefix, colors: Colors::Spectral { indices, lambdas_nm } });
    }
    found.sort_by(|a, b| a.prefix.cmp(&b.prefix));
    found
}

fn nothing(parts: &[Header], layer: Option<&str>) -> Error {
    const LISTED: usize = 12;
    let names: Vec<String> = parts.iter().flat_map(|part| &part.channels.list).map(|c| c.name.to_string()).collect();
    let mut list = names.iter().take(LISTED).map(String::as_str).collect::<Vec<_>>().join(", ");
    if names.len() > LISTED {
        list += ", …";
    }
    let where_ = layer.map_or(String::new(), |name| format!(" in the layer {name:?}"));
    let message = format!("no picture{where_}: the channels are {list}; expected X, Y, Z or R, G, B or S0.…nm");
    Error::new(ErrorKind::Missing, message)
}
