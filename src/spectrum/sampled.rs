//! Values at the wavelengths of a path.

use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Sub};
use wide::f32x8;

/// Wavelengths that a path carries.
pub const LANES: usize = 8;

/// The values of a spectrum at the [`LANES`] wavelengths of a path; the wavelengths themselves travel beside it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SampledSpectrum(f32x8);

impl SampledSpectrum {
    /// The value 0 in every lane.
    pub const ZERO: Self = Self(f32x8::ZERO);
    /// The value 1 in every lane.
    pub const ONE: Self = Self(f32x8::ONE);

    /// Makes a spectrum of the same value in every lane.
    pub fn splat(value: f32) -> Self {
        Self(f32x8::splat(value))
    }

    /// Makes a spectrum of the values of its lanes.
    pub fn new(lanes: [f32; LANES]) -> Self {
        Self(f32x8::new(lanes))
    }

    /// Makes a spectrum by a function of the lane's index.
    pub fn from_fn(f: impl FnMut(usize) -> f32) -> Self {
        Self::new(std::array::from_fn(f))
    }

    /// Values of all lanes.
    pub fn lanes(self) -> [f32; LANES] {
        self.0.to_array()
    }

    /// Value of one lane.
    pub fn lane(self, lane: usize) -> f32 {
        self.0.to_array()[lane]
    }

    /// Keeps the value of one lane and sets the others to 0.
    pub fn only(self, lane: usize) -> Self {
        let lanes = self.lanes();
        Self::from_fn(|k| if k == lane { lanes[k] } else { 0.0 })
    }

    /// Sum of the lanes.
    pub fn sum(self) -> f32 {
        let [a, b, c, d, e, f, g, h] = self.lanes();
        // In pairs: a chain of seven sums would wait for each.
        ((a + e) + (c + g)) + ((b + f) + (d + h))
    }

    /// Mean of the lanes.
    pub fn mean(self) -> f32 {
        self.sum() * (1.0 / LANES as f32)
    }

    /// Largest lane.
    pub fn max(self) -> f32 {
        let [a, b, c, d, e, f, g, h] = self.lanes();
        a.max(e).max(c.max(g)).max(b.max(f).max(d.max(h)))
    }

    /// Whether every lane is 0.
    pub fn is_zero(self) -> bool {
        self.0 == f32x8::ZERO
    }

    /// Whether no lane is NaN or infinite.
    pub fn is_finite(self) -> bool {
        self.lanes().into_iter().all(f32::is_finite)
    }

    /// Sets lanes below the smallest normal number to 0: arithmetic on denormals is slow and loses digits.
    pub fn without_denormals(self) -> Self {
        Self(self.0.simd_lt(f32x8::splat(f32::MIN_POSITIVE)).select(f32x8::ZERO, self.0))
    }
}

impl From<f32x8> for SampledSpectrum {
    fn from(lanes: f32x8) -> Self {
        Self(lanes)
    }
}

impl Add for SampledSpectrum {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Sub for SampledSpectrum {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Mul for SampledSpectrum {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

impl Mul<f32> for SampledSpectrum {
    type Output = Self;
    fn mul(self, factor: f32) -> Self {
        Self(self.0 * f32x8::splat(factor))
    }
}

impl Div for SampledSpectrum {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        Self(self.0 / other.0)
    }
}

impl AddAssign for SampledSpectrum {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl MulAssign for SampledSpectrum {
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl MulAssign<f32> for SampledSpectrum {
    fn mul_assign(&mut self, factor: f32) {
        *self = *self * factor;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lanes_and_denormals() {
        let s = SampledSpectrum::from_fn(|k| k as f32);
        assert_eq!(s.only(3).lanes(), [0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!((s.mean(), s.max(), s.lane(7)), (3.5, 7.0, 7.0));
        let tiny = SampledSpectrum::splat(f32::MIN_POSITIVE / 2.0);
        assert!(!tiny.is_zero() && tiny.without_denormals().is_zero());
        assert_eq!(s.without_denormals(), s);
    }
}
