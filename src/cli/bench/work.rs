//! A scene to render many times.

use crate::cli::values::resolution as parse_resolution;
use crate::scene::description;
use crate::scene::{Compiled, compile};
use crate::{Error, ErrorKind, Result, sampling};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// A compiled scene with what the benchmark has to know of it.
pub struct Work {
    /// The file's name without its extension.
    pub name: String,
    /// The scene.
    pub compiled: Compiled,
    /// Wall time of compiling the scene, seconds.
    pub compile_seconds: f64,
    /// Warnings of reading and compiling the scene, one line each.
    pub warnings: Vec<String>,
    /// Hash of the scene file and of all files that it names.
    pub content_hash: u64,
}

impl Work {
    /// Reads and compiles a scene, at another resolution if one is given.
    pub fn new(path: &Path, resolution: Option<&str>) -> Result<Self> {
        let parsed = description::parse_file(path)?;
        let (mut description, mut warnings) = (parsed.description, parsed.warnings);
        if let Some(text) = resolution {
            (description.film.width, description.film.height) = parse_resolution(text)?;
        }
        let started = Instant::now();
        let compiled = compile(&description)?;
        let compile_seconds = started.elapsed().as_secs_f64();
        warnings.extend_from_slice(&compiled.warnings);
        let name = path.file_stem().map_or_else(|| "scene".into(), |stem| stem.to_string_lossy().into_owned());
        let content_hash = content_hash(path)?;
        Ok(Self { name, compiled, compile_seconds, warnings, content_hash })
    }

    /// Width and height.
    pub fn size(&self) -> [u32; 2] {
        [self.compiled.film.width, self.compiled.film.height]
    }

    /// Whether there is anything that gathers light into caustics.
    pub fn has_specular(&self) -> bool {
        self.compiled.scene.objects.iter().any(|object| object.material.focuses())
    }
}

/// Hash of a scene file's bytes and of those of every file named in it.
fn content_hash(path: &Path) -> Result<u64> {
    let failed = |e: std::io::Error| Error::new(ErrorKind::FileNotFound, format!("cannot be read: {e}")).in_file(path);
    let bytes = std::fs::read(path).map_err(failed)?;
    let mut hash = hash_bytes(0, &bytes);
    let mut named = Vec::new();
    if let Ok(value) = serde_json::from_slice(&bytes) {
        named_files(&value, path.parent().unwrap_or(Path::new("")), &mut named);
    }
    for file in named {
        hash = hash_bytes(hash, &std::fs::read(file).unwrap_or_default());
    }
    Ok(hash)
}

fn named_files(value: &serde_json::Value, folder: &Path, files: &mut Vec<PathBuf>) {
    match value {
        serde_json::Value::Object(map) => {
            for (key, value) in map {
                match value.as_str().filter(|_| key == "file") {
                    Some(name) => files.push(folder.join(name)),
                    None => named_files(value, folder, files),
                }
            }
        }
        serde_json::Value::Array(list) => list.iter().for_each(|value| named_files(value, folder, files)),
        _ => {}
    }
}

/// Hash of bytes and what came before them.
pub fn hash_bytes(start: u64, bytes: &[u8]) -> u64 {
    let start = sampling::mix(start ^ bytes.len() as u64);
    bytes.chunks(8).fold(start, |hash, chunk| {
        let mut word = [0; 8];
        word[..chunk.len()].copy_from_slice(chunk);
        sampling::mix(hash ^ u64::from_le_bytes(word))
    })
}
