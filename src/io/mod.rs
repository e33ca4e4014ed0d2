//! Files: reading and writing what the other modules compute with.

pub mod mesh;
mod obj;
mod ply;
