//! Rays, boxes, transforms, shapes and the bounding volume hierarchy. Knows nothing of materials or light.

mod aabb;
mod analytic;
mod disk;
pub mod implicit;
mod lens;
mod ray;
pub mod solids;
mod sphere;

pub use aabb::Aabb;
pub use analytic::{Analytic, AnalyticHit, AnalyticShape};
pub use disk::Disk;
pub use implicit::{IMPLICIT_KINDS, Implicit, ImplicitKind};
pub use lens::Lens;
pub use ray::{Ray, offset_origin};
pub use solids::{BrilliantCut, TriangleSoup, brilliant, prism};
pub use sphere::Sphere;
