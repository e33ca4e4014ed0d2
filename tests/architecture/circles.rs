//! No circles between files: the graph of which file uses what another one defines.
//!
//! A name counts for the file that defines it, not for the module that re-exports it: a parent may show what its children
//! define, and its children may use each other through it. What a file uses of the `mod.rs` of a folder that it is in does not
//! count either: there stands what the whole folder is about, such as the enum of its kinds or the arguments of all of them.

use crate::source::{Source, outside_tests};
use std::collections::{BTreeMap, BTreeSet};

/// A module with what its file defines and imports at the top level.
struct Module {
    file: String,
    path: Vec<String>,
    code: String,
    defined: BTreeSet<String>,
    imports: Vec<Import>,
}

/// One name of a `use`.
struct Import {
    /// From the crate's root.
    path: Vec<String>,
    /// The name that it has here; `*` for all of a module.
    name: String,
    /// Whether others see it too.
    is_public: bool,
}

/// What a path leads to.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Target {
    Module(Vec<String>),
    File(String),
}

struct Graph {
    modules: BTreeMap<Vec<String>, Module>,
    paths: BTreeSet<Vec<String>>,
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// The words of code and what stands between them, white space aside.
pub fn tokens(code: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let mut rest = code.trim_start();
    while let Some(first) = rest.chars().next() {
        let length = match first {
            c if is_word(c) => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
            ':' if rest.starts_with("::") => 2,
            c => c.len_utf8(),
        };
        tokens.push(&rest[..length]);
        rest = rest[length..].trim_start();
    }
    tokens
}

/// Names of items that are declared outside of all braces.
fn defined(tokens: &[&str]) -> BTreeSet<String> {
    const KEYWORDS: [&str; 8] = ["fn", "struct", "enum", "const", "static", "type", "trait", "union"];
    let mut depth = 0;
    let mut names = BTreeSet::new();
    for (i, token) in tokens.iter().enumerate() {
        match *token {
            "{" => depth += 1,
            "}" => depth -= 1,
            keyword if depth == 0 && KEYWORDS.contains(&keyword) => {
                names.extend(tokens.get(i + 1).map(|name| (*name).to_owned()));
            }
            "macro_rules" if depth == 0 => names.extend(tokens.get(i + 2).map(|name| (*name).to_owned())),
            _ => {}
        }
    }
    names
}

/// Reads one tree of a `use` from `at` on: its paths, each with the name that it binds.
fn use_tree(tokens: &[&str], at: &mut usize, prefix: &[String], found: &mut Vec<(Vec<String>, String)>) {
    let mut path = prefix.to_vec();
    while let Some(&token) = tokens.get(*at) {
        match token {
            "{" => {
                *at += 1;
                while tokens.get(*at).is_some_and(|token| *token != "}") {
                    use_tree(tokens, at, &path, found);
                    *at += usize::from(tokens.get(*at) == Some(&","));
                }
                *at += 1;
                return;
            }
            "," | "}" | ";" => break,
            "::" => *at += 1,
            "as" => {
                found.push((without_self(path), tokens[*at + 1].to_owned()));
                *at += 2;
                return;
            }
            name => {
                path.push(name.to_owned());
                *at += 1;
            }
        }
    }
    let path = without_self(path);
    let name = path.last().cloned().unwrap_or_default();
    found.push((path, name));
}

/// `a::self` is `a`.
fn without_self(mut path: Vec<String>) -> Vec<String> {
    if path.len() > 1 && path.last().is_some_and(|last| last == "self") {
        path.pop();
    }
    path
}

/// A name that a `use` binds: whether it is public, its path as written, and the name.
type Use = (bool, Vec<String>, String);

/// The code without its `use` declarations, and these.
pub fn split_uses<'a>(tokens: &[&'a str]) -> (Vec<&'a str>, Vec<Use>) {
    let (mut code, mut uses) = (Vec::new(), Vec::new());
    let mut at = 0;
    while at < tokens.len() {
        // `impl Trait + use<…>` captures, and imports nothing.
        if tokens[at] != "use" || tokens.get(at + 1) == Some(&"<") {
            code.push(tokens[at]);
            at += 1;
            continue;
        }
        let is_public = at > 0 && ["pub", ")"].contains(&tokens[at - 1]);
        let mut found = Vec::new();
        at += 1;
        use_tree(tokens, &mut at, &[], &mut found);
        uses.extend(found.into_iter().map(|(path, name)| (is_public, path, name)));
    }
    (code, uses)
}

