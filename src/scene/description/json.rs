//! JSON as a tree that keeps what serde_json's own would lose: the order of keys, repeated keys (so that they can be
//! refused) and exact integers. Lists of numbers are stored compactly, as scenes can carry millions of them.

use std::cell::Cell;
use std::collections::HashSet;
use std::fmt;
use std::io::Read;

use serde::de::{DeserializeSeed, Deserializer, Error as _, MapAccess, SeqAccess, Visitor};

use super::path::Path;
use super::text::{quote, show};
use crate::{Error, ErrorKind, Result};

/// Largest scene file that is read, bytes.
pub const MAX_FILE_BYTES: u64 = 256 << 20;

/// Largest count of values other than plain numbers inside lists, which bounds the memory a hostile file can use.
const MAX_VALUES: usize = 30_000_000;

/// A JSON value.
#[derive(Debug, Clone, PartialEq)]
pub enum Json {
    /// `null`.
    Null,
    /// `true` or `false`.
    Bool(bool),
    /// A number written as an integer that fits.
    Integer(i64),
    /// Any other number; finite.
    Number(f64),
    /// A string.
    Text(String),
    /// A list of nothing but numbers (also the empty list).
    Numbers(Vec<f64>),
    /// Any other list.
    List(Vec<Json>),
    /// An object, its keys in file order and each given once.
    Object(Vec<(String, Json)>),
}

impl Json {
    /// The value as a number.
    pub fn as_number(&self) -> Option<f64> {
        match self {
            Json::Integer(value) => Some(*value as f64),
            Json::Number(value) => Some(*value),
            _ => None,
        }
    }

    /// The value as an integer, exactly; `4.0` counts as 4.
    pub fn as_integer(&self) -> Option<i64> {
        match self {
            Json::Integer(value) => Some(*value),
            Json::Number(value) if value.fract() == 0.0 && value.abs() <= (1u64 << 53) as f64 => Some(*value as i64),
            _ => None,
        }
    }

    /// The value as a string.
    pub fn as_text(&self) -> Option<&str> {
        match self {
            Json::Text(text) => Some(text),
            _ => None,
        }
    }

    /// The entries of an object.
    pub fn entries(&self) -> Option<&[(String, Json)]> {
        match self {
            Json::Object(entries) => Some(entries),
            _ => None,
        }
    }

    /// The value of an object's key.
    pub fn get(&self, key: &str) -> Option<&Json> {
        self.entries()?.iter().find(|(name, _)| name == key).map(|(_, value)| value)
    }

    /// What this is, for messages: `a string: "5 m"`.
    pub fn found(&self) -> String {
        match self {
            Json::Null => "null".into(),
            Json::Bool(value) => format!("{value}"),
            Json::Integer(value) => format!("a number: {value}"),
            Json::Number(value) => format!("a number: {}", show(*value)),
            Json::Text(text) => format!("a string: {}", quote(text)),
            Json::Numbers(items) if items.is_empty() => "an empty list".into(),
            Json::Numbers(items) => format!("a list of {} numbers", items.len()),
            Json::List(_) => "a list".into(),
            Json::Object(_) => "an object".into(),
        }
    }
}

/// Reads at most [`MAX_FILE_BYTES`] from `reader`.
pub fn read_limited(reader: impl Read) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    reader
        .take(MAX_FILE_BYTES + 1)
        .read_to_end(&mut bytes)
        .map_err(|error| Error::new(ErrorKind::Io, format!("reading failed: {error}")))?;
    check_size(bytes.len() as u64)?;
    Ok(bytes)
}

/// Refuses files above [`MAX_FILE_BYTES`].
pub fn check_size(bytes: u64) -> Result<()> {
    if bytes <= MAX_FILE_BYTES {
        return Ok(());
    }
    let message = format!("the file has more than {} MB, the limit of scene files", MAX_FILE_BYTES >> 20);
    Err(Error::new(ErrorKind::LimitExceeded, message))
}

/// The tree of a JSON text. A byte order mark is skipped.
///
/// Errors: not UTF-8, not JSON (with line and column), numbers beyond f64, nesting beyond 128, repeated keys.
pub fn parse(bytes: &[u8]) -> Result<Json> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    check_size(bytes.len() as u64)?;
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let before = &bytes[..error.valid_up_to()];
        let line = before.iter().filter(|&&byte| byte == b'\n').count() + 1;
        let column = before.iter().rev().take_while(|&&byte| byte != b'\n').count() + 1;
        Error::new(ErrorKind::Syntax, "a byte that is not UTF-8; expected a JSON file in UTF-8")
            .at(format!("line {line} column {column}"))
    })?;
    let values = Cell::new(0);
    let mut deserializer = serde_json::Deserializer::from_str(text);
    let json = Node { values: &values }
        .deserialize(&mut deserializer)
        .and_then(|json| deserializer.end().map(|()| json))
        .map_err(|error| syntax_error(text, &error, values.get()))?;
    refuse_repeated_keys(&json, &Path::Root)?;
    Ok(json)
}

