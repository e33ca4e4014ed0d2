//! Optimal colours: the brightest that a surface of a chromaticity can be, MacAdam's limits.
//!
//! Illuminant and observer are linear between their samples, so the colour of a band with ends anywhere has a closed form.
//! The limits are found to rounding instead of by triangulating a sampled surface.

use super::locus::Locus;
use crate::color::integration::{merged_knots, segment_2};
use crate::color::{Observer, chromaticity, xyz_from_xy};
use crate::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, Spectrum};
use crate::{Error, ErrorKind, Result};
use glam::{DMat3, DVec3};

/// Narrowest step of an outer surface, nm.
const STEP_MIN_NM: f64 = 0.5;
/// Bound of the relative error of a limit: what accumulates over the knots, and the gap at which the search ends.
const ROUNDING: f64 = 1e-12;
/// The search needs 32 in the middle and 70 at most, except for one in a thousand next to the white, where it stalls with the
/// limit 1e-7 too high.
const PIVOTS_MAX: usize = 150;

/// A surface that reflects everything in a band and nothing outside, or nothing inside and everything outside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OptimalColor {
    /// Wavelength at which the reflectance steps from 0 to 1, nm.
    pub from_nm: f64,
    /// Wavelength at which it steps from 1 to 0, nm; below `from_nm` for a purple, which reflects both ends of the spectrum.
    pub to_nm: f64,
    /// XYZ under the illuminant; the perfect diffuser has Y = 1.
    pub xyz: DVec3,
}

/// All optimal colours of an illuminant: the Rösch-MacAdam solid's surface.
#[derive(Debug, Clone)]
pub struct OptimalColors {
    locus: Locus,
    lambda_nm: Vec<f64>,
    power: Vec<f64>,
    /// Colour-matching functions at the knots, scaled so that the perfect diffuser has Y = 1.
    response: Vec<DVec3>,
    /// XYZ of everything below each knot.
    cumulative: Vec<DVec3>,
}

