//! Camera paths, light paths and both together find the same picture: means of blocks of pixels over independent seeds,
//! compared by Welch's test with Šidák's correction. Light paths and camera paths share the surfaces and nothing else of
//! the transport, so this is the test of the weights that combine them.
//!
//! A pinhole cannot be reached through glass or mirrors by light paths: the camera sees diffuse surfaces only.

#[path = "common/render.rs"]
mod common;

use abbe::film::Film;
use common::{Estimate, render_json, sidak, with};
use serde_json::{Value, json};

const SIDE: usize = 32;
const BLOCK: usize = 4;
const SEEDS: u64 = 16;
/// Joint level of all comparisons in this file: eight scenes, three pairs of integrators.
const ALPHA: f64 = 0.01;
const PAIRS: usize = 8 * 3;
/// Largest relative standard error of the mean picture.
const ERROR: f64 = 0.003;

/// A floor under a ball of glass; the camera sees the middle of the floor and not the ball.
fn scene(glass: Value, light: Value) -> Value {
    json!({
        "camera": { "type": "perspective", "from": [0, 0.25, 0.6], "to": [0, 0, 0], "fov_degrees": 24 },
        "film": { "width": SIDE, "height": SIDE, "filter": { "type": "box" } },
        "render": { "samples_per_pixel": 64, "max_depth": 12, "seed": 0, "integrator": "path" },
        "materials": {
            "floor": { "type": "diffuse", "reflectance": { "rgb": [0.7, 0.6, 0.4] } },
            "wall": { "type": "diffuse", "reflectance": { "rgb": [0.3, 0.5, 0.6] } },
            "metal": { "type": "conductor", "metal": "Au" },
            "glass": glass
        },
        "objects": [
            { "shape": { "type": "quad", "origin": [-0.5, 0, 0.5], "u": [1, 0, 0], "v": [0, 0, -1] }, "material": "floor" },
            { "shape": { "type": "quad", "origin": [-0.5, 0, -0.5], "u": [1, 0, 0], "v": [0, 1, 0] }, "material": "wall" },
            { "shape": { "type": "sphere", "center": [0.02, 0.32, -0.03], "radius": 0.11 }, "material": "glass" },
            light
        ],
        "lights": []
    })
}

/// 0.4 sr seen from the ball.
fn quad_light() -> Value {
    json!({ "shape": { "type": "quad", "origin": [-0.05, 0.75, -0.2], "u": [0.28, 0, 0], "v": [0, 0.05, 0.3] },
            "emission": { "blackbody_kelvin": 3200, "scale": 5 } })
}

fn crown() -> Value {
    json!({ "type": "dielectric", "ior": 1.52 })
}

/// X, Y, Z of every block, and at the end those of the whole picture.
fn block_means(film: &Film) -> Vec<f64> {
    let blocks = SIDE / BLOCK;
    let mut sums = vec![0.0; 3 * (blocks * blocks + 1)];
    for (pixel, xyz) in film.to_xyz().iter().enumerate() {
        let block = pixel / SIDE / BLOCK * blocks + pixel % SIDE / BLOCK;
        for c in 0..3 {
            sums[3 * block + c] += xyz[c] / (BLOCK * BLOCK) as f64;
            sums[3 * blocks * blocks + c] += xyz[c] / (SIDE * SIDE) as f64;
        }
    }
    sums
}

/// Estimates of every block mean by one integrator. Seeds of different integrators differ, so that nothing is shared.
fn estimates(scene: &Value, integrator: &str, samples: u64, first_seed: u64) -> Vec<Estimate> {
    let scene = with(&with(scene, "/render/integrator", integrator), "/render/samples_per_pixel", samples);
    let films: Vec<Vec<f64>> = (first_seed..first_seed + SEEDS)
        .map(|seed| block_means(&render_json(&with(&scene, "/render/seed", seed)).0))
        .collect();
    (0..films[0].len()).map(|k| Estimate::of(&films.iter().map(|f| f[k]).collect::<Vec<_>>())).collect()
}

