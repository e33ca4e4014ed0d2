//! Objects with known keys: one function both declares an object's keys and reads them.
//!
//! Run on an object of the file, each call returns the key's value; run on nothing, each call records what the key is,
//! and the record is what the schema and the reference are made of. So that both see the same keys, a function asks for
//! all of its keys, whatever their values, and leaves what holds between them to [`Object::check`].

use super::super::context::Context;
use super::super::json::{self, Json};
use super::super::path::Path;
use super::super::text::quote;
use super::kind::{Field, Kind, Need, Rule, Table};
use super::values::find_name;
use super::{Codec, Value, error, with_nearest};
use crate::{ErrorKind, Result};

/// An object that is read or described.
pub struct Object<'a> {
    /// With its article: "a sphere".
    what: &'static str,
    /// What is read of it, if it is in a file.
    file: Option<Reading<'a>>,
    /// What is declared of it; recorded where there is no file.
    table: Table,
}

/// What is known of an object of the file.
struct Reading<'a> {
    value: Value<'a>,
    entries: &'a [(String, Json)],
    /// Keys that were asked for.
    asked: Vec<&'static str>,
    /// Keys that must be there.
    required: Vec<&'static str>,
    /// The first of those that is not.
    missing: Option<&'static str>,
    /// Whether it is one of those that `rule` wants.
    missing_by_rule: bool,
}

/// One kind of an object, told by the value of a tag or by its first key.
pub struct Variant<T> {
    /// The tag's value, or the key.
    pub name: &'static str,
    /// With its article: "a sphere".
    pub what: &'static str,
    /// What it is.
    pub doc: &'static str,
    /// Declares and reads the keys that it has beside the common ones.
    pub read: fn(&mut Object) -> Result<T>,
}

/// An object with known keys, as a codec.
pub struct Record<T> {
    /// With its article: "a film".
    pub what: &'static str,
    /// What it is.
    pub doc: &'static str,
    /// Declares and reads its keys.
    pub read: fn(&mut Object) -> Result<T>,
}

impl<T> Codec for Record<T> {
    type Value = T;

    fn kind(&self) -> Kind {
        Kind::Object(Box::new(describe(self.what, self.doc, self.read).0))
    }

    fn read(&self, value: &Value) -> Result<T> {
        let Some(entries) = value.json.entries() else {
            return Err(value.wrong_type(&format!("an object ({})", self.what)));
        };
        let mut object = Object::new(self.what, self.doc, Some(Reading::new(*value, entries)));
        let read = (self.read)(&mut object)?;
        object.finish()?;
        Ok(read)
    }

    fn placeholder(&self) -> T {
        describe(self.what, self.doc, self.read).1
    }
}

/// Runs `read` on nothing: what it declares, and what it makes of placeholders.
pub fn describe<T>(what: &'static str, doc: &'static str, read: fn(&mut Object) -> Result<T>) -> (Table, T) {
    let mut object = Object::new(what, doc, None);
    let placeholder = read(&mut object).expect("objects fail in checks alone, and these do not run here");
    (object.table, placeholder)
}

impl<'a> Reading<'a> {
    fn new(value: Value<'a>, entries: &'a [(String, Json)]) -> Self {
        Self {
            value,
            entries,
            asked: Vec::with_capacity(8),
            required: Vec::new(),
            missing: None,
            missing_by_rule: false,
        }
    }

    fn get(&self, key: &str) -> Option<&'a Json> {
        self.entries.iter().find(|(name, _)| name == key).map(|(_, json)| json)
    }

    fn ask(&mut self, key: &'static str) {
        if !self.asked.contains(&key) {
            self.asked.push(key);
        }
    }

    fn lacks(&mut self, key: &'static str, rule: Rule) {
        if self.missing.is_none() {
            self.missing = Some(key);
            self.missing_by_rule = rule.sets().iter().any(|set| set.contains(&key));
        }
    }
}

impl<'a> Object<'a> {
    fn new(what: &'static str, doc: &'static str, file: Option<Reading<'a>>) -> Self {
        let table = Table { what, doc, fields: Vec::new(), tag: None, variants: Vec::new(), rule: Rule::Free };
        Self { what, file, table }
    }

    /// A key that must be there.
    pub fn required<C: Codec>(&mut self, key: &'static str, codec: C, doc: &'static str) -> Result<C::Value> {
        if let Some(reading) = &mut self.file {
            reading.required.push(key);
            if reading.get(key).is_none() {
                reading.lacks(key, self.table.rule);
            }
        }
        Ok(self.given(key, &codec, Need::Required, doc)?.unwrap_or_else(|| codec.placeholder()))
    }

