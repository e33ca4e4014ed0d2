//! CIEDE2000.

use super::chroma;
use crate::color::space::hue_degrees;
use crate::math;
use glam::DVec3;
use std::f64::consts::PI;

/// The parametric factors k_L, k_C, k_H of the viewing conditions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parametric {
    /// Divides the lightness difference.
    pub k_l: f64,
    /// Divides the chroma difference.
    pub k_c: f64,
    /// Divides the hue difference.
    pub k_h: f64,
}

impl Parametric {
    /// The reference conditions, 1:1:1.
    pub const REFERENCE: Self = Self { k_l: 1.0, k_c: 1.0, k_h: 1.0 };
    /// Textiles, 2:1:1.
    pub const TEXTILES: Self = Self { k_l: 2.0, ..Self::REFERENCE };
}

/// ΔE00 of two CIE Lab colours under reference conditions \[Sharma2005\]. Symmetric up to rounding.
///
/// The formula itself has three discontinuities, all tiny except for large differences: where the hues are 180° apart the
/// mean hue jumps by 180°; where one colour is exactly grey it has no hue and the mean is the other's, not the limit of
/// nearly grey ones; and ΔΘ meets itself with a step of 1e-52 at 0° = 360°.
pub fn cie2000(lab_1: DVec3, lab_2: DVec3) -> f64 {
    cie2000_weighted(lab_1, lab_2, Parametric::REFERENCE)
}

/// [`cie2000`] with other parametric factors (positive).
pub fn cie2000_weighted(lab_1: DVec3, lab_2: DVec3, parametric: Parametric) -> f64 {
    let terms = terms(lab_1, lab_2);
    let lightness = terms.delta_l / (parametric.k_l * terms.s_l);
    let chroma = terms.delta_c / (parametric.k_c * terms.s_c);
    let hue = terms.delta_h / (parametric.k_h * terms.s_h);
    let sum = lightness * lightness + chroma * chroma + hue * hue + terms.r_t * chroma * hue;
    // |R_T| < 2 makes the form positive definite; rounding may still leave −0.
    sum.max(0.0).sqrt()
}

/// The differences ΔL′, ΔC′, ΔH′ of CIEDE2000, their weights and the rotation term.
pub(super) struct Terms {
    pub delta_l: f64,
    pub delta_c: f64,
    pub delta_h: f64,
    pub s_l: f64,
    pub s_c: f64,
    pub s_h: f64,
    pub r_t: f64,
}

pub(super) fn terms(lab_1: DVec3, lab_2: DVec3) -> Terms {
    let g = 0.5 * (1.0 - seventh_power_share((chroma(lab_1) + chroma(lab_2)) / 2.0));
    let [one, two] = [lab_1, lab_2].map(|lab| DVec3::new(lab.x, (1.0 + g) * lab.y, lab.z));
    let (c_1, c_2) = (chroma(one), chroma(two));
    let (delta_hue, mean_hue) = hues(one, two);
    let mean_c = (c_1 + c_2) / 2.0;
    let t = 1.0 - 0.17 * cosine(mean_hue - 30.0) + 0.24 * cosine(2.0 * mean_hue) + 0.32 * cosine(3.0 * mean_hue + 6.0)
        - 0.20 * cosine(4.0 * mean_hue - 63.0);
    let turn = (mean_hue - 275.0) / 25.0;
    let delta_theta = 30.0 * math::exp(-turn * turn);
    let from_middle = (lab_1.x + lab_2.x) / 2.0 - 50.0;
    let square = from_middle * from_middle;
    Terms {
        delta_l: lab_2.x - lab_1.x,
        delta_c: c_2 - c_1,
        delta_h: 2.0 * (c_1 * c_2).sqrt() * sine(delta_hue / 2.0),
        s_l: 1.0 + 0.015 * square / (20.0 + square).sqrt(),
        s_c: 1.0 + 0.045 * mean_c,
        s_h: 1.0 + 0.015 * mean_c * t,
        r_t: -2.0 * seventh_power_share(mean_c) * sine(2.0 * delta_theta),
    }
}

