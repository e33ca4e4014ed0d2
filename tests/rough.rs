//! Rough glass and rough metal: the lobes by themselves (reciprocity, energy, the smooth limit), and pictures in which
//! camera paths, light paths and both together find the same light.

#[path = "common/render.rs"]
mod common;

use abbe::bsdf::{
    Branching, Bsdf, Carried, Conductor, Density, Dielectric, Ggx, Indices, Lanes, NEVER, Outgoing, Parting,
    RoughConductor, RoughDielectric, ScatteringModel,
};
use abbe::film::Film;
use abbe::geometry::Frame;
use abbe::math;
use abbe::sampling::Sobol;
use abbe::spectrum::{LANES, SampledSpectrum};
use common::{Estimate, render_json, sidak, with};
use glam::{DVec3, Vec3};
use serde_json::{Value, json};
use std::path::Path;

const ALPHAS: [f32; 6] = [1e-3, 0.03, 0.1, 0.3, 0.6, 1.0];

/// A dense flint, lane by lane.
fn flint() -> Indices {
    Indices { eta: std::array::from_fn(|k| 1.97 - 0.012 * k as f64), dispersive: true }
}

fn glass(alpha: f32, lanes: Lanes, leaving: bool) -> RoughDielectric {
    let (from, to) = if leaving { (flint(), Indices::AIR) } else { (Indices::AIR, flint()) };
    let (boundary, odds) = (Dielectric { from, to }, SampledSpectrum::ONE);
    RoughDielectric { boundary, ggx: Ggx::new(alpha), lanes, hero: 3, odds, parts: false }
}

fn metal(alpha: f32) -> RoughConductor {
    let (eta, k) = (SampledSpectrum::splat(0.2), SampledSpectrum::splat(3.4));
    RoughConductor { facets: Conductor { eta, k, eta_outside: [1.0; LANES] }, ggx: Ggx::new(alpha) }
}

/// A path that has just started.
fn carried() -> Carried {
    Carried::new(0, Branching { parting: Parting::Ways(1), least_share: NEVER })
}

/// f · |cos θ_i|.
fn value(model: &impl ScatteringModel, frame: &Frame, wo: Vec3, wi: Vec3) -> SampledSpectrum {
    model.evaluate(frame, wo, wi).map_or(SampledSpectrum::ZERO, |evaluation| evaluation.value)
}

fn frame() -> Frame {
    let geometric = DVec3::new(0.2, 0.9, -0.3).normalize();
    Frame { geometric, shading: geometric.as_vec3() }
}

/// The direction at an angle to the normal, degrees, turned about it.
fn direction(degrees: f64, turn: f64) -> Vec3 {
    let (s, t) = frame().geometric.any_orthonormal_pair();
    let theta = degrees.to_radians();
    let across = s * math::cos(turn) + t * math::sin(turn);
    (frame().geometric * math::cos(theta) + across * math::sin(theta)).normalize().as_vec3()
}

/// f(ωₒ → ωᵢ) / η_i² is f(ωᵢ → ωₒ) / η_o²: light goes the same way back, in units of étendue.
#[test]
fn reciprocity() {
    let sobol = Sobol::new(5);
    for (alpha, leaving) in ALPHAS.into_iter().flat_map(|a| [(a, false), (a, true)]) {
        let boundary = glass(alpha, Lanes::Shared, leaving);
        let mut compared = 0;
        for i in 0..2000 {
            let u = sobol.group(i, 0);
            let wo = direction(89.0 * f64::from(u[3]), 0.3);
            let sample = boundary.sample(&frame(), wo, &carried(), [u[0], u[1]], u[2]);
            let Some((sample, wi)) = sample.and_then(|sample| Some((sample, sample.wi.shared()?))) else { continue };
            let crosses = sample.crosses;
            let there = value(&boundary, &frame(), wo, wi).lanes();
            let (reversed, turned) = boundary.reversed(&frame(), crosses);
            let back = value(&reversed, &turned, wi, wo).lanes();
            let (cos_i, cos_o) = (frame().cos_shading(wi).abs(), frame().cos_shading(wo).abs());
            for k in 0..LANES {
                let (from, to) = (boundary.boundary.from.eta[k], boundary.boundary.to.eta[k]);
                let ratio = if crosses { (to * to / (from * from)) as f32 } else { 1.0 };
                let (there, back) = (there[k] / cos_i, ratio * back[k] / cos_o);
                // Cosines near grazing angles are f32, and so are directions against a narrow lobe.
                let tolerance = 2e-4 + 2e-7 / cos_i.min(cos_o) + 4e-6 / alpha;
                assert!((there - back).abs() <= tolerance * there.max(back), "{alpha} {crosses}: {there} {back}");
                compared += 1;
            }
        }
        assert!(compared > 8000, "{alpha}: {compared}");
        let metal = metal(alpha);
        let (a, b) = (direction(40.0, 0.0), direction(41.0, 3.1));
        let there = value(&metal, &frame(), a, b).lane(0) / frame().cos_shading(b);
        let back = value(&metal, &frame(), b, a).lane(0) / frame().cos_shading(a);
        assert!((there / back - 1.0).abs() < 1e-4, "{alpha}: {there} {back}");
    }
}

