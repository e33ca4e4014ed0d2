//! The arithmetic that an implicit surface is written in, so that one formula serves points, intervals and derivatives.

use std::ops::{Add, Mul, Sub};

use crate::math;

/// What the formula of a surface may do with its coordinates. Implemented by `f64` (a point), [`Interval`](super::Interval)
/// (an enclosure over a range) and [`Dual`] of either (value and derivative).
pub trait Number: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// The number times a constant.
    fn scale(self, factor: f64) -> Self;
    /// The number plus a constant.
    fn shift(self, offset: f64) -> Self;
    /// x².
    fn square(self) -> Self;
    /// |x|.
    fn abs(self) -> Self;
    /// The larger of two.
    fn max(self, other: Self) -> Self;
    /// Sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);
    /// (|a|ᵖ + |b|ᵖ)^(1/p) with p ≥ 1: a norm, so it changes no faster than its arguments.
    fn norm(self, other: Self, p: f64) -> Self;
    /// Smooth minimum: min(a, b) − k h³/6 with h = max(1 − |a − b|/k, 0), the cubic polynomial of \[Quilez2013\]. Twice
    /// continuously differentiable, equal to the minimum where |a − b| ≥ `width` k, and never more than k/6 below it.
    fn smooth_min(self, other: Self, width: f64) -> Self;
}

/// The partial derivatives that [`Dual`] needs of the functions of [`Number`].
pub trait Differentiable: Number {
    /// Derivative of |x|.
    fn abs_slope(self) -> Self;
    /// Derivative of max(a, b) by a; that by b is 1 minus it.
    fn max_slope(self, other: Self) -> Self;
    /// Derivative of the p-norm of (a, b) by a.
    fn norm_slope(self, other: Self, p: f64) -> Self;
    /// The p-norm of (a, b) and its derivatives by a and by b.
    fn norm_and_slopes(self, other: Self, p: f64) -> (Self, Self, Self) {
        (self.norm(other, p), self.norm_slope(other, p), other.norm_slope(self, p))
    }
    /// Derivative of the smooth minimum by a; that by b is 1 minus it.
    fn smooth_min_slope(self, other: Self, width: f64) -> Self;
}

impl Number for f64 {
    fn scale(self, factor: f64) -> Self {
        self * factor
    }

    fn shift(self, offset: f64) -> Self {
        self + offset
    }

    fn square(self) -> Self {
        self * self
    }

    fn abs(self) -> Self {
        f64::abs(self)
    }

    fn max(self, other: Self) -> Self {
        f64::max(self, other)
    }

    fn sin_cos(self) -> (Self, Self) {
        (math::sin(self), math::cos(self))
    }

    fn norm(self, other: Self, p: f64) -> Self {
        let (a, b) = (f64::abs(self), f64::abs(other));
        if p == 1.0 {
            a + b
        } else if p == 2.0 {
            (a * a + b * b).sqrt()
        } else {
            let large = a.max(b);
            if large == 0.0 {
                return 0.0;
            }
            large * math::pow(1.0 + math::pow(a.min(b) / large, p), 1.0 / p)
        }
    }

    fn smooth_min(self, other: Self, width: f64) -> Self {
        let least = self.min(other);
        let difference = f64::abs(self - other);
        if difference >= width {
            return least;
        }
        let h = 1.0 - difference / width;
        least - width / 6.0 * (h * h * h)
    }
}

impl Differentiable for f64 {
    fn abs_slope(self) -> Self {
        if self < 0.0 { -1.0 } else { 1.0 }
    }

    fn max_slope(self, other: Self) -> Self {
        if self >= other { 1.0 } else { 0.0 }
    }

    fn norm_slope(self, other: Self, p: f64) -> Self {
        let (a, b) = (f64::abs(self), f64::abs(other));
        if a == 0.0 {
            return 0.0;
        }
        let slope = if p == 1.0 {
            1.0
        } else if p == 2.0 {
            a / (a * a + b * b).sqrt()
        } else {
            math::pow(1.0 + math::pow(b / a, p), (1.0 - p) / p)
        };
        slope.copysign(self)
    }

    /// With r the ratio of the smaller to the larger and s = 1 + rᵖ, everything follows from rᵖ and s^(1/p).
    fn norm_and_slopes(self, other: Self, p: f64) -> (Self, Self, Self) {
        if p == 1.0 || p == 2.0 || (self == 0.0 && other == 0.0) {
            return (self.norm(other, p), self.norm_slope(other, p), other.norm_slope(self, p));
        }
        let (a, b) = (f64::abs(self), f64::abs(other));
        let (large, ratio) = (a.max(b), a.min(b) / a.max(b));
        let power = math::pow(ratio, p);
        let root = math::pow(1.0 + power, 1.0 / p);
        let large_slope = root / (1.0 + power);
        let small_slope = if ratio > 0.0 { power / ratio * large_slope } else { 0.0 };
        let (slope_a, slope_b) = if a >= b { (large_slope, small_slope) } else { (small_slope, large_slope) };
        (large * root, slope_a.copysign(self), slope_b.copysign(other))
    }

