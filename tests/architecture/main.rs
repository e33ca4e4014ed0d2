//! Reads the source and holds the rules of its architecture: who may use whom, and what may not be written at all.

mod api;
mod circles;
mod source;

use source::{Source, outside_tests, tree};
use std::collections::BTreeSet;

/// What a part of the crate may use of another.
enum Grant {
    /// All of a module.
    Module(&'static str),
    /// These items of a module alone.
    Items(&'static str, &'static [&'static str]),
}

use Grant::{Items, Module};

/// Parts of the crate by module path, each with what it may use besides itself, `math` and the items of the crate's
/// root. The longest path that fits a file decides.
const RULES: &[(&str, &[Grant])] = &[
    ("math", &[]),
    ("error", &[]),
    ("image", &[]),
    ("references", &[]),
    ("geometry", &[]),
    ("sampling", &[]),
    ("spectrum", &[Module("sampling")]),
    ("color", &[Module("spectrum")]),
    ("optics", &[Module("spectrum")]),
    ("bsdf", &[Items("geometry", &["Frame"]), Module("optics"), Module("sampling"), Module("spectrum")]),
    ("film", &[Module("color"), Module("sampling"), Module("spectrum")]),
    ("metrics", &[Module("color")]),
    ("develop", &[Module("color"), Module("film")]),
    (
        "io",
        &[
            Module("color"),
            Items("develop", &["Picture"]),
            Module("film"),
            Module("geometry"),
            Module("optics"),
            Module("spectrum"),
        ],
    ),
    ("scene", &[Module("geometry"), Module("optics"), Module("sampling"), Module("spectrum")]),
    // Plain enums, and the limits that the modules below state.
    (
        "scene::description",
        &[
            Items("color", &["Observer"]),
            Items("develop", &["TONEMAPS", "Tonemap"]),
            Items("geometry", &["implicit"]),
            Items("io", &["spectrum_file"]),
            Items("scene", &["Integrator"]),
        ],
    ),
    (
        "scene::compile",
        &[
            Module("bsdf"),
            Module("color"),
            Items("film", &["Filter", "Sensor"]),
            Module("geometry"),
            Module("io"),
            Module("optics"),
            Module("sampling"),
            Module("scene"),
            Module("scene::description"),
            Module("spectrum"),
        ],
    ),
    (
        "render",
        &[
            Module("bsdf"),
            Items("color", &["Observer"]),
            Module("film"),
            Module("geometry"),
            Items("metrics", &["stats"]),
            Module("optics"),
            Module("sampling"),
            Module("scene"),
            Module("spectrum"),
        ],
    ),
];

/// Modules that may use everything, and that nothing may use.
const TOP: &[&str] = &["cli", "main", "project"];

/// Numbers that look like absolute epsilons, and why they are none: file, part of the line, reason.
const EPSILONS: &[(&str, &str, &str)] = &[
    ("bsdf/microfacet.rs", "const SMOOTHEST: f64 = 1e-4;", "a slope"),
    ("bsdf/rough_dielectric.rs", "const LEAST_CONTRAST: f64 = 1e-9;", "relative to the index"),
    ("geometry/implicit/mod.rs", "step.length() <= 1e-6 * p.length()", "relative to the point"),
    (
        "render/driver/run.rs",
        "const SHORTEST_PASS: f64 = 0.001;",
        "seconds; decides how often to look up, no bit of the film",
    ),
];

/// Every path that starts at `crate::` or climbs with `super::`, with its position, from the crate's root.
fn absolute_paths(source: &Source) -> Vec<(usize, Vec<String>)> {
    let code = &source.code;
    let mut paths = Vec::new();
    for (root, is_super) in [("crate", false), ("super", true)] {
        for (at, _) in code.match_indices(root) {
            let word = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
            let continued = code[at + root.len()..].trim_start().starts_with("::");
            if code[..at].ends_with(word) || !continued {
                continue;
            }
            let base = if is_super { source.module() } else { Vec::new() };
            let mut rest = &code[at..];
            let mut base = base;
            while let Some(after) = rest.strip_prefix("super") {
                base.pop();
                rest = after.trim_start().trim_start_matches("::").trim_start();
            }
            let rest = rest.strip_prefix("crate").map_or(rest, |r| r.trim_start().trim_start_matches("::"));
            let mut tails = Vec::new();
            use_tree(rest, &mut tails);
            paths.extend(tails.into_iter().map(|tail| (at, base.iter().cloned().chain(tail).collect())));
        }
    }
    paths
}

/// Expands `a::{b, c::d}` into its paths; returns what follows.
fn use_tree<'a>(text: &'a str, paths: &mut Vec<Vec<String>>) -> &'a str {
    let text = text.trim_start();
    if let Some(mut rest) = text.strip_prefix('{') {
        loop {
            rest = rest.trim_start();
            if rest.is_empty() {
                return rest;
            }
            if let Some(after) = rest.strip_prefix('}') {
                return after;
            }
            let before = rest.len();
            rest = use_tree(rest, paths);
            // `as name` and commas.
            rest = rest.trim_start_matches(|c: char| c != '}' && c != ',').trim_start_matches(',');
            assert!(rest.len() < before, "a use tree that is none: {rest:.40}");
        }
    }
    let length = text.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == '*')).unwrap_or(text.len());
    let (name, rest) = text.split_at(length);
    match rest.trim_start().strip_prefix("::") {
        Some(rest) if !name.is_empty() => {
            let mut tails = Vec::new();
            let rest = use_tree(rest, &mut tails);
            paths.extend(tails.into_iter().map(|tail| [vec![name.to_owned()], tail].concat()));
            rest
        }
        _ => {
            paths.push(if name.is_empty() { Vec::new() } else { vec![name.to_owned()] });
            rest
        }
    }
}