/// Mean weight of samples: the share of the light that is scattered once by what a white surface would scatter.
fn energy(n: u64, seed: u64, sample: impl Fn([f32; 8]) -> f32) -> f64 {
    let sobol = Sobol::new(seed);
    (0..n).map(|i| f64::from(sample(sobol.group(i, 0)))).sum::<f64>() / n as f64
}

/// A furnace: what comes in goes out, but for what meets a second facet, which single scattering loses: of dense flint up to
/// 1.9 % at α = 0.03, 11 % at 0.1, 20 % at 0.3, 41 % at 0.6, 69 % at 1, at the worst angle and from the worse side. Each
/// lane, from either side, alone or led by another.
#[test]
fn furnace() {
    let limits = [1e-4, 0.022, 0.12, 0.21, 0.43, 0.71];
    for (alpha, limit) in ALPHAS.into_iter().zip(limits) {
        let mut worst: f64 = 0.0;
        for degrees in [0.0, 30.0, 60.0, 80.0] {
            let wo = direction(degrees, 1.0);
            for leaving in [false, true] {
                let alone = |lane: usize| {
                    let boundary = glass(alpha, Lanes::Only(lane), leaving);
                    energy(4096, 7, |u| {
                        let sample = boundary.sample(&frame(), wo, &carried(), [u[0], u[1]], u[2]);
                        let Some(sample) = sample else { return 0.0 };
                        let lit = sample.weight.lane(lane);
                        assert!(lit <= 1.0 + 1e-5, "{alpha} {degrees}: a weight of {lit}");
                        lit
                    })
                };
                let together = |lane: usize| {
                    energy(1 << 15, 8, |u| {
                        let hero = (u[3] * LANES as f32) as usize;
                        let boundary = RoughDielectric { hero, ..glass(alpha, Lanes::Shared, leaving) };
                        let sample = boundary.sample(&frame(), wo, &carried(), [u[0], u[1]], u[2]);
                        let Some(sample) = sample else { return 0.0 };
                        let (lit, sum) = (sample.weight.lane(lane), sample.odds.unwrap().sum());
                        assert!((sum / LANES as f32 - 1.0).abs() < 1e-4, "odds add up to {sum}");
                        assert!(lit <= LANES as f32 * 1.001, "{alpha} {degrees}: a weight of {lit}");
                        lit
                    })
                };
                let (first, last) = (alone(0), alone(7));
                worst = worst.max(1.0 - first).max(1.0 - last);
                assert!(first < 1.0 + 1e-6 && last < 1.0 + 1e-6, "{alpha} {degrees}: {first} {last}");
                for (lane, alone) in [(0, first), (7, last)] {
                    let together = together(lane);
                    // Lobes that hardly overlap leave each lane to its turn as hero: the variance is about C.
                    assert!((together - alone).abs() < 0.02, "{alpha} {degrees} {leaving}: {together} {alone}");
                }
            }
        }
        println!("glass of α = {alpha}: a loss of at most {worst:.4}");
        assert!(worst < limit, "{alpha}: {worst}");
    }
}

