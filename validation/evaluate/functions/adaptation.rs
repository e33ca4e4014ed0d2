//! Chromatic adaptation.

use super::{Answer, Function, read};
use abbe::color::adaptation::{
    Cie1994, Cie1994Field, ConeTransform, Fairchild1991Field, Surround, cmccat2000, fairchild1991, fairchild2020,
    li2025, zhai2018,
};
use glam::{DMat3, DVec3};
use serde_json::{Value, json};

/// By name.
pub const FUNCTIONS: &[(&str, Function)] = &[
    ("cone_transform_names", |_| Ok(json!(ConeTransform::names().collect::<Vec<_>>()))),
    ("cone_adaptation_matrix", |argument| {
        let (name, from, to): (String, [f64; 3], [f64; 3]) = read(argument)?;
        Ok(rows(ConeTransform::by_name(&name)?.adaptation(from.into(), to.into())))
    }),
    ("cie1994_forward", |argument| cie1994(argument, Cie1994::forward)),
    ("cie1994_inverse", |argument| cie1994(argument, Cie1994::inverse)),
    ("cmccat2000_forward", |argument| cmccat(argument, |matrix| matrix)),
    ("cmccat2000_inverse", |argument| cmccat(argument, |matrix| matrix.inverse())),
    ("zhai2018", zhai),
    ("fairchild1991", fairchild),
    ("fairchild2020_matrix", |argument| {
        let (whites, weights, transform): ([[f64; 3]; 3], [f64; 3], String) = read(argument)?;
        Ok(rows(fairchild2020(whites.map(DVec3::from), weights, ConeTransform::by_name(&transform)?)))
    }),
    ("li2025", |argument| {
        type Argument = ([f64; 3], [f64; 3], [f64; 3], f64, Option<f64>);
        let (xyz, from, to, luminance, surround): Argument = read(argument)?;
        let matrix = li2025(from.into(), to.into(), luminance, surround.unwrap_or(f64::INFINITY));
        Ok(json!((matrix * DVec3::from(xyz)).to_array()))
    }),
];

/// XYZ, both chromaticities, both illuminances, background, noise.
fn cie1994(argument: &Value, direction: fn(&Cie1994, DVec3) -> DVec3) -> Answer {
    let (xyz, [xy_1, xy_2], [e_1, e_2], background, noise): ([f64; 3], [[f64; 2]; 2], [f64; 2], f64, f64) =
        read(argument)?;
    let field = |white_xy, illuminance| Cie1994Field { white_xy, illuminance };
    let model = Cie1994::new(field(xy_1, e_1), field(xy_2, e_2), background, noise)?;
    Ok(json!(direction(&model, xyz.into()).to_array()))
}

/// XYZ, both whites, both luminances, whether the surround is dim.
fn cmccat(argument: &Value, direction: fn(DMat3) -> DMat3) -> Answer {
    let (xyz, from, to, luminances, dim): ([f64; 3], [f64; 3], [f64; 3], [f64; 2], bool) = read(argument)?;
    let surround = if dim { Surround::Dim } else { Surround::Average };
    let matrix = direction(cmccat2000(from.into(), to.into(), luminances, surround));
    Ok(json!((matrix * DVec3::from(xyz)).to_array()))
}

/// XYZ, both whites, both degrees, baseline white, name of the transform.
fn zhai(argument: &Value) -> Answer {
    type Argument = ([f64; 3], [[f64; 3]; 2], [f64; 2], [f64; 3], String);
    let (xyz, [from, to], degrees, baseline, transform): Argument = read(argument)?;
    let transform = ConeTransform::by_name(&transform)?;
    let matrix = zhai2018(from.into(), to.into(), degrees, baseline.into(), transform);
    Ok(json!((matrix * DVec3::from(xyz)).to_array()))
}

/// XYZ, both whites, both luminances, whether the illuminant is discounted.
fn fairchild(argument: &Value) -> Answer {
    let (xyz, whites, luminances, discounts): ([f64; 3], [[f64; 3]; 2], [f64; 2], bool) = read(argument)?;
    let field = |i: usize| Fairchild1991Field {
        white: whites[i].into(),
        luminance: luminances[i],
        discounts_illuminant: discounts,
    };
    Ok(json!((fairchild1991(field(0), field(1)) * DVec3::from(xyz)).to_array()))
}

/// Rows as printed in a book; glam keeps columns.
fn rows(matrix: DMat3) -> Value {
    json!(matrix.transpose().to_cols_array_2d())
}
