//! Checks a file against the tables: types, ranges, unknown and missing keys, alternatives.
//!
//! What needs more than one value (names, geometry, spectra in their roles) is checked by the decoder afterwards.

use super::json::{Json, quote, show};
use super::path::Path;
use super::tables::*;
use crate::{Error, ErrorKind, Result};

/// Longest name that is compared with the valid ones: the comparison's time grows with the square of it.
const MAX_COMPARED: usize = 64;

/// An error at a path.
pub fn error(kind: ErrorKind, path: &Path, message: impl Into<String>) -> Error {
    Error::new(kind, message).at(path.to_string())
}

/// Adds the candidate nearest to `name`, if the name is short enough to be one with a slip in it.
pub fn with_nearest<'a>(error: Error, name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Error {
    if name.len() <= MAX_COMPARED { error.nearest(name, candidates) } else { error }
}

/// Checks `json` against `kind`.
pub fn check(kind: &Kind, json: &Json, path: &Path) -> Result<()> {
    match kind {
        Kind::Number(range) => check_number(kind, range, json, path),
        Kind::Integer(range) => check_integer(kind, range, json, path),
        Kind::Bool if matches!(json, Json::Bool(_)) => Ok(()),
        Kind::Text => check_text(kind, json, path).map(drop),
        Kind::Name(_) => check_name(kind, json, path).map(drop),
        Kind::File(file) => check_file(file, check_name(kind, json, path)?, path),
        Kind::Choice(choice) => check_choice(choice, check_text(kind, json, path)?, path),
        Kind::Numbers(numbers) => check_numbers(numbers, json, path),
        Kind::List(list) => check_list(list, json, path),
        Kind::Map(map) => check_map(map, json, path),
        Kind::Object(table) => check_table(table, &[], json, path),
        Kind::Tagged(tagged) => {
            let selected = select(tagged, json, path)?;
            check_table(selected.table, &selected.tags, json, path)
        }
        Kind::Forms(forms) => check_forms(forms, json, path),
        Kind::Spectrum(_) => check_forms(&SPECTRUM, json, path),
        Kind::Either(kinds) => match kinds.iter().find(|kind| has_type(kind, json)) {
            Some(kind) => check(kind, json, path),
            None => Err(wrong_type(&kind.expected(), json, path)),
        },
        Kind::Bool => Err(wrong_type(&kind.expected(), json, path)),
    }
}

/// "expected …, found …".
pub fn wrong_type(expected: &str, json: &Json, path: &Path) -> Error {
    error(ErrorKind::WrongType, path, format!("expected {expected}, found {}", json.found()))
}

/// Whether the JSON type alone fits; decides between the kinds of a [`Kind::Either`].
fn has_type(kind: &Kind, json: &Json) -> bool {
    match kind {
        Kind::Number(_) => json.as_number().is_some(),
        Kind::Choice(_) => json.as_text().is_some(),
        Kind::Numbers(_) => matches!(json, Json::Numbers(_) | Json::List(_)),
        _ => false,
    }
}

fn out_of_range(expected: &str, found: String, path: &Path) -> Error {
    error(ErrorKind::OutOfRange, path, format!("expected {expected}, found {found}"))
}

fn check_number(kind: &Kind, range: &Range, json: &Json, path: &Path) -> Result<()> {
    match json.as_number() {
        None => Err(wrong_type(&kind.expected(), json, path)),
        Some(value) if !range.contains(value) => Err(out_of_range(&kind.expected(), show(value), path)),
        Some(_) => Ok(()),
    }
}

fn check_integer(kind: &Kind, range: &Range, json: &Json, path: &Path) -> Result<()> {
    let inside = |value: i64| (range.min as i64..=range.max as i64).contains(&value);
    match (json.as_integer(), json.as_number()) {
        (Some(value), _) if inside(value) => Ok(()),
        (Some(value), _) => Err(out_of_range(&kind.expected(), value.to_string(), path)),
        (None, Some(value)) if value.fract() == 0.0 => Err(out_of_range(&kind.expected(), show(value), path)),
        (None, _) => Err(wrong_type(&kind.expected(), json, path)),
    }
}

fn check_text<'a>(kind: &Kind, json: &'a Json, path: &Path) -> Result<&'a str> {
    let text = json.as_text().ok_or_else(|| wrong_type(&kind.expected(), json, path))?;
    if text.len() > MAX_TEXT {
        let message = format!("a string of {} bytes; the limit is {MAX_TEXT}", text.len());
        return Err(error(ErrorKind::LimitExceeded, path, message));
    }
    Ok(text)
}

