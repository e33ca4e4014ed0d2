//! The rainbow that a prism throws on a screen, as XYZ in each of its columns, against an integral over wavelengths and the
//! beam's cross-section that knows Snell, Fresnel and the plane geometry of the prism, and nothing of the renderer but the
//! glass's index and the observer.
//!
//! Light is unpolarised at each face, as in the renderer: what the first face does to polarisation is not kept for the
//! second.

#[path = "common/render.rs"]
mod common;

use abbe::color::Observer;
use abbe::math;
use abbe::optics::ior::IndexOfRefraction;
use common::{Estimate, fresnel, render_json, sidak, with};
use glam::{DVec2, DVec3};
use serde_json::{Value, json};
use std::f64::consts::{FRAC_1_PI, PI};

const GLASS: &str = "F2";
const APEX: f64 = 60.0;
const SIDE: f64 = 0.1;
/// Angle of incidence, degrees: near the least deviation.
const INCIDENCE: f64 = 56.0;
const BEAM_RADIUS: f64 = 0.0015;
const REFLECTANCE: f64 = 0.8;
/// Distance of the screen from the prism's axis, and of the camera from the screen, metres.
const SCREEN: f64 = 1.0;
const CAMERA: f64 = 0.3;
/// Columns and rows of the film, and the width of a pixel on the screen.
const SIZE: [usize; 2] = [50, 6];
const PIXEL: f64 = 0.0018;
/// Columns count that have at least this share of the brightest in X, Y or Z.
const DIMMEST: f64 = 0.1;
/// Largest error of a column, and largest standard error of the mean over the seeds.
const TOLERANCE: f64 = 0.01;
const NOISE: f64 = 0.005;
const SEEDS: u64 = 6;

/// The beam's power: W/nm at wavelengths in nm, linear between them.
struct Lamp {
    name: &'static str,
    nm: &'static [f64],
    power: &'static [f64],
}

/// Near enough to white, and one whose ends are bright to the observer: the two ends of the rainbow that white light leaves
/// dim, and noisy, are measured by it.
const LAMPS: [Lamp; 2] = [
    Lamp { name: "white", nm: &[360.0, 480.0, 600.0, 830.0], power: &[0.5, 1.1, 0.9, 1.3] },
    Lamp {
        name: "violet and red",
        nm: &[360.0, 380.0, 400.0, 420.0, 440.0, 640.0, 680.0, 700.0, 720.0, 830.0],
        power: &[200.0, 200.0, 20.0, 2.0, 0.4, 0.8, 12.0, 50.0, 200.0, 200.0],
    },
];

impl Lamp {
    fn eval(&self, lambda: f64) -> f64 {
        let i = self.nm.partition_point(|w| *w <= lambda).clamp(1, self.nm.len() - 1);
        let t = (lambda - self.nm[i - 1]) / (self.nm[i] - self.nm[i - 1]);
        self.power[i - 1] + t * (self.power[i] - self.power[i - 1])
    }
}

/// The plane of the prism's section: x towards the apex, y towards the side that the light comes from.
struct Section {
    n: IndexOfRefraction,
    apex: DVec2,
    /// Outward normals of the faces that light enters and leaves by.
    faces: [DVec2; 2],
    start: DVec2,
    direction: DVec2,
    /// A point of the screen, and the unit direction across it away from the light it faces.
    screen: DVec2,
    facing: DVec2,
}

/// A ray that has crossed the prism: where it meets the screen, and what is left of its power.
struct Landing {
    along: f64,
    transmittance: f64,
}

fn polar(angle: f64) -> DVec2 {
    DVec2::new(math::cos(angle), math::sin(angle))
}

/// Where a ray meets a line.
fn meet(point: DVec2, direction: DVec2, on_line: DVec2, normal: DVec2) -> DVec2 {
    point + direction * ((on_line - point).dot(normal) / direction.dot(normal))
}

/// Direction after refraction, n₁ / n₂ = `ratio`, by a face whose `normal` points to where the light goes.
fn bend(direction: DVec2, normal: DVec2, ratio: f64) -> DVec2 {
    let along = (direction - normal * direction.dot(normal)) * ratio;
    along + normal * (1.0 - along.length_squared()).sqrt()
}

