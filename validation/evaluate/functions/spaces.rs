//! Colour spaces and lightness.

use super::{Answer, Function, read};
use abbe::color::lightness::{self, AbebeCurve, HdrEdition};
use abbe::color::space::{self, Din99, Din99Factors, HdrConditions};
use glam::DVec3;
use serde_json::{Value, json};

/// By name.
pub const FUNCTIONS: &[(&str, Function)] = &[
    ("space_from_xyz", from_xyz),
    ("space_to_xyz", to_xyz),
    ("space_round_trip", round_trip),
    ("hdr_space_from_xyz", hdr_from_xyz),
    ("hdr_space_to_xyz", hdr_to_xyz),
    ("din99_from_lab", din99_from_lab),
    ("lab_from_din99", lab_from_din99),
    ("xy_from_uv_1976", |uv| Ok(json!(space::xy_from_uv_1976(read(uv)?)))),
    ("xy_from_uv_1960", |uv| Ok(json!(space::xy_from_uv_1960(read(uv)?)))),
    ("scale", scale),
    ("abebe2017", abebe2017),
    ("abebe2017_inverse", abebe2017_inverse),
];

/// `[space, xyz, white]`.
fn from_xyz(argument: &Value) -> Answer {
    let (name, xyz, white): (String, [f64; 3], [f64; 3]) = read(argument)?;
    Ok(json!((space::by_name(&name)?.from_xyz)(xyz.into(), white.into()).to_array()))
}

/// `[space, coordinates, white]`.
fn to_xyz(argument: &Value) -> Answer {
    let (name, coordinates, white): (String, [f64; 3], [f64; 3]) = read(argument)?;
    Ok(json!((space::by_name(&name)?.to_xyz)(coordinates.into(), white.into()).to_array()))
}

/// `[space, xyz, white]`: there and back.
fn round_trip(argument: &Value) -> Answer {
    let (name, xyz, white): (String, [f64; 3], [f64; 3]) = read(argument)?;
    let space = space::by_name(&name)?;
    Ok(json!((space.to_xyz)((space.from_xyz)(xyz.into(), white.into()), white.into()).to_array()))
}

/// `[space, edition, surround, white in cd/m², coordinates, white]`.
type HdrArgument = (String, u32, f64, f64, [f64; 3], [f64; 3]);

fn hdr(argument: &Value) -> Result<(String, HdrConditions, DVec3, DVec3), Box<dyn std::error::Error>> {
    let (name, edition, surround, white_cd_m2, coordinates, white): HdrArgument = read(argument)?;
    let edition = if edition == 2010 { HdrEdition::Fairchild2010 } else { HdrEdition::Fairchild2011 };
    Ok((name, HdrConditions { surround, white_cd_m2, edition }, coordinates.into(), white.into()))
}

fn hdr_from_xyz(argument: &Value) -> Answer {
    let (name, conditions, xyz, white) = hdr(argument)?;
    let value = match name.as_str() {
        "hdr-ipt" => space::hdr_ipt_from_xyz(xyz, conditions),
        _ => space::hdr_cielab_from_xyz(xyz, white, conditions),
    };
    Ok(json!(value.to_array()))
}

fn hdr_to_xyz(argument: &Value) -> Answer {
    let (name, conditions, value, white) = hdr(argument)?;
    let xyz = match name.as_str() {
        "hdr-ipt" => space::xyz_from_hdr_ipt(value, conditions),
        _ => space::xyz_from_hdr_cielab(value, white, conditions),
    };
    Ok(json!(xyz.to_array()))
}

/// `[formula, k_e, k_ch, coordinates]`.
fn din99(argument: &Value) -> Result<(Din99, Din99Factors, DVec3), Box<dyn std::error::Error>> {
    let (formula, k_e, k_ch, coordinates): (String, f64, f64, [f64; 3]) = read(argument)?;
    let formula = match formula.as_str() {
        "din99" => Din99::Standard,
        "din99b" => Din99::B,
        "din99c" => Din99::C,
        "din99d" => Din99::D,
        other => return Err(format!("no formula {other:?}").into()),
    };
    Ok((formula, Din99Factors { k_e, k_ch }, coordinates.into()))
}

fn din99_from_lab(argument: &Value) -> Answer {
    let (formula, factors, lab) = din99(argument)?;
    Ok(json!(space::din99_from_lab(lab, formula, factors).to_array()))
}

fn lab_from_din99(argument: &Value) -> Answer {
    let (formula, factors, value) = din99(argument)?;
    Ok(json!(space::lab_from_din99(value, formula, factors).to_array()))
}

/// `[name of a function of one number, its argument]`.
fn scale(argument: &Value) -> Answer {
    let (name, x): (String, f64) = read(argument)?;
    let function: fn(f64) -> f64 = match name.as_str() {
        "lightness-cie1976" => lightness::lightness_cie_1976,
        "lightness-glasser1958" => lightness::lightness_glasser1958,
        "lightness-wyszecki1963" => lightness::lightness_wyszecki1963,
        "lightness-fairchild2010" => lightness::lightness_fairchild2010,
        "lightness-fairchild2011" => lightness::lightness_fairchild2011,
        "luminance-cie1976" => lightness::luminance_cie_1976,
        "luminance-fairchild2010" => lightness::luminance_fairchild2010,
        "luminance-fairchild2011" => lightness::luminance_fairchild2011,
        "luminance-newhall1943" => lightness::luminance_newhall1943,
        "luminance-astm-d1535" => lightness::luminance_astm_d1535,
        "munsell-value-astm-d1535" => lightness::munsell_value_astm_d1535,
        other => return Err(format!("no scale {other:?}").into()),
    };
    Ok(json!(function(x)))
}

/// `[curve, x, white in cd/m²]`.
fn abebe(argument: &Value) -> Result<(f64, f64, AbebeCurve), Box<dyn std::error::Error>> {
    let (curve, x, white_cd_m2): (String, f64, f64) = read(argument)?;
    let curve = if curve == "stevens" { AbebeCurve::Stevens } else { AbebeCurve::MichaelisMenten };
    Ok((x, white_cd_m2, curve))
}

fn abebe2017(argument: &Value) -> Answer {
    let (y, white_cd_m2, curve) = abebe(argument)?;
    Ok(json!(lightness::lightness_abebe2017(y, white_cd_m2, curve)))
}

fn abebe2017_inverse(argument: &Value) -> Answer {
    let (value, white_cd_m2, curve) = abebe(argument)?;
    Ok(json!(lightness::luminance_abebe2017(value, white_cd_m2, curve)))
}