fn check_name<'a>(kind: &Kind, json: &'a Json, path: &Path) -> Result<&'a str> {
    let text = check_text(kind, json, path)?;
    if text.is_empty() {
        return Err(error(ErrorKind::Missing, path, format!("an empty string; expected {}", kind.expected())));
    }
    Ok(text)
}

fn check_file(file: &FileKind, name: &str, path: &Path) -> Result<()> {
    let extension = name.rsplit_once('.').map_or(String::new(), |(_, end)| end.to_ascii_lowercase());
    let extension = extension.as_str();
    if file.extensions.contains(&extension) {
        return Ok(());
    }
    let (kind, yet) = match file.later.contains(&extension) {
        true => (ErrorKind::Unsupported, format!("files of type .{extension} are not read yet")),
        false => (ErrorKind::FileFormat, format!("{} has an unknown file type", quote(name))),
    };
    Err(error(kind, path, format!("{yet}; expected {}", file.expected())))
}

fn check_choice(choice: &Choice, text: &str, path: &Path) -> Result<()> {
    if choice.names.iter().any(|(name, _)| *name == text) {
        return Ok(());
    }
    Err(unknown_name(choice.what, text, choice.names.iter().map(|(name, _)| *name), choice.later, path))
}

/// A name outside a closed set.
fn unknown_name(
    what: &str,
    text: &str,
    names: impl Iterator<Item = &'static str> + Clone,
    later: &[&str],
    path: &Path,
) -> Error {
    let valid = names.clone().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ");
    if later.contains(&text) {
        return error(ErrorKind::Unsupported, path, format!("{what} {text:?} is not supported yet; expected {valid}"));
    }
    let message = format!("{} is not {what}; expected {valid}", quote(text));
    with_nearest(error(ErrorKind::UnknownName, path, message), text, names)
}

fn check_numbers(numbers: &Numbers, json: &Json, path: &Path) -> Result<()> {
    let kind = Kind::Numbers(*numbers);
    let count = match json {
        Json::Numbers(items) => items.len(),
        Json::List(items) => items.len(),
        _ => return Err(wrong_type(&kind.expected(), json, path)),
    };
    if count == 0 && numbers.min > 0 {
        return Err(error(ErrorKind::Missing, path, format!("an empty list; expected {}", kind.expected())));
    }
    if count > numbers.max && numbers.max != numbers.min {
        let message = format!("a list of {count} numbers; the limit is {}", numbers.max);
        return Err(error(ErrorKind::LimitExceeded, path, message));
    }
    if count < numbers.min || count > numbers.max || !count.is_multiple_of(numbers.multiple_of) {
        let message = format!("expected {}, found {count}", kind.expected());
        return Err(error(ErrorKind::WrongType, path, message));
    }
    match json {
        Json::Numbers(items) => {
            items.iter().enumerate().try_for_each(|(i, value)| check_item(numbers, *value, &Path::Index(path, i)))
        }
        Json::List(items) => items.iter().enumerate().try_for_each(|(i, item)| {
            let here = Path::Index(path, i);
            match item {
                Json::Null if numbers.null => Ok(()),
                _ => check_item(numbers, item.as_number().ok_or_else(|| not_an_item(numbers, item, &here))?, &here),
            }
        }),
        _ => Ok(()),
    }
}

fn not_an_item(numbers: &Numbers, item: &Json, path: &Path) -> Error {
    let expected = Kind::Number(numbers.item).expected();
    wrong_type(&if numbers.null { format!("{expected} or null") } else { expected }, item, path)
}

fn check_item(numbers: &Numbers, value: f64, path: &Path) -> Result<()> {
    let whole = value.fract() == 0.0 || !numbers.integer;
    if whole && numbers.item.contains(value) {
        return Ok(());
    }
    let kind = if numbers.integer { Kind::Integer(numbers.item) } else { Kind::Number(numbers.item) };
    match whole {
        true => Err(out_of_range(&kind.expected(), show(value), path)),
        false => Err(wrong_type(&kind.expected(), &Json::Number(value), path)),
    }
}

