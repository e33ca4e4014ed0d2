//! Transparent volumes that touch, overlap and hold each other: what is where follows from priorities, and boundaries
//! between equal indices do not exist.

#[path = "common/render.rs"]
mod common;

use abbe::math;
use common::{Estimate, Layer, box_shape, mean_y, render_json, stack, with};
use serde_json::{Value, json};
use std::f64::consts::PI;

fn dielectric(ior: f64, priority: i32, absorption: f64) -> Value {
    json!({ "type": "dielectric", "ior": ior, "priority": priority, "absorption_per_m": absorption })
}

/// A wide slab between two heights.
fn slab(material: &str, bottom: f64, top: f64) -> Value {
    json!({ "shape": box_shape([-4.0, bottom, -4.0], [4.0, top, 4.0]), "material": material })
}

/// Looks down through slabs at a plane of radiance 1, so that the picture is their transmittance.
fn column(materials: Value, mut objects: Vec<Value>, degrees: f64) -> Value {
    let (sin, cos) = (math::sin(degrees.to_radians()), math::cos(degrees.to_radians()));
    objects.push(json!({ "emission": 1,
        "shape": { "type": "quad", "origin": [-5, -0.2, 5], "u": [10, 0, 0], "v": [0, 0, -10] } }));
    json!({
        "camera": { "type": "perspective", "from": [-sin, cos + 0.1, 0], "to": [0, 0.1, 0], "up": [0, 0, 1], "fov_degrees": 0.01 },
        "film": { "width": 32, "height": 32 },
        "render": { "samples_per_pixel": 64, "max_depth": 400, "seed": 0, "integrator": "path" },
        "materials": materials,
        "objects": objects
    })
}

fn layer(index: f64, thickness: f64) -> Layer {
    Layer { index, thickness, absorption: 0.0 }
}

fn sin(degrees: f64) -> f64 {
    math::sin(degrees.to_radians())
}

/// Liquid between two panes, its volume reaching into them. The pane wins or the liquid, by priority.
#[test]
fn overlap_is_decided_by_priority() {
    for (glass, liquid) in [(1, 0), (0, 1)] {
        for degrees in [0.0, 55.0] {
            let materials = json!({ "glass": dielectric(1.62, glass, 0.0), "liquid": dielectric(1.33, liquid, 3.0) });
            // The liquid comes first, last, and in between: order must not matter.
            let objects = vec![slab("glass", 0.0, 0.04), slab("liquid", 0.03, 0.12), slab("glass", 0.1, 0.14)];
            let (of_glass, of_liquid) = if glass > liquid { ([0.04, 0.04], 0.06) } else { ([0.03, 0.02], 0.09) };
            let between = Layer { index: 1.33, thickness: of_liquid, absorption: 3.0 };
            let (exact, _) = stack(&[layer(1.62, of_glass[0]), between, layer(1.62, of_glass[1])], sin(degrees));
            let seen = Estimate::over_seeds(&column(materials, objects, degrees), 8, mean_y);
            seen.check(&format!("overlap {glass} {liquid} at {degrees}°"), exact, 2e-3);
        }
    }
}

/// The same with faces that coincide exactly.
#[test]
fn coincident_faces() {
    for (glass, liquid) in [(1, 0), (0, 1), (0, 0)] {
        for degrees in [0.0, 55.0] {
            let materials = json!({ "glass": dielectric(1.62, glass, 0.0), "liquid": dielectric(1.33, liquid, 3.0) });
            let objects = vec![slab("glass", 0.0, 0.04), slab("liquid", 0.04, 0.1), slab("glass", 0.1, 0.14)];
            let between = Layer { index: 1.33, thickness: 0.06, absorption: 3.0 };
            let (exact, _) = stack(&[layer(1.62, 0.04), between, layer(1.62, 0.04)], sin(degrees));
            let seen = Estimate::over_seeds(&column(materials, objects, degrees), 8, mean_y);
            seen.check(&format!("coincident {glass} {liquid} at {degrees}°"), exact, 2e-3);
        }
    }
}

/// The same with panes that are boxes and a liquid that is a cylinder between them.
#[test]
fn boxes_and_cylinders_touch() {
    let pane = |bottom: f64, top: f64| json!({ "material": "glass", "shape": { "type": "box", "min": [-4, bottom, -4], "max": [4, top, 4] } });
    let liquid = json!({ "material": "liquid", "shape": { "type": "cylinder", "radius": 3, "height": 0.06 },
        "transform": [{ "translate": [0, 0.07, 0] }] });
    for degrees in [0.0, 55.0] {
        let materials = json!({ "glass": dielectric(1.62, 1, 0.0), "liquid": dielectric(1.33, 0, 3.0) });
        let objects = vec![pane(0.0, 0.04), liquid.clone(), pane(0.1, 0.14)];
        let between = Layer { index: 1.33, thickness: 0.06, absorption: 3.0 };
        let (exact, _) = stack(&[layer(1.62, 0.04), between, layer(1.62, 0.04)], sin(degrees));
        let seen = Estimate::over_seeds(&column(materials, objects, degrees), 8, mean_y);
        seen.check(&format!("box, cylinder, box at {degrees}°"), exact, 2e-3);
    }
}

