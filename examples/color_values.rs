//! Values of the colour library as JSON, for validation/run.py.
//!
//! Reads one request from standard input and answers on standard output. Keys of the request, all needed:
//!
//! * `transfer`: components to encode and to decode;
//! * `reflectance_rgb`, `emission_rgb`: linear sRGB colours to upsample;
//! * `realisable_rgb`: linear colours to look for a reflectance of, in every space.

use abbe::color::{self, RgbSpace, upsample};
use abbe::spectrum::Spectrum;
use abbe::{Error, ErrorKind, Result};
use glam::{DMat3, DVec3};
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
        "spaces": RgbSpace::all().iter().map(space).collect::<Vec<_>>(),
        "encoded": numbers(&request["transfer"])?.into_iter().map(color::srgb_encode).collect::<Vec<_>>(),
        "decoded": numbers(&request["transfer"])?.into_iter().map(color::srgb_decode).collect::<Vec<_>>(),
        "reflectance_spectra": upsampled(&request, "reflectance_rgb", upsample::reflectance)?,
        "realisable": realisable(&request)?,
        "emission_spectra": upsampled(&request, "emission_rgb", upsample::emission)?,
    }))
}

fn space(space: &RgbSpace) -> Value {
    // Rows as printed in a book; glam keeps columns.
    let rows = |matrix: DMat3| matrix.transpose().to_cols_array_2d();
    json!({
        "name": space.name,
        "primaries": space.primaries,
        "white": space.white,
        "xyz_from_rgb": rows(space.xyz_from_rgb),
        "rgb_from_xyz": rows(space.rgb_from_xyz),
    })
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

/// By space: whether each colour has a reflectance.
fn realisable(request: &Value) -> Result<Value> {
    let colors = list(request, "realisable_rgb")?.iter().map(rgb).collect::<Result<Vec<_>>>()?;
    let in_space = |space: &RgbSpace| -> Vec<bool> {
        colors.iter().map(|&color| upsample::reflectance(color, space).is_ok()).collect()
    };
    Ok(RgbSpace::all().iter().map(|space| (space.name.to_owned(), json!(in_space(space)))).collect())
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