fn check_list(list: &List, json: &Json, path: &Path) -> Result<()> {
    let items: &[Json] = match json {
        Json::List(items) => items,
        Json::Numbers(items) if items.is_empty() => &[],
        Json::Numbers(items) => return check(&list.item, &Json::Number(items[0]), &Path::Index(path, 0)),
        _ => return Err(wrong_type(&format!("a list, each item {}", list.what), json, path)),
    };
    if items.len() < list.min {
        let message = format!("an empty list; expected at least {} item, each {}", list.min, list.what);
        return Err(error(ErrorKind::Missing, path, message));
    }
    if items.len() > list.max {
        let message = format!("a list of {} items; the limit is {}", items.len(), list.max);
        return Err(error(ErrorKind::LimitExceeded, path, message));
    }
    items.iter().enumerate().try_for_each(|(i, item)| check(&list.item, item, &Path::Index(path, i)))
}

fn check_map(map: &Map, json: &Json, path: &Path) -> Result<()> {
    let expected = || format!("an object of names, each with {}", map.what);
    let entries = json.entries().ok_or_else(|| wrong_type(&expected(), json, path))?;
    if entries.len() > MAX_NAMES {
        let message = format!("{} names; the limit is {MAX_NAMES}", entries.len());
        return Err(error(ErrorKind::LimitExceeded, path, message));
    }
    for (name, value) in entries {
        let here = Path::Key(path, name);
        if name == "comment" {
            check_comment(value, &here)?;
        } else if name.is_empty() {
            return Err(error(ErrorKind::Missing, &here, format!("an empty name; expected a name for {}", map.what)));
        } else if name.len() > MAX_TEXT {
            let message = format!("a name of {} bytes; the limit is {MAX_TEXT}", name.len());
            return Err(error(ErrorKind::LimitExceeded, &here, message));
        } else {
            check(&map.item, value, &here)?;
        }
    }
    Ok(())
}

/// Comments are strings of any length.
fn check_comment(json: &Json, path: &Path) -> Result<()> {
    json.as_text().map(drop).ok_or_else(|| wrong_type("a string (\"comment\" is reserved for remarks)", json, path))
}

/// A kind of a [`Tagged`], found by its tags.
pub struct Selected {
    /// The innermost name: "sphere", "torus".
    pub name: &'static str,
    /// Its keys.
    pub table: &'static Table,
    /// The keys that told.
    pub tags: Vec<&'static str>,
}

/// Finds the kind of a tagged object.
pub fn select(tagged: &'static Tagged, json: &Json, path: &Path) -> Result<Selected> {
    let mut tags = Vec::with_capacity(2);
    let mut tagged = tagged;
    loop {
        if json.entries().is_none() {
            return Err(wrong_type(&format!("an object ({})", tagged.what), json, path));
        }
        let names = tagged.variants.iter().map(|(name, _)| *name);
        let tag = json.get(tagged.tag).ok_or_else(|| {
            let valid = names.clone().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ");
            let message = format!("missing key `{}`; {} has one of {valid}", tagged.tag, tagged.what);
            error(ErrorKind::Missing, path, message)
        })?;
        let here = Path::Key(path, tagged.tag);
        let text = check_text(&Kind::Text, tag, &here)?;
        let variant = tagged.variants.iter().find(|(name, _)| *name == text);
        let (name, body) = variant.ok_or_else(|| {
            let what = format!("the {} of {}", tagged.tag, tagged.what);
            unknown_name(&what, text, names, tagged.later, &here)
        })?;
        tags.push(tagged.tag);
        match body {
            Body::Table(table) => return Ok(Selected { name, table, tags }),
            Body::Tagged(inner) => tagged = inner,
        }
    }
}

fn check_forms(forms: &'static Forms, json: &Json, path: &Path) -> Result<()> {
    match (json, &forms.number, forms.text) {
        (Json::Integer(_) | Json::Number(_), Some((_, range)), _) => check(&Kind::Number(*range), json, path),
        (Json::Text(_), _, Some(_)) => check(&Kind::Name("a name"), json, path),
        (Json::Text(text), _, None) if forms.owner("glass").is_some() => {
            let message =
                format!("expected {}, found a string; a glass is {{\"glass\": {}}}", forms.expected(), quote(text));
            Err(error(ErrorKind::WrongType, path, message))
        }
        (Json::Object(entries), _, _) => {
            let form = select_form(forms, entries, path)?;
            for (key, _) in entries {
                if forms.owner(key).is_some_and(|owner| !std::ptr::eq(owner, form)) {
                    let message = format!("`{key}` does not go with `{}`: {}", form.fields[0].key, only_one(forms));
                    return Err(error(ErrorKind::UnknownKey, &Path::Key(path, key), message));
                }
            }
            check_table(form, &[], json, path)
        }
        _ => Err(wrong_type(&forms.expected(), json, path)),
    }
}

