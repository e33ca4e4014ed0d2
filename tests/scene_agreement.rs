//! The schema and the decoder of scenes agree: random documents that walk the schema, whole and damaged.

use std::collections::BTreeMap;
use std::path::Path;

use abbe::scene::description::{parse_str, schema};
use abbe::{Error, ErrorKind};
use serde_json::{Map, Value, json};

/// SplitMix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn chance(&mut self, share: f64) -> bool {
        self.unit() < share
    }

    fn pick<'a, T>(&mut self, items: &'a [T]) -> &'a T {
        &items[self.below(items.len())]
    }
}

/// Makes documents that a schema accepts.
struct Generator<'a> {
    root: &'a Value,
    random: Random,
}

impl Generator<'_> {
    fn value(&mut self, schema: &Value) -> Value {
        if let Some(name) = schema["$ref"].as_str() {
            let definition = self.root.pointer(&name[1..]).expect("a definition").clone();
            return self.value(&definition);
        }
        if !schema["const"].is_null() {
            return schema["const"].clone();
        }
        if let Some(names) = schema["enum"].as_array() {
            return self.random.pick(names).clone();
        }
        match schema["type"].as_str() {
            None => {
                let kinds = ["anyOf", "oneOf"].iter().find_map(|key| schema[key].as_array()).expect("alternatives");
                let kind = self.random.pick(kinds).clone();
                self.value(&kind)
            }
            Some("number") => json!(self.number(schema)),
            Some("integer") => json!(self.number(schema).trunc().max(schema["minimum"].as_f64().unwrap()) as i64),
            Some("boolean") => json!(self.random.chance(0.5)),
            Some("string") => self.string(schema),
            Some("array") => self.array(schema),
            Some("object") => self.object(schema),
            Some(other) => {
                if other == "null" {
                    Value::Null
                } else {
                    panic!("no generator for {other}")
                }
            }
        }
    }

    fn number(&mut self, schema: &Value) -> f64 {
        let least = schema["minimum"].as_f64().or(schema["exclusiveMinimum"].as_f64());
        let most = schema["maximum"].as_f64().or(schema["exclusiveMaximum"].as_f64());
        if self.random.chance(0.1) {
            let ends: Vec<f64> = ["minimum", "maximum"].iter().filter_map(|key| schema[key].as_f64()).collect();
            if !ends.is_empty() {
                return *self.random.pick(&ends);
            }
        }
        // Between the ends, which lie near 1 where the range allows it, so that the geometry is often sound.
        let (low, high) = (least.unwrap_or(-10.0).max(-10.0), most.unwrap_or(1000.0).min(1000.0));
        let share = self.random.unit().max(1e-6);
        low + (high - low) * if self.random.chance(0.5) { share } else { share * share * share }
    }

    fn string(&mut self, schema: &Value) -> Value {
        if let Some(pattern) = schema["pattern"].as_str() {
            let names = ["a.csv", "dir/b.SPD", "c.spdx", "mesh.obj", "mesh.ply", "n.yml", "n.yaml"];
            let fits = |name: &&&str| {
                let end = name.rsplit('.').next().unwrap().to_lowercase();
                let first = end.chars().next().unwrap();
                pattern.contains(&end.chars().map(|c| format!("[{c}{}]", c.to_ascii_uppercase())).collect::<String>())
                    && pattern.contains(first)
            };
            let names: Vec<&&str> = names.iter().filter(fits).collect();
            return json!(**self.random.pick(&names));
        }
        let known: &[&str] = match schema["title"].as_str() {
            Some("one of `spectra`") => &["s0", "s1", "s2"],
            Some("one of `materials`") => &["m0", "m1", "m2"],
            _ => &["D65", "x", "a name", "é"],
        };
        json!(*self.random.pick(known))
    }

    fn array(&mut self, schema: &Value) -> Value {
        let least = schema["minItems"].as_u64().unwrap_or(0) as usize;
        let most = schema["maxItems"].as_u64().map_or(least + 6, |max| max as usize).min(least + 6);
        let count = least + self.random.below(most - least + 1);
        let items: Vec<Value> = (0..count).map(|_| self.value(&schema["items"])).collect();
        let ascending = self.random.chance(0.8) && count > 1 && items.iter().all(Value::is_number) && most > least;
        if !ascending {
            return Value::Array(items);
        }
        let mut numbers: Vec<f64> = items.iter().filter_map(Value::as_f64).collect();
        numbers.sort_by(f64::total_cmp);
        if schema["items"]["type"] == "integer" { Value::Array(items) } else { json!(numbers) }
    }

    fn object(&mut self, schema: &Value) -> Value {
        if schema["additionalProperties"].is_object() {
            let prefix = if schema["additionalProperties"]["$ref"] == "#/$defs/spectrum" { "s" } else { "m" };
            let count = 2 + self.random.below(2);
            let entries = (0..count).map(|i| (format!("{prefix}{i}"), self.value(&schema["additionalProperties"])));
            return Value::Object(entries.collect());
        }
        let keys_of = |value: &Value| -> Vec<String> {
            value["required"].as_array().into_iter().flatten().map(|key| key.as_str().unwrap().to_owned()).collect()
        };
        let mut keys = keys_of(schema);
        let properties = schema["properties"].as_object().expect("properties");
        keys.extend(properties.keys().filter(|_| self.random.chance(0.4)).cloned());
        if let Some(sets) = ["anyOf", "oneOf"].iter().find_map(|key| schema[key].as_array()) {
            let sets: Vec<Vec<String>> = sets.iter().map(keys_of).collect();
            let chosen = self.random.pick(&sets).clone();
            if schema["oneOf"].is_array() {
                keys.retain(|key| sets.iter().all(|set| !set.contains(key)));
            }
            keys.extend(chosen);
        }
        let entries = keys.iter().map(|key| (key.clone(), self.value(&properties[key])));
        Value::Object(entries.collect::<Map<String, Value>>())
    }

    /// Damages one value of a document.
    fn damage(&mut self, document: &mut Value) {
        let count = count(document);
        let target = self.random.below(count);
        let at = nth(document, &mut { target });
        let numbers = [json!(-1), json!(0), json!(0.5), json!(7), json!(1e31), json!(1e300), json!(i64::MAX)];
        let others =
            [Value::Null, json!(true), json!("x"), json!(""), json!([]), json!({}), json!([1, 2]), json!([{}])];
        match (self.random.below(4), &mut *at) {
            (0, Value::Object(map)) if !map.is_empty() => {
                let key = map.keys().nth(self.random.below(map.len())).unwrap().clone();
                map.remove(&key);
            }
            (1, Value::Object(map)) => {
                let keys = ["radius", "name", "scale", "values", "type", "rgb", "k", "unknown", "comment"];
                let key = (*self.random.pick(&keys)).to_owned();
                map.insert(key, self.random.pick(&[json!(1), json!("x"), json!([1, 1, 1])]).clone());
            }
            (2, Value::Array(items)) if !items.is_empty() => drop(items.pop()),
            (_, at) if at.is_number() && self.random.chance(0.7) => *at = self.random.pick(&numbers).clone(),
            (_, at) => *at = self.random.pick(&others).clone(),
        }
    }
}