/// At facets that lanes share, the same energy as above.
#[test]
fn furnace_where_lanes_part() {
    for (alpha, degrees) in [(0.01, 30.0), (0.01, 60.0), (0.1, 60.0), (0.3, 45.0)] {
        let wo = direction(degrees, 1.0);
        for leaving in [false, true] {
            let parting = RoughDielectric { parts: true, ..glass(alpha, Lanes::Shared, leaving) };
            for lane in [0, 7] {
                let parted = energy(8192, 9, |u| {
                    let sample = parting.sample(&frame(), wo, &carried(), [u[0], u[1]], u[2]);
                    let Some(sample) = sample else { return 0.0 };
                    if let (Outgoing::PerLane(directions), Density::PerLane(pdf)) = (sample.wi, sample.pdf) {
                        assert_eq!(directions[lane].is_some(), pdf.lane(lane) > 0.0);
                    }
                    sample.weight.lane(lane)
                });
                let boundary = glass(alpha, Lanes::Only(lane), leaving);
                let alone = energy(8192, 10, |u| {
                    let sample = boundary.sample(&frame(), wo, &carried(), [u[0], u[1]], u[2]);
                    sample.map_or(0.0, |sample| sample.weight.lane(lane))
                });
                assert!((parted - alone).abs() < 5e-3, "{alpha} {degrees} {leaving} {lane}: {parted} {alone}");
            }
        }
    }
}

/// Metals that reflect all lose what meets a second facet, and nothing else. At α = 1 facets are those of a hemisphere, D = 1 / π,
/// Λ = (1 / cos θ − 1) / 2, and what falls straight down returns as ∫ D / (4 (1 + Λ(θ))) dω = 1 − ln 2.
#[test]
fn metals() {
    let losses = [1e-4, 0.02, 0.11, 0.16, 0.42, 0.7];
    for (alpha, limit) in ALPHAS.into_iter().zip(losses) {
        for degrees in [0.0, 45.0, 80.0] {
            let wo = direction(degrees, 0.5);
            let (eta, k) = (SampledSpectrum::splat(1e-3), SampledSpectrum::splat(1e3));
            let perfect = RoughConductor { facets: Conductor { eta, k, ..metal(0.1).facets }, ggx: Ggx::new(alpha) };
            let e = energy(8192, 3, |u| {
                let Some(sample) = perfect.sample(&frame(), wo, &carried(), [u[0], u[1]], 0.0) else { return 0.0 };
                let wi = sample.wi.shared().unwrap();
                let evaluation = perfect.evaluate(&frame(), wo, wi).unwrap();
                let (pdf, value) = (evaluation.pdf.shared().unwrap(), evaluation.value.lane(0));
                let tolerance = 1e-3 + 1e-5 / alpha;
                assert!(
                    (pdf / sample.pdf.shared().unwrap() - 1.0).abs() < tolerance,
                    "{alpha}: {pdf} {:?}",
                    sample.pdf
                );
                assert!((value / pdf - sample.weight.lane(0)).abs() < 1e-3, "{alpha}");
                sample.weight.lane(0)
            });
            assert!(e < 1.0 + 1e-6 && e > 1.0 - limit, "{alpha} {degrees}: {e}");
            if alpha == 1.0 && degrees == 0.0 {
                assert!((e - (1.0 - std::f64::consts::LN_2)).abs() < 1e-5, "{e}");
            }
        }
        assert!(Bsdf::RoughConductor(metal(alpha)).is_rough());
    }
}

const SIDE: usize = 32;
const BLOCK: usize = 4;
const SEEDS: u64 = 16;
/// Joint level of all comparisons of pictures in this file.
const LEVEL: f64 = 0.01;
const PAIRS: usize = 4 * 3 + 2;

/// A floor and a wall with a rough ball that the camera sees a part of, and its caustic.
fn scene(material: Value, light: Value) -> Value {
    json!({
        "camera": { "type": "perspective", "from": [0.1, 0.3, 0.7], "to": [-0.03, 0.05, 0], "fov_degrees": 26 },
        "film": { "width": SIDE, "height": SIDE, "filter": { "type": "box" } },
        "render": { "samples_per_pixel": 64, "max_depth": 8, "seed": 0, "integrator": "path" },
        "materials": {
            "floor": { "type": "diffuse", "reflectance": { "rgb": [0.7, 0.6, 0.4] } },
            "wall": { "type": "diffuse", "reflectance": { "rgb": [0.3, 0.5, 0.6] } },
            "rough": material
        },
        "objects": [
            { "shape": { "type": "quad", "origin": [-0.5, 0, 0.5], "u": [1, 0, 0], "v": [0, 0, -1] }, "material": "floor" },
            { "shape": { "type": "quad", "origin": [-0.5, 0, -0.5], "u": [1, 0, 0], "v": [0, 1, 0] }, "material": "wall" },
            { "shape": { "type": "sphere", "center": [0.0, 0.17, -0.03], "radius": 0.1 }, "material": "rough" },
            light
        ],
        "lights": []
    })
}

