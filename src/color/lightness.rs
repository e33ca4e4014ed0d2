//! Lightness from luminance and back, by every formula in use.
//!
//! Luminance Y is relative, 1 for white, and lightness is 0 for black and 100 for white, unless a function says otherwise.

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
