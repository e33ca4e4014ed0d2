//! Every JSON block of the documentation compiles. A block marked `json` is a whole scene; one marked `json fragment` is a part
//! of a scene, to which camera and film are added if it has none. Paths in blocks start at scenes/recipes/.

use std::fs;
use std::path::{Path, PathBuf};

use abbe::scene::compile;
use abbe::scene::description::parse_str;
use serde_json::{Map, Value, json};

/// The blocks of a page, each with its line, whether it is a fragment, and its text.
fn blocks(page: &str) -> Vec<(usize, bool, String)> {
    let mut blocks = Vec::new();
    let mut open: Option<(usize, bool, String)> = None;
    for (number, line) in page.lines().enumerate() {
        match (&mut open, line) {
            (None, "```json") => open = Some((number + 1, false, String::new())),
            (None, "```json fragment") => open = Some((number + 1, true, String::new())),
            (Some(_), "```") => blocks.extend(open.take()),
            (Some((.., text)), _) => text.extend([line, "\n"]),
            (None, _) => {}
        }
    }
    assert!(open.is_none(), "a block without an end");
    blocks
}

/// A fragment with what it lacks to be a scene.
fn completed(fragment: &str) -> String {
    let mut scene: Map<String, Value> = serde_json::from_str(fragment).unwrap();
    let camera = json!({ "type": "perspective", "from": [0, 1, 5], "to": [0, 0, 0] });
    scene.entry("camera").or_insert(camera);
    scene.entry("film").or_insert(json!({ "width": 8, "height": 8 }));
    Value::Object(scene).to_string()
}

fn pages(root: &Path) -> Vec<PathBuf> {
    let docs = fs::read_dir(root.join("docs")).unwrap().map(|entry| entry.unwrap().path());
    let mut pages: Vec<PathBuf> = docs.filter(|path| path.extension().is_some_and(|e| e == "md")).collect();
    pages.push(root.join("README.md"));
    pages
}

/// The README shows scenes/first.json, whose picture stands below it.
#[test]
fn the_first_scene_is_the_one_in_the_readme() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let readme = blocks(&fs::read_to_string(root.join("README.md")).unwrap());
    let first = fs::read_to_string(root.join("scenes/first.json")).unwrap();
    assert_eq!(readme.iter().map(|(_, _, text)| text.trim()).collect::<Vec<_>>(), [first.trim()]);
}

#[test]
fn scenes_in_the_documentation_compile() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let beside = root.join("scenes/recipes/block.json");
    let mut checked = 0;
    for page in pages(root) {
        for (line, is_fragment, text) in blocks(&fs::read_to_string(&page).unwrap()) {
            let text = if is_fragment { completed(&text) } else { text };
            let place = format!("{}:{line}", page.display());
            let parsed = parse_str(&text, &beside).unwrap_or_else(|e| panic!("{place}: {e}"));
            compile(&parsed.description).unwrap_or_else(|e| panic!("{place}: {e}"));
            checked += 1;
        }
    }
    assert!(checked >= 5, "{checked} blocks");
}
