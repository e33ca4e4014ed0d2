//! Natural reflectances: the smoothest logit of a colour plus what measured reflectances of such colours have in common,
//! moved back to the exact colour by the smoothest change.
//!
//! The common part is a field of curves over CIE Lab, learnt by validation/learn_natural.py from the samples of
//! CIE 224:2017 and from Munsell colours with the reflectances of \[Otsu2018\]. It vanishes for greys, which are constants.
//!
//! A user's own measured spectra can be anchors: each is reproduced at its colour, and what it differs by from the
//! learnt prior fades out over 40 units of CIE Lab around it (interpolation by a compact kernel \[Wendland1995\]).

use super::data::rows;
use super::linear::Cholesky;
use super::smoothest::{Link, solve_curve};
use super::target::{KNOTS, REFLECTANCE, knots_nm, refined, spectrum_of};
use super::{cannot_be_a_reflectance, check_components};
use crate::color::RgbSpace;
use crate::color::space::lab_from_xyz;
use crate::math;
use crate::spectrum::Spectrum;
use crate::{Error, ErrorKind, Result};
use glam::DVec3;
use std::sync::LazyLock;

/// Curves that the field combines.
const CURVES: usize = 12;
/// Standard deviation of the field's Gaussians, units of CIE Lab.
const LENGTH: f64 = 60.0;
/// Chroma within which colours count as nearly grey, units of CIE Lab.
const GREY_WIDTH: f64 = 10.0;
/// Reach of an anchor in units of CIE Lab.
const ANCHOR_REACH: f64 = 40.0;
/// Values of anchors are kept this far from 0 and 1, where no logit is finite.
const ANCHOR_MARGIN: f64 = 1e-6;
/// Most anchors: their equations are solved directly.
const MAX_ANCHORS: usize = 1024;
/// Shares of the field that are tried in turn: next to the limit of what a reflectance can be all of it may be too much.
const SHARES: [f64; 3] = [1.0, 0.5, 0.25];

static PRIOR: LazyLock<Prior> = LazyLock::new(Prior::embedded);

/// The learnt field.
struct Prior {
    /// Centres of Gaussians in CIE Lab, and the amount of each curve there.
    centers: Vec<(DVec3, [f64; CURVES])>,
    /// The curves at the coarse knots.
    curves: Vec<[f64; CURVES]>,
}

impl Prior {
    fn embedded() -> Self {
        let centers = rows::<{ 3 + CURVES }>(include_str!("../../../data/recovery/natural_centers.csv"));
        let split = |row: &[f64; 3 + CURVES]| (DVec3::from_slice(row), std::array::from_fn(|k| row[3 + k]));
        let curves = rows::<{ 1 + CURVES }>(include_str!("../../../data/recovery/natural_curves.csv"));
        Self {
            centers: centers.iter().map(split).collect(),
            curves: curves.iter().map(|row| std::array::from_fn(|k| row[1 + k])).collect(),
        }
    }

    /// What to add to the smoothest logit of a colour, at the coarse knots.
    fn residual(&self, lab: DVec3) -> Vec<f64> {
        let chroma_squared = lab.y * lab.y + lab.z * lab.z;
        let factor = -math::exp_m1(-0.5 * chroma_squared / (GREY_WIDTH * GREY_WIDTH));
        let mut amounts = [0.0; CURVES];
        for (center, weights) in &self.centers {
            let kernel = factor * math::exp(-0.5 * center.distance_squared(lab) / (LENGTH * LENGTH));
            amounts.iter_mut().zip(weights).for_each(|(amount, weight)| *amount += kernel * weight);
        }
        let value = |curves: &[f64; CURVES]| curves.iter().zip(amounts).map(|(curve, amount)| curve * amount).sum();
        self.curves.iter().map(value).collect()
    }
}

