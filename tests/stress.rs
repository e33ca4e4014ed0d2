//! Glass where it is hardest: lights and cameras inside of it, solids that touch, coincide and overlap, rays at the critical
//! angle, fifty boundaries in a row, light of one or two lines, contrasts of index from 1.0001 to 4. Every render insists
//! that no sample was lost and no path lost count of where it is (at edges of volumes in each other: at most one in a million rays); energy is compared with closed forms.

#[path = "common/render.rs"]
mod common;

use abbe::color::Observer;
use abbe::math;
use common::{
    Estimate, Layer, box_shape, compile_json, fresnel, mean_xyz_sum, mean_y, render_counting_underflows, render_json,
    stack, with,
};
use serde_json::{Value, json};
use std::f64::consts::PI;

const CONTRASTS: [f64; 5] = [1.0001, 1.01, 1.5, 2.4, 4.0];

fn dielectric(index: f64) -> Value {
    json!({ "type": "dielectric", "ior": index })
}

/// Slabs that are wide in x and z.
fn slab(material: &str, bottom: f64, top: f64) -> Value {
    json!({ "shape": box_shape([-40.0, bottom, -40.0], [40.0, top, 40.0]), "material": material })
}

/// A plane of radiance 1 that faces up (from below everything) or down (from above).
fn plane(height: f64, up: bool) -> Value {
    let (u, v) = ([0.0, 0.0, -90.0], [90.0, 0.0, 0.0]);
    let (u, v) = if up { (v, u) } else { (u, v) };
    json!({ "shape": { "type": "quad", "origin": [-45, height, 45], "u": u, "v": v }, "emission": 1 })
}

/// A camera that looks from a point along one direction, all its pixels alike.
fn narrow(from: [f64; 3], to: [f64; 3], materials: Value, objects: Vec<Value>) -> Value {
    json!({
        "camera": { "type": "perspective", "from": from, "to": to, "up": [0, 0, 1], "fov_degrees": 0.001 },
        "film": { "width": 16, "height": 16 },
        "render": { "samples_per_pixel": 128, "max_depth": 4000, "seed": 0, "integrator": "path" },
        "materials": materials,
        "objects": objects
    })
}

/// A slab of any index, at 45° and at a grazing angle.
#[test]
fn slabs_of_every_contrast() {
    for index in CONTRASTS {
        for degrees in [45f64, 89.0] {
            let (sin, cos) = (math::sin(degrees.to_radians()), math::cos(degrees.to_radians()));
            let scene = narrow(
                [-0.2 * sin, 0.2 * cos, 0.0],
                [0.0; 3],
                json!({ "glass": dielectric(index) }),
                vec![slab("glass", -0.01, 0.0), plane(-0.5, true)],
            );
            let (exact, _) = stack(&[Layer { index, thickness: 0.01, absorption: 0.0 }], sin);
            let seen = Estimate::over_seeds(&scene, 10, mean_y);
            seen.check(&format!("slab of {index} at {degrees}°"), exact, 2e-2);
        }
    }
}

/// Panes of a stack: 25 of glass that absorbs a little, with air between.
fn panes(bottom: f64) -> (Vec<Value>, Vec<Layer>) {
    let (glass, air) = (0.002, 0.001);
    let objects = (0..25).map(|i| f64::from(i) * (glass + air) + bottom).map(|b| slab("glass", b, b + glass)).collect();
    let layer = |i: usize| match i % 2 {
        0 => Layer { index: 1.3, thickness: glass, absorption: 2.0 },
        _ => Layer { index: 1.0, thickness: air, absorption: 0.0 },
    };
    (objects, (0..49).map(layer).collect())
}

/// Fifty boundaries, seen through and at a slant.
#[test]
fn seen_through_fifty_boundaries() {
    for degrees in [0.0f64, 60.0] {
        let (sin, cos) = (math::sin(degrees.to_radians()), math::cos(degrees.to_radians()));
        let (mut objects, layers) = panes(0.0);
        objects.push(plane(-0.1, true));
        let glass = json!({ "type": "dielectric", "ior": 1.3, "absorption_per_m": 2 });
        let scene = narrow([-0.3 * sin, 0.1 + 0.3 * cos, 0.0], [0.0, 0.1, 0.0], json!({ "glass": glass }), objects);
        let (exact, _) = stack(&layers, sin);
        let scene = with(&scene, "/render/samples_per_pixel", 64);
        let seen = Estimate::over_seeds(&scene, 6, mean_y);
        seen.check(&format!("fifty boundaries at {degrees}°"), exact, 3e-2);
    }
}

