//! Natural reflectances for textures: eight coefficients a texel, from a table and a Newton step, evaluated in nanoseconds.
//!
//! The logit of a reflectance is a combination of eight curves, the first of which is 1: greys stay constants. Coefficients
//! come from a table over lightness, saturation and hue of a space's cube, interpolated by cubics; the axes are spaced so
//! that spectra change evenly along them, and the logit of the luminance, which has no bounds, is left out of the table.
//! Newton steps then restore the colour.

use super::check_components;
use super::data::{resampled, rows};
use super::linear::solve_dense;
use super::natural::{base_curve, coarse_curve};
use super::projection::within_limit;
use super::target::{COARSE_STEP, KNOTS, REFLECTANCE, knots_nm};
use crate::Result;
use crate::color::RgbSpace;
use crate::math;
use crate::spectrum::LAMBDA_MIN_NM;
use glam::{DMat3, DVec3};
#[cfg(feature = "render")]
use rayon::prelude::*;
use std::sync::LazyLock;

/// Coefficients of a reflectance.
const TERMS: usize = 8;
/// Intervals of the table: of each half of lightness, of saturation, of each sixth of the hues.
const LIGHTNESS: usize = 10;
const SATURATION: usize = 7;
const HUE: usize = 9;
/// Nodes along lightness, saturation and hue.
const NODES: [usize; 3] = [2 * LIGHTNESS + 1, SATURATION + 1, 6 * HUE];
/// Lightness of the darkest nodes, and what the lightest lack: darker colours have the same curves but for a constant.
const DARKEST: f64 = 1e-6;
/// Logit of white; that of black is its negative. Both are beyond what f32 can tell from 1 and 0.
const WHITE_LOGIT: f32 = 105.0;
/// Newton steps at a node.
const NODE_STEPS: u32 = 12;
/// A step that changes the logit by less than this in the mean is made without looking whether it brought the colour nearer.
const TRUSTED_STEP: f64 = 0.25;
/// Most halvings of a step.
const MAX_HALVINGS: usize = 6;

static BASIS: LazyLock<Basis> = LazyLock::new(Basis::embedded);
static SRGB: LazyLock<Table> = LazyLock::new(|| Table::new(RgbSpace::srgb()));

/// Values of lanes that the compiler turns into vector instructions.
const LANES: usize = 8;
/// The knots in groups of lanes; the last ones have no weight.
const GROUPS: usize = KNOTS.div_ceil(LANES);

/// The curves, and the weights of colour, at the knots.
struct Basis {
    /// Curves by knot.
    curves: Vec<[f32; TERMS]>,
    /// Curves and weights by group of knots.
    groups: Vec<Group>,
}

struct Group {
    curves: [[f32; LANES]; TERMS],
    weights: [[f32; LANES]; 3],
}

impl Basis {
    fn embedded() -> Self {
        let table = rows::<{ 1 + TERMS }>(include_str!("../../../data/recovery/natural_basis.csv"));
        let curves: Vec<[f64; TERMS]> = resampled(&table, &knots_nm());
        let curves: Vec<[f32; TERMS]> = curves.into_iter().map(|row| row.map(|value| value as f32)).collect();
        let group = |g: usize| {
            let knot = |lane: usize| (g * LANES + lane).min(KNOTS - 1);
            let weight = |lane: usize, k: usize| {
                REFLECTANCE.weights.get(g * LANES + lane).map_or(0.0, |weight| weight[k] as f32)
            };
            Group {
                curves: std::array::from_fn(|term| std::array::from_fn(|lane| curves[knot(lane)][term])),
                weights: std::array::from_fn(|k| std::array::from_fn(|lane| weight(lane, k))),
            }
        };
        let groups = (0..GROUPS).map(group).collect();
        Self { curves, groups }
    }

    /// The coefficients nearest to a logit at the coarse knots, by least squares.
    fn fit(&self, logit: &[f64]) -> [f64; TERMS] {
        let mut amounts = [0.0; TERMS];
        let mut squares = [0.0; TERMS];
        for (curves, z) in self.curves.iter().step_by(COARSE_STEP).zip(logit) {
            for (term, &curve) in curves.iter().enumerate() {
                amounts[term] += f64::from(curve) * z;
                squares[term] += f64::from(curve * curve);
            }
        }
        // The curves are nearly orthogonal, and the colour is restored anyway.
        std::array::from_fn(|term| amounts[term] / squares[term])
    }

