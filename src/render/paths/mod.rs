//! Paths: what camera paths, light paths and merging have in common, and none of what sets them apart.
//!
//! A path is a [`Walk`]. Each technique repeats three steps: [`Walk::advance`] finds where the ray ends, [`Walk::encounter`]
//! makes a [`Vertex`] of what is there, and [`Walk::scatter`] sends the path on. Between them it does what is its own:
//! collect light, splat, or merge.

mod counters;
mod encounter;
mod fork;
mod interiors;
mod numbers;
mod scatter;
mod spectral_cache;
mod vertex;
mod visibility;
mod walk;
mod workspace;

pub use counters::Counters;
pub use numbers::Layout;
pub use scatter::adjoint;
pub use vertex::{Encounter, Scattering, Vertex};
pub use walk::{Place, TransportMode, Walk};
pub use workspace::Workspace;
