//! Files in and out: what other programs wrote, read with limits and places in the messages.

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