    fn color(&self, coefficients: &[f64; TERMS]) -> DVec3 {
        let c = coefficients.map(|c| c as f32);
        let mut sums = [[0.0; LANES]; 3];
        for group in &self.groups {
            let r = logistic(logit(&group.curves, &c));
            for (sum, weights) in sums.iter_mut().zip(&group.weights) {
                add_product(sum, weights, &r);
            }
        }
        DVec3::from(sums.map(total))
    }

    /// The colour, and its derivatives by the coefficients.
    fn linearize(&self, coefficients: &[f64; TERMS]) -> (DVec3, [[f64; TERMS]; 3]) {
        let c = coefficients.map(|c| c as f32);
        let mut sums = [[0.0; LANES]; 3];
        let mut slopes = [[[0.0; LANES]; TERMS]; 3];
        for group in &self.groups {
            let r = logistic(logit(&group.curves, &c));
            for ((sum, slopes), weights) in sums.iter_mut().zip(&mut slopes).zip(&group.weights) {
                add_product(sum, weights, &r);
                let slope: [f32; LANES] = std::array::from_fn(|lane| weights[lane] * (r[lane] * (1.0 - r[lane])));
                for (sum, curve) in slopes.iter_mut().zip(&group.curves) {
                    add_product(sum, curve, &slope);
                }
            }
        }
        (DVec3::from(sums.map(total)), slopes.map(|slopes| slopes.map(total)))
    }

    /// Newton steps of least change towards a colour, each made only if it brings the colour nearer.
    fn restore(&self, mut at: [f64; TERMS], color: DVec3, steps: u32) -> [f64; TERMS] {
        for _ in 0..steps {
            let (now, slopes) = self.linearize(&at);
            let residual = color - now;
            let Some(step) = least_change(&slopes, residual) else { break };
            let moved = |share: f64| std::array::from_fn(|term| at[term] + share * step[term]);
            if step.iter().map(|s| s * s).sum::<f64>() < TRUSTED_STEP * TRUSTED_STEP {
                at = moved(1.0);
                continue;
            }
            let error = residual.abs().max_element();
            let is_nearer = |c: &[f64; TERMS]| (color - self.color(c)).abs().max_element() < error;
            let shares = (0..MAX_HALVINGS).map(|halvings| 1.0 / f64::from(1 << halvings));
            let Some(next) = shares.map(moved).find(is_nearer) else { break };
            at = next;
        }
        at
    }
}

fn logit(curves: &[[f32; LANES]; TERMS], coefficients: &[f32; TERMS]) -> [f32; LANES] {
    let mut z = [0.0; LANES];
    for (curve, &c) in curves.iter().zip(coefficients) {
        add_product(&mut z, curve, &[c; LANES]);
    }
    z
}

fn add_product(sum: &mut [f32; LANES], a: &[f32; LANES], b: &[f32; LANES]) {
    for lane in 0..LANES {
        sum[lane] += a[lane] * b[lane];
    }
}

fn total(lanes: [f32; LANES]) -> f64 {
    lanes.into_iter().map(f64::from).sum()
}

/// The smallest change of coefficients whose linear effect is a residual.
fn least_change(slopes: &[[f64; TERMS]; 3], residual: DVec3) -> Option<[f64; TERMS]> {
    let product = |a: usize, b: usize| -> f64 { slopes[a].iter().zip(&slopes[b]).map(|(x, y)| x * y).sum() };
    let row = |a: usize| [product(a, 0), product(a, 1), product(a, 2), residual[a]];
    let m = solve_dense([row(0), row(1), row(2)])?;
    Some(std::array::from_fn(|term| (0..3).map(|k| m[k] * slopes[k][term]).sum()))
}

/// 1 / (1 + e⁻ᶻ) in f32, to 2e-7 of its value; exactly 0 and 1 beyond ±104.
fn logistic<const N: usize>(z: [f32; N]) -> [f32; N] {
    z.map(|z| {
        let e = exp_of_negative(-z.abs());
        let small = e / (1.0 + e);
        if z < 0.0 { small } else { 1.0 / (1.0 + e) }
    })
}

