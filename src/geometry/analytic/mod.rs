//! Shapes with an exact intersection of their own, placed in the world by an affine transform. Everything in f64.

mod kinds;
#[cfg(test)]
mod tests;
mod transformed;

pub use kinds::AnalyticShape;

use super::hit::{AnalyticHit, F64_CHAIN};
use super::polyhedron::Polyhedron;
use super::shape::{CurvedFaces, LocalShape, Parametrization};
use super::sphere::PlacedBall;
use super::{Aabb, Ray};
use crate::Result;
use glam::{DAffine3, DVec3};
use transformed::Transformed;

/// A shape in the world.
#[derive(Debug, Clone, PartialEq)]
pub struct Analytic {
    placed: Placed,
}

#[derive(Debug, Clone, PartialEq)]
enum Placed {
    /// A sphere that is still one in the world.
    Ball(PlacedBall),
    /// A convex solid with flat facets.
    Polyhedron(Box<Polyhedron>),
    /// Any other shape.
    Transformed(Box<Transformed>),
}

impl Analytic {
    /// Places a shape. A mirroring transform keeps normals outward.
    ///
    /// Errors: `NotFinite` or `Degenerate` for a transform that is not finite or (numerically) singular.
    pub fn new(shape: AnalyticShape, world_from_object: DAffine3) -> Result<Self> {
        let transformed = Transformed::new(shape, &world_from_object)?;
        let placed = match transformed.as_ball() {
            Some(ball) => Placed::Ball(ball),
            None => Placed::Transformed(Box::new(transformed)),
        };
        Ok(Self { placed })
    }

    /// A box around the shape, rounded outward.
    pub fn bounds(&self) -> Aabb {
        let (min, max) = match &self.placed {
            Placed::Ball(ball) => ball.bounds(),
            Placed::Polyhedron(solid) => return solid.bounds(),
            Placed::Transformed(shape) => shape.bounds(),
        };
        let slack = min.abs().max(max.abs()) * F64_CHAIN;
        Aabb::enclosing(min - slack, max + slack)
    }

    /// Whether a point is inside; `false` for an open shape.
    pub fn contains(&self, point: DVec3) -> bool {
        match &self.placed {
            Placed::Ball(ball) => ball.contains(point),
            Placed::Polyhedron(solid) => solid.contains(point),
            Placed::Transformed(shape) => shape.contains(point),
        }
    }

    /// Whether the shape is known to hold a whole box, so that its surface stays clear of it.
    pub fn encloses(&self, bounds: &Aabb) -> bool {
        let convex = match &self.placed {
            Placed::Ball(_) | Placed::Polyhedron(_) => true,
            Placed::Transformed(shape) => shape.shape().is_convex(),
        };
        convex && bounds.corners().iter().all(|corner| self.contains(corner.as_dvec3()))
    }

    /// Whether a curved part of the surface may lie on the other's: shapes can share a part of a sphere or of a cylinder,
    /// and equal shapes share everything. For flat parts, see [`Self::planes`].
    pub fn may_share_a_face(&self, other: &Self) -> bool {
        match (&self.placed, &other.placed) {
            (Placed::Ball(a), Placed::Ball(b)) => a == b,
            (a, b) => a.curved_faces().meets(b.curved_faces()) || a == b,
        }
    }

    /// Unit normals of flat facets, and the distances of their planes from the origin.
    pub fn planes(&self) -> Vec<(DVec3, f64)> {
        match &self.placed {
            Placed::Ball(_) => Vec::new(),
            Placed::Polyhedron(solid) => solid.planes().collect(),
            Placed::Transformed(shape) => shape.planes(),
        }
    }

    /// Coordinates on the surface at the point of a hit and their derivatives in the world. `None` for shapes without
    /// natural coordinates: most implicit surfaces, and convex glass that is kept as a polyhedron.
    pub fn parametrization(&self, face: u8, point: DVec3) -> Option<Parametrization> {
        match &self.placed {
            Placed::Ball(ball) => ball.parametrization(point),
            Placed::Polyhedron(_) => None,
            Placed::Transformed(shape) => shape.parametrization(face, point),
        }
    }

    /// The nearest hit with 0 < t < `t_max`. There is no smallest t: a ray that starts off the surface by as little as
    /// [`offset_origin`](super::offset_origin) moves it meets only what lies ahead.
    #[inline]
    pub fn intersect(&self, ray: &Ray, t_max: f32) -> Option<AnalyticHit> {
        let (o, d, t_max) = (ray.origin.as_dvec3(), ray.direction.as_dvec3(), f64::from(t_max));
        match &self.placed {
            Placed::Ball(ball) => ball.intersect(o, d, t_max),
            Placed::Polyhedron(solid) => solid.intersect(o, d, t_max),
            Placed::Transformed(shape) => shape.intersect(o, d, t_max),
        }
    }

    /// Whether there is a hit with 0 < t < `t_max`: the same answer as [`Analytic::intersect`], for less work.
    #[inline]
    pub fn hits(&self, ray: &Ray, t_max: f32) -> bool {
        let (o, d, t_max) = (ray.origin.as_dvec3(), ray.direction.as_dvec3(), f64::from(t_max));
        match &self.placed {
            Placed::Ball(ball) => ball.hits(o, d, t_max),
            Placed::Polyhedron(solid) => solid.hits(o, d, t_max),
            Placed::Transformed(shape) => shape.hits(o, d, t_max),
        }
    }
}

impl Placed {
    fn curved_faces(&self) -> CurvedFaces {
        match self {
            Self::Ball(_) => CurvedFaces { spherical: true, ..CurvedFaces::default() },
            Self::Polyhedron(_) => CurvedFaces::default(),
            Self::Transformed(shape) => shape.shape().curved_faces(),
        }
    }
}

impl From<Polyhedron> for Analytic {
    fn from(solid: Polyhedron) -> Self {
        Self { placed: Placed::Polyhedron(Box::new(solid)) }
    }
}
