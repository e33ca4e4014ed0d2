//! Reads the YAML files of refractiveindex.info: a dispersion formula or a table of n, and often a table of k.

use std::fmt;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use serde::de::{Deserialize, Deserializer, IgnoredAny, MapAccess, Visitor};
use serde_saphyr::Spanned;

use crate::optics::dispersion::Dispersion;
use crate::optics::ior::IndexOfRefraction;
use crate::optics::table::Table;
use crate::{Error, ErrorKind, Result};

/// Larger files are refused; the largest of the database has 3 MB.
pub const MAX_FILE_BYTES: u64 = 64 << 20;

/// What a file says about a material.
#[derive(Debug, Clone, PartialEq)]
pub struct OpticalConstants {
    /// Real part of the index.
    pub n: IndexOfRefraction,
    /// Extinction coefficient, the imaginary part of the index, where the file has one. Its range may differ from n's.
    pub k: Option<Table>,
    /// Where the data come from, as plain text on one line; may be empty.
    pub references: String,
    /// Remarks on the sample and the measurement, as plain text on one line; may be empty.
    pub comments: String,
}

/// Reads a file.
///
/// # Errors
/// `FileNotFound`, `Io`, `LimitExceeded` above [`MAX_FILE_BYTES`], and those of [`parse`]; all name the file.
pub fn read(path: &Path) -> Result<OpticalConstants> {
    read_text(path).and_then(|text| parse(&text)).map_err(|error| error.in_file(path))
}

fn read_text(path: &Path) -> Result<String> {
    let cannot_read = |e: std::io::Error| Error::new(ErrorKind::Io, format!("cannot be read: {e}"));
    let file = File::open(path).map_err(|e| match e.kind() {
        std::io::ErrorKind::NotFound => Error::new(ErrorKind::FileNotFound, "no such file"),
        _ => cannot_read(e),
    })?;
    let mut bytes = Vec::new();
    file.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes).map_err(cannot_read)?;
    if bytes.len() as u64 > MAX_FILE_BYTES {
        let message =
            format!("the file is larger than {} MB: expected a refractiveindex.info file", MAX_FILE_BYTES >> 20);
        return Err(Error::new(ErrorKind::LimitExceeded, message));
    }
    String::from_utf8(bytes).map_err(|e| {
        let message = format!("byte {} is not UTF-8: expected a text file", e.utf8_error().valid_up_to());
        Error::new(ErrorKind::Syntax, message)
    })
}

/// Reads the text of a file. Places in errors are lines and keys, such as `line 9: DATA[0].coefficients`.
///
/// Of several blocks the one with n and the one with k are taken; two of either are an error, since the format does not
/// say which would count. Rows may stand in any order (some files have them by energy), and rows of one wavelength, which
/// a few published tables repeat, count as their mean.
///
/// # Errors
/// `Syntax` for text that is not YAML, `WrongType` for values of another type, `Missing` without DATA, without n, or
/// without a key that a block needs, `Duplicate`, `Unsupported` for another type of block or formula, `FileFormat` for
/// text where numbers belong, `NotFinite`, `OutOfRange`, `LimitExceeded` for absurdly large or nested YAML.
pub fn parse(text: &str) -> Result<OpticalConstants> {
    let options = serde_saphyr::options! { with_snippet: false };
    let document: Document = serde_saphyr::from_str_with_options(text, options).map_err(|e| from_yaml(&e))?;
    let blocks = document.data.ok_or_else(|| Error::new(ErrorKind::Missing, "expected the key DATA, found none"))?;
    let (mut n, mut k) = (None, None);
    for (i, block) in blocks.iter().enumerate() {
        let (block_n, block_k) = read_block(block, i)?;
        set_once(&mut n, block_n, block, i, "n")?;
        set_once(&mut k, block_k, block, i, "k")?;
    }
    let n = n.ok_or_else(|| {
        let message = "expected a block with the index n (formula, tabulated n or tabulated nk), found none";
        Error::new(ErrorKind::Missing, message).at("DATA")
    })?;
    let (references, comments) = (plain_text(&document.references), plain_text(&document.comments));
    Ok(OpticalConstants { n, k, references, comments })
}

fn set_once<T>(slot: &mut Option<T>, found: Option<T>, block: &Spanned<Block>, i: usize, what: &str) -> Result<()> {
    if found.is_some() && slot.is_some() {
        let message = format!("a second block with {what}: expected one");
        return Err(Error::new(ErrorKind::Duplicate, message).at(place(line_of(block), &format!("DATA[{i}]"))));
    }
    *slot = slot.take().or(found);
    Ok(())
}