/// Hue difference, in (−180, 180] or ±180, and mean hue, in [0, 360), both in degrees; a grey has no hue of its own.
fn hues(one: DVec3, two: DVec3) -> (f64, f64) {
    let [h_1, h_2] = [one, two].map(|lab| hue_degrees(lab.y, lab.z));
    let (delta, sum) = (h_2 - h_1, h_1 + h_2);
    if chroma(one) * chroma(two) == 0.0 {
        return (0.0, sum);
    }
    if delta.abs() <= 180.0 {
        return (delta, sum / 2.0);
    }
    let mean = if sum < 360.0 { (sum + 360.0) / 2.0 } else { (sum - 360.0) / 2.0 };
    (delta - 360.0_f64.copysign(delta), mean)
}

/// √(C⁷ / (C⁷ + 25⁷)).
fn seventh_power_share(c: f64) -> f64 {
    let cube = c * c * c;
    let seventh = cube * cube * c;
    (seventh / (seventh + 6_103_515_625.0)).sqrt()
}

fn cosine(degrees: f64) -> f64 {
    math::cos(degrees * (PI / 180.0))
}

fn sine(degrees: f64) -> f64 {
    math::sin(degrees * (PI / 180.0))
}

#[cfg(test)]
mod tests {
    use super::super::tests::lab;
    use super::*;
    use proptest::prelude::*;

    /// The pairs of \[Sharma2005\], table 1: Lab, Lab, ΔE00 to four digits.
    const SHARMA: [([f64; 3], [f64; 3], f64); 34] = [
        ([50.0, 2.6772, -79.7751], [50.0, 0.0, -82.7485], 2.0425),
        ([50.0, 3.1571, -77.2803], [50.0, 0.0, -82.7485], 2.8615),
        ([50.0, 2.8361, -74.0200], [50.0, 0.0, -82.7485], 3.4412),
        ([50.0, -1.3802, -84.2814], [50.0, 0.0, -82.7485], 1.0000),
        ([50.0, -1.1848, -84.8006], [50.0, 0.0, -82.7485], 1.0000),
        ([50.0, -0.9009, -85.5211], [50.0, 0.0, -82.7485], 1.0000),
        ([50.0, 0.0, 0.0], [50.0, -1.0, 2.0], 2.3669),
        ([50.0, -1.0, 2.0], [50.0, 0.0, 0.0], 2.3669),
        ([50.0, 2.4900, -0.0010], [50.0, -2.4900, 0.0009], 7.1792),
        ([50.0, 2.4900, -0.0010], [50.0, -2.4900, 0.0010], 7.1792),
        ([50.0, 2.4900, -0.0010], [50.0, -2.4900, 0.0011], 7.2195),
        ([50.0, 2.4900, -0.0010], [50.0, -2.4900, 0.0012], 7.2195),
        ([50.0, -0.0010, 2.4900], [50.0, 0.0009, -2.4900], 4.8045),
        ([50.0, -0.0010, 2.4900], [50.0, 0.0010, -2.4900], 4.8045),
        ([50.0, -0.0010, 2.4900], [50.0, 0.0011, -2.4900], 4.7461),
        ([50.0, 2.5000, 0.0], [50.0, 0.0, -2.5000], 4.3065),
        ([50.0, 2.5000, 0.0], [73.0, 25.0, -18.0], 27.1492),
        ([50.0, 2.5000, 0.0], [61.0, -5.0, 29.0], 22.8977),
        ([50.0, 2.5000, 0.0], [56.0, -27.0, -3.0], 31.9030),
        ([50.0, 2.5000, 0.0], [58.0, 24.0, 15.0], 19.4535),
        ([50.0, 2.5000, 0.0], [50.0, 3.1736, 0.5854], 1.0000),
        ([50.0, 2.5000, 0.0], [50.0, 3.2972, 0.0], 1.0000),
        ([50.0, 2.5000, 0.0], [50.0, 1.8634, 0.5757], 1.0000),
        ([50.0, 2.5000, 0.0], [50.0, 3.2592, 0.3350], 1.0000),
        ([60.2574, -34.0099, 36.2677], [60.4626, -34.1751, 39.4387], 1.2644),
        ([63.0109, -31.0961, -5.8663], [62.8187, -29.7946, -4.0864], 1.2630),
        ([61.2901, 3.7196, -5.3901], [61.4292, 2.2480, -4.9620], 1.8731),
        ([35.0831, -44.1164, 3.7933], [35.0232, -40.0716, 1.5901], 1.8645),
        ([22.7233, 20.0904, -46.6940], [23.0331, 14.9730, -42.5619], 2.0373),
        ([36.4612, 47.8580, 18.3852], [36.2715, 50.5065, 21.2231], 1.4146),
        ([90.8027, -2.0831, 1.4410], [91.1528, -1.6435, 0.0447], 1.4441),
        ([90.9257, -0.5406, -0.9208], [88.6381, -0.8985, -0.7239], 1.5381),
        ([6.7747, -0.2908, -2.4247], [5.8714, -0.0985, -2.2286], 0.6377),
        ([2.0776, 0.0795, -1.1350], [0.9033, -0.0636, -0.5514], 0.9082),
    ];

