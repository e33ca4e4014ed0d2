//! Rays, boxes, shapes and the bounding volume hierarchy. Knows nothing of materials or light.

mod aabb;
mod analytic;
mod bvh;
mod cuboid;
mod cylinder;
mod disk;
mod frame;
mod hit;
pub(crate) mod implicit;
mod lens;
mod mesh;
mod polyhedron;
#[cfg(test)]
mod random;
mod ray;
mod shape;
mod solids;
mod span;
mod sphere;
mod triangle;

pub use aabb::Aabb;
pub use bvh::{AnalyticId, Bvh, BvhHit, Primitive, TriangleId};
pub use frame::Frame;
pub use mesh::Mesh;
pub use ray::{Ray, offset_origin};
pub use shape::Parametrization;
pub use triangle::{TriangleHit, geometric_normal, sample_triangle};

pub(crate) use analytic::{Analytic, AnalyticShape};
pub(crate) use cuboid::Cuboid;
pub(crate) use cylinder::Cylinder;
pub(crate) use disk::Disk;
pub(crate) use frame::orthonormal_basis;
pub(crate) use hit::AnalyticHit;
pub(crate) use implicit::Implicit;
pub(crate) use lens::Lens;
pub(crate) use polyhedron::Polyhedron;
pub(crate) use shape::Patch;
pub(crate) use solids::{BrilliantCut, TriangleSoup, brilliant, prism};
pub(crate) use sphere::Sphere;
pub(crate) use triangle::triangle_area;
