//! Rainbows: where a ball of water sends parallel light after one and after two reflections inside, at four lines of the
//! spectrum, ray by ray and as a picture on a screen.
//!
//! A ray that meets the ball at angle i is refracted at r with sin i = n sin r, and after k reflections has been turned by
//! k π + 2 i − 2 (k + 1) r, which is least at cos² i = (n² − 1) / (k (k + 2)). Seen from the ball, the bow's
//! edge lies at 4 r − 2 i from the point opposite to the light for k = 1, with everything inside of it; and at
//! π + 2 i − 6 r for k = 2, with everything outside of it.

#[path = "common/render.rs"]
mod common;
#[path = "common/trace.rs"]
mod trace;

use abbe::math;
use common::{compile_json, render_json, with};
use glam::DVec3;
use serde_json::{Value, json};
use std::f64::consts::PI;
use trace::{Event, Tracer};

/// C, d, F and h; nm.
const LINES: [f64; 4] = [656.2725, 587.5618, 486.1327, 404.6561];
/// Largest error of an edge, degrees.
const TOLERANCE: f64 = 0.1;

fn water(lambda_nm: f64) -> f64 {
    abbe::io::catalogue::glass("water").unwrap().constants().unwrap().n.eval(lambda_nm)
}

/// Angles of incidence and refraction of the ray that is turned least after k reflections.
fn rainbow_ray(n: f64, k: f64) -> (f64, f64) {
    let i = math::acos(((n * n - 1.0) / (k * (k + 2.0))).sqrt());
    (i, math::asin(math::sin(i) / n))
}

/// Angle of the edge of the bow with k = 1 or 2 reflections from the point opposite to the light.
fn edge(n: f64, k: usize) -> f64 {
    let (i, r) = rainbow_ray(n, k as f64);
    if k == 1 { 4.0 * r - 2.0 * i } else { PI + 2.0 * i - 6.0 * r }
}

/// The textbooks' 42° and 51° are those of n = 4/3.
#[test]
fn the_closed_form_is_the_textbooks() {
    let degrees = |n: f64, k: usize| edge(n, k).to_degrees();
    assert!((degrees(4.0 / 3.0, 1) - 42.03).abs() < 0.01, "{}", degrees(4.0 / 3.0, 1));
    assert!((degrees(4.0 / 3.0, 2) - 50.98).abs() < 0.01, "{}", degrees(4.0 / 3.0, 2));
    assert!((water(587.5618) - 1.3334).abs() < 1e-4);
}

/// A ball of water of radius 1 at the origin and light that travels along +z.
fn ball() -> Value {
    json!({
        "camera": { "type": "perspective", "from": [0, 0, -3], "to": [0, 0, 0] },
        "film": { "width": 4, "height": 4 },
        "materials": { "water": { "type": "dielectric", "ior": { "glass": "water" } } },
        "objects": [{ "shape": { "type": "sphere", "center": [0, 0, 0], "radius": 1 }, "material": "water" }],
        "environment": { "radiance": 1 }
    })
}

/// The least of f over [a, b], where it has one minimum, by golden sections.
fn minimum(mut a: f64, mut b: f64, f: impl Fn(f64) -> f64) -> f64 {
    let ratio = 0.5 * (5f64.sqrt() - 1.0);
    while b - a > 1e-4 {
        let (c, d) = (b - ratio * (b - a), a + ratio * (b - a));
        if f(c) < f(d) { b = d } else { a = c }
    }
    f(0.5 * (a + b))
}

