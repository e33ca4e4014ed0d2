//! Values of the colour library as JSON, for validation/run.py.
//!
//! Reads one request from standard input and answers on standard output. Keys of the request, all needed:
//!
//! * `reflectance_rgb`, `emission_rgb`: linear sRGB colours to upsample;
//! * `realisable_rgb`: linear colours to look for a reflectance of, in seven spaces.

use abbe::color::{RgbSpace, upsample};
use abbe::spectrum::Spectrum;
use abbe::{Error, ErrorKind, Result};
use glam::DVec3;
use serde_json::{Value, json};
use std::io::Read;

fn main() -> std::process::ExitCode {
    let mut text = String::new();
    if let Err(error) = std::io::stdin().read_to_string(&mut text) {
        eprintln!("standard input: {error}");
        return std::process::ExitCode::FAILURE;
    }
    match answer(&text) {
        Ok(values) => {
            println!("{values}");
            std::process::ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            std::process::ExitCode::FAILURE
        }
    }
}

fn answer(text: &str) -> Result<Value> {
    let request: Value = serde_json::from_str(text).map_err(|e| Error::new(ErrorKind::Syntax, e.to_string()))?;
    Ok(json!({
        "reflectance_spectra": upsampled(&request, "reflectance_rgb", upsample::reflectance)?,
        "realisable": realisable(&request)?,
        "emission_spectra": upsampled(&request, "emission_rgb", upsample::emission)?,
    }))
}

/// The upsampled spectra at 360, 361, …, 830 nm.
fn upsampled(
    request: &Value,
    key: &str,
    method: impl Fn([f64; 3], &RgbSpace) -> Result<Spectrum>,
) -> Result<Vec<Vec<f64>>> {
    let spectrum = |value: &Value| {
        let spectrum = method(rgb(value)?, RgbSpace::srgb())?;
        Ok((360..=830).map(|lambda| spectrum.eval(f64::from(lambda))).collect())
    };
    list(request, key)?.iter().map(spectrum).collect()
}

/// Spaces that colours are looked for in.
const SPACES: [&str; 7] = ["srgb", "display-p3", "rec2020", "adobe-rgb", "acescg", "aces2065-1", "prophoto-rgb"];

/// By space: whether each colour has a reflectance.
fn realisable(request: &Value) -> Result<Value> {
    let colors = list(request, "realisable_rgb")?.iter().map(rgb).collect::<Result<Vec<_>>>()?;
    let in_space = |space: &RgbSpace| -> Vec<bool> {
        colors.iter().map(|&color| upsample::reflectance(color, space).is_ok()).collect()
    };
    let found = |name| RgbSpace::by_name(name).map(|space| (name.to_owned(), json!(in_space(space))));
    SPACES.into_iter().map(found).collect()
}

fn rgb(value: &Value) -> Result<[f64; 3]> {
    Ok(DVec3::from_slice(&numbers_exactly(value, 3)?).to_array())
}

fn list<'a>(value: &'a Value, key: &str) -> Result<&'a [Value]> {
    let missing = || Error::new(ErrorKind::Missing, format!("no list {key:?} in the request"));
    value[key].as_array().map(Vec::as_slice).ok_or_else(missing)
}

fn numbers(value: &Value) -> Result<Vec<f64>> {
    let wrong = || Error::new(ErrorKind::WrongType, format!("{value}; expected a list of numbers"));
    value.as_array().and_then(|list| list.iter().map(Value::as_f64).collect()).ok_or_else(wrong)
}

fn numbers_exactly(value: &Value, count: usize) -> Result<Vec<f64>> {
    let numbers = numbers(value)?;
    if numbers.len() == count {
        return Ok(numbers);
    }
    Err(Error::new(ErrorKind::WrongType, format!("{value}; expected {count} numbers")))
}