/// A screen that reflects so little that nothing comes back from it, and a camera that sees a square of it head on.
/// Returns the scene and the factor from the power that falls on the screen to the mean of the picture.
fn power_meter(height: f64, materials: Value, mut objects: Vec<Value>, lights: Value) -> (Value, f64) {
    let (reflectance, half) = (1e-3, 0.05);
    objects.push(json!({ "material": "screen", "shape": { "type": "quad",
        "origin": [-0.2, height, 0.2], "u": [0.4, 0, 0], "v": [0, 0, -0.4] } }));
    let mut scene = narrow([0.0, height + 0.2, 0.0], [0.0, height, 0.0], materials, objects);
    scene["materials"]["screen"] = json!({ "type": "diffuse", "reflectance": reflectance });
    scene["camera"]["fov_degrees"] = json!(2.0 * math::atan2(half, 0.2).to_degrees());
    scene["lights"] = lights;
    (scene, reflectance / PI / (4.0 * half * half))
}

/// The same by light: what arrives of a laser on a screen below.
#[test]
fn laser_through_fifty_boundaries() {
    let (objects, layers) = panes(0.4);
    let glass = json!({ "type": "dielectric", "ior": 1.3, "absorption_per_m": 2 });
    let laser = json!([{ "type": "beam", "origin": [0, 0.6, 0], "direction": [0, -1, 0], "radius": 0.01, "power": 3 }]);
    let (scene, per_watt) = power_meter(0.0, json!({ "glass": glass }), objects, laser);
    let (through, _) = stack(&layers, 0.0);
    let scene = with(&with(&scene, "/render/integrator", "auto"), "/render/samples_per_pixel", 64);
    Estimate::over_seeds(&scene, 6, mean_y).check("laser, fifty boundaries", 3.0 * through * per_watt, 3e-2);
}

/// From inside a wide slab a lamp above has n² (1 − F) / (1 − F²) of its radiance, the sum over reflections up and down;
/// beyond the critical angle none of it is seen.
#[test]
fn camera_inside() {
    for index in CONTRASTS {
        let critical = math::asin(1.0 / index);
        for (angle, what) in [(0.0, "upright"), (0.97 * critical, "below the critical angle")] {
            let (sin, cos) = (math::sin(angle), math::cos(angle));
            let objects = vec![slab("glass", -0.01, 0.01), plane(0.3, false)];
            let scene = narrow([0.0; 3], [sin, cos, 0.0], json!({ "glass": dielectric(index) }), objects);
            let exact = index * index / (1.0 + fresnel(index * sin, index, 1.0));
            let seen = Estimate::over_seeds(&scene, 6, mean_y);
            seen.check(&format!("from inside {index}, {what}"), exact, 2e-2);
        }
        let beyond = (1.001 * critical).min(0.5 * (critical + 0.5 * PI));
        let to = [math::sin(beyond), math::cos(beyond), 0.0];
        let objects = vec![slab("glass", -0.01, 0.01), plane(0.3, false)];
        let mut dark = narrow([0.0; 3], to, json!({ "glass": dielectric(index) }), objects);
        dark["camera"]["fov_degrees"] = json!(1e-5);
        assert_eq!(
            mean_y(&render_json(&with(&dark, "/render/max_depth", 64)).0),
            0.0,
            "{index}: beyond the critical angle"
        );
    }
}

/// A point light in the middle of a ball of glass: whatever is reflected comes back to the middle, so that at last all of
/// its power leaves, evenly. A spot's light does the same within its cone.
#[test]
fn lights_inside_a_ball() {
    for index in [1.0001, 1.5, 4.0] {
        for (name, light) in [
            ("point", json!({ "type": "point", "position": [0, 0, 0], "intensity": 2 })),
            (
                "spot",
                json!({ "type": "spot", "position": [0, 0, 0], "direction": [0, -1, 0], "intensity": 2,
                             "inner_degrees": 60, "outer_degrees": 61 }),
            ),
        ] {
            let ball =
                json!({ "shape": { "type": "sphere", "center": [0, 0, 0], "radius": 0.05 }, "material": "glass" });
            let materials = json!({ "glass": dielectric(index) });
            let (mut scene, per_watt) = power_meter(-0.3, materials, vec![ball], json!([light]));
            // The camera stands below the ball. A spot that is reflected leaves upwards by every other way out.
            scene["camera"]["from"] = json!([0, -0.1, 0]);
            let f = fresnel(0.0, index, 1.0);
            let share = if name == "point" { 1.0 } else { 1.0 / (1.0 + f) };
            // The solid angle of a square of edge 2 a at a distance d is 4 asin (a² / (a² + d²)).
            let (a2, d2) = (0.05 * 0.05, 0.3 * 0.3);
            let exact = 2.0 * share * 4.0 * math::asin(a2 / (a2 + d2)) * per_watt;
            let scene = with(&with(&scene, "/render/integrator", "auto"), "/render/samples_per_pixel", 256);
            let seen = Estimate::over_seeds(&scene, 6, mean_y);
            seen.check(&format!("{name} in a ball of {index}"), exact, 4e-2);
        }
    }
}

