//! Lenses: focal lengths at every Fraunhofer line against the lensmaker's equation, and an achromat against a singlet.
//!
//! Focal lengths come from rays close to the axis, traced through the compiled scene. Where they have to agree with closed
//! forms to 0.1 % they agree to 0.02 %.

#[path = "common/render.rs"]
mod common;
#[path = "common/trace.rs"]
mod trace;

use abbe::math;
use abbe::optics::ior::{FRAUNHOFER_LINES, IndexOfRefraction};
use common::{compile_json, render_json, with};
use glam::DVec3;
use serde_json::{Value, json};
use trace::{Event, Tracer};

const C: f64 = 656.2725;
const D: f64 = 587.5618;
const F: f64 = 486.1327;

/// Relative error of a focal length.
const TOLERANCE: f64 = 2e-4;

fn glass(name: &str) -> IndexOfRefraction {
    abbe::io::catalogue::glass(name).unwrap().constants().unwrap().n
}

/// V = (n_d − 1) / (n_F − n_C).
fn abbe_number(n: &IndexOfRefraction) -> f64 {
    (n.eval(D) - 1.0) / (n.eval(F) - n.eval(C))
}

fn lines() -> impl Iterator<Item = (&'static str, f64)> {
    FRAUNHOFER_LINES.into_iter().filter(|(_, nm)| (360.0..=830.0).contains(nm))
}

/// Focal length, and distance of the focus from the last vertex, metres.
#[derive(Debug, Clone, Copy)]
struct Focus {
    length: f64,
    back: f64,
}

/// Of parallel light along +z at a height so small that aberrations do not show, through glass whose last vertex is at z.
fn traced(tracer: &Tracer, height: f64, lambda: f64, events: &[Event], last_vertex: f64) -> Focus {
    let out = tracer.trace(DVec3::new(0.0, height, -0.2), DVec3::Z, lambda, events);
    let slope = -out.direction.y / out.direction.z;
    Focus { length: height / slope, back: out.point.z + out.point.y / slope - last_vertex }
}

/// A scene of glass alone.
fn of_glass(materials: Value, objects: Value) -> Value {
    json!({
        "camera": { "type": "perspective", "from": [0, 0, -0.25], "to": [0, 0, 0] },
        "film": { "width": 4, "height": 4 },
        "materials": materials,
        "objects": objects,
        "environment": { "radiance": 1 }
    })
}

/// Biconvex, of unequal faces, plano-convex both ways round, both meniscuses, and concave ones: radii in metres, positive
/// when convex.
const SINGLETS: [([Option<f64>; 2], f64); 8] = [
    ([Some(0.1), Some(0.1)], 0.006),
    ([Some(0.06), Some(0.25)], 0.01),
    ([Some(0.05), None], 0.008),
    ([None, Some(0.05)], 0.008),
    ([Some(0.04), Some(-0.09)], 0.007),
    ([Some(-0.05), Some(0.11)], 0.007),
    ([Some(-0.08), Some(-0.12)], 0.003),
    ([None, Some(-0.07)], 0.002),
];

/// 1 / f = (n − 1) (1/R₁ − 1/R₂ + (n − 1) d / (n R₁ R₂)), with R₂ negative where the second face is convex; the focus is
/// f (1 − (n − 1) d / (n R₁)) behind the second vertex.
fn lensmaker(n: f64, radii: [Option<f64>; 2], d: f64) -> Focus {
    let curvature = [radii[0].map_or(0.0, |r| 1.0 / r), radii[1].map_or(0.0, |r| -1.0 / r)];
    let power = (n - 1.0) * (curvature[0] - curvature[1] + (n - 1.0) * d / n * curvature[0] * curvature[1]);
    Focus { length: 1.0 / power, back: (1.0 - (n - 1.0) * d / n * curvature[0]) / power }
}

