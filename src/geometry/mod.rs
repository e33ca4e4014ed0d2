//! Rays, boxes, transforms, shapes and the bounding volume hierarchy. Knows nothing of materials or light.

mod aabb;
mod frame;
mod ray;

pub use aabb::Aabb;
pub use frame::{Frame, orthonormal_basis};
pub use ray::{Ray, offset_origin};