    /// A key that may be absent.
    pub fn optional<C: Codec>(&mut self, key: &'static str, codec: C, doc: &'static str) -> Result<Option<C::Value>> {
        self.given(key, &codec, Need::Optional, doc)
    }

    /// A key that means the JSON text `default` when absent.
    pub fn default<C: Codec>(
        &mut self,
        key: &'static str,
        codec: C,
        default: &'static str,
        doc: &'static str,
    ) -> Result<C::Value> {
        if let Some(value) = self.given(key, &codec, Need::Default(default), doc)? {
            return Ok(value);
        }
        let json = json::parse(default.as_bytes())?;
        match &self.file {
            Some(Reading { value, .. }) => {
                codec.read(&Value { json: &json, path: &Path::Key(value.path, key), context: value.context })
            }
            None => codec.read(&Value { json: &json, path: &Path::Root, context: &Context::default() }),
        }
    }

    /// Reads a key if it is in the file, or records it.
    fn given<C: Codec>(
        &mut self,
        key: &'static str,
        codec: &C,
        need: Need,
        doc: &'static str,
    ) -> Result<Option<C::Value>> {
        match &mut self.file {
            None => {
                self.table.fields.push(Field { key, kind: codec.kind(), need, doc });
                Ok(None)
            }
            Some(reading) => {
                reading.ask(key);
                let read = |json| {
                    let path = Path::Key(reading.value.path, key);
                    codec.read(&Value { json, path: &path, context: reading.value.context })
                };
                reading.get(key).map(read).transpose()
            }
        }
    }

    /// The kind of object that the value of `tag` tells.
    pub(crate) fn tagged<T>(&mut self, tag: &'static str, variants: &[Variant<T>]) -> Result<T> {
        let Some(reading) = &mut self.file else {
            self.table.tag = Some(tag);
            return Ok(self.describe_variants(variants));
        };
        reading.ask(tag);
        let names = variants.iter().map(|variant| variant.name);
        let json = reading.get(tag).ok_or_else(|| {
            let valid = names.clone().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ");
            let message = format!("missing key `{tag}`; {} has one of {valid}", self.what);
            reading.value.error(ErrorKind::Missing, message)
        })?;
        let path = Path::Key(reading.value.path, tag);
        let value = Value { json, path: &path, context: reading.value.context };
        let variant = &variants[find_name(&value, &format!("the {tag} of {}", self.what), names)?];
        self.what = variant.what;
        (variant.read)(self)
    }

    /// The kind of object that its first key tells. Keys that all kinds have are asked for before.
    pub(crate) fn form<T>(&mut self, variants: &[Variant<T>]) -> Result<T> {
        let Some(reading) = &self.file else { return Ok(self.describe_variants(variants)) };
        let variant = chosen_form(self.what, reading, variants)?;
        self.what = variant.what;
        (variant.read)(self)
    }

    fn describe_variants<T>(&mut self, variants: &[Variant<T>]) -> T {
        let described = variants.iter().map(|variant| describe(variant.what, variant.doc, variant.read));
        let (tables, placeholders): (Vec<Table>, Vec<T>) = described.unzip();
        self.table.variants = variants.iter().map(|variant| variant.name).zip(tables).collect();
        placeholders.into_iter().next().expect("an object of variants has at least one")
    }

