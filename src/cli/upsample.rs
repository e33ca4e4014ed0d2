//! `abbe upsample`: a spectrum of an RGB colour.

use super::spectrum::{self, Kind};
use super::{plot, usage, write_data};
use crate::color::{RgbSpace, upsample};
use crate::io::output::write_atomically;
use crate::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, PiecewiseLinear, Spectrum};
use crate::{Error, ErrorKind, Result, VERSION};
use clap::builder::PossibleValuesParser;
use glam::DVec3;
use serde_json::json;
use std::path::{Path, PathBuf};

/// Arguments of `abbe upsample`.
#[derive(Debug, Clone, clap::Args)]
pub struct UpsampleArgs {
    /// Red, green and blue, linear unless --encoded; or one hexadecimal colour such as '#ff8800', always encoded
    #[arg(required = true, num_args = 1..=3, value_name = "R G B", allow_negative_numbers = true)]
    pub color: Vec<String>,
    /// RGB space of the colour
    #[arg(long, value_name = "NAME", default_value = "srgb", value_parser = PossibleValuesParser::new(space_names()))]
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
