//! Camera paths, light paths, both together, and the state of the art that is kept as a baseline find the same picture. Light
//! paths and camera paths share the surfaces and nothing else of the transport, so this is the test of the weights that
//! combine them.
//!
//! Every technique makes sixteen pictures of its own seeds, and every pair of techniques is compared in X, Y and Z:
//!
//! * the mean of the picture: within 3σ, where the standard error of each technique is at most 0.1 %;
//! * every pixel, every block of 4 × 4 pixels and the mean, by Welch's test with Šidák's correction for all comparisons of
//!   all scenes. Pixels find what is wrong in few places, blocks what is too faint for a pixel.
//!
//! Welch's test wants normal means. A pixel that rare bright paths make has none: those seeds that missed them agree with
//! each other on too little light, which the test takes for certainty. Two things keep that away. Lights are large, about
//! 0.1 to 1 sr from where caustics are made, and pixels few, with thousands of paths each: the largest error of a pixel is
//! bounded, and spikes would exceed it. And the variance of a pixel counts as at least the mean variance of its block, so
//! that missing the rare paths in all sixteen seeds takes sixteen pixels.
//!
//! A comparison that fails is made once more with other seeds, and has to hold there. Of all these pairs chance puts one
//! beyond 3σ in every few sets of seeds, and the same one twice in one of hundreds; a true difference fails twice.
//!
//! A pinhole cannot be reached through glass or mirrors by light paths: the camera sees diffuse surfaces only. `auto` leaves
//! lights of over 0.1 sr to camera paths. `merge` does not: with nothing specular in sight, it is camera paths and
//! light paths with the same weights as `auto`, for every light but the environment.

#[path = "common/render.rs"]
mod common;

use abbe::film::Film;
use common::{Estimate, box_shape, compile_json, render_compiled, sidak, with};
use serde_json::{Value, json};

const SIDE: usize = 16;
const BLOCK: usize = 4;
const BLOCKS: usize = SIDE / BLOCK;
/// Compared numbers: X, Y, Z of pixels, then of blocks, then of the picture.
const VALUES: usize = 3 * (SIDE * SIDE + BLOCKS * BLOCKS + 1);
const SEEDS: u64 = 16;
/// Joint level of all comparisons in this file.
const ALPHA: f64 = 0.01;
/// Pairs of techniques: three for the six scenes with three techniques, six for the three with four.
const PAIRS: usize = 6 * 3 + 3 * 6;
/// Largest standard error of the mean picture, relative to it.
const ERROR: f64 = 0.001;
/// The same of a pixel.
const NOISE: f64 = 0.1;

