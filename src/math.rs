//! Transcendental functions with the same bits on every processor, and rounding-error bounds.
//!
//! The platform's `sin`, `exp`, `ln`, … change their last bits with the processor's features, so everything that can
//! reach a pixel goes through these wrappers over the `libm` crate (clippy forbids the others). Square roots, sums and
//! products are exactly rounded everywhere and need no wrapper.

/// Bound of the relative error of `n` chained f32 operations: n·u / (1 − n·u) with u = 2⁻²⁴ \[Higham2002\].
pub const fn gamma(n: u32) -> f32 {
    let nu = n as f32 * (f32::EPSILON * 0.5);
    nu / (1.0 - nu)
}

/// Sine of an angle in radians.
pub fn sin(x: f64) -> f64 {
    libm::sin(x)
}

/// Cosine of an angle in radians.
pub fn cos(x: f64) -> f64 {
    libm::cos(x)
}

/// Tangent of an angle in radians.
pub fn tan(x: f64) -> f64 {
    libm::tan(x)
}

/// Arc sine, radians.
pub fn asin(x: f64) -> f64 {
    libm::asin(x)
}

/// Arc cosine, radians.
pub fn acos(x: f64) -> f64 {
    libm::acos(x)
}

/// Angle of the vector (x, y), radians in (−π, π].
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// e to the power x.
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// e to the power x, minus 1, accurate near 0.
pub fn exp_m1(x: f64) -> f64 {
    libm::expm1(x)
}

/// Natural logarithm.
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// Natural logarithm of 1 + x, accurate near 0.
pub fn ln_1p(x: f64) -> f64 {
    libm::log1p(x)
}

/// Logarithm to the base 2.
pub fn log2(x: f64) -> f64 {
    libm::log2(x)
}

/// Logarithm to the base 10.
pub fn log10(x: f64) -> f64 {
    libm::log10(x)
}

/// 2 to the power x.
pub fn exp2(x: f64) -> f64 {
    libm::exp2(x)
}

/// 10 to the power x.
pub fn exp10(x: f64) -> f64 {
    libm::exp10(x)
}

/// Cube root, with the sign of x.
pub fn cbrt(x: f64) -> f64 {
    libm::cbrt(x)
}

/// Length of the vector (x, y), without overflow or underflow on the way.
pub fn hypot(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}

/// x to the power y.
pub fn pow(x: f64, y: f64) -> f64 {
    libm::pow(x, y)
}

/// |x| to the power y with the sign of x: the power mirrored at 0, which has a value for every x.
pub fn signed_pow(x: f64, y: f64) -> f64 {
    pow(x.abs(), y).copysign(x)
}

/// Natural logarithm of the gamma function of x > 0.
pub fn ln_gamma(x: f64) -> f64 {
    libm::lgamma(x)
}

/// Coefficients of sin(πx/4)/x and (cos(πx/4) − 1)/x² in powers of x², minimax on [−1, 1].
const SIN: [f32; 4] = [std::f32::consts::FRAC_PI_4, -0.080_745_37, 0.002_489_872, -3.587_725_6e-5];
const COS: [f32; 4] = [-0.308_425_13, 0.015_854_327, -0.000_325_942, 3.531_334_6e-6];

/// Sine and cosine of an angle in eighths of a turn (45°), in [−1, 1]; errors are below 1e-7. Straight-line code for
/// directions by the million.
#[inline]
pub fn sin_cos_eighth_turns(x: f32) -> (f32, f32) {
    let x2 = x * x;
    let sin = x * (SIN[0] + x2 * (SIN[1] + x2 * (SIN[2] + x2 * SIN[3])));
    let cos = 1.0 + x2 * (COS[0] + x2 * (COS[1] + x2 * (COS[2] + x2 * COS[3])));
    (sin, cos)
}

/// Sine and cosine of an angle in turns, in [−1, 1].
#[inline]
pub fn sin_cos_turns(x: f32) -> (f32, f32) {
    let quarter = (4.0 * x).round();
    let (sin, cos) = sin_cos_eighth_turns(2.0 * (4.0 * x - quarter));
    match quarter as i32 & 3 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// e to the power x in f32.
pub fn exp_f32(x: f32) -> f32 {
    libm::expf(x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_4, TAU};

    #[test]
    fn short_sines_and_cosines() {
        let worst = |pairs: &mut dyn Iterator<Item = ((f32, f32), f64)>| {
            let error =
                |((s, c), x): ((f32, f32), f64)| (f64::from(s) - sin(x)).abs().max((f64::from(c) - cos(x)).abs());
            pairs.map(error).fold(0.0, f64::max)
        };
        let steps = || (-20_000..=20_000).map(|i| i as f32 / 20_000.0);
        let eighths = worst(&mut steps().map(|x| (sin_cos_eighth_turns(x), f64::from(x) * FRAC_PI_4)));
        let turns = worst(&mut steps().map(|x| (sin_cos_turns(x), f64::from(x) * TAU)));
        assert!(eighths < 1e-7 && turns < 1e-7, "{eighths:e} {turns:e}");
        assert_eq!(sin_cos_turns(0.25), (1.0, 0.0));
        assert_eq!(sin_cos_turns(-0.5), (0.0, -1.0));
    }
}
