//! Light quality. A light is a list of wavelengths in nm and a list of values: a table.

use super::{Answer, Function, read};
use abbe::color::luminous::LuminousEfficiency;
use abbe::color::quality;
use abbe::spectrum::{PiecewiseLinear, Spectrum};
use serde_json::{Value, json};

/// By name.
pub const FUNCTIONS: &[(&str, Function)] = &[
    ("cri", cri),
    ("cri_against", cri_against),
    ("cqs", cqs),
    ("cqs_preference", cqs_preference),
    ("fidelity", fidelity),
    ("tm30", tm30),
    ("ssi", ssi),
    ("luminous_at_samples", luminous_at_samples),
    ("luminous", luminous),
];

type Samples = (Vec<f64>, Vec<f64>);

fn table((lambda_nm, values): Samples) -> abbe::Result<PiecewiseLinear> {
    PiecewiseLinear::new(lambda_nm, values)
}

fn light(samples: Samples) -> abbe::Result<Spectrum> {
    table(samples).map(Spectrum::PiecewiseLinear)
}

/// Ra, R1 to R15.
fn cri(argument: &Value) -> Answer {
    Ok(indices(&quality::cri(&light(read(argument)?)?)?))
}

/// The same against the reference of a temperature.
fn cri_against(argument: &Value) -> Answer {
    let (samples, kelvin): (Samples, f64) = read(argument)?;
    Ok(indices(&quality::cri_against(&light(samples)?, kelvin)?))
}

fn indices(found: &quality::Cri) -> Value {
    json!([vec![found.ra], found.r.to_vec(), vec![found.r15]].concat())
}

/// Q_a, Q_f, Q_g, Q_a of the samples.
fn cqs(argument: &Value) -> Answer {
    let (version, samples): (String, Samples) = read(argument)?;
    let found = quality::cqs(&light(samples)?, quality::CqsVersion::by_name(&version)?)?;
    Ok(json!([vec![found.qa, found.qf, found.qg], found.q.to_vec()].concat()))
}

/// Q_p, Q_d of version 7.4.
fn cqs_preference(argument: &Value) -> Answer {
    let found = quality::cqs(&light(read(argument)?)?, quality::CqsVersion::V7_4)?;
    Ok(json!([found.qp, found.qd]))
}

/// R_f and those of the samples.
fn fidelity(argument: &Value) -> Answer {
    let found = quality::fidelity(&light(read(argument)?)?)?;
    Ok(json!([vec![found.rf], found.rs.to_vec()].concat()))
}

/// R_f, R_g, and for each bin R_f, R_cs, R_hs, the mean a', b' under the light and under the reference.
fn tm30(argument: &Value) -> Answer {
    let found = quality::tm30(&light(read(argument)?)?)?;
    let bins = found.bins.iter().flatten().flat_map(|bin| {
        let own = [bin.fidelity, bin.chroma_shift_percent, bin.hue_shift];
        [own.as_slice(), &bin.seen, &bin.expected].concat()
    });
    Ok(json!([found.rf, found.rg].into_iter().chain(bins).collect::<Vec<f64>>()))
}

fn ssi(argument: &Value) -> Answer {
    let (test, reference): (Samples, Samples) = read(argument)?;
    Ok(json!(quality::ssi(&light(test)?, &light(reference)?)?))
}

/// Flux and efficiency by sums at the samples.
fn luminous_at_samples(argument: &Value) -> Answer {
    let (name, samples): (String, Samples) = read(argument)?;
    let (function, samples) = (LuminousEfficiency::by_name(&name)?, table(samples)?);
    Ok(json!([function.flux_at_samples(&samples), function.efficiency_at_samples(&samples)?]))
}

/// Flux and efficacy by integrals.
fn luminous(argument: &Value) -> Answer {
    let (name, samples): (String, Samples) = read(argument)?;
    let (function, light) = (LuminousEfficiency::by_name(&name)?, light(samples)?);
    Ok(json!([function.flux(&light), function.efficacy(&light)?]))
}
