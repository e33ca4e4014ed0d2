//! Appearance models. Conditions are a list: surround, adapting luminance, background, whether the illuminant is discounted,
//! XYZ of the white.

use super::{Answer, Function, read};
use abbe::color::appearance::{
    Appearance, AppearanceModel, Hellwig2022, Surround, UniformSpace, ViewingConditions, Zcam,
};
use serde_json::{Value, json};

/// By name.
pub const FUNCTIONS: &[(&str, Function)] = &[
    ("appearance_from_xyz", appearance_from_xyz),
    ("jch_from_xyz", jch_from_xyz),
    ("xyz_from_jch", xyz_from_jch),
    ("xyz_from_jmh", xyz_from_jmh),
    ("hellwig_hk", hellwig_hk),
    ("hellwig_xyz_from_jch_hk", hellwig_xyz_from_jch_hk),
    ("zcam_scales", zcam_scales),
    ("ucs_from_jmh", ucs_from_jmh),
    ("jmh_from_ucs", jmh_from_ucs),
    ("ucs_difference", ucs_difference),
];

type Conditions = (String, f64, f64, bool, [f64; 3]);

fn viewing(conditions: Conditions) -> abbe::Result<ViewingConditions> {
    let (surround, adapting_luminance, background_y, discount_illuminant, white) = conditions;
    let (surround, white_xyz) = (Surround::by_name(&surround)?, white.into());
    Ok(ViewingConditions { white_xyz, adapting_luminance, background_y, surround, discount_illuminant })
}

fn model(name: &str, conditions: Conditions) -> abbe::Result<AppearanceModel> {
    AppearanceModel::by_name(name, &viewing(conditions)?)
}

/// J, C, h, s, Q, M, H.
fn correlates(seen: &Appearance) -> [f64; 7] {
    [
        seen.lightness,
        seen.chroma,
        seen.hue_degrees,
        seen.saturation,
        seen.brightness,
        seen.colorfulness,
        seen.hue_quadrature,
    ]
}

fn appearance_from_xyz(argument: &Value) -> Answer {
    let (name, conditions, xyz): (String, Conditions, [f64; 3]) = read(argument)?;
    Ok(json!(correlates(&model(&name, conditions)?.appearance_from_xyz(xyz.into()))))
}

fn jch_from_xyz(argument: &Value) -> Answer {
    let (name, conditions, xyz): (String, Conditions, [f64; 3]) = read(argument)?;
    Ok(json!(model(&name, conditions)?.appearance_from_xyz(xyz.into()).jch().to_array()))
}

fn xyz_from_jch(argument: &Value) -> Answer {
    let (name, conditions, jch): (String, Conditions, [f64; 3]) = read(argument)?;
    Ok(json!(model(&name, conditions)?.xyz_from_jch(jch.into()).to_array()))
}

fn xyz_from_jmh(argument: &Value) -> Answer {
    let (name, conditions, jmh): (String, Conditions, [f64; 3]) = read(argument)?;
    Ok(json!(model(&name, conditions)?.xyz_from_jmh(jmh.into()).to_array()))
}

fn hellwig_hk(argument: &Value) -> Answer {
    let (conditions, xyz): (Conditions, [f64; 3]) = read(argument)?;
    let model = Hellwig2022::new(&viewing(conditions)?)?;
    let hk = model.helmholtz_kohlrausch(&model.appearance_from_xyz(xyz.into()));
    Ok(json!([hk.lightness, hk.brightness]))
}

fn hellwig_xyz_from_jch_hk(argument: &Value) -> Answer {
    let (conditions, jch): (Conditions, [f64; 3]) = read(argument)?;
    Ok(json!(Hellwig2022::new(&viewing(conditions)?)?.xyz_from_jch_hk(jch.into()).to_array()))
}

fn zcam_scales(argument: &Value) -> Answer {
    let (conditions, xyz): (Conditions, [f64; 3]) = read(argument)?;
    let scales = Zcam::scales(&Zcam::new(&viewing(conditions)?)?.appearance_from_xyz(xyz.into()));
    Ok(json!([scales.vividness, scales.blackness, scales.whiteness]))
}

fn ucs_from_jmh(argument: &Value) -> Answer {
    let (space, jmh): (String, [f64; 3]) = read(argument)?;
    Ok(json!(UniformSpace::by_name(&space)?.ucs_from_jmh(jmh.into()).to_array()))
}

fn jmh_from_ucs(argument: &Value) -> Answer {
    let (space, ucs): (String, [f64; 3]) = read(argument)?;
    Ok(json!(UniformSpace::by_name(&space)?.jmh_from_ucs(ucs.into()).to_array()))
}

fn ucs_difference(argument: &Value) -> Answer {
    let (space, a, b): (String, [f64; 3], [f64; 3]) = read(argument)?;
    Ok(json!(UniformSpace::by_name(&space)?.difference(a.into(), b.into())))
}
