//! Gamut mapping: what becomes of colours that a space cannot hold, and how many there were.
//!
//! A colour is in gamut if its linear components are in [0, 1]. [`GamutMethod::Clip`] moves each component there, which
//! changes hue. [`GamutMethod::Desaturate`] keeps lightness and hue and takes away chroma, in the spirit of \[CSS4\]:
//!
//! 1. Colours in gamut stay as they are, bit for bit.
//! 2. The others are seen in Oklab \[Ottosson2020\], with cone responses scaled so that the white of the space is exactly
//!    L = 1, a = b = 0 (for D65 this moves Oklab by less than 1e-3). L ≥ 1 becomes white, L ≤ 0 black.
//! 3. Of the colours (L, t a, t b) with t in [0, 1] the one with the largest t in gamut is taken, where red may be a
//!    little below 0 near blue (see below). Components are cubic polynomials of t, so t is 1 or a root of one of eight of
//!    them: there is no search with a tolerance.
//! 4. Red below 0 is clipped.
//!
//! The result is in gamut, mapping it again changes nothing, and its hue in Oklab is that of the colour within 0.5°
//! (nearer to grey than a chroma of 0.02 the fourth digit of white's own a and b is worth more).
//!
//! # Near blue
//! Within 0.2° of the hue of the blue of sRGB and Rec. 2020 a ray of constant lightness leaves the gamut through red = 0,
//! enters it again and leaves it through green = 0: blue would stay, and blue with a red of −1e-17 lose a sixth of its
//! chroma. There the face red = 0 is taken as tilted outwards about the edge between blue and black, by just so much that
//! red + κ green decreases along the ray at blue; away from the edge the tilted face bends back to red = 0. That fills the
//! notch, which is less than 0.002 deep, and leaves the mapping continuous but for a band of hues 0.002° wide, where
//! neighbours part by less than 0.01. Where there is no notch (Display P3, DCI-P3, Adobe RGB) κ is 0. Into spaces with
//! primaries that no light has it stays discontinuous.

use super::adaptation::bradford;
use super::{LinearRgb, RgbSpace, xyz_from_xy};
use crate::color::space::OKLAB_CONES_FROM_XYZ;
use crate::{Error, Result, math};
use glam::{DMat3, DVec3};

/// How colours get into a gamut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum GamutMethod {
    /// Clips each component by itself.
    Clip,
    /// Lowers the chroma at the same lightness and hue.
    Desaturate,
}

impl GamutMethod {
    /// Names that [`GamutMethod::by_name`] knows.
    pub fn names() -> impl Iterator<Item = &'static str> {
        ["clip", "desaturate"].into_iter()
    }

    /// A method by its name.
    ///
    /// # Errors
    /// [`UnknownName`](crate::ErrorKind::UnknownName) with the nearest name.
    pub fn by_name(name: &str) -> Result<Self> {
        match name {
            "clip" => Ok(Self::Clip),
            "desaturate" => Ok(Self::Desaturate),
            _ => Err(Error::unknown_name("gamut mapping", name, Self::names())),
        }
    }
}

/// How far a colour is outside of the gamut: the most that a component is below 0 or above 1; 0 inside.
///
/// NaN counts as infinitely far.
pub fn excess(rgb: LinearRgb) -> f64 {
    if rgb.0.is_nan() {
        return f64::INFINITY;
    }
    (-rgb.0).max(rgb.0 - 1.0).max_element().max(0.0)
}

/// Takes away the negative components of a colour of any brightness by mixing it with the grey of its luminance, as far as it
/// takes. Where the luminance is not positive either, negative components become 0.
///
/// For light before tone mapping, when 1 bounds nothing yet; [`GamutMapper`] is for colours as they are shown.
pub fn without_negatives(space: &RgbSpace, rgb: LinearRgb) -> LinearRgb {
    let lowest = rgb.0.min_element();
    if lowest >= 0.0 {
        return rgb;
    }
    let luminance = space.xyz_from_rgb.row(1).dot(rgb.0);
    if luminance <= 0.0 {
        return LinearRgb(rgb.0.max(DVec3::ZERO));
    }
    let inside = DVec3::splat(luminance) + (rgb.0 - luminance) * (luminance / (luminance - lowest));
    LinearRgb(inside.max(DVec3::ZERO))
}