impl Module {
    fn shows(&self, name: &str) -> bool {
        self.imports.iter().any(|import| import.is_public && import.name == *name)
    }
}

impl Graph {
    fn new(sources: impl Iterator<Item = Source>) -> Self {
        let sources: Vec<Source> = sources.collect();
        let paths: BTreeSet<Vec<String>> = sources.iter().map(Source::module).collect();
        let mut modules = BTreeMap::new();
        for source in &sources {
            let path = source.module();
            let all = tokens(&source.code);
            let (code, uses) = split_uses(&all);
            let imports = uses.into_iter().filter_map(|(is_public, tail, name)| {
                Some(Import { path: absolute(&paths, &path, &tail)?, name, is_public })
            });
            let module = Module {
                file: source.file.clone(),
                defined: defined(&code),
                imports: imports.collect(),
                code: code.join(" "),
                path: path.clone(),
            };
            modules.insert(path, module);
        }
        Self { modules, paths }
    }

    /// Where a path from the crate's root leads.
    fn resolve(&self, path: &[String], depth: usize) -> Option<Target> {
        let mut module = Vec::new();
        for (i, name) in path.iter().enumerate() {
            let inner = [module.as_slice(), std::slice::from_ref(name)].concat();
            // A function that is shown beside the module of its name is meant where the path ends.
            let is_shown = i + 1 == path.len() && self.modules.get(&module).is_some_and(|m| m.shows(name));
            if self.modules.contains_key(&inner) && !is_shown {
                module = inner;
                continue;
            }
            return self.item(&module, &path[i..], depth);
        }
        Some(Target::Module(module))
    }

    /// Where a name in a module leads, and what follows it if it is a module's.
    fn item(&self, module: &[String], rest: &[String], depth: usize) -> Option<Target> {
        let here = self.modules.get(module)?;
        let name = &rest[0];
        let file = || Some(Target::File(here.file.clone()));
        if here.defined.contains(name) || depth > 8 {
            return file();
        }
        if let Some(import) = here.imports.iter().find(|import| import.name == *name) {
            return self.resolve(&[&import.path, &rest[1..]].concat(), depth + 1);
        }
        let globs = here.imports.iter().filter(|import| import.name == "*");
        for glob in globs {
            let of = &glob.path[..glob.path.len() - 1];
            if self.modules.get(of).is_some_and(|target| target.defined.contains(name)) {
                return self.item(of, rest, depth + 1);
            }
        }
        file()
    }

    /// Files that a module's file uses.
    fn used(&self, module: &Module) -> BTreeSet<String> {
        let mut used = BTreeSet::new();
        let mut add = |target: Option<Target>| used.extend(target.and_then(Target::file));
        let words = tokens(&module.code);
        for import in &module.imports {
            if !import.is_public || words.contains(&import.name.as_str()) {
                add(self.resolve(&import.path, 0));
            }
        }
        for path in chains(&words) {
            let bound = module.imports.iter().find(|import| import.name == path[0]);
            let start = match bound {
                Some(import) => Some([&import.path, &path[1..]].concat()),
                None => absolute(&self.paths, &module.path, &path),
            };
            add(start.and_then(|path| self.resolve(&path, 0)));
        }
        used.retain(|file| *file != module.file && !is_above(file, &module.file));
        used
    }

    /// Files of each circle, in order.
    fn circles(&self) -> Vec<Vec<String>> {
        let edges: BTreeMap<String, BTreeSet<String>> =
            self.modules.values().map(|module| (module.file.clone(), self.used(module))).collect();
        let reached: BTreeMap<&String, BTreeSet<String>> =
            edges.keys().map(|file| (file, reachable(&edges, file))).collect();
        let mut circles = BTreeSet::new();
        for (file, all) in &reached {
            if all.contains(*file) {
                let mutual = all.iter().filter(|other| reached.get(other).is_some_and(|back| back.contains(*file)));
                circles.insert(mutual.cloned().collect::<Vec<_>>());
            }
        }
        circles.into_iter().collect()
    }
}

impl Target {
    /// The file of an item. A module alone is a name, and what is used of it counts.
    fn file(self) -> Option<String> {
        match self {
            Self::File(file) => Some(file),
            Self::Module(_) => None,
        }
    }
}

