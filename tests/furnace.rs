//! Furnaces: where radiance is 1 everywhere, nothing can be seen, at any wavelength.

#[path = "common/render.rs"]
mod common;

use abbe::color::{Observer, xyz_of_emission};
use abbe::spectrum::{PiecewiseLinear, Spectrum};
use common::{Estimate, hat, mean_xyz_sum, mean_y, render_json, with};
use serde_json::{Value, json};

const BINS: usize = 12;

/// One object that fills the picture, in an environment of radiance 1.
fn furnace(shape: Value, glass: &str, from: [f64; 3], fov_degrees: f64) -> Value {
    json!({
        "camera": { "type": "perspective", "from": from, "to": [0, 0, 0], "up": [0, 0, -1], "fov_degrees": fov_degrees },
        "film": { "width": 32, "height": 32 },
        "render": { "samples_per_pixel": 64, "max_depth": 512, "seed": 0, "integrator": "path" },
        "materials": { "glass": { "type": "dielectric", "ior": { "glass": glass, "extrapolate": "hold" } } },
        "objects": [{ "shape": shape, "material": "glass" }],
        "environment": { "radiance": 1 }
    })
}

/// In each of twelve bins of wavelengths the picture is as bright as the environment.
fn every_bin_is_one(name: &str, scene: &Value, samples: u64) {
    let scene = with(scene, "/render/samples_per_pixel", samples);
    for bin in 0..BINS {
        let (knots, values) = hat(bin, BINS);
        let emission = Spectrum::PiecewiseLinear(PiecewiseLinear::new(knots.clone(), values.clone()).unwrap());
        let exact = xyz_of_emission(&emission, Observer::cie_1931_2deg()).element_sum();
        let scene = with(&scene, "/environment/radiance", json!({ "wavelengths_nm": knots, "values": values }));
        let seen = Estimate::over_seeds(&scene, 6, mean_xyz_sum);
        seen.check(&format!("{name}, bin {bin}"), exact, 1e-3);
    }
}

#[test]
fn dispersive_sphere() {
    let sphere = json!({ "type": "sphere", "center": [0, 0, 0], "radius": 1 });
    every_bin_is_one("sphere of N-SF66", &furnace(sphere, "N-SF66", [0.3, 2.0, 0.4], 30.0), 128);
}

fn gem() -> Value {
    furnace(json!({ "type": "brilliant", "radius": 1 }), "diamond", [0.3, 3.0, 0.4], 20.0)
}

#[test]
fn brilliant() {
    every_bin_is_one("brilliant", &gem(), 128);
}

/// Light stays long in a gem; what is cut off at 64 events is seen.
#[test]
fn long_paths_in_a_gem() {
    let of = |depth: u64| Estimate::over_seeds(&with(&gem(), "/render/max_depth", depth), 8, mean_y);
    let whole = of(1024);
    whole.check("gem, 1024 events", 1.0, 2e-3);
    // The random numbers are the same, so that the differences are sharp.
    let beyond = [64, 512].map(|depth| whole.mean - of(depth).mean);
    println!("share beyond 64 and 512 events: {beyond:.6?}");
    assert!(beyond[0] > 1e-3 && beyond[0] < 5e-3 && beyond[1].abs() < 1e-5, "{beyond:?}");
}

/// Inside glass radiance is n² times that outside: from within a ball, from the liquid around a ball, from a ball in
/// liquid, and through a thin lens.
#[test]
fn camera_inside_glass() {
    let scene = |from: [f64; 3], aperture: f64| {
        json!({
            "camera": { "type": "perspective", "from": from, "to": [0, 0, 0], "fov_degrees": 60, "aperture_radius": aperture },
            "film": { "width": 16, "height": 16 },
            "render": { "samples_per_pixel": 64, "max_depth": 1000, "seed": 0, "integrator": "path" },
            "materials": {
                "glass": { "type": "dielectric", "ior": 1.5, "priority": 1 },
                "liquid": { "type": "dielectric", "ior": 1.33 }
            },
            "objects": [
                { "shape": { "type": "sphere", "center": [0, 0, 0], "radius": 1 }, "material": "glass" },
                { "shape": { "type": "sphere", "center": [0, 0, 0], "radius": 3 }, "material": "liquid" }
            ],
            "environment": { "radiance": 1 }
        })
    };
    for aperture in [0.0, 0.1] {
        for (from, n) in [([0.3, 0.2, 0.4], 1.5), ([1.2, 0.8, 0.3], 1.33), ([3.0, 2.0, 1.0], 1.0)] {
            let (film, _) = render_json(&scene(from, aperture));
            let mean = mean_y(&film);
            assert!((mean / (n * n) - 1.0).abs() < 1e-3, "{from:?}: {mean}, expected {}", n * n);
            let mut alone = scene(from, aperture);
            alone["objects"].as_array_mut().unwrap().truncate(1);
            let (film, _) = render_json(&alone);
            let n = if n == 1.5 { 1.5 } else { 1.0 };
            assert!((mean_y(&film) / (n * n) - 1.0).abs() < 1e-3, "{from:?} alone: {}", mean_y(&film));
        }
    }
}

/// A diffuse ball in a uniform environment has its reflectance as radiance. A closed room whose walls emit L and reflect a
/// has L / (1 − a).
#[test]
fn diffuse() {
    let ball = json!({
        "camera": { "type": "perspective", "from": [0, 0, 3], "to": [0, 0, 0], "fov_degrees": 20 },
        "film": { "width": 16, "height": 16 },
        "render": { "samples_per_pixel": 64, "max_depth": 64, "seed": 0, "integrator": "path" },
        "materials": { "grey": { "type": "diffuse", "reflectance": 0.8 } },
        "objects": [{ "shape": { "type": "sphere", "center": [0, 0, 0], "radius": 1 }, "material": "grey" }],
        "environment": { "radiance": 1 }
    });
    Estimate::over_seeds(&ball, 4, mean_y).check("diffuse ball", 0.8, 1e-3);
    for integrator in ["path", "light"] {
        for reflectance in [0.0, 0.5, 0.8] {
            let mut room = with(&with(&ball, "/render/integrator", integrator), "/render/max_depth", 400);
            room = with(&room, "/camera/from", json!([0.3, 0.2, 0.1]));
            room = with(&room, "/camera/fov_degrees", 70);
            room = with(&room, "/render/samples_per_pixel", 1024);
            room["materials"]["grey"]["reflectance"] = json!(reflectance);
            room["objects"][0]["emission"] = json!(1);
            room["objects"][0]["emission_two_sided"] = json!(true);
            room.as_object_mut().unwrap().remove("environment");
            let seen = Estimate::over_seeds(&room, 6, mean_y);
            seen.check(&format!("room of {reflectance}, {integrator}"), 1.0 / (1.0 - reflectance), 5e-3);
        }
    }
}