/// A beam that starts in a slab leaves it downwards with 1 / (1 + F) of its power.
#[test]
fn beam_from_inside() {
    for index in CONTRASTS {
        let beam =
            json!([{ "type": "beam", "origin": [0, 0.2, 0], "direction": [0, -1, 0], "radius": 0.01, "power": 3 }]);
        let objects = vec![slab("glass", 0.19, 0.21)];
        let (mut scene, per_watt) = power_meter(0.0, json!({ "glass": dielectric(index) }), objects, beam);
        scene["camera"]["from"] = json!([0, 0.1, 0]);
        scene["camera"]["fov_degrees"] = json!(2.0 * math::atan2(0.05, 0.1).to_degrees());
        let exact = 3.0 * per_watt / (1.0 + fresnel(0.0, index, 1.0));
        let scene = with(&with(&scene, "/render/integrator", "auto"), "/render/samples_per_pixel", 64);
        Estimate::over_seeds(&scene, 6, mean_y).check(&format!("beam in a slab of {index}"), exact, 2e-2);
    }
}

/// A closed room whose walls emit 1 and reflect half has radiance 2 everywhere, whatever glass stands in it: light paths.
#[test]
fn room_with_glass() {
    for index in CONTRASTS {
        let ball = |center: [f64; 3]| json!({ "shape": { "type": "sphere", "center": center, "radius": 0.3 }, "material": "glass" });
        let mut scene = narrow(
            [0.0, 0.9, 0.0],
            [0.0, 2.0, 0.0],
            json!({ "glass": dielectric(index), "wall": { "type": "diffuse", "reflectance": 0.5 } }),
            vec![
                json!({ "shape": { "type": "sphere", "center": [0, 0, 0], "radius": 2 }, "material": "wall",
                        "emission": 1, "emission_two_sided": true }),
                // One alone, and two that overlap.
                ball([-0.9, -0.2, 0.0]),
                ball([0.6, 0.0, 0.0]),
                ball([0.9, 0.2, 0.1]),
            ],
        );
        scene["camera"]["fov_degrees"] = json!(90);
        scene["camera"]["up"] = json!([0, 0, 1]);
        scene["render"] = json!({ "samples_per_pixel": 128, "max_depth": 400, "seed": 0, "integrator": "light" });
        let seen = Estimate::over_seeds(&scene, 6, mean_y);
        seen.check(&format!("room with glass of {index}"), 2.0, 3e-2);
    }
}

/// A furnace around solids in every position that rounding makes doubtful.
fn furnace(materials: Value, objects: Vec<Value>, fov_degrees: f64) -> Value {
    let mut scene = narrow([2.1, 1.7, 2.9], [0.0; 3], materials, objects);
    scene["camera"]["fov_degrees"] = json!(fov_degrees);
    scene["film"] = json!({ "width": 64, "height": 64 });
    scene["render"] = json!({ "samples_per_pixel": 16, "max_depth": 2000, "seed": 0, "integrator": "path" });
    scene["environment"] = json!({ "radiance": 1 });
    scene
}

fn ball(center: [f64; 3], radius: f64, material: &str) -> Value {
    json!({ "shape": { "type": "sphere", "center": center, "radius": radius }, "material": material })
}

