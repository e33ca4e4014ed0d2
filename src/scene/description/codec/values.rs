//! Codecs of single values: numbers, strings, names, files, choices.

use std::fmt::Display;
use std::path::PathBuf;

use super::super::json::Json;
use super::super::text::{quote, show};
use super::kind::{Kind, MAX_TEXT, Range};
use super::{Codec, Value, with_nearest};
use crate::{ErrorKind, Result};

/// A number in a range.
#[derive(Debug, Clone, Copy)]
pub struct Number(pub Range);

impl Codec for Number {
    type Value = f64;

    fn kind(&self) -> Kind {
        Kind::Number(self.0)
    }

    fn read(&self, value: &Value) -> Result<f64> {
        match value.json.as_number() {
            None => Err(value.wrong_type(&self.kind().expected())),
            Some(x) if !self.0.contains(x) => Err(value.out_of_range(&self.kind().expected(), &show(x))),
            Some(x) => Ok(x),
        }
    }

    fn placeholder(&self) -> f64 {
        0.0
    }
}

/// An integer, ends included.
#[derive(Debug, Clone, Copy)]
pub struct Integer {
    /// Least value.
    pub min: i64,
    /// Greatest value.
    pub max: i64,
}

impl Codec for Integer {
    type Value = i64;

    fn kind(&self) -> Kind {
        Kind::Integer(Range::from_to(self.min as f64, self.max as f64))
    }

    fn read(&self, value: &Value) -> Result<i64> {
        let refused = |found: &dyn Display| Err(value.out_of_range(&self.kind().expected(), &found.to_string()));
        match (value.json.as_integer(), value.json.as_number()) {
            (Some(n), _) if (self.min..=self.max).contains(&n) => Ok(n),
            (Some(n), _) => refused(&n),
            (None, Some(x)) if x.fract() == 0.0 => refused(&show(x)),
            _ => Err(value.wrong_type(&self.kind().expected())),
        }
    }

    fn placeholder(&self) -> i64 {
        0
    }
}

/// `true` or `false`.
#[derive(Debug, Clone, Copy)]
pub struct Bool;

impl Codec for Bool {
    type Value = bool;

    fn kind(&self) -> Kind {
        Kind::Bool
    }

    fn read(&self, value: &Value) -> Result<bool> {
        match value.json {
            Json::Bool(value) => Ok(*value),
            _ => Err(value.wrong_type(&self.kind().expected())),
        }
    }

    fn placeholder(&self) -> bool {
        false
    }
}

/// Reads a string of bounded length.
fn text<'a>(kind: impl Fn() -> Kind, value: &Value<'a>) -> Result<&'a str> {
    let text = value.json.as_text().ok_or_else(|| value.wrong_type(&kind().expected()))?;
    if text.len() > MAX_TEXT {
        let message = format!("a string of {} bytes; the limit is {MAX_TEXT}", text.len());
        return Err(value.error(ErrorKind::LimitExceeded, message));
    }
    Ok(text)
}

/// Reads a string that is not empty.
fn name<'a>(kind: impl Fn() -> Kind, value: &Value<'a>) -> Result<&'a str> {
    let text = text(&kind, value)?;
    if text.is_empty() {
        return Err(value.error(ErrorKind::Missing, format!("an empty string; expected {}", kind().expected())));
    }
    Ok(text)
}

/// Finds a string in a closed set of names; returns its index.
pub fn find_name(value: &Value, what: &str, names: impl Iterator<Item = &'static str> + Clone) -> Result<usize> {
    let text = text(|| Kind::Text, value)?;
    names.clone().position(|name| name == text).ok_or_else(|| {
        let valid = names.clone().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ");
        let message = format!("{} is not {what}; expected {valid}", quote(text));
        with_nearest(value.error(ErrorKind::UnknownName, message), text, names)
    })
}

/// Any string.
#[derive(Debug, Clone, Copy)]
pub struct Text;

impl Codec for Text {
    type Value = String;

    fn kind(&self) -> Kind {
        Kind::Text
    }

    fn read(&self, value: &Value) -> Result<String> {
        text(|| self.kind(), value).map(str::to_owned)
    }

    fn placeholder(&self) -> String {
        String::new()
    }
}

/// A name, not empty; the words say of what.
#[derive(Debug, Clone, Copy)]
pub struct Name(pub &'static str);

impl Codec for Name {
    type Value = String;

    fn kind(&self) -> Kind {
        Kind::Name(self.0)
    }

    fn read(&self, value: &Value) -> Result<String> {
        name(|| self.kind(), value).map(str::to_owned)
    }

    fn placeholder(&self) -> String {
        String::new()
    }
}

/// The path of a file of one of some kinds, relative to the scene's folder.
#[derive(Debug, Clone, Copy)]
pub struct FileName {
    /// What the file holds.
    pub what: &'static str,
    /// Extensions that are read, without the dot.
    pub extensions: &'static [&'static str],
}