/// A gamut mapping into one space.
#[derive(Debug, Clone, PartialEq)]
pub struct GamutMapper {
    method: GamutMethod,
    cone_from_rgb: DMat3,
    rgb_from_cone: DMat3,
    notch: Notch,
}

/// How far below 0 red may be near blue: the smaller of κ green and μ (blue − ν green).
#[derive(Debug, Clone, Copy, PartialEq)]
struct Notch {
    kappa: f64,
    mu: f64,
}

/// ν of [`Notch`].
const NU: f64 = 2.0;
/// Green over blue where both bounds of [`Notch`] are equal: the filled notch is deepest there.
const DEEPEST: f64 = 0.0185;
/// κ over what makes red + κ green stationary along the ray at blue.
const MARGIN: f64 = 1.02;

impl Notch {
    fn new(cone_from_rgb: DMat3, rgb_from_cone: DMat3) -> Self {
        let roots = cone_from_rgb.col(2).map(math::cbrt);
        let along_ray = rgb_from_cone * (roots * roots * (roots - lightness(roots)));
        let ratio = along_ray.x / -along_ray.y;
        let kappa = if along_ray.y < 0.0 && ratio > 0.0 { MARGIN * ratio } else { 0.0 };
        Self { kappa, mu: kappa * DEEPEST / (1.0 - NU * DEEPEST) }
    }

    /// The faces red + κ green = 0 and red + μ (blue − ν green) = 0.
    fn faces(self) -> [DVec3; 2] {
        [DVec3::new(1.0, self.kappa, 0.0), DVec3::new(1.0, -NU * self.mu, self.mu)]
    }

    fn holds(self, rgb: DVec3) -> bool {
        let allowed = (self.kappa * rgb.y).min((self.mu * (rgb.z - NU * rgb.y)).max(0.0));
        rgb.x + allowed >= 0.0 && rgb.y >= 0.0 && rgb.z >= 0.0 && rgb.max_element() <= 1.0
    }
}

/// Lightness from cube roots of cone responses.
fn lightness(roots: DVec3) -> f64 {
    ROOTS_FROM_LAB.inverse().row(0).dot(roots)
}

/// Oklab to cube roots of cone responses. Its first column is exactly 1, which makes greys exactly neutral.
const ROOTS_FROM_LAB: DMat3 = DMat3::from_cols(
    DVec3::new(1.0, 1.0, 1.0),
    DVec3::new(0.396_337_777_4, -0.105_561_345_8, -0.089_484_177_5),
    DVec3::new(0.215_803_757_3, -0.063_854_172_8, -1.291_485_548_0),
);

impl GamutMapper {
    /// A mapping into the gamut of a space.
    pub fn new(space: &RgbSpace, method: GamutMethod) -> Self {
        let adapted = bradford(space.white_xyz(), xyz_from_xy(RgbSpace::srgb().white));
        let cone_from_rgb = OKLAB_CONES_FROM_XYZ * adapted * space.xyz_from_rgb;
        let white = cone_from_rgb * DVec3::ONE;
        let cone_from_rgb = DMat3::from_diagonal(white.recip()) * cone_from_rgb;
        let rgb_from_cone = cone_from_rgb.inverse();
        Self { method, cone_from_rgb, rgb_from_cone, notch: Notch::new(cone_from_rgb, rgb_from_cone) }
    }

    /// The colour in gamut, components in [0, 1].
    ///
    /// Components that are not finite cannot be mapped: such colours come back as they are.
    pub fn map(&self, rgb: LinearRgb) -> LinearRgb {
        if !rgb.0.is_finite() || excess(rgb) == 0.0 {
            return rgb;
        }
        match self.method {
            GamutMethod::Clip => LinearRgb(rgb.0.clamp(DVec3::ZERO, DVec3::ONE)),
            GamutMethod::Desaturate => self.desaturate(rgb),
        }
    }