    fn smooth_min_slope(self, other: Self, width: f64) -> Self {
        let difference = self - other;
        if difference <= -width {
            return 1.0;
        }
        if difference >= width {
            return 0.0;
        }
        let h = 1.0 - f64::abs(difference) / width;
        0.5 - (0.5 * (1.0 - h * h)).copysign(difference)
    }
}

/// A value and its derivative in one direction: forward differentiation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dual<T> {
    /// Value.
    pub value: T,
    /// Derivative.
    pub slope: T,
}

impl<T: Differentiable> Dual<T> {
    /// a-slope · w + b-slope · (1 − w).
    fn blend(a: T, b: T, weight: T) -> T {
        b + weight * (a - b)
    }
}

impl<T: Differentiable> Add for Dual<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl<T: Differentiable> Sub for Dual<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl<T: Differentiable> Mul for Dual<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self { value: self.value * other.value, slope: self.slope * other.value + self.value * other.slope }
    }
}

impl<T: Differentiable> Number for Dual<T> {
    fn scale(self, factor: f64) -> Self {
        Self { value: self.value.scale(factor), slope: self.slope.scale(factor) }
    }

    fn shift(self, offset: f64) -> Self {
        Self { value: self.value.shift(offset), slope: self.slope }
    }

    fn square(self) -> Self {
        Self { value: self.value.square(), slope: (self.value * self.slope).scale(2.0) }
    }

    fn abs(self) -> Self {
        Self { value: self.value.abs(), slope: self.slope * self.value.abs_slope() }
    }

    fn max(self, other: Self) -> Self {
        let weight = self.value.max_slope(other.value);
        Self { value: self.value.max(other.value), slope: Self::blend(self.slope, other.slope, weight) }
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (Self { value: sin, slope: cos * self.slope }, Self { value: cos, slope: (sin * self.slope).scale(-1.0) })
    }

    fn norm(self, other: Self, p: f64) -> Self {
        let (value, by_self, by_other) = self.value.norm_and_slopes(other.value, p);
        Self { value, slope: self.slope * by_self + other.slope * by_other }
    }

    fn smooth_min(self, other: Self, width: f64) -> Self {
        let weight = self.value.smooth_min_slope(other.value, width);
        Self { value: self.value.smooth_min(other.value, width), slope: Self::blend(self.slope, other.slope, weight) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The derivative of `f` at x by central differences and by `Dual`.
    fn slopes(f: impl Fn(Dual<f64>) -> Dual<f64>, x: f64) -> (f64, f64) {
        let h = 1.0 / 65536.0;
        let at = |x: f64| f(Dual { value: x, slope: 1.0 }).value;
        ((at(x + h) - at(x - h)) / (2.0 * h), f(Dual { value: x, slope: 1.0 }).slope)
    }

    proptest! {
        #[test]
        fn dual_slopes_are_the_derivatives(x in 0.2..2.0f64, y in 0.2..2.0f64, p in 1.0..6.0f64, sign in prop::bool::ANY) {
            let x = if sign { x } else { -x };
            let c = Dual { value: y, slope: 0.0 };
            let functions: [&dyn Fn(Dual<f64>) -> Dual<f64>; 9] = [
                &|v| v.square() * c - v,
                &|v| v.abs().scale(3.0).shift(1.0),
                &|v| v.sin_cos().0,
                &|v| v.sin_cos().1,
                &|v| v.norm(c, p),
                &|v| c.norm(v, p),
                &|v| v.norm(c, 2.0),
                &|v| v.smooth_min(c, 1.7),
                &|v| c.smooth_min(v, 1.7),
            ];
            for f in functions {
                let (numeric, dual) = slopes(f, x);
                prop_assert!((numeric - dual).abs() < 1e-6, "{numeric} {dual}");
            }
        }

        #[test]
        fn smooth_min_lies_within_a_sixth_of_its_width_below_the_minimum(a in -2.0..2.0f64, b in -2.0..2.0f64, k in 0.0..2.0f64) {
            let smooth = a.smooth_min(b, k);
            prop_assert!(smooth <= a.min(b) && smooth >= a.min(b) - k / 6.0 - 1e-15);
            if (a - b).abs() >= k { prop_assert_eq!(smooth, a.min(b)); }
            prop_assert_eq!(smooth, b.smooth_min(a, k));
        }
    }

    proptest! {
        #[test]
        fn norm_slopes_agree_with_their_own_formula(a in -2.0..2.0f64, b in prop_oneof![Just(0.0), -2.0..2.0f64], p in prop_oneof![Just(1.0), Just(2.0), 1.0..20.0f64]) {
            let (value, by_a, by_b) = a.norm_and_slopes(b, p);
            for (x, y) in [(value, a.norm(b, p)), (by_a, a.norm_slope(b, p)), (by_b, b.norm_slope(a, p))] {
                prop_assert!((x - y).abs() < 1e-14, "{x} {y}");
            }
        }
    }

    #[test]
    fn norms_have_their_closed_forms() {
        assert_eq!(3.0f64.norm(-4.0, 2.0), 5.0);
        assert_eq!(3.0f64.norm(-4.0, 1.0), 7.0);
        assert!((3.0f64.norm(4.0, 3.0) - 91f64.cbrt()).abs() < 1e-14);
        assert_eq!(0.0f64.norm(0.0, 3.0), 0.0);
    }
}