/// Rays traced through the compiled ball turn back no less than the closed form says, at every line.
#[test]
fn edges_of_traced_rays() {
    let file = ball();
    let compiled = compile_json(&file);
    let tracer = Tracer::new(&compiled, &file);
    for azimuth in [0.0, 1.1] {
        let across = DVec3::new(math::cos(azimuth), math::sin(azimuth), 0.0);
        let mut last = [f64::NEG_INFINITY; 2];
        for lambda in LINES {
            let n = water(lambda);
            for (k, events) in [
                (1, &[Event::Refract, Event::Reflect, Event::Refract][..]),
                (2, &[Event::Refract, Event::Reflect, Event::Reflect, Event::Refract][..]),
            ] {
                // Angle from the point opposite to the light, counted from the side that the ray came in by.
                let angle = |b: f64| {
                    let out = tracer.trace(across * b - DVec3::Z * 2.0, DVec3::Z, lambda, events).direction;
                    math::atan2(out.dot(across), -out.z)
                };
                // Once reflected, light comes back on the other side, at most this far; twice, on the same, at least.
                let seen = minimum(0.6, 0.999, angle);
                let exact = if k == 1 { -edge(n, 1) } else { edge(n, 2) };
                let off = (seen - exact).to_degrees();
                println!("{lambda} nm, k = {k}: {:.4}°, exact {:.4}°", seen.to_degrees(), exact.to_degrees());
                assert!(off.abs() < 0.01 * TOLERANCE, "{lambda} nm, k = {k}: off by {off}°");
                assert!(
                    seen > last[k - 1] + 0.2f64.to_radians(),
                    "red is outermost in the first bow, innermost in the second"
                );
                last[k - 1] = seen;
            }
        }
    }
}

/// Distance of the screen, in radii of the ball.
const SCREEN: f64 = 1000.0;
/// Film, pixels, and what it shows of the screen about the middle of a bow's edge: angles at the ball, degrees.
const SIZE: [usize; 2] = [256, 384];
const VIEW: [[f64; 2]; 2] = [[39.5, 44.0], [48.5, 54.5]];

/// The screen and a narrow beam that falls onto the ball where the rays of both bows do. The camera sees, head on, the
/// part of the screen about the edge of bow k.
fn picture(k: usize, power: Value, samples: u64) -> Value {
    let [near, far] = VIEW[k - 1].map(|degrees| SCREEN * math::tan(degrees.to_radians()));
    let side = if k == 1 { -1.0 } else { 1.0 };
    let (x, distance) = (side * 0.5 * (near + far), 0.5 * SCREEN);
    let mut scene = with(&ball(), "/camera/from", json!([x, 0, distance - SCREEN]));
    scene["camera"]["to"] = json!([x, 0, -SCREEN]);
    scene["camera"]["fov_degrees"] = json!(2.0 * math::atan2(0.5 * (far - near), distance).to_degrees());
    scene["film"] = json!({ "width": SIZE[0], "height": SIZE[1] });
    // The bow with two reflections takes five events: in, twice reflected, out, and the screen.
    scene["render"] = json!({ "samples_per_pixel": samples, "max_depth": 5, "integrator": "light" });
    scene["materials"]["screen"] = json!({ "type": "diffuse", "reflectance": 0.8 });
    scene["objects"].as_array_mut().unwrap().push(json!({ "material": "screen", "shape": { "type": "quad",
        "origin": [-2.0 * SCREEN, -2.0 * SCREEN, -SCREEN], "u": [4.0 * SCREEN, 0, 0], "v": [0, 4.0 * SCREEN, 0] } }));
    scene["lights"] =
        json!([{ "type": "beam", "origin": [0.86, 0, -2], "direction": [0, 0, 1], "radius": 0.14, "power": power }]);
    scene.as_object_mut().unwrap().remove("environment");
    scene
}

/// Mean XYZ over rings of the screen, by their distance from the axis.
struct Profile {
    rings: Vec<[f64; 3]>,
    width: f64,
    nearest: f64,
}

impl Profile {
    fn of(k: usize, power: Value, samples: u64) -> Self {
        let [near, far] = VIEW[k - 1].map(|degrees| SCREEN * math::tan(degrees.to_radians()));
        let side = if k == 1 { -1.0 } else { 1.0 };
        let (film, _) = render_json(&picture(k, power, samples));
        let pixel = (far - near) / SIZE[0] as f64;
        let mut sums = vec![([0.0; 3], 0.0); SIZE[0]];
        for (index, xyz) in film.to_image().triples().iter().enumerate() {
            // The camera looks along −z with +y up, so that +x is to the right.
            let [column, row] = [index % SIZE[0], index / SIZE[0]].map(|i| i as f64 + 0.5);
            let x = side * near.midpoint(far) + (column - 0.5 * SIZE[0] as f64) * pixel;
            let radius = x.hypot((row - 0.5 * SIZE[1] as f64) * pixel);
            let ring = ((radius - near) / pixel) as usize;
            if let Some((sum, count)) = sums.get_mut(ring) {
                (0..3).for_each(|c| sum[c] += xyz[c]);
                *count += 1.0;
            }
        }
        let rings = sums.iter().map(|(sum, count)| sum.map(|v| v / f64::max(*count, 1.0))).collect();
        Self { rings, width: pixel, nearest: near }
    }

