//! `abbe scene export`: a scene for another renderer, so that both can be timed on the same work.
//!
//! What the other program cannot express is refused, not approximated. Meshes go as PLY beside the file, in world space;
//! spectra go as tables over 360–830 nm.

mod mitsuba;
mod parts;
mod pbrt;

use super::write_data;
use crate::io::output::write_atomically;
use crate::scene::compile;
use crate::scene::description;
use crate::{Error, ErrorKind, Result};
use clap::ValueEnum;
use parts::Parts;
use std::path::{Path, PathBuf};

/// `abbe scene export …`.
#[derive(Debug, Clone, clap::Args)]
pub struct ExportArgs {
    /// Scene file
    #[arg(value_name = "SCENE")]
    pub scene: PathBuf,
    /// Renderer to write for
    #[arg(long, value_enum)]
    pub format: Format,
    /// File to write; meshes are put beside it
    #[arg(short, long = "output", value_name = "FILE")]
    pub output: PathBuf,
    /// Wavelength in nm at which indices that depend on it are taken, for all wavelengths
    #[arg(long, value_name = "NM")]
    pub at: Option<f64>,
    /// Print nothing
    #[arg(short, long)]
    pub quiet: bool,
}

/// Formats of other renderers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Mitsuba 3 XML, for its spectral variants
    Mitsuba,
    /// pbrt-v4
    Pbrt,
}

/// Exports a scene, and tells what was written.
///
/// # Errors
/// Those of scene files; `Unsupported` for what the format cannot express, with its place in the scene; `Usage`; `Io`.
pub fn run(args: &ExportArgs, out: &mut dyn std::io::Write) -> Result<()> {
    if let Some(nm) = args.at.filter(|nm| !(360.0..=830.0).contains(nm)) {
        return Err(Error::new(ErrorKind::Usage, format!("--at {nm}: expected a wavelength in [360, 830] nm")));
    }
    let parsed = description::parse_file(&args.scene)?;
    let compiled = compile(&parsed.description)?;
    if args.output.as_os_str() == "-" {
        return Err(Error::new(ErrorKind::Usage, "-o -: expected the name of a file, as meshes are put beside it"));
    }
    let stem = args.output.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let stem = stem.ok_or_else(|| Error::new(ErrorKind::Usage, "-o: expected the name of a file"))?;
    let write = || -> Result<(String, Parts)> {
        let parts = Parts::new(&parsed.description, &compiled, &stem, args.at)?;
        let text = match args.format {
            Format::Mitsuba => mitsuba::text(&parts)?,
            Format::Pbrt => pbrt::text(&parts)?,
        };
        Ok((text, parts))
    };
    let (text, parts) = write().map_err(|error| error.in_file(&args.scene))?;
    let folder = args.output.parent().unwrap_or(Path::new(""));
    for (name, bytes) in &parts.meshes {
        write_atomically(&folder.join(name), bytes)?;
    }
    write_atomically(&args.output, text.as_bytes())?;
    if args.quiet {
        return Ok(());
    }
    let told = format!("{}: {} objects, {} meshes\n", args.output.display(), parts.objects.len(), parts.meshes.len());
    write_data(out, told.as_bytes())
}

/// What a format cannot express.
fn cannot(format: &str, what: &str, place: &str) -> Error {
    Error::new(ErrorKind::Unsupported, format!("{what} cannot be written for {format}")).at(place)
}

#[cfg(test)]
mod tests;
