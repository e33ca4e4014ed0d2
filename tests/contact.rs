//! Glass on tables and lamps on glass, in exact contact: nothing goes through a table, and a lamp shines.

#[path = "common/render.rs"]
mod common;

use common::{Estimate, compile_json, mean_y, render_counting_underflows, with};
use glam::{DQuat, DVec3};
use serde_json::{Value, json};

/// The same fractions every time.
struct Fractions(u64);

impl Fractions {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.next()
    }
}

/// A block with a step, which is not convex, so that it stays a mesh.
fn stepped_block() -> Value {
    let outline = [[-0.5, 0.0], [0.5, 0.0], [0.5, 0.4], [0.0, 0.4], [0.0, 0.8], [-0.5, 0.8]];
    let mut positions = Vec::new();
    for z in [-0.5, 0.5] {
        positions.extend(outline.iter().flat_map(|[x, y]| [*x, *y, z]));
    }
    // Two rectangles tile the L, once at the back and once at the front.
    let caps = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]];
    let mut indices: Vec<u32> = caps.iter().flat_map(|[a, b, c]| [*a, *c, *b]).collect();
    indices.extend(caps.iter().flatten().map(|i| i + 6));
    for i in 0..6 {
        let j = (i + 1) % 6;
        indices.extend([i, j, j + 6, i, j + 6, i + 6]);
    }
    json!({ "type": "triangles", "positions": positions, "indices": indices })
}

/// Glass shapes that stand on y = 0.
fn standing(kind: usize) -> (Value, Value) {
    match kind {
        0 => (json!({ "type": "box", "min": [-0.5, 0, -0.4], "max": [0.5, 0.3, 0.5] }), json!([])),
        1 => (
            json!({ "type": "lens", "radii": [null, 2.0], "thickness": 0.3, "diameter": 1 }),
            json!([{ "rotate_degrees": -90, "axis": [1, 0, 0] }, { "translate": [0, 0.15, 0] }]),
        ),
        2 => (stepped_block(), json!([])),
        3 => (json!({ "type": "cylinder", "radius": 0.4, "height": 0.5 }), json!([{ "translate": [0, 0.25, 0] }])),
        _ => (json!({ "type": "sphere", "center": [0, 0.45, 0], "radius": 0.45 }), json!([])),
    }
}

/// Glass on a table that is turned, moved and scaled with it; a lamp of radiance 1 under the table is all the light.
fn lamp_under_table(kind: usize, random: &mut Fractions) -> Value {
    let axis = DVec3::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0));
    let degrees = if random.next() < 0.25 { 0.0 } else { random.between(0.0, 360.0) };
    let scale = abbe::math::exp(random.between(-7.0, 7.0));
    let shift = DVec3::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)) * scale;
    let place = json!([{ "scale": scale }, { "rotate_degrees": degrees, "axis": axis.to_array() },
                       { "translate": shift.to_array() }]);
    let turn = DQuat::from_axis_angle(axis.normalize(), degrees.to_radians());
    let at = |p: DVec3| (turn * (p * scale) + shift).to_array();
    let (shape, mut transform) = standing(kind);
    let turned = json!([{ "rotate_degrees": random.between(0.0, 360.0), "axis": [0, 1, 0] }]);
    for step in [&turned, &place] {
        transform.as_array_mut().unwrap().extend(step.as_array().unwrap().iter().cloned());
    }
    let sheet = |y: f64| json!({ "type": "quad", "origin": [-3, y, 3], "u": [6, 0, 0], "v": [0, 0, -6] });
    let glass = json!({ "shape": shape, "material": "glass", "transform": transform });
    let table = json!({ "shape": sheet(0.0), "material": "table", "transform": place });
    let lamp = json!({ "shape": sheet(-0.5), "emission": 1, "transform": place });
    let objects = if random.next() < 0.5 { json!([glass, table, lamp]) } else { json!([table, lamp, glass]) };
    json!({
        "camera": { "type": "perspective", "from": at(DVec3::new(0.3, 3.0, 0.2)), "to": at(DVec3::new(-0.1, 0.0, 0.1)),
                    "up": (turn * DVec3::Z).to_array(), "fov_degrees": 12 },
        "film": { "width": 8, "height": 8 },
        "render": { "samples_per_pixel": 64, "integrator": "path" },
        "materials": { "glass": { "type": "dielectric", "ior": 1.5 },
                       "table": { "type": "diffuse", "reflectance": 0.5 } },
        "objects": objects
    })
}

