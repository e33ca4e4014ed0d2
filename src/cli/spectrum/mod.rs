//! `abbe spectrum`: the colour of spectra from a file.

mod light;
mod measure;
mod report;

use super::{plot, swatch, usage, write_data};
use crate::color::{Observer, RgbSpace};
use crate::io::output::write_atomically;
use crate::io::spectrum_file::{self, Finding, NamedSpectrum, Quantity, SpectrumFile};
use crate::spectrum::PiecewiseLinear;
use crate::{Error, ErrorKind, Result};
use clap::builder::PossibleValuesParser;
pub(super) use light::Lamp;
use measure::{Measurement, Viewing, adaptation, adaptation_names};
use std::path::{Path, PathBuf};

/// Arguments of `abbe spectrum`.
#[derive(Debug, Clone, clap::Args)]
pub struct SpectrumArgs {
    /// CSV, .spd or .spdx with wavelengths in nm and one or many spectra; - is stdin
    pub file: PathBuf,
    /// What the values are. Default: what the file says, else reflectance with --illuminant and emission without
    #[arg(long = "as", value_name = "KIND")]
    pub kind: Option<Kind>,
    /// The light on a reflectance or transmittance, and the white that colours are seen against: a name (A, D65, FL11, …), a
    /// file, or a blackbody as in 2856K. Default: D65
    #[arg(long, value_name = "LIGHT")]
    pub illuminant: Option<String>,
    /// Standard observer
    #[arg(long, value_name = "NAME", default_value = "1931-2", value_parser = PossibleValuesParser::new(Observer::names()))]
    pub observer: String,
    /// RGB space
    #[arg(long, value_name = "NAME", default_value = "srgb", hide_possible_values = true,
        value_parser = PossibleValuesParser::new(RgbSpace::names()))]
    pub space: String,
    /// Chromatic adaptation from the light's white to the space's: none, bradford, cat16, … Default: bradford for
    /// reflectances and transmittances, none for emissions
    #[arg(long, value_name = "NAME", value_parser = PossibleValuesParser::new(adaptation_names()), hide_possible_values = true)]
    pub adaptation: Option<String>,
    /// Only these columns; may be repeated
    #[arg(long, value_name = "NAME")]
    pub column: Vec<String>,
    /// The values are percent: divide them by 100
    #[arg(long)]
    pub percent: bool,
    /// Draw the spectra and their chromaticities; - is stdout
    #[arg(long, value_name = "OUT.svg")]
    pub plot: Option<PathBuf>,
    /// Print one JSON object instead of text
    #[arg(long, conflicts_with = "csv")]
    pub json: bool,
    /// Print a table, one line a spectrum, instead of text
    #[arg(long)]
    pub csv: bool,
    /// No warnings
    #[arg(short, long)]
    pub quiet: bool,
}

/// What the values of a file are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Kind {
    /// Light: a radiance, or relative power
    Emission,
    /// The share of light that a surface sends back
    Reflectance,
    /// The share of light that a filter lets through
    Transmittance,
}

impl From<Kind> for Quantity {
    fn from(kind: Kind) -> Self {
        match kind {
            Kind::Emission => Self::Emission,
            Kind::Reflectance => Self::Reflectance,
            Kind::Transmittance => Self::Transmittance,
        }
    }
}

/// Prints the colours to stdout, and warnings to stderr.
///
/// # Errors
/// `Usage` for flags that make no sense, those of [`spectrum_file::read_all`] and [`spectrum_file::findings`],
/// `UnknownName` for a column that is not there, `Io`.
pub fn run(args: &SpectrumArgs) -> Result<()> {
    check_plot(args)?;
    let input = Input::read(args)?;
    let viewing = viewing(args, &input)?;
    let measured = measure_all(&input, &viewing)?;
    if !args.quiet {
        warnings(&input, &measured).iter().for_each(|warning| eprintln!("warning: {warning}"));
    }
    let drawing = args.plot.as_ref().map(|path| (path, report::plot(&input.title, &viewing, &measured).to_svg()));
    let text = match &drawing {
        Some((path, svg)) if is_stream(path) => svg.clone(),
        _ if args.json => report::json(&input.file, &viewing, &measured),
        _ if args.csv => report::csv(&measured),
        _ => report::text(&viewing, &measured, swatch::is_wanted()),
    };
    if let Some((path, svg)) = drawing.filter(|(path, _)| !is_stream(path)) {
        write_atomically(path, svg.as_bytes())?;
    }
    write_data(&mut std::io::stdout().lock(), text.as_bytes())
}

fn is_stream(path: &Path) -> bool {
    path.as_os_str() == "-"
}

fn check_plot(args: &SpectrumArgs) -> Result<()> {
    match &args.plot {
        Some(path) if is_stream(path) && (args.json || args.csv) => {
            Err(usage("--plot - writes to stdout, as --json and --csv do; expected one of them"))
        }
        Some(path) => plot::check_name(path),
        None => Ok(()),
    }
}

/// What is read.
struct Input {
    /// Name of the file in errors and JSON.
    file: PathBuf,
    /// Title of drawings.
    title: String,
    spectra: Vec<NamedSpectrum>,
    quantity: Option<Quantity>,
}

