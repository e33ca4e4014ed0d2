//! Codecs of lists and of objects whose keys are the user's names.

use super::super::json::Json;
use super::super::path::Path;
use super::super::text::show;
use super::kind::{Kind, MAX_NAMES, MAX_TEXT, NumbersKind, Range};
use super::object::check_comment;
use super::{Codec, Value, error};
use crate::{ErrorKind, Result};

/// A list of numbers; `null` reads as infinity.
#[derive(Debug, Clone, Copy)]
pub struct Numbers(pub NumbersKind);

impl Numbers {
    /// From `min` to `max` numbers.
    pub const fn several(min: usize, max: usize, item: Range) -> Self {
        Self(NumbersKind { min, max, multiple_of: 1, item, integer: false, null: false })
    }

    fn check_count(&self, count: usize, value: &Value) -> Result<()> {
        let NumbersKind { min, max, multiple_of, .. } = self.0;
        let expected = || self.kind().expected();
        if count == 0 && min > 0 {
            return Err(value.error(ErrorKind::Missing, format!("an empty list; expected {}", expected())));
        }
        if count > max && max != min {
            return Err(value.error(ErrorKind::LimitExceeded, format!("a list of {count} numbers; the limit is {max}")));
        }
        if count < min || count > max || !count.is_multiple_of(multiple_of) {
            return Err(value.error(ErrorKind::WrongType, format!("expected {}, found {count}", expected())));
        }
        Ok(())
    }

    fn number(&self, x: f64, value: &Value, index: usize) -> Result<f64> {
        let whole = x.fract() == 0.0 || !self.0.integer;
        if whole && self.0.item.contains(x) {
            return Ok(x);
        }
        let (json, path) = (Json::Number(x), Path::Index(value.path, index));
        let here = Value { json: &json, path: &path, context: value.context };
        let expected = self.0.item_kind().expected();
        Err(if whole { here.out_of_range(&expected, &show(x)) } else { here.wrong_type(&expected) })
    }

    fn item(&self, item: &Json, value: &Value, index: usize) -> Result<f64> {
        match item {
            Json::Null if self.0.null => Ok(f64::INFINITY),
            _ => match item.as_number() {
                Some(x) => self.number(x, value, index),
                None => {
                    let expected = self.0.item_kind().expected();
                    let here = Value { json: item, path: &Path::Index(value.path, index), context: value.context };
                    Err(here.wrong_type(&if self.0.null { format!("{expected} or null") } else { expected }))
                }
            },
        }
    }
}

impl Codec for Numbers {
    type Value = Vec<f64>;

    fn kind(&self) -> Kind {
        Kind::Numbers(self.0)
    }

    fn read(&self, value: &Value) -> Result<Vec<f64>> {
        match value.json {
            Json::Numbers(items) => {
                self.check_count(items.len(), value)?;
                items.iter().enumerate().map(|(i, &x)| self.number(x, value, i)).collect()
            }
            Json::List(items) => {
                self.check_count(items.len(), value)?;
                items.iter().enumerate().map(|(i, item)| self.item(item, value, i)).collect()
            }
            _ => Err(value.wrong_type(&self.kind().expected())),
        }
    }

    fn placeholder(&self) -> Vec<f64> {
        Vec::new()
    }
}

/// Exactly `N` numbers.
#[derive(Debug, Clone, Copy)]
pub struct Array<const N: usize> {
    /// Range of each.
    pub item: Range,
    /// Whether one may be `null`, which reads as infinity.
    pub null: bool,
}

impl<const N: usize> Array<N> {
    /// `N` numbers in a range.
    pub const fn of(item: Range) -> Self {
        Self { item, null: false }
    }

    fn numbers(&self) -> Numbers {
        Numbers(NumbersKind { min: N, max: N, multiple_of: 1, item: self.item, integer: false, null: self.null })
    }
}

impl<const N: usize> Codec for Array<N> {
    type Value = [f64; N];

    fn kind(&self) -> Kind {
        self.numbers().kind()
    }

    fn read(&self, value: &Value) -> Result<[f64; N]> {
        let numbers = self.numbers().read(value)?;
        Ok(numbers.try_into().expect("the list was checked to be of this length"))
    }