#[test]
fn focal_lengths_of_singlets() {
    let mut worst = 0.0f64;
    for name in ["N-BK7", "SF11", "fused-silica", "water"] {
        let n = glass(name);
        for (radii, thickness) in SINGLETS {
            let file = of_glass(
                json!({ "glass": { "type": "dielectric", "ior": { "glass": name } } }),
                json!([{ "shape": { "type": "lens", "radii": radii, "thickness": thickness, "diameter": 0.02 },
                         "material": "glass" }]),
            );
            let compiled = compile_json(&file);
            let tracer = Tracer::new(&compiled, &file);
            for (line, lambda) in lines() {
                let exact = lensmaker(n.eval(lambda), radii, thickness);
                let height = 0.002 * exact.length.abs();
                let seen = traced(&tracer, height, lambda, &[Event::Refract; 2], 0.5 * thickness);
                let off = [seen.length / exact.length - 1.0, (seen.back - exact.back) / exact.length];
                worst = worst.max(off[0].abs()).max(off[1].abs());
                assert!(off.iter().all(|o| o.abs() < TOLERANCE), "{name} {radii:?} {line}: {seen:?}, {exact:?}");
            }
            // 1 / V is the spread of a thin lens; thickness changes little.
            let [f_c, f_d, f_f] =
                [C, D, F].map(|lambda| traced(&tracer, 2e-4, lambda, &[Event::Refract; 2], 0.5 * thickness).length);
            let spread = (f_c - f_f) / f_d * abbe_number(&n);
            assert!((spread - 1.0).abs() < 0.06, "{name} {radii:?}: {spread} of 1 / V");
        }
    }
    println!("singlets: worst {worst:.1e}");
}

const CROWN: &str = "N-BK7";
const FLINT: &str = "SF5";
const FOCAL_LENGTH: f64 = 0.2;
const DIAMETER: f64 = 0.03;
const CROWN_THICKNESS: f64 = 0.007;
const FLINT_THICKNESS: f64 = 0.003;

/// A cemented doublet by its three curvatures, 1/m, positive where the centre lies behind the surface.
#[derive(Debug, Clone, Copy)]
struct Doublet {
    curvature: [f64; 3],
}

impl Doublet {
    /// Thin lenses with φ₁ + φ₂ = 1 / f and φ₁ / V₁ + φ₂ / V₂ = 0, the crown with equal faces.
    fn thin() -> Self {
        let (crown, flint) = (glass(CROWN), glass(FLINT));
        let (v1, v2) = (abbe_number(&crown), abbe_number(&flint));
        let [power1, power2] = [v1 / (v1 - v2), -v2 / (v1 - v2)].map(|share| share / FOCAL_LENGTH);
        let first = 0.5 * power1 / (crown.eval(D) - 1.0);
        Self { curvature: [first, -first, -first - power2 / (flint.eval(D) - 1.0)] }
    }

    /// The same with the last curvature changed until, with its true thicknesses, C and F have one focus.
    fn thick() -> Self {
        let thin = Self::thin();
        let with_last = |last: f64| Self { curvature: [thin.curvature[0], thin.curvature[1], last] };
        let apart = |last: f64| with_last(last).paraxial(F).back - with_last(last).paraxial(C).back;
        let (mut a, mut b) = (thin.curvature[2], thin.curvature[2] * 1.01);
        for _ in 0..20 {
            let step = apart(b) * (b - a) / (apart(b) - apart(a));
            (a, b) = (b, b - step);
            if step.abs() < 1e-12 * b.abs() {
                break;
            }
        }
        with_last(b)
    }

    /// Gauss's optics: n u changes by −h φ at a surface, h by u d between two.
    fn paraxial(&self, lambda: f64) -> Focus {
        let n = [1.0, glass(CROWN).eval(lambda), glass(FLINT).eval(lambda), 1.0];
        let distance = [CROWN_THICKNESS, FLINT_THICKNESS, 0.0];
        let (mut height, mut bent) = (1.0, 0.0);
        for surface in 0..3 {
            bent -= height * (n[surface + 1] - n[surface]) * self.curvature[surface];
            height += bent / n[surface + 1] * distance[surface];
        }
        Focus { length: -1.0 / bent, back: -height / bent }
    }

    /// The scene. The cemented faces either coincide, or the flint reaches into the crown, which
    /// wins by its priority; then its own first face does not matter, and is flat. The crown's centre is the origin.
    fn scene(&self, in_contact: bool) -> Value {
        let [first, second, last] = self.curvature.map(|c| 1.0 / c);
        let (front, start) = if in_contact { (json!(second), 0.5 * CROWN_THICKNESS) } else { (Value::Null, 0.0) };
        let end = 0.5 * CROWN_THICKNESS + FLINT_THICKNESS;
        let lens = |radii: Value, thickness: f64| json!({ "type": "lens", "radii": radii, "thickness": thickness, "diameter": DIAMETER });
        of_glass(
            json!({ "crown": { "type": "dielectric", "ior": { "glass": CROWN }, "priority": if in_contact { 0 } else { 1 } },
                    "flint": { "type": "dielectric", "ior": { "glass": FLINT } } }),
            json!([
                { "shape": lens(json!([first, -second]), CROWN_THICKNESS), "material": "crown" },
                { "shape": lens(json!([front, -last]), end - start), "material": "flint",
                  "transform": [{ "translate": [0, 0, 0.5 * (start + end)] }] }
            ]),
        )
    }
}

