//! OSA-UCS, the uniform colour scales of the Optical Society of America.

use crate::color::root::increasing_root;
use crate::math;
use glam::{DMat3, DVec2, DVec3};
use std::f64::consts::SQRT_2;
use std::sync::LazyLock;

const CONES_FROM_XYZ: DMat3 = DMat3::from_cols(
    DVec3::new(0.7990, -0.4493, -0.1149),
    DVec3::new(0.4194, 1.3265, 0.3394),
    DVec3::new(-0.1648, 0.0927, 0.7170),
);
/// j and g from the cube roots of the responses; the rows add up to 0.
const J_ROW: DVec3 = DVec3::new(1.7, 8.0, -9.7);
const G_ROW: DVec3 = DVec3::new(-13.7, 17.7, -4.0);

static XYZ_FROM_CONES: LazyLock<DMat3> = LazyLock::new(|| CONES_FROM_XYZ.inverse());

/// Luminance in per cent with the Helmholtz-Kohlrausch effect in it, and its gradient by X, Y and Z in per cent.
fn effective_luminance(xyz: DVec3) -> (f64, DVec3) {
    let DVec3 { x, y, z: _ } = xyz;
    let n = xyz.element_sum();
    if n == 0.0 {
        return (0.0, DVec3::ZERO);
    }
    // Y K(x, y) with K a quadratic of the chromaticity: Y q / n², q homogeneous in X, Y and n.
    let q = 4.4934 * x * x + 4.3034 * y * y - 4.276 * x * y - 1.3744 * x * n - 2.5643 * y * n + 1.8103 * n * n;
    let q_x = 8.9868 * x - 4.276 * y - 1.3744 * n;
    let q_y = 8.6068 * y - 4.276 * x - 2.5643 * n;
    let q_n = -1.3744 * x - 2.5643 * y + 3.6206 * n;
    let k = q / (n * n);
    let by_n = y * (q_n / (n * n) - 2.0 * k / n);
    let gradient = DVec3::new(y * q_x / (n * n) + by_n, k + y * q_y / (n * n) + by_n, by_n);
    (y * k, gradient)
}

/// 14.4 + √2 L over 5.9, of the cube root of effective luminance in per cent.
fn lightness_term(root: f64, luminance: f64) -> f64 {
    root - 2.0 / 3.0 + 0.042 * math::cbrt(luminance - 30.0)
}

/// L, j, g of XYZ for a 10° observer under D65 \[MacAdam1974\]: lightness, yellowness, greenness, all 0 for the grey of 30 %.
///
/// Defined by samples of Y from 0.1 to 0.9. Near black it is meaningless: chroma is infinite where effective luminance is
/// 0.003, and 0 for every colour where it is 0.005.
pub fn osa_ucs_from_xyz(xyz: DVec3) -> DVec3 {
    let xyz = 100.0 * xyz;
    let luminance = effective_luminance(xyz).0;
    let root = math::cbrt(luminance);
    let term = lightness_term(root, luminance);
    let chroma = term / (root - 2.0 / 3.0);
    let roots = DVec3::from((CONES_FROM_XYZ * xyz).to_array().map(math::cbrt));
    DVec3::new((5.9 * term - 14.4) / SQRT_2, chroma * J_ROW.dot(roots), chroma * G_ROW.dot(roots))
}

/// Inverse of [`osa_ucs_from_xyz`] for every surface colour of Y from 0.01; NaN where no colour has these coordinates.
///
/// There is no closed form: two roots are found to rounding. Far outside the locus (saturated greens) several XYZ share
/// their coordinates, and the one with the largest responses comes back.
pub fn xyz_from_osa_ucs(ljg: DVec3) -> DVec3 {
    let term = (SQRT_2 * ljg.x + 14.4) / 5.9;
    let root = root_of_luminance(term);
    let opponent = DVec2::new(ljg.y, ljg.z) * ((root - 2.0 / 3.0) / term);
    // With the blue root w, the red one is w + red and the green one w + green.
    let determinant = J_ROW.x * G_ROW.y - J_ROW.y * G_ROW.x;
    let red = (opponent.x * G_ROW.y - opponent.y * J_ROW.y) / determinant;
    let green = (J_ROW.x * opponent.y - G_ROW.x * opponent.x) / determinant;
    responses_with_luminance(DVec3::new(red, green, 0.0), root * root * root)
        .map_or(DVec3::NAN, |cones| *XYZ_FROM_CONES * cones / 100.0)
}

