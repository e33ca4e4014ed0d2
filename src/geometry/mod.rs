//! Rays, boxes, transforms, shapes and the bounding volume hierarchy. Knows nothing of materials or light.

mod aabb;
pub mod bvh;
mod mesh;
mod ray;
mod triangle;

pub use aabb::Aabb;
pub use bvh::{Bvh, BvhHit, Primitive};
pub use mesh::Mesh;
pub use ray::{Ray, offset_origin};
pub use triangle::{TriangleHit, geometric_normal, sample_triangle, triangle_area};
