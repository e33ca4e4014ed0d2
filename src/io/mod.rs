//! Reads and writes files. What other programs wrote is read within limits, and messages name the place of what is wrong.

pub mod catalogue;
pub mod exr;
pub mod mask;
pub mod mesh;
mod obj;
pub mod output;
mod ply;
pub mod png;
pub mod refractive_index_info;
pub mod spectrum_file;