/// serde_json's error in our words: the place, what was found, what was expected.
fn syntax_error(text: &str, error: &serde_json::Error, values: usize) -> Error {
    let message = error.to_string();
    let reason = message.split(" at line ").next().unwrap_or(&message);
    let line = text.lines().nth(error.line().saturating_sub(1)).unwrap_or("");
    let start = floor_char(line, error.column().saturating_sub(1));
    let column = line[..start].chars().count() + 1;
    let word = word_at(line, start);
    let (kind, message) = if values > MAX_VALUES {
        (ErrorKind::LimitExceeded, format!("more than {MAX_VALUES} values, the limit of scene files"))
    } else if text.trim().is_empty() {
        (ErrorKind::Syntax, "the file is empty; expected a JSON object".into())
    } else if reason.starts_with("recursion limit") {
        (ErrorKind::LimitExceeded, "nested deeper than 128 levels, the limit of scene files".into())
    } else if reason == "number out of range" {
        (ErrorKind::NotFinite, format!("{} is beyond the largest number, 1.8e308", quote(word)))
    } else if is_non_finite(word) {
        (ErrorKind::NotFinite, format!("{word} is not a JSON number; expected a finite number"))
    } else if error.is_eof() {
        (ErrorKind::Syntax, format!("the file ends too soon ({reason})"))
    } else if line[start..].starts_with(['/', '#']) {
        (ErrorKind::Syntax, "JSON has no comments; expected a value (a \"comment\" key may stand in any object)".into())
    } else if reason == "trailing characters" {
        (ErrorKind::Syntax, format!("{} after the end of the scene; expected nothing more", quote(word)))
    } else {
        (ErrorKind::Syntax, format!("{reason}, found {}", quote(word)))
    };
    Error::new(kind, message).at(format!("line {} column {column}", error.line()))
}

/// The largest character boundary of `line` that is not after `index`.
fn floor_char(line: &str, index: usize) -> usize {
    (0..=index.min(line.len())).rev().find(|&i| line.is_char_boundary(i)).unwrap_or(0)
}

/// The number-like word around byte `at` of a line, or the one character there.
fn word_at(line: &str, at: usize) -> &str {
    let inside = |c: char| c.is_ascii_alphanumeric() || matches!(c, '+' | '-' | '.');
    let start = line[..at].rfind(|c| !inside(c)).map_or(0, |i| i + line[i..].chars().next().map_or(1, char::len_utf8));
    let end = at + line[at..].find(|c| !inside(c)).unwrap_or(line.len() - at);
    let character = line[at..].chars().next().map_or(0, char::len_utf8);
    if line[at..].starts_with(inside) { &line[start..end] } else { &line[at..at + character] }
}

fn is_non_finite(word: &str) -> bool {
    let bare = word.trim_start_matches(['-', '+']).to_ascii_lowercase();
    matches!(bare.as_str(), "nan" | "inf" | "infinity")
}

fn refuse_repeated_keys(json: &Json, path: &Path) -> Result<()> {
    match json {
        Json::Object(entries) => {
            let mut seen = HashSet::with_capacity(entries.len());
            for (key, value) in entries {
                let here = Path::Key(path, key);
                if !seen.insert(key.as_str()) {
                    let message = format!("the key {} is given twice; expected it once", quote(key));
                    return Err(Error::new(ErrorKind::Duplicate, message).at(here.to_string()));
                }
                refuse_repeated_keys(value, &here)?;
            }
            Ok(())
        }
        Json::List(items) => {
            items.iter().enumerate().try_for_each(|(i, item)| refuse_repeated_keys(item, &Path::Index(path, i)))
        }
        _ => Ok(()),
    }
}

/// Deserializes one value, counting it.
#[derive(Clone, Copy)]
struct Node<'a> {
    values: &'a Cell<usize>,
}

impl Node<'_> {
    fn count<E: serde::de::Error>(self) -> std::result::Result<(), E> {
        self.values.set(self.values.get() + 1);
        if self.values.get() > MAX_VALUES { Err(E::custom("too many values")) } else { Ok(()) }
    }
}

