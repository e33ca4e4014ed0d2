//! `abbe upsample`: a spectrum of an RGB colour.

use super::spectrum::{self, Kind, Lamp};
use super::{plot, usage, write_data};
use crate::color::upsample::{self, Method};
use crate::color::{EncodedRgb, LinearRgb, RgbSpace};
use crate::io::output::write_atomically;
use crate::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, PiecewiseLinear, Spectrum};
use crate::{Error, ErrorKind, Result, VERSION};
use clap::builder::PossibleValuesParser;
use serde_json::json;
use std::path::{Path, PathBuf};

/// Arguments of `abbe upsample`.
#[derive(Debug, Clone, clap::Args)]
pub struct UpsampleArgs {
    /// Red, green and blue, linear unless --encoded; or one hexadecimal colour such as '#ff8800', always encoded
    #[arg(required = true, num_args = 1..=3, value_name = "R G B", allow_negative_numbers = true)]
    pub color: Vec<String>,
    /// RGB space of the colour
    #[arg(long, value_name = "NAME", default_value = "srgb", hide_possible_values = true,
        value_parser = PossibleValuesParser::new(RgbSpace::names()))]
    pub space: String,
    /// R G B are after the space's transfer function, as picture files have them
    #[arg(long, conflicts_with = "linear")]
    pub encoded: bool,
    /// R G B are proportional to light (the default)
    #[arg(long)]
    pub linear: bool,
    /// What the spectrum is to be
    #[arg(long = "as", value_name = "KIND", default_value = "reflectance")]
    pub kind: Kind,
    /// How a reflectance is made [default: natural]
    #[arg(long, value_name = "NAME", value_parser = PossibleValuesParser::new(Method::names()))]
    pub method: Option<String>,
    /// Make of a colour that no reflectance has the nearest one towards grey, with a warning
    #[arg(long, conflicts_with = "method")]
    pub project: bool,
    /// Make an emission by tinting this light: a name, a file, or a blackbody as in 2856K
    #[arg(long, value_name = "LIGHT")]
    pub illuminant: Option<String>,
    /// CSV to write; - is stdout, which is the default
    #[arg(short, long, value_name = "OUT.csv")]
    pub output: Option<PathBuf>,
    /// Draw the spectrum and its chromaticity
    #[arg(long, value_name = "OUT.svg")]
    pub plot: Option<PathBuf>,
    /// Print one JSON object on stdout; a CSV is written with -o alone
    #[arg(long)]
    pub json: bool,
    /// No warnings
    #[arg(short, long)]
    pub quiet: bool,
}

/// Prints or writes the spectrum.
///
/// # Errors
/// `Usage` for a colour that is not written as one, those of [`upsample::reflectance_by`] and [`upsample::emission`], `Io`.
pub fn run(args: &UpsampleArgs) -> Result<()> {
    if let Some(path) = &args.plot {
        plot::check_name(path)?;
    }
    check_streams(args)?;
    let made = Made::new(args)?;
    if !args.quiet {
        made.findings().iter().for_each(|(name, message)| eprintln!("warning: {message} [{name}]"));
    }
    if let Some(path) = &args.plot {
        let svg = spectrum::drawing(&made.title(), made.table.clone(), args.kind.into(), made.space)?;
        output(path, svg.as_bytes())?;
    }
    if let Some(path) = &args.output {
        output(path, made.csv().as_bytes())?;
    }
    match (args.json, &args.output) {
        (true, _) => output("-".as_ref(), made.json().as_bytes()),
        (_, None) => output("-".as_ref(), made.csv().as_bytes()),
        _ => Ok(()),
    }
}

fn output(path: &Path, bytes: &[u8]) -> Result<()> {
    match path.as_os_str() == "-" {
        true => write_data(&mut std::io::stdout().lock(), bytes),
        false => write_atomically(path, bytes),
    }
}

/// Only one thing may go to stdout.
fn check_streams(args: &UpsampleArgs) -> Result<()> {
    let is_stream = |path: &Option<PathBuf>| path.as_ref().is_some_and(|path| path.as_os_str() == "-");
    let csv = is_stream(&args.output) || (args.output.is_none() && !args.json);
    let count = [csv, args.json, is_stream(&args.plot)].into_iter().filter(|wanted| *wanted).count();
    match count {
        0 | 1 => Ok(()),
        _ => Err(usage("the CSV, --json and --plot - all write to stdout; expected one of them (-o names a file)")),
    }
}

