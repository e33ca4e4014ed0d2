//! Light by formula, and correlated colour temperature.

use super::{Answer, Function, read};
use abbe::color::daylight::{self, Factors};
use abbe::color::illuminant;
use abbe::color::led::{self, Led};
use abbe::color::temperature::{self, Approximation, ohno, robertson};
use abbe::color::thermal::{RadiationConstants, rayleigh_jeans_radiance};
use abbe::spectrum::Spectrum;
use abbe::spectrum::resample::Grid;
use serde_json::{Value, json};

/// By name.
pub const FUNCTIONS: &[(&str, Function)] = &[
    ("blackbody", blackbody),
    ("planck_law", planck_law),
    ("rayleigh_jeans_law", rayleigh_jeans_law),
    ("illuminant_a", illuminant_a),
    ("daylight_xy", daylight_xy),
    ("daylight_of_xy", daylight_of_xy),
    ("daylight_of_kelvin", daylight_of_kelvin),
    ("gaussian", gaussian),
    ("gaussian_of_fwhm", gaussian_of_fwhm),
    ("leds", leds),
    ("cct", cct),
    ("duv", duv),
    ("cct_its_90", cct_its_90),
    ("uv_of_cct", uv_of_cct),
    ("cct_by", cct_by),
    ("uv_of_cct_by", uv_of_cct_by),
    ("ohno_2013_duv", ohno_2013_duv),
    ("uv_of_ohno_2013", uv_of_ohno_2013),
    ("robertson_1968_duv", robertson_1968_duv),
    ("uv_of_robertson_1968", uv_of_robertson_1968),
];

fn at_each(lambdas: &[f64], f: impl Fn(f64) -> f64) -> Answer {
    Ok(json!(lambdas.iter().map(|&lambda| f(lambda)).collect::<Vec<_>>()))
}

/// The renderer's, of a temperature and wavelengths.
fn blackbody(argument: &Value) -> Answer {
    let (kelvin, lambdas): (f64, Vec<f64>) = read(argument)?;
    let body = Spectrum::blackbody(kelvin)?;
    at_each(&lambdas, |lambda| body.eval(lambda))
}

/// Of named constants, a temperature and wavelengths.
fn planck_law(argument: &Value) -> Answer {
    let (name, kelvin, lambdas): (String, f64, Vec<f64>) = read(argument)?;
    let constants = RadiationConstants::by_name(&name)?;
    at_each(&lambdas, |lambda| constants.planck_radiance(lambda, kelvin))
}

fn rayleigh_jeans_law(argument: &Value) -> Answer {
    let (kelvin, lambdas): (f64, Vec<f64>) = read(argument)?;
    at_each(&lambdas, |lambda| rayleigh_jeans_radiance(lambda, kelvin))
}

fn illuminant_a(argument: &Value) -> Answer {
    Ok(json!(illuminant::standard_a(read(argument)?)))
}

fn daylight_xy(argument: &Value) -> Answer {
    Ok(json!(daylight::xy(read(argument)?)?))
}

fn factors(rounded: bool) -> Factors {
    if rounded { Factors::Rounded } else { Factors::Exact }
}

/// Of a chromaticity and whether factors are rounded.
fn daylight_of_xy(argument: &Value) -> Answer {
    let (xy, rounded) = read(argument)?;
    Ok(json!(daylight::of_xy(xy, factors(rounded))?.values()))
}

fn daylight_of_kelvin(argument: &Value) -> Answer {
    let (kelvin, rounded) = read(argument)?;
    Ok(json!(daylight::of_kelvin(kelvin, factors(rounded))?.values()))
}

/// Of a centre, a standard deviation and wavelengths.
fn gaussian(argument: &Value) -> Answer {
    let (mean, sigma, lambdas): (f64, f64, Vec<f64>) = read(argument)?;
    at_each(&lambdas, |lambda| led::gaussian(lambda, mean, sigma))
}

/// Of a centre, a width and wavelengths.
fn gaussian_of_fwhm(argument: &Value) -> Answer {
    let (peak, fwhm, lambdas): (f64, f64, Vec<f64>) = read(argument)?;
    at_each(&lambdas, |lambda| led::gaussian_of_fwhm(lambda, peak, fwhm))
}

/// Of a list of peak, width and power, and a grid.
fn leds(argument: &Value) -> Answer {
    let (list, [from, to, step]): (Vec<[f64; 3]>, [f64; 3]) = read(argument)?;
    let led = |[peak, width, power]: [f64; 3]| Ok(Led::new(peak, width)?.with_power(power));
    let list = list.into_iter().map(led).collect::<abbe::Result<Vec<_>>>()?;
    Ok(json!(led::tabulate(&list, &Grid::new(from, to, step)?)?.values()))
}

fn cct(argument: &Value) -> Answer {
    Ok(json!(temperature::correlated(read(argument)?)?.kelvin))
}

fn duv(argument: &Value) -> Answer {
    Ok(json!(temperature::correlated(read(argument)?)?.duv))
}

fn cct_its_90(argument: &Value) -> Answer {
    Ok(json!(temperature::its_90_from_si(temperature::correlated(read(argument)?)?.kelvin)))
}

/// Of a temperature and a distance.
fn uv_of_cct(argument: &Value) -> Answer {
    let (kelvin, duv) = read(argument)?;
    Ok(json!(temperature::uv_at(kelvin, duv)?))
}

/// Of a method and a chromaticity.
fn cct_by(argument: &Value) -> Answer {
    let (name, uv): (String, _) = read(argument)?;
    Ok(json!(Approximation::by_name(&name)?.kelvin(uv)?))
}

/// Of a method and a temperature.
fn uv_of_cct_by(argument: &Value) -> Answer {
    let (name, kelvin): (String, _) = read(argument)?;
    Ok(json!(Approximation::by_name(&name)?.uv(kelvin)?))
}

fn ohno_2013_duv(argument: &Value) -> Answer {
    Ok(json!(ohno::correlated(read(argument)?)?.duv))
}

fn uv_of_ohno_2013(argument: &Value) -> Answer {
    let (kelvin, duv) = read(argument)?;
    Ok(json!(ohno::uv_at(kelvin, duv)?))
}

fn robertson_1968_duv(argument: &Value) -> Answer {
    Ok(json!(robertson::correlated(read(argument)?)?.duv))
}

fn uv_of_robertson_1968(argument: &Value) -> Answer {
    let (kelvin, duv) = read(argument)?;
    Ok(json!(robertson::uv_at(kelvin, duv)?))
}