/// 0.3 sr seen from the ball.
fn lamp() -> Value {
    json!({ "shape": { "type": "quad", "origin": [-0.05, 0.75, -0.2], "u": [0.28, 0, 0], "v": [0, 0.05, 0.3] },
            "emission": { "blackbody_kelvin": 3200, "scale": 5 } })
}

fn frosted(alpha: f64) -> Value {
    json!({ "type": "dielectric", "ior": { "glass": "N-SF66", "extrapolate": "hold" }, "roughness": alpha })
}

/// X, Y, Z of every block, and at the end those of the whole picture.
fn block_means(film: &Film) -> Vec<f64> {
    let blocks = SIDE / BLOCK;
    let mut sums = vec![0.0; 3 * (blocks * blocks + 1)];
    for (pixel, xyz) in film.to_image().triples().iter().enumerate() {
        let block = pixel / SIDE / BLOCK * blocks + pixel % SIDE / BLOCK;
        for c in 0..3 {
            sums[3 * block + c] += xyz[c] / (BLOCK * BLOCK) as f64;
            sums[3 * blocks * blocks + c] += xyz[c] / (SIDE * SIDE) as f64;
        }
    }
    sums
}

fn estimates(scene: &Value, integrator: &str, samples: u64, first_seed: u64) -> Vec<Estimate> {
    let scene = with(&with(scene, "/render/integrator", integrator), "/render/samples_per_pixel", samples);
    let films: Vec<Vec<f64>> = (first_seed..first_seed + SEEDS)
        .map(|seed| block_means(&render_json(&with(&scene, "/render/seed", seed)).0))
        .collect();
    (0..films[0].len()).map(|k| Estimate::of(&films.iter().map(|f| f[k]).collect::<Vec<_>>())).collect()
}

/// Compares estimates of two techniques block by block [Welch1947], [Sidak1967].
fn compare(what: &str, a: &[Estimate], b: &[Estimate], noise: f64) {
    let smallest = a.iter().zip(b).map(|(a, b)| a.p_value(b)).fold(1.0, f64::min);
    let (whole_a, whole_b) = (a[a.len() - 2], b[b.len() - 2]);
    let sigma = whole_a.error.hypot(whole_b.error) / whole_a.mean;
    let off = whole_b.mean / whole_a.mean - 1.0;
    let errors = [whole_a.error / whole_a.mean, whole_b.error / whole_b.mean].map(|e| 100.0 * e);
    println!(
        "{what}: differ by {:+.3} % ± {:.3} %, errors {errors:.3?} %, p {smallest:.5}",
        100.0 * off,
        100.0 * sigma
    );
    assert!(errors[0] < 100.0 * noise && errors[1] < 100.0 * noise, "{what}: too noisy");
    assert!(off.abs() < 3.5 * sigma, "{what}");
    let threshold = sidak(LEVEL, PAIRS * a.len());
    assert!(smallest > threshold, "{what}: p = {smallest:e} < {threshold:e}");
}

/// Camera paths, light paths, and both: `merge` draws every light, as `auto` does the small ones.
fn agree(name: &str, scene: &Value, samples: [u64; 3]) {
    let names = ["path", "light", "merge"];
    let all: Vec<Vec<Estimate>> =
        (0..3).map(|i| estimates(scene, names[i], samples[i], 1000 * (i as u64 + 1))).collect();
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        compare(&format!("{name}: {} {}", names[i], names[j]), &all[i], &all[j], 0.006);
    }
}

#[test]
fn rough_dispersive_glass() {
    agree("frosted flint", &scene(frosted(0.3), lamp()), [64, 256, 48]);
}