    fn desaturate(&self, rgb: LinearRgb) -> LinearRgb {
        let roots = (self.cone_from_rgb * rgb.0).map(math::cbrt);
        let lightness = lightness(roots);
        if lightness >= 1.0 {
            return LinearRgb(DVec3::ONE);
        }
        if lightness <= 0.0 {
            return LinearRgb(DVec3::ZERO);
        }
        // Components are R (L + t d)³ with d the part of the roots that is not lightness; R takes 1 to 1.
        let d = roots - lightness;
        let components = [
            DVec3::splat(lightness * lightness * lightness),
            self.rgb_from_cone * (3.0 * lightness * lightness * d),
            self.rgb_from_cone * (3.0 * lightness * d * d),
            self.rgb_from_cone * (d * d * d),
        ];
        let inside = eval(components, largest_inside(components, self.notch));
        LinearRgb(inside.clamp(DVec3::ZERO, DVec3::ONE))
    }
}

/// Three cubic polynomials at t.
fn eval(cubics: [DVec3; 4], t: f64) -> DVec3 {
    cubics[0] + t * (cubics[1] + t * (cubics[2] + t * cubics[3]))
}

/// The largest t in [0, 1] at which the polynomials are in gamut, as they are at 0.
fn largest_inside(cubics: [DVec3; 4], notch: Notch) -> f64 {
    let mut crossings = vec![1.0, 0.0];
    let [tilted, bent] = notch.faces();
    let faces = [(DVec3::X, 0.0), (DVec3::Y, 0.0), (DVec3::Z, 0.0), (tilted, 0.0), (bent, 0.0)];
    for (face, bound) in faces.into_iter().chain([DVec3::X, DVec3::Y, DVec3::Z].map(|axis| (axis, 1.0))) {
        let [c0, c1, c2, c3] = cubics.map(|c| face.dot(c));
        push_roots([c0 - bound, c1, c2, c3], &mut crossings);
    }
    crossings.sort_by(|a, b| b.total_cmp(a));
    let inside = |t| notch.holds(eval(cubics, t));
    let found = crossings.windows(2).find(|pair| inside(0.5 * (pair[0] + pair[1])));
    found.map_or(0.0, |pair| pair[0])
}

/// Adds the roots of a cubic polynomial in (0, 1).
fn push_roots(cubic: [f64; 4], roots: &mut Vec<f64>) {
    let value = |t: f64| cubic[0] + t * (cubic[1] + t * (cubic[2] + t * cubic[3]));
    // Between 0, the points where it turns, and 1 it is monotone.
    let mut from = 0.0;
    for to in turning_points(cubic).into_iter().chain([1.0]) {
        if from < to && to <= 1.0 {
            if (value(from) < 0.0) != (value(to) < 0.0) {
                roots.push(root_between(cubic, from, to));
            }
            from = to;
        }
    }
}

/// Arguments at which the derivative of a cubic polynomial is 0, ascending; NaN for turns that do not exist.
fn turning_points([_, c1, c2, c3]: [f64; 4]) -> [f64; 2] {
    // 3 c₃ t² + 2 c₂ t + c₁, by the form that does not cancel.
    let q = -(c2 + (c2 * c2 - 3.0 * c3 * c1).sqrt().copysign(c2));
    let [a, b] = [q / (3.0 * c3), c1 / q];
    if a < b { [a, b] } else { [b, a] }
}

/// The root of a monotone piece with a change of sign: Newton's steps, halving where they leave the bracket.
fn root_between([c0, c1, c2, c3]: [f64; 4], mut from: f64, mut to: f64) -> f64 {
    let value = |t: f64| c0 + t * (c1 + t * (c2 + t * c3));
    let slope = |t: f64| c1 + t * (2.0 * c2 + t * 3.0 * c3);
    let rises = value(from) < 0.0;
    let mut t = 0.5 * (from + to);
    loop {
        if (value(t) < 0.0) == rises {
            from = t;
        } else {
            to = t;
        }
        let step = t - value(t) / slope(t);
        let next = if from < step && step < to { step } else { 0.5 * (from + to) };
        if next == t || next <= from || next >= to {
            return next;
        }
        t = next;
    }
}

