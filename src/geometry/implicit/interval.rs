//! Interval arithmetic with outward rounding \[Moore2009\].

use std::ops::{Add, Mul, Sub};

use super::number::{Differentiable, Number};
use crate::math;

/// All numbers from `lo` to `hi`, finite. Every operation returns an interval that holds every exact result of operands
/// taken from the given intervals: ends are widened past the rounding error of f64 and of libm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Lower end.
    pub lo: f64,
    /// Upper end.
    pub hi: f64,
}

/// Relative widening that covers one correctly rounded operation: x (1 − 2⁻⁵²) lies at or below the predecessor of x.
const ROUNDING: f64 = f64::EPSILON;
/// Relative widening that covers a short chain with calls of libm (each below 1 ulp).
const LIBM: f64 = 16.0 * f64::EPSILON;
/// Absolute widening that covers results that underflow, squared ones too: 2⁻⁵⁰⁰.
const TINY: f64 = f64::from_bits((1023 - 500) << 52);

fn below(x: f64) -> f64 {
    x - (x.abs() * ROUNDING + f64::MIN_POSITIVE)
}

fn above(x: f64) -> f64 {
    x + (x.abs() * ROUNDING + f64::MIN_POSITIVE)
}

impl Interval {
    /// Both ends, which must be in order.
    pub fn new(lo: f64, hi: f64) -> Self {
        debug_assert!(lo <= hi || lo.is_nan() || hi.is_nan(), "[{lo}, {hi}]");
        Self { lo, hi }
    }

    /// One number.
    pub fn point(x: f64) -> Self {
        Self { lo: x, hi: x }
    }

    /// +1 or −1 if every number in it has that sign, 0 if it holds 0 (or is not a number).
    pub fn sign(self) -> i32 {
        if self.lo > 0.0 {
            1
        } else if self.hi < 0.0 {
            -1
        } else {
            0
        }
    }

    /// Largest absolute value.
    pub fn magnitude(self) -> f64 {
        self.lo.abs().max(self.hi.abs())
    }

    /// Smallest absolute value.
    pub fn mignitude(self) -> f64 {
        self.lo.max(-self.hi).max(0.0)
    }

    fn widened(lo: f64, hi: f64, relative: f64) -> Self {
        Self::new(lo - (lo.abs() * relative + TINY), hi + (hi.abs() * relative + TINY))
    }

    fn clamped(self, lo: f64, hi: f64) -> Self {
        Self::new(self.lo.clamp(lo, hi), self.hi.clamp(lo, hi))
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(below(self.lo + other.lo), above(self.hi + other.hi))
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(below(self.lo - other.hi), above(self.hi - other.lo))
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (a, b, c, d) = (self.lo * other.lo, self.lo * other.hi, self.hi * other.lo, self.hi * other.hi);
        Self::new(below(a.min(b).min(c.min(d))), above(a.max(b).max(c.max(d))))
    }
}

impl Number for Interval {
    fn scale(self, factor: f64) -> Self {
        let (a, b) = (self.lo * factor, self.hi * factor);
        Self::new(below(a.min(b)), above(a.max(b)))
    }

    fn shift(self, offset: f64) -> Self {
        Self::new(below(self.lo + offset), above(self.hi + offset))
    }

    fn square(self) -> Self {
        let (least, most) = (self.mignitude(), self.magnitude());
        Self::new(below(least * least).max(0.0), above(most * most))
    }

    fn abs(self) -> Self {
        Self::new(self.mignitude(), self.magnitude())
    }

    fn max(self, other: Self) -> Self {
        Self::new(self.lo.max(other.lo), self.hi.max(other.hi))
    }

    /// Monotone between multiples of a quarter turn, so the ends and the extrema in between decide. A multiple that lies
    /// just outside by rounding only widens the result by that rounding.
    fn sin_cos(self) -> (Self, Self) {
        use std::f64::consts::{FRAC_PI_2, TAU};
        let whole = Self::new(-1.0, 1.0);
        if self.hi - self.lo >= TAU {
            return (whole, whole);
        }
        let (sin_lo, cos_lo) = (math::sin(self.lo), math::cos(self.lo));
        let (sin_hi, cos_hi) = (math::sin(self.hi), math::cos(self.hi));
        let mut sin = Self::widened(sin_lo.min(sin_hi), sin_lo.max(sin_hi), LIBM);
        let mut cos = Self::widened(cos_lo.min(cos_hi), cos_lo.max(cos_hi), LIBM);
        let slack = LIBM * (1.0 + self.magnitude());
        let first = (self.lo / FRAC_PI_2 - slack).ceil();
        let last = (self.hi / FRAC_PI_2 + slack).floor();
        let mut quarter = first;
        while quarter <= last {
            match quarter.rem_euclid(4.0) as u8 {
                0 => cos.hi = 1.0,
                1 => sin.hi = 1.0,
                2 => cos.lo = -1.0,
                _ => sin.lo = -1.0,
            }
            quarter += 1.0;
        }
        (sin.clamped(-1.0, 1.0), cos.clamped(-1.0, 1.0))
    }

    /// The norm grows with |a| and with |b|.
    fn norm(self, other: Self, p: f64) -> Self {
        let lo = self.mignitude().norm(other.mignitude(), p);
        let hi = self.magnitude().norm(other.magnitude(), p);
        let widened = Self::widened(lo, hi, LIBM);
        Self::new(widened.lo.max(0.0), widened.hi)
    }

