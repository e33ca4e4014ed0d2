//! Spectra in files: CSV, `.spd` pairs and IES TM-27 `.spdx`.

use crate::spectrum::{PiecewiseLinear, check_knot};
use crate::{Error, ErrorKind, Result};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Most samples of a spectrum.
pub const MAX_KNOTS: usize = 1_000_000;
/// Largest file, bytes.
pub const MAX_BYTES: u64 = 64 << 20;
/// If the longest wavelength is below this many "nm" the file is in another unit: nothing here deals with X-rays.
const SHORTEST_LAST_NM: f64 = 100.0;

/// How a file is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    /// One sample a line, two columns.
    Rows,
    /// Numbers between white space, wavelength and value in turn.
    Pairs,
    /// XML.
    Spdx,
}

/// Reads a spectrum: wavelengths in nm, ascending, with one value each.
///
/// * `.csv`, `.txt`, `.tsv`, `.dat`: two columns with a comma, semicolon, tab or blanks between; comments from `#`; an
///   optional first line of column names.
/// * `.spd`: pairs of numbers with white space between; comments from `#`.
/// * `.spdx`, `.xml`: IES TM-27 \[TM27\], the `SpectralData` elements.
///
/// # Errors
/// A file that does not exist, is not a file, is larger than [`MAX_BYTES`] or not UTF-8; anything that is not a number;
/// wavelengths that do not ascend, are not positive, or look like µm or m; no samples or more than [`MAX_KNOTS`].
/// Errors name the file and the line.
pub fn read(path: impl AsRef<Path>) -> Result<PiecewiseLinear> {
    let path = path.as_ref();
    let read = || parse(&read_text(path)?, format_of(path)?);
    read().map_err(|error| error.in_file(path))
}

fn format_of(path: &Path) -> Result<Format> {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_lowercase();
    match extension.as_str() {
        "csv" | "txt" | "tsv" | "dat" => Ok(Format::Rows),
        "spd" => Ok(Format::Pairs),
        "spdx" | "xml" => Ok(Format::Spdx),
        _ => {
            let message = format!("extension {extension:?}; expected .csv, .txt, .tsv, .dat, .spd, .spdx or .xml");
            Err(Error::new(ErrorKind::FileFormat, message))
        }
    }
}

fn read_text(path: &Path) -> Result<String> {
    let unreadable = |e: std::io::Error| {
        let kind = if e.kind() == std::io::ErrorKind::NotFound { ErrorKind::FileNotFound } else { ErrorKind::Io };
        Error::new(kind, format!("cannot be read: {e}"))
    };
    // Asked before opening: opening a pipe would wait for its writer.
    if !path.metadata().map_err(unreadable)?.is_file() {
        return Err(Error::new(ErrorKind::FileNotFound, "is not a file; expected a file with a spectrum"));
    }
    let mut bytes = Vec::new();
    File::open(path).and_then(|f| f.take(MAX_BYTES + 1).read_to_end(&mut bytes)).map_err(unreadable)?;
    if bytes.len() as u64 > MAX_BYTES {
        let message = format!("more than {} MiB; expected a spectrum of at most that", MAX_BYTES >> 20);
        return Err(Error::new(ErrorKind::LimitExceeded, message));
    }
    decode(bytes)
}

fn decode(bytes: Vec<u8>) -> Result<String> {
    String::from_utf8(bytes).map_err(|error| {
        let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + valid.iter().filter(|&&byte| byte == b'\n').count();
        Error::new(ErrorKind::FileFormat, "is not UTF-8; expected text").at(format!("line {line}"))
    })
}

fn parse(text: &str, format: Format) -> Result<PiecewiseLinear> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    match format {
        Format::Rows => parse_rows(text),
        Format::Pairs => parse_pairs(text),
        Format::Spdx => parse_spdx(text),
    }
}

/// The samples read so far, checked one by one.
#[derive(Default)]
struct Samples {
    lambda_nm: Vec<f64>,
    values: Vec<f64>,
}