impl OptimalColors {
    /// Computes the optimal colours of an illuminant without negative power and with positive luminance, in any unit.
    ///
    /// # Errors
    /// Negative power, or no luminance.
    pub fn new(illuminant: &Spectrum, observer: &Observer) -> Result<Self> {
        let table = illuminant.tabulate();
        if table.min() < 0.0 {
            let message = format!("an illuminant with a power of {}; expected none below 0", table.min());
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        let [x, y, z] = observer.curves();
        let lambda_nm = merged_knots(&[&table, x, y, z], LAMBDA_MIN_NM, LAMBDA_MAX_NM);
        let [power, x, y, z] = [&table, x, y, z].map(|table| table.eval_ascending(&lambda_nm));
        let response: Vec<_> = (0..lambda_nm.len()).map(|i| DVec3::new(x[i], y[i], z[i])).collect();
        let mut colors =
            Self { locus: Locus::new(observer), cumulative: vec![DVec3::ZERO], lambda_nm, power, response };
        for i in 1..colors.lambda_nm.len() {
            let below = colors.cumulative[i - 1] + colors.partial(i - 1, colors.lambda_nm[i]);
            colors.cumulative.push(below);
        }
        let luminance = colors.white().y;
        if !(luminance > 0.0 && (1.0 / luminance).is_finite()) {
            let message = format!("an illuminant of luminance {luminance:e}; expected a positive one");
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        for xyz in colors.response.iter_mut().chain(&mut colors.cumulative) {
            *xyz /= luminance;
        }
        Ok(colors)
    }

    /// XYZ of the perfect diffuser, Y = 1.
    pub fn white(&self) -> DVec3 {
        self.cumulative[self.cumulative.len() - 1]
    }

    /// XYZ of a surface that reflects from one wavelength to another, nm; if the first is the larger, everything but what is
    /// between. Wavelengths are taken to the nearest of 360–830 nm.
    pub fn band(&self, from_nm: f64, to_nm: f64) -> OptimalColor {
        let [from, to] = [from_nm, to_nm].map(|lambda| lambda.clamp(LAMBDA_MIN_NM, LAMBDA_MAX_NM));
        let between = self.below(to) - self.below(from);
        OptimalColor { from_nm: from, to_nm: to, xyz: if from > to { self.white() + between } else { between } }
    }

    /// MacAdam's limit \[MacAdam1935\]: the luminance that no surface of a chromaticity exceeds, whatever its reflectance; 1
    /// for the white. `None` for what is outside the locus or not finite.
    ///
    /// Reflectances of 0 and 1 with two steps reach it where the locus is convex \[Schroedinger1920\]. That of 1931 is not
    /// quite, in the violet and along its straight red end; this counts any number of steps. Within rounding of the locus,
    /// where the limit falls to 0 infinitely steeply, it is a bound that may be some per cent too high.
    pub fn limit(&self, xy: [f64; 2]) -> Option<f64> {
        if !(xy[0].is_finite() && xy[1].is_finite() && self.locus.contains(xy.into())) {
            return None;
        }
        // No luminance can exceed that of the perfect diffuser.
        let target = xyz_from_xy(xy);
        let mut limit = self.white().y;
        let Some(mut corners) = self.first_corners(target) else { return Some(limit) };
        // The target's ray passes a triangle of surface colours. Whatever surface is farthest beyond the triangle's plane
        // bounds the limit, and replaces a corner so that the ray passes the new triangle: the simplex method on the
        // continuum of surfaces.
        for _ in 0..PIVOTS_MAX {
            let shares_from_xyz = corners.inverse();
            let shares = shares_from_xyz * target;
            let normal = shares_from_xyz.transpose() * DVec3::ONE;
            let farthest = self.farthest(normal);
            // A bound for any normal, however badly rounded. Next to the locus it is nearly at right angles to the target, whose
            // own rounding decides then.
            let rounding = 16.0 * f64::EPSILON;
            let reach = normal.dot(farthest) + rounding * normal.abs().dot(farthest.abs());
            let share = normal.dot(target) - rounding * normal.abs().element_sum() * target.max_element();
            if reach.is_nan() || share.is_nan() || share <= 0.0 {
                break;
            }
            let bound = reach / share;
            limit = limit.min(bound);
            if limit * shares.element_sum() <= 1.0 + ROUNDING / 4.0 {
                break;
            }
            let entering = shares_from_xyz * farthest;
            let ratio = |i: usize| if entering[i] > 0.0 { shares[i].max(0.0) / entering[i] } else { f64::INFINITY };
            let leaving = (0..3).min_by(|&i, &j| ratio(i).total_cmp(&ratio(j))).unwrap_or(0);
            *corners.col_mut(leaving) = farthest;
        }
        Some(limit)
    }

    /// The white and two neighbouring corners of the diagram's hull, so dark as not to be beyond any limit, between which a
    /// target's chromaticity is.
    fn first_corners(&self, target: DVec3) -> Option<DMat3> {
        let hull = &self.locus.hull;
        let spectral = |i: usize| {
            let xy = self.locus.xy[hull[i % hull.len()]];
            xy.extend(1.0 - xy.element_sum()) * 1e-9
        };
        let corners = |i: usize| DMat3::from_cols(self.white(), spectral(i), spectral(i + 1));
        (0..hull.len()).map(corners).find(|corners| {
            let shares = corners.inverse() * target;
            shares.is_finite() && shares.min_element() >= 0.0
        })
    }

    /// Whether some surface has this colour under the illuminant: whether it is within MacAdam's limits, black and the limits
    /// (up to 1e-12 of them) included.
    pub fn contains(&self, xyz: DVec3) -> bool {
        if xyz == DVec3::ZERO {
            return true;
        }
        let limit = if xyz.element_sum() > 0.0 { self.limit(chromaticity(xyz)) } else { None };
        limit.is_some_and(|limit| xyz.y <= limit * (1.0 + ROUNDING))
    }

    /// The surface with the largest n·XYZ: reflectance 1 where n·response is positive, else 0.
    fn farthest(&self, normal: DVec3) -> DVec3 {
        let mut xyz = DVec3::ZERO;
        let mut from_nm = LAMBDA_MIN_NM;
        let mut side = self.response[0].dot(normal);
        for (i, response) in self.response.iter().enumerate().skip(1) {
            let next = response.dot(normal);
            if (side > 0.0) != (next > 0.0) {
                let (start, end) = (self.lambda_nm[i - 1], self.lambda_nm[i]);
                let turn_nm = start + (end - start) * (side / (side - next));
                if side > 0.0 {
                    xyz += self.below(turn_nm) - self.below(from_nm);
                }
                from_nm = turn_nm;
            }
            side = next;
        }
        if side > 0.0 { xyz + (self.white() - self.below(from_nm)) } else { xyz }
    }

    /// Black, white, and the optimal colours of every two steps on a grid in nm from 360 nm on: a sampled surface.
    ///
    /// # Errors
    /// Steps that are not from 0.5 nm to half of the range.
    pub fn outer_surface(&self, step_nm: f64) -> Result<Vec<OptimalColor>> {
        let range = LAMBDA_MAX_NM - LAMBDA_MIN_NM;
        let widest = range / 2.0;
        if !(STEP_MIN_NM..=widest).contains(&step_nm) {
            let message = format!("steps of {step_nm} nm; expected {STEP_MIN_NM} to {widest} nm");
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        let count = (range / step_nm).ceil() as usize;
        let at = |i: usize| LAMBDA_MIN_NM + i as f64 * step_nm;
        let bands = (0..count).flat_map(|i| (0..count).filter(move |&j| j != i).map(move |j| (i, j)));
        let mut surface = vec![self.band(LAMBDA_MIN_NM, LAMBDA_MIN_NM), self.band(LAMBDA_MIN_NM, LAMBDA_MAX_NM)];
        surface.extend(bands.map(|(i, j)| self.band(at(i), at(j))));
        Ok(surface)
    }

    /// Index of the knot at or below a wavelength, never the last.
    fn segment(&self, lambda_nm: f64) -> usize {
        let above = self.lambda_nm.partition_point(|&knot| knot <= lambda_nm);
        above.saturating_sub(1).min(self.lambda_nm.len() - 2)
    }

    /// Power and response at a wavelength of a segment.
    fn at(&self, segment: usize, lambda_nm: f64) -> (f64, DVec3) {
        let (from, to) = (self.lambda_nm[segment], self.lambda_nm[segment + 1]);
        let t = (lambda_nm - from) / (to - from);
        let power = self.power[segment] + (self.power[segment + 1] - self.power[segment]) * t;
        (power, self.response[segment].lerp(self.response[segment + 1], t))
    }

    /// XYZ from the start of a segment to a wavelength in it.
    fn partial(&self, segment: usize, lambda_nm: f64) -> DVec3 {
        let (power, response) = self.at(segment, lambda_nm);
        let (length, power) = (lambda_nm - self.lambda_nm[segment], [self.power[segment], power]);
        let axis = |axis: usize| segment_2(length, power, [self.response[segment][axis], response[axis]]);
        DVec3::new(axis(0), axis(1), axis(2))
    }

    /// XYZ of everything below a wavelength.
    fn below(&self, lambda_nm: f64) -> DVec3 {
        let segment = self.segment(lambda_nm);
        self.cumulative[segment] + self.partial(segment, lambda_nm)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::illuminant;
    use proptest::prelude::*;
    use std::sync::LazyLock;

    static D65: LazyLock<OptimalColors> = LazyLock::new(|| of("D65"));

    fn of(name: &str) -> OptimalColors {
        OptimalColors::new(&illuminant::by_name(name).unwrap(), Observer::cie_1931_2deg()).unwrap()
    }

    #[test]
    fn white_is_the_brightest_of_its_chromaticity() {
        for name in ["A", "D65", "FL11", "HP1"] {
            let colors = of(name);
            let limit = colors.limit(chromaticity(colors.white())).unwrap();
            assert!((limit - 1.0).abs() < 1e-14, "{name}: {limit}");
            assert!(colors.contains(colors.white()) && colors.contains(DVec3::ZERO));
            assert!(!colors.contains(colors.white() * 1.000_001));
        }
    }

    #[test]
    fn limits_of_a_linear_program() {
        // Largest luminance of a reflectance in cells of 0.25 nm, solved by an independent package; its cells cost 3e-6. Next
        // to the white, in the green-blue, and on the straight red end of the locus.
        let d65 = [[0.585_121_992_7, 0.414_272_206_1], [0.669_159_401_2, 0.330_590_484_4]];
        for (name, xy, expected) in [
            ("E", [0.332_315_170_9, 0.333_253_185_0], 0.996_800_514),
            ("E", [0.234_545_727_7, 0.317_644_637_9], 0.709_323_403),
            ("FL11", [0.379_525_766_2, 0.376_982_269_3], 0.994_874_289),
            ("LED-RGB1", [0.446_769_925_3, 0.425_485_294_9], 0.973_963_814),
            ("D65", d65[0], 0.339_684_355),
            ("D65", d65[1], 0.203_498_030),
        ] {
            let limit = of(name).limit(xy).unwrap();
            let tolerance = if name == "D65" { 1e-3 } else { 1e-5 };
            assert!((limit / expected - 1.0).abs() < tolerance, "{name} {xy:?}: {limit}");
        }
    }

    #[test]
    fn limits_as_published() {
        // Luminance at chromaticities of optimal colours under D65, tabulated to four digits of x and y.
        for (x, y, limit) in [(0.1346, 0.0747, 0.1), (0.0391, 0.4074, 0.1), (0.0344, 0.7732, 0.1)] {
            let found = D65.limit([x, y]).unwrap();
            assert!((found - limit).abs() < 0.005, "{x} {y}: {found}");
        }
    }

    #[test]
    fn two_steps_where_the_locus_is_convex_and_bounds_everywhere() {
        let surface = D65.outer_surface(23.5).unwrap();
        assert_eq!(surface.len(), 2 + 20 * 19);
        assert_eq!(surface[0].xyz, DVec3::ZERO);
        assert!((surface[1].xyz - D65.white()).abs().max_element() < 1e-15);
        for color in &surface[2..] {
            // Bands at the ends of the spectrum are spectral: their chromaticity may be outside by rounding.
            let Some(limit) = D65.limit(chromaticity(color.xyz)) else { continue };
            assert!(color.xyz.y <= limit * (1.0 + ROUNDING), "{color:?} {limit}");
            let both_in_the_curved_part = [color.from_nm, color.to_nm].iter().all(|l| (460.0..550.0).contains(l));
            if both_in_the_curved_part {
                assert!((color.xyz.y / limit - 1.0).abs() < 1e-6, "{color:?} {limit}");
            }
        }
    }

    #[test]
    fn every_observer_has_limits() {
        for name in Observer::names() {
            let colors = OptimalColors::new(illuminant::d65(), Observer::by_name(name).unwrap()).unwrap();
            let white = chromaticity(colors.white());
            assert!((colors.limit(white).unwrap() - 1.0).abs() < 1e-12, "{name}");
            let band = colors.band(470.0, 540.0);
            let limit = colors.limit(chromaticity(band.xyz)).unwrap();
            assert!((band.xyz.y / limit - 1.0).abs() < 1e-6, "{name}: {band:?} {limit}");
        }
    }

    #[test]
    fn bands_and_what_they_leave_out_make_white() {
        let (band, rest) = (D65.band(480.3, 613.7), D65.band(613.7, 480.3));
        assert!((band.xyz + rest.xyz - D65.white()).abs().max_element() < 1e-15);
        assert!((D65.band(300.0, 900.0).xyz - D65.white()).abs().max_element() < 1e-15);
    }

    #[test]
    fn what_is_no_light_has_no_limit() {
        for xy in [[0.7, 0.7], [0.1, 0.0], [f64::NAN, 0.3], [0.3, f64::INFINITY]] {
            assert_eq!(D65.limit(xy), None);
        }
        for xyz in [DVec3::new(-0.1, 0.1, 0.0), DVec3::NEG_ONE, DVec3::NAN, DVec3::new(0.0, 0.1, 0.0)] {
            assert!(!D65.contains(xyz), "{xyz}");
        }
    }

    #[test]
    fn impossible_illuminants_are_refused() {
        let observer = Observer::cie_1931_2deg();
        for spectrum in [Spectrum::Constant(0.0), Spectrum::Constant(-1.0)] {
            assert_eq!(OptimalColors::new(&spectrum, observer).unwrap_err().kind, ErrorKind::OutOfRange);
        }
        for step in [0.0, -1.0, f64::NAN, 300.0] {
            assert!(D65.outer_surface(step).is_err());
        }
    }

    proptest! {
        #[test]
        fn surfaces_are_within_the_limits(values in prop::collection::vec(0.0..1.0_f64, 2..12)) {
            let count = values.len() as f64 - 1.0;
            let knots = (0..values.len()).map(|i| 380.0 + 350.0 * i as f64 / count).collect();
            let table = crate::spectrum::PiecewiseLinear::new(knots, values).unwrap();
            let (lamp, observer) = (illuminant::d65(), Observer::cie_1931_2deg());
            let xyz = crate::color::xyz_of_reflectance(&Spectrum::PiecewiseLinear(table), lamp, observer);
            prop_assert!(D65.contains(xyz), "{xyz}");
            let limit = D65.limit(chromaticity(xyz)).unwrap();
            prop_assert!(!D65.contains(xyz * (limit / xyz.y * 1.000_001)));
        }

        #[test]
        fn half_way_between_two_colors_of_the_solid_there_is_another(
            from in 380.0..700.0_f64, to in 380.0..700.0_f64, start in 380.0..700.0_f64, end in 380.0..700.0_f64,
        ) {
            prop_assert!(D65.contains(D65.band(from, to).xyz.midpoint(D65.band(start, end).xyz)));
        }
    }
}
