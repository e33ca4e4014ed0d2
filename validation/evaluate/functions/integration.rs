//! Resampling, and XYZ of spectra by the exact rule, by sums and by ASTM E308. A table is `[wavelengths in nm, values]`.

use super::{Answer, Function, read};
use abbe::color::{Observer, astm_e308, illuminant, sums, xyz_of_emission, xyz_of_reflectance};
use abbe::spectrum::resample::{Extrapolation, Grid, Interpolation, align, interpolate, trim};
use abbe::spectrum::{PiecewiseLinear, Spectrum};
use glam::DVec3;
use serde_json::{Value, json};
use std::error::Error;

/// By name.
pub const FUNCTIONS: &[(&str, Function)] = &[
    ("interpolate", interpolated),
    ("align", aligned),
    ("trim", trimmed),
    ("xyz_of_illuminant", of_illuminant),
    ("xyz_of_emission", of_emission),
    ("xyz_of_reflectance", of_reflectance),
    ("xyz_of_line", of_line),
    ("xyz_of_blackbody", of_blackbody),
    ("xyz_by_sum", by_sum),
    ("xyz_by_astm_e308", by_astm_e308),
    ("xyz_by_astm_e308_weights", by_weights),
    ("astm_e308_weights", weights),
];

type Table = (Vec<f64>, Vec<f64>);

fn table((lambdas, values): Table) -> abbe::Result<PiecewiseLinear> {
    PiecewiseLinear::new(lambdas, values)
}

fn spectrum(samples: Table) -> abbe::Result<Spectrum> {
    table(samples).map(Spectrum::PiecewiseLinear)
}

fn grid([from, to, step]: [f64; 3]) -> abbe::Result<Grid> {
    Grid::new(from, to, step)
}

fn answer(xyz: DVec3) -> Answer {
    Ok(json!(xyz.to_array()))
}

/// Of a table, wavelengths and an interpolation.
fn interpolated(argument: &Value) -> Answer {
    let (samples, lambdas, name): (Table, Vec<f64>, String) = read(argument)?;
    Ok(json!(interpolate(&table(samples)?, &lambdas, Interpolation::by_name(&name)?)?))
}

/// Of a table, a grid, an interpolation and an extrapolation: the values.
fn aligned(argument: &Value) -> Answer {
    let (samples, at, inside, outside): (Table, [f64; 3], String, String) = read(argument)?;
    let (inside, outside) = (Interpolation::by_name(&inside)?, Extrapolation::by_name(&outside)?);
    Ok(json!(align(&table(samples)?, &grid(at)?, inside, outside)?.values()))
}

/// Of a table and two wavelengths: pairs of wavelength and value.
fn trimmed(argument: &Value) -> Answer {
    let (samples, from, to): (Table, f64, f64) = read(argument)?;
    Ok(json!(trim(&table(samples)?, from, to)?.knots().collect::<Vec<_>>()))
}

fn of_illuminant(argument: &Value) -> Answer {
    answer(xyz_of_emission(&illuminant::by_name(&read::<String>(argument)?)?, Observer::cie_1931_2deg()))
}

/// Of a table and an observer.
fn of_emission(argument: &Value) -> Answer {
    let (samples, observer): (Table, String) = read(argument)?;
    answer(xyz_of_emission(&spectrum(samples)?, Observer::by_name(&observer)?))
}

/// A table under a named illuminant, for a named observer.
fn under(argument: &Value) -> Result<(PiecewiseLinear, Spectrum, &'static Observer), Box<dyn Error>> {
    let (samples, lamp, observer): (Table, String, String) = read(argument)?;
    Ok((table(samples)?, illuminant::by_name(&lamp)?, Observer::by_name(&observer)?))
}

fn of_reflectance(argument: &Value) -> Answer {
    let (samples, lamp, observer) = under(argument)?;
    answer(xyz_of_reflectance(&Spectrum::PiecewiseLinear(samples), &lamp, observer))
}

/// Of a centre and a width in nm.
fn of_line(argument: &Value) -> Answer {
    let (center_nm, fwhm_nm) = read(argument)?;
    answer(xyz_of_emission(&Spectrum::line(center_nm, fwhm_nm)?, Observer::cie_1931_2deg()))
}

fn of_blackbody(argument: &Value) -> Answer {
    answer(xyz_of_emission(&Spectrum::blackbody(read(argument)?)?, Observer::cie_1931_2deg()))
}

/// Of a table, an illuminant, an observer, a grid and the table's interpolation.
fn by_sum(argument: &Value) -> Answer {
    let (samples, lamp, observer, at, inside): (Table, String, String, [f64; 3], String) = read(argument)?;
    let at = grid(at)?;
    let samples = align(&table(samples)?, &at, Interpolation::by_name(&inside)?, Extrapolation::Constant)?;
    let (lamp, observer) = (illuminant::by_name(&lamp)?, Observer::by_name(&observer)?);
    answer(sums::xyz_of_reflectance(&Spectrum::PiecewiseLinear(samples), &lamp, observer, &at))
}

fn by_astm_e308(argument: &Value) -> Answer {
    let (samples, lamp, observer) = under(argument)?;
    answer(astm_e308::xyz_of_reflectance(&samples, &lamp, observer)?)
}

/// The weights at the samples' own step, even if it is 20 nm.
fn by_weights(argument: &Value) -> Answer {
    let (samples, lamp, observer) = under(argument)?;
    let step_nm = Grid::of_samples(&samples).ok_or("unequal distances")?.step_nm();
    answer(astm_e308::Weights::new(&lamp, observer, step_nm)?.xyz(&samples)?)
}

/// Of an illuminant, an observer and a step: the rows.
fn weights(argument: &Value) -> Answer {
    let (lamp, observer, step_nm): (String, String, f64) = read(argument)?;
    let weights = astm_e308::Weights::new(&illuminant::by_name(&lamp)?, Observer::by_name(&observer)?, step_nm)?;
    Ok(json!(weights.rows().map(|(_, row)| row.to_array()).collect::<Vec<_>>()))
}
