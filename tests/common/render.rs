//! Rendering in tests, and the statistics that pictures are judged by.
#![allow(dead_code, reason = "every test file uses its own part")]

use abbe::film::Film;
use abbe::math;
use abbe::render::{Rendering, Statistics};
use abbe::scene::Compiled;
use serde_json::Value;
use std::f64::consts::FRAC_PI_2;
use std::path::Path;

/// Compiles a scene.
pub fn compile_json(scene: &Value) -> Compiled {
    let parsed = abbe::scene::description::parse_str(&scene.to_string(), Path::new("test.json"))
        .unwrap_or_else(|error| panic!("{error}"));
    abbe::scene::compile(&parsed.description).unwrap_or_else(|error| panic!("{error}"))
}

/// Renders a scene, and insists that no sample was lost and no path lost count of what it is inside of.
pub fn render_json(scene: &Value) -> (Film, Statistics) {
    render_compiled(&compile_json(scene))
}

/// The same for a compiled scene.
pub fn render_compiled(compiled: &Compiled) -> (Film, Statistics) {
    let (film, statistics) = render_counting_underflows(compiled);
    assert_eq!(statistics.counters.medium_underflows, 0, "paths left media that they had not entered");
    (film, statistics)
}

/// The same for a scene with edges of volumes in each other: a path that comes within rounding of one may lose count.
pub fn render_counting_underflows(compiled: &Compiled) -> (Film, Statistics) {
    let Rendering { film, statistics, .. } =
        abbe::render::render(&compiled.scene, &compiled.render, &compiled.film, &mut |_| true);
    assert!(statistics.complete);
    assert_eq!(film.non_finite_samples, 0, "samples were not finite");
    (film, statistics)
}

/// The scene with the value at a JSON pointer replaced; the place must exist.
pub fn with(scene: &Value, pointer: &str, value: impl Into<Value>) -> Value {
    let mut scene = scene.clone();
    *scene.pointer_mut(pointer).unwrap_or_else(|| panic!("no {pointer}")) = value.into();
    scene
}

/// Mean X + Y + Z of a film: positive at every visible wavelength.
pub fn mean_xyz_sum(film: &Film) -> f64 {
    let picture = film.to_image();
    let image = picture.triples();
    image.iter().flatten().sum::<f64>() / image.len() as f64
}

/// Mean Y of a film.
pub fn mean_y(film: &Film) -> f64 {
    let picture = film.to_image();
    let image = picture.triples();
    image.iter().map(|xyz| xyz[1]).sum::<f64>() / image.len() as f64
}

/// Probability that chance alone fails one comparison with an exact value.
const LEVEL: f64 = 1e-4;

/// A number known up to a statistical error.
#[derive(Debug, Clone, Copy)]
pub struct Estimate {
    pub mean: f64,
    /// Standard error of the mean.
    pub error: f64,
    pub count: usize,
}

impl Estimate {
    /// From independent values.
    pub fn of(values: &[f64]) -> Self {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let variance = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / (n * (n - 1.0));
        Self { mean, error: variance.sqrt(), count: values.len() }
    }

    /// Of a quantity of the scene's film, over seeds 0, 1, ….
    pub fn over_seeds(scene: &Value, seeds: u64, quantity: impl Fn(&Film) -> f64) -> Self {
        let of_seed = |seed: u64| quantity(&render_json(&with(scene, "/render/seed", seed)).0);
        Self::of(&(0..seeds).map(of_seed).collect::<Vec<_>>())
    }

    /// Insists on an exact value: the statistical error is below `relative` / 3, and the mean is off by less than
    /// `relative`, and by no more than rounding (2e-6) and Student's t at the level [`LEVEL`] explain.
    pub fn check(&self, what: &str, exact: f64, relative: f64) {
        let (off, scale) = ((self.mean - exact).abs(), exact.abs().max(1e-30));
        println!("{what}: {:.7} ± {:.7}, exact {exact:.7}, off by {:.1e}", self.mean, self.error, off / scale);
        assert!(self.error <= relative / 3.0 * scale, "{what}: too noisy: {self:?}, exact {exact}");
        assert!(off <= relative * scale, "{what}: {self:?}, exact {exact}");
        let t = (off - 2e-6 * scale).max(0.0) / self.error.max(f64::MIN_POSITIVE);
        assert!(student_two_sided(t, self.count as f64 - 1.0) > LEVEL, "{what}: {self:?}, exact {exact}, {t} σ");
    }