#[test]
fn finely_ground_glass() {
    agree("ground flint", &scene(frosted(0.08), lamp()), [128, 384, 48]);
}

/// A rough metal under a smooth glass ball: caustics on it, and its own.
#[test]
fn rough_metal() {
    let mut scene = scene(json!({ "type": "conductor", "metal": "Au", "roughness": 0.25 }), lamp());
    scene["materials"]["glass"] = json!({ "type": "dielectric", "ior": { "glass": "N-SF11", "extrapolate": "hold" } });
    scene["objects"].as_array_mut().unwrap().push(json!(
        { "shape": { "type": "sphere", "center": [0.03, 0.38, 0.0], "radius": 0.06 }, "material": "glass" }));
    agree("rough gold", &scene, [128, 256, 48]);
}

/// Frosted glass in a liquid, absorbing, with a smooth drop of something else in it: every class of path at once. The
/// camera and the light are in the liquid.
#[test]
fn nested_rough_media() {
    let mut scene = scene(frosted(0.4), lamp());
    scene["materials"]["rough"]["absorption_per_m"] = json!({ "wavelengths_nm": [400, 700], "values": [6, 1] });
    scene["materials"]["rough"]["priority"] = json!(1);
    scene["materials"]["liquid"] = json!({ "type": "dielectric", "ior": { "nd": 1.36, "vd": 50 } });
    scene["materials"]["drop"] = json!({ "type": "dielectric", "ior": 1.05, "priority": 2, "roughness": 0.4 });
    let objects = scene["objects"].as_array_mut().unwrap();
    objects.push(json!({ "shape": { "type": "sphere", "center": [0, 0, 0], "radius": 3 }, "material": "liquid" }));
    objects
        .push(json!({ "shape": { "type": "sphere", "center": [0.05, 0.2, 0.0], "radius": 0.08 }, "material": "drop" }));
    agree("nested", &scene, [96, 512, 48]);
}

/// As rough as nothing is as smooth: what is seen through a ball and in it.
#[test]
fn the_smooth_limit() {
    let smooth = with(&scene(frosted(0.0), lamp()), "/camera/to", json!([0.0, 0.17, 0.0]));
    let a = estimates(&smooth, "path", 64, 1);
    for alpha in [1e-4, 1e-3] {
        let rough = with(&smooth, "/materials/rough/roughness", alpha);
        compare(&format!("α = {alpha}"), &a, &estimates(&rough, "path", 64, 500), 0.01);
    }
}

fn parsed(roughness: Value, material: &str) -> Result<abbe::scene::Compiled, abbe::Error> {
    let mut scene = scene(frosted(0.0), lamp());
    if material == "conductor" {
        scene["materials"]["rough"] = json!({ "type": "conductor", "metal": "Au" });
    }
    scene["materials"]["rough"]["roughness"] = roughness;
    let parsed = abbe::scene::description::parse_str(&scene.to_string(), Path::new("test.json"))?;
    abbe::scene::compile(&parsed.description)
}

#[test]
fn bad_input() {
    for material in ["dielectric", "conductor"] {
        for (roughness, code, fragment) in [
            (json!(-0.1), "out_of_range", "[0, 1]"),
            (json!(1.5), "out_of_range", "[0, 1]"),
            (json!([0.1, 1.5]), "out_of_range", "[0, 1]"),
            (json!([0.1, 0.2]), "unsupported", "expected one number, or two equal ones"),
            (json!([0.1]), "wrong_type", "2 numbers"),
            (json!("matte"), "wrong_type", "found a string"),
        ] {
            let error = parsed(roughness.clone(), material).expect_err("a bad roughness");
            assert_eq!(error.kind.code(), code, "{error}");
            assert!(error.to_string().contains("materials.rough.roughness"), "{error}");
            assert!(error.to_string().contains(fragment), "{error}");
        }
        for roughness in [json!(0), json!(1), json!([0.3, 0.3]), json!([0, 0])] {
            assert!(parsed(roughness, material).unwrap().warnings.is_empty());
        }
        let warnings = parsed(json!(5e-5), material).unwrap().warnings;
        assert!(warnings.len() == 1 && warnings[0].contains("rendered as smooth"), "{warnings:?}");
    }
}
