//! Spectra in files: CSV, `.spd` pairs and IES TM-27 `.spdx`; one spectrum or many.

mod diagnostics;
mod pairs;
mod rows;
mod spdx;

pub use diagnostics::{Finding, VISIBLE_NM, findings};

use crate::spectrum::{PiecewiseLinear, check_knot};
use crate::{Error, ErrorKind, Result};
use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::sync::LazyLock;

/// Most samples of a spectrum.
pub const MAX_KNOTS: usize = 1_000_000;
/// Largest file, bytes.
pub const MAX_BYTES: u64 = 64 << 20;
/// Shortest wavelength in nm that a file may end at. One that ends below is in another unit, since nobody means X-rays.
const SHORTEST_LAST_NM: f64 = 100.0;

/// A way to write spectra into files.
struct Format {
    /// Extensions of its files, without the dot, in lower case.
    extensions: &'static [&'static str],
    /// Reads a file's text.
    parse: fn(&str) -> Result<SpectrumFile>,
}

/// All formats that can be read.
const FORMATS: [&Format; 3] = [&rows::FORMAT, &pairs::FORMAT, &spdx::FORMAT];

/// Extensions of files that are read, without the dot.
pub static EXTENSIONS: LazyLock<Vec<&str>> =
    LazyLock::new(|| FORMATS.iter().flat_map(|format| format.extensions).copied().collect());

/// The quantity that the values of a spectrum are of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Light that is sent out, in whatever unit.
    Emission,
    /// The share of the light that a surface sends back.
    Reflectance,
    /// The share of the light that a filter lets through.
    Transmittance,
}

impl Quantity {
    /// Reads the quantity from a column's name or from the `SpectralQuantity` of TM-27, if it says one.
    fn from_word(word: &str) -> Option<Self> {
        match word.trim().to_lowercase().as_str() {
            "reflectance" | "reflectivity" | "reflection" => Some(Self::Reflectance),
            "transmittance" | "transmissivity" | "transmission" => Some(Self::Transmittance),
            "emission" | "radiance" | "irradiance" | "exitance" | "flux" | "intensity" | "power" => {
                Some(Self::Emission)
            }
            _ => None,
        }
    }
}

/// One spectrum of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedSpectrum {
    /// The column's name; "column 2" and so on where columns have none; empty for a lone spectrum whose column has none, or
    /// one that says what the values are.
    pub name: String,
    /// Wavelengths in nm, ascending, with one value each.
    pub table: PiecewiseLinear,
}

/// What a file holds.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumFile {
    /// Spectra in the file's order, at least one.
    pub spectra: Vec<NamedSpectrum>,
    /// What the values are, if the file says so: by the names of its columns, or the `SpectralQuantity` of TM-27.
    pub quantity: Option<Quantity>,
}

/// Reads a file with one spectrum: wavelengths in nm, ascending, with one value each.
///
/// The formats are those of [`read_all`].
///
/// # Errors
/// Those of [`read_all`]; more than one spectrum.
pub fn read(path: impl AsRef<Path>) -> Result<PiecewiseLinear> {
    let path = path.as_ref();
    let read = || single(parse(&read_text(path)?, format_of(path)?)?);
    read().map_err(|error| error.in_file(path))
}

/// Reads all spectra of a file.
///
/// * `.csv`, `.txt`, `.tsv`, `.dat`: wavelengths in the first column, a spectrum in each further one, with a comma,
///   semicolon, tab or blanks between; cells may stand in double quotes, and among several spectra a cell may be empty (no
///   sample there); comments from `#`; an optional first line of column names.
/// * `.spd`: pairs of numbers with white space between; comments from `#`.
/// * `.spdx`, `.xml`: IES TM-27 \[TM27\], the `SpectralData` elements of each `SpectralDistribution`.
///
/// # Errors
/// A file that does not exist, is not a file, is larger than [`MAX_BYTES`] or not UTF-8; anything that is not a number;
/// wavelengths that do not ascend, are not positive, or look like µm or m; no samples or more than [`MAX_KNOTS`].
/// Errors name the file and the line.
pub fn read_all(path: impl AsRef<Path>) -> Result<SpectrumFile> {
    let path = path.as_ref();
    let read = || parse(&read_text(path)?, format_of(path)?);
    read().map_err(|error| error.in_file(path))
}

/// Reads all spectra of a stream: XML if its first character is `<`, else rows as in a `.csv`.
///
/// # Errors
/// As [`read_all`], with `name` for the file.
pub fn read_all_from(reader: impl Read, name: impl AsRef<Path>) -> Result<SpectrumFile> {
    let read = || {
        let text = read_limited(reader)?;
        let is_xml = text.trim_start_matches('\u{feff}').trim_start().starts_with('<');
        parse(&text, if is_xml { &spdx::FORMAT } else { &rows::FORMAT })
    };
    read().map_err(|error| error.in_file(name))
}