/// The cube root of effective luminance whose [`lightness_term`] is given.
fn root_of_luminance(term: f64) -> f64 {
    // s = ∛(t³ − 30) with t = u − 0.042 s solves s³ + 30 = (u − 0.042 s)³; in s the slope is never 0 nor infinite.
    let u = term + 2.0 / 3.0;
    let residual = |s: f64| {
        let t = u - 0.042 * s;
        (s * s * s + 30.0 - t * t * t, 3.0 * s * s + 0.126 * t * t)
    };
    let bound = 4.0 + 2.0 * u.abs();
    u - 0.042 * increasing_root(-bound, bound, residual)
}

/// The responses whose cube roots are `offsets` plus one number, with an effective luminance in per cent.
fn responses_with_luminance(offsets: DVec3, luminance: f64) -> Option<DVec3> {
    let eval = |w: f64| {
        let roots = offsets + w;
        let (value, gradient) = effective_luminance(*XYZ_FROM_CONES * (roots * roots * roots));
        (value - luminance, gradient.dot(*XYZ_FROM_CONES * (3.0 * roots * roots)))
    };
    let mut w = math::cbrt(luminance).abs() - offsets.min_element();
    for _ in 0..64 {
        if eval(w).0 > 0.0 {
            break;
        }
        w += w.abs();
    }
    // From above the luminance of real colours is increasing and convex, so that Newton's steps only go down.
    for _ in 0..200 {
        let (excess, slope) = eval(w);
        let next = w - excess / slope;
        if !next.is_finite() {
            return None;
        }
        if next >= w {
            return Some((offsets + w) * (offsets + w) * (offsets + w));
        }
        w = next;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Observer, RgbSpace, xyz_from_xy};
    use proptest::prelude::*;

    #[test]
    fn the_middle_grey_is_the_origin() {
        // D65 of the 10° observer at an effective luminance of 30 %.
        let grey = xyz_from_xy([0.31382, 0.33100]);
        let scale = 0.30 / (effective_luminance(100.0 * grey).0 / 100.0);
        let ljg = osa_ucs_from_xyz(grey * scale);
        assert!(ljg.x.abs() < 0.02 && ljg.y.abs() < 0.05 && ljg.z.abs() < 0.05, "{ljg}");
        assert!(osa_ucs_from_xyz(grey * scale * 1.1).x > ljg.x);
    }

    #[test]
    fn the_gradient_is_the_slope() {
        let (xyz, step) = (DVec3::new(20.0, 30.0, 10.0), 1e-5);
        let gradient = effective_luminance(xyz).1;
        for axis in DVec3::AXES {
            let slope =
                (effective_luminance(xyz + step * axis).0 - effective_luminance(xyz - step * axis).0) / (2.0 * step);
            assert!((gradient.dot(axis) - slope).abs() < 1e-8, "{gradient} {slope}");
        }
    }

    #[test]
    fn impossible_coordinates_give_no_number() {
        assert!(xyz_from_osa_ucs(DVec3::new(0.0, f64::INFINITY, 0.0)).is_nan());
        assert!(xyz_from_osa_ucs(DVec3::splat(f64::NAN)).is_nan());
    }

    proptest! {
        #[test]
        fn surface_colors_round_trip(from in 400.0..690.0_f64, width in 5.0..250.0_f64, level in 0.02..1.0_f64, grey in 0.0..1.0_f64) {
            // A narrow or wide band of the spectrum, mixed with white.
            let observer = Observer::cie_1931_2deg();
            let band = (0..250).map(|i| observer.eval(from + f64::from(i) / 250.0 * width)).sum::<DVec3>() * (width / 250.0);
            let white = RgbSpace::srgb().white_xyz();
            let xyz = (band / observer.y_integral()).lerp(white, grey) * level;
            prop_assume!(xyz.y > 0.01);
            let back = xyz_from_osa_ucs(osa_ucs_from_xyz(xyz));
            prop_assert!((back - xyz).abs().max_element() < 1e-11, "{back} {xyz}");
        }
    }
}
