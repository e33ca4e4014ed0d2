//! The first crossing of an implicit surface along a ray: isolated by interval enclosures of the function and of its
//! derivative, then refined in a bracket \[Mitchell1990\].

use glam::DVec3;

use super::interval::Interval;
use super::number::{Dual, Number};

/// A function of space: negative inside the solid, positive outside, continuous, with bounded slopes.
pub trait Field {
    /// Whether it is convex (along every line), which makes Newton's method alone safe.
    const CONVEX: bool = false;
    /// Its value; written once for points, intervals and derivatives.
    fn value<N: Number>(&self, p: [N; 3]) -> N;
}

/// The straight line on which a root is sought.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    pub origin: DVec3,
    pub direction: DVec3,
}

/// Pieces examined before the remaining ones are judged by the signs at their ends alone. Rays that need more than a few
/// hundred run along the surface within rounding error, where either answer is right.
const MAX_PIECES: u32 = 1 << 14;
/// Deepest subdivision: 2⁻⁶⁰ of the range is below the spacing of its numbers.
const MAX_DEPTH: usize = 60;
/// Values and slopes relative to the function's range below which rounding error is looked at: far above f64's, far below
/// what a ray meets often.
const NEARLY_ZERO: f64 = 1.0 / (1u64 << 24) as f64;
/// Newton steps before plain bisection takes over.
const NEWTON_STEPS: u32 = 8;
/// Steps in all: each bisection halves the bracket, and 53 of them reach the spacing of f64.
const MAX_STEPS: u32 = NEWTON_STEPS + 56;

impl Line {
    /// Value and derivative along the line over a range of t.
    fn enclosure<F: Field>(&self, field: &F, t: Interval) -> Dual<Interval> {
        let coordinate = |o: f64, d: f64| Dual { value: t.scale(d).shift(o), slope: Interval::point(d) };
        let (o, d) = (self.origin, self.direction);
        field.value([coordinate(o.x, d.x), coordinate(o.y, d.y), coordinate(o.z, d.z)])
    }

    /// Enclosure of the value at one t: its width is the rounding error.
    fn certain_value<F: Field>(&self, field: &F, t: f64) -> Interval {
        let t = Interval::point(t);
        let coordinate = |o: f64, d: f64| t.scale(d).shift(o);
        let (o, d) = (self.origin, self.direction);
        field.value([coordinate(o.x, d.x), coordinate(o.y, d.y), coordinate(o.z, d.z)])
    }

    /// Value and derivative at one t, in f64.
    fn value<F: Field>(&self, field: &F, t: f64) -> Dual<f64> {
        let p = self.origin + self.direction * t;
        let d = self.direction;
        let coordinate = |value: f64, slope: f64| Dual { value, slope };
        field.value([coordinate(p.x, d.x), coordinate(p.y, d.y), coordinate(p.z, d.z)])
    }
}

/// The gradient at a point.
pub(super) fn gradient<F: Field>(field: &F, p: DVec3) -> DVec3 {
    let along = |axis: DVec3| {
        field.value([
            Dual { value: p.x, slope: axis.x },
            Dual { value: p.y, slope: axis.y },
            Dual { value: p.z, slope: axis.z },
        ])
    };
    DVec3::new(along(DVec3::X).slope, along(DVec3::Y).slope, along(DVec3::Z).slope)
}

/// A place on the line and the function's value there.
#[derive(Clone, Copy)]
struct End {
    t: f64,
    value: Interval,
}

/// The first t in (t0, t1) at which the sign of the function changes for certain, or `None`. A start whose sign is
/// uncertain (within rounding error of the surface) counts as lying on the side that the ray goes to; a touch without
/// a change of sign is no root.
///
/// The line is walked from t0 on. A piece is *settled* when no pair of roots can hide in it: the function excludes 0, or
/// is monotone, or cannot reach 0 from its ends with the slopes enclosed, or is no wider than its rounding error.
/// Otherwise it is halved. A settled piece holds a root just if its ends differ in sign.
pub(super) fn first_root<F: Field>(field: &F, line: &Line, t0: f64, t1: f64) -> Option<f64> {
    if F::CONVEX {
        return first_root_of_convex(field, line, t0, t1);
    }
    let end = |t: f64| End { t, value: line.certain_value(field, t) };
    let mut left = end(t0);
    let mut certain = left;
    let mut rights = [left; MAX_DEPTH];
    rights[0] = end(t1);
    let mut depth = 1;
    let mut pieces = 0;
    while depth > 0 {
        let right = rights[depth - 1];
        pieces += 1;
        let middle = 0.5 * (left.t + right.t);
        let indivisible = middle <= left.t || middle >= right.t || depth == MAX_DEPTH || pieces > MAX_PIECES;
        if !indivisible && !is_settled(field, line, &left, &right) {
            rights[depth] = end(middle);
            depth += 1;
            continue;
        }
        let (before, after) = (certain.value.sign(), right.value.sign());
        if before * after < 0 {
            return Some(refine(field, line, certain.t, right.t, before));
        }
        if after != 0 || before == 0 {
            certain = right;
        }
        left = right;
        depth -= 1;
    }
    None
}