fn format_of(path: &Path) -> Result<&'static Format> {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_lowercase();
    let reads = |format: &&&Format| format.extensions.contains(&extension.as_str());
    FORMATS.iter().find(reads).copied().ok_or_else(|| {
        let (last, others) = EXTENSIONS.split_last().expect("there are formats");
        let message = format!("extension {extension:?}; expected .{} or .{last}", others.join(", ."));
        Error::new(ErrorKind::FileFormat, message)
    })
}

fn read_text(path: &Path) -> Result<String> {
    // The kind of file is asked before opening, for opening a pipe would wait for its writer.
    if !path.metadata().map_err(unreadable)?.is_file() {
        return Err(Error::new(ErrorKind::FileNotFound, "is not a file; expected a file with a spectrum"));
    }
    read_limited(File::open(path).map_err(unreadable)?)
}

fn unreadable(error: std::io::Error) -> Error {
    let kind = if error.kind() == std::io::ErrorKind::NotFound { ErrorKind::FileNotFound } else { ErrorKind::Io };
    Error::new(kind, format!("cannot be read: {error}"))
}

fn read_limited(reader: impl Read) -> Result<String> {
    let mut bytes = Vec::new();
    reader.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
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

fn parse(text: &str, format: &Format) -> Result<SpectrumFile> {
    (format.parse)(text.strip_prefix('\u{feff}').unwrap_or(text))
}

/// Takes the spectrum of a file that must hold no other.
fn single(file: SpectrumFile) -> Result<PiecewiseLinear> {
    let count = file.spectra.len();
    let mut spectra = file.spectra.into_iter();
    match (spectra.next(), spectra.next()) {
        (Some(only), None) => Ok(only.table),
        _ => Err(Error::new(ErrorKind::FileFormat, format!("{count} spectra; expected one (two columns)"))),
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

/// Iterates over lines without their comments, each with its number counted from 1.
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const SPDX: &str = "<?xml version=\"1.0\"?>\n<IESTM2714 xmlns=\"iestm2714\" version=\"1.0\">\n\
        <Header><Description>lamp</Description></Header>\n<SpectralDistribution>\n\
        <SpectralQuantity>relative</SpectralQuantity>\n\
        <SpectralData wavelength=\"400.0\">0.034</SpectralData>\n\
        <SpectralData wavelength=\" 403.1 \"> 3.7e-2 </SpectralData>\n</SpectralDistribution></IESTM2714>\n";

    fn knots(text: &str, format: &Format) -> Vec<(f64, f64)> {
        single(parse(text, format).unwrap()).unwrap().knots().collect()
    }

    fn message(text: &str, format: &Format) -> String {
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
            assert_eq!(knots(text, &rows::FORMAT), expected, "{text:?}");
        }
        assert_eq!(knots("# pbrt\n400 0.5 500\n-1e-3", &pairs::FORMAT), expected);
        assert_eq!(knots(SPDX, &spdx::FORMAT), [(400.0, 0.034), (403.1, 0.037)]);
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
            ("400", "line 1: 1 column; expected at least two: wavelength in nm and value"),
            ("400,1,2\n410,1", "line 2: 2 columns; expected 3 as in the lines before"),
            ("nm,a\n410,1,2", "line 2: 3 columns; expected 2 as in the lines before"),
            ("400,1,2\n410,1,x", "line 2, column \"column 3\": \"x\"; expected a number with a decimal point"),
            ("nm,a,b\n400,1,2\n410,nan,1", "line 3, column \"a\": NaN at 410 nm; expected finite numbers"),
            ("nm,a,b\n400,1,\n410,2,", "column \"b\": no samples; expected pairs of wavelength in nm and value"),
            ("400,1,2\n390,,", "line 2: wavelength 390 nm after 400 nm; expected ascending wavelengths"),
            (
                "patch,400,410,420\nred,0.1,0.2,0.3",
                "line 2: wavelengths along the line of names; expected them down the first column (transpose the table)",
            ),
            ("-400,1", "line 1: wavelength -400 nm; expected a positive one"),
            ("0.4,1\n0.7,2", "wavelengths up to 0.7 look like µm; expected nm"),
            ("4e-7,1\n7e-7,2", "wavelengths up to 7e-7 look like m; expected nm"),
            ("", "no samples; expected pairs of wavelength in nm and value"),
            ("# nothing\n", "no samples; expected pairs of wavelength in nm and value"),
            ("nm,value\n", "no samples; expected pairs of wavelength in nm and value"),
        ];
        for (text, expected) in rows {
            assert_eq!(message(text, &rows::FORMAT), expected, "{text:?}");
        }
        let expected = "line 2: wavelength 500 without a value; expected pairs of wavelength and value";
        assert_eq!(message("400 1\n500", &pairs::FORMAT), expected);
        assert!(
            message(&SPDX.replace("403.1", "399"), &spdx::FORMAT).starts_with("line 7: wavelength 399 nm after 400")
        );
        assert!(message(&SPDX.replace("0.034", "x"), &spdx::FORMAT).starts_with("line 6: \"x\"; expected a number"));
        assert!(message(&SPDX.replace("wavelength=", "w="), &spdx::FORMAT).contains("expected the attribute"));
        assert!(message("<a>\n<b></a>", &spdx::FORMAT).starts_with("line 2: not XML"));
        assert!(message("<a/>", &spdx::FORMAT).starts_with("no samples"));
    }

    #[test]
    fn many_columns_have_names_and_may_have_gaps() {
        let file = parse("nm;dark skin;\"a;\"\"b\"\"\";\n400;1;;3\n410;2;5;4\n", &rows::FORMAT).unwrap();
        assert_eq!(
            file.spectra.iter().map(|s| s.name.as_str()).collect::<Vec<_>>(),
            ["dark skin", "a;\"b\"", "column 4"]
        );
        assert_eq!(file.spectra[1].table.knots().collect::<Vec<_>>(), [(410.0, 5.0)]);
        assert_eq!(file.spectra[2].table.knots().collect::<Vec<_>>(), [(400.0, 3.0), (410.0, 4.0)]);
        let numbered = parse("wavelength_nm 1 2\n400 0.5 0.25", &rows::FORMAT).unwrap();
        assert_eq!(numbered.spectra[1].name, "2");
        assert_eq!(parse("400 0.5 0.25", &rows::FORMAT).unwrap().spectra[1].name, "column 3");
        assert_eq!(parse("400 0.5", &rows::FORMAT).unwrap().spectra[0].name, "");
        let error = single(file).unwrap_err();
        assert_eq!(error.to_string(), "3 spectra; expected one (two columns)");
    }

    #[test]
    fn names_and_headers_say_what_the_values_are() {
        let quantity = |text: &str, format| parse(text, format).unwrap().quantity;
        assert_eq!(quantity("nm,Reflectance\n400,1", &rows::FORMAT), Some(Quantity::Reflectance));
        assert_eq!(quantity("nm,transmittance,transmittance\n400,1,2", &rows::FORMAT), Some(Quantity::Transmittance));
        assert_eq!(quantity("nm,reflectance,transmittance\n400,1,2", &rows::FORMAT), None);
        assert_eq!(quantity("nm,value\n400,1", &rows::FORMAT), None);
        assert_eq!(quantity(SPDX, &spdx::FORMAT), None);
        assert_eq!(quantity(&SPDX.replace("relative", "Radiance"), &spdx::FORMAT), Some(Quantity::Emission));
        assert_eq!(parse(SPDX, &spdx::FORMAT).unwrap().spectra[0].name, "lamp");
    }

    #[test]
    fn streams_are_rows_or_xml() {
        let first = |text: &str| read_all_from(text.as_bytes(), "<stdin>").map(|f| f.spectra[0].table.knots().count());
        assert_eq!(first("400 1\n410 2"), Ok(2));
        assert_eq!(first(&format!("\u{feff}{SPDX}")), Ok(2));
        assert_eq!(
            first("400 1\n410").unwrap_err().to_string(),
            "<stdin>: line 2: 1 column; expected 2 as in the lines before"
        );
    }

    #[test]
    fn limits_hold() {
        let rows = |count: usize| (0..count).map(|i| format!("{} 1\n", 100 + i)).collect::<String>();
        assert_eq!(knots(&rows(MAX_KNOTS), &pairs::FORMAT).len(), MAX_KNOTS);
        assert_eq!(parse(&rows(MAX_KNOTS + 1), &rows::FORMAT).unwrap_err().kind, ErrorKind::LimitExceeded);
        // Deep nesting and entities that expand to more are not followed.
        let deep = "<a>".repeat(100_000) + &"</a>".repeat(100_000);
        assert!(parse(&deep, &spdx::FORMAT).is_err());
        let bomb = "<!DOCTYPE a [<!ENTITY b \"bbbbbbbb\"><!ENTITY c \"&b;&b;&b;&b;\">]><a>&c;</a>";
        assert!(parse(bomb, &spdx::FORMAT).is_err());
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
                for format in [&rows::FORMAT, &pairs::FORMAT, &spdx::FORMAT] {
                    let _ = parse(&text, format);
                }
            }
        }

        #[test]
        fn nearly_valid_text_gives_a_result(
            text in "([0-9.e,; \t\r\n#-]|nan|inf|µ|nm|<SpectralData wavelength=\"|\">|</SpectralData>|<a>|</a>|&){0,60}",
        ) {
            for format in [&rows::FORMAT, &pairs::FORMAT, &spdx::FORMAT] {
                for spectrum in parse(&text, format).into_iter().flat_map(|file| file.spectra) {
                    prop_assert!(spectrum.table.lambdas_nm().windows(2).all(|l| l[0] < l[1]));
                    let _ = findings(&spectrum.table, Quantity::Reflectance);
                }
            }
        }

        #[test]
        fn what_is_written_is_read(samples in prop::collection::vec((0.001..50.0_f64, -1e6..1e6_f64), 1..20)) {
            let mut lambda = 300.0;
            let samples: Vec<_> = samples.iter().map(|s| { lambda += s.0; (lambda, s.1) }).collect();
            let text: String = samples.iter().map(|(l, v)| format!("{l},{v}\n")).collect();
            prop_assert_eq!(knots(&text, &rows::FORMAT), samples);
        }
    }
}
