//! Photon merging: what is seen through glass or in a mirror is as bright as it is by other means. Merging blurs by its
//! radius, which is a few pixels wide: pictures of two resolutions have radii of 2 : 1. The blur's bias goes with the square
//! of the radius (the kernel is symmetric, so that the first order vanishes), and a third of the difference of the two
//! pictures is what is left of it in the finer one. Beyond that merging has to agree by Welch's test, in X, Y and Z of every
//! block and of the whole picture.

#[path = "common/render.rs"]
mod common;

use abbe::film::Film;
use common::{Estimate, box_shape, compile_json, render_compiled, sidak, student_two_sided, with};
use serde_json::{Value, json};

/// Blocks along each side that are compared.
const BLOCKS: usize = 4;
/// Compared numbers: X, Y, Z of blocks, then of the picture.
const VALUES: usize = 3 * (BLOCKS * BLOCKS + 1);
const SEEDS: u64 = 16;
/// Joint level of all comparisons in this file.
const ALPHA: f64 = 0.01;
const SCENES: usize = 3;
/// Largest tolerance, 3σ and bias, relative to the brightest block, and to the mean of the whole picture for that.
const TOLERANCE: [f64; 2] = [0.05, 0.015];

/// A floor under a ball of glass.
fn scene(light: Value) -> Value {
    json!({
        "camera": { "type": "perspective", "from": [0, 0.5, 1.4], "to": [0, 0, 0], "fov_degrees": 14 },
        "film": { "width": 32, "height": 32, "filter": { "type": "box" } },
        "render": { "samples_per_pixel": 64, "max_depth": 12, "seed": 0, "integrator": "auto" },
        "materials": {
            "floor": { "type": "diffuse", "reflectance": 0.6 },
            "mirror": { "type": "mirror", "reflectance": 1 },
            "glass": { "type": "dielectric", "ior": { "glass": "N-SF66" } }
        },
        "objects": [
            { "shape": { "type": "quad", "origin": [-0.6, 0, 0.6], "u": [1.2, 0, 0], "v": [0, 0, -1.2] }, "material": "floor" },
            { "shape": { "type": "sphere", "center": [0, 0.3, -0.02], "radius": 0.09 }, "material": "glass" }
        ],
        "lights": [light]
    })
}

/// X, Y, Z of every block, and of the whole picture.
fn values(film: &Film) -> Vec<f64> {
    let side = film.width() as usize;
    let mut sums = vec![0.0; VALUES];
    for (pixel, xyz) in film.to_image().triples().iter().enumerate() {
        let block = pixel / side * BLOCKS / side * BLOCKS + pixel % side * BLOCKS / side;
        for c in 0..3 {
            sums[3 * block + c] += xyz[c] / (side * side / (BLOCKS * BLOCKS)) as f64;
            sums[VALUES - 3 + c] += xyz[c] / (side * side) as f64;
        }
    }
    sums
}

/// What finds the light in question.
#[derive(Clone, Copy, PartialEq)]
enum By {
    Merging,
    Others,
}

fn estimates(scene: &Value, by: By, side: u32, first_seed: u64) -> Vec<Estimate> {
    let mut compiled = compile_json(&with(&with(scene, "/film/width", side), "/film/height", side));
    let mut picture = |seed| {
        compiled.render.seed = seed;
        let (film, statistics) = render_compiled(&compiled);
        assert_eq!(statistics.photon_paths > 0, by == By::Merging);
        values(&film)
    };
    let films: Vec<Vec<f64>> = (first_seed..first_seed + SEEDS).map(&mut picture).collect();
    (0..VALUES).map(|k| Estimate::of(&films.iter().map(|f| f[k]).collect::<Vec<_>>())).collect()
}

