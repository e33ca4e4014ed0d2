//! Lightness from luminance and back, by every formula in use.
//!
//! Luminance Y is relative, 1 for white, and lightness is 0 for black and 100 for white, unless a function says otherwise.

use super::root::increasing_root;
use crate::math;

/// Where the cube root of CIE 1976 gives way to a straight line: (6/29)³ of white's luminance.
pub const CIE_1976_BREAK: f64 = 216.0 / 24_389.0;

/// The function f(t) of CIE 1976 \[CIE15\]: the cube root of a ratio to white, straight below (6/29)³; 16/116 at 0.
///
/// Monotone and continuous; the straight line goes on below 0.
pub fn response_cie_1976(ratio: f64) -> f64 {
    if ratio > CIE_1976_BREAK { math::cbrt(ratio) } else { 841.0 / 108.0 * ratio + 16.0 / 116.0 }
}

/// The ratio to white whose [`response_cie_1976`] is given.
pub fn ratio_cie_1976(response: f64) -> f64 {
    if response > 24.0 / 116.0 { response * response * response } else { (response - 16.0 / 116.0) * (108.0 / 841.0) }
}

/// L\* of CIE 1976 \[CIE15\] from the ratio of luminance to white's; negative for negative luminance.
pub fn lightness_cie_1976(y: f64) -> f64 {
    116.0 * response_cie_1976(y) - 16.0
}

/// Inverse of [`lightness_cie_1976`].
pub fn luminance_cie_1976(lightness: f64) -> f64 {
    ratio_cie_1976((lightness + 16.0) / 116.0)
}

/// Lightness of Glasser and others' cube-root formula \[Glasser1958\] from relative luminance; −18.38 for black, 99.0 for
/// white. Negative luminance keeps its sign under the root.
pub fn lightness_glasser1958(y: f64) -> f64 {
    25.29 * math::cbrt(100.0 * y) - 18.38
}

/// W\* of \[Wyszecki1963\] from relative luminance, meant for 0.01 to 0.98. Negative luminance keeps its sign under the root.
pub fn lightness_wyszecki1963(y: f64) -> f64 {
    25.0 * math::cbrt(100.0 * y) - 17.0
}

/// Inverse of [`lightness_glasser1958`].
pub fn luminance_glasser1958(lightness: f64) -> f64 {
    let root = (lightness + 18.38) / 25.29;
    root * root * root / 100.0
}

/// Inverse of [`lightness_wyszecki1963`].
pub fn luminance_wyszecki1963(lightness: f64) -> f64 {
    let root = (lightness + 17.0) / 25.0;
    root * root * root / 100.0
}

/// Which paper the lightness of the hdr spaces follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HdrEdition {
    /// \[Fairchild2010\]: half of the scale at a luminance of 0.184, maximum 100.
    Fairchild2010,
    /// \[Fairchild2011\]: half of the scale at a luminance of 2, maximum 247 (hdr-CIELAB) or 246 (hdr-IPT).
    Fairchild2011,
}

impl HdrEdition {
    /// Relative luminance at which lightness is half of its maximum.
    fn half_luminance(self) -> f64 {
        match self {
            Self::Fairchild2010 => 0.184,
            Self::Fairchild2011 => 2.0,
        }
    }
}

/// Lightness of the hdr spaces: 0.02 + maximum · Y^ε / (Y^ε + Yₕ^ε), point-symmetric about black for negative Y.
///
/// `exponent` ε is positive; [`super::space::HdrConditions`] gives it. Monotone in Y.
pub fn hdr_lightness(y: f64, exponent: f64, maximum: f64, edition: HdrEdition) -> f64 {
    let power = math::pow(y.abs(), exponent);
    let share = power / (power + math::pow(edition.half_luminance(), exponent));
    0.02 + maximum * share.copysign(y)
}

/// Inverse of [`hdr_lightness`]; infinite or NaN at the maximum and beyond.
pub fn hdr_luminance(lightness: f64, exponent: f64, maximum: f64, edition: HdrEdition) -> f64 {
    let above = lightness - 0.02;
    let odds = above.abs() / (maximum - above.abs());
    (edition.half_luminance() * math::pow(odds, 1.0 / exponent)).copysign(above)
}

