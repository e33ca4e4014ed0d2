//! `abbe upsample`: a spectrum of an RGB colour.

use super::spectrum::{self, Kind};
use super::{plot, usage, write_data};
use crate::color::{EncodedRgb, LinearRgb, RgbSpace, upsample};
use crate::io::output::write_atomically;
use crate::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, PiecewiseLinear, Spectrum};
use crate::{Result, VERSION};
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
    /// CSV to write; - is stdout, which is the default
    #[arg(short, long, value_name = "OUT.csv")]
    pub output: Option<PathBuf>,
    /// Draw the spectrum and its chromaticity
    #[arg(long, value_name = "OUT.svg")]
    pub plot: Option<PathBuf>,
    /// Print one JSON object on stdout; a CSV is written with -o alone
    #[arg(long)]
    pub json: bool,
}

/// Prints or writes the spectrum.
///
/// # Errors
/// `Usage` for a colour that is not written as one, those of [`upsample::reflectance`] and [`upsample::emission`], `Io`.
pub fn run(args: &UpsampleArgs) -> Result<()> {
    if let Some(path) = &args.plot {
        plot::check_name(path)?;
    }
    check_streams(args)?;
    let space = RgbSpace::by_name(&args.space)?;
    let color = Color::parse(args, space)?;
    let spectrum = match args.kind {
        Kind::Emission => upsample::emission(color.linear.to_array(), space),
        Kind::Reflectance | Kind::Transmittance => upsample::reflectance(color.linear.to_array(), space),
    };
    let made = Made { args, space, color, table: tabulated(&spectrum?) };
    if let Some(path) = &args.plot {
        let title = made.title();
        let svg = spectrum::drawing(&title, made.table.clone(), args.kind.into(), space)?;
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
    table: PiecewiseLinear,
}

impl Made<'_> {
    fn what(&self) -> &'static str {
        match self.args.kind {
            Kind::Emission => "emission",
            Kind::Reflectance => "reflectance",
            Kind::Transmittance => "transmittance",
        }
    }

    fn title(&self) -> String {
        let [r, g, b] = self.color.linear.to_array();
        format!("{} of linear {} {r:.4} {g:.4} {b:.4}", self.what(), self.space.name)
    }

    /// One line a knot, under names that `abbe spectrum` understands.
    fn csv(&self) -> String {
        let [r, g, b] = self.color.linear.to_array();
        let mut text = format!("# {} of linear {} {r} {g} {b}, by {VERSION}\n", self.what(), self.space.name);
        text += &format!("wavelength_nm,{}\n", self.what());
        self.table.knots().for_each(|(nm, value)| text += &format!("{nm},{value}\n"));
        text
    }

    fn json(&self) -> String {
        let back = self.back();
        let wanted = self.color.linear.to_array();
        let error = wanted.iter().zip(back).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let value = json!({
            "space": self.space.name,
            "as": self.what(),
            "rgb_linear": wanted,
            "rgb_encoded": self.color.encoded.to_array(),
            "wavelengths_nm": self.table.lambdas_nm(),
            "values": self.table.values(),
            "round_trip": { "rgb_linear": back, "largest_error": error },
        });
        format!("{value}\n")
    }

    /// The colour of the spectrum, which is to be the one that was asked for.
    fn back(&self) -> [f64; 3] {
        let spectrum = Spectrum::PiecewiseLinear(self.table.clone());
        match self.args.kind {
            Kind::Emission => upsample::rgb_of_emission(&spectrum, self.space),
            Kind::Reflectance | Kind::Transmittance => upsample::rgb_of_reflectance(&spectrum, self.space),
        }
    }
}