/// Balls and cubes of a lattice that touch their neighbours in points, edges and faces; overlapping ones of three glasses;
/// the same ball twice. Nothing of it can be seen in a furnace.
#[test]
fn touching_and_overlapping() {
    let material = |i: usize| ["a", "b", "c"][i % 3];
    let lattice = || (0..27).map(|i| [i % 3, i / 3 % 3, i / 9].map(|k| 0.5 * f64::from(k) - 0.5));
    let balls =
        |radius: f64| -> Vec<Value> { lattice().enumerate().map(|(i, c)| ball(c, radius, material(i))).collect() };
    let cubes = |keep: fn(usize) -> bool| -> Vec<Value> {
        let cube = |(i, c): (usize, [f64; 3])| json!({ "shape": box_shape(c.map(|x| x - 0.25), c.map(|x| x + 0.25)), "material": material(i) });
        lattice().enumerate().filter(|(i, _)| keep(*i)).map(cube).collect()
    };
    let glass =
        |name: &str, priority: i32| json!({ "type": "dielectric", "ior": { "glass": name }, "priority": priority });
    let nested = |i: usize| ball([0.12 * i as f64 - 0.6, 0.0, 0.0], 0.12 * i as f64, material(i));
    let scenes: [(&str, Vec<Value>); 6] = [
        ("touching balls", balls(0.25)),
        ("overlapping balls", balls(0.32)),
        ("cubes that share edges and corners", cubes(|i| i % 2 == 0)),
        ("cubes that share faces", cubes(|_| true)),
        ("the same ball twice", vec![ball([0.0; 3], 0.7, "a"), ball([0.0; 3], 0.7, "b")]),
        ("balls that touch from inside", (1..6).map(nested).collect()),
    ];
    for (name, objects) in scenes {
        for priorities in [[0, 0, 0], [2, 0, 1]] {
            let [a, b, c] = priorities;
            let materials = json!({ "a": glass("SF11", a), "b": glass("N-BK7", b), "c": glass("water", c) });
            let scene = compile_json(&furnace(materials, objects.clone(), 28.0));
            let (film, statistics) = render_counting_underflows(&scene);
            let (underflows, rays) = (statistics.counters.medium_underflows, statistics.counters.rays);
            assert!(underflows <= rays / 1_000_000 + 1, "{name}, {priorities:?}: {underflows} in {rays} rays");
            let picture = film.to_image();
            let image = picture.triples();
            assert!(image.iter().flatten().all(|v| v.is_finite() && *v >= 0.0), "{name}");
            println!("{name}, priorities {priorities:?}: {:.5}", mean_y(&film));
            assert!((mean_y(&film) - 1.0).abs() < 5e-3, "{name}, {priorities:?}: {}", mean_y(&film));
        }
    }
}

/// X + Y + Z of a spectrum given as lines, nm and area.
fn lines_xyz(lines: &[(f64, f64)]) -> f64 {
    let observer = Observer::cie_1931_2deg();
    lines.iter().map(|(nm, area)| area * observer.eval(*nm).element_sum()).sum::<f64>() / observer.y_integral()
}

/// Sodium's two lines, as narrow triangles, and the same for a laser.
fn triangles(lines: &[(f64, f64)]) -> Value {
    let width = 0.01;
    let knots: Vec<f64> = lines.iter().flat_map(|(nm, _)| [nm - width, *nm, nm + width]).collect();
    let values: Vec<f64> = lines.iter().flat_map(|(_, area)| [0.0, area / width, 0.0]).collect();
    json!({ "wavelengths_nm": knots, "values": values })
}

/// A ball of dense flint in a furnace of one or two lines is as bright as they are; so is the light of three lasers through
/// a pane, less what the pane keeps back of each.
#[test]
fn line_spectra() {
    let sodium = [(588.995, 2.0), (589.592, 1.0)];
    let flint = json!({ "glass": { "type": "dielectric", "ior": { "glass": "SF11" } } });
    for (name, lines) in
        [("sodium", &sodium[..]), ("laser", &[(632.8, 1.0)]), ("far ends", &[(400.0, 1.0), (720.0, 1.0)])]
    {
        let mut scene = furnace(flint.clone(), vec![ball([0.0; 3], 1.0, "glass")], 20.0);
        scene["film"] = json!({ "width": 16, "height": 16 });
        scene["environment"]["radiance"] = triangles(lines);
        let seen = Estimate::over_seeds(&scene, 6, mean_xyz_sum);
        seen.check(&format!("flint in a furnace of {name}"), lines_xyz(lines), 1e-2);
    }
    let lasers = [(457.9, 2.0), (532.0, 1.0), (632.8, 3.0)];
    let beam = |(nm, watts): (f64, f64)| {
        json!({ "type": "beam", "origin": [0, 0.4, 0], "direction": [0, -1, 0], "radius": 0.01,
                "power": { "line_nm": nm, "fwhm_nm": 0.001, "scale": watts } })
    };
    let (scene, per_watt) = power_meter(0.0, flint, vec![slab("glass", 0.3, 0.31)], lasers.map(beam).into());
    let n = abbe::io::catalogue::glass("SF11").unwrap().constants().unwrap().n;
    let through = lasers.map(|(nm, watts)| {
        let pane = Layer { index: n.eval(nm), thickness: 0.01, absorption: 0.0 };
        (nm, watts * stack(&[pane], 0.0).0)
    });
    let scene = with(&with(&scene, "/render/integrator", "auto"), "/render/samples_per_pixel", 256);
    Estimate::over_seeds(&scene, 6, mean_xyz_sum).check("three lasers", lines_xyz(&through) * per_watt, 1e-2);
}

