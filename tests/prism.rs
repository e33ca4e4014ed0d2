//! Prisms: the deviation of every Fraunhofer line, and where a beam's lines land on a screen.

#[path = "common/render.rs"]
mod common;
#[path = "common/trace.rs"]
mod trace;

use abbe::math;
use abbe::optics::ior::IndexOfRefraction;
use common::{compile_json, render_json, with};
use glam::DVec3;
use serde_json::{Value, json};
use trace::{Event, Tracer};

const APEX: f64 = 60.0;
/// C, d, F, g and h; nm.
const LINES: [f64; 5] = [656.2725, 587.5618, 486.1327, 435.8343, 404.6561];

fn index(glass: &str) -> IndexOfRefraction {
    abbe::io::catalogue::glass(glass).unwrap().constants().unwrap().n
}

/// δ = i + asin(sin α √(n² − sin² i) − cos α sin i) − α.
fn deviation(n: f64, i: f64) -> f64 {
    let alpha = APEX.to_radians();
    let (sin_i, root) = (math::sin(i), (n * n - math::sin(i) * math::sin(i)).sqrt());
    i + math::asin(math::sin(alpha) * root - math::cos(alpha) * sin_i) - alpha
}

/// Direction of light that meets the prism's face towards +z at this angle, on the side of its normal towards the base.
fn incident(i: f64) -> DVec3 {
    let half = 0.5 * APEX.to_radians();
    let normal = DVec3::new(math::sin(half), 0.0, math::cos(half));
    let along = DVec3::new(math::cos(half), 0.0, -math::sin(half));
    along * math::sin(i) - normal * math::cos(i)
}

/// A prism, and a camera that looks along the light at the middle of its face.
fn scene(glass: &str, i: f64) -> Value {
    let half = 0.5 * APEX.to_radians();
    let side = 0.1;
    // The middle of the face: half way from the apex at 2/3 of the height to the corner of the base.
    let height = side * math::cos(half);
    let middle = DVec3::new((2.0 / 3.0 - 0.5) * height, 0.003, 0.5 * side * math::sin(half));
    let from = middle - incident(i) * 0.3;
    json!({
        "camera": { "type": "perspective", "from": from.to_array(), "to": middle.to_array(), "fov_degrees": 1 },
        "film": { "width": 2, "height": 2 },
        "materials": { "glass": { "type": "dielectric", "ior": { "glass": glass } } },
        "objects": [{ "shape": { "type": "prism", "apex_degrees": APEX, "side": side, "length": 0.1 }, "material": "glass" }],
        "environment": { "radiance": 1 }
    })
}

/// Direction in which the camera's middle ray leaves the prism of a scene, refracted at one wavelength.
fn refracted(scene: &Value, lambda: f64) -> DVec3 {
    let [from, to] = ["from", "to"].map(|key| {
        let point: [f64; 3] = serde_json::from_value(scene["camera"][key].clone()).unwrap();
        DVec3::from(point)
    });
    let compiled = compile_json(scene);
    let tracer = Tracer::new(&compiled, scene);
    tracer.trace(from, (to - from).normalize(), lambda, &[Event::Refract; 2]).direction
}

fn angle(a: DVec3, b: DVec3) -> f64 {
    math::atan2(a.cross(b).length(), a.dot(b))
}

#[test]
fn deviation_of_every_line() {
    for (glass, angles) in [("SF11", [60.0, 62.0, 63.2, 68.0, 76.0f64]), ("N-BK7", [38.0, 45.0, 49.3, 57.0, 72.0])] {
        for degrees in angles {
            let i = degrees.to_radians();
            let scene = scene(glass, i);
            let mut last = 0.0;
            for lambda in LINES {
                let n = index(glass).eval(lambda);
                let exact = deviation(n, i);
                let out = refracted(&scene, lambda);
                let seen = angle(incident(i), out);
                assert!((seen - exact).abs() < 1e-5, "{glass} {degrees}° {lambda} nm: {seen} rad, exact {exact}");
                assert!(out.x < incident(i).x, "towards the base");
                assert!(seen > last + 1e-3, "{glass}: shorter waves deviate more");
                last = seen;
            }
        }
    }
}

/// sin ((α + δ) / 2) = n sin (α / 2) at the least deviation; to either side there is more.
#[test]
fn minimum_deviation() {
    for glass in ["SF11", "N-BK7"] {
        for lambda in LINES {
            let n = index(glass).eval(lambda);
            let half = 0.5 * APEX.to_radians();
            let i = math::asin(n * math::sin(half));
            let least = 2.0 * i - 2.0 * half;
            let seen = |i: f64| angle(incident(i), refracted(&scene(glass, i), lambda));
            assert!((seen(i) - least).abs() < 1e-5, "{glass} {lambda}: {} {least}", seen(i));
            for off in [-0.02, 0.02] {
                assert!(seen(i + off) > seen(i) + 1e-5, "{glass} {lambda}: not the least");
            }
        }
    }
}