    /// The smooth minimum grows with a and with b.
    fn smooth_min(self, other: Self, width: f64) -> Self {
        let (lo, hi) = (self.lo.smooth_min(other.lo, width), self.hi.smooth_min(other.hi, width));
        let slack = |x: f64, y: f64| LIBM * (x.abs().min(y.abs()) + width) + TINY;
        Self::new(lo - slack(self.lo, other.lo) - LIBM * lo.abs(), hi + slack(self.hi, other.hi) + LIBM * hi.abs())
    }
}

impl Differentiable for Interval {
    fn abs_slope(self) -> Self {
        Self::new(if self.lo > 0.0 { 1.0 } else { -1.0 }, if self.hi < 0.0 { -1.0 } else { 1.0 })
    }

    fn max_slope(self, other: Self) -> Self {
        Self::new(if self.lo > other.hi { 1.0 } else { 0.0 }, if self.hi < other.lo { 0.0 } else { 1.0 })
    }

    /// sign(a) (|a|/norm)^(p−1) grows with a; with |b| its absolute value falls.
    fn norm_slope(self, other: Self, p: f64) -> Self {
        if p == 1.0 {
            return self.abs_slope();
        }
        let (least, most) = (other.mignitude(), other.magnitude());
        let lo = self.lo.norm_slope(if self.lo < 0.0 { least } else { most }, p);
        let hi = self.hi.norm_slope(if self.hi > 0.0 { least } else { most }, p);
        Self::widened(lo, hi, LIBM).clamped(-1.0, 1.0)
    }

    /// The slope falls from 1 to 0 while a − b rises from −k to k.
    fn smooth_min_slope(self, other: Self, width: f64) -> Self {
        let (difference, zero) = (self - other, 0.0);
        let (lo, hi) = (difference.hi.smooth_min_slope(zero, width), difference.lo.smooth_min_slope(zero, width));
        Self::widened(lo, hi, LIBM).clamped(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::super::number::Dual;
    use super::*;
    use proptest::prelude::*;

    /// An interval and two numbers inside; sometimes a point, sometimes with an end at 0.
    fn interval_with_points() -> impl Strategy<Value = (Interval, f64)> {
        let width = prop_oneof![Just(0.0), 1e-12..1e-3f64, 0.0..3.0f64, 0.0..9.0f64];
        let low = prop_oneof![Just(0.0), -8.0..8.0f64, -1e-9..1e-9f64];
        (low, width, prop_oneof![Just(0.0), Just(1.0), 0.0..1.0f64])
            .prop_map(|(lo, width, u)| (Interval::new(lo, lo + width), (lo + width * u).min(lo + width)))
    }

    fn holds(outer: Interval, x: f64) -> bool {
        outer.lo <= x && x <= outer.hi
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]
        #[test]
        fn results_hold_every_value((a, x) in interval_with_points(), (b, y) in interval_with_points(), p in prop_oneof![Just(1.0), Just(2.0), 1.0..20.0f64], k in 0.0..3.0f64) {
            let pairs = [
                (a + b, x + y), (a - b, x - y), (a * b, x * y),
                (a.scale(y), x * y), (a.shift(y), x + y), (a.square(), x * x), (a.abs(), x.abs()),
                (Number::max(a, b), x.max(y)),
                (a.sin_cos().0, math::sin(x)), (a.sin_cos().1, math::cos(x)),
                (a.norm(b, p), x.norm(y, p)), (a.smooth_min(b, k), x.smooth_min(y, k)),
                (a.max_slope(b), x.max_slope(y)), (a.abs_slope(), x.abs_slope()),
                (a.norm_slope(b, p), x.norm_slope(y, p)), (a.smooth_min_slope(b, k), x.smooth_min_slope(y, k)),
            ];
            for (i, (outer, inner)) in pairs.into_iter().enumerate() {
                prop_assert!(holds(outer, inner), "operation {i}: {inner} not in {outer:?} for {a:?} {b:?} {x} {y} {p} {k}");
            }
        }

        #[test]
        fn dual_intervals_hold_the_slope((a, x) in interval_with_points(), c in 0.1..2.0f64) {
            fn f<N: Number>(x: N, c: N) -> N {
                let (sin, cos) = x.sin_cos();
                (sin * cos).shift(0.5).norm(x.square() * c, 3.0).smooth_min(x.abs(), 0.7)
            }
            let outer = f(Dual { value: a, slope: Interval::point(1.0) }, Dual { value: Interval::point(c), slope: Interval::point(0.0) });
            let inner = f(Dual { value: x, slope: 1.0 }, Dual { value: c, slope: 0.0 });
            prop_assert!(holds(outer.value, inner.value) && holds(outer.slope, inner.slope));
        }
    }

    #[test]
    fn rounding_moves_past_the_exact_result() {
        for x in [1.0, 0.1, 1.0 - f64::EPSILON / 2.0, 1e300, 5e-324, 0.0, -3.7] {
            assert!(below(x) <= f64::next_down(x) && above(x) >= f64::next_up(x), "{x}");
        }
    }

    #[test]
    fn narrow_intervals_stay_narrow() {
        let x = Interval::new(0.3, 0.3 + 1e-9);
        for y in [x.sin_cos().0, x.square(), x.norm(x, 3.0), x.smooth_min(x.scale(2.0), 1.0)] {
            assert!(y.hi - y.lo < 3e-9, "{y:?}");
        }
    }
}
