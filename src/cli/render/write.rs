//! Writes the pictures of a render.

use super::{Format, RenderArgs, extension, is_stdout};
use crate::cli::write_data;
use crate::film::Film;
use crate::io::exr::Attributes;
use crate::io::output::write_atomically;
use crate::io::{exr, png};
use crate::render::{Rendering, Statistics};
use crate::scene::Compiled;
use crate::{DevelopSettings, Result};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// What is to be written of a render.
pub struct Written<'a> {
    /// The command line.
    pub args: &'a RenderArgs,
    /// The files.
    pub outputs: &'a [PathBuf],
    /// The scene's file.
    pub file: &'a Path,
    /// How PNGs are developed.
    pub develop: DevelopSettings,
    /// The scene as it was rendered.
    pub compiled: &'a Compiled,
    /// What reading and compiling took.
    pub compiling: Duration,
}

impl Written<'_> {
    /// Writes the files. `seconds` is the wall time of the render.
    pub fn write(&self, rendering: &Rendering, seconds: f64) -> Result<()> {
        for path in self.outputs {
            let bytes = match extension(path) {
                Some(Format::Exr) => self.exr(path, &rendering.film, &rendering.statistics, seconds)?,
                Some(Format::Png) | None => self.png(&rendering.film)?,
            };
            match is_stdout(path) {
                true => write_data(&mut std::io::stdout().lock(), &bytes)?,
                false => write_atomically(path, &bytes)?,
            }
        }
        Ok(())
    }

    fn exr(&self, path: &Path, film: &Film, statistics: &Statistics, seconds: f64) -> Result<Vec<u8>> {
        let attributes = Attributes {
            scene_hash: scene_hash(self.file),
            seed: self.compiled.render.seed,
            samples_per_pixel: statistics.samples,
            seconds,
            observer: self.compiled.film.sensor.name(),
        };
        let (bytes, overflows) = exr::encode(film, &attributes)?;
        if overflows > 0 {
            eprintln!("warning: {}: {overflows} values were too large for 32 bits", path.display());
        }
        Ok(bytes)
    }

    fn png(&self, film: &Film) -> Result<Vec<u8>> {
        let picture = film.develop(&self.develop);
        if self.args.verbose {
            let outside = picture.out_of_gamut * 100.0;
            eprintln!("developed at {:+.2} EV; {outside:.2} % of the pixels were outside sRGB", picture.exposure_ev);
        }
        png::encode(&picture)
    }
}

/// Hash of the scene file's bytes; 0 for a scene that is no file.
fn scene_hash(path: &Path) -> u64 {
    let bytes = std::fs::read(path).unwrap_or_default();
    bytes.chunks(8).fold(0, |hash, chunk| {
        let mut word = [0; 8];
        word[..chunk.len()].copy_from_slice(chunk);
        crate::sampling::mix(hash ^ u64::from_le_bytes(word))
    })
}
