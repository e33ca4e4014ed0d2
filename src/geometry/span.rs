//! Convex solids as intervals along a line, so that no gap opens where their surfaces meet.

use super::sphere::ball_span;
use glam::DVec3;

/// The face of an interval's end at infinity.
const NOT_HIT: u8 = u8::MAX;

/// A stretch of a line and the surfaces at its ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct Span {
    /// First and last t.
    pub t: [f64; 2],
    /// The surfaces there.
    pub face: [u8; 2],
}

impl Span {
    /// Where h + t · slope ≥ 0.
    pub fn half_space(h: f64, slope: f64, face: u8) -> Option<Self> {
        let root = -h / slope;
        if slope > 0.0 {
            Some(Self { t: [root, f64::INFINITY], face: [face, NOT_HIT] })
        } else if slope < 0.0 {
            Some(Self { t: [f64::NEG_INFINITY, root], face: [NOT_HIT, face] })
        } else {
            (h >= 0.0).then_some(Self { t: [f64::NEG_INFINITY, f64::INFINITY], face: [NOT_HIT; 2] })
        }
    }

    /// Where |o + t d| ≤ 1: between a lower and an upper face.
    pub fn slab(o: f64, d: f64, [lower, upper]: [u8; 2]) -> Option<Self> {
        Some(Self::half_space(1.0 + o, d, lower)?.intersection(&Self::half_space(1.0 - o, -d, upper)?))
    }

    /// Where a line is inside an infinite cylinder; `o` and `d` are without their components along its axis.
    pub fn cylinder(o: DVec3, d: DVec3, radius: f64, face: u8) -> Option<Self> {
        let t = if d == DVec3::ZERO {
            (o.dot(o) <= radius * radius).then_some((f64::NEG_INFINITY, f64::INFINITY))
        } else {
            ball_span(o, d, radius)
        };
        t.map(|(t0, t1)| Self { t: [t0, t1], face: [face; 2] })
    }

    /// The stretch that lies in both; it has no length if `t` does not ascend.
    pub fn intersection(&self, other: &Self) -> Self {
        let (first, last) = (self.t[0] >= other.t[0], self.t[1] <= other.t[1]);
        Self {
            t: [self.t[0].max(other.t[0]), self.t[1].min(other.t[1])],
            face: [if first { self.face[0] } else { other.face[0] }, if last { self.face[1] } else { other.face[1] }],
        }
    }

    /// The shortest stretch that holds both.
    pub fn hull(&self, other: &Self) -> Self {
        let (first, last) = (self.t[0] <= other.t[0], self.t[1] >= other.t[1]);
        Self {
            t: [self.t[0].min(other.t[0]), self.t[1].max(other.t[1])],
            face: [if first { self.face[0] } else { other.face[0] }, if last { self.face[1] } else { other.face[1] }],
        }
    }

    /// The first end in (0, `t_max`) and the surface there, if the stretch has a length.
    pub fn first_end(&self, t_max: f64) -> Option<(f64, u8)> {
        if self.t[0] >= self.t[1] {
            return None;
        }
        let end = usize::from(self.t[0] <= 0.0);
        (self.t[end] > 0.0 && self.t[end] < t_max).then_some((self.t[end], self.face[end]))
    }
}