    /// Two-sided probability of a difference at least as large by chance [Welch1947].
    pub fn p_value(&self, other: &Self) -> f64 {
        let (a, b) = (self.error * self.error, other.error * other.error);
        if a + b == 0.0 {
            return if self.mean == other.mean { 1.0 } else { 0.0 };
        }
        let freedom = (a + b) * (a + b) / (a * a / (self.count as f64 - 1.0) + b * b / (other.count as f64 - 1.0));
        student_two_sided((self.mean - other.mean).abs() / (a + b).sqrt(), freedom)
    }
}

/// Probability that a |t| of `freedom` degrees of freedom exceeds `t`: with t = √ν tan θ the density is ∝ cos^(ν−1) θ.
pub fn student_two_sided(t: f64, freedom: f64) -> f64 {
    let integral = |from: f64| {
        let n = 4000;
        let step = (FRAC_PI_2 - from) / f64::from(n);
        (0..n).map(|i| math::pow(math::cos(from + (f64::from(i) + 0.5) * step), freedom - 1.0)).sum::<f64>() * step
    };
    integral(math::atan2(t, freedom.sqrt())) / integral(0.0)
}

/// Threshold of each of `tests` p-values for a joint level `alpha` [Sidak1967].
pub fn sidak(alpha: f64, tests: usize) -> f64 {
    1.0 - math::pow(1.0 - alpha, 1.0 / tests as f64)
}

/// How many standard deviations a χ² lies above what is expected [WilsonHilferty1931].
pub fn chi2_sigmas(chi2: f64, freedom: f64) -> f64 {
    let v = 2.0 / (9.0 * freedom);
    (math::pow(chi2 / freedom, 1.0 / 3.0) - (1.0 - v)) / v.sqrt()
}

/// A spectrum of `count` hats over 380–750 nm that add up to 1: the table of hat `index`, from `value` of a wavelength at
/// its knots (1 for the hat itself). The first and last are 1 beyond their peak.
pub fn hat(index: usize, count: usize) -> (Vec<f64>, Vec<f64>) {
    let peak = |i: usize| 380.0 + 370.0 * i as f64 / (count - 1) as f64;
    let knots: Vec<f64> = (0..count).map(peak).collect();
    let values = (0..count).map(|i| if i == index { 1.0 } else { 0.0 }).collect();
    (knots, values)
}

/// A box between two corners, as the JSON of a closed mesh with its front outside.
pub fn box_shape(min: [f64; 3], max: [f64; 3]) -> Value {
    let corner = |i: usize| (0..3).map(move |axis| if i >> axis & 1 == 0 { min[axis] } else { max[axis] });
    let positions: Vec<f64> = (0..8).flat_map(corner).collect();
    let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let indices: Vec<usize> = quads.iter().flat_map(|[a, b, c, d]| [*a, *b, *c, *a, *c, *d]).collect();
    serde_json::json!({ "type": "triangles", "positions": positions, "indices": indices })
}

/// Reflectance of unpolarised light at a smooth boundary, by Fresnel's amplitudes as the textbooks give them; 1 beyond the
/// critical angle. `sin` is that of the angle in a medium of index 1.
pub fn fresnel(sin: f64, from: f64, to: f64) -> f64 {
    if sin >= to {
        return 1.0;
    }
    let cos = |n: f64| (1.0 - sin * sin / (n * n)).sqrt();
    let (ci, ct) = (cos(from), cos(to));
    let s = (from * ci - to * ct) / (from * ci + to * ct);
    let p = (to * ci - from * ct) / (to * ci + from * ct);
    0.5 * (s * s + p * p)
}

/// A plane-parallel layer.
#[derive(Debug, Clone, Copy)]
pub struct Layer {
    pub index: f64,
    pub thickness: f64,
    pub absorption: f64,
}

/// Transmittance and reflectance of layers in air, all reflections between them added up without interference: for one
/// slab T = (1 − R)² τ / (1 − R² τ²), for more by adding a boundary at a time.
pub fn stack(layers: &[Layer], sin: f64) -> (f64, f64) {
    let first = fresnel(sin, 1.0, layers[0].index);
    let (mut t, mut front, mut back) = (1.0 - first, first, first);
    for (i, layer) in layers.iter().enumerate() {
        let next = layers.get(i + 1).map_or(1.0, |l| l.index);
        let cos = (1.0 - sin * sin / (layer.index * layer.index)).sqrt();
        let tau = math::exp(-layer.absorption * layer.thickness / cos);
        let r = fresnel(sin, layer.index, next);
        let echoes = 1.0 / (1.0 - back * tau * tau * r);
        front += t * t * tau * tau * r * echoes;
        back = r + (1.0 - r) * (1.0 - r) * tau * tau * back * echoes;
        t *= tau * (1.0 - r) * echoes;
    }
    (t, front)
}