/// How many colours were outside of a gamut, and by how much.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct GamutReport {
    /// Colours counted.
    pub colors: usize,
    /// Colours with a component below 0 or above 1, or one that is not finite.
    pub outside: usize,
    /// Colours with a component below 0: more saturated than the gamut.
    pub below_zero: usize,
    /// Colours with a component above 1: brighter than the gamut.
    pub above_one: usize,
    /// Colours with a component that is not finite; they count in nothing that follows.
    pub not_finite: usize,
    /// The largest [`excess`].
    pub largest_excess: f64,
    /// The sum of all [`excess`]es.
    pub total_excess: f64,
}

impl GamutReport {
    /// Counts a colour.
    pub fn add(&mut self, rgb: LinearRgb) {
        self.colors += 1;
        if !rgb.0.is_finite() {
            self.outside += 1;
            self.not_finite += 1;
            return;
        }
        let excess = excess(rgb);
        self.outside += usize::from(excess > 0.0);
        self.below_zero += usize::from(rgb.0.min_element() < 0.0);
        self.above_one += usize::from(rgb.0.max_element() > 1.0);
        self.largest_excess = self.largest_excess.max(excess);
        self.total_excess += excess;
    }

    /// Counts what another report counted.
    pub fn merge(&mut self, other: &GamutReport) {
        self.colors += other.colors;
        self.outside += other.outside;
        self.below_zero += other.below_zero;
        self.above_one += other.above_one;
        self.not_finite += other.not_finite;
        self.largest_excess = self.largest_excess.max(other.largest_excess);
        self.total_excess += other.total_excess;
    }

    /// Share of the colours that were outside, 0 if there were none at all.
    pub fn share_outside(&self) -> f64 {
        self.outside as f64 / self.colors.max(1) as f64
    }

    /// Mean [`excess`] of the finite colours outside, 0 if there were none.
    pub fn mean_excess(&self) -> f64 {
        self.total_excess / (self.outside - self.not_finite).max(1) as f64
    }
}