/// Insists that merging at the smaller of two radii differs from the truth by chance and by what is left of the blur alone,
/// and that this is little.
fn agree(what: &str, truth: &[Estimate], coarse: &[Estimate], fine: &[Estimate]) {
    let threshold = sidak(ALPHA, SCENES * VALUES);
    for channel in 0..3 {
        let blocks = truth.iter().skip(channel).step_by(3);
        let brightest = blocks.clone().take(BLOCKS * BLOCKS).map(|e| e.mean).fold(0.0, f64::max);
        for (k, truth) in blocks.enumerate() {
            let [coarse, fine] = [coarse, fine].map(|values| values[3 * k + channel]);
            // Errors of the fine picture and of a third of the difference add up.
            let sigma = truth.error.hypot(fine.error) + coarse.error.hypot(fine.error) / 3.0;
            let bias = (coarse.mean - fine.mean).abs() / 3.0;
            let off = (fine.mean - truth.mean).abs();
            let p = student_two_sided((off - bias).max(0.0) / sigma, SEEDS as f64 - 1.0);
            println!("{what} {k} {channel}: {:.5} {:.5} {:.5} ± {sigma:.5}", truth.mean, coarse.mean, fine.mean);
            let whole = k == BLOCKS * BLOCKS;
            let scale = if whole { truth.mean } else { brightest };
            let tolerance = (3.0 * sigma + bias) / scale;
            assert!(tolerance < TOLERANCE[usize::from(whole)], "{what}: block {k} is known to {tolerance} only");
            assert!(p > threshold, "{what}: block {k}: {truth:?}, {fine:?}, blur {bias}, p = {p:e}");
            assert!(!whole || off < 3.0 * sigma + bias, "{what}: picture: {truth:?}, {fine:?}, blur {bias}");
        }
    }
}

/// The picture of a floor under a ball in a mirror is the one from the mirror's other side: merging against light paths.
fn mirrored(what: &str, light: Value, samples: u64) {
    let direct = with(&scene(light), "/render/samples_per_pixel", samples);
    let mut mirrored = direct.clone();
    mirrored["camera"]["from"] = json!([0, 0.5, 0.6]);
    mirrored["camera"]["to"] = json!([0, 0, 2]);
    // Between camera and floor, z = 1 is halfway between the camera and its mirror image.
    mirrored["objects"].as_array_mut().unwrap().push(json!({
        "shape": { "type": "quad", "origin": [-0.15, 0.22, 1], "u": [0.3, 0, 0], "v": [0, 0.3, 0] }, "material": "mirror"
    }));
    let flipped = |values: Vec<Estimate>| {
        let mut flipped = values.clone();
        for k in 0..BLOCKS * BLOCKS {
            let from = k / BLOCKS * BLOCKS + BLOCKS - 1 - k % BLOCKS;
            flipped[3 * k..3 * k + 3].copy_from_slice(&values[3 * from..3 * from + 3]);
        }
        flipped
    };
    let truth = estimates(&direct, By::Others, 32, 1);
    let coarse = flipped(estimates(&mirrored, By::Merging, 32, 101));
    let fine = flipped(estimates(&mirrored, By::Merging, 64, 201));
    agree(what, &truth, &coarse, &fine);
}

/// A caustic of a light without extent.
#[test]
fn a_mirror_shows_the_same_caustic() {
    let spot = json!({ "type": "spot", "position": [0.1, 0.9, 0], "direction": [-0.1, -0.6, -0.02],
                       "intensity": 1, "inner_degrees": 7, "outer_degrees": 8 });
    mirrored("mirror", spot, 64);
}

/// The spot of a beam, what bounces off it, and its caustic: all that a local light does is left to light paths, and in a
/// mirror to merging.
#[test]
fn a_mirror_shows_the_same_beam() {
    let beam = json!({ "type": "beam", "origin": [0.12, 0.8, 0], "direction": [-0.1, -0.6, -0.02], "radius": 0.1,
                       "power": { "illuminant": "D65", "scale": 0.1 } });
    mirrored("beam", beam, 16);
}

/// A caustic of a large light seen through a plate of glass, out of focus: merging against camera paths, which can run into
/// the light.
#[test]
fn a_plate_before_a_lens_shows_what_camera_paths_find() {
    let mut scene = scene(json!({}));
    scene["lights"] = json!([]);
    scene["camera"]["aperture_radius"] = json!(0.02);
    scene["camera"]["focus_distance"] = json!(0.8);
    let objects = scene["objects"].as_array_mut().unwrap();
    objects.push(json!({ "emission": { "illuminant": "D65" },
        "shape": { "type": "quad", "origin": [-0.2, 0.75, -0.2], "u": [0.4, 0, 0], "v": [0, 0, 0.4] } }));
    objects.push(json!({ "shape": box_shape([-0.3, 0.2, 1.0], [0.3, 0.55, 1.02]), "material": "glass" }));
    let by_camera = with(&with(&scene, "/render/integrator", "path"), "/render/samples_per_pixel", 256);
    let truth = estimates(&by_camera, By::Others, 32, 1);
    let by_merging = with(&scene, "/render/integrator", "merge");
    let coarse = estimates(&by_merging, By::Merging, 32, 101);
    let fine = estimates(&by_merging, By::Merging, 64, 201);
    agree("plate", &truth, &coarse, &fine);
}
