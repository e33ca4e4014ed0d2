//! Malformed scenes must fail with the right error at the right place, and never panic.

#[path = "common/bad_scenes.rs"]
mod bad;
#[path = "common/full_scene.rs"]
mod full;

use std::path::Path;
use std::sync::OnceLock;

use abbe::scene::description::{parse_bytes, parse_file, parse_str, schema};
use abbe::{Error, ErrorKind};
use bad::{GOOD, bad_scenes};
use full::FULL;
use proptest::prelude::*;
use serde_json::{Value, json};

fn parse_error(text: &str) -> Option<Error> {
    parse_str(text, Path::new("folder/scene.json")).err()
}

#[test]
fn each_bad_scene_fails_as_the_table_says() {
    let scenes = bad_scenes();
    let mut failures = Vec::new();
    for scene in scenes.iter().filter(|scene| !scene.needs_compile) {
        let Some(error) = parse_error(&scene.text) else {
            failures.push(format!("{}: accepted", scene.name));
            continue;
        };
        let line = error.to_string();
        // lines that serde_json ends with a lone newline may differ in their column
        let at_place = if scene.code == "syntax" || scene.code == "not_finite" {
            error.place.starts_with(scene.place)
        } else {
            error.place == scene.place
        };
        let good = error.kind.code() == scene.code && at_place && line.contains(scene.fragment);
        if !(good && line.starts_with("folder/scene.json: ") && !line.contains('\n')) {
            failures.push(format!(
                "{}: expected {} at {}: …{}…\n    got {}: {line}",
                scene.name,
                scene.code,
                scene.place,
                scene.fragment,
                error.kind.code()
            ));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    assert!(scenes.len() > 130, "{}", scenes.len());
}

#[test]
fn scenes_for_the_compiler_parse() {
    for scene in bad_scenes().iter().filter(|scene| scene.needs_compile) {
        assert_eq!(parse_error(&scene.text), None, "{}", scene.name);
    }
    assert_eq!(parse_error(GOOD), None);
}

#[test]
fn every_kind_of_parse_error_is_produced() {
    let produced: Vec<&str> = bad_scenes().iter().map(|scene| scene.code).collect();
    for code in [
        "syntax",
        "unknown_key",
        "wrong_type",
        "out_of_range",
        "not_finite",
        "unknown_name",
        "missing",
        "duplicate",
        "degenerate",
        "bad_reference",
        "file_format",
        "limit_exceeded",
        "unsupported",
        "version",
        "file_not_found",
    ] {
        assert!(produced.contains(&code), "{code}");
    }
}

/// Bad scenes whose fault lies between values, which a schema cannot say.
fn is_beyond_schema(code: &str, name: &str) -> bool {
    matches!(code, "degenerate" | "bad_reference" | "duplicate")
        || (code == "unknown_name" && ["unknown spectrum", "unknown material"].contains(&name))
        || [
            "too many pixels",
            "lengths differ",
            "wavelengths descend",
            "wavelengths repeat",
            "micrometres",
            "metres",
            "table above 1",
            "scaled above 1",
            "rgb of 255",
            "emission overflows",
            "line in micrometres",
            "sellmeier lengths",
            "anisotropic glass",
            "spot angles",
            "positions not in threes",
            "indices not in threes",
            "index too large",
            "normals too few",
            "fat torus",
            "fat gyroid",
            "gyroid of too many periods",
            "smooth union lengths",
            "lens of small radius",
            "projective matrix",
        ]
        .contains(&name)
}

#[test]
fn the_schema_accepts_good_scenes_and_refuses_bad_ones() {
    let validator = validator();
    let good: Value = serde_json::from_str(GOOD).unwrap();
    assert!(validator.is_valid(&good), "{:?}", validator.iter_errors(&good).next().map(|error| error.to_string()));
    let (mut refused, mut wrong) = (0, Vec::new());
    for scene in bad_scenes() {
        let Ok(value) = serde_json::from_str::<Value>(&scene.text) else { continue };
        let beyond = scene.needs_compile || is_beyond_schema(scene.code, scene.name);
        refused += usize::from(!validator.is_valid(&value));
        if validator.is_valid(&value) != beyond {
            wrong.push(format!("{}: valid is {}", scene.name, !beyond));
        }
    }
    assert!(wrong.is_empty(), "not as expected, {}", wrong.join("\n"));
    assert!(refused > 70, "{refused}");
}

#[test]
fn hostile_bytes_are_refused_and_a_byte_order_mark_is_not() {
    let file = Path::new("scene.json");
    let kind = |bytes: &[u8]| parse_bytes(bytes, file).unwrap_err().kind;
    assert_eq!(kind(&[&GOOD.as_bytes()[..20], b"\xc3\x28"].concat()), ErrorKind::Syntax);
    assert_eq!(kind(&[0; 1000]), ErrorKind::Syntax);
    assert_eq!(kind("[".repeat(10_000_000).as_bytes()), ErrorKind::LimitExceeded);
    let nested = format!("{}1{}", "[".repeat(100), "]".repeat(100));
    assert_eq!(kind(nested.as_bytes()), ErrorKind::WrongType);
    assert_eq!(
        kind(format!("{{\"comment\": \"x\", \"{}\": 1}}", "k".repeat(1 << 20)).as_bytes()),
        ErrorKind::UnknownKey
    );
    assert!(parse_bytes(&[b"\xef\xbb\xbf", GOOD.as_bytes()].concat(), file).is_ok());

    let long = GOOD.replace("\"glass\": {", &format!("\"{}\": {{", "g".repeat(5000)));
    assert_eq!(parse_error(&long).unwrap().kind, ErrorKind::LimitExceeded);
    let steps = format!("\"material\": \"glass\", \"transform\": [{}]", vec!["{\"scale\": 1}"; 65].join(","));
    assert_eq!(parse_error(&GOOD.replace("\"material\": \"glass\"", &steps)).unwrap().kind, ErrorKind::LimitExceeded);
}

#[test]
fn long_chains_of_names_resolve_without_recursion() {
    let mut spectra: String = (0..50_000).map(|i| format!("\"s{i}\": {{\"name\": \"s{}\"}},", i + 1)).collect();
    spectra.push_str("\"s50000\": 0.5, ");
    let chain = GOOD
        .replace("\"spectra\": {", &format!("\"spectra\": {{ {spectra}"))
        .replace("\"reflectance\": \"red_paint\"", "\"reflectance\": \"s0\"");
    assert_eq!(parse_error(&chain), None);
    let too_bright = chain.replace("\"s50000\": 0.5", "\"s50000\": 1.5");
    assert_eq!(parse_error(&too_bright).unwrap().place, "materials.floor.reflectance");
}

#[test]
fn files_that_cannot_be_read_say_so() {
    let error = parse_file(Path::new("no/such/scene.json")).unwrap_err();
    assert_eq!(error.kind, ErrorKind::FileNotFound);
    assert!(error.to_string().starts_with("no/such/scene.json: cannot open"));
    assert_eq!(parse_file(Path::new(".")).unwrap_err().kind, ErrorKind::FileNotFound);
}

fn validator() -> &'static jsonschema::Validator {
    static VALIDATOR: OnceLock<jsonschema::Validator> = OnceLock::new();
    VALIDATOR.get_or_init(|| jsonschema::validator_for(&schema()).expect("a valid schema"))
}

/// Replaces the `target`-th value of a tree (in depth-first order) by `replacement`.
fn mutate(value: &mut Value, target: usize, replacement: &Value, seen: &mut usize) {
    let here = *seen;
    *seen += 1;
    if here == target {
        *value = replacement.clone();
        return;
    }
    match value {
        Value::Array(items) => items.iter_mut().for_each(|item| mutate(item, target, replacement, seen)),
        Value::Object(map) => map.values_mut().for_each(|item| mutate(item, target, replacement, seen)),
        _ => {}
    }
}

fn strange_values() -> impl Strategy<Value = Value> {
    let leaf = prop_oneof![
        Just(Value::Null),
        any::<bool>().prop_map(Value::from),
        any::<i64>().prop_map(Value::from),
        any::<f64>().prop_map(|x| json!(x)),
        prop::sample::select(vec!["", "glass", "red_paint", "sphere", "perspective", "comment", "é\u{0}"])
            .prop_map(Value::from),
        prop::sample::select(vec![
            json!({"rgb": [1, 1, 1]}),
            json!({"name": "red_paint", "scale": 3}),
            json!({"type": "quad", "origin": [0, 0, 0], "u": [1, 0, 0], "v": [1e-30, 1e-300, 0]}),
            json!({"type": "lens", "radii": [null, 1], "thickness": 1, "diameter": 1e-9}),
            json!({"type": "triangles", "positions": [0, 0, 0], "indices": [0, 0, 0]}),
            json!({"type": "implicit", "surface": "smooth-union", "centers": [[0, 0, 0]], "radii": [1]}),
            json!([{"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}, {"scale": [1, -1, 1e-30]}]),
        ]),
    ];
    leaf.prop_recursive(2, 8, 4, |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 0..4).prop_map(Value::from),
            prop::collection::hash_map("[a-z_]{0,6}|type|name|scale|radius", inner, 0..4).prop_map(|map| json!(map)),
        ]
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn mutated_scenes_never_panic(mutations in prop::collection::vec((0usize..398, strange_values()), 1..4)) {
        let mut scene: Value = serde_json::from_str(FULL).unwrap();
        for (target, replacement) in &mutations {
            mutate(&mut scene, *target, replacement, &mut 0);
        }
        match parse_error(&scene.to_string()) {
            Some(error) => prop_assert!(!error.message.is_empty() && !error.to_string().contains('\n')),
            None => prop_assert!(validator().is_valid(&scene), "parses, but the schema refuses {scene}"),
        }
    }

    #[test]
    fn damaged_bytes_never_panic(at in 0usize..900, byte in any::<u8>(), cut in 0usize..2000) {
        let mut bytes = GOOD.as_bytes().to_vec();
        let at = at % bytes.len();
        bytes[at] = byte;
        bytes.truncate(cut.max(1));
        let _ = parse_bytes(&bytes, Path::new("scene.json"));
    }
}