impl<'de> DeserializeSeed<'de> for Node<'_> {
    type Value = Json;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> std::result::Result<Json, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Node<'_> {
    type Value = Json;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a JSON value")
    }
    fn visit_unit<E: serde::de::Error>(self) -> std::result::Result<Json, E> {
        Ok(Json::Null)
    }
    fn visit_bool<E: serde::de::Error>(self, value: bool) -> std::result::Result<Json, E> {
        Ok(Json::Bool(value))
    }
    fn visit_i64<E: serde::de::Error>(self, value: i64) -> std::result::Result<Json, E> {
        Ok(Json::Integer(value))
    }
    fn visit_u64<E: serde::de::Error>(self, value: u64) -> std::result::Result<Json, E> {
        Ok(i64::try_from(value).map_or(Json::Number(value as f64), Json::Integer))
    }
    fn visit_f64<E: serde::de::Error>(self, value: f64) -> std::result::Result<Json, E> {
        Ok(Json::Number(value))
    }
    fn visit_str<E: serde::de::Error>(self, value: &str) -> std::result::Result<Json, E> {
        Ok(Json::Text(value.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> std::result::Result<Json, A::Error> {
        let mut numbers = Vec::new();
        let first = loop {
            match seq.next_element_seed(self)? {
                None => return Ok(Json::Numbers(numbers)),
                Some(item) => match item.as_number() {
                    Some(value) => numbers.push(value),
                    None => break item,
                },
            }
        };
        let mut items: Vec<Json> = numbers.into_iter().map(Json::Number).collect();
        self.count()?;
        items.push(first);
        while let Some(item) = seq.next_element_seed(self)? {
            self.count()?;
            items.push(item);
        }
        Ok(Json::List(items))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> std::result::Result<Json, A::Error> {
        let mut entries = Vec::new();
        while let Some(key) = map.next_key::<String>()? {
            self.count().map_err(A::Error::custom::<A::Error>)?;
            entries.push((key, map.next_value_seed(self)?));
        }
        Ok(Json::Object(entries))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fails(text: &str) -> Error {
        parse(text.as_bytes()).expect_err(text)
    }

    #[test]
    fn keeps_order_and_exact_integers() {
        let json = parse(br#"{"b": 9007199254740993, "a": [1, 2.5], "c": [1, "x"]}"#).unwrap();
        let expected = vec![
            ("b".to_owned(), Json::Integer(9_007_199_254_740_993)),
            ("a".to_owned(), Json::Numbers(vec![1.0, 2.5])),
            ("c".to_owned(), Json::List(vec![Json::Number(1.0), Json::Text("x".into())])),
        ];
        assert_eq!(json, Json::Object(expected));
        assert_eq!(parse(b"1e2").unwrap().as_integer(), Some(100));
        assert_eq!(parse(b"18446744073709551615").unwrap().as_integer(), None);
        assert_eq!(parse(b"\xef\xbb\xbf[0.1]").unwrap(), Json::Numbers(vec![0.1]));
    }

    #[test]
    fn repeated_keys_are_named_with_their_path() {
        let error = fails(r#"{"a": [{"x": 1}, {"x": 1, "y y": {"z": 1, "z": 2}}]}"#);
        assert_eq!((error.kind, error.place.as_str()), (ErrorKind::Duplicate, "a[1][\"y y\"].z"));
        assert!(error.message.contains("\"z\""));
    }

    #[test]
    fn syntax_errors_tell_line_column_and_expectation() {
        for (text, kind, place, fragment) in [
            ("", ErrorKind::Syntax, "line 1 column 1", "empty"),
            ("{\n  \"a\": tru }", ErrorKind::Syntax, "line 2 column 11", "expected"),
            ("{\"a\" 1}", ErrorKind::Syntax, "line 1 column 6", "expected `:`"),
            ("{\"ä\" 1}", ErrorKind::Syntax, "line 1 column 6", "expected `:`, found \"1\""),
            ("[1, 2,]", ErrorKind::Syntax, "line 1 column 7", "trailing comma"),
            ("{} x", ErrorKind::Syntax, "line 1 column 4", "\"x\" after the end"),
            ("{\"a\": [1, 2", ErrorKind::Syntax, "line 1", "ends too soon"),
            ("{ // hi\n}", ErrorKind::Syntax, "line 1 column 3", "no comments"),
            ("[NaN]", ErrorKind::NotFinite, "line 1 column 2", "NaN is not a JSON number"),
            ("[-Infinity]", ErrorKind::NotFinite, "line 1 column 3", "-Infinity"),
            ("[1e999]", ErrorKind::NotFinite, "line 1", "\"1e999\" is beyond"),
            ("['a']", ErrorKind::Syntax, "line 1 column 2", "expected value"),
        ] {
            let error = fails(text);
            assert_eq!(error.kind, kind, "{text}: {error}");
            assert!(error.place.starts_with(place), "{text}: {error}");
            assert!(error.message.contains(fragment), "{text}: {error}");
        }
    }

    #[test]
    fn bombs_and_bad_bytes_are_refused() {
        assert_eq!(fails(&"[".repeat(1_000_000)).kind, ErrorKind::LimitExceeded);
        assert_eq!(fails(&"{\"a\":".repeat(200)).kind, ErrorKind::LimitExceeded);
        let error = parse(b"{\n \"a\xff\": 1}").unwrap_err();
        assert_eq!((error.kind, error.place.as_str()), (ErrorKind::Syntax, "line 2 column 4"));
        assert_eq!(check_size(MAX_FILE_BYTES + 1).unwrap_err().kind, ErrorKind::LimitExceeded);
        assert!(read_limited(std::io::repeat(b' ').take(100)).is_ok());
    }
}