/// Reads n and k from a block of DATA, those of them that it has.
fn read_block(block: &Spanned<Block>, i: usize) -> Result<(Option<IndexOfRefraction>, Option<Table>)> {
    let at = |key: &str| format!("DATA[{i}].{key}");
    let required = |value: &Option<Spanned<String>>, key: &str| {
        value.clone().ok_or_else(|| {
            let message = format!("expected the key {key}, found none");
            Error::new(ErrorKind::Missing, message).at(place(line_of(block), &format!("DATA[{i}]")))
        })
    };
    let kind = required(&block.value.kind, "type")?;
    let mut words = kind.value.split_whitespace();
    let unsupported = || {
        let message = format!(
            "{:?}: expected \"formula 1\" to \"formula 9\", \"tabulated n\", \"tabulated k\" or \"tabulated nk\"",
            shortened(&kind.value)
        );
        Error::new(ErrorKind::Unsupported, message).at(place(line_of(&kind), &at("type")))
    };
    match (words.next(), words.next(), words.next()) {
        (Some("formula"), Some(number), None) => {
            let number = number.parse().map_err(|_| unsupported())?;
            let coefficients = required(&block.value.coefficients, "coefficients")?;
            let range = required(&block.value.range, "wavelength_range")?;
            let range_nm = read_range_nm(&range).map_err(|e| e.at(place(line_of(&range), &at("wavelength_range"))))?;
            let formula = read_numbers(&coefficients.value)
                .and_then(|numbers| Dispersion::from_coefficients(number, &numbers))
                .map_err(|e| e.at(place(line_of(&coefficients), &at("coefficients"))))?;
            let n = IndexOfRefraction::formula(formula, range_nm);
            Ok((Some(n.map_err(|e| e.at(place(line_of(&range), &at("wavelength_range"))))?), None))
        }
        (Some("tabulated"), Some(columns @ ("n" | "k" | "nk")), None) => {
            let data = required(&block.value.data, "data")?;
            let tables = read_table(&data, columns.len(), &at("data"))?;
            let mut tables = tables.into_iter();
            let n = if columns.starts_with('n') { tables.next().map(IndexOfRefraction::Table) } else { None };
            Ok((n, tables.next()))
        }
        _ => Err(unsupported()),
    }
}

/// Parses a range: two wavelengths in µm, in either order.
fn read_range_nm(range: &Spanned<String>) -> Result<[f64; 2]> {
    match read_numbers(&range.value)?[..] {
        [a, b] => Ok([nm_from_um(a.min(b)), nm_from_um(a.max(b))]),
        ref numbers => {
            let message = format!("expected two wavelengths in µm, found {} numbers", numbers.len());
            Err(Error::new(ErrorKind::FileFormat, message))
        }
    }
}

fn read_numbers(text: &str) -> Result<Vec<f64>> {
    text.split_whitespace().map(read_number).collect()
}

fn read_number(word: &str) -> Result<f64> {
    match word.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        Ok(number) => Err(Error::new(ErrorKind::NotFinite, format!("found {number}, expected a finite number"))),
        Err(_) => Err(Error::new(ErrorKind::FileFormat, format!("found {:?}, expected a number", shortened(word)))),
    }
}

/// Parses a table of wavelengths (µm) and one or two more columns, and makes a table of each of these.
fn read_table(data: &Spanned<String>, columns: usize, key: &str) -> Result<Vec<Table>> {
    let mut rows: Vec<[f64; 3]> = Vec::new();
    for (i, line) in data.value.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        // The place of a block of text is its first line.
        let at_row = |e: Error| e.at(place(line_of(data) + i as u64, &format!("{key}, row {}", i + 1)));
        rows.push(read_row(line, columns).map_err(at_row)?);
    }
    rows.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let rows: Vec<[f64; 3]> = rows.chunk_by(|a, b| a[0] == b[0]).map(mean_row).collect();
    let column = |j: usize| rows.iter().map(|row| row[j]).collect::<Vec<f64>>();
    let tables: Result<_> = (1..=columns).map(|j| Table::new(column(0), column(j))).collect();
    tables.map_err(|e| e.at(place(line_of(data), key)))
}