/// eˣ of x ≤ 0 without branches, so that lanes are computed together; 0 below −87, where f32 has few digits left.
fn exp_of_negative(x: f32) -> f32 {
    const LN_2_HIGH: f32 = 0.693_359_4;
    const LN_2_LOW: f32 = -2.121_944_4e-4;
    let n = (x.max(-87.0) * std::f32::consts::LOG2_E).round_ties_even();
    let t = x.max(-87.0) - n * LN_2_HIGH - n * LN_2_LOW;
    // Taylor: |t| ≤ ½ ln 2, so that the next term is 4e-9.
    let tail = 1.0 / 120.0 + t * (1.0 / 720.0 + t * (1.0 / 5040.0));
    let series = 1.0 + t * (1.0 + t * (0.5 + t * (1.0 / 6.0 + t * (1.0 / 24.0 + t * tail))));
    let power = f32::from_bits((((n as i32) + 127) as u32) << 23);
    if x < -87.0 { 0.0 } else { series * power }
}

/// A natural reflectance as eight numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coefficients(pub [f32; TERMS]);

impl Coefficients {
    /// A constant reflectance in [0, 1].
    fn grey(value: f64) -> Self {
        let logit = if value <= 0.0 {
            -WHITE_LOGIT
        } else if value >= 1.0 {
            WHITE_LOGIT
        } else {
            math::ln(value / (1.0 - value)) as f32
        };
        let mut coefficients = [0.0; TERMS];
        coefficients[0] = logit;
        Self(coefficients)
    }

    /// The reflectance at a wavelength in nm, in [0, 1]; constant outside of 360–830 nm.
    pub fn eval(&self, lambda_nm: f32) -> f32 {
        self.sample([lambda_nm])[0]
    }

    /// The reflectance at several wavelengths in nm.
    pub fn sample<const N: usize>(&self, lambdas_nm: [f32; N]) -> [f32; N] {
        let curves = &BASIS.curves;
        logistic(lambdas_nm.map(|lambda| {
            let position = (lambda - LAMBDA_MIN_NM as f32).clamp(0.0, (KNOTS - 1) as f32);
            let cell = (position as usize).min(KNOTS - 2);
            let t = position - cell as f32;
            let (left, right) = (&curves[cell], &curves[cell + 1]);
            let mut terms = [0.0; TERMS];
            for term in 0..TERMS {
                terms[term] = self.0[term] * (left[term] + t * (right[term] - left[term]));
            }
            let [a, b, c, d, e, f, g, h] = terms;
            ((a + e) + (b + f)) + ((c + g) + (d + h))
        }))
    }
}

/// A table from colours of one RGB space to coefficients.
pub struct Table {
    /// Coefficients by lightness, saturation and hue; the logit of the luminance is left out.
    nodes: Vec<[f32; TERMS]>,
    /// RGB of the space to that of the sRGB primaries.
    rgb_from_space: DMat3,
    /// RGB of the sRGB primaries to that of the space.
    space_from_rgb: DMat3,
}