/// Lightness of \[Fairchild2010\] with the exponent 1.836 of its average conditions.
pub fn lightness_fairchild2010(y: f64) -> f64 {
    hdr_lightness(y, 1.836, 100.0, HdrEdition::Fairchild2010)
}

/// Inverse of [`lightness_fairchild2010`].
pub fn luminance_fairchild2010(lightness: f64) -> f64 {
    hdr_luminance(lightness, 1.836, 100.0, HdrEdition::Fairchild2010)
}

/// Lightness of \[Fairchild2011\], of hdr-CIELAB with the exponent 0.474 of its average conditions.
pub fn lightness_fairchild2011(y: f64) -> f64 {
    hdr_lightness(y, 0.474, 247.0, HdrEdition::Fairchild2011)
}

/// Inverse of [`lightness_fairchild2011`].
pub fn luminance_fairchild2011(lightness: f64) -> f64 {
    hdr_luminance(lightness, 0.474, 247.0, HdrEdition::Fairchild2011)
}

/// The two curves of \[Abebe2017\].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AbebeCurve {
    /// Saturating, V Yᵉ / (b Yᵉ + K).
    MichaelisMenten,
    /// A power with an offset.
    Stevens,
}

/// V, K, b and exponent of the Michaelis-Menten curve for a white of an absolute luminance.
fn abebe_saturating(white_cd_m2: f64) -> [f64; 4] {
    if white_cd_m2 <= 100.0 { [1.448, 0.635, 0.813, 0.582] } else { [1.680, 1.584, 0.096, 0.293] }
}

/// Factor, offset and exponent of Stevens' curve for a white of an absolute luminance.
fn abebe_power(white_cd_m2: f64) -> [f64; 3] {
    if white_cd_m2 <= 100.0 { [1.226, 0.226, 0.266] } else { [1.127, 0.127, 0.230] }
}

/// Lightness (about 1 for white, not 100) of \[Abebe2017\] from the ratio of luminance to white's and white's absolute
/// luminance, for images of high dynamic range. The parameters change where white exceeds 100 cd/m². Ratios of 0 and more.
pub fn lightness_abebe2017(y: f64, white_cd_m2: f64, curve: AbebeCurve) -> f64 {
    match curve {
        AbebeCurve::MichaelisMenten => {
            let [v, k, b, exponent] = abebe_saturating(white_cd_m2);
            let power = math::pow(y, exponent);
            v * power / (b * power + k)
        }
        AbebeCurve::Stevens => {
            let [factor, offset, exponent] = abebe_power(white_cd_m2);
            factor * math::pow(y, exponent) - offset
        }
    }
}

/// Inverse of [`lightness_abebe2017`]; NaN for lightness that no luminance has.
pub fn luminance_abebe2017(lightness: f64, white_cd_m2: f64, curve: AbebeCurve) -> f64 {
    match curve {
        AbebeCurve::MichaelisMenten => {
            let [v, k, b, exponent] = abebe_saturating(white_cd_m2);
            math::pow(lightness * k / (v - b * lightness), 1.0 / exponent)
        }
        AbebeCurve::Stevens => {
            let [factor, offset, exponent] = abebe_power(white_cd_m2);
            math::pow((lightness + offset) / factor, 1.0 / exponent)
        }
    }
}

/// Coefficients of V, V², … V⁵ that give Y in per cent of magnesium oxide \[Newhall1943\].
const NEWHALL_1943: [f64; 5] = [1.2219, -0.23111, 0.23951, -0.021009, 0.000_840_4];
/// The same coefficients in per cent of the perfect diffuser, 0.975 times as large \[ASTMD1535\].
const ASTM_D1535: [f64; 5] = [1.1914, -0.22533, 0.23352, -0.020484, 0.000_819_39];

/// Value and derivative of a quintic without constant term.
fn quintic(coefficients: [f64; 5], v: f64) -> (f64, f64) {
    let [a, b, c, d, e] = coefficients;
    let value = v * (a + v * (b + v * (c + v * (d + v * e))));
    (value, a + v * (2.0 * b + v * (3.0 * c + v * (4.0 * d + v * 5.0 * e))))
}

/// Luminance, relative to magnesium oxide, of a Munsell value V of 0 to 10 \[Newhall1943\].
pub fn luminance_newhall1943(value: f64) -> f64 {
    quintic(NEWHALL_1943, value).0 / 100.0
}

