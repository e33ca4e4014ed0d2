//! Colour differences.

use super::{Answer, Function, read};
use abbe::color::difference::{self, CamSpace};
use serde_json::{Value, json};

/// By name.
pub const FUNCTIONS: &[(&str, Function)] = &[("difference", lab), ("difference_itp", itp), ("difference_cam", cam)];

/// `[name, lab, lab]`.
fn lab(argument: &Value) -> Answer {
    let (name, one, two): (String, [f64; 3], [f64; 3]) = read(argument)?;
    Ok(json!(difference::by_name(&name)?(one.into(), two.into())))
}

fn itp(argument: &Value) -> Answer {
    let (one, two): ([f64; 3], [f64; 3]) = read(argument)?;
    Ok(json!(difference::itp(one.into(), two.into())))
}

/// `["lcd", "scd" or "ucs", jab, jab]`.
fn cam(argument: &Value) -> Answer {
    let (kind, one, two): (String, [f64; 3], [f64; 3]) = read(argument)?;
    let space = match kind.as_str() {
        "lcd" => CamSpace::LargeDifferences,
        "scd" => CamSpace::SmallDifferences,
        _ => CamSpace::Uniform,
    };
    Ok(json!(difference::cam_ucs(one.into(), two.into(), space)))
}