impl Codec for FileName {
    type Value = PathBuf;

    fn kind(&self) -> Kind {
        Kind::File { what: self.what, extensions: self.extensions }
    }

    fn read(&self, value: &Value) -> Result<PathBuf> {
        let name = name(|| self.kind(), value)?;
        let extension = name.rsplit_once('.').map_or(String::new(), |(_, end)| end.to_ascii_lowercase());
        if !self.extensions.contains(&extension.as_str()) {
            let message = format!("{} has an unknown file type; expected {}", quote(name), self.kind().expected());
            return Err(value.error(ErrorKind::FileFormat, message));
        }
        Ok(value.context.folder.join(name))
    }

    fn placeholder(&self) -> PathBuf {
        PathBuf::new()
    }
}

/// One of a set of strings.
#[derive(Debug, Clone, Copy)]
pub struct Choice<T: 'static> {
    /// What is chosen, with its article.
    pub what: &'static str,
    /// The names with what they stand for and what that means.
    pub names: &'static [(&'static str, T, &'static str)],
}

impl<T: Copy> Codec for Choice<T> {
    type Value = T;

    fn kind(&self) -> Kind {
        Kind::Choice(self.names.iter().map(|(name, _, doc)| (*name, *doc)).collect())
    }

    fn read(&self, value: &Value) -> Result<T> {
        if value.json.as_text().is_none() {
            return Err(value.wrong_type(&self.kind().expected()));
        }
        let index = find_name(value, self.what, self.names.iter().map(|(name, ..)| *name))?;
        Ok(self.names[index].1)
    }

    fn placeholder(&self) -> T {
        self.names[0].1
    }
}

/// One of the names that another module lists.
#[derive(Debug, Clone, Copy)]
pub struct KnownName {
    /// What is named, with its article.
    pub what: &'static str,
    /// Lists the names.
    pub names: fn() -> Vec<&'static str>,
}

impl Codec for KnownName {
    type Value = String;

    fn kind(&self) -> Kind {
        Kind::Choice((self.names)().into_iter().map(|name| (name, "")).collect())
    }

    fn read(&self, value: &Value) -> Result<String> {
        if value.json.as_text().is_none() {
            return Err(value.wrong_type(&self.kind().expected()));
        }
        let names = (self.names)();
        let index = find_name(value, self.what, names.iter().copied())?;
        Ok(names[index].to_owned())
    }

    fn placeholder(&self) -> String {
        String::new()
    }
}

/// A number, or something of another JSON type.
#[derive(Debug, Clone, Copy)]
pub struct NumberOr<C: Codec> {
    /// Range of the number.
    pub range: Range,
    /// What the number stands for.
    pub from_number: fn(f64) -> C::Value,
    /// What else may stand here.
    pub other: C,
}

impl<C: Codec> Codec for NumberOr<C> {
    type Value = C::Value;

    fn kind(&self) -> Kind {
        Kind::Either(vec![(self.other.kind(), ""), (Kind::Number(self.range), "")])
    }

    fn read(&self, value: &Value) -> Result<C::Value> {
        match (value.json, self.other.kind()) {
            (Json::Integer(_) | Json::Number(_), _) => Number(self.range).read(value).map(self.from_number),
            (Json::Text(_), Kind::Choice(_)) => self.other.read(value),
            (Json::Numbers(_) | Json::List(_), Kind::Numbers(_)) => self.other.read(value),
            _ => Err(value.wrong_type(&self.kind().expected())),
        }
    }

    fn placeholder(&self) -> C::Value {
        self.other.placeholder()
    }
}

/// What another codec reads, with one more check.
#[derive(Debug, Clone, Copy)]
pub struct Checked<C: Codec> {
    /// Reads the value.
    pub codec: C,
    /// Refuses what no schema can.
    pub check: fn(&Value, &C::Value) -> Result<()>,
}

impl<C: Codec> Codec for Checked<C> {
    type Value = C::Value;

    fn kind(&self) -> Kind {
        self.codec.kind()
    }

    fn read(&self, value: &Value) -> Result<C::Value> {
        let read = self.codec.read(value)?;
        (self.check)(value, &read)?;
        Ok(read)
    }

    fn placeholder(&self) -> C::Value {
        self.codec.placeholder()
    }
}

/// A codec with a name of its own in the schema and the reference.
#[derive(Debug, Clone, Copy)]
pub struct Defined<C> {
    /// The name.
    pub name: &'static str,
    /// Makes the codec.
    pub codec: fn() -> C,
}

impl<C: Codec + 'static> Codec for Defined<C> {
    type Value = C::Value;

    fn kind(&self) -> Kind {
        let codec = self.codec;
        Kind::Defined(self.name, Box::new(move || codec().kind()))
    }

    fn read(&self, value: &Value) -> Result<C::Value> {
        (self.codec)().read(value)
    }

    fn placeholder(&self) -> C::Value {
        (self.codec)().placeholder()
    }
}
