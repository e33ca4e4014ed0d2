//! Random numbers and warps: Owen-scrambled Sobol points, discrete, piecewise-linear and quantile distributions, maps from the unit
//! square to directions and discs, and weights for combining techniques. Nothing here knows what is being sampled.

mod alias;
mod grid;
mod mis;
mod piecewise;
mod quantile;
mod sobol;
mod warp;

pub use alias::{AliasTable, Draw};
pub use grid::GridDensity;
pub use mis::balance_heuristic;
pub use piecewise::PiecewiseLinearDensity;
pub use quantile::QuantileDensity;
pub use sobol::{DIMENSIONS, Sobol, mix};
pub use warp::{
    concentric_disk, concentric_disk_inverse, cosine_hemisphere, uniform_cone, uniform_cone_inverse, uniform_sphere,
};
