//! Reading the values of an object that [`super::validate`] has passed, with the tables' defaults for absent keys.

use std::borrow::Cow;

use super::json::{self, Json};
use super::path::Path;
use super::tables::*;
use super::validate::{self, select};
use crate::Result;

/// An object of the file with its table.
///
/// The getters panic when asked for what the table does not say, which is a mistake in this module's callers and not in
/// a file: the file was checked against the same table.
pub struct Fields<'a> {
    table: &'static Table,
    json: &'a Json,
    path: &'a Path<'a>,
}

impl<'a> Fields<'a> {
    /// The keys of an object whose table is known.
    pub fn new(table: &'static Table, json: &'a Json, path: &'a Path<'a>) -> Self {
        Self { table, json, path }
    }

    /// The keys of a tagged object, and its kind.
    pub fn tagged(tagged: &'static Tagged, json: &'a Json, path: &'a Path<'a>) -> Result<(&'static str, Self)> {
        let selected = select(tagged, json, path)?;
        Ok((selected.name, Self::new(selected.table, json, path)))
    }

    /// The keys of an object recognised by them, and the first key of its form.
    pub fn form(forms: &'static Forms, json: &'a Json, path: &'a Path<'a>) -> Result<(&'static str, Self)> {
        let table = validate::select_form(forms, json.entries().unwrap_or_default(), path)?;
        Ok((table.fields[0].key, Self::new(table, json, path)))
    }

    /// Where the object stands.
    pub fn path(&self) -> &'a Path<'a> {
        self.path
    }

    /// Where a key of it stands.
    pub fn at(&self, key: &'a str) -> Path<'a> {
        Path::Key(self.path, key)
    }

    /// The value of a key if it is there, without its default.
    pub fn given(&self, key: &str) -> Option<&'a Json> {
        self.json.get(key)
    }

    /// The value of a key, or its default.
    pub fn value(&self, key: &str) -> Cow<'a, Json> {
        if let Some(value) = self.given(key) {
            return Cow::Borrowed(value);
        }
        match self.table.field(key).map(|field| field.need) {
            Some(Need::Default(text)) => Cow::Owned(json::parse(text.as_bytes()).expect("defaults are JSON")),
            other => panic!("{} has no default for `{key}`: {other:?}", self.table.what),
        }
    }

    /// A number.
    pub fn number(&self, key: &str) -> f64 {
        self.value(key).as_number().expect("checked to be a number")
    }

    /// A number that may be absent.
    pub fn number_if_given(&self, key: &str) -> Option<f64> {
        self.given(key).map(|value| value.as_number().expect("checked to be a number"))
    }

    /// An integer.
    pub fn integer(&self, key: &str) -> i64 {
        self.value(key).as_integer().expect("checked to be an integer")
    }

    /// `true` or `false`.
    pub fn flag(&self, key: &str) -> bool {
        matches!(*self.value(key), Json::Bool(true))
    }

    /// A string.
    pub fn text(&self, key: &str) -> String {
        self.value(key).as_text().expect("checked to be a string").to_owned()
    }

    /// A string that may be absent.
    pub fn text_if_given(&self, key: &str) -> Option<String> {
        self.given(key).and_then(Json::as_text).map(str::to_owned)
    }

    /// A list of numbers; `null` reads as infinity.
    pub fn numbers(&self, key: &str) -> Vec<f64> {
        match &*self.value(key) {
            Json::Numbers(items) => items.clone(),
            Json::List(items) => items.iter().map(|item| item.as_number().unwrap_or(f64::INFINITY)).collect(),
            other => panic!("checked to be a list, but is {}", other.found()),
        }
    }

    /// A list of `N` numbers.
    pub fn array<const N: usize>(&self, key: &str) -> [f64; N] {
        self.numbers(key).try_into().expect("checked to be of this length")
    }

    /// A flat list as tuples; empty if absent.
    pub fn tuples<const N: usize>(&self, key: &str) -> Vec<[f64; N]> {
        match self.given(key) {
            Some(Json::Numbers(items)) => items.as_chunks().0.to_vec(),
            _ => Vec::new(),
        }
    }
}

/// The items of a list of objects.
pub fn items(json: &Json) -> &[Json] {
    match json {
        Json::List(items) => items,
        _ => &[],
    }
}

/// The entries of a map of the user's names.
pub fn named(json: &Json) -> impl Iterator<Item = &(String, Json)> {
    json.entries().unwrap_or_default().iter().filter(|(name, _)| name != "comment")
}
