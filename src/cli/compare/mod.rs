//! `abbe compare`: how far a picture is from a reference.

mod report;

use super::values::exposure;
use super::{heat, usage, write_data};
use crate::color::RgbSpace;
use crate::develop;
use crate::io::exr::{self, Preference, ReadPicture};
use crate::io::output::write_atomically;
use crate::io::{mask, png};
use crate::metrics::{self, Displayed, Pair};
use crate::{Error, ErrorKind, Image, Result, math};
use clap::ValueEnum;
use glam::DVec3;
use report::{Report, threshold};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Arguments of `abbe compare`.
#[derive(Debug, Clone, clap::Args)]
pub struct CompareArgs {
    /// Picture to judge, EXR; - is stdin
    #[arg(value_name = "A.exr")]
    pub test: PathBuf,
    /// Reference, EXR; - is stdin
    #[arg(value_name = "B.exr")]
    pub reference: PathBuf,
    /// Factor of A; auto makes the means equal
    #[arg(long, value_name = "auto|S", default_value = "1")]
    pub scale: String,
    /// Values that relMSE, MAPE, SMAPE and bias compare: CIE XYZ or linear sRGB
    #[arg(long, value_enum, default_value_t = Channels::Xyz)]
    pub channels: Channels,
    /// Part or layer of files that hold several pictures
    #[arg(long, value_name = "NAME")]
    pub layer: Option<String>,
    /// Only pixels where this picture exceeds 0.5 count, .png or .exr
    #[arg(long, value_name = "FILE")]
    pub mask: Option<PathBuf>,
    /// Exposure in stops for PSNR, ΔE and FLIP; auto suits B
    #[arg(long, value_name = "EV|auto", default_value = "auto", allow_negative_numbers = true)]
    pub exposure: String,
    /// Pixels per degree of visual angle for FLIP
    #[arg(long, value_name = "P", default_value_t = metrics::FLIP_PIXELS_PER_DEGREE)]
    pub pixels_per_degree: f64,
    /// Exit with 4 where a metric is worse: 0.01 is of relMSE; others by name, such as flip=0.1. May be repeated
    #[arg(long, value_name = "[METRIC=]E")]
    pub threshold: Vec<String>,
    /// Picture of the differences to write: .png in false colours, .exr with signed differences; may be repeated
    #[arg(short, long = "output", value_name = "FILE")]
    pub output: Vec<PathBuf>,
    /// What the PNG shows
    #[arg(long, value_enum, default_value_t = Map::Error)]
    pub map: Map,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
    /// Print nothing; the exit code tells
    #[arg(short, long)]
    pub quiet: bool,
}

/// Values to compare.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Channels {
    /// CIE XYZ.
    Xyz,
    /// Linear sRGB.
    Rgb,
}

/// Maps of differences.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Map {
    /// Relative error of each pixel, the square root of its part in relMSE; white is 100 %
    Error,
    /// ΔE 2000; white is 10
    DeltaE,
    /// FLIP; white is 1
    Flip,
}

/// Compares. The exit code is 4 if a threshold is exceeded.
///
/// # Errors
/// `Usage` for arguments that make no sense, those of [`exr`], and pictures that cannot be compared.
pub fn run(args: &CompareArgs) -> Result<ExitCode> {
    let thresholds = args.threshold.iter().map(|text| threshold(text)).collect::<Result<Vec<_>>>()?;
    check_outputs(args)?;
    let preference = if args.channels == Channels::Rgb { Preference::Rgb } else { Preference::Xyz };
    if is_stdin(&args.test) && is_stdin(&args.reference) {
        return Err(usage("- for both pictures; expected one of them on stdin"));
    }
    let layer = args.layer.as_deref();
    let [test, reference] = [&args.test, &args.reference].map(|path| read(path, preference, layer));
    let (test, reference) = (test?, reference?);
    let (report, maps) = compare(args, &test, &reference)?;
    for path in &args.output {
        write_atomically(path, &encode(&maps, path, args.map)?)?;
    }
    if report.non_finite != [0, 0] && !args.quiet {
        let [a, b] = report.non_finite;
        eprintln!("warning: {a} pixels of A and {b} of B are not finite; they have been left out");
    }
    let exceeded: Vec<String> = thresholds.iter().filter_map(|t| t.exceeded(&report)).collect();
    print(args, &report, &exceeded)?;
    Ok(if exceeded.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(super::OVER_THRESHOLD) })
}

