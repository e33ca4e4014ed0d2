//! The scene format as data: every object's keys with type, range, default and meaning.
//!
//! These tables are the only place where a key is described. The check of a file ([`super::validate`]), the decoder's
//! defaults ([`super::fields`]) and the JSON Schema ([`super::schema`]) all read them, so they cannot disagree.

mod kinds;
mod scene;
mod shape;
mod spectrum;

pub use kinds::*;
pub use scene::*;
pub use shape::*;
pub use spectrum::*;