impl Table {
    /// The table of sRGB, made at its first use.
    pub fn srgb() -> &'static Table {
        &SRGB
    }

    /// Makes the table of a space, in about half a second of processor time.
    ///
    /// Colours that no reflectance has are moved towards grey, as by [`super::projected`].
    pub fn new(space: &RgbSpace) -> Self {
        let (rgb_from_space, space_from_rgb) = (REFLECTANCE.rgb_from(space), REFLECTANCE.space_from_rgb(space));
        let mut table = Self { nodes: Vec::new(), rgb_from_space, space_from_rgb };
        let [lightness, saturation, hue] = NODES;
        let count = lightness * saturation * hue;
        let nodes = 0..count;
        #[cfg(feature = "render")]
        let nodes = nodes.into_par_iter();
        table.nodes = nodes.map(|i| table.node(Node::of_index(i))).collect();
        table
    }

    fn node(&self, node: Node) -> [f32; TERMS] {
        if node.saturation == 0.0 {
            return [0.0; TERMS];
        }
        let color = within_limit(self.rgb_from_space * DVec3::from(node.rgb()));
        let every_fifth = |curve: Vec<f64>| curve.into_iter().step_by(COARSE_STEP).collect();
        let Some(curve) = coarse_curve(color).or_else(|| base_curve(color).map(every_fifth)) else {
            // A projection that ended at black or white.
            return [0.0; TERMS];
        };
        let mut coefficients = BASIS.restore(BASIS.fit(&curve), color, NODE_STEPS);
        coefficients[0] -= logit_of_luminance(color);
        coefficients.map(|c| c as f32)
    }

    /// The coefficients of linear RGB, after this many Newton steps; one is enough for an error of 2e-4.
    ///
    /// Greys are exact, black and white included. What cannot be a reflectance is moved towards grey.
    ///
    /// # Errors
    /// Components outside of [0, 1].
    pub fn coefficients(&self, rgb: [f64; 3], steps: u32) -> Result<Coefficients> {
        check_components(rgb, 1.0, "reflectance")?;
        if rgb[0] == rgb[1] && rgb[1] == rgb[2] {
            return Ok(Coefficients::grey(rgb[0]));
        }
        let asked = self.rgb_from_space * DVec3::from(rgb);
        let color = within_limit(asked);
        let rgb =
            if color == asked { rgb } else { (self.space_from_rgb * color).clamp(DVec3::ZERO, DVec3::ONE).into() };
        if color.x == color.y && color.y == color.z {
            return Ok(Coefficients::grey(color.x));
        }
        let mut coefficients = self.interpolate(Node::of_rgb(rgb));
        coefficients[0] += logit_of_luminance(color);
        Ok(Coefficients(BASIS.restore(coefficients, color, steps).map(|c| c as f32)))
    }

    /// Cubics through four nodes along each axis, none of them across an edge of the coordinates.
    fn interpolate(&self, node: Node) -> [f64; TERMS] {
        let [_, saturations, hues] = NODES;
        let (l, l_weights) = stencil(node.lightness * (2 * LIGHTNESS) as f64, LIGHTNESS, 2);
        let (s, s_weights) = stencil(node.saturation * SATURATION as f64, SATURATION, 1);
        let (h, h_weights) = stencil(node.hue * HUE as f64, HUE, 6);
        let mut sum = [0.0_f32; TERMS];
        for (i, l_weight) in l_weights.into_iter().enumerate() {
            for (j, s_weight) in s_weights.into_iter().enumerate() {
                let row = ((l + i) * saturations + s + j) * hues;
                for (k, h_weight) in h_weights.into_iter().enumerate() {
                    let weight = (l_weight * s_weight * h_weight) as f32;
                    let values = &self.nodes[row + (h + k) % hues];
                    for term in 0..TERMS {
                        sum[term] += weight * values[term];
                    }
                }
            }
        }
        sum.map(f64::from)
    }
}

fn logit_of_luminance(color: DVec3) -> f64 {
    let y = REFLECTANCE.xyz_from_rgb.row(1).dot(color);
    math::ln(y / (1.0 - y))
}

/// First node and weights of the cubic at a position along an axis of so many blocks of so many intervals each.
fn stencil(position: f64, intervals: usize, blocks: usize) -> (usize, [f64; 4]) {
    let block = (position as usize / intervals).min(blocks - 1) * intervals;
    let first = (position as usize).saturating_sub(1).clamp(block, block + intervals - 3);
    let [a, b, c, d] = std::array::from_fn(|i| position - (first + i) as f64);
    (first, [b * c * d / -6.0, a * c * d / 2.0, a * b * d / -2.0, a * b * c / 6.0])
}

/// A place in the table. All coordinates are continuous in RGB.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Node {
    /// Lightness in [0, 1], ½ where the largest and the smallest component add up to 1; dense at both ends and in the middle.
    lightness: f64,
    /// Saturation in [0, 1], 1 at the surface of the cube; dense there.
    saturation: f64,
    /// Hue in [0, 6): red, yellow, green, cyan, blue and magenta at whole numbers, dense around them.
    hue: f64,
}

/// Which components are the largest, the middle and the smallest in each sixth of the hues.
const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [1, 0, 2], [1, 2, 0], [2, 1, 0], [2, 0, 1], [0, 2, 1]];

impl Node {
    fn of_index(index: usize) -> Self {
        let [_, saturations, hues] = NODES;
        let (l, s, h) = (index / hues / saturations, index / hues % saturations, index % hues);
        let lightness = l as f64 / (2 * LIGHTNESS) as f64;
        Self { lightness, saturation: s as f64 / SATURATION as f64, hue: h as f64 / HUE as f64 }
    }

