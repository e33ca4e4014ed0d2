//! Reading and writing files.

pub mod refractive_index_info;
