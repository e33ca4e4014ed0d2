//! Photon merging: what is seen through glass or in a mirror is as bright as it is by other means. Merging blurs by its
//! radius, a few pixels wide: pictures of two resolutions have two radii, and as the blur's bias goes with the square of the
//! radius, their difference says how much of it is left.

#[path = "common/render.rs"]
mod common;

use abbe::film::Film;
use common::{Estimate, box_shape, render_json, with};
use serde_json::{Value, json};

/// Blocks along each side that are compared.
const BLOCKS: usize = 4;
const SEEDS: u64 = 8;

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

/// Y of every block, and at the end of the whole picture.
fn block_means(film: &Film) -> Vec<f64> {
    let side = film.width() as usize;
    let mut sums = vec![0.0; BLOCKS * BLOCKS + 1];
    for (pixel, xyz) in film.to_xyz().iter().enumerate() {
        let block = pixel / side * BLOCKS / side * BLOCKS + pixel % side * BLOCKS / side;
        sums[block] += xyz[1] / (side * side / (BLOCKS * BLOCKS)) as f64;
        sums[BLOCKS * BLOCKS] += xyz[1] / (side * side) as f64;
    }
    sums
}

fn estimates(scene: &Value, side: u32, first_seed: u64) -> Vec<Estimate> {
    let scene = with(&with(scene, "/film/width", side), "/film/height", side);
    let seeds = first_seed..first_seed + SEEDS;
    let films: Vec<Vec<f64>> =
        seeds.map(|seed| block_means(&render_json(&with(&scene, "/render/seed", seed)).0)).collect();
    (0..films[0].len()).map(|k| Estimate::of(&films.iter().map(|f| f[k]).collect::<Vec<_>>())).collect()
}

/// Insists that merging at the smaller of two radii differs from the truth by chance and by what is left of the blur alone.
fn agree(what: &str, truth: &[Estimate], coarse: &[Estimate], fine: &[Estimate]) {
    let brightest = truth.iter().map(|e| e.mean).fold(0.0, f64::max);
    for (k, ((truth, coarse), fine)) in truth.iter().zip(coarse).zip(fine).enumerate() {
        let sigma = truth.error.hypot(fine.error) + coarse.error.hypot(fine.error) / 3.0;
        let bias = (coarse.mean - fine.mean).abs() / 3.0;
        let off = (fine.mean - truth.mean).abs();
        println!("{what} {k}: {:.5} {:.5} {:.5} ± {sigma:.5}", truth.mean, coarse.mean, fine.mean);
        assert!(sigma < 0.03 * brightest, "{what}: block {k} is too noisy");
        assert!(off < 4.0 * sigma + bias, "{what}: block {k}: {truth:?}, {fine:?}, blur {bias}");
    }
}

/// A caustic of a light without extent seen in a mirror is the one seen directly from the mirror's other side: merging
/// against light paths.
#[test]
fn a_mirror_shows_the_same_caustic() {
    let spot = json!({ "type": "spot", "position": [0.1, 0.9, 0], "direction": [-0.1, -0.6, -0.02],
                       "intensity": 1, "inner_degrees": 7, "outer_degrees": 8 });
    let direct = scene(spot);
    let mut mirrored = direct.clone();
    mirrored["camera"]["from"] = json!([0, 0.5, 0.6]);
    mirrored["camera"]["to"] = json!([0, 0, 2]);
    // Between camera and floor, z = 1 is halfway between the camera and its mirror image.
    mirrored["objects"].as_array_mut().unwrap().push(json!({
        "shape": { "type": "quad", "origin": [-0.15, 0.22, 1], "u": [0.3, 0, 0], "v": [0, 0.3, 0] }, "material": "mirror"
    }));
    let flipped = |blocks: Vec<Estimate>| {
        let mut flipped = blocks.clone();
        for k in 0..BLOCKS * BLOCKS {
            flipped[k] = blocks[k / BLOCKS * BLOCKS + BLOCKS - 1 - k % BLOCKS];
        }
        flipped
    };
    let truth = estimates(&direct, 32, 1);
    let coarse = flipped(estimates(&mirrored, 32, 101));
    let fine = flipped(estimates(&mirrored, 64, 201));
    agree("mirror", &truth, &coarse, &fine);
}

/// A caustic of a large light seen through a plate of glass: merging against camera paths, which can run into the light.
#[test]
fn a_plate_shows_what_camera_paths_find() {
    let mut scene = scene(json!({}));
    scene["lights"] = json!([]);
    let objects = scene["objects"].as_array_mut().unwrap();
    objects
        .push(json!({ "shape": { "type": "quad", "origin": [-0.15, 0.75, -0.15], "u": [0.3, 0, 0], "v": [0, 0, 0.3] },
                         "emission": 1 }));
    objects.push(json!({ "shape": box_shape([-0.3, 0.2, 1.0], [0.3, 0.55, 1.02]), "material": "glass" }));
    let by_camera = with(&with(&scene, "/render/integrator", "path"), "/render/samples_per_pixel", 256);
    let truth = estimates(&by_camera, 32, 1);
    let by_merging = with(&scene, "/render/integrator", "merge");
    let (coarse, fine) = (estimates(&by_merging, 32, 101), estimates(&by_merging, 64, 201));
    agree("plate", &truth, &coarse, &fine);
}
