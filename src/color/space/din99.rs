//! DIN99 and its refinements: Lab with its axes turned and chroma compressed, so that plain distances serve.

use crate::math;
use glam::DVec3;
use std::f64::consts::PI;

/// A formula of the family.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Din99 {
    /// DIN 6176, also of ASTM D2244-07 \[DIN6176\].
    Standard,
    /// DIN99b \[Cui2002\].
    B,
    /// DIN99c \[Cui2002\]. The paper computes its Lab from X′ = 1.1 X − 0.1 Z in place of X; here Lab is taken as given.
    C,
    /// DIN99d \[Cui2002\]. The paper computes its Lab from X′ = 1.12 X − 0.12 Z in place of X; here Lab is taken as given.
    D,
}

/// The parametric factors of the viewing conditions: 1 and 1, or 2 and 0.5 for textiles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Din99Factors {
    /// Divides lightness, and chroma together with `k_ch`.
    pub k_e: f64,
    /// Divides chroma.
    pub k_ch: f64,
}

impl Din99Factors {
    /// Reference conditions.
    pub const REFERENCE: Self = Self { k_e: 1.0, k_ch: 1.0 };
    /// Textiles.
    pub const TEXTILES: Self = Self { k_e: 2.0, k_ch: 0.5 };
}

struct Coefficients {
    lightness_scale: f64,
    lightness_rate: f64,
    /// Angle by which the axes turn before the yellow-blue axis is scaled.
    turn_degrees: f64,
    yellow_blue: f64,
    chroma_scale: f64,
    chroma_rate: f64,
    /// Angle that is added to hue in the end.
    hue_degrees: f64,
}

impl Din99 {
    fn coefficients(self) -> Coefficients {
        let [lightness_scale, lightness_rate, turn_degrees, yellow_blue, chroma_scale, chroma_rate, hue_degrees] =
            match self {
                Self::Standard => [105.509, 0.0158, 16.0, 0.7, 1.0 / 0.045, 0.045, 0.0],
                Self::B => [303.67, 0.0039, 26.0, 0.83, 23.0, 0.075, 26.0],
                Self::C => [317.65, 0.0037, 0.0, 0.94, 23.0, 0.066, 0.0],
                Self::D => [325.22, 0.0036, 50.0, 1.14, 22.5, 0.06, 50.0],
            };
        Coefficients {
            lightness_scale,
            lightness_rate,
            turn_degrees,
            yellow_blue,
            chroma_scale,
            chroma_rate,
            hue_degrees,
        }
    }
}

/// (x, y) turned by an angle in degrees.
fn turned(x: f64, y: f64, degrees: f64) -> (f64, f64) {
    let angle = degrees * (PI / 180.0);
    let (sin, cos) = (math::sin(angle), math::cos(angle));
    (cos * x - sin * y, sin * x + cos * y)
}

/// L99, a99, b99 of CIE Lab; white is (100, 0, 0) within the digits of the coefficients, black (0, 0, 0).
///
/// Defined for L\* above −1 / `lightness_rate`, that is −63 and lower; NaN below.
pub fn din99_from_lab(lab: DVec3, formula: Din99, factors: Din99Factors) -> DVec3 {
    let c = formula.coefficients();
    let (red_green, yellow_blue) = turned(lab.y, lab.z, -c.turn_degrees);
    let yellow_blue = c.yellow_blue * yellow_blue;
    let lightness = c.lightness_scale * math::ln_1p(c.lightness_rate * lab.x) / factors.k_e;
    let radius = math::hypot(red_green, yellow_blue);
    if radius == 0.0 {
        return DVec3::new(lightness, 0.0, 0.0);
    }
    let chroma = c.chroma_scale * math::ln_1p(c.chroma_rate * radius) / (factors.k_ch * factors.k_e);
    let (a, b) = turned(red_green / radius, yellow_blue / radius, c.hue_degrees);
    DVec3::new(lightness, chroma * a, chroma * b)
}

/// Inverse of [`din99_from_lab`].
pub fn lab_from_din99(din99: DVec3, formula: Din99, factors: Din99Factors) -> DVec3 {
    let c = formula.coefficients();
    let lightness = math::exp_m1(din99.x * factors.k_e / c.lightness_scale) / c.lightness_rate;
    let chroma = math::hypot(din99.y, din99.z);
    if chroma == 0.0 {
        return DVec3::new(lightness, 0.0, 0.0);
    }
    let radius = math::exp_m1(chroma * factors.k_ch * factors.k_e / c.chroma_scale) / c.chroma_rate;
    let (red_green, yellow_blue) = turned(din99.y / chroma, din99.z / chroma, -c.hue_degrees);
    let (a, b) = turned(radius * red_green, radius * yellow_blue / c.yellow_blue, c.turn_degrees);
    DVec3::new(lightness, a, b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const ALL: [Din99; 4] = [Din99::Standard, Din99::B, Din99::C, Din99::D];

    #[test]
    fn white_and_black() {
        for formula in ALL {
            let white = din99_from_lab(DVec3::new(100.0, 0.0, 0.0), formula, Din99Factors::REFERENCE);
            assert!((white - DVec3::new(100.0, 0.0, 0.0)).abs().max_element() < 0.02, "{formula:?}: {white}");
            assert_eq!(din99_from_lab(DVec3::ZERO, formula, Din99Factors::TEXTILES), DVec3::ZERO);
            assert_eq!(lab_from_din99(DVec3::ZERO, formula, Din99Factors::TEXTILES), DVec3::ZERO);
        }
    }

    #[test]
    fn textiles_halve_lightness_and_keep_chroma() {
        let lab = DVec3::new(60.0, 20.0, -30.0);
        let [reference, textiles] =
            [Din99Factors::REFERENCE, Din99Factors::TEXTILES].map(|f| din99_from_lab(lab, Din99::Standard, f));
        assert_eq!(textiles.x, reference.x / 2.0);
        assert_eq!((textiles.y, textiles.z), (reference.y, reference.z));
    }

    proptest! {
        #[test]
        fn round_trips(l in 0.0..150.0_f64, a in -150.0..150.0_f64, b in -150.0..150.0_f64) {
            let lab = DVec3::new(l, a, b);
            for formula in ALL {
                for factors in [Din99Factors::REFERENCE, Din99Factors::TEXTILES] {
                    let back = lab_from_din99(din99_from_lab(lab, formula, factors), formula, factors);
                    prop_assert!((back - lab).abs().max_element() < 1e-11, "{formula:?}: {back} {lab}");
                }
            }
        }

        #[test]
        fn lightness_is_monotone(l in -20.0..100.0_f64, step in 1e-9..10.0_f64) {
            for formula in ALL {
                let [low, high] = [l, l + step].map(|l| din99_from_lab(DVec3::new(l, 0.0, 0.0), formula, Din99Factors::REFERENCE).x);
                prop_assert!(low < high);
            }
        }
    }
}