    /// Radius of the edge in a channel: where the brightness, from its dark side on, first exceeds half of its peak.
    fn edge(&self, k: usize, channel: usize) -> f64 {
        let peak = self.rings.iter().map(|r| r[channel]).fold(0.0, f64::max);
        let bright = |r: &[f64; 3]| r[channel] > 0.5 * peak;
        let ring = if k == 1 { self.rings.iter().rposition(bright) } else { self.rings.iter().position(bright) };
        self.nearest + self.width * (ring.unwrap() as f64 + 0.5)
    }

    /// Mean of a channel between two angles at the ball, degrees.
    fn mean(&self, degrees: [f64; 2], channel: usize) -> f64 {
        let [from, to] = degrees.map(|a| ((SCREEN * math::tan(a.to_radians()) - self.nearest) / self.width) as usize);
        self.rings[from..to].iter().map(|r| r[channel]).sum::<f64>() / (to - from) as f64
    }
}

/// Angle of an edge on the screen: the ray leaves the ball sin i off its centre, on the outer side for k = 1, on the inner
/// for k = 2.
fn angle_on_screen(radius: f64, n: f64, k: usize) -> f64 {
    let off = math::sin(rainbow_ray(n, k as f64).0) / math::cos(edge(n, k));
    math::atan2(radius + if k == 1 { -off } else { off }, SCREEN)
}

#[test]
fn edges_on_a_screen() {
    for k in [1, 2] {
        for lambda in LINES {
            let profile = Profile::of(k, json!({ "line_nm": lambda, "fwhm_nm": 0.1 }), [2, 6][k - 1]);
            let n = water(lambda);
            let (seen, exact) = (angle_on_screen(profile.edge(k, 1), n, k).to_degrees(), edge(n, k).to_degrees());
            println!("{lambda} nm, k = {k}: {seen:.3}°, exact {exact:.3}°");
            assert!((seen - exact).abs() < TOLERANCE, "{lambda} nm, k = {k}: {seen}°, expected {exact}°");
        }
    }
}

/// In white light the edges of red, green and blue follow each other, red outermost in the first bow and innermost in the
/// second; between them lies Alexander's dark band.
#[test]
fn order_of_colors() {
    let [first, second] = [(1, 4), (2, 12)].map(|(k, samples)| Profile::of(k, json!({ "illuminant": "D65" }), samples));
    let edges = [(&first, 1), (&second, 2)]
        .map(|(profile, k)| [0, 1, 2].map(|channel| math::atan2(profile.edge(k, channel), SCREEN).to_degrees()));
    println!("edges of X, Y, Z: {edges:.2?}");
    let [[x1, y1, z1], [x2, y2, z2]] = edges;
    assert!(x1 > y1 + 0.05 && y1 > z1 + 0.2, "the first bow is red outside: {:?}", edges[0]);
    assert!(x2 < y2 - 0.05 && y2 < z2 - 0.2, "the second bow is red inside: {:?}", edges[1]);
    let dark = first.mean([42.8, 43.9], 1).max(second.mean([48.6, 49.8], 1));
    let bright = [first.mean([40.5, 42.0], 1), second.mean([51.0, 53.0], 1)];
    println!("dark {dark:.1e}, bright {bright:?}");
    assert!(bright[1] > 0.0 && bright[0] > 5.0 * bright[1], "the second bow is the fainter one");
    assert!(dark < 1e-3 * bright[1], "no light between the bows");
}
