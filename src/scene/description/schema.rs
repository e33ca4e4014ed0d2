//! The JSON Schema of scene files (draft 2020-12), generated from the tables that parsing itself uses.

use serde_json::{Map as JsonMap, Value, json};

use super::tables::*;

/// Roles of spectra with the name of their definition.
const ROLES: [(Role, &str); 5] = [
    (Role::Named, "spectrum"),
    (Role::Reflectance, "reflectance"),
    (Role::Emission, "emission"),
    (Role::Absorption, "absorption"),
    (Role::Index, "complex_index"),
];

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
    let mut root = table_schema(&SCENE, &[]);
    root["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    root["title"] = json!("abbe scene");
    let mut definitions = JsonMap::new();
    for (role, name) in ROLES {
        definitions.insert(name.into(), forms_schema(&SPECTRUM, Some(role)));
    }
    definitions.insert("ior".into(), forms_schema(&IOR, None));
    definitions.insert("shape".into(), tagged_schema(&SHAPE, &mut Vec::new()));
    definitions.insert("transform_step".into(), forms_schema(&TRANSFORM_STEP, None));
    root["$defs"] = Value::Object(definitions);
    root
}

fn reference(name: &str) -> Value {
    json!({ "$ref": format!("#/$defs/{name}") })
}

fn kind_schema(kind: &Kind) -> Value {
    match kind {
        Kind::Number(range) => number_schema("number", range),
        Kind::Integer(range) => number_schema("integer", range),
        Kind::Bool => json!({ "type": "boolean" }),
        Kind::Text => json!({ "type": "string", "maxLength": MAX_TEXT }),
        Kind::Name(what) => json!({ "type": "string", "minLength": 1, "maxLength": MAX_TEXT, "title": what }),
        Kind::File(file) => json!({ "type": "string", "title": file.what, "pattern": file_pattern(file) }),
        Kind::Choice(choice) => json!({ "enum": names(choice), "description": choice_doc(choice) }),
        Kind::Numbers(numbers) => numbers_schema(numbers),
        Kind::List(list) => {
            json!({ "type": "array", "items": kind_schema(&list.item), "minItems": list.min, "maxItems": list.max })
        }
        Kind::Map(map) => json!({
            "type": "object",
            "properties": { "comment": comment() },
            "additionalProperties": kind_schema(&map.item),
            "propertyNames": { "minLength": 1, "maxLength": MAX_TEXT },
            "maxProperties": MAX_NAMES,
        }),
        Kind::Object(table) => table_schema(table, &[]),
        Kind::Tagged(tagged) if std::ptr::eq(*tagged, &SHAPE) => reference("shape"),
        Kind::Tagged(tagged) => tagged_schema(tagged, &mut Vec::new()),
        Kind::Forms(forms) if std::ptr::eq(*forms, &IOR) => reference("ior"),
        Kind::Forms(forms) if std::ptr::eq(*forms, &TRANSFORM_STEP) => reference("transform_step"),
        Kind::Forms(forms) => forms_schema(forms, None),
        Kind::Spectrum(role) => {
            reference(ROLES.iter().find(|(named, _)| named == role).map_or("spectrum", |(_, name)| name))
        }
        Kind::Either(kinds) => json!({ "anyOf": kinds.iter().map(kind_schema).collect::<Vec<_>>() }),
    }
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

fn numbers_schema(numbers: &Numbers) -> Value {
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

fn names(choice: &Choice) -> Vec<&'static str> {
    choice.names.iter().map(|(name, _)| *name).collect()
}

fn choice_doc(choice: &Choice) -> String {
    choice.names.iter().map(|(name, doc)| format!("\"{name}\": {doc}")).collect::<Vec<_>>().join(" ")
}

/// Matches the extensions in either case.
fn file_pattern(file: &FileKind) -> String {
    let either = |c: char| format!("[{}{}]", c.to_ascii_lowercase(), c.to_ascii_uppercase());
    let extension = |name: &&str| name.chars().map(either).collect::<String>();
    format!("\\.({})$", file.extensions.iter().map(extension).collect::<Vec<_>>().join("|"))
}

fn comment() -> Value {
    json!({ "type": "string", "description": "A remark for people; ignored." })
}

/// A key: its kind with the key's own description and default.
fn field_schema(field: &Field) -> Value {
    let mut schema = kind_schema(&field.kind);
    let doc = match schema.get("description").and_then(Value::as_str) {
        Some(more) => format!("{} {more}", field.doc),
        None => field.doc.to_owned(),
    };
    schema["description"] = json!(doc);
    if let Need::Default(text) = field.need {
        schema["default"] = serde_json::from_str(text).expect("defaults are JSON");
    }
    schema
}

/// An object; `tags` are the keys and values that tell its kind.
fn table_schema(table: &Table, tags: &[(&str, &str)]) -> Value {
    let mut properties = JsonMap::new();
    let mut required: Vec<&str> = Vec::new();
    for (tag, name) in tags {
        properties.insert((*tag).into(), json!({ "const": name, "description": table.doc }));
        required.push(tag);
    }
    for field in table.all_fields() {
        properties.insert(field.key.into(), field_schema(field));
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
    let alternatives =
        |sets: &[&[&str]]| json!(sets.iter().map(|keys| json!({ "required": keys })).collect::<Vec<_>>());
    match table.rule {
        Rule::Free => {}
        Rule::AnyOf(sets) => schema["anyOf"] = alternatives(sets),
        Rule::OneOf(sets) => {
            schema["oneOf"] = json!(sets.iter().map(|keys| only(keys, sets)).collect::<Vec<_>>());
        }
    }
    schema
}

/// All of `keys`, and no key of the other sets.
fn only(keys: &[&str], sets: &[&[&str]]) -> Value {
    let others = sets.iter().flat_map(|set| set.iter()).filter(|key| !keys.contains(key));
    let absent: Vec<Value> = others.map(|key| json!({ "required": [key] })).collect();
    json!({ "required": keys, "not": { "anyOf": absent } })
}

fn tagged_schema(tagged: &'static Tagged, tags: &mut Vec<(&'static str, &'static str)>) -> Value {
    let mut kinds = Vec::new();
    for (name, body) in tagged.variants {
        tags.push((tagged.tag, name));
        kinds.push(match body {
            Body::Table(table) => table_schema(table, tags),
            Body::Tagged(inner) => tagged_schema(inner, tags),
        });
        tags.pop();
    }
    json!({ "oneOf": kinds })
}

/// The shorthands and forms; a role narrows what its values can be.
fn forms_schema(forms: &Forms, role: Option<Role>) -> Value {
    let mut kinds = Vec::new();
    if let Some((doc, range)) = &forms.number {
        let mut schema = number_schema("number", &role.map_or(*range, Role::range));
        schema["description"] = json!(doc);
        kinds.push(schema);
    }
    if let Some(doc) = forms.text {
        kinds.push(json!({ "type": "string", "minLength": 1, "description": doc }));
    }
    for form in forms.forms {
        let first = form.fields[0].key;
        if role.is_none_or(|role| role.takes_rgb() || first != "rgb") {
            kinds.push(table_schema(form, &[]));
        }
    }
    let mut schema = json!({ "anyOf": kinds });
    if let Some(role) = role {
        schema["title"] = json!(role.what());
    }
    schema
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Keys and tags that the tables name, each with the table it is of.
    fn keys_of_table(table: &Table, keys: &mut Vec<(&'static str, String)>) {
        for field in table.all_fields() {
            keys.push((field.key, table.what.to_owned()));
            keys_of_kind(&field.kind, keys);
        }
    }

    fn keys_of_kind(kind: &Kind, keys: &mut Vec<(&'static str, String)>) {
        match kind {
            Kind::Object(table) => keys_of_table(table, keys),
            Kind::Tagged(tagged) => keys_of_tagged(tagged, keys),
            Kind::Forms(forms) => forms.forms.iter().for_each(|form| keys_of_table(form, keys)),
            Kind::Spectrum(_) => keys_of_kind(&Kind::Forms(&SPECTRUM), keys),
            Kind::List(list) => keys_of_kind(&list.item, keys),
            Kind::Map(map) => keys_of_kind(&map.item, keys),
            _ => {}
        }
    }

    fn keys_of_tagged(tagged: &Tagged, keys: &mut Vec<(&'static str, String)>) {
        for (_, body) in tagged.variants {
            match body {
                Body::Table(table) => keys_of_table(table, keys),
                Body::Tagged(inner) => keys_of_tagged(inner, keys),
            }
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
        keys_of_table(&SCENE, &mut keys);
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