impl Samples {
    fn push(&mut self, lambda_nm: f64, value: f64) -> Result<()> {
        if self.lambda_nm.len() == MAX_KNOTS {
            let message = format!("more than {MAX_KNOTS} samples; expected at most that many");
            return Err(Error::new(ErrorKind::LimitExceeded, message));
        }
        check_knot(self.lambda_nm.last().copied(), lambda_nm, value)?;
        self.lambda_nm.push(lambda_nm);
        self.values.push(value);
        Ok(())
    }

    fn finish(self) -> Result<PiecewiseLinear> {
        let Some(&last) = self.lambda_nm.last() else {
            return Err(Error::new(ErrorKind::Missing, "no samples; expected pairs of wavelength in nm and value"));
        };
        if last < SHORTEST_LAST_NM {
            let unit = if last < 1e-3 { "m" } else { "µm" };
            let message = format!("wavelengths up to {last:?} look like {unit}; expected nm");
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        PiecewiseLinear::new(self.lambda_nm, self.values)
    }
}

/// Lines without comments, with their numbers counted from 1.
fn content_lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    // "\r\n" is one line break, and so is a lone "\r".
    let lines = text.split('\n').enumerate().flat_map(|(i, line)| line.split('\r').map(move |part| (i + 1, part)));
    lines
        .map(|(number, line)| (number, line.split('#').next().unwrap_or_default().trim()))
        .filter(|(_, l)| !l.is_empty())
}

fn at_line(number: usize) -> impl Fn(Error) -> Error {
    move |error| error.at(format!("line {number}"))
}

fn number(text: &str) -> Result<f64> {
    text.parse().map_err(|_| {
        let start: String = text.chars().take(40).collect();
        Error::new(ErrorKind::Syntax, format!("{start:?}; expected a number with a decimal point"))
    })
}

/// The fields of a row. A semicolon or tab separates before a comma, so that a decimal comma is not taken for one.
fn fields(line: &str) -> Vec<&str> {
    match [';', '\t', ','].into_iter().find(|&separator| line.contains(separator)) {
        Some(separator) => line.split(separator).map(str::trim).collect(),
        None => line.split_whitespace().collect(),
    }
}

fn parse_rows(text: &str) -> Result<PiecewiseLinear> {
    let mut samples = Samples::default();
    for (index, (line, content)) in content_lines(text).enumerate() {
        let fields = fields(content);
        if index == 0 && fields.iter().all(|field| field.parse::<f64>().is_err()) {
            continue; // Column names.
        }
        parse_row(&fields).and_then(|(lambda, value)| samples.push(lambda, value)).map_err(at_line(line))?;
    }
    samples.finish()
}

fn parse_row(fields: &[&str]) -> Result<(f64, f64)> {
    match fields {
        [lambda, value] => Ok((number(lambda)?, number(value)?)),
        _ => {
            let message = format!("{} columns; expected two: wavelength in nm and value", fields.len());
            Err(Error::new(ErrorKind::FileFormat, message))
        }
    }
}

fn parse_pairs(text: &str) -> Result<PiecewiseLinear> {
    let mut samples = Samples::default();
    let mut pending = None;
    let words =
        content_lines(text).flat_map(|(line, content)| content.split_whitespace().map(move |word| (line, word)));
    for (line, word) in words {
        let value = number(word).map_err(at_line(line))?;
        pending = match pending {
            None => Some((line, value)),
            Some((_, lambda)) => {
                samples.push(lambda, value).map_err(at_line(line))?;
                None
            }
        };
    }
    match pending {
        Some((line, lambda)) => {
            let message = format!("wavelength {lambda} without a value; expected pairs of wavelength and value");
            Err(at_line(line)(Error::new(ErrorKind::FileFormat, message)))
        }
        None => samples.finish(),
    }
}