/// The colour that was asked for.
struct Color {
    linear: LinearRgb,
    encoded: EncodedRgb,
}

impl Color {
    fn parse(args: &UpsampleArgs, space: &RgbSpace) -> Result<Self> {
        match args.color.as_slice() {
            [hex] if args.linear => {
                Err(usage(format!("{hex:?} with --linear; expected R G B, as hexadecimal colours are encoded")))
            }
            [hex] => Ok(Self::from_encoded(parse_hex(hex)?, space)),
            [r, g, b] => {
                let components = [component(r)?, component(g)?, component(b)?];
                match args.encoded {
                    true => Ok(Self::from_encoded(EncodedRgb::from(components), space)),
                    false => Ok(Self::from_linear(LinearRgb::from(components), space)),
                }
            }
            _ => Err(usage("two components; expected R G B, or one hexadecimal colour such as '#ff8800'")),
        }
    }

    fn from_encoded(encoded: EncodedRgb, space: &RgbSpace) -> Self {
        Self { linear: space.decode(encoded), encoded }
    }

    fn from_linear(linear: LinearRgb, space: &RgbSpace) -> Self {
        Self { linear, encoded: space.encode(linear) }
    }
}

fn component(text: &str) -> Result<f64> {
    text.parse().map_err(|_| usage(format!("{text:?}; expected a number, or one hexadecimal colour such as '#ff8800'")))
}

/// `#rrggbb` or `#rgb`, with or without the `#`.
fn parse_hex(text: &str) -> Result<EncodedRgb> {
    let digits = text.strip_prefix('#').unwrap_or(text);
    let nibbles: Option<Vec<u32>> = digits.chars().map(|c| c.to_digit(16)).collect();
    match nibbles.as_deref() {
        Some(&[r, g, b]) => Ok(EncodedRgb::from([r, g, b].map(|n| f64::from(17 * n) / 255.0))),
        Some(&[r, s, g, h, b, c]) => {
            Ok(EncodedRgb::from([16 * r + s, 16 * g + h, 16 * b + c].map(|n| f64::from(n) / 255.0)))
        }
        _ => Err(usage(format!("{text:?}; expected a hexadecimal colour such as '#ff8800' or '#f80', or R G B"))),
    }
}

/// A table keeps its own knots; anything else gets one a nanometre.
fn tabulated(spectrum: &Spectrum) -> PiecewiseLinear {
    if let Spectrum::PiecewiseLinear(table) = spectrum {
        return table.clone();
    }
    let knots: Vec<f64> = (0..=(LAMBDA_MAX_NM - LAMBDA_MIN_NM) as u32).map(|i| LAMBDA_MIN_NM + f64::from(i)).collect();
    let values = knots.iter().map(|&nm| spectrum.eval(nm)).collect();
    PiecewiseLinear::from_valid_knots(knots, values)
}

/// A spectrum with what it was made from.
struct Made<'a> {
    args: &'a UpsampleArgs,
    space: &'static RgbSpace,
    color: Color,
    /// Name of the method.
    method: &'static str,
    /// What is left of the saturation; 1 unless the colour was projected.
    saturation: f64,
    table: PiecewiseLinear,
    /// Linear RGB of the table.
    back: [f64; 3],
}

/// Errors of a colour below this are told by `--json` alone: solvers are far below, published methods far above.
const TOLD_ERROR: f64 = 1e-6;

impl<'a> Made<'a> {
    fn new(args: &'a UpsampleArgs) -> Result<Self> {
        let space = RgbSpace::by_name(&args.space)?;
        let color = Color::parse(args, space)?;
        let rgb = color.linear.to_array();
        let (method, saturation, spectrum) = match args.kind {
            Kind::Emission => emission(args, rgb, space)?,
            Kind::Reflectance | Kind::Transmittance => reflectance(args, rgb, space)?,
        };
        let table = tabulated(&spectrum);
        let spectrum = Spectrum::PiecewiseLinear(table.clone());
        let back = match args.kind {
            Kind::Emission => upsample::rgb_of_emission(&spectrum, space),
            Kind::Reflectance | Kind::Transmittance => upsample::rgb_of_reflectance(&spectrum, space),
        };
        Ok(Self { args, space, color, method, saturation, table, back })
    }

