//! Reading and writing files.

pub mod catalogue;
pub mod refractive_index_info;
//! Files in and out: what other programs wrote, read with limits and line numbers.

pub mod spectrum_file;