fn is_stdin(path: &Path) -> bool {
    path.as_os_str() == "-"
}

fn check_outputs(args: &CompareArgs) -> Result<()> {
    let legal = |path: &&PathBuf| matches!(extension(path).as_deref(), Some("png" | "exr"));
    match args.output.iter().find(|path| !legal(path)) {
        Some(path) => Err(usage(format!("-o {}: expected a name that ends in .exr or .png", path.display()))),
        None => Ok(()),
    }
}

fn extension(path: &Path) -> Option<String> {
    Some(path.extension()?.to_str()?.to_ascii_lowercase())
}

fn read(path: &Path, preference: Preference, layer: Option<&str>) -> Result<ReadPicture> {
    let read = match is_stdin(path) {
        true => read_stdin(preference, layer),
        false => exr::read_file(path, preference, layer),
    };
    read.map_err(|error| match error.kind {
        // A file of several pictures, which the message lists.
        ErrorKind::Usage => Error { message: format!("{}, with --layer", error.message), ..error },
        _ => error,
    })
}

fn read_stdin(preference: Preference, layer: Option<&str>) -> Result<ReadPicture> {
    let mut bytes = Vec::new();
    let failed = |e: std::io::Error| Error::new(ErrorKind::Io, format!("reading stdin failed: {e}"));
    std::io::stdin().lock().read_to_end(&mut bytes).map_err(failed)?;
    exr::decode(&bytes, preference, layer).map_err(|error| error.in_file("<stdin>"))
}

/// Compares two pictures. Also makes a picture of their difference in XYZ, and beside it the map of each metric.
fn compare(args: &CompareArgs, test: &ReadPicture, reference: &ReadPicture) -> Result<(Report, Image)> {
    let size = same_size(args, &test.xyz, &reference.xyz)?;
    let mask = args.mask.as_deref().map(|path| read_mask(path, size)).transpose()?;
    let scale = scale(args, &test.xyz, &reference.xyz, mask.as_deref())?;
    let scaled = test.xyz.map(|v| v * scale);
    let values = |xyz: &Image| match args.channels {
        Channels::Xyz => xyz.clone(),
        Channels::Rgb => {
            let rgb_from_xyz = RgbSpace::srgb().rgb_from_xyz;
            let pixels = xyz.triples().iter().flat_map(|pixel| (rgb_from_xyz * DVec3::from(*pixel)).to_array());
            Image::new(size, &["R", "G", "B"], pixels.collect())
        }
    };
    let (test_values, reference_values) = (values(&scaled), values(&reference.xyz));
    let pair = Pair::new(&test_values, &reference_values, mask.as_deref())?;

    let exposure_ev = exposure(&args.exposure)?.unwrap_or_else(|| develop::automatic_exposure(&reference.xyz));
    let factor = math::exp(exposure_ev * std::f64::consts::LN_2);
    let shown = [&scaled, &reference.xyz].map(|xyz| Displayed::new(xyz, factor));
    if !(args.pixels_per_degree > 0.0 && args.pixels_per_degree <= 1000.0) {
        return Err(usage(format!(
            "--pixels-per-degree {}: expected more than 0, at most 1000",
            args.pixels_per_degree
        )));
    }
    let delta_e = metrics::color_difference_map(&shown[0], &shown[1]);
    let flip = metrics::flip_map(&shown[0], &shown[1], args.pixels_per_degree);
    let report = Report {
        sources: [test.source, reference.source],
        size,
        pixels: pair.count(),
        non_finite: pair.non_finite(),
        scale,
        exposure_ev,
        relmse: metrics::relative_mse(&pair),
        trimmed_relmse: metrics::trimmed_relative_mse(&pair),
        mape: metrics::mape(&pair),
        smape: metrics::smape(&pair),
        psnr: metrics::psnr(&pair, &shown[0], &shown[1]),
        color_difference: metrics::color_difference(&pair, &delta_e),
        flip: metrics::flip(&pair, &flip),
        bias: metrics::bias(&pair),
    };
    let difference = scaled.zip_with(&reference.xyz, |a, b| a - b);
    Ok((report, difference.beside(&metrics::relative_error_map(&pair)).beside(&delta_e).beside(&flip)))
}