/// Glass in glass of the same index, overlapping or touching, is one piece: the same bits as one box.
#[test]
fn equal_indices_reflect_nothing() {
    for degrees in [0.0, 40.0, 80.0] {
        let materials = json!({ "glass": dielectric(1.5, 0, 0.0), "other": dielectric(1.5, 1, 0.0) });
        let film = |objects| {
            render_json(&with(&column(materials.clone(), objects, degrees), "/render/samples_per_pixel", 64)).0
        };
        let whole = film(vec![slab("glass", 0.0, 0.12)]);
        let overlapping = film(vec![slab("glass", 0.0, 0.07), slab("other", 0.05, 0.12)]);
        assert_eq!(whole.to_image(), overlapping.to_image(), "overlapping at {degrees}°");
        let inside = film(vec![slab("glass", 0.0, 0.12), slab("other", 0.05, 0.07)]);
        assert_eq!(whole.to_image(), inside.to_image(), "inside at {degrees}°");
    }
}

/// Touching, with no gap at all.
#[test]
fn equal_indices_in_contact() {
    let materials = json!({ "glass": dielectric(1.5, 0, 0.0), "other": dielectric(1.5, 1, 0.0) });
    let film = |objects| render_json(&column(materials.clone(), objects, 40.0)).0;
    let whole = film(vec![slab("glass", 0.0, 0.12)]);
    let touching = film(vec![slab("glass", 0.0, 0.0625), slab("other", 0.0625, 0.12)]);
    assert_eq!(whole.to_image(), touching.to_image());
}

/// A bubble of air in glass is two more boundaries.
#[test]
fn bubble_in_glass() {
    for degrees in [0.0, 50.0] {
        let materials = json!({ "glass": dielectric(1.5, 0, 0.0), "air": dielectric(1.0, 1, 0.0) });
        let objects = vec![slab("glass", 0.0, 0.1), slab("air", 0.04, 0.06)];
        let (exact, _) = stack(&[layer(1.5, 0.04), layer(1.0, 0.02), layer(1.5, 0.04)], sin(degrees));
        Estimate::over_seeds(&column(materials, objects, degrees), 8, mean_y).check("bubble", exact, 2e-3);
    }
    // Of lower priority it is not there.
    let materials = json!({ "glass": dielectric(1.5, 0, 0.0), "air": dielectric(1.0, -1, 0.0) });
    let scene = column(materials, vec![slab("glass", 0.0, 0.1), slab("air", 0.04, 0.06)], 0.0);
    Estimate::over_seeds(&scene, 8, mean_y).check("no bubble", stack(&[layer(1.5, 0.1)], 0.0).0, 2e-3);
}

/// Ice that floats: part of it in water, part in air. Straight down through it there is no water on top.
#[test]
fn ice_in_water() {
    let materials = json!({ "water": dielectric(1.333, 0, 2.0), "ice": dielectric(1.6, 1, 0.0) });
    let ice = json!({ "shape": box_shape([-0.5, 0.02, -0.5], [0.5, 0.12, 0.5]), "material": "ice" });
    let scene = column(materials, vec![slab("water", 0.0, 0.1), ice], 0.0);
    let water = Layer { index: 1.333, thickness: 0.02, absorption: 2.0 };
    let (exact, _) = stack(&[layer(1.6, 0.1), water], 0.0);
    Estimate::over_seeds(&scene, 8, mean_y).check("ice", exact, 2e-3);
    // Obliquely, where light also leaves by its sides and by those of the water: in a furnace nothing can be seen.
    let mut furnace = with(&scene, "/camera/from", json!([0.8, 0.7, 0.9]));
    furnace["camera"]["fov_degrees"] = json!(40);
    furnace["environment"] = json!({ "radiance": 1 });
    furnace["objects"].as_array_mut().unwrap().pop();
    furnace["materials"]["water"]["absorption_per_m"] = json!(0);
    let (film, _) = render_json(&with(&furnace, "/render/max_depth", 2000));
    assert!((mean_y(&film) - 1.0).abs() < 1e-3, "{}", mean_y(&film));
}

/// A room with a lamp; objects of index 1 stand in it.
fn room(objects: &[Value]) -> Value {
    let mut all = vec![
        json!({ "shape": { "type": "quad", "origin": [-1, 0, 1], "u": [2, 0, 0], "v": [0, 0, -2] }, "material": "wall" }),
        json!({ "shape": { "type": "quad", "origin": [-1, 0, -1], "u": [2, 0, 0], "v": [0, 2, 0] }, "material": "wall" }),
        json!({ "shape": { "type": "sphere", "center": [0.3, 1, 0], "radius": 0.1 }, "emission": 5 }),
    ];
    all.extend_from_slice(objects);
    json!({
        "camera": { "type": "perspective", "from": [0, 1, 2.5], "to": [0, 0.6, 0], "fov_degrees": 40 },
        "film": { "width": 48, "height": 48 },
        "render": { "samples_per_pixel": 16, "max_depth": 6, "seed": 0, "integrator": "path" },
        "materials": { "wall": { "type": "diffuse", "reflectance": 0.7 }, "air": dielectric(1.0, 3, 0.0) },
        "objects": all,
        "lights": [{ "type": "point", "position": [-0.5, 0.7, 0.2], "intensity": 0.5 }]
    })
}

