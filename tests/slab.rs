//! Slabs of absorbing, dispersive glass: transmittance and reflectance against the sum over all internal reflections.

#[path = "common/render.rs"]
mod common;

use abbe::color::Observer;
use abbe::math;
use common::{Estimate, Layer, box_shape, fresnel, hat, mean_xyz_sum, mean_y, stack, with};
use serde_json::{Value, json};

const BINS: usize = 8;
const THICKNESS: f64 = 0.02;
const ABSORPTION_NM: [f64; 4] = [400.0, 500.0, 600.0, 700.0];
const ABSORPTION: [f64; 4] = [40.0, 20.0, 5.0, 10.0];

/// A slab seen at an angle, with a plane of radiance 1 behind it (its transmittance) or in front (its reflectance).
fn scene(degrees: f64, behind: bool) -> Value {
    let (sin, cos) = (math::sin(degrees.to_radians()), math::cos(degrees.to_radians()));
    let light = if behind {
        json!({ "type": "quad", "origin": [-5, -0.5, 5], "u": [10, 0, 0], "v": [0, 0, -10] })
    } else {
        json!({ "type": "quad", "origin": [-5, 1.5, 5], "u": [0, 0, -10], "v": [10, 0, 0] })
    };
    json!({
        "camera": { "type": "perspective", "from": [-sin, cos, 0], "to": [0, 0, 0], "up": [0, 0, 1], "fov_degrees": 0.01 },
        "film": { "width": 32, "height": 32 },
        "render": { "samples_per_pixel": 64, "max_depth": 200, "seed": 0, "integrator": "path" },
        "materials": { "glass": { "type": "dielectric", "ior": { "glass": "N-BK7" },
            "absorption_per_m": { "wavelengths_nm": ABSORPTION_NM, "values": ABSORPTION } } },
        "objects": [
            { "shape": box_shape([-3.0, -THICKNESS, -3.0], [3.0, 0.0, 3.0]), "material": "glass" },
            { "shape": light, "emission": 1 }
        ]
    })
}

fn piecewise(x: f64, knots: &[f64], values: &[f64]) -> f64 {
    let i = knots.partition_point(|k| *k <= x).clamp(1, knots.len() - 1);
    let t = ((x - knots[i - 1]) / (knots[i] - knots[i - 1])).clamp(0.0, 1.0);
    values[i - 1] + (values[i] - values[i - 1]) * t
}

/// X + Y + Z of a bin of light that a slab lets through, and of what it reflects.
fn exact(bin: usize, degrees: f64) -> (f64, f64) {
    let glass = abbe::io::catalogue::glass("N-BK7").unwrap().constants().unwrap().n;
    let (knots, values) = hat(bin, BINS);
    let observer = Observer::cie_1931_2deg();
    let (mut through, mut back) = (0.0, 0.0);
    let step = 0.25;
    for i in 0..(470.0 / step) as u32 {
        let lambda = 360.0 + (f64::from(i) + 0.5) * step;
        let layer = Layer {
            index: glass.eval(lambda),
            thickness: THICKNESS,
            absorption: piecewise(lambda, &ABSORPTION_NM, &ABSORPTION),
        };
        let (t, r) = stack(&[layer], math::sin(degrees.to_radians()));
        let weight = piecewise(lambda, &knots, &values) * observer.eval(lambda).element_sum() * step;
        through += t * weight;
        back += r * weight;
    }
    (through / observer.y_integral(), back / observer.y_integral())
}

#[test]
fn transmittance_and_reflectance() {
    for degrees in [0.0, 35.0, 70.0] {
        for bin in 0..BINS {
            let (knots, values) = hat(bin, BINS);
            let emission = json!({ "wavelengths_nm": knots, "values": values });
            let (through, back) = exact(bin, degrees);
            for (behind, exact, tolerance) in [(true, through, 3e-3), (false, back, 1e-2)] {
                let scene = with(&scene(degrees, behind), "/objects/1/emission", emission.clone());
                let what = format!("{degrees}°, bin {bin}, {}", if behind { "transmittance" } else { "reflectance" });
                Estimate::over_seeds(&scene, 8, mean_xyz_sum).check(&what, exact, tolerance);
            }
        }
    }
}

/// A right-angled prism sends light back after two total reflections: with R of its base and τ along the way, which is as
/// long as the base for every ray, R + (1 − R)² τ / (1 − R τ).
#[test]
fn total_internal_reflection() {
    let (side, absorption, n) = (0.1, 6.0, 1.6);
    let scene = json!({
        "camera": { "type": "perspective", "from": [-1, 0, 0.02], "to": [0, 0, 0.02], "fov_degrees": 0.01 },
        "film": { "width": 32, "height": 32 },
        "render": { "samples_per_pixel": 128, "max_depth": 200, "seed": 0, "integrator": "path" },
        "materials": { "glass": { "type": "dielectric", "ior": n, "absorption_per_m": absorption } },
        "objects": [
            { "shape": { "type": "prism", "apex_degrees": 90, "side": side, "length": 0.1 }, "material": "glass" },
            { "shape": { "type": "quad", "origin": [-2, -1, -1], "u": [0, 2, 0], "v": [0, 0, 2] }, "emission": 1 }
        ]
    });
    let (r, tau) = (fresnel(0.0, 1.0, n), math::exp(-absorption * side * 2f64.sqrt()));
    let exact = r + (1.0 - r) * (1.0 - r) * tau / (1.0 - r * tau);
    Estimate::over_seeds(&scene, 8, mean_y).check("right-angled prism", exact, 3e-3);
}