/// Light that meets the second face of a wedge at the critical angle of 550 nm: what is longer gets through, more and more,
/// what is shorter does not. Three wedges: at that angle, and where all or none of the spectrum gets through.
#[test]
fn wedge_at_the_critical_angle() {
    let n = abbe::io::catalogue::glass("F2").unwrap().constants().unwrap().n;
    let critical = |nm: f64| math::asin(1.0 / n.eval(nm));
    let observer = Observer::cie_1931_2deg();
    for (name, apex) in [("at 550 nm", critical(550.0)), ("at 620 nm", critical(620.0)), ("at 365 nm", critical(365.0))]
    {
        // The apex lies towards +x: the first face's normal is half the angle away from +z, which the camera looks along.
        let half = 0.5 * apex;
        let normal = [math::sin(half), 0.0, math::cos(half)];
        let (side, height) = (0.1, 0.1 * math::cos(half));
        let middle = [height / 6.0, 0.001, 0.5 * side * math::sin(half)];
        let from: [f64; 3] = std::array::from_fn(|c| middle[c] + 0.1 * normal[c]);
        // Light leaves by the second face, along it and towards the base. There stands a lamp that catches all of it.
        let lamp = [-math::cos(half + 0.1), 0.0, -math::sin(half + 0.1)].map(|x| 0.7 * x);
        let lamp = json!({ "emission": 1, "shape": { "type": "sphere", "center": lamp, "radius": 0.35 } });
        let mut scene = narrow(
            from,
            middle,
            json!({ "glass": { "type": "dielectric", "ior": { "glass": "F2" } } }),
            vec![
                json!({ "shape": { "type": "prism", "apex_degrees": apex.to_degrees(), "side": side, "length": 0.1 },
                        "material": "glass" }),
                lamp,
            ],
        );
        scene["camera"]["up"] = json!([0, 1, 0]);
        scene["camera"]["fov_degrees"] = json!(1e-5);
        scene["render"]["max_depth"] = json!(2);
        scene["render"]["samples_per_pixel"] = json!(1024);
        let step = 0.05;
        let exact: f64 = (0..(470.0 / step) as u32)
            .map(|i| 360.0 + (f64::from(i) + 0.5) * step)
            .map(|nm| {
                let index = n.eval(nm);
                let (into, out) = (fresnel(0.0, 1.0, index), fresnel(index * math::sin(apex), index, 1.0));
                (1.0 - into) * (1.0 - out) * observer.eval(nm).element_sum() * step / observer.y_integral()
            })
            .sum();
        Estimate::over_seeds(&scene, 6, mean_xyz_sum).check(&format!("wedge, critical {name}"), exact, 2.5e-2);
    }
}

/// Wedges so thin that nothing of them can be seen, and light that grazes: nothing is lost in a furnace.
#[test]
fn thin_wedges_and_grazing_light() {
    let glass = |index: f64| json!({ "a": dielectric(index) });
    for index in CONTRASTS {
        for apex in [1e-3, 0.1, 179.0] {
            let wedge =
                json!({ "shape": { "type": "prism", "apex_degrees": apex, "side": 1, "length": 1 }, "material": "a" });
            let film = render_json(&furnace(glass(index), vec![wedge], 12.0)).0;
            assert!((mean_y(&film) - 1.0).abs() < 5e-3, "{index}, {apex}°: {}", mean_y(&film));
        }
        let mut grazing = furnace(glass(index), vec![slab("a", -0.1, 0.0)], 1e-3);
        grazing["camera"]["from"] = json!([-10, 0.01, 0]);
        grazing["film"] = json!({ "width": 16, "height": 16 });
        let film = render_json(&grazing).0;
        assert!((mean_y(&film) - 1.0).abs() < 5e-3, "{index}, grazing: {}", mean_y(&film));
    }
}
