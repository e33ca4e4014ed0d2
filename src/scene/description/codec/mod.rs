//! What a value of a scene file can be: each [`Codec`] says in one place what it accepts, how that reads in messages,
//! in the schema and in the reference, and how it is read.

mod kind;
mod lists;
mod object;
mod values;

pub use kind::{Field, Kind, MAX_NAMES, MAX_TEXT, Need, NumbersKind, Range, Rule, Table};
pub use lists::{Array, List, Map, Numbers, Tuples};
pub use object::{Object, Record, Variant, describe};
pub use values::{Bool, Checked, Choice, Defined, FileName, Integer, KnownName, Name, Number, NumberOr, Text};

use super::context::{Context, with_nearest};
use super::json::Json;
use super::path::Path;
use crate::{Error, ErrorKind, Result};

/// A value of the file, where it stands, and what the rest of the file says.
#[derive(Clone, Copy)]
pub struct Value<'a> {
    /// The value.
    pub json: &'a Json,
    /// Its place.
    pub path: &'a Path<'a>,
    /// Names, folder and warnings of the file.
    pub context: &'a Context,
}

/// Reads one kind of value, and describes it.
pub trait Codec {
    /// What it is read as.
    type Value;
    /// What is accepted, for messages, schema and reference.
    fn kind(&self) -> Kind;
    /// Reads a value of the file.
    fn read(&self, value: &Value) -> Result<Self::Value>;
    /// Some value, where there is none in the file: while an object is described, or while the rest of an object that
    /// lacks a key is looked at. Nothing ever sees the result.
    fn placeholder(&self) -> Self::Value;
}

/// An error at a path.
pub fn error(kind: ErrorKind, path: &Path, message: impl Into<String>) -> Error {
    Error::new(kind, message).at(path.to_string())
}

impl Value<'_> {
    /// An item of a list that stands here, read by `codec`.
    fn item<C: Codec>(&self, index: usize, json: &Json, codec: &C) -> Result<C::Value> {
        codec.read(&Value { json, path: &Path::Index(self.path, index), context: self.context })
    }

    /// An error at this place.
    pub fn error(&self, kind: ErrorKind, message: impl Into<String>) -> Error {
        error(kind, self.path, message)
    }

    /// "expected …, found …", of a value of another type.
    pub fn wrong_type(&self, expected: &str) -> Error {
        self.error(ErrorKind::WrongType, format!("expected {expected}, found {}", self.json.found()))
    }

    /// "expected …, found …", of a number outside its range.
    fn out_of_range(&self, expected: &str, found: &str) -> Error {
        self.error(ErrorKind::OutOfRange, format!("expected {expected}, found {found}"))
    }
}
