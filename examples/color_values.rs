//! Values of the colour library as JSON, for validation/run.py.
//!
//! Reads one request from standard input and answers on standard output. A table is
//! `{"wavelengths_nm": […], "values": […]}`. Keys of the request, all needed:
//!
//! * `illuminants`: names; `reflectances`, `emissions`: tables; `lines`: `[centre, width]` in nm;
//! * `blackbodies`: temperatures in K, `wavelengths_nm` to evaluate them at;
//! * `transfer`: components to encode and to decode.

use abbe::color::{self, Observer, RgbSpace, illuminant};
use abbe::spectrum::{PiecewiseLinear, Spectrum};
use abbe::{Error, ErrorKind, Result};
use glam::DMat3;
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
    let observer = Observer::cie_1931_2deg();
    let names = list(&request, "illuminants")?.iter().map(name).collect::<Result<Vec<_>>>()?;
    let lamps = names.iter().map(|name| illuminant::by_name(name)).collect::<Result<Vec<_>>>()?;
    let reflectances = list(&request, "reflectances")?.iter().map(table).collect::<Result<Vec<_>>>()?;
    let emissions = list(&request, "emissions")?.iter().map(table).collect::<Result<Vec<_>>>()?;
    let lines = list(&request, "lines")?.iter().map(line).collect::<Result<Vec<_>>>()?;
    let bodies = numbers(&request["blackbodies"])?.into_iter().map(Spectrum::blackbody).collect::<Result<Vec<_>>>()?;
    let xyz = |spectrum: &Spectrum| color::xyz_of_emission(spectrum, observer).to_array();
    let under_lamps = |reflectance: &Spectrum| -> Vec<[f64; 3]> {
        lamps.iter().map(|lamp| color::xyz_of_reflectance(reflectance, lamp, observer).to_array()).collect()
    };
    Ok(json!({
        "illuminant_names": illuminant::names().collect::<Vec<_>>(),
        "illuminant_xyz": lamps.iter().map(xyz).collect::<Vec<_>>(),
        "reflectance_xyz": reflectances.iter().map(under_lamps).collect::<Vec<_>>(),
        "emission_xyz": emissions.iter().map(xyz).collect::<Vec<_>>(),
        "line_xyz": lines.iter().map(xyz).collect::<Vec<_>>(),
        "blackbodies": blackbodies(&request)?,
        "blackbody_xyz": bodies.iter().map(xyz).collect::<Vec<_>>(),
        "spaces": RgbSpace::all().iter().map(space).collect::<Vec<_>>(),
        "encoded": numbers(&request["transfer"])?.into_iter().map(color::srgb_encode).collect::<Vec<_>>(),
        "decoded": numbers(&request["transfer"])?.into_iter().map(color::srgb_decode).collect::<Vec<_>>(),
    }))
}

fn blackbodies(request: &Value) -> Result<Vec<Vec<f64>>> {
    let lambdas = numbers(&request["wavelengths_nm"])?;
    let radiances = |kelvin| {
        let body = Spectrum::blackbody(kelvin)?;
        Ok(lambdas.iter().map(|&lambda| body.eval(lambda)).collect())
    };
    numbers(&request["blackbodies"])?.into_iter().map(radiances).collect()
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

fn list<'a>(value: &'a Value, key: &str) -> Result<&'a [Value]> {
    let missing = || Error::new(ErrorKind::Missing, format!("no list {key:?} in the request"));
    value[key].as_array().map(Vec::as_slice).ok_or_else(missing)
}

fn name(value: &Value) -> Result<&str> {
    value.as_str().ok_or_else(|| Error::new(ErrorKind::WrongType, format!("{value}; expected a name")))
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

fn table(value: &Value) -> Result<Spectrum> {
    let table = PiecewiseLinear::new(numbers(&value["wavelengths_nm"])?, numbers(&value["values"])?)?;
    Ok(Spectrum::PiecewiseLinear(table))
}

fn line(value: &Value) -> Result<Spectrum> {
    let [center_nm, fwhm_nm] = numbers_exactly(value, 2)?[..] else {
        return Err(Error::new(ErrorKind::WrongType, format!("{value}; expected centre and width")));
    };
    Spectrum::line(center_nm, fwhm_nm)
}