impl FromIterator<LinearRgb> for GamutReport {
    fn from_iter<T: IntoIterator<Item = LinearRgb>>(colors: T) -> Self {
        let mut report = Self::default();
        colors.into_iter().for_each(|rgb| report.add(rgb));
        report
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::space::oklab_from_xyz;
    use proptest::prelude::*;

    fn mapper(name: &str) -> GamutMapper {
        GamutMapper::new(RgbSpace::by_name(name).unwrap(), GamutMethod::Desaturate)
    }

    /// Oklab of linear sRGB without the scaling to white; lightness, chroma, hue in degrees.
    fn oklch(rgb: LinearRgb) -> [f64; 3] {
        let lab = oklab_from_xyz(RgbSpace::srgb().xyz_from_linear(rgb));
        [lab.x, (lab.y * lab.y + lab.z * lab.z).sqrt(), math::atan2(lab.z, lab.y).to_degrees()]
    }

    fn hue_difference(a: f64, b: f64) -> f64 {
        let turn = (a - b).rem_euclid(360.0);
        turn.min(360.0 - turn)
    }

    #[test]
    fn oklab_is_anchored_on_every_white() {
        for space in RgbSpace::all() {
            let mapper = GamutMapper::new(space, GamutMethod::Desaturate);
            assert!((mapper.cone_from_rgb * DVec3::ONE - 1.0).abs().max_element() < 1e-14, "{}", space.name);
            assert!((mapper.rgb_from_cone * DVec3::ONE - 1.0).abs().max_element() < 1e-13, "{}", space.name);
        }
    }

    #[test]
    fn colors_in_gamut_stay_bit_for_bit() {
        let mapper = mapper("srgb");
        for i in 0..=1000 {
            let rgb = LinearRgb::new(f64::from(i) / 1000.0, f64::from(i * 7 % 1001) / 1000.0, f64::from(i % 2));
            assert_eq!(mapper.map(rgb), rgb);
        }
    }

    #[test]
    fn light_becomes_white_and_dark_black() {
        let mapper = mapper("srgb");
        assert_eq!(mapper.map(LinearRgb::new(9.0, 9.0, 9.0)), LinearRgb(DVec3::ONE));
        assert_eq!(mapper.map(LinearRgb::new(0.0, 0.0, 1000.0)), LinearRgb(DVec3::ONE));
        assert_eq!(mapper.map(LinearRgb::new(-0.1, -0.2, -0.1)), LinearRgb(DVec3::ZERO));
        for bad in [f64::NAN, f64::INFINITY] {
            assert!(!mapper.map(LinearRgb::new(bad, 0.5, 0.5)).0.is_finite());
        }
    }

    #[test]
    fn negative_components_vanish_at_the_same_luminance() {
        let srgb = RgbSpace::srgb();
        let luminance = |rgb: LinearRgb| srgb.xyz_from_linear(rgb).y;
        let green = LinearRgb::new(-2.0, 5.0, 1.0);
        let found = without_negatives(srgb, green);
        assert!(found.0.x == 0.0 && found.0.y > found.0.z && (luminance(found) - luminance(green)).abs() < 1e-12);
        let bright = LinearRgb::new(0.0, 7.0, 0.5);
        assert_eq!(without_negatives(srgb, bright), bright);
        assert_eq!(without_negatives(srgb, LinearRgb::new(-3.0, -1.0, 2.0)), LinearRgb::new(0.0, 0.0, 2.0));
    }

    /// Display P3 in sRGB: continuous; steepest near blue.
    #[test]
    fn neighbours_stay_neighbours() {
        let mapper = mapper("srgb");
        let into = RgbSpace::srgb().rgb_from(RgbSpace::by_name("display-p3").unwrap(), None);
        let level = |i: usize| i as f64 / 16.0;
        for i in 0..17 * 17 * 17 {
            let p3 = DVec3::new(level(i / 289), level(i / 17 % 17), level(i % 17));
            for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                let [a, b] = [p3, p3 + 1e-6 * axis].map(|rgb| mapper.map(LinearRgb(into * rgb)).0);
                assert!((a - b).abs().max_element() < 1e-3, "{p3} {a} {b}");
            }
        }
    }

    #[test]
    fn only_gamuts_with_a_notch_fill_one() {
        let kappa = |name| mapper(name).notch.kappa;
        assert_eq!([kappa("display-p3"), kappa("adobe-rgb"), kappa("dci-p3")], [0.0; 3]);
        assert!((0.08..0.09).contains(&kappa("srgb")) && (0.055..0.065).contains(&kappa("rec2020")));
        // Blue that rounding has put outside stays blue.
        let blue = mapper("srgb").map(LinearRgb::new(-1e-17, -1e-17, 0.25));
        assert!((blue.0 - DVec3::new(0.0, 0.0, 0.25)).abs().max_element() < 1e-12, "{blue:?}");
    }

    /// The hues near blue are those where the exact gamut is not to be reached continuously: there the step would be 0.06,
    /// and what is left of it is 0.008.
    #[test]
    fn neighbours_stay_neighbours_near_blue() {
        for name in ["srgb", "rec2020"] {
            let mapper = mapper(name);
            for i in 0..20_000 {
                let [red, green] = [i % 200, i / 200].map(|k| 1e-5 * (f64::from(k) - 80.0));
                let blue = DVec3::new(red, green, 0.3);
                let [a, b] = [blue, blue + DVec3::new(1e-7, -1e-7, 1e-7)].map(|rgb| mapper.map(LinearRgb(rgb)).0);
                assert!((a - b).abs().max_element() < 0.01, "{name}: {blue} {a} {b}");
            }
        }
    }

    #[test]
    fn extremes_get_in_too() {
        for rgb in [[1e300, -1e300, 1e300], [-1e300, 1e-300, 1e300], [1e-300, -1e-300, 0.0], [-1e9, 1e9, 0.5]] {
            assert_eq!(excess(mapper("srgb").map(rgb.into())), 0.0, "{rgb:?}");
        }
    }