#[test]
fn nothing_goes_through_a_table_under_glass() {
    let mut random = Fractions(7);
    let mut worst: f64 = 0.0;
    for pair in 0..200 {
        let scene = lamp_under_table(pair % 5, &mut random);
        let (film, statistics) = render_counting_underflows(&compile_json(&scene));
        assert_eq!(statistics.counters.medium_underflows, 0, "{pair}: {scene}");
        let leak = mean_y(&film);
        assert!(leak < 1e-5, "{pair}: {leak:e} in {scene}");
        worst = worst.max(leak);
    }
    println!("worst leak {worst:e}");
}

/// A plano-convex lens, `above` a matte table, in even light.
fn lens_on_table(above: f64, integrator: &str) -> Value {
    json!({
        "camera": { "type": "perspective", "from": [0.3, 3.75, 0.2], "to": [-0.15, 0.75, 0.1], "fov_degrees": 4 },
        "film": { "width": 8, "height": 8 },
        "render": { "samples_per_pixel": 512, "integrator": integrator, "seed": 0 },
        "materials": { "glass": { "type": "dielectric", "ior": 1.5 },
                       "table": { "type": "diffuse", "reflectance": 0.5 } },
        "objects": [
            { "shape": { "type": "quad", "origin": [-5, 0.75, 5], "u": [10, 0, 0], "v": [0, 0, -10] }, "material": "table" },
            { "shape": { "type": "lens", "radii": [null, 2.0], "thickness": 0.3, "diameter": 1 }, "material": "glass",
              "transform": [{ "rotate_degrees": -90, "axis": [1, 0, 0] }, { "translate": [0, 0.9 + above, 0] }] }
        ],
        "environment": { "radiance": 1 }
    })
}

#[test]
fn contact_is_optical_contact() {
    for integrator in ["path", "auto"] {
        let y = |above: f64| Estimate::over_seeds(&lens_on_table(above, integrator), 8, mean_y);
        let (touching, sunk) = (y(0.0), y(-1e-4));
        println!("{integrator}: touching {touching:?}, sunk {sunk:?}");
        assert!(touching.p_value(&sunk) > 1e-4, "{integrator}: touching {touching:?}, sunk {sunk:?}");
        assert!((touching.mean / sunk.mean - 1.0).abs() < 0.01);
    }
}

/// A lamp that shines up (or down, into the glass) near the upper face of a block of glass over a matte floor.
fn lamp_on_glass(above: f64, down: bool, integrator: &str) -> Value {
    let (u, v) = if down { ([0.6, 0.0, 0.0], [0.0, 0.0, 0.6]) } else { ([0.0, 0.0, 0.6], [0.6, 0.0, 0.0]) };
    json!({
        "camera": { "type": "perspective", "from": [0, 0.95, 0.0001], "to": [0, 0, 0], "fov_degrees": 70 },
        "film": { "width": 16, "height": 16 },
        "render": { "samples_per_pixel": 256, "integrator": integrator, "seed": 0 },
        "materials": { "glass": { "type": "dielectric", "ior": 1.5 },
                       "floor": { "type": "diffuse", "reflectance": 0.5 } },
        "objects": [
            { "shape": { "type": "quad", "origin": [-1, 0, 1], "u": [2, 0, 0], "v": [0, 0, -2] }, "material": "floor" },
            { "shape": { "type": "quad", "origin": [-2, 2, -2], "u": [4, 0, 0], "v": [0, 0, 4] }, "material": "floor" },
            { "shape": { "type": "box", "min": [-0.5, 1, -0.5], "max": [0.5, 1.05, 0.5] }, "material": "glass" },
            { "shape": { "type": "quad", "origin": [-0.3, 1.05 + above, -0.3], "u": u, "v": v }, "emission": 1 }
        ]
    })
}

