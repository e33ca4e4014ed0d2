//! Wavelength, purity, optimal colours, whiteness, yellowness.

use super::{Answer, Function, read};
use abbe::color::chroma::{self, Field, OptimalColors, Whiteness, YellownessIlluminant};
use abbe::color::{Observer, illuminant};
use serde_json::{Value, json};
use std::collections::HashMap;
use std::sync::LazyLock;

/// By name.
pub const FUNCTIONS: &[(&str, Function)] = &[
    ("dominant_wavelength", dominant),
    ("complementary_wavelength", complementary),
    ("is_within_locus", within_locus),
    ("optimal_band", band),
    ("macadam_limit", limit),
    ("is_within_macadam_limits", within_limits),
    ("whiteness", whiteness),
    ("yellowness", yellowness),
];

/// `[xy, white]`: wavelength in nm, negative for a complementary one, and the two purities.
fn dominant(argument: &Value) -> Answer {
    let (xy, white): ([f64; 2], [f64; 2]) = read(argument)?;
    let found = chroma::dominant_wavelength(xy, white, Observer::cie_1931_2deg()).ok_or("no dominant wavelength")?;
    let sign = if found.is_complementary { -1.0 } else { 1.0 };
    Ok(json!([sign * found.lambda_nm, found.excitation_purity, found.colorimetric_purity]))
}

/// `[xy, white]`.
fn complementary(argument: &Value) -> Answer {
    let (xy, white): ([f64; 2], [f64; 2]) = read(argument)?;
    let found = chroma::complementary_wavelength(xy, white, Observer::cie_1931_2deg());
    Ok(json!(found.ok_or("no complementary wavelength")?))
}

fn within_locus(xy: &Value) -> Answer {
    Ok(json!(f64::from(chroma::is_within_locus(read(xy)?, Observer::cie_1931_2deg()))))
}

/// Optimal colours of every standard illuminant.
static OPTIMAL: LazyLock<HashMap<&str, OptimalColors>> = LazyLock::new(|| {
    let optimal = |name| OptimalColors::new(&illuminant::by_name(name)?, Observer::cie_1931_2deg());
    illuminant::names().filter_map(|name| Some((name, optimal(name).ok()?))).collect()
});

fn optimal(name: &str) -> Result<&'static OptimalColors, String> {
    OPTIMAL.get(name).ok_or_else(|| format!("no illuminant {name:?}"))
}

/// `[illuminant, from, to]`.
fn band(argument: &Value) -> Answer {
    let (name, from, to): (String, f64, f64) = read(argument)?;
    Ok(json!(optimal(&name)?.band(from, to).xyz.to_array()))
}

/// `[illuminant, xy]`.
fn limit(argument: &Value) -> Answer {
    let (name, xy): (String, [f64; 2]) = read(argument)?;
    Ok(json!(optimal(&name)?.limit(xy).ok_or("outside the locus")?))
}

/// `[illuminant, xyz]`: 1 or 0.
fn within_limits(argument: &Value) -> Answer {
    let (name, xyz): (String, [f64; 3]) = read(argument)?;
    Ok(json!(f64::from(optimal(&name)?.contains(xyz.into()))))
}

/// `[index, xyz, white]`: whiteness, or whiteness and tint.
fn whiteness(argument: &Value) -> Answer {
    let (name, xyz, white): (String, [f64; 3], [f64; 3]) = read(argument)?;
    let (xyz, white) = (xyz.into(), white.into());
    let with_tint = |w: Whiteness| json!([w.whiteness, w.tint]);
    Ok(match name.as_str() {
        "berger1959" => json!(chroma::whiteness_berger1959(xyz, white)),
        "taube1960" => json!(chroma::whiteness_taube1960(xyz, white)),
        "stensby1968" => json!(chroma::whiteness_stensby1968_from_xyz(xyz, white)),
        "astm-e313" => json!(chroma::whiteness_astm_e313(xyz)),
        "ganz1979" => with_tint(chroma::whiteness_ganz1979(xyz)),
        "cie2004-2" => with_tint(chroma::whiteness_cie2004(xyz, white, Field::Degrees2)),
        "cie2004-10" => with_tint(chroma::whiteness_cie2004(xyz, white, Field::Degrees10)),
        other => return Err(format!("no whiteness {other:?}").into()),
    })
}

/// `[index, xyz]`.
fn yellowness(argument: &Value) -> Answer {
    let (name, xyz): (String, [f64; 3]) = read(argument)?;
    let xyz = xyz.into();
    let e313 = |illuminant, field| chroma::yellowness_astm_e313(xyz, illuminant, field);
    Ok(json!(match name.as_str() {
        "astm-d1925" => chroma::yellowness_astm_d1925(xyz),
        "astm-e313-alternative" => chroma::yellowness_astm_e313_alternative(xyz),
        "astm-e313-c-2" => e313(YellownessIlluminant::C, Field::Degrees2),
        "astm-e313-d65-2" => e313(YellownessIlluminant::D65, Field::Degrees2),
        "astm-e313-c-10" => e313(YellownessIlluminant::C, Field::Degrees10),
        "astm-e313-d65-10" => e313(YellownessIlluminant::D65, Field::Degrees10),
        other => return Err(format!("no yellowness {other:?}").into()),
    }))
}
