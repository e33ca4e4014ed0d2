//! Implicit surfaces: closed solids given by f(p) < 0, intersected without missing a root that can be seen.
//!
//! Each surface writes its function once, generic over [`Number`]. Evaluated on intervals it gives rigorous enclosures of
//! the function and its slope along a piece of a ray, which isolate the first root; evaluated on [`Dual`] numbers it
//! gives Newton's method and the normal.

mod gyroid;
mod interval;
mod number;
mod roots;
mod smooth_union;
mod superquadric;
mod tanglecube;
mod torus;

use glam::DVec3;

pub use gyroid::Gyroid;
pub use interval::Interval;
pub use number::{Differentiable, Dual, Number};
pub use roots::Field;
pub use smooth_union::SmoothUnion;
pub use superquadric::Superquadric;
pub use tanglecube::Tanglecube;
pub use torus::Torus;

use super::analytic::LocalHit;
use crate::{Error, ErrorKind, Result};
use roots::Line;

/// A kind of implicit surface, for listings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ImplicitKind {
    /// Its name in scene files.
    pub name: &'static str,
    /// What it is, in one line.
    pub doc: &'static str,
    /// Names of its parameters and what they mean.
    pub parameters: &'static [(&'static str, &'static str)],
}

/// All kinds of implicit surfaces.
pub const IMPLICIT_KINDS: [ImplicitKind; 5] = [
    ImplicitKind {
        name: "torus",
        doc: "ring torus about the y axis",
        parameters: &[
            ("major_radius", "radius of the centre line, m"),
            ("minor_radius", "radius of the tube, m, below major_radius"),
        ],
    },
    ImplicitKind {
        name: "superquadric",
        doc: "superellipsoid: box, cylinder, ellipsoid, octahedron and what lies between",
        parameters: &[
            ("radii", "half axes along x, y, z, m"),
            ("exponent_y", "north-south exponent in [0.1, 2]; 1 is round, small is boxy"),
            ("exponent_xz", "east-west exponent in [0.1, 2]; 1 is round, small is boxy"),
        ],
    },
    ImplicitKind {
        name: "gyroid",
        doc: "wall about a gyroid, cut by a sphere about the origin",
        parameters: &[
            ("period", "period of the surface, m"),
            ("thickness", "thickness of the wall where it is thinnest, m, below period/4"),
            ("radius", "radius of the sphere, m, at most 100 periods"),
        ],
    },
    ImplicitKind {
        name: "smooth_union",
        doc: "spheres melted into each other by a cubic smooth minimum",
        parameters: &[
            ("centers", "centres, m, 1 to 256 of them"),
            ("radii", "radii, m, one a centre"),
            ("blend", "width of the blend, m, 0 or more"),
        ],
    },
    ImplicitKind {
        name: "tanglecube",
        doc: "quartic x^4 - 5x^2 + y^4 - 5y^2 + z^4 - 5z^2 + level = 0 in units of size",
        parameters: &[("size", "length of one unit, m"), ("level", "constant term in [-100, 18.75); 11.8 by default")],
    },
];

/// A built-in implicit surface in object space.
#[derive(Debug, Clone, PartialEq)]
pub enum Implicit {
    /// Torus about the y axis.
    Torus(Torus),
    /// Superellipsoid.
    Superquadric(Superquadric),
    /// Gyroid wall cut by a sphere.
    Gyroid(Gyroid),
    /// Spheres melted into each other.
    SmoothUnion(SmoothUnion),
    /// Tanglecube.
    Tanglecube(Tanglecube),
}

/// Calls the same generic code for whichever surface it is.
macro_rules! for_surface {
    ($implicit:expr, $surface:ident => $body:expr) => {
        match $implicit {
            Implicit::Torus($surface) => $body,
            Implicit::Superquadric($surface) => $body,
            Implicit::Gyroid($surface) => $body,
            Implicit::SmoothUnion($surface) => $body,
            Implicit::Tanglecube($surface) => $body,
        }
    };
}

impl Implicit {
    /// The function: negative inside, positive outside.
    pub fn value(&self, p: DVec3) -> f64 {
        for_surface!(self, surface => roots::value_at(surface, p))
    }

    /// The function's gradient, which points outward; 0 at singular points.
    pub fn gradient(&self, p: DVec3) -> DVec3 {
        for_surface!(self, surface => roots::gradient(surface, p))
    }

    /// Corners of an axis-aligned box around the solid.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let Box3 { min, max } = self.object_box();
        (min, max)
    }

    fn object_box(&self) -> Box3 {
        for_surface!(self, surface => surface.bounds())
    }

    /// The first t in (0, t_max) at which the line crosses the surface.
    pub(super) fn first_crossing(&self, origin: DVec3, direction: DVec3, t_max: f64) -> Option<f64> {
        let (t0, t1) = self.object_box().clip(origin, direction, t_max)?;
        let line = Line { origin, direction };
        for_surface!(self, surface => roots::first_root(surface, &line, t0, t1))
    }

    /// The first hit on the line, moved onto the surface.
    pub(super) fn intersect(&self, origin: DVec3, direction: DVec3, t_max: f64) -> Option<LocalHit> {
        let t = self.first_crossing(origin, direction, t_max)?;
        Some(for_surface!(self, surface => project(surface, origin + direction * t, direction, t)))
    }
}

/// The hit at t: one Newton step along the gradient takes the point to the surface as exactly as f64 can say, which a
/// grazing t alone does not. A singular point keeps its place and gets a normal against the ray.
fn project<F: Field>(surface: &F, p: DVec3, direction: DVec3, t: f64) -> LocalHit {
    let gradient = roots::gradient(surface, p);
    let slope = gradient.length();
    let step = gradient * (roots::value_at(surface, p) / (slope * slope));
    // A step longer than the rounding error of a grazing root would mean that the slope vanishes here.
    let point = if step.length() <= 1e-6 * p.length() { p - step } else { p };
    let normal = if slope > 0.0 && slope.is_finite() { gradient } else { -direction };
    LocalHit { t, point, normal, distance: roots::distance_bound(surface, point, slope), face: 0 }
}

/// An axis-aligned box in f64.
#[derive(Debug, Clone, Copy)]
struct Box3 {
    min: DVec3,
    max: DVec3,
}

impl Box3 {
    fn around(center: DVec3, half: DVec3) -> Self {
        Self { min: center - half, max: center + half }
    }

    fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The part of (0, t_max) in which the line is inside this box, grown a little so that its ends lie off the surface.
    fn clip(&self, origin: DVec3, direction: DVec3, t_max: f64) -> Option<(f64, f64)> {
        let margin = (self.max - self.min) * GROWTH;
        let inverse = direction.recip();
        let (a, b) = ((self.min - margin - origin) * inverse, (self.max + margin - origin) * inverse);
        let (mut t0, mut t1) = (0.0f64, t_max);
        for i in 0..3 {
            if direction[i] == 0.0 {
                if origin[i] < self.min[i] - margin[i] || origin[i] > self.max[i] + margin[i] {
                    return None;
                }
                continue;
            }
            t0 = t0.max(a[i].min(b[i]));
            t1 = t1.min(a[i].max(b[i]));
        }
        (t0 < t1 && t1.is_finite()).then_some((t0, t1))
    }
}

/// Growth of the box relative to its size: above every rounding error in clipping, below anything that costs time.
const GROWTH: f64 = 1.0 / (1u64 << 20) as f64;

/// A parameter that must be a positive number.
fn positive(name: &str, value: f64) -> Result<f64> {
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(Error::new(ErrorKind::OutOfRange, format!("{name} is {value}; expected a positive number")))
    }
}
