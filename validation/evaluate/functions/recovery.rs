//! Spectra from RGB.

use super::{Answer, Function, read};
use abbe::color::upsample::{self, Method, Natural, Table, jakob_hanika::CoefficientTable, meng, otsu};
use abbe::color::{RgbSpace, illuminant};
use abbe::spectrum::{PiecewiseLinear, Spectrum};
use serde_json::{Value, json};

/// By name.
pub const FUNCTIONS: &[(&str, Function)] = &[
    ("upsampled", upsampled),
    ("upsampled_at", upsampled_at),
    ("upsampled_emission", emission),
    ("upsampled_lamp", lamp),
    ("projected", projected),
    ("has_reflectance", has_reflectance),
    ("natural_with_anchors", with_anchors),
    ("texture_reflectance", texture),
    ("otsu_unclipped", otsu_unclipped),
    ("otsu_clipped", otsu_clipped),
    ("meng", meng_of_xyz),
    ("coefficient_table", coefficient_table),
];

/// Values at 360, 361, …, 830 nm.
fn at_knots(spectrum: &Spectrum) -> Value {
    json!((360..=830).map(|lambda| spectrum.eval(f64::from(lambda))).collect::<Vec<_>>())
}

/// [method, space, [r, g, b]]
fn upsampled(argument: &Value) -> Answer {
    let (method, space, rgb): (String, String, [f64; 3]) = read(argument)?;
    let spectrum = upsample::reflectance_by(Method::by_name(&method)?, rgb, RgbSpace::by_name(&space)?)?;
    Ok(at_knots(&spectrum))
}

/// [method, space, [r, g, b], wavelengths in nm]
fn upsampled_at(argument: &Value) -> Answer {
    let (method, space, rgb, lambdas): (String, String, [f64; 3], Vec<f64>) = read(argument)?;
    let spectrum = upsample::reflectance_by(Method::by_name(&method)?, rgb, RgbSpace::by_name(&space)?)?;
    Ok(json!(lambdas.into_iter().map(|lambda| spectrum.eval(lambda)).collect::<Vec<_>>()))
}

/// [space, [r, g, b]]
fn emission(argument: &Value) -> Answer {
    let (space, rgb): (String, [f64; 3]) = read(argument)?;
    Ok(at_knots(&upsample::emission(rgb, RgbSpace::by_name(&space)?)?))
}

/// [illuminant, space, [r, g, b]]
fn lamp(argument: &Value) -> Answer {
    let (lamp, space, rgb): (String, String, [f64; 3]) = read(argument)?;
    let lamp = illuminant::by_name(&lamp)?;
    Ok(at_knots(&upsample::emission_of_lamp(rgb, RgbSpace::by_name(&space)?, &lamp)?))
}

/// [space, [r, g, b]] to [saturation, colour, values]
fn projected(argument: &Value) -> Answer {
    let (space, rgb): (String, [f64; 3]) = read(argument)?;
    let projected = upsample::projected(rgb, RgbSpace::by_name(&space)?)?;
    Ok(json!([projected.saturation, projected.rgb, at_knots(&projected.spectrum)]))
}

/// [method, space, [r, g, b]] to 1 or 0
fn has_reflectance(argument: &Value) -> Answer {
    let (method, space, rgb): (String, String, [f64; 3]) = read(argument)?;
    let found = upsample::reflectance_by(Method::by_name(&method)?, rgb, RgbSpace::by_name(&space)?).is_ok();
    Ok(json!(u8::from(found)))
}

/// [wavelengths in nm, values of anchors, sRGB colours] to the spectra of the colours
fn with_anchors(argument: &Value) -> Answer {
    let (lambdas, anchors, colors): (Vec<f64>, Vec<Vec<f64>>, Vec<[f64; 3]>) = read(argument)?;
    let spectrum = |values| PiecewiseLinear::new(lambdas.clone(), values).map(Spectrum::PiecewiseLinear);
    let natural = Natural::with_anchors(&anchors.into_iter().map(spectrum).collect::<abbe::Result<Vec<_>>>()?)?;
    let values = |rgb| Ok(at_knots(&natural.reflectance(rgb, RgbSpace::srgb())?));
    Ok(json!(colors.into_iter().map(values).collect::<abbe::Result<Vec<_>>>()?))
}

/// [steps, [r, g, b]] of sRGB
fn texture(argument: &Value) -> Answer {
    let (steps, rgb): (u32, [f64; 3]) = read(argument)?;
    let coefficients = Table::srgb().coefficients(rgb, steps)?;
    Ok(json!((360..=830_u16).map(|lambda| coefficients.eval(f32::from(lambda))).collect::<Vec<_>>()))
}

fn otsu_unclipped(argument: &Value) -> Answer {
    at_ten(&otsu::unclipped(read(argument)?)?)
}

fn otsu_clipped(argument: &Value) -> Answer {
    at_ten(&otsu::clipped(read(argument)?)?)
}

/// Values at 380, 390, …, 730 nm.
fn at_ten(spectrum: &Spectrum) -> Answer {
    Ok(json!((38..=73).map(|ten| spectrum.eval(f64::from(10 * ten))).collect::<Vec<_>>()))
}

/// Values at 360, 361, …, 830 nm.
fn meng_of_xyz(argument: &Value) -> Answer {
    Ok(at_knots(&meng::from_xyz(read(argument)?)?))
}

/// [bytes of a file, colours] to coefficients
fn coefficient_table(argument: &Value) -> Answer {
    let (bytes, colors): (Vec<u8>, Vec<[f64; 3]>) = read(argument)?;
    let table = CoefficientTable::from_bytes(&bytes)?;
    let coefficients = |rgb| Ok(table.lookup(rgb)?.coefficients);
    Ok(json!(colors.into_iter().map(coefficients).collect::<abbe::Result<Vec<_>>>()?))
}