/// A volume of index 1 changes nothing, whether it stands in the view, between light and wall, or around the lamp.
#[test]
fn index_one_is_invisible() {
    let places = [([0.0, 0.5, 0.5], 0.3), ([0.3, 0.5, 0.0], 0.3), ([0.3, 1.0, 0.0], 0.2), ([-0.5, 0.7, 0.2], 0.1)];
    let balls: Vec<Value> = places
        .iter()
        .map(|(center, radius)| json!({ "shape": { "type": "sphere", "center": center, "radius": radius }, "material": "air" }))
        .collect();
    for integrator in ["path", "light", "auto"] {
        let render = |objects: &[Value]| render_json(&with(&room(objects), "/render/integrator", integrator)).0;
        let (without, with) = (render(&[]), render(&balls));
        let (a, b) = (mean_y(&without), mean_y(&with));
        assert!((a / b - 1.0).abs() < 1e-5, "{integrator}: {a} {b}");
        // The random numbers are the same: but for rounding at edges, so is every pixel.
        let differ = (0..48 * 48).filter(|&p| (without.xyz(p)[1] - with.xyz(p)[1]).abs() > 1e-3 * a).count();
        assert!(differ <= 10, "{integrator}: {differ} pixels differ");
    }
}

/// A lamp in the middle of a glass ball. What is reflected at the glass comes back to the lamp, which is black, so that
/// of light with impact parameter p, uniform in p² up to the lamp's radius a, the share 1 − F(p / b) escapes once.
#[test]
fn lamp_in_a_glass_ball() {
    let (a, b, n, wall) = (0.1, 0.15, 1.5, 1.0);
    let scene = json!({
        "camera": { "type": "perspective", "from": [0, 0, 0.5], "to": [0, 0, 2], "fov_degrees": 90 },
        "film": { "width": 16, "height": 16 },
        "render": { "samples_per_pixel": 512, "max_depth": 2, "seed": 0, "integrator": "path" },
        "materials": { "glass": dielectric(n, 0, 0.0), "wall": { "type": "diffuse", "reflectance": 0.5 } },
        "objects": [
            { "shape": { "type": "sphere", "center": [0, 0, 0], "radius": a }, "emission": 10 },
            { "shape": { "type": "sphere", "center": [0, 0, 0], "radius": b }, "material": "glass" },
            { "shape": { "type": "sphere", "center": [0, 0, 0], "radius": wall }, "material": "wall" }
        ]
    });
    let steps = 20_000;
    let escaping = (0..steps)
        .map(|i| (f64::from(i) + 0.5) / f64::from(steps))
        // The sine in the glass is p / b: n times that in a medium of index 1.
        .map(|s2| 1.0 - common::fresnel(n * a * s2.sqrt() / b, n, 1.0))
        .sum::<f64>()
        / f64::from(steps);
    let power = 4.0 * PI * PI * a * a * 10.0 * escaping;
    let exact = 0.5 / PI * power / (4.0 * PI * wall * wall);
    for integrator in ["path", "light", "auto"] {
        let scene = with(&scene, "/render/integrator", integrator);
        let scene = with(&scene, "/render/samples_per_pixel", if integrator == "path" { 2048 } else { 1024 });
        Estimate::over_seeds(&scene, 8, mean_y).check(&format!("lamp in glass, {integrator}"), exact, 6e-3);
    }
    // Seen directly through the middle: (1 − F) L / n².
    let direct = with(&with(&scene, "/camera/to", json!([0, 0, 0])), "/camera/fov_degrees", 0.1);
    let f0 = (n - 1.0) * (n - 1.0) / ((n + 1.0) * (n + 1.0));
    let direct = with(&direct, "/materials/wall/reflectance", 0);
    let direct = with(&direct, "/render/max_depth", 8);
    let exact = (1.0 - f0) * 10.0 / (n * n);
    Estimate::over_seeds(&direct, 8, mean_y).check("lamp seen through glass", exact, 2e-3);
    // In equilibrium: black at n² in glass, surrounded by 1, is 1 everywhere.
    let mut equilibrium = with(&direct, "/camera/fov_degrees", 40);
    equilibrium["objects"].as_array_mut().unwrap().pop();
    equilibrium["objects"][0]["emission"] = json!(n * n);
    equilibrium["environment"] = json!({ "radiance": 1 });
    let (film, _) = render_json(&with(&equilibrium, "/render/max_depth", 64));
    let picture = film.to_image();
    let pixels = picture.triples();
    let spread = pixels.iter().map(|p| (p[1] - 1.0).abs()).fold(0.0, f64::max);
    assert!((mean_y(&film) - 1.0).abs() < 1e-3 && spread < 0.05, "{} {spread}", mean_y(&film));
}
