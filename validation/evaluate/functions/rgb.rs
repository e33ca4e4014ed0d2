//! RGB spaces.

use super::{Answer, Function, read};
use abbe::color::adaptation::ConeTransform;
use abbe::color::{EncodedRgb, LinearRgb, RgbSpace};
use glam::{DMat3, DVec3};
use serde_json::{Value, json};

/// By name; each takes the name of a space first.
pub const FUNCTIONS: &[(&str, Function)] = &[
    ("rgb_names", |_| Ok(json!(RgbSpace::all().iter().map(|space| space.name).collect::<Vec<_>>()))),
    ("rgb_published_names", |_| Ok(json!(RgbSpace::published().iter().map(|space| space.name).collect::<Vec<_>>()))),
    ("rgb_primaries_and_white", |argument| {
        let space = space(argument)?;
        let [r, g, b] = space.primaries;
        Ok(json!([r, g, b, space.white]))
    }),
    ("xyz_from_rgb_matrix", |argument| Ok(rows(space(argument)?.xyz_from_rgb))),
    ("rgb_from_xyz_matrix", |argument| Ok(rows(space(argument)?.rgb_from_xyz))),
    ("rgb_from_rgb_matrix", rgb_from_rgb_matrix),
    ("encoded_from_xyz", |argument| {
        let (name, xyz): (String, [f64; 3]) = read(argument)?;
        let space = RgbSpace::by_name(&name)?;
        Ok(json!(space.encode(space.linear_from_xyz(DVec3::from(xyz))).to_array()))
    }),
    ("xyz_from_encoded", |argument| {
        let (name, rgb): (String, [f64; 3]) = read(argument)?;
        let space = RgbSpace::by_name(&name)?;
        Ok(json!(space.xyz_from_linear(space.decode(EncodedRgb::from(rgb))).to_array()))
    }),
    ("rgb_luminance", |argument| {
        let (name, rgb): (String, [f64; 3]) = read(argument)?;
        Ok(json!(RgbSpace::by_name(&name)?.luminance(LinearRgb::from(rgb))))
    }),
];

fn space(argument: &Value) -> Result<&'static RgbSpace, Box<dyn std::error::Error>> {
    Ok(RgbSpace::by_name(&read::<String>(argument)?)?)
}

/// From, to, name of the adaptation or null.
fn rgb_from_rgb_matrix(argument: &Value) -> Answer {
    let (from, to, adaptation): (String, String, Option<String>) = read(argument)?;
    let adaptation = adaptation.map(|name| ConeTransform::by_name(&name)).transpose()?;
    Ok(rows(RgbSpace::by_name(&to)?.rgb_from(RgbSpace::by_name(&from)?, adaptation)))
}

/// Rows as printed in a book; glam keeps columns.
fn rows(matrix: DMat3) -> Value {
    json!(matrix.transpose().to_cols_array_2d())
}