    fn of_rgb(rgb: [f64; 3]) -> Self {
        let sextant = ORDERS.iter().position(|&[a, b, c]| rgb[a] >= rgb[b] && rgb[b] >= rgb[c]).unwrap_or(0);
        let [most, middle, least] = ORDERS[sextant].map(|i| rgb[i]);
        let sum = most + least;
        // Twice the distance to the nearer end of the lightness, which is also the largest difference of components there.
        let room = sum.min(2.0 - sum);
        let chroma = most - least;
        let lightness = 0.5 * flattened(flattened(room));
        let towards_middle = flattened((middle - least) / chroma);
        Self {
            lightness: if sum <= 1.0 { lightness } else { 1.0 - lightness },
            saturation: 1.0 - (1.0 - (chroma / room).min(1.0)).sqrt(),
            hue: sextant as f64 + if sextant.is_multiple_of(2) { towards_middle } else { 1.0 - towards_middle },
        }
    }

    fn rgb(&self) -> [f64; 3] {
        let sextant = (self.hue as usize).min(5);
        let part = self.hue - sextant as f64;
        let towards_middle = if sextant.is_multiple_of(2) { part } else { 1.0 - part };
        let room = steepened(steepened(2.0 * self.lightness.min(1.0 - self.lightness))).max(DARKEST);
        let rest = 1.0 - self.saturation;
        let chroma = room * (1.0 - rest * rest);
        let mean = if self.lightness <= 0.5 { 0.5 * room } else { 1.0 - 0.5 * room };
        let least = (mean - 0.5 * chroma).max(0.0);
        let components = [mean + 0.5 * chroma, least + chroma * steepened(towards_middle), least];
        let mut rgb = [0.0; 3];
        ORDERS[sextant].into_iter().zip(components).for_each(|(i, value)| rgb[i] = value.clamp(0.0, 1.0));
        rgb
    }
}

/// Maps [0, 1] to itself, steep at both ends: √x / (√x + √(1 − x)).
fn flattened(x: f64) -> f64 {
    let (a, b) = (x.clamp(0.0, 1.0).sqrt(), (1.0 - x).clamp(0.0, 1.0).sqrt());
    a / (a + b)
}

