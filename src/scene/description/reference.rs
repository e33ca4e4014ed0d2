//! The reference of the scene format in Markdown, made from what the decoders declare.

use std::fmt::Write;

use super::codec::{Codec, Field, Kind, Need, Rule, Table};
use super::document::SCENE;

/// Every kind of thing in a scene file with its keys: type, unit, default, limits and meaning, in Markdown.
pub fn reference() -> String {
    let mut writer =
        Writer { text: String::from(INTRODUCTION), waiting: Vec::new(), known: Vec::new(), written: Vec::new() };
    writer.later("a scene", SCENE.kind());
    while !writer.waiting.is_empty() {
        let (title, kind) = writer.waiting.remove(0);
        writer.section(&title, kind);
    }
    writer.text
}

const INTRODUCTION: &str = "\
# Keys of scene files

`abbe scene reference` prints this page from the same declarations that read scene files, so it is complete.
`abbe scene schema` prints them as a JSON Schema, which editors use to complete and check keys.

Lengths are in metres, angles in degrees, wavelengths in nanometres; y is up and axes are right-handed.
Every object may have the key `comment` with a string that is ignored.
In square brackets a limit is included, in round ones it is not.
";

struct Writer {
    text: String,
    /// Sections that something refers to and that are not written yet.
    waiting: Vec<(String, Kind)>,
    /// Titles of all sections.
    known: Vec<String>,
    /// Objects that are written already, by their description, with the title of their section.
    written: Vec<(&'static str, String)>,
}

impl Writer {
    /// Queues a section, unless it is known; returns a link to it.
    fn later(&mut self, what: &str, kind: Kind) -> String {
        let title = title(what);
        let link = format!("[{what}](#{})", anchor(&title));
        if !self.known.contains(&title) {
            self.known.push(title.clone());
            self.waiting.push((title, kind));
        }
        link
    }

    fn section(&mut self, title: &str, kind: Kind) {
        self.line(&format!("\n## {title}\n"));
        match kind {
            Kind::Object(table) => self.table(*table, 3),
            Kind::Either(kinds) => {
                for (kind, doc) in kinds {
                    match kind {
                        Kind::Object(table) => self.table_once(*table, title),
                        _ => self.line(&format!("* {}: {doc}", capitalized(&kind.expected()))),
                    }
                }
            }
            _ => self.line(&format!("{}.", capitalized(&kind.expected()))),
        }
    }

    /// Writes an object, or where it is written if that was done before.
    fn table_once(&mut self, table: Table, title: &str) {
        if let Some((_, title)) = self.written.iter().find(|(doc, _)| *doc == table.doc) {
            let link = format!("[{title}](#{})", anchor(title));
            self.line(&format!("* {}, as described under {link}.", capitalized(&table.expected())));
        } else {
            self.written.push((table.doc, title.to_owned()));
            self.line("* An object:\n");
            self.table(table, 3);
        }
    }

    fn table(&mut self, table: Table, level: usize) {
        if !table.doc.is_empty() {
            self.line(&format!("{}\n", table.doc));
        }
        let told = match table.tag {
            Some(tag) => format!("The key `{tag}` tells which:"),
            None => "The first key tells which:".to_owned(),
        };
        if !table.fields.is_empty() {
            self.fields(table.fields);
        }
        match table.rule {
            Rule::Free => {}
            Rule::AnyOf(_) => self.line(&format!("\nAt least one is needed: {}.", table.rule.describe())),
            Rule::OneOf(_) => self.line(&format!("\nJust one is needed: {}.", table.rule.describe())),
        }
        if !table.variants.is_empty() {
            let names: Vec<String> = table.variants.iter().map(|(name, _)| format!("`{name}`")).collect();
            self.line(&format!("\n{told} {}.", names.join(", ")));
        }
        for (name, variant) in table.variants {
            let name = table.tag.map_or(format!("`{name}`"), |tag| format!("`\"{tag}\": \"{name}\"`"));
            self.line(&format!("\n{} {name}: {}\n", "#".repeat(level), variant.what));
            self.table(variant, level + 1);
        }
    }

    fn fields(&mut self, fields: Vec<Field>) {
        self.line("| key | value | default | meaning |\n|---|---|---|---|");
        for field in fields {
            let default = match field.need {
                Need::Required => "required".to_owned(),
                Need::Optional => "—".to_owned(),
                Need::Default(text) => format!("`{text}`"),
            };
            let meaning = meaning(&field);
            let cells = [format!("`{}`", field.key), self.value(field.kind), default, meaning];
            self.line(&format!("| {} |", cells.map(|cell| cell.replace('|', "\\|")).join(" | ")));
        }
    }

    /// What may stand somewhere, with links to the sections of larger things.
    fn value(&mut self, kind: Kind) -> String {
        match kind {
            Kind::Object(ref table) => {
                let what = table.what;
                self.later(what, kind)
            }
            Kind::Defined(name, kind) => {
                let what = name.replace('_', " ");
                let article = if what.starts_with(['a', 'e', 'i', 'o']) { "an" } else { "a" };
                self.later(&format!("{article} {what}"), kind())
            }
            Kind::List { item, .. } if matches!(*item, Kind::Object(_) | Kind::Defined(..)) => {
                format!("a list, each item {}", self.value(*item))
            }
            Kind::Map { item, .. } => format!("an object of names, each with {}", self.value(*item)),
            _ => kind.expected(),
        }
    }

    fn line(&mut self, text: &str) {
        writeln!(self.text, "{text}").expect("writing to a string does not fail");
    }
}

/// A key's meaning, with the meaning of each name where there is a choice.
fn meaning(field: &Field) -> String {
    match &field.kind {
        Kind::Choice(names) => {
            let documented = names.iter().filter(|(_, doc)| !doc.is_empty());
            let names = documented.map(|(name, doc)| format!(" `\"{name}\"`: {doc}"));
            format!("{}{}", field.doc, names.collect::<String>())
        }
        _ => field.doc.to_owned(),
    }
}

/// "a scene" as a title.
fn title(what: &str) -> String {
    capitalized(what.trim_start_matches("an ").trim_start_matches("a "))
}

/// The address of a title inside the page.
fn anchor(title: &str) -> String {
    title.to_lowercase().replace(' ', "-")
}

fn capitalized(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or(String::new(), |first| first.to_uppercase().chain(chars).collect())
}
