//! Reflection and refraction at a smooth boundary.

use super::{Answer, Function, read};
use abbe::optics;
use serde_json::{Value, json};

/// By name.
pub const FUNCTIONS: &[(&str, Function)] = &[("refract", refract), ("conductor_reflectance", conductor)];

/// Reflectance of unpolarised light, and the sine of the refracted ray; 1 and the sine that Snell's law would need beyond the
/// critical angle. Of `[cos θ, n, n']`.
fn refract(argument: &Value) -> Answer {
    let [cos_theta, from, to]: [f64; 3] = read(argument)?;
    Ok(match optics::refract(cos_theta, from, to) {
        Some(r) => json!([r.reflectance, (1.0 - r.cos_theta_t * r.cos_theta_t).max(0.0).sqrt()]),
        None => json!([1.0, from / to * (1.0 - cos_theta * cos_theta).sqrt()]),
    })
}

/// Of `[cos θ, n outside, n, k]`.
fn conductor(argument: &Value) -> Answer {
    let [cos_theta, outside, n, k]: [f64; 4] = read(argument)?;
    Ok(json!(optics::fresnel_conductor(cos_theta, outside, n, k)))
}