/// The method with its anchors, if any.
///
/// ```
/// use abbe::color::{RgbSpace, upsample};
/// use abbe::spectrum::{PiecewiseLinear, Spectrum};
/// let paint = PiecewiseLinear::new(vec![400.0, 550.0, 600.0, 700.0], vec![0.06, 0.08, 0.5, 0.7])?;
/// let paint = Spectrum::PiecewiseLinear(paint);
/// let rgb = upsample::rgb_of_reflectance(&paint, RgbSpace::srgb());
/// let natural = upsample::Natural::with_anchors(&[paint.clone()])?;
/// let same = natural.reflectance(rgb, RgbSpace::srgb())?;
/// assert!((same.eval(570.0) - paint.eval(570.0)).abs() < 1e-9);
/// # Ok::<(), abbe::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Natural {
    anchors: Vec<Anchor>,
}

/// A colour and what its kernel is multiplied by.
#[derive(Debug, Clone)]
struct Anchor {
    lab: DVec3,
    /// At the knots.
    logits: Vec<f64>,
}

impl Natural {
    /// The learnt prior alone.
    pub fn new() -> Self {
        Self::default()
    }

    /// The learnt prior, and measured reflectances that colours like theirs get.
    ///
    /// An anchor is reproduced at whole nanometres; values nearer than 1e-6 to 0 and 1 are moved that far away.
    ///
    /// # Errors
    /// A spectrum outside of [0, 1]; two of the same colour, between which nothing decides; more than 1024.
    pub fn with_anchors(spectra: &[Spectrum]) -> Result<Self> {
        if spectra.len() > MAX_ANCHORS {
            let message = format!("{} anchors; expected at most {MAX_ANCHORS}", spectra.len());
            return Err(Error::new(ErrorKind::LimitExceeded, message));
        }
        let mut anchors = Vec::with_capacity(spectra.len());
        for (index, spectrum) in spectra.iter().enumerate() {
            anchors.push(Self::residual_of_anchor(spectrum).map_err(|e| e.at(format!("anchors[{index}]")))?);
        }
        let kernel = |i: usize, j: usize| wendland(anchors[i].lab.distance(anchors[j].lab) / ANCHOR_REACH);
        let factor = Cholesky::new(anchors.len(), kernel).map_err(|index| {
            let message = "the colour of an earlier anchor; expected anchors of different colours";
            Error::new(ErrorKind::Duplicate, message).at(format!("anchors[{index}]"))
        })?;
        for knot in 0..KNOTS {
            let mut column: Vec<f64> = anchors.iter().map(|anchor| anchor.logits[knot]).collect();
            factor.solve(&mut column);
            anchors.iter_mut().zip(column).for_each(|(anchor, value)| anchor.logits[knot] = value);
        }
        Ok(Self { anchors })
    }