/// C and F meet in one point, and the rest of the spectrum within a twentieth of the spread of a singlet.
#[test]
fn achromat() {
    let events = [Event::Refract; 3];
    let last_vertex = 0.5 * CROWN_THICKNESS + FLINT_THICKNESS;
    let height = 0.002 * FOCAL_LENGTH;
    for (name, doublet) in [("thin", Doublet::thin()), ("thick", Doublet::thick())] {
        let file = doublet.scene(false);
        let compiled = compile_json(&file);
        let tracer = Tracer::new(&compiled, &file);
        let of_line = |lambda: f64| traced(&tracer, height, lambda, &events, last_vertex);
        for (line, lambda) in lines() {
            let (seen, exact) = (of_line(lambda), doublet.paraxial(lambda));
            let off = [seen.length / exact.length - 1.0, (seen.back - exact.back) / exact.length];
            assert!(off.iter().all(|o| o.abs() < TOLERANCE), "{name} {line}: {seen:?}, {exact:?}");
        }
        let [c, d, f] = [C, D, F].map(of_line);
        // In units of the spread that a singlet of the same glass and focal length has.
        let singlet = d.length / abbe_number(&glass(CROWN));
        let [apart, secondary] = [(c.back - f.back) / singlet, (c.back.midpoint(f.back) - d.back) / singlet];
        println!(
            "{name}: f = {:.3} mm, C and F are {:.4} of a singlet's spread apart, d is {secondary:.4} before",
            1e3 * d.length,
            apart
        );
        assert!((d.length / FOCAL_LENGTH - 1.0).abs() < 0.02, "{name}: f = {}", d.length);
        let limit = if name == "thin" { 0.1 } else { 0.02 };
        assert!(apart.abs() < limit && secondary > 0.0 && secondary < 0.1, "{name}: {apart}, {secondary}");
    }
}

/// A laser through the rim of the doublet hits the screen where its middle ray does, whether the cemented faces coincide
/// or the flint reaches into the crown: light paths, a bench full of lenses' own test.
#[test]
fn lasers_through_an_achromat() {
    let doublet = Doublet::thick();
    let (height, screen, width, camera) = (0.012, 0.35, 0.002, 0.05);
    for lambda in [C, F] {
        let overlapping = doublet.scene(false);
        let compiled = compile_json(&overlapping);
        let ray = Tracer::new(&compiled, &overlapping).trace(
            DVec3::new(0.0, height, -0.2),
            DVec3::Z,
            lambda,
            &[Event::Refract; 3],
        );
        let exact = ray.point.y + ray.direction.y * (screen - ray.point.z) / ray.direction.z;
        for in_contact in [false, true] {
            // The screen is seen head on, from between it and the lens, about the spot.
            let mut scene = with(&doublet.scene(in_contact), "/camera/from", json!([0, exact, screen - camera]));
            scene["camera"]["to"] = json!([0, exact, screen]);
            scene["camera"]["fov_degrees"] = json!(2.0 * math::atan2(0.5 * width, camera).to_degrees());
            scene["film"] = json!({ "width": 64, "height": 64 });
            scene["render"] = json!({ "samples_per_pixel": 16, "max_depth": 4, "integrator": "light" });
            scene["materials"]["screen"] = json!({ "type": "diffuse", "reflectance": 0.8 });
            scene["objects"].as_array_mut().unwrap().push(json!({ "material": "screen", "shape": { "type": "quad",
                "origin": [0.1, -0.1, screen], "u": [-0.2, 0, 0], "v": [0, 0.2, 0] } }));
            scene["lights"] = json!([{ "type": "beam", "origin": [0, height, -0.1], "direction": [0, 0, 1],
                "radius": 0.0002, "power": { "line_nm": lambda, "fwhm_nm": 0.1 } }]);
            scene.as_object_mut().unwrap().remove("environment");
            let film = render_json(&scene).0;
            let (mut sum, mut y) = (0.0, 0.0);
            for (pixel, xyz) in film.to_image().triples().iter().enumerate() {
                sum += xyz[1];
                y += xyz[1] * (32.0 - (pixel / 64) as f64 - 0.5) * width / 64.0;
            }
            assert!(sum > 0.0, "{lambda} nm, in contact {in_contact}: no light");
            println!("{lambda} nm, in contact {in_contact}: {:.2} µm off", 1e6 * y / sum);
            assert!((y / sum).abs() < 3e-6, "{lambda} nm, in contact {in_contact}: {} m off", y / sum);
        }
    }
}
