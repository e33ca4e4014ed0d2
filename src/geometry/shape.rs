//! What every shape with an equation of its own states about itself.

use super::hit::LocalHit;
use crate::math;
use glam::{DAffine3, DVec2, DVec3};

/// What a shape states, in the *local* space where its equation is simplest. No method has a default, so that a new shape
/// cannot inherit a wrong answer.
pub(super) trait LocalShape {
    /// Takes local space to the object's.
    fn object_from_local(&self) -> DAffine3;

    /// Corners of a box around the shape in the world.
    fn bounds(&self, world_from_local: &DAffine3) -> (DVec3, DVec3);

    /// Whether the shape encloses a volume.
    fn is_closed(&self) -> bool;

    /// Whether a point is inside; `false` for an open shape.
    fn contains(&self, p: DVec3) -> bool;

    /// Negative on the inner side of one of the shape's surfaces, positive on the outer one.
    fn side(&self, face: u8, p: DVec3) -> f64;

    /// The first hit on a line with t in (0, `t_max`), moved onto the surface.
    fn intersect(&self, o: DVec3, d: DVec3, t_max: f64) -> Option<LocalHit>;

    /// Whether there is such a hit: the same answer as [`Self::intersect`], for less work.
    fn hits(&self, o: DVec3, d: DVec3, t_max: f64) -> bool;

    /// Kinds of curved surfaces that another shape can have a part of.
    fn curved_faces(&self) -> CurvedFaces;

    /// Outward normals of flat facets, of any length, each with a point of the facet. An open shape has none to share.
    fn facets(&self) -> Vec<(DVec3, DVec3)>;

    /// The pieces of the surface, placed in the world, that points can be drawn from uniformly by area. `None` where this
    /// is not known how to do exactly: a light of that shape is found by camera paths alone.
    fn patches(&self, world_from_object: &DAffine3) -> Option<Vec<Patch>>;

    /// Surface coordinates at a point of one of the shape's surfaces; `None` for a shape that has none.
    fn parametrization(&self, face: u8, p: DVec3) -> Option<Parametrization>;
}

/// Kinds of curved surfaces that shapes can have in common.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct CurvedFaces {
    /// A part of a sphere, or of an ellipsoid.
    pub spherical: bool,
    /// A part of a cylinder.
    pub cylindrical: bool,
}

impl CurvedFaces {
    /// Whether there is a kind that both have.
    pub fn meets(self, other: Self) -> bool {
        (self.spherical && other.spherical) || (self.cylindrical && other.cylindrical)
    }
}

/// A piece of a surface in the world that points can be drawn from uniformly by area.
#[derive(Debug, Clone, PartialEq)]
pub enum Patch {
    /// A parallelogram with outward normal `u` × `v`.
    Parallelogram {
        /// Corner.
        origin: DVec3,
        /// Edge.
        u: DVec3,
        /// Edge.
        v: DVec3,
    },
    /// An ellipse with outward normal `u` × `v`.
    Ellipse {
        /// Centre.
        center: DVec3,
        /// Half axis.
        u: DVec3,
        /// Half axis, conjugate to the first.
        v: DVec3,
    },
    /// A sphere.
    Sphere {
        /// Centre.
        center: DVec3,
        /// Radius.
        radius: f64,
    },
    /// The side of a right circular cylinder.
    Tube {
        /// Centre.
        center: DVec3,
        /// From the centre to that of an end.
        half_axis: DVec3,
        /// Radius.
        radius: f64,
    },
}

impl Patch {
    /// Area of one side.
    pub fn area(&self) -> f64 {
        use std::f64::consts::PI;
        match self {
            Self::Parallelogram { u, v, .. } => u.cross(*v).length(),
            Self::Ellipse { u, v, .. } => PI * u.cross(*v).length(),
            Self::Sphere { radius, .. } => 4.0 * PI * radius * radius,
            Self::Tube { half_axis, radius, .. } => 4.0 * PI * radius * half_axis.length(),
        }
    }
}

/// Coordinates on a surface and how the point moves with them. Seen from outside, u × v points to the viewer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parametrization {
    /// The coordinates; [0, 1]² over a whole face where the shape decides.
    pub uv: DVec2,
    /// Derivative of the point by u.
    pub dp_du: DVec3,
    /// Derivative of the point by v.
    pub dp_dv: DVec3,
}

/// Turns about an axis, in [0, 1).
pub(super) fn turns(sin: f64, cos: f64) -> f64 {
    let turns = math::atan2(sin, cos) / std::f64::consts::TAU;
    if turns < 0.0 { (turns + 1.0).min(1.0f64.next_down()) } else { turns }
}