fn only_one(forms: &Forms) -> String {
    let keys: Vec<&str> = forms.forms.iter().map(|form| form.fields[0].key).collect();
    format!("{} has just one of {}", forms.what, keys.join(", "))
}

/// The form that owns the first key that tells.
pub fn select_form(forms: &'static Forms, entries: &[(String, Json)], path: &Path) -> Result<&'static Table> {
    if let Some(form) = entries.iter().find_map(|(key, _)| forms.owner(key)) {
        return Ok(form);
    }
    let known = || forms.forms.iter().flat_map(|form| form.all_fields()).map(|field| field.key);
    let unknown = entries.iter().find(|(key, _)| key != "comment" && known().all(|name| name != key));
    Err(match unknown {
        Some((key, _)) => {
            let message = format!("unknown key {}; {}", quote(key), only_one(forms));
            with_nearest(error(ErrorKind::UnknownKey, &Path::Key(path, key), message), key, known())
        }
        None => error(ErrorKind::Missing, path, only_one(forms)),
    })
}

/// Checks an object's keys and values; `tags` are the keys that told its kind.
fn check_table(table: &'static Table, tags: &[&str], json: &Json, path: &Path) -> Result<()> {
    let expected = || format!("an object ({})", table.what);
    let entries = json.entries().ok_or_else(|| wrong_type(&expected(), json, path))?;
    for (key, value) in entries {
        let here = Path::Key(path, key);
        match table.field(key) {
            Some(field) => check(&field.kind, value, &here)?,
            None if key == "comment" => check_comment(value, &here)?,
            None if tags.contains(&key.as_str()) => {}
            None => return Err(unknown_key(table, tags, key, &here)),
        }
    }
    let has = |key: &str| entries.iter().any(|(name, _)| name == key);
    let required = table.fields.iter().filter(|field| field.need == Need::Required);
    if let Some(field) = required.clone().find(|field| !has(field.key)) {
        let needs: Vec<&str> = required.map(|field| field.key).collect();
        let message = format!("missing key `{}`; {} needs {}", field.key, table.what, needs.join(", "));
        return Err(error(ErrorKind::Missing, path, message));
    }
    check_rule(table, has, path)
}

fn unknown_key(table: &'static Table, tags: &[&str], key: &str, path: &Path) -> Error {
    if table.later.contains(&key) {
        return error(ErrorKind::Unsupported, path, format!("`{key}` of {} is not supported yet", table.what));
    }
    let known: Vec<&str> = tags.iter().copied().chain(table.all_fields().map(|field| field.key)).collect();
    let message = format!("unknown key {}; {} has {}", quote(key), table.what, known.join(", "));
    with_nearest(error(ErrorKind::UnknownKey, path, message), key, known)
}

fn check_rule(table: &Table, has: impl Fn(&str) -> bool, path: &Path) -> Result<()> {
    let (alternatives, only_one) = match table.rule {
        Rule::Free => return Ok(()),
        Rule::AnyOf(alternatives) => (alternatives, false),
        Rule::OneOf(alternatives) => (alternatives, true),
    };
    let complete = alternatives.iter().filter(|keys| keys.iter().all(|key| has(key))).count();
    let begun = alternatives.iter().filter(|keys| keys.iter().any(|key| has(key))).count();
    let names: Vec<String> = alternatives.iter().map(|keys| keys.join(" and ")).collect();
    let (what, names) = (table.what, names.join(", or "));
    if only_one && begun > 1 {
        return Err(error(ErrorKind::UnknownKey, path, format!("{what} has just one of: {names}")));
    }
    if complete > 0 {
        return Ok(());
    }
    let missing = alternatives.iter().find(|keys| keys.iter().any(|key| has(key))).unwrap_or(&alternatives[0]);
    let missing = missing.iter().find(|key| !has(key)).unwrap_or(&missing[0]);
    Err(error(ErrorKind::Missing, path, format!("missing key `{missing}`; {what} needs {names}")))
}
