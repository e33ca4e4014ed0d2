//! The crate's source files as the checks see them: code without comments, texts and tests.

use std::fs;
use std::path::{Path, PathBuf};

/// A source file without comments, string contents and test code; line breaks stay where they are.
pub struct Source {
    /// Relative to `src`, with `/`.
    pub file: String,
    pub code: String,
    /// Lines of the file as it is, for its length.
    pub lines: usize,
}

impl Source {
    pub fn new(file: &str, text: &str) -> Self {
        Self { file: file.to_owned(), code: without_tests(&without_text(text)), lines: text.lines().count() }
    }

    /// The module's path, `["scene", "compile"]` for `scene/compile/mod.rs`; empty for `lib.rs`.
    pub fn module(&self) -> Vec<String> {
        let stem = self.file.trim_end_matches(".rs");
        let parts = stem.split('/').filter(|part| !["mod", "lib"].contains(part));
        parts.map(str::to_owned).collect()
    }

    pub fn line_of(&self, at: usize) -> usize {
        self.code[..at].matches('\n').count() + 1
    }

    /// Lines of code that hold a match, as `file:line: text`.
    pub fn lines_with(&self, matches: impl Fn(&str) -> bool) -> Vec<String> {
        let lines = self.code.lines().enumerate().filter(|(_, line)| matches(line));
        lines.map(|(i, line)| format!("{}:{}: {}", self.file, i + 1, line.trim())).collect()
    }
}

/// Blanks comments and the contents of string and character literals.
fn without_text(text: &str) -> String {
    let chars: Vec<char> = text.chars().collect();
    let starts = |i: usize, what: &str| what.chars().enumerate().all(|(k, c)| chars.get(i + k) == Some(&c));
    let mut out = String::with_capacity(text.len());
    let blank = |from: usize, to: usize, out: &mut String| {
        out.extend(chars[from..to.min(chars.len())].iter().map(|&c| if c == '\n' { '\n' } else { ' ' }));
        to.min(chars.len())
    };
    let find = |from: usize, what: &str| (from..chars.len()).find(|&i| starts(i, what)).unwrap_or(chars.len());
    let mut i = 0;
    while i < chars.len() {
        let part_of_a_word = i > 0 && (chars[i - 1].is_alphanumeric() || chars[i - 1] == '_');
        let hashes = chars[i + 1..].iter().take_while(|&&c| c == '#').count();
        if starts(i, "//") {
            i = blank(i, find(i, "\n"), &mut out);
        } else if starts(i, "/*") {
            i = blank(i, end_of_block_comment(&chars, i), &mut out);
        } else if chars[i] == 'r' && !part_of_a_word && chars.get(i + 1 + hashes) == Some(&'"') {
            let close = format!("\"{}", "#".repeat(hashes));
            i = blank(i, find(i + 2 + hashes, &close) + close.len(), &mut out);
        } else if chars[i] == '"' {
            let mut end = i + 1;
            while end < chars.len() && chars[end] != '"' {
                end += if chars[end] == '\\' { 2 } else { 1 };
            }
            i = blank(i, end + 1, &mut out);
        } else if chars[i] == '\'' && chars.get(i + 1) == Some(&'\\') {
            i = blank(i, find(i + 3, "'") + 1, &mut out);
        } else if chars[i] == '\'' && chars.get(i + 2) == Some(&'\'') {
            i = blank(i, i + 3, &mut out);
        } else {
            out.push(chars[i]);
            i += 1;
        }
    }
    out
}

/// The position after a block comment, which may hold others.
fn end_of_block_comment(chars: &[char], start: usize) -> usize {
    let (mut depth, mut i) = (0, start);
    while i < chars.len() {
        match (chars[i], chars.get(i + 1)) {
            ('/', Some('*')) => (depth, i) = (depth + 1, i + 2),
            ('*', Some('/')) => (depth, i) = (depth - 1, i + 2),
            _ => i += 1,
        }
        if depth == 0 {
            break;
        }
    }
    i
}

const TEST_ATTRIBUTE: &str = "#[cfg(test)]";

/// The position after the item that starts at `start`: its closing brace or semicolon.
fn end_of_item(code: &str, start: usize) -> usize {
    let mut depth = 0;
    for (i, c) in code[start..].char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 1 => return start + i + 1,
            '}' => depth -= 1,
            ';' if depth == 0 => return start + i + 1,
            _ => {}
        }
    }
    code.len()
}

/// Blanks items behind `#[cfg(test)]`.
fn without_tests(code: &str) -> String {
    let mut out = code.to_owned();
    while let Some(start) = out.find(TEST_ATTRIBUTE) {
        let end = end_of_item(&out, start);
        let blank: String = out[start..end].chars().map(|c| if c == '\n' { '\n' } else { ' ' }).collect();
        out.replace_range(start..end, &blank);
    }
    out
}

/// Whether a file is a module that its parent declares for tests alone.
pub fn is_test_file(file: &str) -> bool {
    file.rsplit('/').next() == Some("tests.rs")
}

pub fn rust_files(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            rust_files(&path, files);
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
}

/// All of src, except files of tests.
pub fn tree() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    rust_files(&root, &mut files);
    files.sort();
    let sources: Vec<Source> = files
        .iter()
        .map(|path| {
            let relative = path.strip_prefix(&root).unwrap().to_str().unwrap().replace('\\', "/");
            Source::new(&relative, &fs::read_to_string(path).unwrap())
        })
        .collect();
    assert!(sources.len() > 90, "only {} files found", sources.len());
    sources
}

pub fn outside_tests() -> impl Iterator<Item = Source> {
    tree().into_iter().filter(|source| !is_test_file(&source.file))
}