/// The inverse of [`flattened`].
fn steepened(v: f64) -> f64 {
    let (a, b) = (v * v, (1.0 - v) * (1.0 - v));
    a / (a + b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::srgb_decode;
    use crate::color::upsample::target::spectrum_of;
    use crate::color::upsample::{reflectance, rgb_of_reflectance};

    fn spectrum(c: &Coefficients) -> crate::spectrum::Spectrum {
        spectrum_of(knots_nm().into_iter().map(|lambda| f64::from(c.eval(lambda as f32))).collect())
    }

    /// Colours spread over a cube in encoded components, its faces and the neighbourhood of its corners.
    fn colors(count: usize) -> impl Iterator<Item = [f64; 3]> {
        // Additive recurrences of the plastic number: even, and the same each time.
        let spread = |i: usize, step: f64| (0.5 + i as f64 * step).fract();
        (0..count).map(move |i| {
            let mut encoded = [0.819_172_5, 0.671_043_6, 0.549_700_5].map(|step| spread(i, step));
            match i % 6 {
                0 => encoded[i / 6 % 3] = 0.0,
                1 => encoded[i / 6 % 3] = 1.0,
                2 => encoded = encoded.map(|e| 0.08 * e),
                3 => encoded = encoded.map(|e| 1.0 - 0.08 * e),
                4 => encoded = encoded.map(|e| 0.95 * e.round() + 0.05 * e),
                _ => {}
            }
            encoded.map(srgb_decode)
        })
    }

    #[test]
    fn coordinates_lead_back() {
        for rgb in colors(2000) {
            let node = Node::of_rgb(rgb);
            let back = node.rgb();
            let error = (DVec3::from(back) - DVec3::from(rgb)).abs().max_element();
            assert!(
                error < 1e-12 + 2.0 * DARKEST * f64::from(node.lightness < 0.05 || node.lightness > 0.95),
                "{rgb:?}"
            );
        }
    }

    #[test]
    fn cubics_are_exact_for_cubics_and_stay_in_their_block() {
        let cubic = |x: f64| 1.0 + x * (0.5 - x * (0.3 - 0.02 * x));
        for position in [0.0, 0.3, 1.0, 5.7, 8.999, 9.0, 10.0, 13.2, 17.999, 18.0] {
            let (first, weights) = stencil(position, 9, 2);
            let value: f64 = weights.iter().enumerate().map(|(i, w)| w * cubic((first + i) as f64)).sum();
            assert!((value - cubic(position)).abs() < 1e-12, "{position}");
            assert!(if position < 9.0 { first + 3 <= 9 } else { first >= 9 && first + 3 <= 18 }, "{position}: {first}");
        }
    }

    #[test]
    fn one_step_has_the_colour_and_two_have_it_better() {
        let mut worst = [0.0_f64; 2];
        for rgb in colors(600) {
            for (worst, steps) in worst.iter_mut().zip([1, 2]) {
                let coefficients = Table::srgb().coefficients(rgb, steps).unwrap();
                let back = DVec3::from(rgb_of_reflectance(&spectrum(&coefficients), RgbSpace::srgb()));
                *worst = worst.max((back - DVec3::from(rgb)).abs().max_element());
            }
        }
        assert!(worst[0] < 2.5e-4 && worst[1] < 1e-5, "{worst:?}");
    }

    #[test]
    fn the_spectra_are_the_natural_ones() {
        let mut sum = 0.0;
        let count = 120;
        for rgb in colors(count) {
            let table = spectrum(&Table::srgb().coefficients(rgb, 1).unwrap());
            let direct = reflectance(rgb, RgbSpace::srgb()).unwrap();
            let squares: f64 = knots_nm().iter().map(|&l| (table.eval(l) - direct.eval(l)).powi_2()).sum();
            sum += (squares / KNOTS as f64).sqrt();
        }
        assert!(sum / (count as f64) < 0.01, "{}", sum / count as f64);
    }

    trait Square {
        fn powi_2(self) -> Self;
    }
    impl Square for f64 {
        fn powi_2(self) -> f64 {
            self * self
        }
    }

    #[test]
    fn greys_are_flat_and_black_and_white_exact() {
        for (grey, exact) in [(0.0, true), (1.0, true), (0.2, false), (1e-5, false)] {
            let c = Table::srgb().coefficients([grey; 3], 1).unwrap();
            let values = c.sample([360.0, 444.4, 555.5, 829.9]);
            assert!(values.iter().all(|v| *v == values[0]));
            let error = (f64::from(values[0]) - grey).abs();
            assert!(if exact { error == 0.0 } else { error < 1e-6 * grey }, "{grey}: {error:e}");
        }
    }

    #[test]
    fn wider_spaces_get_reflectances() {
        let rec2020 = RgbSpace::by_name("rec2020").unwrap();
        let table = Table::new(rec2020);
        let mut errors = Vec::new();
        for rgb in colors(200) {
            let coefficients = table.coefficients(rgb, 2).unwrap();
            let (least, most) = spectrum(&coefficients).range();
            assert!(0.0 <= least && most <= 1.0);
            if reflectance(rgb, rec2020).is_ok() {
                let back = DVec3::from(rgb_of_reflectance(&spectrum(&coefficients), rec2020));
                errors.push((back - DVec3::from(rgb)).abs().max_element());
            }
        }
        errors.sort_by(f64::total_cmp);
        // Next to the limit of reflectances eight curves are too few.
        let quantile = |percent: usize| errors[errors.len() * percent / 100];
        assert!(quantile(50) < 1e-6 && quantile(80) < 1e-3 && quantile(95) < 1e-2, "{errors:?}");
    }

    #[test]
    fn the_logistic_function_in_f32() {
        let mut worst = 0.0_f64;
        for i in -9000..=9000 {
            let z = i as f32 * 0.01;
            let exact = 1.0 / (1.0 + math::exp(-f64::from(z)));
            if exact > 1e-37 {
                worst = worst.max((f64::from(logistic([z])[0]) / exact - 1.0).abs());
            }
        }
        assert!(worst < 3e-7, "{worst:e}");
        assert_eq!(logistic([WHITE_LOGIT, -WHITE_LOGIT, 0.0]), [1.0, 0.0, 0.5]);
    }
}
