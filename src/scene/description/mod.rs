//! `SceneDescription`: scene.json as plain data, in the user's names and units.
//!
//! Parsing checks everything that can be checked without opening another file: types, ranges, unknown and duplicate
//! keys, names. What needs files, tables or geometry is checked by [`crate::scene::compile`], which reports with the
//! JSON path that each part of the description carries as `at`.
//!
//! Each kind of thing is said once, in the file of its group: a struct, and a function that declares its keys with
//! their limits, defaults and meaning, and reads them. The JSON Schema and the reference are made by running the same
//! functions on nothing.

mod camera;
mod codec;
mod context;
mod document;
mod film;
mod ior;
mod json;
mod lights;
mod materials;
mod named_spectra;
mod parse;
mod path;
mod reference;
mod schema;
mod settings;
mod shapes;
mod spectrum;
mod text;
mod transform;
mod vector;

pub use crate::develop::{TONEMAPS, Tonemap};
pub use crate::scene::Integrator;
pub use camera::{CameraDescription, FovAxis};
pub use document::{ObjectDescription, SceneDescription};
pub use film::{FilmDescription, FilterKind, MAX_PIXELS, MAX_SIDE};
pub use ior::{IorDescription, IorKind};
pub use lights::{EnvironmentDescription, LightDescription, LightKind};
pub use materials::{ConductorDescription, MaterialDescription, MaterialKind};
pub use parse::{Parsed, parse_bytes, parse_file, parse_reader, parse_str};
pub use reference::reference;
pub use schema::schema;
#[cfg(feature = "cli")]
pub(crate) use settings::EXPOSURES_EV;
pub use settings::{DevelopDescription, INTEGRATORS, RenderDescription};
pub use shapes::{BrilliantDescription, ImplicitDescription, ShapeDescription};
pub use spectrum::{SpectrumDescription, SpectrumKind};
pub use transform::TransformStep;

/// Where in the file a value stands, as a JSON path such as `objects[2].shape.radius`.
pub type JsonPath = String;