fn same_size(args: &CompareArgs, test: &Image, reference: &Image) -> Result<[u32; 2]> {
    let [[a, b], [c, d]] = [test.size(), reference.size()];
    if [a, b] != [c, d] {
        let [test, reference] = [&args.test, &args.reference].map(|path| path.display());
        let message = format!("{test} has {a}x{b} pixels, {reference} has {c}x{d}; expected pictures of the same size");
        return Err(Error::new(ErrorKind::OutOfRange, message));
    }
    Ok([a, b])
}

/// Reads which pixels of pictures of a size count.
pub(super) fn read_mask(path: &Path, size: [u32; 2]) -> Result<Vec<bool>> {
    let mask = mask::read_file(path)?;
    if mask.size() != size {
        let [[a, b], [width, height]] = [mask.size(), size];
        let message = format!("a mask of {a}x{b} pixels; expected {width}x{height}");
        return Err(Error::new(ErrorKind::OutOfRange, message).in_file(path));
    }
    Ok(mask.plane(0).map(|v| v > 0.5).collect())
}

/// The factor of A. The quotient of the means is not swayed by noise, as a factor of least squares would be.
fn scale(args: &CompareArgs, test: &Image, reference: &Image, mask: Option<&[bool]>) -> Result<f64> {
    if args.scale != "auto" {
        let factor: Option<f64> = args.scale.parse().ok().filter(|s: &f64| s.is_finite() && *s > 0.0);
        return factor.ok_or_else(|| usage(format!("--scale {}: expected a positive factor, or auto", args.scale)));
    }
    let pair = Pair::new(test, reference, mask)?;
    let test_mean = pair.pixels().flat_map(|(test, _)| test).sum::<f64>() / (3 * pair.count()) as f64;
    if !(test_mean > 0.0 && pair.mean() > 0.0) {
        let message = format!("--scale auto: the means are {test_mean} and {}; expected both positive", pair.mean());
        return Err(Error::new(ErrorKind::OutOfRange, message));
    }
    Ok(pair.mean() / test_mean)
}

/// Encodes all maps as an EXR, or one of them in false colours.
fn encode(maps: &Image, path: &Path, map: Map) -> Result<Vec<u8>> {
    if extension(path).as_deref() == Some("exr") {
        return exr::encode_image(maps);
    }
    let (channel, white) = match map {
        Map::Error => (3, 1.0),
        Map::DeltaE => (4, 10.0),
        Map::Flip => (5, 1.0),
    };
    png::encode(&heat::picture(maps, channel, white))
}

/// The JSON or the table to stdout, what is exceeded to stderr.
fn print(args: &CompareArgs, report: &Report, exceeded: &[String]) -> Result<()> {
    if !args.quiet {
        let text = match args.json {
            true => format!("{}\n", report.to_json(args, exceeded)),
            false => report.to_table(args),
        };
        write_data(&mut std::io::stdout().lock(), text.as_bytes())?;
        exceeded.iter().for_each(|what| eprintln!("{what}"));
    }
    Ok(())
}