/// The first root of a convex function of about unit slope over the range: the entry if the line starts outside, else the
/// exit. A start within rounding error of the surface counts as lying on the side that the ray goes to.
fn first_root_of_convex<F: Field>(field: &F, line: &Line, t0: f64, t1: f64) -> Option<f64> {
    let start = line.value(field, t0);
    let uncertain = start.value.abs() < NEARLY_ZERO && line.certain_value(field, t0).sign() == 0;
    let outside = if uncertain { start.slope > 0.0 } else { start.value > 0.0 };
    let exit = || root_seen_from(field, line, t1, (t0, t1));
    if !outside {
        return exit().map(|(t, _)| t);
    }
    let (entry, slope) = root_seen_from(field, line, t0, (t0, t1))?;
    // Nearly a touch: a hit only if the function is negative for certain midway to the exit.
    if slope.abs() * (t1 - t0) < NEARLY_ZERO
        && let Some((exit, _)) = exit()
        && line.certain_value(field, 0.5 * (entry + exit)).sign() >= 0
    {
        return None;
    }
    Some(entry)
}

/// The root of a convex function nearest to `from`, an end of the range at which it is positive, and the slope there.
/// Newton's method never steps past it, for a convex function lies above its tangents; where the slope points away from
/// the range there is none.
fn root_seen_from<F: Field>(field: &F, line: &Line, from: f64, (t0, t1): (f64, f64)) -> Option<(f64, f64)> {
    let forward = from == t0;
    let mut t = from;
    for _ in 0..MAX_STEPS {
        let Dual { value, slope } = line.value(field, t);
        if value <= 0.0 {
            // Reached to the last bit; or the whole range is inside.
            return (t != from).then_some((t, slope));
        }
        let next = t - value / slope;
        if (slope < 0.0) != forward || !(t0..=t1).contains(&next) {
            return None;
        }
        if (next - t).abs() <= f64::EPSILON * t.abs() {
            return Some((next, slope));
        }
        t = next;
    }
    None
}

/// Whether the signs at the ends of a piece tell all about its roots.
fn is_settled<F: Field>(field: &F, line: &Line, left: &End, right: &End) -> bool {
    let Dual { value, slope } = line.enclosure(field, Interval::new(left.t, right.t));
    if value.sign() != 0 || slope.sign() != 0 {
        return true;
    }
    let width = right.t - left.t;
    let (a, b) = (left.value, right.value);
    match (a.sign(), b.sign()) {
        (1, 1) => cones_meet_above_zero(a.lo, b.lo, slope.lo, slope.hi, width),
        (-1, -1) => cones_meet_above_zero(-a.hi, -b.hi, -slope.hi, -slope.lo, width),
        // Both ends uncertain and the function flat in between: on the surface as far as f64 can tell.
        (0, 0) => slope.magnitude() * width <= 4.0 * ((a.hi - a.lo) + (b.hi - b.lo)),
        _ => false,
    }
}

/// Whether a function that is at least `a` > 0 and `b` > 0 at the ends of a piece stays positive if its slope lies in
/// [`falling`, `rising`] with `falling` ≤ 0 ≤ `rising`: it lies above a cone from either end.
fn cones_meet_above_zero(a: f64, b: f64, falling: f64, rising: f64, width: f64) -> bool {
    let reach = a * rising - b * falling;
    reach > -falling * rising * width * (1.0 + 8.0 * f64::EPSILON) + reach * 8.0 * f64::EPSILON
}

/// The root in a bracket whose left end has the given sign, to the spacing of f64.
fn refine<F: Field>(field: &F, line: &Line, mut a: f64, mut b: f64, sign: i32) -> f64 {
    let mut t = 0.5 * (a + b);
    for step in 0..MAX_STEPS {
        let Dual { value, slope } = line.value(field, t);
        if value == 0.0 {
            return t;
        }
        if (value > 0.0) == (sign > 0) {
            a = t;
        } else {
            b = t;
        }
        let newton = t - value / slope;
        let next = if step < NEWTON_STEPS && newton > a && newton < b { newton } else { 0.5 * (a + b) };
        if (next - t).abs() <= f64::EPSILON * t.abs() || next <= a || next >= b {
            return next.clamp(a, b);
        }
        t = next;
    }
    t
}

/// How far a point can be from the surface, to first order: the largest value that rounding allows, over the slope.
pub(super) fn distance_bound<F: Field>(field: &F, p: DVec3, gradient_length: f64) -> f64 {
    let value = field.value([Interval::point(p.x), Interval::point(p.y), Interval::point(p.z)]);
    if gradient_length > 0.0 { value.magnitude() / gradient_length } else { 0.0 }
}

/// The value in f64.
pub(super) fn value_at<F: Field>(field: &F, p: DVec3) -> f64 {
    field.value([p.x, p.y, p.z])
}
