//! What validation can ask for, one file a subject: functions from JSON to JSON.

mod adaptation;
mod appearance;
mod chroma;
mod difference;
mod gamut;
mod integration;
mod metrics;
mod optics;
mod quality;
mod recovery;
mod rgb;
mod sources;
mod spaces;
mod tables;
mod transfer;

use serde::de::DeserializeOwned;
use serde_json::Value;
use std::error::Error;

/// What a function returns.
pub type Answer = Result<Value, Box<dyn Error>>;

/// A function of one JSON value.
pub type Function = fn(&Value) -> Answer;

const SUBJECTS: [&[(&str, Function)]; 15] = [
    adaptation::FUNCTIONS,
    appearance::FUNCTIONS,
    chroma::FUNCTIONS,
    difference::FUNCTIONS,
    gamut::FUNCTIONS,
    integration::FUNCTIONS,
    metrics::FUNCTIONS,
    optics::FUNCTIONS,
    quality::FUNCTIONS,
    recovery::FUNCTIONS,
    rgb::FUNCTIONS,
    sources::FUNCTIONS,
    spaces::FUNCTIONS,
    tables::FUNCTIONS,
    transfer::FUNCTIONS,
];

/// A function of any subject.
pub fn by_name(name: &str) -> Option<Function> {
    SUBJECTS.into_iter().flatten().find(|(known, _)| *known == name).map(|(_, function)| *function)
}

/// An argument as a type: numbers, strings, arrays and tuples of them.
fn read<T: DeserializeOwned>(argument: &Value) -> Result<T, Box<dyn Error>> {
    Ok(T::deserialize(argument)?)
}
