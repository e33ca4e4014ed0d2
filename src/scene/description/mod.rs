//! `SceneDescription`: scene.json as plain data, in the user's names and units.
//!
//! Parsing checks everything that can be checked without opening another file: types, ranges, unknown and duplicate
//! keys, names. What needs files, tables or geometry is checked by [`crate::scene::compile`], which reports with the
//! JSON path that each part of the description carries as `at`.

mod decode_shape;
mod decode_spectrum;
mod fields;
mod json;
mod parse;
mod path;
mod schema;
mod tables;
mod types;
mod validate;

pub use parse::{Parsed, parse_bytes, parse_file, parse_reader, parse_str};
pub use schema::schema;
pub use types::*;