    #[test]
    fn roots_are_found_where_they_are() {
        // (t − 0.2)(t − 0.5)(t − 0.7), a straight line, a double root, none.
        let roots = |cubic| {
            let mut found = Vec::new();
            push_roots(cubic, &mut found);
            found
        };
        let three = roots([-0.07, 0.59, -1.4, 1.0]);
        assert_eq!(three.len(), 3);
        assert!(three.iter().zip([0.2, 0.5, 0.7]).all(|(t, expected)| (t - expected).abs() < 1e-14), "{three:?}");
        assert_eq!(roots([-0.5, 1.0, 0.0, 0.0]), [0.5]);
        assert_eq!(roots([-0.25, 0.0, 1.0, 0.0]), [0.5]);
        assert!(roots([1.0, 0.0, 0.0, 1.0]).is_empty() && roots([0.3, 0.0, 0.0, 0.0]).is_empty());
    }

    #[test]
    fn a_report_counts_and_adds_up() {
        let colors =
            [[0.5, 0.5, 0.5], [-0.25, 0.5, 0.5], [0.5, 1.5, -0.125], [f64::NAN, 0.0, 0.0]].map(LinearRgb::from);
        let report = GamutReport::from_iter(colors);
        assert_eq!((report.colors, report.outside, report.not_finite), (4, 3, 1));
        assert_eq!((report.below_zero, report.above_one), (2, 1));
        assert_eq!((report.share_outside(), report.largest_excess, report.mean_excess()), (0.75, 0.5, 0.375));
        let mut twice = report;
        twice.merge(&report);
        assert_eq!((twice.colors, twice.outside, twice.mean_excess()), (8, 6, 0.375));
        let none = GamutReport::default();
        assert_eq!((none.share_outside(), none.mean_excess()), (0.0, 0.0));
    }

    #[test]
    fn methods_have_names() {
        assert_eq!(GamutMethod::by_name("clip").unwrap(), GamutMethod::Clip);
        assert_eq!(GamutMethod::by_name("clop").unwrap_err().nearest.as_deref(), Some("clip"));
        let clip = GamutMapper::new(RgbSpace::srgb(), GamutMethod::Clip);
        assert_eq!(clip.map(LinearRgb::new(-1.0, 0.5, 2.0)), LinearRgb::new(0.0, 0.5, 1.0));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn any_color_gets_in_keeps_its_hue_and_stays(rgb in prop::array::uniform3(-2.0..3.0_f64)) {
            let rgb = LinearRgb::from(rgb);
            let mapped = mapper("srgb").map(rgb);
            prop_assert_eq!(excess(mapped), 0.0);
            prop_assert_eq!(mapper("srgb").map(mapped), mapped);
            let (before, after) = (oklch(rgb), oklch(mapped));
            if after[1] > 0.02 {
                prop_assert!(hue_difference(before[2], after[2]) < 0.5, "{before:?} {after:?}");
                prop_assert!((before[0] - after[0]).abs() < 3e-3 && after[1] <= before[1] + 1e-3, "{before:?} {after:?}");
            }
        }

        /// No colour of more chroma on the same ray is in gamut: what is left of the chroma is at its edge.
        #[test]
        fn no_more_chroma_than_necessary_is_lost(rgb in prop::array::uniform3(-0.5..1.5_f64)) {
            let (rgb, mapper) = (LinearRgb::from(rgb), mapper("rec2020"));
            let mapped = mapper.map(rgb);
            let roots = |c: LinearRgb| (mapper.cone_from_rgb * c.0).map(math::cbrt);
            let lightness = lightness(roots(rgb));
            if excess(rgb) > 0.0 && lightness > 0.01 && lightness < 0.99 {
                let (outer, inner) = (roots(rgb), roots(mapped));
                for i in 2..=100 {
                    let more = inner.lerp(outer, f64::from(i) / 100.0);
                    let color = LinearRgb(mapper.rgb_from_cone * (more * more * more));
                    prop_assert!(excess(color) > 0.0, "{color:?}");
                }
            }
        }
    }
}
