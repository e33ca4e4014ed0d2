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
/// ln(1 + x), accurate near 0.
pub fn ln_1p(x: f64) -> f64 {
    libm::log1p(x)
}

/// Cube root, with the sign of x.
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

/// Cube root; that of a negative number is negative.
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

/// Sine and cosine of an f32 angle in radians.
pub fn sin_cos_f32(x: f32) -> (f32, f32) {
    libm::sincosf(x)
}

/// e to the power x in f32.
pub fn exp_f32(x: f32) -> f32 {
    libm::expf(x)
}
