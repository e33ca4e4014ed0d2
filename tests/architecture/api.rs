//! What is public is used: the compiler sees dead code only among what is not.

use crate::circles::{split_uses, tokens};
use crate::source::{Source, outside_tests, rust_files};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// Rooms that are there for users of the library: nothing in the crate need use all that they offer.
const API: [&str; 8] = ["color", "math", "metrics", "optics", "project", "references", "sampling", "spectrum"];

/// Public items of other rooms that are there for users although nothing outside the room uses them: a sensor's
/// further channels, the limits of what is read, and lists of names.
const KEPT: [&str; 7] = [
    "film: Sensor::with_channels",
    "io: MAX_BYTES",
    "io: MAX_MESH_BYTES",
    "io: MESH_EXTENSIONS",
    "io: VISIBLE_NM",
    "io: glass_names",
    "io: metal_names",
];

/// The public items of a file: those at its top level, and functions of `impl` blocks with the type's name.
#[derive(Default)]
struct Items {
    modules: BTreeSet<String>,
    top: BTreeSet<String>,
    methods: Vec<(String, String)>,
    shown: BTreeSet<String>,
    shown_whole: BTreeSet<String>,
    /// Names in the signatures, fields and variants of public items: who has the item has these too.
    signatures: BTreeSet<String>,
}

impl Items {
    fn new(source: &Source) -> Self {
        let (code, uses) = split_uses(&tokens(&source.code));
        let mut items = Self::default();
        for (_, path, name) in uses.into_iter().filter(|(is_public, ..)| *is_public) {
            match name.as_str() {
                "*" => items.shown_whole.extend(path.iter().rev().nth(1).cloned()),
                _ => drop(items.shown.insert(name)),
            }
        }
        let (mut depth, mut owner) = (0, None);
        for (i, &token) in code.iter().enumerate() {
            match token {
                "{" => depth += 1,
                "}" => depth -= 1,
                "impl" if depth == 0 => owner = Some(implemented(&code[i + 1..])),
                "pub" if depth <= 1 => {
                    items.signatures.extend(signature(&code[i + 1..]).into_iter().map(str::to_owned));
                    let Some((keyword, name)) = declared(&code[i + 1..]) else { continue };
                    match (depth, keyword, &owner) {
                        (0, "mod", _) => drop(items.modules.insert(name.to_owned())),
                        (0, ..) => drop(items.top.insert(name.to_owned())),
                        (_, "fn" | "const", Some(owner)) => items.methods.push((owner.clone(), name.to_owned())),
                        _ => {}
                    }
                }
                "struct" | "enum" | "fn" | "trait" if depth == 0 => owner = None,
                _ => {}
            }
        }
        items
    }
}

/// The keyword and the name of the declaration that follows `pub`; `None` for `pub(crate)`, fields and `pub use`.
fn declared<'a>(code: &[&'a str]) -> Option<(&'a str, &'a str)> {
    const KEYWORDS: [&str; 8] = ["fn", "struct", "enum", "const", "static", "type", "trait", "mod"];
    let at = usize::from(code.first() == Some(&"const") && code.get(1) == Some(&"fn"));
    let keyword = code.get(at).filter(|keyword| KEYWORDS.contains(keyword))?;
    Some((keyword, code.get(at + 1)?))
}

/// The names behind `pub` up to the body, the next field or the end; an enum's variants too. Not the item's own.
fn signature<'a>(code: &[&'a str]) -> BTreeSet<&'a str> {
    let own = declared(code).map(|(_, name)| name);
    let is_enum = code.first() == Some(&"enum");
    let mut names = BTreeSet::new();
    let mut depth = 0;
    for (i, &token) in code.iter().enumerate().filter(|(_, token)| Some(**token) != own) {
        match token {
            // The arrow before what a function returns.
            ">" if i > 0 && code[i - 1] == "-" => {}
            "(" | "<" | "[" => depth += 1,
            "{" if is_enum => depth += 1,
            "{" | ";" | "=" if depth == 0 => break,
            ")" | ">" | "]" | "}" => depth -= 1,
            "," if depth == 0 => break,
            _ => drop(names.insert(token)),
        }
        if depth < 0 || (depth == 0 && token == "}") {
            break;
        }
    }
    names
}

/// The type of an `impl` block, from the tokens behind the word.
fn implemented(code: &[&str]) -> String {
    let mut depth = 0;
    let mut name = "";
    for &token in code {
        match token {
            "{" => break,
            "<" => depth += 1,
            ">" => depth -= 1,
            "for" if depth == 0 => name = "",
            word if depth == 0 && name.is_empty() && word.starts_with(char::is_alphabetic) => name = word,
            _ => {}
        }
    }
    name.to_owned()
}

