//! Rays, boxes, shapes and the bounding volume hierarchy. Knows nothing of materials or light.

mod aabb;
mod analytic;
pub mod bvh;
mod cuboid;
mod cylinder;
mod disk;
mod frame;
mod hit;
pub mod implicit;
mod lens;
mod mesh;
mod polyhedron;
#[cfg(test)]
mod random;
mod ray;
mod shape;
pub mod solids;
mod span;
mod sphere;
mod triangle;

pub use aabb::Aabb;
pub use analytic::{Analytic, AnalyticShape};
pub use bvh::{Bvh, BvhHit, Primitive};
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use disk::Disk;
pub use frame::{Frame, orthonormal_basis};
pub use hit::AnalyticHit;
pub use implicit::Implicit;
pub use lens::Lens;
pub use mesh::Mesh;
pub use polyhedron::Polyhedron;
pub use ray::{Ray, offset_origin};
pub use shape::{Parametrization, Patch};
pub use solids::{BrilliantCut, TriangleSoup, brilliant, prism};
pub use sphere::Sphere;
pub use triangle::{TriangleHit, geometric_normal, sample_triangle, triangle_area};