    /// The colour of a measured reflectance, and its logit minus that of the learnt prior.
    fn residual_of_anchor(spectrum: &Spectrum) -> Result<Anchor> {
        let (least, most) = spectrum.range();
        if !(least >= 0.0 && most <= 1.0) {
            let message = format!("values from {least} to {most}; expected a reflectance within [0, 1]");
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        let value = |lambda: f64| spectrum.eval(lambda).clamp(ANCHOR_MARGIN, 1.0 - ANCHOR_MARGIN);
        let values: Vec<f64> = knots_nm().into_iter().map(value).collect();
        let color = REFLECTANCE.rgb_of(&values);
        let prior = base_curve(color).ok_or_else(|| cannot_be_a_reflectance(color.to_array(), "sRGB"))?;
        let logits = values.iter().zip(prior).map(|(&value, prior)| Link::Logistic.inverse(value) - prior).collect();
        Ok(Anchor { lab: lab(color), logits })
    }

    /// The natural reflectance in [0, 1] whose colour under D65 is `rgb` (linear, each in [0, 1]).
    ///
    /// [0, 0, 0] is exactly 0, [1, 1, 1] exactly 1; other greys are constants, unless there are anchors near them.
    ///
    /// # Errors
    /// Those of [`super::reflectance`].
    pub fn reflectance(&self, rgb: [f64; 3], space: &RgbSpace) -> Result<Spectrum> {
        check_components(rgb, 1.0, "reflectance")?;
        let grey = (rgb[0] == rgb[1] && rgb[1] == rgb[2]).then_some(rgb[0]);
        let color = grey.map_or_else(|| REFLECTANCE.rgb_from(space) * DVec3::from(rgb), DVec3::splat);
        self.of_color(color).ok_or_else(|| cannot_be_a_reflectance(rgb, space.name))
    }

    /// The reflectance of linear RGB of the sRGB primaries; `None` if there is none.
    pub(super) fn of_color(&self, color: DVec3) -> Option<Spectrum> {
        let grey = (color.x == color.y && color.y == color.z).then_some(color.x);
        if grey == Some(0.0) || grey == Some(1.0) {
            return grey.map(Spectrum::Constant);
        }
        let lab = lab(color);
        let near = |anchor: &&Anchor| anchor.lab.distance(lab) < ANCHOR_REACH;
        let mut near = self.anchors.iter().filter(near).peekable();
        if near.peek().is_none() {
            return match grey {
                Some(value) => (0.0..=1.0).contains(&value).then_some(Spectrum::Constant(value)),
                None => Some(spectrum_of(Link::Logistic.values(&base_curve(color)?))),
            };
        }
        let mut curve = base_curve(color)?;
        for anchor in near {
            let kernel = wendland(anchor.lab.distance(lab) / ANCHOR_REACH);
            curve.iter_mut().zip(&anchor.logits).for_each(|(z, logit)| *z += kernel * logit);
        }
        let curve = solve_curve(&REFLECTANCE.weights, color, Link::Logistic, Some(&curve))?;
        Some(spectrum_of(Link::Logistic.values(&curve)))
    }
}

/// The logit of a colour without anchors; `None` if it cannot be a reflectance, or is black or white.
pub(super) fn base_curve(color: DVec3) -> Option<Vec<f64>> {
    if color.x == color.y && color.y == color.z {
        return (0.0 < color.x && color.x < 1.0).then(|| vec![Link::Logistic.inverse(color.x); KNOTS]);
    }
    let around = |curve: Vec<f64>| solve_curve(&REFLECTANCE.weights, color, Link::Logistic, Some(&curve));
    // Coarse knots do nearly all of it; next to the limit of what a reflectance can be they miss some colours.
    coarse_curve(color)
        .and_then(|coarse| around(refined(&coarse)))
        .or_else(|| with_residual(&REFLECTANCE.weights, color, &refined(&PRIOR.residual(lab(color)))))
}

/// The logit of a colour that is not grey at the coarse knots; `None` if there is none.
pub(super) fn coarse_curve(color: DVec3) -> Option<Vec<f64>> {
    with_residual(&REFLECTANCE.coarse_weights, color, &PRIOR.residual(lab(color)))
}

/// The smoothest logit plus a residual, or as much of it as there is a solution with.
fn with_residual(weights: &[DVec3], color: DVec3, residual: &[f64]) -> Option<Vec<f64>> {
    let smoothest = solve_curve(weights, color, Link::Logistic, None)?;
    let with_share = |share: f64| {
        let around: Vec<f64> = smoothest.iter().zip(residual).map(|(z, f)| z + share * f).collect();
        solve_curve(weights, color, Link::Logistic, Some(&around))
    };
    SHARES.into_iter().find_map(with_share).or(Some(smoothest))
}

/// CIE Lab under the integrated white of D65, of linear RGB of the sRGB primaries.
fn lab(color: DVec3) -> DVec3 {
    lab_from_xyz(REFLECTANCE.xyz_from_rgb * color, REFLECTANCE.white)
}

/// A positive definite function of the distance in three dimensions that is 0 from 1 on and twice differentiable.
fn wendland(distance: f64) -> f64 {
    let rest = (1.0 - distance).max(0.0);
    rest * rest * (rest * rest) * (4.0 * distance + 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::upsample::{rgb_of_reflectance, smoothest_reflectance};
    use crate::spectrum::PiecewiseLinear;

    fn table(knots: &[(f64, f64)]) -> Spectrum {
        let (lambdas, values) = knots.iter().copied().unzip();
        Spectrum::PiecewiseLinear(PiecewiseLinear::new(lambdas, values).unwrap())
    }

    fn distance(a: &Spectrum, b: &Spectrum) -> f64 {
        knots_nm().into_iter().map(|l| (a.eval(l) - b.eval(l)).abs()).fold(0.0, f64::max)
    }

    fn paints() -> Vec<Spectrum> {
        vec![
            table(&[(380.0, 0.05), (560.0, 0.06), (600.0, 0.6), (720.0, 0.8)]),
            table(&[(380.0, 0.3), (450.0, 0.55), (520.0, 0.2), (700.0, 0.05), (730.0, 0.4)]),
            table(&[(400.0, 0.7), (500.0, 0.72), (700.0, 0.69)]),
            Spectrum::Constant(0.3),
        ]
    }

    #[test]
    fn anchors_are_reproduced_and_neighbours_follow() {
        let natural = Natural::with_anchors(&paints()).unwrap();
        for paint in paints() {
            let rgb = rgb_of_reflectance(&paint, RgbSpace::srgb());
            let got = natural.reflectance(rgb, RgbSpace::srgb()).unwrap();
            assert!(distance(&got, &paint) < 1e-9, "{rgb:?}: {:e}", distance(&got, &paint));
            // A little beside the anchor: nearer to it than the prior, with its own colour.
            let beside = rgb.map(|c| c * 0.98);
            let got = natural.reflectance(beside, RgbSpace::srgb()).unwrap();
            let prior = Natural::new().reflectance(beside, RgbSpace::srgb()).unwrap();
            if distance(&paint, &prior) > 0.05 {
                assert!(distance(&got, &paint) < 0.3 * distance(&paint, &prior), "{rgb:?}");
            }
            let back = DVec3::from(rgb_of_reflectance(&got, RgbSpace::srgb()));
            assert!((back - DVec3::from(beside)).abs().max_element() < 1e-9);
        }
    }

    #[test]
    fn anchors_end_at_their_reach() {
        let natural = Natural::with_anchors(&paints()[..1]).unwrap();
        for rgb in [[0.1, 0.1, 0.6], [0.9; 3], [0.05, 0.5, 0.4], [0.0; 3], [1.0; 3]] {
            let [with, without] =
                [&natural, &Natural::new()].map(|natural| natural.reflectance(rgb, RgbSpace::srgb()).unwrap());
            assert_eq!(with, without, "{rgb:?}");
        }
    }

    #[test]
    fn bad_anchors_are_refused() {
        let same = [table(&[(400.0, 0.2), (700.0, 0.4)]), table(&[(400.0, 0.2), (700.0, 0.4)])];
        let error = Natural::with_anchors(&same).unwrap_err();
        assert_eq!((error.kind, error.place.as_str()), (ErrorKind::Duplicate, "anchors[1]"));
        let error = Natural::with_anchors(&[Spectrum::Constant(0.5), Spectrum::Constant(1.1)]).unwrap_err();
        assert_eq!((error.kind, error.place.as_str()), (ErrorKind::OutOfRange, "anchors[1]"));
        // Black and white paint are no problem.
        Natural::with_anchors(&[Spectrum::Constant(0.0), Spectrum::Constant(1.0)]).unwrap();
    }

    #[test]
    fn the_prior_is_felt_by_colours_and_fades_towards_grey() {
        let differ = |rgb: [f64; 3]| {
            let natural = Natural::new().reflectance(rgb, RgbSpace::srgb()).unwrap();
            distance(&natural, &smoothest_reflectance(rgb, RgbSpace::srgb()).unwrap())
        };
        assert!(differ([0.5, 0.1, 0.08]) > 0.03);
        assert!(differ([0.3, 0.3, 0.3 - 1e-6]) < 1e-6);
    }

    #[test]
    fn compact_kernel() {
        assert_eq!([0.0, 1.0, 2.0].map(wendland), [1.0, 0.0, 0.0]);
        assert!((wendland(0.5) - 3.0 / 16.0).abs() < 1e-15);
    }
}