/// Public items that no other room, test, benchmark or example names.
fn unused(sources: &[Source], outside: &BTreeSet<String>) -> Vec<String> {
    let room = |source: &Source| source.module().first().cloned().unwrap_or_default();
    let mut words: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for source in sources {
        words.entry(room(source)).or_default().extend(tokens(&source.code).into_iter().map(str::to_owned));
    }
    let items: Vec<(&Source, Items)> = sources.iter().map(|source| (source, Items::new(source))).collect();
    let is_shown = |source: &Source| {
        let path = source.module();
        (1..path.len()).all(|n| {
            let parent = items.iter().find(|(other, _)| other.module() == path[..n]);
            parent.is_some_and(|(_, items)| items.modules.contains(&path[n]))
        })
    };
    let mut found = Vec::new();
    for name in words.keys().filter(|room| !room.is_empty() && *room != "cli" && !API.contains(&room.as_str())) {
        let of_room = || items.iter().filter(|(source, _)| room(source) == *name);
        let mut exported: BTreeSet<&String> = BTreeSet::new();
        for (_, file) in of_room().filter(|(source, _)| is_shown(source)) {
            exported.extend(file.top.iter().chain(&file.shown));
            let whole = |source: &Source| source.module().last().is_some_and(|m| file.shown_whole.contains(m));
            exported.extend(of_room().filter(|(source, _)| whole(source)).flat_map(|(_, items)| &items.top));
        }
        let elsewhere = |item: &String| {
            outside.contains(item) || words.iter().any(|(other, words)| other != name && words.contains(item))
        };
        let in_signatures = |item: &String| of_room().any(|(_, items)| items.signatures.contains(item));
        let unused = |item: &&&String| !elsewhere(item) && !in_signatures(item);
        found.extend(exported.iter().filter(unused).map(|item| format!("{name}: {item}")));
        let methods = of_room().flat_map(|(_, items)| &items.methods);
        let methods = methods.filter(|(owner, method)| exported.contains(owner) && !elsewhere(method));
        found.extend(methods.map(|(owner, method)| format!("{name}: {owner}::{method}")));
    }
    found
}

/// All words of tests, benchmarks and examples.
fn words_outside() -> BTreeSet<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    for folder in ["tests", "benches", "examples", "validation"] {
        rust_files(&root.join(folder), &mut files);
    }
    files.retain(|file| !file.starts_with(root.join("tests/architecture")));
    let sources: Vec<Source> = files.iter().map(|file| Source::new("", &fs::read_to_string(file).unwrap())).collect();
    sources.iter().flat_map(|source| tokens(&source.code)).map(str::to_owned).collect()
}

#[test]
fn what_is_public_is_used() {
    let sources: Vec<Source> = outside_tests().collect();
    let mut found = unused(&sources, &words_outside());
    let stale: Vec<_> = KEPT.iter().filter(|kept| !found.iter().any(|item| item == *kept)).collect();
    assert!(stale.is_empty(), "listed, but used, no longer public or gone; take off the list: {stale:#?}");
    found.retain(|item| !KEPT.contains(&item.as_str()));
    assert!(found.is_empty(), "public, but not used outside of their room:\n{}", found.join("\n"));
}

#[test]
fn the_checker_sees_planted_items() {
    let found = |a: &str, b: &str, outside: &[&str]| {
        let sources = [("a/mod.rs", a), ("a/inner.rs", b), ("z.rs", "fn f() { used() }")];
        let outside = outside.iter().map(|word| (*word).to_owned()).collect();
        unused(&sources.map(|(file, text)| Source::new(file, text)), &outside)
    };
    assert_eq!(found("mod inner; pub fn used() {} pub fn unused() {}", "pub fn hidden() {}", &[]), ["a: unused"]);
    assert!(found("mod inner; pub(crate) fn unused() {}", "", &[]).is_empty());
    assert!(found("mod inner; pub fn unused() {}", "", &["unused"]).is_empty());
    assert_eq!(found("mod inner; pub use inner::T;", "pub struct T { pub x: u8 }", &[]), ["a: T"]);
    assert_eq!(found("pub mod inner;", "pub const C: u8 = 0;", &[]), ["a: C"]);
    assert_eq!(found("mod inner; pub use inner::*;", "pub enum E { A }", &[]), ["a: E"]);
    let both = "mod inner; pub use inner::{S, T}; pub fn used() -> Option<S> {}";
    assert!(found(both, "pub struct S { pub x: T } pub enum T { A }", &[]).is_empty());
    let arrays = "mod inner; pub use inner::S; pub fn used(u: [u8; 2]) -> Option<S> {}";
    assert!(found(arrays, "pub struct S {}", &[]).is_empty());
    let methods = "pub struct T<A>(A); impl<A: B> T<A> { pub fn used() {} pub const fn m() {} fn n() {} }";
    assert_eq!(found("mod inner; pub use inner::T;", methods, &["T"]), ["a: T::m"]);
}