/// Compares all three integrators, with so many samples a pixel and seed each.
fn agree(name: &str, scene: &Value, samples: [u64; 3]) {
    let names = ["path", "light", "auto"];
    let all: Vec<Vec<Estimate>> =
        (0..3).map(|i| estimates(scene, names[i], samples[i], 1000 * (i as u64 + 1))).collect();
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        let (a, b) = (&all[i], &all[j]);
        let smallest = a.iter().zip(b).map(|(a, b)| a.p_value(b)).fold(1.0, f64::min);
        let (whole_a, whole_b) = (a[a.len() - 2], b[b.len() - 2]);
        let sigma = (whole_a.error.hypot(whole_b.error)) / whole_a.mean;
        let off = whole_b.mean / whole_a.mean - 1.0;
        println!(
            "{name}: {} {} differ by {:+.2} % ± {:.2} % ({:.2} σ), errors {:.2} % {:.2} %, smallest p {smallest:.5}",
            names[i],
            names[j],
            100.0 * off,
            100.0 * sigma,
            off / sigma,
            100.0 * whole_a.error / whole_a.mean,
            100.0 * whole_b.error / whole_b.mean,
        );
        assert!(whole_a.error < ERROR * whole_a.mean && whole_b.error < ERROR * whole_b.mean, "{name}: too noisy");
        assert!(off.abs() < 3.0 * sigma, "{name}: {} and {}", names[i], names[j]);
        let threshold = sidak(ALPHA, PAIRS * a.len());
        assert!(smallest > threshold, "{name}: {} and {}: p = {smallest:e} < {threshold:e}", names[i], names[j]);
    }
}

#[test]
fn glass_ball() {
    agree("glass ball", &scene(crown(), quad_light()), [96, 256, 64]);
}

#[test]
fn dispersive_ball() {
    let flint = json!({ "type": "dielectric", "ior": { "glass": "N-SF66" } });
    agree("dispersive ball", &scene(flint, quad_light()), [96, 256, 64]);
}

/// A coloured, absorbing, dispersive ball, a gold ball beside it, and a spherical light.
#[test]
fn absorption_and_metal() {
    let amber = json!({ "type": "dielectric", "ior": { "glass": "N-SF11" }, "absorption_per_m":
        { "wavelengths_nm": [400, 500, 600, 700], "values": [20, 12, 3, 1] } });
    let light = json!({ "shape": { "type": "sphere", "center": [0.15, 0.8, 0.1], "radius": 0.14 },
                        "emission": { "illuminant": "D65" } });
    let mut scene = scene(amber, light);
    let gold =
        json!({ "shape": { "type": "sphere", "center": [-0.25, 0.25, -0.1], "radius": 0.1 }, "material": "metal" });
    scene["objects"].as_array_mut().unwrap().push(gold);
    agree("absorption and metal", &scene, [96, 256, 64]);
}

#[test]
fn two_sided_light() {
    let mut light = quad_light();
    light["emission_two_sided"] = json!(true);
    agree("two-sided light", &scene(crown(), light), [96, 256, 64]);
}

#[test]
fn mesh_light() {
    let light = json!({ "shape": { "type": "triangles",
        "positions": [-0.05, 0.75, -0.1, 0.25, 0.72, -0.1, 0.15, 0.8, 0.2, -0.05, 0.8, 0.15], "indices": [0, 1, 2, 0, 2, 3] },
        "emission": 5, "emission_two_sided": false });
    agree("mesh light", &scene(crown(), light), [96, 256, 64]);
}

#[test]
fn wide_sun() {
    let mut scene = scene(
        crown(),
        json!({ "shape": { "type": "sphere", "center": [0, 5, 0], "radius": 0.1 },
                                           "emission": { "illuminant": "D65", "scale": 10 } }),
    );
    scene["lights"] = json!([{ "type": "directional", "direction": [-0.2, -1, -0.3], "irradiance": 1,
                               "angular_diameter_degrees": 10 }]);
    scene["objects"].as_array_mut().unwrap().pop();
    agree("wide sun", &scene, [1024, 256, 64]);
}

/// A thin lens in front and a lens of glass above, a Gaussian filter.
#[test]
fn thin_lens_and_filter() {
    let mut scene = scene(crown(), quad_light());
    scene["camera"]["aperture_radius"] = json!(0.03);
    scene["camera"]["focus_distance"] = json!(0.5);
    scene["film"]["filter"] = json!({ "type": "gaussian", "radius": 1.5 });
    scene["objects"][2]["shape"] = json!({ "type": "lens", "radii": [0.5, 0.6], "thickness": 0.03, "diameter": 0.2 });
    scene["objects"][2]["transform"] =
        json!([{ "rotate_degrees": 80, "axis": [1, 0, 0] }, { "translate": [0.0, 0.3, 0.0] }]);
    scene["materials"]["glass"]["ior"] = json!({ "glass": "N-BK7" });
    agree("thin lens and filter", &scene, [256, 256, 64]);
}

/// Normals that are not those of the surface: light paths need a correction that camera paths do not.
#[test]
fn shading_normals() {
    let mut scene = scene(crown(), quad_light());
    scene["objects"][0]["shape"] = json!({ "type": "triangles",
        "positions": [-0.5, 0, 0.5, 0.5, 0, 0.5, 0.5, 0, -0.5, -0.5, 0, -0.5],
        "normals": [0.3, 1, 0, 0.2, 1, 0.3, -0.4, 1, 0, 0, 1, -0.4], "indices": [0, 1, 2, 0, 2, 3] });
    agree("shading normals", &scene, [96, 256, 64]);
}