impl Section {
    fn new() -> Self {
        let half = 0.5 * APEX.to_radians();
        let height = SIDE * math::cos(half);
        let faces = [polar(0.5 * PI - half), polar(half - 0.5 * PI)];
        // Light comes from the base's side of the first face's normal.
        let direction = -polar(math::atan2(faces[0].y, faces[0].x) + INCIDENCE.to_radians());
        let middle = DVec2::new(2.0 / 3.0 * height, 0.0) + 0.5 * SIDE * DVec2::new(-math::cos(half), math::sin(half));
        let mut section = Self {
            n: abbe::io::catalogue::glass(GLASS).unwrap().constants().unwrap().n,
            apex: DVec2::new(2.0 / 3.0 * height, 0.0),
            faces,
            start: middle - direction * 0.2,
            direction,
            screen: DVec2::ZERO,
            facing: DVec2::X,
        };
        // The screen faces green light, and the film is centred between the ends of the spectrum.
        section.facing = section.refracted(550.0).1;
        section.screen = section.facing * SCREEN;
        let [red, violet] = [700.0, 410.0].map(|lambda| section.land(lambda, 0.0).along);
        section.screen += section.facing.perp() * red.midpoint(violet);
        section
    }

    /// Directions inside the glass and after it.
    fn refracted(&self, lambda: f64) -> (DVec2, DVec2) {
        let n = self.n.eval(lambda);
        let inside = bend(self.direction, -self.faces[0], 1.0 / n);
        (inside, bend(inside, self.faces[1], n))
    }

    /// Follows the ray that is `off` the beam's axis.
    fn land(&self, lambda: f64, off: f64) -> Landing {
        let n = self.n.eval(lambda);
        let (inside, out) = self.refracted(lambda);
        let entry = meet(self.start + self.direction.perp() * off, self.direction, self.apex, self.faces[0]);
        let exit = meet(entry, inside, self.apex, self.faces[1]);
        let spot = meet(exit, out, self.screen, self.facing);
        // Sines in air, before the first face and after the second.
        let sines = [self.direction.perp_dot(self.faces[0]), out.perp_dot(self.faces[1])].map(f64::abs);
        let transmittance = (1.0 - fresnel(sines[0], 1.0, n)) * (1.0 - fresnel(sines[1], n, 1.0));
        Landing { along: (spot - self.screen).dot(self.facing.perp()), transmittance }
    }
}

/// Share of a disc of radius 1 on one side of a chord at −1 … 1 from its centre.
fn disc_share(chord: f64) -> f64 {
    let c = chord.clamp(-1.0, 1.0);
    0.5 + FRAC_1_PI * (c * (1.0 - c * c).sqrt() + math::asin(c))
}

/// Sum over the rows of each column of the film, XYZ.
fn exact(section: &Section, lamp: &Lamp) -> Vec<[f64; 3]> {
    let observer = Observer::cie_1931_2deg();
    let mut columns = vec![[0.0; 3]; SIZE[0]];
    let step = 0.05;
    for i in 0..(470.0 / step) as u32 {
        let lambda = 360.0 + (f64::from(i) + 0.5) * step;
        let center = section.land(lambda, 0.0);
        // Flat faces keep parallel light parallel: on the screen the beam's section is stretched.
        let stretch = section.land(lambda, BEAM_RADIUS).along - center.along;
        // A column's radiance is ρ / π times its power over its area.
        let seen = REFLECTANCE * FRAC_1_PI / (PIXEL * PIXEL) * lamp.eval(lambda) * center.transmittance * step;
        let weights = observer.eval(lambda) * (seen / observer.y_integral());
        let share = |edge: usize| disc_share((at_edge(edge) - center.along) / stretch.abs());
        for (column, sum) in columns.iter_mut().enumerate() {
            let inside = share(column + 1) - share(column);
            (0..3).for_each(|c| sum[c] += weights[c] * inside);
        }
    }
    columns
}

/// Place on the screen of the left edge of a column.
fn at_edge(column: usize) -> f64 {
    (column as f64 - 0.5 * SIZE[0] as f64) * PIXEL
}

/// From the plane of the section to the scene: x stays, y is the scene's z.
fn lift(p: DVec2) -> DVec3 {
    DVec3::new(p.x, 0.0, p.y)
}

