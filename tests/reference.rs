//! The library against the frozen values of validation/reference: what `python3 validation/run.py --freeze` wrote from
//! colour-science, so that no Python is needed to check it.

#[path = "../validation/evaluate/functions/mod.rs"]
mod functions;

use serde_json::Value;
use std::path::Path;

/// A tolerated difference: absolute, or relative to the largest component of what is expected.
struct Tolerance {
    value: f64,
    relative: bool,
}

#[test]
fn the_library_has_the_frozen_values() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("validation/reference");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|e| e == "json"));
    files.sort();
    assert!(!files.is_empty(), "no frozen values");
    let misses: Vec<String> = files.iter().flat_map(|path| check_file(path)).collect();
    assert!(misses.is_empty(), "{}", misses.join("\n"));
}

fn check_file(path: &Path) -> Vec<String> {
    let text = std::fs::read_to_string(path).unwrap();
    let comparisons: Vec<Value> = serde_json::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    comparisons.iter().filter_map(check).map(|miss| format!("{}: {miss}", path.display())).collect()
}

fn check(comparison: &Value) -> Option<String> {
    let (subject, name) = (&comparison["subject"], comparison["function"].as_str().unwrap());
    let function = functions::by_name(name).unwrap_or_else(|| panic!("{subject}: no function {name:?}"));
    let tolerance = Tolerance {
        value: comparison["tolerance"].as_f64().unwrap(),
        relative: comparison["relative"].as_bool().unwrap(),
    };
    let (arguments, expected) =
        (comparison["arguments"].as_array().unwrap(), comparison["expected"].as_array().unwrap());
    assert_eq!(arguments.len(), expected.len(), "{subject}");
    assert!(!arguments.is_empty(), "{subject}");
    for (argument, expected) in arguments.iter().zip(expected) {
        let value = match function(argument) {
            Ok(value) => value,
            Err(error) => return Some(format!("{subject} at {argument}: {error}")),
        };
        if !agrees(&value, expected, &tolerance) {
            return Some(format!("{subject} at {argument}: {value}; expected {expected} within {}", tolerance.value));
        }
    }
    None
}

/// Whether numbers, lists of numbers or lists of lists agree.
fn agrees(value: &Value, expected: &Value, tolerance: &Tolerance) -> bool {
    let (Some(value), Some(expected)) = (flat(value), flat(expected)) else { return value == expected };
    let largest = expected.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let allowed = if tolerance.relative { tolerance.value * largest } else { tolerance.value };
    value.len() == expected.len() && value.iter().zip(&expected).all(|(a, b)| (a - b).abs() <= allowed)
}

/// The numbers of a nested list; `None` if there is anything else in it.
fn flat(value: &Value) -> Option<Vec<f64>> {
    match value {
        Value::Array(parts) => parts.iter().map(flat).collect::<Option<Vec<_>>>().map(|p| p.concat()),
        _ => value.as_f64().map(|number| vec![number]),
    }
}

#[test]
fn a_wrong_value_is_noticed() {
    let tolerance = Tolerance { value: 1e-3, relative: true };
    let [a, b] = [serde_json::json!([[100.0], 2.0]), serde_json::json!([[100.05], 2.05])];
    assert!(agrees(&a, &b, &tolerance));
    assert!(!agrees(&a, &b, &Tolerance { relative: false, ..tolerance }));
    assert!(!agrees(&a, &serde_json::json!([[100.0]]), &tolerance));
    assert!(!agrees(&serde_json::json!({ "error": "no" }), &a, &tolerance));
}
