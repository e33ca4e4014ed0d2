//! From a scene file to a [`SceneDescription`].

use std::fs::File;
use std::io::Read;
use std::path::Path as FilePath;

use super::codec::{Codec, Value, error};
use super::context::Context;
use super::document::{SCENE, SceneDescription, VERSION};
use super::json::{self, Json};
use super::path::Path;
use crate::{Error, ErrorKind, Result};

/// Most warnings that are kept one by one.
const MAX_WARNINGS: usize = 20;

/// A scene with what deserves a look in it.
#[derive(Debug, Clone, PartialEq)]
pub struct Parsed {
    /// The scene.
    pub description: SceneDescription,
    /// One line each, with file and JSON path.
    pub warnings: Vec<String>,
}

/// Reads a scene file. Errors name the file, the place in it, what was found and what was expected.
pub fn parse_file(path: &FilePath) -> Result<Parsed> {
    let read = || -> Result<Vec<u8>> {
        let not_found = |error: std::io::Error| Error::new(ErrorKind::FileNotFound, format!("cannot open: {error}"));
        let metadata = std::fs::metadata(path).map_err(not_found)?;
        if !metadata.is_file() {
            return Err(Error::new(ErrorKind::FileNotFound, "not a regular file; expected a scene in JSON"));
        }
        json::check_size(metadata.len())?;
        json::read_limited(File::open(path).map_err(not_found)?)
    };
    parse_bytes(&read().map_err(|error| error.in_file(path))?, path)
}

/// Reads a scene from a stream such as stdin; `file` stands for it in messages, its folder is that of relative paths.
pub fn parse_reader(reader: impl Read, file: &FilePath) -> Result<Parsed> {
    parse_bytes(&json::read_limited(reader).map_err(|error| error.in_file(file))?, file)
}

/// Parses a scene; `file` is where the text is from, its folder is that of relative paths.
pub fn parse_str(text: &str, file: &FilePath) -> Result<Parsed> {
    parse_bytes(text.as_bytes(), file)
}

/// Like [`parse_str`], of bytes that need not be UTF-8.
pub fn parse_bytes(bytes: &[u8], file: &FilePath) -> Result<Parsed> {
    let parsed = json::parse(bytes).and_then(|json| decode(&json, file));
    parsed.map_err(|error| error.in_file(file))
}

fn decode(json: &Json, file: &FilePath) -> Result<Parsed> {
    check_version(json)?;
    let folder = file.parent().map(FilePath::to_owned).unwrap_or_default();
    let context = Context { folder, ..Context::default() };
    let mut description = SCENE.read(&Value { json, path: &Path::Root, context: &context })?;
    file.clone_into(&mut description.file);
    let warnings = warnings(&description, &context);
    Ok(Parsed { description, warnings })
}

/// Scenes of another version are refused before anything else in them is judged.
fn check_version(json: &Json) -> Result<()> {
    match json.get("abbe").and_then(Json::as_integer) {
        Some(version) if version != VERSION => {
            let message = format!("this is a scene of version {version}; expected version {VERSION}");
            Err(error(ErrorKind::Version, &Path::Key(&Path::Root, "abbe"), message))
        }
        _ => Ok(()),
    }
}

/// Everything that deserves a look, with the file's name in front.
fn warnings(scene: &SceneDescription, context: &Context) -> Vec<String> {
    let mut warnings = context.warnings.take();
    let (materials, spectra) = (context.materials.borrow(), context.spectra.borrow());
    warnings.extend(materials.unused().map(|i| format!("{}: no object has this material", scene.materials[i].1.at)));
    warnings.extend(spectra.unused().map(|i| format!("{}: nothing uses this spectrum", scene.spectra[i].1.at)));
    let dark = scene.objects.iter().filter(|object| object.emission_two_sided && object.emission.is_none());
    warnings.extend(dark.map(|object| format!("{}: `emission_two_sided` without `emission`", object.at)));
    let more = warnings.len().saturating_sub(MAX_WARNINGS);
    warnings.truncate(MAX_WARNINGS);
    if more > 0 {
        warnings.push(format!("and {more} more warnings"));
    }
    warnings.iter().map(|warning| format!("{}: {warning}", scene.file.display())).collect()
}