    fn placeholder(&self) -> [f64; N] {
        [0.0; N]
    }
}

/// A flat list of tuples of `N` numbers, at least one tuple.
#[derive(Debug, Clone, Copy)]
pub struct Tuples<const N: usize> {
    /// Range of each number.
    pub item: Range,
    /// Whether they must be integers.
    pub integer: bool,
}

impl<const N: usize> Tuples<N> {
    fn numbers(&self) -> Numbers {
        let (item, integer) = (self.item, self.integer);
        Numbers(NumbersKind { min: N, max: usize::MAX, multiple_of: N, item, integer, null: false })
    }
}

impl<const N: usize> Codec for Tuples<N> {
    type Value = Vec<[f64; N]>;

    fn kind(&self) -> Kind {
        self.numbers().kind()
    }

    fn read(&self, value: &Value) -> Result<Vec<[f64; N]>> {
        Ok(self.numbers().read(value)?.as_chunks().0.to_vec())
    }

    fn placeholder(&self) -> Vec<[f64; N]> {
        Vec::new()
    }
}

/// A list of anything but plain numbers.
#[derive(Debug, Clone, Copy)]
pub struct List<C> {
    /// What an item is called.
    pub what: &'static str,
    /// The items.
    pub item: C,
    /// Fewest items.
    pub min: usize,
    /// Most items.
    pub max: usize,
}

impl<C: Codec> Codec for List<C> {
    type Value = Vec<C::Value>;

    fn kind(&self) -> Kind {
        Kind::List { what: self.what, item: Box::new(self.item.kind()), min: self.min, max: self.max }
    }

    fn read(&self, value: &Value) -> Result<Vec<C::Value>> {
        let numbers: Vec<Json>;
        let items: &[Json] = match value.json {
            Json::List(items) => items,
            Json::Numbers(items) => {
                numbers = items.iter().map(|&x| Json::Number(x)).collect();
                &numbers
            }
            _ => return Err(value.wrong_type(&self.kind().expected())),
        };
        if items.len() < self.min {
            let message = format!("an empty list; expected at least {} item, each {}", self.min, self.what);
            return Err(value.error(ErrorKind::Missing, message));
        }
        if items.len() > self.max {
            let message = format!("a list of {} items; the limit is {}", items.len(), self.max);
            return Err(value.error(ErrorKind::LimitExceeded, message));
        }
        items.iter().enumerate().map(|(i, item)| value.item(i, item, &self.item)).collect()
    }

    fn placeholder(&self) -> Vec<C::Value> {
        Vec::new()
    }
}

/// An object whose keys are the user's names, in file order.
#[derive(Debug, Clone, Copy)]
pub struct Map<C> {
    /// What an entry is called.
    pub what: &'static str,
    /// The entries.
    pub item: C,
}

impl<C: Codec> Codec for Map<C> {
    type Value = Vec<(String, C::Value)>;

    fn kind(&self) -> Kind {
        Kind::Map { what: self.what, item: Box::new(self.item.kind()) }
    }

    fn read(&self, value: &Value) -> Result<Self::Value> {
        let entries = value.json.entries().ok_or_else(|| value.wrong_type(&self.kind().expected()))?;
        if entries.len() > MAX_NAMES {
            let message = format!("{} names; the limit is {MAX_NAMES}", entries.len());
            return Err(value.error(ErrorKind::LimitExceeded, message));
        }
        let mut read = Vec::with_capacity(entries.len());
        for (name, json) in entries {
            let path = Path::Key(value.path, name);
            let here = Value { json, path: &path, context: value.context };
            if name == "comment" {
                check_comment(&here)?;
            } else if name.is_empty() {
                let message = format!("an empty name; expected a name for {}", self.what);
                return Err(error(ErrorKind::Missing, &path, message));
            } else if name.len() > MAX_TEXT {
                let message = format!("a name of {} bytes; the limit is {MAX_TEXT}", name.len());
                return Err(error(ErrorKind::LimitExceeded, &path, message));
            } else {
                read.push((name.clone(), self.item.read(&here)?));
            }
        }
        Ok(read)
    }

    fn placeholder(&self) -> Self::Value {
        Vec::new()
    }
}