    /// One set of keys out of several; `read` asks for the keys of the set whose index it gets.
    pub(crate) fn one_of<T>(
        &mut self,
        sets: &'static [&'static [&'static str]],
        read: impl Fn(&mut Self, usize) -> Result<T>,
    ) -> Result<T> {
        self.table.rule = Rule::OneOf(sets);
        let Some(reading) = &mut self.file else {
            let first = read(self, 0)?;
            for set in 1..sets.len() {
                read(self, set)?;
            }
            let in_sets = |field: &&mut Field| sets.iter().any(|set| set.contains(&field.key));
            self.table.fields.iter_mut().filter(in_sets).for_each(|field| field.need = Need::Optional);
            return Ok(first);
        };
        sets.iter().copied().flatten().for_each(|key| reading.ask(key));
        let mut begun = (0..sets.len()).filter(|&i| sets[i].iter().any(|key| reading.get(key).is_some()));
        let set = begun.next().unwrap_or(0);
        if begun.next().is_some() {
            let message = format!("{} has just one of: {}", self.what, self.table.rule.describe());
            return Err(reading.value.error(ErrorKind::UnknownKey, message));
        }
        read(self, set)
    }

    /// Demands that at least one of these sets of keys is complete.
    pub(crate) fn any_of(&mut self, sets: &'static [&'static [&'static str]]) {
        self.table.rule = Rule::AnyOf(sets);
        if let Some(reading) = &mut self.file {
            let complete = |set: &&[&str]| set.iter().all(|key| reading.get(key).is_some());
            if !sets.iter().any(complete) {
                reading.lacks(sets[0][0], self.table.rule);
            }
        }
    }

    /// The key that every scene object may have.
    pub fn name(&mut self) -> Result<Option<String>> {
        self.optional("name", super::Name("a name for messages"), "A name for messages.")
    }

    /// Checks what holds between keys, once all are there.
    pub fn check(&self, test: impl FnOnce(&Value) -> Result<()>) -> Result<()> {
        match &self.file {
            Some(reading) if reading.missing.is_none() => test(&reading.value),
            _ => Ok(()),
        }
    }

    /// Fails with a message at `key`, or at the object itself if that is empty, when `wrong` holds.
    pub(crate) fn refuse_if(
        &self,
        wrong: bool,
        kind: ErrorKind,
        key: &str,
        message: impl FnOnce() -> String,
    ) -> Result<()> {
        self.check(|value| match (wrong, key) {
            (false, _) => Ok(()),
            (true, "") => Err(value.error(kind, message())),
            (true, key) => Err(error(kind, &Path::Key(value.path, key), message())),
        })
    }

    /// Its place in the file.
    pub fn at(&self) -> String {
        self.file.as_ref().map_or(String::new(), |reading| reading.value.path.to_string())
    }

    /// Refuses keys that nobody asked for, and objects that lack one.
    fn finish(&self) -> Result<()> {
        let Some(reading) = &self.file else { return Ok(()) };
        let path = reading.value.path;
        for (key, json) in reading.entries {
            let here = Path::Key(path, key);
            if key == "comment" {
                check_comment(&Value { json, path: &here, ..reading.value })?;
            } else if !reading.asked.contains(&key.as_str()) {
                let message = format!("unknown key {}; {} has {}", quote(key), self.what, reading.asked.join(", "));
                let error = error(ErrorKind::UnknownKey, &here, message);
                return Err(with_nearest(error, key, reading.asked.iter().copied()));
            }
        }
        let Some(key) = reading.missing else { return Ok(()) };
        let needs = if reading.missing_by_rule { self.table.rule.describe() } else { reading.required.join(", ") };
        let message = format!("missing key `{key}`; {} needs {needs}", self.what);
        Err(reading.value.error(ErrorKind::Missing, message))
    }
}

/// Comments are strings of any length.
pub fn check_comment(value: &Value) -> Result<()> {
    match value.json {
        Json::Text(_) => Ok(()),
        _ => Err(value.wrong_type("a string (\"comment\" is reserved for remarks)")),
    }
}

/// The form whose key the object has.
fn chosen_form<'f, T>(what: &str, reading: &Reading, forms: &'f [Variant<T>]) -> Result<&'f Variant<T>> {
    let keys = || forms.iter().map(|form| form.name);
    let only_one = || format!("{what} has just one of {}", keys().collect::<Vec<_>>().join(", "));
    let mut told = reading.entries.iter().filter_map(|(key, _)| forms.iter().find(|form| form.name == key));
    if let Some(form) = told.next() {
        let Some(other) = told.next() else { return Ok(form) };
        let message = format!("`{}` does not go with `{}`: {}", other.name, form.name, only_one());
        return Err(error(ErrorKind::UnknownKey, &Path::Key(reading.value.path, other.name), message));
    }
    // A form whose first key is missing is told by another of its keys.
    let tables: Vec<Table> = forms.iter().map(|form| describe(form.what, form.doc, form.read).0).collect();
    let has = |table: &Table| table.fields.iter().any(|field| reading.get(field.key).is_some());
    if let Some(index) = tables.iter().position(has) {
        return Ok(&forms[index]);
    }
    let common = |key: &str| key == "comment" || reading.asked.contains(&key);
    let Some((key, _)) = reading.entries.iter().find(|(key, _)| !common(key)) else {
        return Err(reading.value.error(ErrorKind::Missing, only_one()));
    };
    let message = format!("unknown key {}; {}", quote(key), only_one());
    let error = error(ErrorKind::UnknownKey, &Path::Key(reading.value.path, key), message);
    let known = tables.iter().flat_map(|table| &table.fields).map(|field| field.key);
    Err(with_nearest(error, key, known.chain(reading.asked.iter().copied())))
}