#[test]
fn a_lamp_in_a_face_of_glass_shines() {
    for (down, near) in [(true, -1e-4), (false, 1e-4)] {
        for integrator in ["path", "light", "auto"] {
            let y = |above: f64| Estimate::over_seeds(&lamp_on_glass(above, down, integrator), 6, mean_y);
            let (touching, clear) = (y(0.0), y(near));
            println!("{integrator}, down {down}: touching {touching:?}, clear {clear:?}");
            assert!(touching.mean > 1e-3 && touching.p_value(&clear) > 1e-4, "{integrator}, {down}");
        }
    }
    // A gap of a few times the rounding is no contact, and all techniques agree on that.
    for above in [-1e-5, -4e-6, 4e-6, 1e-5] {
        let [path, light, auto] = ["path", "light", "auto"]
            .map(|integrator| Estimate::over_seeds(&lamp_on_glass(above, false, integrator), 6, mean_y));
        println!("{above:e}: path {path:?}, light {light:?}, auto {auto:?}");
        assert!(path.p_value(&light) > 1e-4 && path.p_value(&auto) > 1e-4, "{above:e}: {path:?} {light:?} {auto:?}");
    }
    let above = with(&lamp_on_glass(0.001, true, "auto"), "/render/seed", 3);
    assert!(mean_y(&common::render_json(&above).0) > 1e-3);
}

/// A glass ball of radius 5 mm, sunk into a matte ground by a share of its radius, under an even sky.
fn ball_on_ground(half_width: f64, sunk: f64) -> Value {
    let (radius, w) = (0.005, half_width);
    json!({
        "camera": { "type": "perspective", "from": [0, 0.05, 0.03], "to": [0, radius, 0], "fov_degrees": 8 },
        "film": { "width": 16, "height": 16 },
        "render": { "samples_per_pixel": 256, "integrator": "path", "seed": 0 },
        "materials": { "glass": { "type": "dielectric", "ior": 1.5 }, "ground": { "type": "diffuse", "reflectance": 0.5 } },
        "objects": [
            { "shape": { "type": "quad", "origin": [-w, 0, w], "u": [2.0 * w, 0, 0], "v": [0, 0, -2.0 * w] }, "material": "ground" },
            { "shape": { "type": "sphere", "center": [0, radius * (1.0 - sunk), 0], "radius": radius }, "material": "glass" }
        ],
        "environment": { "radiance": 1 }
    })
}

#[test]
fn a_ball_touches_a_wide_ground_in_a_point() {
    for sunk in [0.0, 1e-3] {
        let y =
            |half_width: f64| mean_y(&render_counting_underflows(&compile_json(&ball_on_ground(half_width, sunk))).0);
        let near = y(0.5);
        for half_width in [100.0, 1000.0] {
            let far = y(half_width);
            println!("sunk by {sunk}: {near} on 1 m, {far} on {} m", 2.0 * half_width);
            assert!((far / near - 1.0).abs() < 0.01, "sunk by {sunk}: {near} on 1 m, {far} on {} m", 2.0 * half_width);
        }
    }
}

/// A lamp in a plate of glass of 3 mm over a floor: in its middle, or in its upper face.
fn lamp_in_plate(half_width: f64, height: f64, integrator: &str) -> Value {
    let w = half_width;
    json!({
        "camera": { "type": "perspective", "from": [0.1, 0.018, 0], "to": [0, 0, 0], "fov_degrees": 12 },
        "film": { "width": 16, "height": 16 },
        "render": { "samples_per_pixel": 256, "integrator": integrator, "seed": 0 },
        "materials": { "glass": { "type": "dielectric", "ior": 1.5 }, "floor": { "type": "diffuse", "reflectance": 0.5 } },
        "objects": [
            { "shape": { "type": "quad", "origin": [-w, 0, w], "u": [2.0 * w, 0, 0], "v": [0, 0, -2.0 * w] }, "material": "floor" },
            { "shape": { "type": "box", "min": [-0.02, 0.02, -0.02], "max": [0.02, 0.023, 0.02] }, "material": "glass" },
            { "shape": { "type": "disk", "center": [0, height, 0], "normal": [0, -1, 0], "radius": 0.005 }, "emission": 10 }
        ]
    })
}

#[test]
fn a_lamp_in_thin_glass_stays_there_in_a_wide_scene() {
    for height in [0.0215, 0.023] {
        let y = |half_width: f64, integrator: &str| {
            Estimate::over_seeds(&lamp_in_plate(half_width, height, integrator), 4, mean_y)
        };
        let near = y(0.5, "path");
        for (half_width, integrator) in [(0.5, "light"), (250.0, "path"), (250.0, "light")] {
            let far = y(half_width, integrator);
            println!("at {height}: {near:?}, {integrator} in {half_width} m: {far:?}");
            assert!(
                (far.mean / near.mean - 1.0).abs() < 0.02,
                "at {height}: {near:?}, {integrator}, {half_width}: {far:?}"
            );
        }
    }
}