fn scene(section: &Section, lamp: &Lamp) -> Value {
    let from = section.screen - section.facing * CAMERA;
    // As the camera sees it, `perp` of its direction (a quarter turn from x to y, that is from x to z) is to the right.
    let right = lift(section.facing.perp());
    let corner = lift(section.screen) - right * 0.1 - DVec3::Y * 0.1;
    let half = math::atan2(0.5 * SIZE[0] as f64 * PIXEL, CAMERA);
    json!({
        "camera": { "type": "perspective", "from": lift(from).to_array(), "to": lift(section.screen).to_array(),
                    "fov_degrees": 2.0 * half.to_degrees() },
        "film": { "width": SIZE[0], "height": SIZE[1] },
        // In, out, and the screen: no reflection inside the prism.
        "render": { "samples_per_pixel": 400, "max_depth": 3, "seed": 0 },
        "materials": { "glass": { "type": "dielectric", "ior": { "glass": GLASS } },
                       "screen": { "type": "diffuse", "reflectance": REFLECTANCE } },
        "objects": [
            { "shape": { "type": "prism", "apex_degrees": APEX, "side": SIDE, "length": 0.1 }, "material": "glass" },
            { "shape": { "type": "quad", "origin": corner.to_array(), "u": (right * 0.2).to_array(), "v": [0, 0.2, 0] },
              "material": "screen" }
        ],
        "lights": [{ "type": "beam", "origin": lift(section.start).to_array(), "direction": lift(section.direction).to_array(),
                     "radius": BEAM_RADIUS, "power": { "wavelengths_nm": lamp.nm, "values": lamp.power } }]
    })
}

/// The same sums of a rendered film.
fn columns(scene: &Value) -> Vec<[f64; 3]> {
    let picture = render_json(scene).0.to_image();
    let image = picture.triples();
    let sum = |column: usize| {
        let pixels = (0..SIZE[1]).map(|row| image[row * SIZE[0] + column]);
        pixels.fold([0.0; 3], |sum, xyz| std::array::from_fn(|c| sum[c] + xyz[c]))
    };
    (0..SIZE[0]).map(sum).collect()
}

/// Compares every column that counts and returns which did.
fn compare(section: &Section, lamp: &Lamp) -> Vec<usize> {
    let exact = exact(section, lamp);
    let scene = scene(section, lamp);
    let films: Vec<_> = (0..SEEDS).map(|seed| columns(&with(&scene, "/render/seed", seed))).collect();
    let peak: [f64; 3] = std::array::from_fn(|c| exact.iter().map(|xyz| xyz[c]).fold(0.0, f64::max));
    let share = |xyz: &[f64; 3]| (0..3).map(|c| xyz[c] / peak[c]).fold(0.0, f64::max);
    let counted: Vec<usize> = (0..SIZE[0]).filter(|column| share(&exact[*column]) >= DIMMEST).collect();
    let threshold = sidak(0.01, 3 * SIZE[0] * LAMPS.len());
    let (mut worst, mut noisiest, mut least) = (0.0f64, 0.0f64, 1.0f64);
    for &column in &counted {
        for c in 0..3 {
            let seen = Estimate::of(&films.iter().map(|film| film[column][c]).collect::<Vec<_>>());
            let exact = Estimate { mean: exact[column][c], error: 0.0, count: usize::MAX };
            let (off, noise) = (seen.mean / exact.mean - 1.0, seen.error / exact.mean);
            let p = seen.p_value(&exact);
            let what =
                format!("{}, column {column}, {}: off by {off} ± {noise}, p = {p}", lamp.name, ["X", "Y", "Z"][c]);
            // Where only stray light of the column's ends is seen in a channel, its digits say nothing.
            if exact.mean >= 1e-4 * peak[c] {
                assert!(noise < NOISE, "too noisy: {what}");
                assert!(off.abs() < TOLERANCE && p > threshold, "{what}");
                (worst, noisiest, least) = (worst.max(off.abs()), noisiest.max(noise), least.min(p));
            }
        }
    }
    println!(
        "{}: {} columns, worst off by {:.2} %, noisiest {:.2} %, smallest p {least:.5} (threshold {threshold:.5})",
        lamp.name,
        counted.len(),
        100.0 * worst,
        100.0 * noisiest
    );
    counted
}

#[test]
fn every_column_of_the_rainbow() {
    let section = Section::new();
    let [white, ends] = LAMPS.each_ref().map(|lamp| compare(&section, lamp));
    assert!(white.len() >= 32, "{} columns count in white light", white.len());
    // Both lamps together leave out no column between 390 and 730 nm.
    let at = |lambda: f64| (section.land(lambda, 0.0).along / PIXEL + 0.5 * SIZE[0] as f64) as usize;
    let (from, to) = (at(390.0).min(at(730.0)), at(390.0).max(at(730.0)));
    println!("390 to 730 nm are columns {from} to {to}");
    assert!((from..=to).all(|column| white.contains(&column) || ends.contains(&column)));
}
