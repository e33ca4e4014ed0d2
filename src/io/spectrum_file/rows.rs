//! Reads `.csv` files and their like: one wavelength a line, one spectrum a column.

use super::{Format, NamedSpectrum, Quantity, Samples, SpectrumFile, at_line, content_lines, number};
use crate::spectrum::check_knot;
use crate::{Error, ErrorKind, Result};

/// One wavelength a line, two columns or more.
pub(super) const FORMAT: Format = Format { extensions: &["csv", "txt", "tsv", "dat"], parse };

/// Words that show a first line to be one of names even where columns are named by numbers.
const WAVELENGTH_WORDS: [&str; 5] = ["wavelength", "lambda", "λ", "nm", "wl"];

fn parse(text: &str) -> Result<SpectrumFile> {
    let mut lines = content_lines(text).map(|(line, content)| (line, fields(content))).peekable();
    let header = lines.next_if(|(_, fields)| is_header(fields)).map(|(_, names)| names);
    let mut table = Table::new(header);
    for (line, fields) in lines {
        table.push_row(line, &fields).map_err(at_line(line))?;
    }
    table.finish()
}

/// Decides whether a first line holds names: no field is a number, or the first one says what the first column is, or the others
/// are wavelengths (which is then refused).
fn is_header(fields: &[String]) -> bool {
    let is_name = |field: &String| field.parse::<f64>().is_err();
    let first = fields.first().map(|f| f.to_lowercase()).unwrap_or_default();
    let says_wavelength = WAVELENGTH_WORDS.iter().any(|word| first.starts_with(word));
    fields.iter().all(is_name) || (is_name(&first) && (says_wavelength || are_wavelengths(&fields[1..])))
}

/// Decides whether names are wavelengths, so that lines and columns have changed places.
fn are_wavelengths(names: &[String]) -> bool {
    let numbers: Option<Vec<f64>> = names.iter().map(|name| name.parse().ok()).collect();
    numbers.is_some_and(|n| n.len() > 2 && n[0] >= 100.0 && n.windows(2).all(|pair| pair[0] < pair[1]))
}

/// The columns read so far.
struct Table {
    header: Option<Vec<String>>,
    last_nm: Option<f64>,
    columns: Vec<Samples>,
}

impl Table {
    fn new(header: Option<Vec<String>>) -> Self {
        let count = header.as_ref().map_or(0, |names| names.len().saturating_sub(1));
        let columns = std::iter::repeat_with(Samples::default).take(count).collect();
        Self { header, last_nm: None, columns }
    }

    fn push_row(&mut self, line: usize, fields: &[String]) -> Result<()> {
        let [lambda, values @ ..] = fields else { return Ok(()) };
        if self.columns.is_empty() {
            self.columns.resize_with(values.len(), Samples::default);
        }
        let count = self.columns.len();
        if values.len() != count || count == 0 {
            return Err(wrong_width(fields.len(), count));
        }
        let is_transposed = || self.header.as_ref().is_some_and(|names| are_wavelengths(&names[1..]));
        let lambda = number(lambda).map_err(|error| if is_transposed() { transposed() } else { error })?;
        check_knot(self.last_nm, lambda, 0.0)?;
        self.last_nm = Some(lambda);
        for (index, cell) in values.iter().enumerate() {
            if cell.is_empty() && count > 1 {
                continue;
            }
            let pushed = number(cell).and_then(|value| self.columns[index].push(lambda, value));
            pushed.map_err(|error| match count {
                1 => error,
                _ => error.at(format!("line {line}, column {:?}", self.name(index))),
            })?;
        }
        Ok(())
    }

    /// Returns the name of a column, or its number, where the column of wavelengths is number 1.
    fn name(&self, index: usize) -> String {
        let given = self.header.as_ref().map(|names| names[index + 1].as_str()).filter(|name| !name.is_empty());
        given.map_or_else(|| format!("column {}", index + 2), str::to_owned)
    }

    fn finish(mut self) -> Result<SpectrumFile> {
        if self.last_nm.is_none() || self.columns.is_empty() {
            self.columns = vec![Samples::default()];
            self.header = None;
        }
        let names: Vec<String> = (0..self.columns.len()).map(|index| self.name(index)).collect();
        let quantities: Vec<_> = names.iter().map(|name| Quantity::from_word(name)).collect();
        let quantity = quantities[0].filter(|_| quantities.iter().all(|q| *q == quantities[0]));
        let is_alone = names.len() == 1;
        let nameless = is_alone && (self.header.is_none() || quantity.is_some());
        let spectra = names.into_iter().zip(self.columns).map(|(name, samples)| {
            let table = samples.finish().map_err(|e| if is_alone { e } else { e.at(format!("column {name:?}")) })?;
            Ok(NamedSpectrum { name: if nameless { String::new() } else { name }, table })
        });
        Ok(SpectrumFile { spectra: spectra.collect::<Result<_>>()?, quantity })
    }
}

fn wrong_width(found: usize, expected_values: usize) -> Error {
    let found = format!("{found} column{}", if found == 1 { "" } else { "s" });
    let message = match expected_values {
        0 => format!("{found}; expected at least two: wavelength in nm and value"),
        n => format!("{found}; expected {} as in the lines before", n + 1),
    };
    Error::new(ErrorKind::FileFormat, message)
}

fn transposed() -> Error {
    let message = "wavelengths along the line of names; expected them down the first column (transpose the table)";
    Error::new(ErrorKind::FileFormat, message)
}

/// Splits a row into fields. A semicolon or tab separates before a comma, so that a decimal comma is not taken for one.
fn fields(line: &str) -> Vec<String> {
    let separator = [';', '\t', ','].into_iter().find(|&separator| split(line, |c| c == separator).len() > 1);
    let parts = match separator {
        Some(separator) => split(line, |c| c == separator),
        None => split(line, char::is_whitespace).into_iter().filter(|part| !part.is_empty()).collect(),
    };
    parts.into_iter().map(|part| unquoted(part.trim())).collect()
}

/// Splits a line at the separators that are not inside double quotes.
fn split(line: &str, is_separator: impl Fn(char) -> bool) -> Vec<&str> {
    let mut inside = false;
    let outside = |c: char| {
        inside ^= c == '"';
        !inside && is_separator(c)
    };
    line.split(outside).collect()
}

/// Removes double quotes around a text, inside which two of them stand for one.
fn unquoted(field: &str) -> String {
    match field.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')) {
        Some(inner) => inner.replace("\"\"", "\"").trim().to_owned(),
        None => field.to_owned(),
    }
}
