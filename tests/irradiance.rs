//! Direct light of every kind of light on a diffuse surface, against its irradiance in closed form, by camera paths and by
//! light paths.

#[path = "common/render.rs"]
mod common;

use abbe::math;
use common::{Estimate, mean_y, with};
use glam::DVec3;
use serde_json::{Value, json};
use std::f64::consts::PI;

const REFLECTANCE: f64 = 0.6;
/// Half of the edge of the square that the camera sees, in the plane y = 0 about the origin.
const HALF: f64 = 0.2;

/// A receiver and a light.
fn scene(light: &Value) -> Value {
    let mut objects = vec![json!({ "material": "grey",
        "shape": { "type": "quad", "origin": [-0.3, 0, 0.3], "u": [0.6, 0, 0], "v": [0, 0, -0.6] } })];
    let mut lights = Vec::new();
    if light["type"].is_string() {
        lights.push(light.clone())
    } else {
        objects.push(light.clone())
    }
    json!({
        "camera": { "type": "perspective", "from": [0, 1, 0], "to": [0, 0, 0], "up": [0, 0, -1],
                    "fov_degrees": 2.0 * math::atan2(HALF, 1.0).to_degrees() },
        "film": { "width": 16, "height": 16 },
        "render": { "samples_per_pixel": 1024, "max_depth": 1, "seed": 0, "integrator": "path" },
        "materials": { "grey": { "type": "diffuse", "reflectance": REFLECTANCE } },
        "objects": objects,
        "lights": lights
    })
}

/// Mean radiance of the square for an irradiance at each of its points.
fn mean_radiance(irradiance: impl Fn(DVec3) -> f64) -> f64 {
    let n = 64;
    let at = |i: i32| HALF * (2.0 * (f64::from(i) + 0.5) / f64::from(n) - 1.0);
    let sum: f64 = (0..n * n).map(|k| irradiance(DVec3::new(at(k % n), 0.0, at(k / n)))).sum();
    REFLECTANCE / PI * sum / f64::from(n * n)
}

fn check(what: &str, light: Value, irradiance: impl Fn(DVec3) -> f64) {
    let exact = mean_radiance(irradiance);
    for integrator in ["path", "light"] {
        let samples = if integrator == "path" { 512 } else { 2048 };
        let scene = with(&with(&scene(&light), "/render/integrator", integrator), "/render/samples_per_pixel", samples);
        let tolerance = if integrator == "path" { 1e-3 } else { 8e-3 };
        Estimate::over_seeds(&scene, 6, mean_y).check(&format!("{what}, {integrator}"), exact, tolerance);
    }
}

/// Irradiance of a polygon of radiance 1 at a point whose normal is +y: ½ Σ γᵢ (n · Γᵢ) [Lambert1760].
fn polygon(corners: &[DVec3], point: DVec3) -> f64 {
    let v: Vec<DVec3> = corners.iter().map(|c| (*c - point).normalize()).collect();
    let sum: f64 = (0..v.len())
        .map(|i| (v[i], v[(i + 1) % v.len()]))
        .map(|(a, b)| math::acos(a.dot(b)) * a.cross(b).normalize().y)
        .sum();
    0.5 * sum.abs()
}

#[test]
fn sphere() {
    let (center, radius) = (DVec3::new(0.6, 0.7, 0.2), 0.25);
    let light = json!({ "shape": { "type": "sphere", "center": center.to_array(), "radius": radius }, "emission": 2 });
    check("sphere", light, |p| {
        let to = center - p;
        2.0 * PI * radius * radius / to.length_squared() * to.normalize().y
    });
}

#[test]
fn rectangle_and_mesh() {
    let (o, u, v) = (DVec3::new(0.3, 0.6, -0.3), DVec3::new(0.4, -0.2, 0.0), DVec3::new(0.1, 0.05, 0.6));
    let corners = [o, o + u, o + u + v, o + v];
    assert!(u.cross(v).y < 0.0);
    let quad = json!({ "shape": { "type": "quad", "origin": o.to_array(), "u": u.to_array(), "v": v.to_array() }, "emission": 1 });
    check("rectangle", quad.clone(), |p| polygon(&corners, p));
    let mut two_sided = quad;
    two_sided["emission_two_sided"] = json!(true);
    check("two-sided rectangle", two_sided, |p| polygon(&corners, p));
    let positions: Vec<f64> = corners.iter().flat_map(|c| c.to_array()).collect();
    let mesh = json!({ "shape": { "type": "triangles", "positions": positions, "indices": [0, 1, 2, 0, 2, 3] }, "emission": 1 });
    check("mesh", mesh, |p| polygon(&corners, p));
}