fn children(value: &Value) -> Vec<&Value> {
    match value {
        Value::Array(items) => items.iter().collect(),
        Value::Object(map) => map.values().collect(),
        _ => Vec::new(),
    }
}

fn count(value: &Value) -> usize {
    1 + children(value).into_iter().map(count).sum::<usize>()
}

/// The value at a place in depth-first order.
fn nth<'a>(value: &'a mut Value, left: &mut usize) -> &'a mut Value {
    if *left == 0 {
        return value;
    }
    *left -= 1;
    let inside: Vec<&mut Value> = match value {
        Value::Array(items) => items.iter_mut().collect(),
        Value::Object(map) => map.values_mut().collect(),
        _ => Vec::new(),
    };
    for child in inside {
        let size = count(child);
        if *left < size {
            return nth(child, left);
        }
        *left -= size;
    }
    panic!("no such value")
}

/// What no schema can say: part of the error's message, for kinds of errors that a schema can raise as well.
const BEYOND_SCHEMA: &[(ErrorKind, &str)] = &[
    (ErrorKind::UnknownName, "no spectrum named"),
    (ErrorKind::UnknownName, "no material named"),
    (ErrorKind::WrongType, "expected as many"),
    (ErrorKind::WrongType, "for each entry, found"),
    (ErrorKind::WrongType, "cannot be an RGB colour"),
    (ErrorKind::OutOfRange, "wavelengths must ascend"),
    (ErrorKind::OutOfRange, "expected nanometres"),
    (ErrorKind::OutOfRange, "expected a reflectance"),
    (ErrorKind::OutOfRange, "expected an emission"),
    (ErrorKind::OutOfRange, "expected an absorption"),
    (ErrorKind::OutOfRange, "expected a complex index"),
    (ErrorKind::OutOfRange, "the index of one of"),
    (ErrorKind::OutOfRange, "cannot span the diameter"),
    (ErrorKind::OutOfRange, "expected less than `major_radius`"),
    (ErrorKind::OutOfRange, "expected less than a quarter of `period`"),
    (ErrorKind::OutOfRange, "expected at most 100 periods"),
    (ErrorKind::OutOfRange, "the last row must be 0 0 0 1"),
    (ErrorKind::OutOfRange, "at least `inner_degrees`"),
    (ErrorKind::Unsupported, "anisotropic roughness"),
    (ErrorKind::LimitExceeded, "pixels in all"),
];

/// The reason why a document that the schema accepts may be refused.
fn beyond_schema(error: &Error) -> Option<&'static str> {
    match error.kind {
        ErrorKind::Degenerate => Some("degenerate"),
        ErrorKind::BadReference => Some("bad reference"),
        kind => {
            BEYOND_SCHEMA.iter().find(|(k, part)| *k == kind && error.message.contains(part)).map(|(_, part)| *part)
        }
    }
}

#[test]
fn schema_and_decoder_agree_on_random_documents() {
    let root = schema();
    let validator = jsonschema::validator_for(&root).expect("a valid schema");
    let mut generator = Generator { root: &root, random: Random(14) };
    let (mut accepted, mut refused, mut reasons) = (0, 0, BTreeMap::<&str, usize>::new());
    for i in 0..10_000 {
        let mut document = generator.value(&root);
        let damaged = i % 2 == 1;
        if damaged {
            generator.damage(&mut document);
        }
        let (valid, parsed) = (validator.is_valid(&document), parse_str(&document.to_string(), Path::new("x.json")));
        assert!(valid || damaged, "the generator made {document}");
        match (valid, parsed) {
            (true, Ok(_)) => accepted += 1,
            (false, Err(_)) => refused += 1,
            (false, Ok(_)) => panic!("parses, but the schema refuses {document}"),
            (true, Err(error)) => match beyond_schema(&error) {
                Some(reason) => *reasons.entry(reason).or_default() += 1,
                None => panic!("the schema accepts, but: {error}\n{document}"),
            },
        }
    }
    assert!(accepted > 300 && refused > 1000 && reasons.len() > 12, "{accepted}, {refused}, {reasons:?}");
    println!("accepted {accepted}, refused by both {refused}, beyond the schema {reasons:?}");
}