/// Parses a row: the wavelength, which becomes nm, and two values. A single value stands for both.
fn read_row(line: &str, columns: usize) -> Result<[f64; 3]> {
    let numbers = read_numbers(line)?;
    if numbers.len() != columns + 1 {
        let (found, expected) = (numbers.len(), columns + 1);
        let message = format!("found {found} numbers, expected {expected}: the wavelength in µm and {columns} more");
        return Err(Error::new(ErrorKind::FileFormat, message));
    }
    if numbers[0] <= 0.0 {
        let message = format!("found the wavelength {} µm, expected more than 0", numbers[0]);
        return Err(Error::new(ErrorKind::OutOfRange, message));
    }
    Ok([nm_from_um(numbers[0]), numbers[1], numbers[columns]])
}

fn mean_row(rows: &[[f64; 3]]) -> [f64; 3] {
    let mean = |j: usize| rows.iter().map(|row| row[j] / rows.len() as f64).sum();
    [rows[0][0], mean(1), mean(2)]
}

fn nm_from_um(um: f64) -> f64 {
    um * 1e3
}

/// Removes HTML tags and line breaks from a text.
fn plain_text(html: &str) -> String {
    let mut text = String::new();
    let mut rest = html;
    while let Some((before, behind)) = rest.split_once('<') {
        text.push_str(before);
        // A tag begins with a letter or a slash; "<" in front of anything else is itself.
        match behind.split_once('>') {
            Some((tag, after)) if tag.starts_with(|c: char| c.is_ascii_alphabetic() || c == '/') => {
                if tag.starts_with("br") {
                    text.push(' ');
                }
                rest = after;
            }
            _ => {
                text.push('<');
                rest = behind;
            }
        }
    }
    text.push_str(rest);
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Returns the beginning of a text, for messages about what stands where a short text was expected.
fn shortened(text: &str) -> String {
    const LONGEST: usize = 40;
    if text.chars().count() <= LONGEST { text.to_owned() } else { text.chars().take(LONGEST).chain(['…']).collect() }
}

fn line_of<T>(value: &Spanned<T>) -> u64 {
    value.defined.line()
}

fn place(line: u64, key: &str) -> String {
    if line == 0 { key.to_owned() } else { format!("line {line}: {key}") }
}

/// Turns an error of the YAML reader into one of this crate: the first line of its message, and the line of the file.
fn from_yaml(error: &serde_saphyr::Error) -> Error {
    let text = error.to_string();
    let message = text.lines().next().unwrap_or_default().trim();
    let kind = match error {
        serde_saphyr::Error::Budget { .. } => ErrorKind::LimitExceeded,
        _ => ErrorKind::Syntax,
    };
    let place = error.location().map(|location| format!("line {}", location.line()));
    Error::new(kind, format!("{message}; expected a refractiveindex.info file")).at(place.unwrap_or_default())
}

/// The keys of a file that are read here.
#[derive(Default)]
struct Document {
    references: String,
    comments: String,
    data: Option<Vec<Spanned<Block>>>,
}

/// One entry of DATA; which keys it needs depends on its type.
#[derive(Default)]
struct Block {
    kind: Option<Spanned<String>>,
    range: Option<Spanned<String>>,
    coefficients: Option<Spanned<String>>,
    data: Option<Spanned<String>>,
}

impl<'de> Deserialize<'de> for Document {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        struct Keys;
        impl<'de> Visitor<'de> for Keys {
            type Value = Document;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a mapping with the key DATA")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> std::result::Result<Document, A::Error> {
                let mut document = Document::default();
                while let Some(key) = map.next_key::<String>()? {
                    match key.as_str() {
                        "REFERENCES" => document.references = map.next_value()?,
                        "COMMENTS" => document.comments = map.next_value()?,
                        "DATA" => document.data = Some(map.next_value()?),
                        _ => drop(map.next_value::<IgnoredAny>()?),
                    }
                }
                Ok(document)
            }
        }
        deserializer.deserialize_map(Keys)
    }
}

impl<'de> Deserialize<'de> for Block {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        struct Keys;
        impl<'de> Visitor<'de> for Keys {
            type Value = Block;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a mapping with the key type")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> std::result::Result<Block, A::Error> {
                let mut block = Block::default();
                while let Some(key) = map.next_key::<String>()? {
                    match key.as_str() {
                        "type" => block.kind = Some(map.next_value()?),
                        // Files before 2020 have the shorter name.
                        "wavelength_range" | "range" => block.range = Some(map.next_value()?),
                        "coefficients" => block.coefficients = Some(map.next_value()?),
                        "data" => block.data = Some(map.next_value()?),
                        _ => drop(map.next_value::<IgnoredAny>()?),
                    }
                }
                Ok(block)
            }
        }
        deserializer.deserialize_map(Keys)
    }
}

#[cfg(test)]
mod tests;