impl Input {
    fn read(args: &SpectrumArgs) -> Result<Self> {
        let is_stdin = is_stream(&args.file);
        let file = if is_stdin { PathBuf::from("<stdin>") } else { args.file.clone() };
        let SpectrumFile { mut spectra, quantity } = match is_stdin {
            true => spectrum_file::read_all_from(std::io::stdin().lock(), &file)?,
            false => spectrum_file::read_all(&file)?,
        };
        let stem =
            if is_stdin { "spectrum".into() } else { args.file.file_stem().unwrap_or_default().to_string_lossy() };
        for spectrum in &mut spectra {
            spectrum.name = swatch::harmless(if spectrum.name.is_empty() { &stem } else { &spectrum.name });
            if args.percent {
                spectrum.table = spectrum.table.clone().scaled(0.01);
            }
        }
        if !args.column.is_empty() {
            spectra = chosen(spectra, &args.column).map_err(|error| error.in_file(&file))?;
        }
        let title = match spectra.as_slice() {
            [only] => only.name.clone(),
            _ => swatch::harmless(&stem),
        };
        Ok(Self { file, title, spectra, quantity })
    }
}

/// Columns that an error names at most.
const SHOWN_COLUMNS: usize = 12;

/// The columns of these names, in this order.
fn chosen(spectra: Vec<NamedSpectrum>, names: &[String]) -> Result<Vec<NamedSpectrum>> {
    let find = |name: &String| {
        let found = spectra.iter().find(|spectrum| spectrum.name == *name).cloned();
        found.ok_or_else(|| {
            let known: Vec<&str> = spectra.iter().map(|s| s.name.as_str()).collect();
            let shown = known[..known.len().min(SHOWN_COLUMNS)].join(", ");
            let more =
                if known.len() > SHOWN_COLUMNS { format!(", … ({} in all)", known.len()) } else { String::new() };
            let message = format!("no column {name:?}; expected one of {shown}{more}");
            Error::new(ErrorKind::UnknownName, message).nearest(name, known)
        })
    };
    names.iter().map(find).collect()
}

fn viewing(args: &SpectrumArgs, input: &Input) -> Result<Viewing> {
    let implied = if args.illuminant.is_some() { Quantity::Reflectance } else { Quantity::Emission };
    let quantity = args.kind.map(Quantity::from).or(input.quantity).unwrap_or(implied);
    let lamp = Lamp::named(args.illuminant.as_deref().unwrap_or("D65"))?;
    let adaptation = adaptation(args.adaptation.as_deref(), quantity);
    Ok(Viewing::new(quantity, Observer::by_name(&args.observer)?, RgbSpace::by_name(&args.space)?, adaptation, lamp))
}

/// A spectrum with its colour and what is doubtful about it.
struct Measured<'a> {
    spectrum: &'a NamedSpectrum,
    measurement: Measurement,
    findings: Vec<Finding>,
}

fn measure_all<'a>(input: &'a Input, viewing: &Viewing) -> Result<Vec<Measured<'a>>> {
    let count = input.spectra.len();
    let measure = |spectrum: &'a NamedSpectrum| {
        let findings = spectrum_file::findings(&spectrum.table, viewing.quantity).map_err(|error| {
            let error = if count == 1 { error } else { error.at(format!("column {:?}", spectrum.name)) };
            error.in_file(&input.file)
        })?;
        let measurement = viewing.measure(&spectrum.table);
        Ok(Measured { spectrum, measurement, findings })
    };
    input.spectra.iter().map(measure).collect()
}

/// One line each; what many columns share is told once.
fn warnings(input: &Input, measured: &[Measured]) -> Vec<String> {
    let mut told: Vec<(&Finding, Vec<&str>)> = Vec::new();
    for one in measured {
        for finding in &one.findings {
            match told.iter_mut().find(|(other, _)| *other == finding) {
                Some((_, names)) => names.push(&one.spectrum.name),
                None => told.push((finding, vec![&one.spectrum.name])),
            }
        }
    }
    let (file, count) = (input.file.display(), measured.len());
    let line = |(finding, names): (&Finding, Vec<&str>)| {
        let whose = match names.as_slice() {
            _ if count == 1 => String::new(),
            [name] => format!(" column {name:?}:"),
            names => format!(" {} of {count} columns:", names.len()),
        };
        let advice = if finding.name == "looks_like_percent" { "; use --percent if they are" } else { "" };
        format!("{file}:{whose} {}{advice} [{}]", finding.message, finding.name)
    };
    told.into_iter().map(line).collect()
}

/// The drawing of one spectrum seen by the CIE 1931 observer, for other commands.
///
/// # Errors
/// None but those of looking up D65.
pub(super) fn drawing(
    name: &str,
    table: PiecewiseLinear,
    quantity: Quantity,
    space: &'static RgbSpace,
) -> Result<String> {
    let usual = adaptation(None, quantity);
    let viewing = Viewing::new(quantity, Observer::cie_1931_2deg(), space, usual, Lamp::named("D65")?);
    let spectrum = NamedSpectrum { name: name.to_owned(), table };
    let measurement = viewing.measure(&spectrum.table);
    let measured = [Measured { spectrum: &spectrum, measurement, findings: Vec::new() }];
    Ok(report::plot(name, &viewing, &measured).to_svg())
}
