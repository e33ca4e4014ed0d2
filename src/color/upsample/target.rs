//! What the methods solve for: a colour as three sums over the knots of a spectrum.

use crate::color::adaptation::bradford;
use crate::color::integration::{segment_2, segment_3};
use crate::color::{Observer, RgbSpace, illuminant, xyz_of_reflectance};
use crate::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, PiecewiseLinear, Spectrum};
use glam::{DMat3, DVec3};
use std::sync::LazyLock;

/// Knots of upsampled spectra: 360, 361, …, 830 nm.
pub(super) const KNOTS: usize = 471;
/// Every so many knots there is a coarse one: 360, 365, …, 830 nm.
pub(super) const COARSE_STEP: usize = 5;

/// Reflectances under D65. White is that of the integrated table, so that r = 1 is exactly [1, 1, 1].
pub(super) static REFLECTANCE: LazyLock<Target> = LazyLock::new(|| {
    let white = xyz_of_reflectance(&Spectrum::Constant(1.0), illuminant::d65(), Observer::cie_1931_2deg());
    Target::new(white, xyz_weights(illuminant::d65(), Observer::cie_1931_2deg()))
});

/// Emissions. White is that of sRGB, so that [1, 1, 1] of any space develops to sRGB [1, 1, 1].
pub(super) static EMISSION: LazyLock<Target> = LazyLock::new(|| {
    let weights = xyz_weights(&Spectrum::Constant(1.0), Observer::cie_1931_2deg());
    Target::new(RgbSpace::srgb().white_xyz(), weights)
});

/// What a knot's value adds to the colour, in linear RGB of the sRGB primaries adapted to `white`.
pub(super) struct Target {
    /// White that all spaces are adapted to, XYZ.
    pub(super) white: DVec3,
    /// The RGB of `weights` to XYZ.
    pub(super) xyz_from_rgb: DMat3,
    /// XYZ to the RGB of `weights`.
    pub(super) rgb_from_xyz: DMat3,
    /// RGB of a spectrum that is 1 at one knot and 0 at all others, linear between.
    pub(super) weights: Vec<DVec3>,
    /// `weights` for spectra that are linear between coarse knots.
    pub(super) coarse_weights: Vec<DVec3>,
}

impl Target {
    /// Makes a target of the white and the XYZ of a spectrum that is 1 at one knot.
    pub(super) fn new(white: DVec3, xyz_weights: Vec<DVec3>) -> Self {
        let srgb = RgbSpace::srgb();
        let xyz_from_rgb = bradford(srgb.white_xyz(), white) * srgb.xyz_from_rgb;
        let rgb_from_xyz = xyz_from_rgb.inverse();
        let weights: Vec<DVec3> = xyz_weights.into_iter().map(|w| rgb_from_xyz * w).collect();
        let coarse_weights = coarse(&weights);
        Self { white, xyz_from_rgb, rgb_from_xyz, weights, coarse_weights }
    }

    /// Linear RGB of a space to the RGB of `weights`.
    pub(super) fn rgb_from(&self, space: &RgbSpace) -> DMat3 {
        if space == RgbSpace::srgb() {
            return DMat3::IDENTITY;
        }
        self.rgb_from_xyz * bradford(space.white_xyz(), self.white) * space.xyz_from_rgb
    }

    /// The inverse of [`Self::rgb_from`].
    pub(super) fn space_from_rgb(&self, space: &RgbSpace) -> DMat3 {
        if space == RgbSpace::srgb() {
            return DMat3::IDENTITY;
        }
        space.rgb_from_xyz * bradford(self.white, space.white_xyz()) * self.xyz_from_rgb
    }

    /// RGB of a spectrum from its values at the knots.
    pub(super) fn rgb_of(&self, values: &[f64]) -> DVec3 {
        self.weights.iter().zip(values).map(|(&w, &v)| w * v).sum()
    }
}

/// The knots' wavelengths, nm.
pub(super) fn knots_nm() -> Vec<f64> {
    (0..KNOTS).map(|i| LAMBDA_MIN_NM + i as f64).collect()
}

/// Weights of the coarse knots: what is linear between them is so between all knots too.
fn coarse(weights: &[DVec3]) -> Vec<DVec3> {
    let mut coarse = vec![DVec3::ZERO; (KNOTS - 1) / COARSE_STEP + 1];
    for (j, &weight) in weights.iter().enumerate() {
        let (cell, rest) = (j / COARSE_STEP, (j % COARSE_STEP) as f64 / COARSE_STEP as f64);
        coarse[cell] += weight * (1.0 - rest);
        if rest > 0.0 {
            coarse[cell + 1] += weight * rest;
        }
    }
    coarse
}

