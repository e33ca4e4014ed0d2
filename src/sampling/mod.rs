//! Random numbers and warps: Owen-scrambled Sobol points, discrete and piecewise-linear distributions, maps from the unit
//! square to directions and discs, and weights for combining techniques. Nothing here knows what is being sampled.

mod alias;
mod mis;
mod piecewise;
mod sobol;
mod warp;

pub use alias::{AliasTable, Draw};
pub use mis::balance_heuristic;
pub use piecewise::PiecewiseLinearDensity;
pub use sobol::{DIMENSIONS, Sobol, mix};
pub use warp::{concentric_disk, cosine_hemisphere, uniform_cone, uniform_sphere};