/// What makes a picture: the integrator, and samples a pixel of each of its pictures.
type Technique = (&'static str, u64);

/// A floor under a ball of glass; the camera looks down on the floor from below the ball.
fn scene(glass: Value, light: Value) -> Value {
    json!({
        "camera": { "type": "perspective", "from": [0, 0.25, 0.1], "to": [0, 0, 0], "fov_degrees": 80 },
        "film": { "width": SIDE, "height": SIDE, "filter": { "type": "box" } },
        "render": { "samples_per_pixel": 64, "max_depth": 12, "seed": 0, "integrator": "path" },
        "materials": {
            "floor": { "type": "diffuse", "reflectance": { "rgb": [0.7, 0.6, 0.4] } },
            "wall": { "type": "diffuse", "reflectance": { "rgb": [0.3, 0.5, 0.6] } },
            "metal": { "type": "conductor", "metal": "Au" },
            "glass": glass
        },
        "objects": [
            { "shape": { "type": "quad", "origin": [-0.4, 0, 0.4], "u": [0.8, 0, 0], "v": [0, 0, -0.8] }, "material": "floor" },
            { "shape": { "type": "quad", "origin": [-0.4, 0, -0.4], "u": [0.8, 0, 0], "v": [0, 0.4, 0] }, "material": "wall" },
            { "shape": { "type": "sphere", "center": [0.02, 0.4, -0.03], "radius": 0.09 }, "material": "glass" },
            light
        ],
        "lights": []
    })
}

/// 0.4 sr seen from the ball.
fn quad_light() -> Value {
    json!({ "shape": { "type": "quad", "origin": [-0.25, 0.8, -0.3], "u": [0.5, 0, 0], "v": [0, 0.05, 0.5] },
            "emission": { "illuminant": "D65" } })
}

fn crown() -> Value {
    json!({ "type": "dielectric", "ior": 1.52 })
}

/// Pixels of a block.
fn pixels_of(block: usize) -> impl Iterator<Item = usize> + Clone {
    let first = block / BLOCKS * BLOCK * SIDE + block % BLOCKS * BLOCK;
    (0..BLOCK * BLOCK).map(move |i| first + i / BLOCK * SIDE + i % BLOCK)
}

/// X, Y, Z of every pixel, of every block, and of the whole picture.
fn values(film: &Film) -> Vec<f64> {
    let picture = film.to_image();
    let pixels = picture.triples();
    let mean = |of: &mut dyn Iterator<Item = usize>, count: usize| {
        of.fold([0.0; 3], |sum: [f64; 3], i| std::array::from_fn(|c| sum[c] + pixels[i][c] / count as f64))
    };
    let blocks = (0..BLOCKS * BLOCKS).map(|block| mean(&mut pixels_of(block), BLOCK * BLOCK));
    let whole = mean(&mut (0..SIDE * SIDE), SIDE * SIDE);
    pixels.iter().copied().chain(blocks).chain([whole]).flatten().collect()
}

/// Estimates of all values by one technique. Seeds of different techniques differ, so that nothing is shared.
fn estimates(scene: &Value, (integrator, samples): Technique, first_seed: u64) -> Vec<Estimate> {
    let scene = with(&with(scene, "/render/integrator", integrator), "/render/samples_per_pixel", samples);
    let mut compiled = compile_json(&scene);
    let mut picture = |seed| {
        compiled.render.seed = seed;
        let (film, statistics) = render_compiled(&compiled);
        let light_paths = !matches!(integrator, "path" | "hero");
        assert_eq!(statistics.light_paths > 0, light_paths, "{integrator} does what its name says");
        values(&film)
    };
    let films: Vec<Vec<f64>> = (first_seed..first_seed + SEEDS).map(&mut picture).collect();
    let of_value = |k: usize| Estimate::of(&films.iter().map(|f| f[k]).collect::<Vec<_>>());
    let mut estimates: Vec<Estimate> = (0..VALUES).map(of_value).collect();
    for block in 0..BLOCKS * BLOCKS {
        for channel in 0..3 {
            let pixels = pixels_of(block).map(|pixel| 3 * pixel + channel);
            let sum: f64 = pixels.clone().map(|k| estimates[k].error * estimates[k].error).sum();
            let least = (sum / (BLOCK * BLOCK) as f64).sqrt();
            pixels.for_each(|k| estimates[k].error = estimates[k].error.max(least));
        }
    }
    estimates
}

/// Insists on enough samples for the comparisons to mean something.
fn check_noise(name: &str, technique: &str, estimates: &[Estimate]) {
    for channel in 0..3 {
        let whole = estimates[VALUES - 3 + channel];
        let pixels = estimates[..3 * SIDE * SIDE].iter().skip(channel).step_by(3);
        let worst = pixels.map(|e| e.error / whole.mean).fold(0.0, f64::max);
        let error = whole.error / whole.mean;
        println!("{name}: {technique} {channel}: mean ± {:.3} %, worst pixel ± {:.1} %", 100.0 * error, 100.0 * worst);
        assert!(error < ERROR, "{name}: {technique} is too noisy: {error}");
        assert!(worst < NOISE, "{name}: {technique} has a pixel that is too noisy: {worst}");
    }
}

/// What is wrong between two techniques.
fn difference(a: &[Estimate], b: &[Estimate]) -> Option<String> {
    for (a, b) in a[VALUES - 3..].iter().zip(&b[VALUES - 3..]) {
        let (off, sigma) = (b.mean - a.mean, a.error.hypot(b.error));
        println!("    mean differs by {:+.3} % ± {:.3} %", 100.0 * off / a.mean, 100.0 * sigma / a.mean);
        if off.abs() > 3.0 * sigma {
            return Some(format!("means {a:?} and {b:?} are {:.1} σ apart", off / sigma));
        }
    }
    // What is within 2σ needs no exact p.
    let far = |k: &usize| (a[*k].mean - b[*k].mean).abs() > 2.0 * a[*k].error.hypot(b[*k].error);
    let p_values = (0..VALUES).filter(far).map(|k| (k, a[k].p_value(&b[k])));
    let (index, p) = p_values.min_by(|a, b| a.1.total_cmp(&b.1))?;
    let threshold = sidak(ALPHA, PAIRS * VALUES);
    println!("    smallest p {p:.1e} of threshold {threshold:.1e}");
    (p < threshold).then(|| format!("value {index}: {:?} and {:?}, p = {p:e}", a[index], b[index]))
}

/// Compares every pair of techniques.
fn agree(name: &str, scene: &Value, techniques: &[Technique]) {
    let of = |technique: usize, redraw: u64| {
        estimates(scene, techniques[technique], 10 + 100 * (1 + technique as u64) + 1000 * redraw)
    };
    let first: Vec<Vec<Estimate>> = (0..techniques.len()).map(|technique| of(technique, 0)).collect();
    for (technique, estimates) in techniques.iter().zip(&first) {
        check_noise(name, technique.0, estimates);
    }
    for (j, second) in first.iter().enumerate() {
        for i in 0..j {
            let pair = [techniques[i].0, techniques[j].0];
            println!("{name}: {pair:?}");
            let Some(what) = difference(&first[i], second) else { continue };
            println!("    {what}; once more");
            let again = difference(&of(i, 1), &of(j, 1));
            assert!(again.is_none(), "{name}: {pair:?}: {what}; with other seeds: {}", again.unwrap_or_default());
        }
    }
}

#[test]
fn glass_ball() {
    let mut light = quad_light();
    light["emission_two_sided"] = json!(true);
    agree("glass ball", &scene(crown(), light), &[("path", 384), ("light", 2304), ("merge", 320)]);
}

#[test]
fn dispersive_ball() {
    let flint = json!({ "type": "dielectric", "ior": { "nd": 1.5, "vd": 15 } });
    agree(
        "dispersive ball",
        &scene(flint, quad_light()),
        &[("path", 3072), ("light", 2304), ("merge", 128), ("hero", 3200)],
    );
}

/// A coloured, absorbing, dispersive ball, a gold ball beside it, and a spherical light.
#[test]
fn absorption_and_metal() {
    let amber = json!({ "type": "dielectric", "ior": { "nd": 1.6, "vd": 20 }, "absorption_per_m":
        { "wavelengths_nm": [400, 500, 600, 700], "values": [20, 12, 3, 1] } });
    let light = json!({ "shape": { "type": "sphere", "center": [0.22, 0.6, 0.12], "radius": 0.14 },
                        "emission": { "illuminant": "D65" } });
    let mut scene = scene(amber, light);
    let gold =
        json!({ "shape": { "type": "sphere", "center": [-0.25, 0.25, -0.1], "radius": 0.1 }, "material": "metal" });
    scene["objects"].as_array_mut().unwrap().push(gold);
    agree("absorption and metal", &scene, &[("path", 768), ("light", 3584), ("merge", 256), ("hero", 768)]);
}

/// A disc of 20° at infinity.
#[test]
fn wide_sun() {
    let mut scene = scene(crown(), json!({}));
    scene["lights"] = json!([{ "type": "directional", "direction": [-0.2, -1, -0.3], "irradiance": { "illuminant": "D65" },
                               "angular_diameter_degrees": 20 }]);
    scene["objects"].as_array_mut().unwrap().pop();
    agree("wide sun", &scene, &[("path", 768), ("light", 256), ("auto", 32)]);
}

/// A thin lens in front and a lens of glass above, a Gaussian filter.
#[test]
fn thin_lens_and_filter() {
    let mut scene = scene(crown(), quad_light());
    scene["camera"]["aperture_radius"] = json!(0.03);
    scene["camera"]["focus_distance"] = json!(0.5);
    scene["film"]["filter"] = json!({ "type": "gaussian", "radius": 1.5 });
    scene["objects"][2]["shape"] = json!({ "type": "lens", "radii": [0.5, 0.6], "thickness": 0.03, "diameter": 0.1 });
    scene["objects"][2]["transform"] =
        json!([{ "rotate_degrees": 80, "axis": [1, 0, 0] }, { "translate": [0.0, 0.3, 0.0] }]);
    scene["materials"]["glass"]["ior"] = json!({ "glass": "N-BK7" });
    agree("thin lens and filter", &scene, &[("path", 768), ("light", 1408), ("merge", 64), ("hero", 1792)]);
}

/// Normals that are not those of the surface: light paths need a correction that camera paths do not. The light is a mesh.
#[test]
fn shading_normals() {
    let light = json!({ "shape": { "type": "triangles",
        "positions": [-0.2, 0.75, -0.25, 0.25, 0.72, -0.2, 0.3, 0.8, 0.25, -0.2, 0.8, 0.2], "indices": [0, 1, 2, 0, 2, 3] },
        "emission": 5, "emission_two_sided": false });
    let mut scene = scene(crown(), light);
    scene["objects"][0]["shape"] = json!({ "type": "triangles",
        "positions": [-0.4, 0, 0.4, 0.4, 0, 0.4, 0.4, 0, -0.4, -0.4, 0, -0.4],
        "normals": [0.3, 1, 0, 0.2, 1, 0.3, -0.4, 1, 0, 0, 1, -0.4], "indices": [0, 1, 2, 0, 2, 3] });
    agree("shading normals", &scene, &[("path", 512), ("light", 1408), ("merge", 128)]);
}

/// The same radiance from everywhere, focused by a dispersive ball: no next-event estimation on one side, no aim on the other.
#[test]
fn environment() {
    let flint = json!({ "type": "dielectric", "ior": { "glass": "SF11" } });
    let mut scene = scene(flint, json!({}));
    scene["objects"].as_array_mut().unwrap().pop();
    scene["environment"] = json!({ "radiance": { "illuminant": "D65", "scale": 0.5 } });
    agree("environment", &scene, &[("path", 128), ("light", 3584), ("hero", 128)]);
}

/// A ball of glass with a bubble and a block of amber that sticks out of it, which wins by its priority, all in water.
#[test]
fn nested_media() {
    let glass = json!({ "type": "dielectric", "ior": { "glass": "N-SF11" }, "priority": 1 });
    let mut scene = scene(glass, quad_light());
    scene["materials"]["amber"] = json!({ "type": "dielectric", "ior": 1.55, "priority": 2, "absorption_per_m":
        { "wavelengths_nm": [400, 500, 600, 700], "values": [30, 12, 3, 1] } });
    scene["materials"]["water"] = json!({ "type": "dielectric", "ior": { "glass": "water" } });
    scene["materials"]["air"] = json!({ "type": "dielectric", "ior": 1, "priority": 3 });
    scene["objects"][2]["shape"] = json!({ "type": "sphere", "center": [0, 0.42, 0], "radius": 0.055 });
    let objects = scene["objects"].as_array_mut().unwrap();
    objects.push(
        json!({ "shape": { "type": "sphere", "center": [0.005, 0.415, 0], "radius": 0.08 }, "material": "water" }),
    );
    objects.push(
        json!({ "shape": { "type": "sphere", "center": [-0.01, 0.44, 0.01], "radius": 0.02 }, "material": "air" }),
    );
    objects.push(json!({ "shape": box_shape([0.02, 0.4, -0.03], [0.1, 0.46, 0.03]), "material": "amber" }));
    agree("nested media", &scene, &[("path", 1536), ("light", 2048), ("merge", 192)]);
}

/// A luminous ball inside a ball of dispersive glass: all light is refracted before it gets anywhere.
#[test]
fn light_inside_glass() {
    let light = json!({ "shape": { "type": "sphere", "center": [0.04, 0.33, -0.02], "radius": 0.07 },
                        "emission": { "illuminant": "D65" } });
    let flint = json!({ "type": "dielectric", "ior": { "glass": "SF11" } });
    agree("light inside glass", &scene(flint, light), &[("path", 512), ("light", 1024), ("merge", 640)]);
}