/// Luminance, relative to the perfect diffuser, of a Munsell value V of 0 to 10 \[ASTMD1535\]; 1 just below V = 10.
pub fn luminance_astm_d1535(value: f64) -> f64 {
    quintic(ASTM_D1535, value).0 / 100.0
}

/// Munsell value V of a luminance, the inverse of [`luminance_astm_d1535`] to rounding; for luminances of V from −1 to 12,
/// NaN outside.
pub fn munsell_value_astm_d1535(y: f64) -> f64 {
    let (low, high) = (-1.0, 12.0);
    let residual = |v| {
        let (value, derivative) = quintic(ASTM_D1535, v);
        (value - 100.0 * y, derivative)
    };
    if residual(low).0 <= 0.0 && residual(high).0 >= 0.0 { increasing_root(low, high, residual) } else { f64::NAN }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn ends_of_the_scales() {
        assert!((lightness_cie_1976(1.0) - 100.0).abs() < 1e-13);
        assert!(lightness_cie_1976(0.0).abs() < 1e-14);
        assert!((lightness_glasser1958(1.0) - 99.01).abs() < 0.01);
        assert!((lightness_wyszecki1963(1.0) - 99.04).abs() < 0.01);
        assert!((lightness_fairchild2010(0.184) - 50.02).abs() < 1e-13);
        assert!((lightness_fairchild2011(2.0) - 123.52).abs() < 1e-13);
        assert!((luminance_astm_d1535(10.0) - 1.0).abs() < 3e-4);
        assert!((luminance_newhall1943(10.0) - 1.0256).abs() < 3e-4);
        for curve in [AbebeCurve::MichaelisMenten, AbebeCurve::Stevens] {
            for white in [50.0, 1000.0] {
                assert!((lightness_abebe2017(1.0, white, curve) - 1.0).abs() < 5e-3);
            }
        }
    }

    #[test]
    fn the_two_branches_of_cie_1976_meet() {
        let step = lightness_cie_1976(CIE_1976_BREAK.next_up()) - lightness_cie_1976(CIE_1976_BREAK);
        assert!(step.abs() < 1e-13, "{step:e}");
        assert!((lightness_cie_1976(CIE_1976_BREAK) - 8.0).abs() < 1e-13);
        assert!(munsell_value_astm_d1535(100.0).is_nan());
        assert_eq!(munsell_value_astm_d1535(0.0), 0.0);
    }

    type Scale = fn(f64) -> f64;
    const PAIRS: [(Scale, Scale); 6] = [
        (lightness_cie_1976, luminance_cie_1976),
        (lightness_glasser1958, luminance_glasser1958),
        (lightness_wyszecki1963, luminance_wyszecki1963),
        (lightness_fairchild2010, luminance_fairchild2010),
        (lightness_fairchild2011, luminance_fairchild2011),
        (munsell_value_astm_d1535, luminance_astm_d1535),
    ];

    proptest! {
        #[test]
        fn inverses_and_monotony(y in 0.0..1.2_f64, step in 1e-9..0.1_f64) {
            for (lightness, luminance) in PAIRS {
                prop_assert!((luminance(lightness(y)) - y).abs() < 1e-13);
                prop_assert!(lightness(y) < lightness(y + step));
            }
            for curve in [AbebeCurve::MichaelisMenten, AbebeCurve::Stevens] {
                for white in [50.0, 1000.0] {
                    let lightness = lightness_abebe2017(y, white, curve);
                    prop_assert!((luminance_abebe2017(lightness, white, curve) - y).abs() < 1e-12);
                    prop_assert!(lightness < lightness_abebe2017(y + step, white, curve));
                }
            }
        }

        #[test]
        fn black_is_a_point_of_symmetry_of_the_hdr_curve(y in 0.0..4.0_f64, exponent in 0.3..2.0_f64) {
            for edition in [HdrEdition::Fairchild2010, HdrEdition::Fairchild2011] {
                let [up, down] = [y, -y].map(|y| hdr_lightness(y, exponent, 247.0, edition));
                prop_assert!((up + down - 0.04).abs() < 1e-13);
            }
        }
    }
}