    #[test]
    fn the_34_published_pairs_both_ways() {
        for (one, two, expected) in SHARMA {
            let [one, two] = [one, two].map(DVec3::from);
            for value in [cie2000(one, two), cie2000(two, one)] {
                assert!((value - expected).abs() < 5e-5, "{one} {two}: {value}, {expected}");
            }
        }
    }

    #[test]
    fn greys_and_equals() {
        let grey = DVec3::new(50.0, 0.0, 0.0);
        assert_eq!(cie2000(grey, grey), 0.0);
        // S_L is 1 in the middle of the scale.
        assert!((cie2000(DVec3::new(49.0, 0.0, 0.0), DVec3::new(51.0, 0.0, 0.0)) - 2.0).abs() < 1e-14);
        assert_eq!(cie2000_weighted(DVec3::new(49.0, 0.0, 0.0), DVec3::new(51.0, 0.0, 0.0), Parametric::TEXTILES), 1.0);
    }

    #[test]
    fn near_the_grey_axis_it_is_the_distance_in_the_stretched_plane() {
        // G → 1/2: a is stretched by 1.5, and all weights but S_L tend to 1.
        for exponent in [-3, -6, -9, -12] {
            let step = math::pow(10.0, f64::from(exponent));
            let (one, two) = (DVec3::new(50.0, step, -2.0 * step), DVec3::new(50.0, -step, step));
            let expected = math::hypot(2.0 * 1.5 * step, 3.0 * step);
            let value = cie2000(one, two);
            assert!((value / expected - 1.0).abs() < 0.2 * step.max(1e-13), "{step:e}: {value:e} {expected:e}");
        }
    }

    #[test]
    fn hue_wraps_at_a_full_turn() {
        let at = |hue: f64| DVec3::new(50.0, 30.0 * cosine(hue), 30.0 * sine(hue));
        let across = cie2000(at(-0.5), at(0.5));
        let [below, above] = [cie2000(at(-1.5), at(-0.5)), cie2000(at(0.5), at(1.5))];
        assert!(below.min(above) < across && across < below.max(above), "{below} {across} {above}");
    }

    proptest! {
        #[test]
        fn symmetric_and_positive(one in lab(), two in lab()) {
            let (there, back) = (cie2000(one, two), cie2000(two, one));
            prop_assert!((there - back).abs() < 1e-11);
            prop_assert!(there > 0.0);
            prop_assert_eq!(cie2000(one, one), 0.0);
        }
    }
}