/// Values at all knots of what is linear between the coarse ones.
pub(super) fn refined(coarse: &[f64]) -> Vec<f64> {
    let value = |j: usize| {
        let (cell, rest) = (j / COARSE_STEP, (j % COARSE_STEP) as f64 / COARSE_STEP as f64);
        coarse.get(cell + 1).map_or(coarse[cell], |right| (1.0 - rest) * coarse[cell] + rest * right)
    };
    (0..KNOTS).map(value).collect()
}

/// The spectrum with these values at the knots.
pub(super) fn spectrum_of(values: Vec<f64>) -> Spectrum {
    Spectrum::PiecewiseLinear(PiecewiseLinear::from_valid_knots(knots_nm(), values))
}

/// XYZ of the tent functions of the knots under an illuminant, by the exact rule; they sum to its white of Y = 1.
pub(super) fn xyz_weights(illuminant: &Spectrum, observer: &Observer) -> Vec<DVec3> {
    let table = illuminant.tabulate();
    let mut weights = vec![DVec3::ZERO; KNOTS];
    for cell in 0..KNOTS - 1 {
        let (from, to) = (LAMBDA_MIN_NM + cell as f64, LAMBDA_MIN_NM + (cell + 1) as f64);
        // The observer is linear inside a cell; the illuminant may have knots there.
        let part = table.restricted(from, to);
        let (knots, lamp) = (part.lambdas_nm(), part.values());
        for (axis, curve) in observer.curves().into_iter().enumerate() {
            let curve = curve.eval_ascending(knots);
            for k in 0..knots.len() - 1 {
                let (lamp, curve) = ([lamp[k], lamp[k + 1]], [curve[k], curve[k + 1]]);
                let right = [knots[k] - from, knots[k + 1] - from];
                let to_right = segment_3(knots[k + 1] - knots[k], lamp, curve, right);
                weights[cell][axis] += segment_2(knots[k + 1] - knots[k], lamp, curve) - to_right;
                weights[cell + 1][axis] += to_right;
            }
        }
    }
    debug_assert_eq!(LAMBDA_MIN_NM + (KNOTS - 1) as f64, LAMBDA_MAX_NM);
    let y_of_white: f64 = weights.iter().map(|w| w.y).sum();
    weights.into_iter().map(|w| w / y_of_white).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_over_knots_are_the_exact_rule() {
        let values: Vec<f64> = (0..KNOTS).map(|j| (j * 37 % 101) as f64 / 100.0).collect();
        let rgb = REFLECTANCE.rgb_of(&values);
        let xyz = xyz_of_reflectance(&spectrum_of(values), illuminant::d65(), Observer::cie_1931_2deg());
        assert!((REFLECTANCE.xyz_from_rgb * rgb - xyz).abs().max_element() < 1e-14);
        assert!((REFLECTANCE.rgb_of(&[1.0; KNOTS]) - 1.0).abs().max_element() < 1e-14);
    }

    #[test]
    fn coarse_knots_have_the_colour_of_what_is_linear_between() {
        let coarse: Vec<f64> = (0..95).map(|j| (j * 37 % 101) as f64 / 100.0).collect();
        let fine = refined(&coarse);
        assert_eq!((fine[0], fine[5], fine[470]), (coarse[0], coarse[1], coarse[94]));
        let sum: DVec3 = REFLECTANCE.coarse_weights.iter().zip(&coarse).map(|(&w, &v)| w * v).sum();
        assert!((REFLECTANCE.rgb_of(&fine) - sum).abs().max_element() < 1e-14);
    }

    #[test]
    fn spaces_convert_there_and_back() {
        for target in [&*REFLECTANCE, &*EMISSION] {
            for space in RgbSpace::all() {
                let both = target.space_from_rgb(space) * target.rgb_from(space);
                assert!(both.abs_diff_eq(DMat3::IDENTITY, 1e-13), "{}: {both}", space.name);
                let white = target.rgb_from(space) * DVec3::ONE;
                assert!((white - 1.0).abs().max_element() < 1e-14, "{}: {white}", space.name);
            }
        }
    }
}
