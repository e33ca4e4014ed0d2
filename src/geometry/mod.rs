//! Rays, boxes, shapes and the bounding volume hierarchy. Knows nothing of materials or light.

mod aabb;
mod analytic;
pub mod bvh;
mod disk;
mod frame;
pub mod implicit;
mod lens;
mod mesh;
mod polyhedron;
mod ray;
pub mod solids;
mod sphere;
mod triangle;

pub use aabb::Aabb;
pub use analytic::{Analytic, AnalyticHit, AnalyticShape};
pub use bvh::{Bvh, BvhHit, Primitive};
pub use disk::Disk;
pub use frame::{Frame, orthonormal_basis};
pub use implicit::{IMPLICIT_KINDS, Implicit, ImplicitKind};
pub use lens::Lens;
pub use mesh::Mesh;
pub use polyhedron::Polyhedron;
pub use ray::{Ray, offset_origin};
pub use solids::{BrilliantCut, TriangleSoup, brilliant, prism};
pub use sphere::Sphere;
pub use triangle::{TriangleHit, geometric_normal, sample_triangle, triangle_area};
