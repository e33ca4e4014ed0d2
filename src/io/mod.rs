//! Reading and writing files.

pub mod catalogue;
pub mod refractive_index_info;
