//! The JSON Schema of scene files (draft 2020-12), made from what the decoders declare.

use serde_json::{Map as JsonMap, Value, json};

use super::codec::{Codec, Field, Kind, MAX_NAMES, MAX_TEXT, Need, NumbersKind, Range, Rule, Table};
use super::document::SCENE;

/// The JSON Schema of scene files.
///
/// A file that parses is valid; a valid file can still fail to parse where several values must agree (names, geometry,
/// ascending wavelengths).
///
/// ```
/// let schema = abbe::scene::description::schema();
/// assert_eq!(schema["properties"]["render"]["default"], serde_json::json!({}));
/// ```
pub fn schema() -> Value {
    let mut definitions = Definitions::default();
    let mut root = definitions.kind(&SCENE.kind());
    root["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    root["title"] = json!("abbe scene");
    root["$defs"] = Value::Object(definitions.0);
    root
}

/// The schemas of the kinds that stand in several places, by name.
#[derive(Default)]
struct Definitions(JsonMap<String, Value>);

/// Keys and values that tell the kind of an object, with the kind's description.
type Tags<'a> = Vec<(&'static str, &'static str, &'a str)>;

impl Definitions {
    fn kind(&mut self, kind: &Kind) -> Value {
        match kind {
            Kind::Number(range) => number_schema("number", range),
            Kind::Integer(range) => number_schema("integer", range),
            Kind::Bool => json!({ "type": "boolean" }),
            Kind::Text => json!({ "type": "string", "maxLength": MAX_TEXT }),
            Kind::Name(what) => json!({ "type": "string", "minLength": 1, "maxLength": MAX_TEXT, "title": what }),
            Kind::File { what, extensions } => {
                json!({ "type": "string", "title": what, "maxLength": MAX_TEXT, "pattern": file_pattern(extensions) })
            }
            Kind::Choice(names) => choice_schema(names),
            Kind::Numbers(numbers) => numbers_schema(numbers),
            Kind::List { item, min, max, .. } => {
                json!({ "type": "array", "items": self.kind(item), "minItems": min, "maxItems": max })
            }
            Kind::Map { item, .. } => json!({
                "type": "object",
                "properties": { "comment": comment() },
                "additionalProperties": self.kind(item),
                "propertyNames": { "minLength": 1, "maxLength": MAX_TEXT },
                "maxProperties": MAX_NAMES,
            }),
            Kind::Object(table) => self.table(table, &Tags::new(), &[]),
            Kind::Either(kinds) => {
                let kinds: Vec<Value> = kinds.iter().map(|(kind, doc)| described(self.kind(kind), doc)).collect();
                json!({ "anyOf": kinds })
            }
            Kind::Defined(name, kind) => {
                if !self.0.contains_key(*name) {
                    // The name is taken first, as the kind may contain itself.
                    self.0.insert((*name).into(), Value::Null);
                    let schema = self.kind(&kind());
                    self.0.insert((*name).into(), schema);
                }
                json!({ "$ref": format!("#/$defs/{name}") })
            }
        }
    }

    /// An object, of which some keys are already told by what it is a kind of.
    fn table(&mut self, table: &Table, tags: &Tags, common: &[&Field]) -> Value {
        let fields: Vec<&Field> = table.fields.iter().chain(common.iter().copied()).collect();
        if table.variants.is_empty() {
            return self.plain_table(table, tags, &fields);
        }
        let kinds: Vec<Value> = table
            .variants
            .iter()
            .map(|(name, variant)| {
                let mut tags = tags.clone();
                tags.extend(table.tag.map(|tag| (tag, *name, variant.doc)));
                self.table(variant, &tags, &fields)
            })
            .collect();
        described(if table.tag.is_some() { json!({ "oneOf": kinds }) } else { json!({ "anyOf": kinds }) }, table.doc)
    }

    fn plain_table(&mut self, table: &Table, tags: &Tags, fields: &[&Field]) -> Value {
        let mut properties = JsonMap::new();
        let mut required: Vec<&str> = Vec::new();
        for (tag, name, doc) in tags {
            properties.insert((*tag).into(), json!({ "const": name, "description": doc }));
            required.push(tag);
        }
        for field in fields {
            properties.insert(field.key.into(), self.field(field));
            if field.need == Need::Required {
                required.push(field.key);
            }
        }
        properties.insert("comment".into(), comment());
        let mut schema = json!({
            "type": "object",
            "description": table.doc,
            "properties": properties,
            "required": required,
            "additionalProperties": false,
        });
        let sets = table.rule.sets();
        match table.rule {
            Rule::Free => {}
            Rule::AnyOf(_) => {
                schema["anyOf"] = sets.iter().map(|keys| json!({ "required": keys })).collect();
            }
            Rule::OneOf(_) => schema["oneOf"] = sets.iter().map(|keys| only(keys, sets)).collect(),
        }
        schema
    }

    /// A key: its kind with the key's own description and default.
    fn field(&mut self, field: &Field) -> Value {
        let mut schema = self.kind(&field.kind);
        let doc = match schema.get("description").and_then(Value::as_str) {
            Some(more) if matches!(field.kind, Kind::Choice(_)) => format!("{} {more}", field.doc),
            _ => field.doc.to_owned(),
        };
        schema["description"] = json!(doc);
        if let Need::Default(text) = field.need {
            schema["default"] = serde_json::from_str(text).expect("defaults are JSON");
        }
        schema
    }
}

