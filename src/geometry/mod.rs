//! Rays, boxes, transforms, shapes and the bounding volume hierarchy. Knows nothing of materials or light.

mod aabb;
mod frame;
mod analytic;
mod disk;
pub mod implicit;
mod lens;
mod ray;
mod sphere;

pub use aabb::Aabb;
pub use frame::{Frame, orthonormal_basis};
pub use analytic::{Analytic, AnalyticHit, AnalyticShape};
pub use disk::Disk;
pub use implicit::{IMPLICIT_KINDS, Implicit, ImplicitKind};
pub use lens::Lens;
pub use ray::{Ray, offset_origin};
pub use sphere::Sphere;
pub mod bvh;
mod ray;
mod triangle;

pub use aabb::Aabb;
pub use bvh::{Bvh, BvhHit, Primitive};
pub use ray::{Ray, offset_origin};
pub use triangle::{TriangleHit, geometric_normal, sample_triangle, triangle_area};