fn parse_spdx(text: &str) -> Result<PiecewiseLinear> {
    let document = roxmltree::Document::parse(text)
        .map_err(|e| at_line(e.pos().row as usize)(Error::new(ErrorKind::Syntax, format!("not XML: {e}"))))?;
    let mut samples = Samples::default();
    for node in document.descendants().filter(|node| node.tag_name().name() == "SpectralData") {
        let sample = || {
            let Some(lambda) = node.attribute("wavelength") else {
                let message = "SpectralData without a wavelength; expected the attribute \"wavelength\" in nm";
                return Err(Error::new(ErrorKind::Missing, message));
            };
            Ok((number(lambda.trim())?, number(node.text().unwrap_or_default().trim())?))
        };
        // The line is looked up only when something is wrong: finding it reads the text from its start.
        sample()
            .and_then(|(lambda, value)| samples.push(lambda, value))
            .map_err(|error| at_line(document.text_pos_at(node.range().start).row as usize)(error))?;
    }
    samples.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const SPDX: &str = "<?xml version=\"1.0\"?>\n<IESTM2714 xmlns=\"iestm2714\" version=\"1.0\">\n\
        <Header><Description>lamp</Description></Header>\n<SpectralDistribution>\n\
        <SpectralQuantity>relative</SpectralQuantity>\n\
        <SpectralData wavelength=\"400.0\">0.034</SpectralData>\n\
        <SpectralData wavelength=\" 403.1 \"> 3.7e-2 </SpectralData>\n</SpectralDistribution></IESTM2714>\n";

    fn knots(text: &str, format: Format) -> Vec<(f64, f64)> {
        parse(text, format).unwrap().knots().collect()
    }

    fn message(text: &str, format: Format) -> String {
        parse(text, format).unwrap_err().to_string()
    }

    #[test]
    fn reads_every_way_to_write_two_columns() {
        let expected = [(400.0, 0.5), (500.0, -1e-3)];
        for text in [
            "400,0.5\n500,-1e-3\n",
            "\u{feff}400, 0.5\r\n500,-1e-3",
            "wavelength_nm,value\n400,0.5\n\n500,-1e-3\n",
            "# from a lamp, 2020\nnm;W\n400;0.5 # first\n500;-1e-3",
            "400\t0.5\r500\t-1e-3\r",
            "  400   0.5\n 500 -1e-3",
        ] {
            assert_eq!(knots(text, Format::Rows), expected, "{text:?}");
        }
        assert_eq!(knots("# pbrt\n400 0.5 500\n-1e-3", Format::Pairs), expected);
        assert_eq!(knots(SPDX, Format::Spdx), [(400.0, 0.034), (403.1, 0.037)]);
    }

    #[test]
    fn errors_name_the_line_and_what_was_expected() {
        let rows = [
            ("400,1\n390,2", "line 2: wavelength 390 nm after 400 nm; expected ascending wavelengths"),
            ("a,b\n400,1\n400,2", "line 3: wavelength 400 nm twice; expected each once"),
            ("400,1\n410,nan", "line 2: NaN at 410 nm; expected finite numbers"),
            ("400,1\r\n410,inf", "line 2: inf at 410 nm; expected finite numbers"),
            ("400,1\n410,one", "line 2: \"one\"; expected a number with a decimal point"),
            ("400;1\n410;0,5", "line 2: \"0,5\"; expected a number with a decimal point"),
            ("400,1,2", "line 1: 3 columns; expected two: wavelength in nm and value"),
            ("400", "line 1: 1 columns; expected two: wavelength in nm and value"),
            ("-400,1", "line 1: wavelength -400 nm; expected a positive one"),
            ("0.4,1\n0.7,2", "wavelengths up to 0.7 look like µm; expected nm"),
            ("4e-7,1\n7e-7,2", "wavelengths up to 7e-7 look like m; expected nm"),
            ("", "no samples; expected pairs of wavelength in nm and value"),
            ("# nothing\n", "no samples; expected pairs of wavelength in nm and value"),
            ("nm,value\n", "no samples; expected pairs of wavelength in nm and value"),
        ];
        for (text, expected) in rows {
            assert_eq!(message(text, Format::Rows), expected, "{text:?}");
        }
        let expected = "line 2: wavelength 500 without a value; expected pairs of wavelength and value";
        assert_eq!(message("400 1\n500", Format::Pairs), expected);
        assert!(
            message(&SPDX.replace("403.1", "399"), Format::Spdx).starts_with("line 7: wavelength 399 nm after 400")
        );
        assert!(message(&SPDX.replace("0.034", "x"), Format::Spdx).starts_with("line 6: \"x\"; expected a number"));
        assert!(message(&SPDX.replace("wavelength=", "w="), Format::Spdx).contains("expected the attribute"));
        assert!(message("<a>\n<b></a>", Format::Spdx).starts_with("line 2: not XML"));
        assert!(message("<a/>", Format::Spdx).starts_with("no samples"));
    }

    #[test]
    fn limits_hold() {
        let rows = |count: usize| (0..count).map(|i| format!("{} 1\n", 100 + i)).collect::<String>();
        assert_eq!(knots(&rows(MAX_KNOTS), Format::Pairs).len(), MAX_KNOTS);
        assert_eq!(parse(&rows(MAX_KNOTS + 1), Format::Rows).unwrap_err().kind, ErrorKind::LimitExceeded);
        // Deep nesting and entities that expand to more are not followed.
        let deep = "<a>".repeat(100_000) + &"</a>".repeat(100_000);
        assert!(parse(&deep, Format::Spdx).is_err());
        let bomb = "<!DOCTYPE a [<!ENTITY b \"bbbbbbbb\"><!ENTITY c \"&b;&b;&b;&b;\">]><a>&c;</a>";
        assert!(parse(bomb, Format::Spdx).is_err());
    }

    #[test]
    fn files_that_are_not_there_or_not_text() {
        let folder = std::env::temp_dir().join(format!("abbe-spectrum-file-{}", std::process::id()));
        std::fs::create_dir_all(folder.join("folder.csv")).unwrap();
        let write = |name: &str, bytes: &[u8]| {
            std::fs::write(folder.join(name), bytes).unwrap();
            folder.join(name)
        };
        let good = write("good.CSV", b"400,1\n500,2\n");
        assert_eq!(read(&good).unwrap().eval(450.0), 1.5);
        let kind = |path: &Path| read(path).unwrap_err().kind;
        assert_eq!(kind(&folder.join("absent.csv")), ErrorKind::FileNotFound);
        assert_eq!(kind(&folder.join("folder.csv")), ErrorKind::FileNotFound);
        assert_eq!(kind(&write("x.exr", b"400 1")), ErrorKind::FileFormat);
        let latin = read(write("latin.csv", b"400,1\n# \xb5m\n")).unwrap_err();
        assert_eq!((latin.kind, latin.place.as_str()), (ErrorKind::FileFormat, "line 2"));
        assert!(latin.to_string().contains("latin.csv: line 2: is not UTF-8"));
        let huge = folder.join("huge.csv");
        File::create(&huge).unwrap().set_len(MAX_BYTES + 1).unwrap();
        assert_eq!(kind(&huge), ErrorKind::LimitExceeded);
        std::fs::remove_dir_all(folder).unwrap();
    }

    proptest! {
        #[test]
        fn any_bytes_give_a_result(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
            if let Ok(text) = decode(bytes) {
                for format in [Format::Rows, Format::Pairs, Format::Spdx] {
                    let _ = parse(&text, format);
                }
            }
        }

        #[test]
        fn nearly_valid_text_gives_a_result(
            text in "([0-9.e,; \t\r\n#-]|nan|inf|µ|nm|<SpectralData wavelength=\"|\">|</SpectralData>|<a>|</a>|&){0,60}",
        ) {
            for format in [Format::Rows, Format::Pairs, Format::Spdx] {
                if let Ok(table) = parse(&text, format) {
                    prop_assert!(table.lambdas_nm().windows(2).all(|l| l[0] < l[1]));
                }
            }
        }

        #[test]
        fn what_is_written_is_read(samples in prop::collection::vec((0.001..50.0_f64, -1e6..1e6_f64), 1..20)) {
            let mut lambda = 300.0;
            let samples: Vec<_> = samples.iter().map(|s| { lambda += s.0; (lambda, s.1) }).collect();
            let text: String = samples.iter().map(|(l, v)| format!("{l},{v}\n")).collect();
            prop_assert_eq!(knots(&text, Format::Rows), samples);
        }
    }
}