/// The longest rule whose module holds a path.
fn rule_of(path: &[String]) -> Option<&'static (&'static str, &'static [Grant])> {
    RULES
        .iter()
        .filter(|(module, _)| module.split("::").enumerate().all(|(i, part)| path.get(i).is_some_and(|p| p == part)))
        .max_by_key(|(module, _)| module.len())
}

/// Uses that the rules forbid, as `file:line: …`.
fn forbidden_uses(source: &Source) -> Vec<String> {
    let module = source.module();
    let Some(first) = module.first() else { return Vec::new() };
    if TOP.contains(&first.as_str()) {
        return Vec::new();
    }
    let Some((own, grants)) = rule_of(&module) else {
        return vec![format!("{}: no rule says what `{first}` may use", source.file)];
    };
    let mut found = Vec::new();
    for (at, path) in absolute_paths(source) {
        let allowed = match rule_of(&path) {
            // Its own parts are its own business; a part inside another has to be granted its surroundings.
            Some((target, _)) if target == own || *target == "math" => true,
            Some((target, _)) => grants.iter().any(|grant| match grant {
                Module(module) => module == target,
                Items(module, items) => {
                    module == target && path.get(1).is_some_and(|item| items.contains(&item.as_str()))
                }
            }),
            // Items of the crate's root.
            None => !path.first().is_some_and(|p| TOP.contains(&p.as_str())),
        };
        if !allowed {
            found.push(format!("{}:{}: `{own}` may not use `{}`", source.file, source.line_of(at), path.join("::")));
        }
    }
    // Imported whole, a module could be asked for its parts by a relative path.
    if own == &"render" {
        found.extend(source.lines_with(|line| line.contains("description")));
    }
    found
}

/// Whether a line holds a number between 1e-9 and 1e-3.
fn has_small_number(line: &str) -> bool {
    let small_exponent = line.match_indices("e-").any(|(i, _)| {
        let exponent: String = line[i + 2..].chars().take_while(char::is_ascii_digit).collect();
        let mantissa = line[..i].ends_with(|c: char| c.is_ascii_digit() || c == '.');
        mantissa && exponent.parse::<u32>().is_ok_and(|e| (3..=9).contains(&e))
    });
    let zeros = line.match_indices("0.00").any(|(i, _)| {
        let number_starts = !line[..i].ends_with(|c: char| c.is_ascii_digit());
        let digits: String = line[i + 2..].chars().take_while(|c| c.is_ascii_digit() || *c == '_').collect();
        number_starts && !digits.trim_matches(['0', '_']).is_empty()
    });
    small_exponent || zeros
}

fn holds_word(line: &str, word: &str) -> bool {
    line.match_indices(word).any(|(i, _)| {
        let letter = |c: char| c.is_alphanumeric() || c == '_';
        !line[..i].ends_with(letter) && !line[i + word.len()..].starts_with(letter)
    })
}

fn assert_none(found: Vec<String>, what: &str) {
    assert!(found.is_empty(), "{what}:\n{}", found.join("\n"));
}

#[test]
fn modules_use_what_lies_below_them() {
    assert_none(outside_tests().flat_map(|source| forbidden_uses(&source)).collect(), "uses against the architecture");
    let modules: BTreeSet<String> = tree().iter().filter_map(|source| source.module().first().cloned()).collect();
    let known: BTreeSet<String> =
        RULES.iter().map(|(module, _)| *module).chain(TOP.iter().copied()).map(str::to_owned).collect();
    assert!(modules.is_subset(&known), "modules without a rule: {:?}", modules.difference(&known));
}

#[test]
fn no_unsafe_code() {
    let found = tree().iter().flat_map(|source| source.lines_with(|line| holds_word(line, "unsafe"))).collect();
    assert_none(found, "unsafe code");
}