/// A disc of radius r at height h, parallel to the plane, whose centre is a off the normal:
/// ½ π (1 − (h² + a² − r²) / √((h² + a² + r²)² − 4 r² a²)).
#[test]
fn disk() {
    let (center, r) = (DVec3::new(0.7, 0.5, 0.1), 0.3);
    let light = json!({ "shape": { "type": "disk", "center": center.to_array(), "normal": [0, -1, 0], "radius": r }, "emission": 1 });
    check("disk", light, |p| {
        let (h2, a2) = (center.y * center.y, (center.x - p.x) * (center.x - p.x) + (center.z - p.z) * (center.z - p.z));
        let s = h2 + a2 + r * r;
        0.5 * PI * (1.0 - (h2 + a2 - r * r) / (s * s - 4.0 * r * r * a2).sqrt())
    });
}

#[test]
fn point_and_spot() {
    let position = DVec3::new(0.4, 0.6, -0.3);
    let of_point = |p: DVec3| {
        let to = position - p;
        3.0 / to.length_squared() * to.normalize().y
    };
    check("point", json!({ "type": "point", "position": position.to_array(), "intensity": 3 }), of_point);
    let spot = |outer: f64| {
        json!({ "type": "spot", "position": position.to_array(), "direction": (-position).to_array(), "intensity": 3,
                "inner_degrees": 30, "outer_degrees": outer })
    };
    check("spot", spot(40.0), of_point);
    // Beyond the edge there is nothing.
    let narrow = json!({ "type": "spot", "position": [1, 0.5, 0], "direction": [1, -1, 0], "intensity": 3,
                         "inner_degrees": 10, "outer_degrees": 20 });
    let dark = Estimate::over_seeds(&with(&scene(&narrow), "/render/samples_per_pixel", 16), 2, mean_y);
    assert_eq!(dark.mean, 0.0);
}

/// A spot's smooth edge on a plane facing it: falls from 1 to 0 and through ½ where 1 − cos is half way; its light paths
/// carry what next-event estimation finds.
#[test]
fn edge_of_a_spot() {
    let spot = json!({ "type": "spot", "position": [0, 0.8, 0], "direction": [0, -1, 0], "intensity": 1,
                       "inner_degrees": 3, "outer_degrees": 12 });
    let of = |integrator: &str, samples: u64| {
        let scene = with(&with(&scene(&spot), "/render/integrator", integrator), "/render/samples_per_pixel", samples);
        Estimate::over_seeds(&scene, 6, mean_y)
    };
    let (path, light) = (of("path", 512), of("light", 1024));
    let sigma = path.error.hypot(light.error);
    assert!(
        sigma < 1e-3 * path.mean && (path.mean - light.mean).abs() < 4.0 * sigma + 1e-5 * path.mean,
        "{path:?} {light:?}"
    );
}

#[test]
fn directional() {
    for degrees in [0.0, 0.53, 20.0] {
        let light = json!({ "type": "directional", "direction": [-0.5, -1, 0.3], "irradiance": 2,
                            "angular_diameter_degrees": degrees });
        // A disc of uniform radiance, wholly above the horizon, is a cosine as parallel light is.
        let cos = DVec3::new(0.5, 1.0, -0.3).normalize().y;
        check(&format!("directional, {degrees}°"), light, |_| 2.0 * cos);
    }
}

#[test]
fn beam() {
    let (direction, radius) = (DVec3::new(-0.5, -1.0, 0.2), 0.4);
    let light = json!({ "type": "beam", "origin": (-direction).to_array(), "direction": direction.to_array(),
                        "radius": radius, "power": 1.5 });
    check("beam", light, |_| 1.5 / (PI * radius * radius) * (-direction).normalize().y);
}
