//! The kinds of shapes. A new one is a file with its struct and its `LocalShape`, and a variant and an arm here.

use super::super::hit::LocalHit;
use super::super::shape::{CurvedFaces, LocalShape, Parametrization, Patch};
use super::super::{Cuboid, Cylinder, Disk, Implicit, Lens, Sphere};
use glam::{DAffine3, DVec3};

/// The shapes that are intersected by their equations.
#[derive(Debug, Clone, PartialEq)]
pub enum AnalyticShape {
    /// A sphere.
    Sphere(Sphere),
    /// A flat disk.
    Disk(Disk),
    /// A box.
    Cuboid(Cuboid),
    /// A cylinder.
    Cylinder(Cylinder),
    /// A spherical lens.
    Lens(Lens),
    /// An implicit surface.
    Implicit(Implicit),
}

/// Calls the same method of whichever shape it is.
macro_rules! for_shape {
    ($shapes:expr, $shape:ident => $body:expr) => {
        match $shapes {
            AnalyticShape::Sphere($shape) => $body,
            AnalyticShape::Disk($shape) => $body,
            AnalyticShape::Cuboid($shape) => $body,
            AnalyticShape::Cylinder($shape) => $body,
            AnalyticShape::Lens($shape) => $body,
            AnalyticShape::Implicit($shape) => $body,
        }
    };
}

impl AnalyticShape {
    /// Whether the shape encloses a volume.
    pub fn is_closed(&self) -> bool {
        for_shape!(self, shape => LocalShape::is_closed(shape))
    }

    /// Whether the shape is known to hold every line between two of its points.
    pub(super) fn is_convex(&self) -> bool {
        matches!(self, Self::Sphere(_) | Self::Cuboid(_) | Self::Cylinder(_))
    }

    /// The pieces of the surface, placed in the world, that points can be drawn from uniformly by area. `None` where this
    /// is not known how to do exactly.
    pub fn patches(&self, world_from_object: &DAffine3) -> Option<Vec<Patch>> {
        for_shape!(self, shape => LocalShape::patches(shape, world_from_object))
    }
}

impl LocalShape for AnalyticShape {
    fn object_from_local(&self) -> DAffine3 {
        for_shape!(self, shape => shape.object_from_local())
    }

    fn bounds(&self, world_from_local: &DAffine3) -> (DVec3, DVec3) {
        for_shape!(self, shape => LocalShape::bounds(shape, world_from_local))
    }

    fn is_closed(&self) -> bool {
        AnalyticShape::is_closed(self)
    }

    fn contains(&self, p: DVec3) -> bool {
        for_shape!(self, shape => LocalShape::contains(shape, p))
    }

    fn side(&self, face: u8, p: DVec3) -> f64 {
        for_shape!(self, shape => shape.side(face, p))
    }

    fn intersect(&self, o: DVec3, d: DVec3, t_max: f64) -> Option<LocalHit> {
        for_shape!(self, shape => shape.intersect(o, d, t_max))
    }

    fn hits(&self, o: DVec3, d: DVec3, t_max: f64) -> bool {
        for_shape!(self, shape => shape.hits(o, d, t_max))
    }

    fn curved_faces(&self) -> CurvedFaces {
        for_shape!(self, shape => shape.curved_faces())
    }

    fn facets(&self) -> Vec<(DVec3, DVec3)> {
        for_shape!(self, shape => shape.facets())
    }

    fn patches(&self, world_from_object: &DAffine3) -> Option<Vec<Patch>> {
        AnalyticShape::patches(self, world_from_object)
    }

    fn parametrization(&self, face: u8, p: DVec3) -> Option<Parametrization> {
        for_shape!(self, shape => shape.parametrization(face, p))
    }
}