/// Whether a file is the `mod.rs` of a folder that another one is in.
fn is_above(file: &str, other: &str) -> bool {
    file.strip_suffix("mod.rs").is_some_and(|folder| other.starts_with(folder))
}

/// Paths of two and more names in code.
fn chains(words: &[&str]) -> Vec<Vec<String>> {
    let mut chains = Vec::new();
    let mut at = 0;
    while at < words.len() {
        let start = at;
        let mut path = vec![words[at].to_owned()];
        while words.get(at + 1) == Some(&"::") && words.get(at + 2).is_some_and(|word| word.starts_with(is_word)) {
            path.push(words[at + 2].to_owned());
            at += 2;
        }
        if path.len() > 1 && words[start].starts_with(is_word) && (start == 0 || words[start - 1] != "::") {
            chains.push(path);
        }
        at += 1;
    }
    chains
}

/// A path from the crate's root; `None` for one into another crate.
fn absolute(modules: &BTreeSet<Vec<String>>, here: &[String], path: &[String]) -> Option<Vec<String>> {
    let mut base = here.to_vec();
    let mut rest = path;
    match path.first()?.as_str() {
        "crate" => (base, rest) = (Vec::new(), &path[1..]),
        "self" => rest = &path[1..],
        "super" => {
            while rest.first().is_some_and(|name| name == "super") {
                base.pop();
                rest = &rest[1..];
            }
        }
        child => {
            let inner = [here, &[child.to_owned()]].concat();
            modules.get(&inner)?;
        }
    }
    Some([&base, rest].concat())
}

fn reachable(edges: &BTreeMap<String, BTreeSet<String>>, from: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut open = vec![from];
    while let Some(file) = open.pop() {
        for next in edges.get(file).into_iter().flatten() {
            if found.insert(next.clone()) {
                open.push(next);
            }
        }
    }
    found
}

fn is_one(source: &Source) -> bool {
    !["lib.rs", "main.rs"].contains(&source.file.as_str())
}

#[test]
fn no_circles_between_files() {
    let graph = Graph::new(outside_tests().filter(is_one));
    let circles: Vec<String> = graph.circles().iter().map(|files| files.join(" ↔ ")).collect();
    assert!(circles.is_empty(), "files that use each other:\n{}", circles.join("\n"));
}

#[test]
fn the_checker_sees_planted_circles() {
    let circles =
        |files: &[(&str, &str)]| Graph::new(files.iter().map(|(file, text)| Source::new(file, text))).circles();
    let two = |a: &str, b: &str| circles(&[("x/mod.rs", "mod a; mod b; pub use a::A;"), ("x/a.rs", a), ("x/b.rs", b)]);
    let a = "use super::b::B;\npub struct A;";
    assert_eq!(two(a, "use super::A;\npub struct B;"), [["x/a.rs", "x/b.rs"]]);
    assert_eq!(two(a, "pub fn f() { super::a::A }\npub struct B;"), [["x/a.rs", "x/b.rs"]]);
    assert_eq!(two(a, "use crate::x::{self};\nfn f() { x::A }\npub struct B;"), [["x/a.rs", "x/b.rs"]]);
    assert!(two(a, "#[cfg(test)] mod tests { use super::super::A; }\npub struct B;").is_empty());
    assert!(two("pub struct A;", "use super::A;\npub struct B;").is_empty());
    assert!(two("pub struct A;\npub fn f() -> impl Fn() + use<> { || () }", "use super::A;\npub struct B;").is_empty());

    // A parent on top of its children, and across folders.
    let child = ("y/c.rs", "use super::P;\npub fn c(_: P) {}");
    assert!(circles(&[("y/mod.rs", "mod c;\npub use c::c;\npub struct P; fn f() { c(P) }"), child]).is_empty());
    let other = ("z.rs", "pub fn z() { crate::y::c() }");
    let first = ("y/mod.rs", "mod c;\npub use c::c;\nfn f() { crate::z::z() }");
    assert!(circles(&[first, ("y/c.rs", "pub fn c() {}"), other]).is_empty());
    let back = ("y/c.rs", "use crate::z;\npub fn c() { z::z() }");
    assert_eq!(circles(&[first, back, other]), [["y/c.rs", "z.rs"]]);
}