    fn what(&self) -> &'static str {
        match self.args.kind {
            Kind::Emission => "emission",
            Kind::Reflectance => "reflectance",
            Kind::Transmittance => "transmittance",
        }
    }

    fn title(&self) -> String {
        let [r, g, b] = self.color.linear.to_array();
        format!("{} of linear {} {r:.4} {g:.4} {b:.4} ({})", self.what(), self.space.name, self.method)
    }

    /// One line a knot, under names that `abbe spectrum` understands.
    fn csv(&self) -> String {
        let ([r, g, b], method) = (self.color.linear.to_array(), self.method);
        let mut text = format!("# {} of linear {} {r} {g} {b}: {method}, {VERSION}\n", self.what(), self.space.name);
        text += &format!("wavelength_nm,{}\n", self.what());
        self.table.knots().for_each(|(nm, value)| text += &format!("{nm},{value}\n"));
        text
    }

    /// The largest difference between the colour asked for and the spectrum's.
    fn error(&self) -> f64 {
        let wanted = self.color.linear.to_array();
        wanted.iter().zip(self.back).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    /// Names and messages of what is not as it was asked for.
    fn findings(&self) -> Vec<(&'static str, String)> {
        let mut found = Vec::new();
        let largest = self.color.linear.0.abs().max_element().max(1.0);
        let [r, g, b] = self.back;
        if self.saturation < 1.0 {
            let percent = 100.0 * self.saturation;
            let message =
                format!("no reflectance has this colour; {percent:.2} % of its saturation are left: {r} {g} {b}");
            found.push(("projected", message));
        } else if self.error() > TOLD_ERROR * largest && self.args.illuminant.is_none() {
            let message = format!("the spectrum has the colour {r} {g} {b}, up to {:.2e} off", self.error());
            found.push(("color_missed", message));
        }
        if self.args.kind != Kind::Emission && self.table.max() > 1.0 {
            let message = format!("values up to {}: more light leaves than arrives", self.table.max());
            found.push(("above_one", message));
        }
        found
    }

    fn json(&self) -> String {
        let warnings = self.findings().into_iter().map(|(name, message)| json!({ "name": name, "message": message }));
        let value = json!({
            "space": self.space.name,
            "as": self.what(),
            "method": self.method,
            "rgb_linear": self.color.linear.to_array(),
            "rgb_encoded": self.color.encoded.to_array(),
            "wavelengths_nm": self.table.lambdas_nm(),
            "values": self.table.values(),
            "saturation_kept": self.saturation,
            "round_trip": { "rgb_linear": self.back, "largest_error": self.error() },
            "warnings": warnings.collect::<Vec<_>>(),
        });
        format!("{value}\n")
    }
}

/// Name of the method, saturation kept, spectrum.
type Upsampled = (&'static str, f64, Spectrum);

fn reflectance(args: &UpsampleArgs, rgb: [f64; 3], space: &RgbSpace) -> Result<Upsampled> {
    if args.illuminant.is_some() {
        return Err(usage("--illuminant is for --as emission; reflectances are made for D65"));
    }
    if args.project {
        let projected = upsample::projected(rgb, space)?;
        return Ok((Method::Natural.name(), projected.saturation, projected.spectrum));
    }
    let method = args.method.as_deref().map_or(Ok(Method::Natural), Method::by_name)?;
    let spectrum = upsample::reflectance_by(method, rgb, space).map_err(|error| match error.kind {
        ErrorKind::OutOfRange if method == Method::Natural && rgb.iter().all(|c| (0.0..=1.0).contains(c)) => {
            Error { message: format!("{}; --project takes the nearest", error.message), ..error }
        }
        _ => error,
    })?;
    Ok((method.name(), 1.0, spectrum))
}

fn emission(args: &UpsampleArgs, rgb: [f64; 3], space: &RgbSpace) -> Result<Upsampled> {
    if args.method.is_some() || args.project {
        return Err(usage(
            "--method and --project are for reflectances; an emission is the smoothest, or a tinted --illuminant",
        ));
    }
    match &args.illuminant {
        Some(name) => {
            let lamp = Lamp::named(name)?;
            Ok(("tinted", 1.0, upsample::emission_of_lamp(rgb, space, &lamp.spectrum)?))
        }
        None => Ok(("smoothest", 1.0, upsample::emission(rgb, space)?)),
    }
}