#[test]
fn no_absolute_epsilons_in_transport() {
    let folders = ["geometry/", "bsdf/", "render/"];
    let mut used = vec![false; EPSILONS.len()];
    let mut found = Vec::new();
    for source in outside_tests().filter(|source| folders.iter().any(|folder| source.file.starts_with(folder))) {
        found.extend(source.lines_with(has_small_number).into_iter().filter(|line| {
            let known = EPSILONS.iter().position(|(file, part, _)| source.file == *file && line.contains(part));
            known.inspect(|&i| used[i] = true).is_none()
        }));
    }
    assert_none(found, "epsilons that are not on the list");
    let stale: Vec<_> = EPSILONS.iter().zip(used).filter(|(_, used)| !used).map(|(entry, _)| entry.1).collect();
    assert!(stale.is_empty(), "on the list, but nowhere else: {stale:?}");
}

#[test]
fn files_are_of_a_size_to_be_read() {
    let long = tree().into_iter().filter(|s| s.lines > 800).map(|s| format!("{}: {} lines", s.file, s.lines));
    assert_none(long.collect(), "files of more than 800 lines");
}

#[test]
fn only_the_command_line_prints_and_exits() {
    let prints = |line: &str| {
        ["println!", "eprintln!", "print!", "eprint!", "process::exit"].iter().any(|word| {
            let macro_or_path = word.trim_end_matches('!');
            line.contains(word) && holds_word(line, macro_or_path)
        })
    };
    let found = outside_tests().filter(|s| !s.file.starts_with("cli/")).flat_map(|s| s.lines_with(prints)).collect();
    assert_none(found, "printing or exiting outside cli/");
}

#[test]
fn nothing_is_left_to_be_written() {
    let unfinished = |line: &str| ["todo!", "unimplemented!", "dbg!"].iter().any(|word| line.contains(word));
    assert_none(tree().iter().flat_map(|source| source.lines_with(unfinished)).collect(), "unfinished code");
}

#[test]
fn the_checker_sees_planted_violations() {
    let count = |file: &str, text: &str| forbidden_uses(&Source::new(file, text)).len();
    assert_eq!(count("render/path.rs", "use crate::scene::description::SceneDescription;"), 2);
    assert_eq!(count("render/path.rs", "use crate::scene::{Scene, compile::compile};"), 1);
    assert_eq!(count("render/path.rs", "use crate::{scene::{Scene}, develop::{self, Tonemap as T}, math};"), 2);
    assert_eq!(count("render/path.rs", "use super::super::develop;"), 1);
    assert_eq!(count("render/path.rs", "use crate::color::{Observer, RgbSpace};"), 1);
    assert_eq!(count("color/rgb.rs", "fn f() { crate::render::render() }"), 1);
    assert_eq!(count("bsdf/mod.rs", "use crate::geometry::{Frame, Bvh};"), 1);
    assert_eq!(count("optics/mod.rs", "use crate::cli::main;"), 1);
    assert_eq!(count("geometry/ray.rs", "use crate\n    ::\n    spectrum::LANES;"), 1);
    assert_eq!(count("scene/light.rs", "use super::description::LightKind;"), 1);
    assert_eq!(count("unknown/mod.rs", ""), 1);

    assert_eq!(count("render/path.rs", "use crate::scene::{Scene, Exit};\nuse super::Walk;\nuse crate::Error;"), 0);
    assert_eq!(count("color/rgb.rs", "/// See [`crate::render`].\n/* crate::render /* */ */ // crate::render"), 0);
    assert_eq!(count("color/rgb.rs", "const A: &str = \"crate::render \\\" \"; const B: char = '\"';"), 0);
    assert_eq!(count("color/rgb.rs", "const A: &str = r#\" \" crate::render\"#; fn f<'a>(x: &'a u8) {}"), 0);
    assert_eq!(count("color/rgb.rs", "#[cfg(test)]\nmod tests {\n use crate::render; fn f() {} }"), 0);
    let behind_tests = "#[cfg(test)]\nmod tests { fn f() { '}'; \"}\"; } }\nuse crate::render;";
    assert_eq!(forbidden_uses(&Source::new("color/rgb.rs", behind_tests)).len(), 1);
    assert!(forbidden_uses(&Source::new("color/rgb.rs", behind_tests))[0].starts_with("color/rgb.rs:3: "));
}

#[test]
fn the_checker_sees_planted_words_and_numbers() {
    for line in ["t > 1e-4", "x + 2.5e-09", "0.0001 * d", "1.e-3", "0.000_01", "0.001"] {
        assert!(has_small_number(line), "{line}");
    }
    for line in ["1e-20", "1e-2", "0.00", "0.07", "f32::EPSILON", "one-3", "value-4", "10.001"] {
        assert!(!has_small_number(line), "{line}");
    }
    assert!(holds_word("unsafe { }", "unsafe") && !holds_word("unsafe_code", "unsafe"));
    let source = Source::new("film/mod.rs", "fn f() {\n    println!(\"x\"); // println!\n}\n// eprintln!");
    assert_eq!(source.lines_with(|line| line.contains("println!")), ["film/mod.rs:2: println!(   );"]);
}
