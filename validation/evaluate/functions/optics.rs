//! Reflection and refraction at a smooth boundary.

use super::{Answer, Function, read};
use abbe::optics;
use serde_json::{Value, json};

/// By name.
pub const FUNCTIONS: &[(&str, Function)] = &[("refract", refract), ("conductor_reflectance", conductor)];

/// Reflectance of unpolarised light, and the cosine of the refracted ray; 1 and 0 beyond the critical angle. Of
/// `[cos θ, n, n']`.
fn refract(argument: &Value) -> Answer {
    let [cos_theta, from, to]: [f64; 3] = read(argument)?;
    let refraction = optics::refract(cos_theta, from, to);
    Ok(refraction.map_or(json!([1.0, 0.0]), |r| json!([r.reflectance, r.cos_theta_t])))
}

/// Of `[cos θ, n outside, n, k]`.
fn conductor(argument: &Value) -> Answer {
    let [cos_theta, outside, n, k]: [f64; 4] = read(argument)?;
    Ok(json!(optics::fresnel_conductor(cos_theta, outside, n, k)))
}