/// Point on the screen (the plane through `screen` facing `−axis`) that the middle of the beam reaches, by Snell's law in
/// the plane of the prism's section.
fn landing(n: f64, start: DVec3, i: f64, screen: DVec3, axis: DVec3) -> DVec3 {
    let half = 0.5 * APEX.to_radians();
    let apex = DVec3::new(2.0 / 3.0 * 0.1 * math::cos(half), 0.0, 0.0);
    let normals =
        [DVec3::new(math::sin(half), 0.0, math::cos(half)), DVec3::new(math::sin(half), 0.0, -math::cos(half))];
    let meet = |o: DVec3, d: DVec3, p: DVec3, n: DVec3| o + d * ((p - o).dot(n) / d.dot(n));
    let bend = |d: DVec3, n: DVec3, ratio: f64| {
        // The part along the face is scaled by the ratio of indices, the rest follows from the length.
        let along = (d - n * d.dot(n)) * ratio;
        along + n * (1.0 - along.length_squared()).sqrt()
    };
    let d = incident(i);
    let entry = meet(start, d, apex, normals[0]);
    let inside = bend(d, -normals[0], 1.0 / n);
    let exit = meet(entry, inside, apex, normals[1]);
    meet(exit, bend(inside, normals[1], n), screen, axis)
}

/// A beam in two lines through a prism onto a screen: each lands within a pixel of where it should, blue beyond red.
#[test]
fn lines_on_a_screen() {
    let (i, glass) = (60f64.to_radians(), "SF11");
    let base = scene(glass, i);
    let start: DVec3 = serde_json::from_value::<[f64; 3]>(base["camera"]["from"].clone()).unwrap().into();
    // The screen faces the d line half a metre away.
    let out = refracted(&base, 587.5618);
    let center = out * 0.5;
    let right = out.cross(DVec3::Y);
    let corner = center - right * 0.2 - DVec3::Y * 0.2;
    let (width, half) = (400, 20f64.to_radians());
    // The camera is above the light, and sees the screen head on.
    let camera = center - out * 0.35 + DVec3::Y * 0.1;
    let mut scene = with(&base, "/camera/from", json!(camera.to_array()));
    scene["camera"]["to"] = json!((camera + out).to_array());
    scene["camera"]["fov_degrees"] = json!(2.0 * half.to_degrees());
    scene["film"] = json!({ "width": width, "height": width });
    scene["render"] = json!({ "samples_per_pixel": 1, "max_depth": 8, "integrator": "light" });
    scene["materials"]["screen"] = json!({ "type": "diffuse", "reflectance": 0.8 });
    scene["objects"].as_array_mut().unwrap().push(json!({ "material": "screen", "shape": { "type": "quad",
        "origin": corner.to_array(), "u": (right * 0.4).to_array(), "v": [0, 0.4, 0] } }));
    scene.as_object_mut().unwrap().remove("environment");
    let mut last = f64::NEG_INFINITY;
    for lambda in [656.2725, 587.5618, 486.1327, 435.8343] {
        let mut scene = scene.clone();
        scene["lights"] = json!([{ "type": "beam", "origin": start.to_array(), "direction": incident(i).to_array(),
            "radius": 0.0005, "power": { "line_nm": lambda, "fwhm_nm": 0.1 } }]);
        for integrator in ["light", "auto"] {
            let (film, _) = render_json(&with(&scene, "/render/integrator", integrator));
            let to = landing(index(glass).eval(lambda), start, i, center, out) - camera;
            let pixels = 0.5 * width as f64 / math::tan(half) / to.dot(out);
            let expected = [0.5 * width as f64 + to.dot(right) * pixels, 0.5 * width as f64 - to.y * pixels];
            // The centre of the spot, without the glow of light that the screen sends back to the prism.
            let (mut sum, mut x, mut y, mut all) = (0.0, 0.0, 0.0, 0.0);
            for (pixel, xyz) in film.to_image().triples().iter().enumerate() {
                let at = [pixel % width, pixel / width].map(|p| p as f64 + 0.5);
                all += xyz[1];
                if (at[0] - expected[0]).abs() < 8.0 && (at[1] - expected[1]).abs() < 8.0 {
                    sum += xyz[1];
                    x += xyz[1] * at[0];
                    y += xyz[1] * at[1];
                }
            }
            assert!(sum > 0.9 * all && sum > 0.0, "{lambda} nm: {sum} of {all} is where it should be");
            let (dx, dy) = (x / sum - expected[0], y / sum - expected[1]);
            println!("{lambda} nm, {integrator}: off by {dx:.3}, {dy:.3} pixels from {expected:?}");
            assert!(dx.abs() < 1.0 && dy.abs() < 1.0, "{lambda} nm, {integrator}: off by {dx}, {dy} pixels");
            // The base lies at −x.
            let towards_base = -(x / sum - 0.5 * width as f64) * right.x.signum();
            if integrator == "light" {
                assert!(towards_base > last + 2.0, "{lambda} nm is not beyond the last line");
                last = towards_base;
            }
        }
    }
}
