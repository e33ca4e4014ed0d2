//! abbe: a spectral renderer and colour library.

pub mod bsdf;
pub mod cli;
pub mod color;
pub mod develop;
mod error;
pub mod film;
pub mod geometry;
pub mod io;
pub mod math;
pub mod optics;
pub mod render;
pub mod sampling;
pub mod scene;
pub mod spectrum;

pub use error::{Error, ErrorKind, Result, nearest_name};

/// Name and version of this program, as written into files.
pub const VERSION: &str = concat!("abbe ", env!("CARGO_PKG_VERSION"));
