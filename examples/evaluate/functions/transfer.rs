//! Transfer functions.

use super::{Answer, Function, read};
use abbe::color::srgb_encode;
use serde_json::{Value, json};

/// By name.
pub const FUNCTIONS: &[(&str, Function)] = &[("srgb_encode", encode)];

fn encode(argument: &Value) -> Answer {
    Ok(json!(srgb_encode(read(argument)?)))
}