fn described(mut schema: Value, doc: &str) -> Value {
    if !doc.is_empty() {
        schema["description"] = json!(doc);
    }
    schema
}

fn number_schema(type_name: &str, range: &Range) -> Value {
    let mut schema = json!({ "type": type_name });
    let number = |x: f64| if x.fract() == 0.0 && x.abs() < 1e16 { json!(x as i64) } else { json!(x) };
    if range.has_min() {
        schema[if range.above { "exclusiveMinimum" } else { "minimum" }] = number(range.min);
    }
    if range.has_max() {
        schema[if range.below { "exclusiveMaximum" } else { "maximum" }] = number(range.max);
    }
    schema
}

fn numbers_schema(numbers: &NumbersKind) -> Value {
    let mut item = number_schema(if numbers.integer { "integer" } else { "number" }, &numbers.item);
    if numbers.null {
        item = json!({ "anyOf": [item, { "type": "null" }] });
    }
    let mut schema = json!({ "type": "array", "items": item, "minItems": numbers.min });
    if numbers.max != usize::MAX {
        schema["maxItems"] = json!(numbers.max);
    }
    schema
}

fn choice_schema(names: &[(&str, &str)]) -> Value {
    let documented = names.iter().filter(|(_, doc)| !doc.is_empty());
    let doc: Vec<String> = documented.map(|(name, doc)| format!("\"{name}\": {doc}")).collect();
    let names: Vec<&str> = names.iter().map(|(name, _)| *name).collect();
    described(json!({ "enum": names }), &doc.join(" "))
}

/// Matches the extensions in either case.
fn file_pattern(extensions: &[&str]) -> String {
    let either = |c: char| format!("[{}{}]", c.to_ascii_lowercase(), c.to_ascii_uppercase());
    let extension = |name: &&str| name.chars().map(either).collect::<String>();
    format!("\\.({})$", extensions.iter().map(extension).collect::<Vec<_>>().join("|"))
}

fn comment() -> Value {
    json!({ "type": "string", "description": "A remark for people; ignored." })
}

/// All of `keys`, and no key of the other sets.
fn only(keys: &[&str], sets: &[&[&str]]) -> Value {
    let others = sets.iter().flat_map(|set| set.iter()).filter(|key| !keys.contains(key));
    let absent: Vec<Value> = others.map(|key| json!({ "required": [key] })).collect();
    json!({ "required": keys, "not": { "anyOf": absent } })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Keys that the tables name, each with the table it is of.
    fn keys_of_table(table: &Table, keys: &mut Vec<(&'static str, &'static str)>) {
        for field in &table.fields {
            keys.push((field.key, table.what));
            keys_of_kind(&field.kind, keys);
        }
        table.variants.iter().for_each(|(_, variant)| keys_of_table(variant, keys));
    }

    fn keys_of_kind(kind: &Kind, keys: &mut Vec<(&'static str, &'static str)>) {
        match kind {
            Kind::Object(table) => keys_of_table(table, keys),
            Kind::Either(kinds) => kinds.iter().for_each(|(kind, _)| keys_of_kind(kind, keys)),
            Kind::Defined(_, kind) => keys_of_kind(&kind(), keys),
            Kind::List { item, .. } | Kind::Map { item, .. } => keys_of_kind(item, keys),
            _ => {}
        }
    }

    /// Every `properties` of the schema, by key.
    fn properties<'a>(schema: &'a Value, found: &mut Vec<(&'a str, &'a Value)>) {
        match schema {
            Value::Object(map) => {
                if let Some(Value::Object(keys)) = map.get("properties") {
                    found.extend(keys.iter().map(|(key, value)| (key.as_str(), value)));
                }
                map.values().for_each(|value| properties(value, found));
            }
            Value::Array(items) => items.iter().for_each(|item| properties(item, found)),
            _ => {}
        }
    }

    #[test]
    fn every_key_of_the_tables_is_in_the_schema_with_its_meaning() {
        let schema = schema();
        let (mut found, mut keys) = (Vec::new(), Vec::new());
        properties(&schema, &mut found);
        keys_of_kind(&SCENE.kind(), &mut keys);
        assert!(keys.len() > 120, "{}", keys.len());
        for (key, table) in keys {
            assert!(found.iter().any(|(name, _)| *name == key), "{key} of {table}");
        }
        for (key, value) in found {
            assert!(value["description"].as_str().is_some_and(|doc| doc.len() > 3), "{key} has no description");
        }
        for surface in ["torus", "superquadric", "gyroid", "smooth-union", "tanglecube"] {
            assert!(schema["$defs"]["shape"].to_string().contains(&format!("\"const\":\"{surface}\"")), "{surface}");
        }
    }

    #[test]
    fn the_schema_is_a_valid_schema() {
        assert!(jsonschema::meta::is_valid(&schema()));
        assert!(jsonschema::validator_for(&schema()).is_ok());
    }
}
