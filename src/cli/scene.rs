//! `abbe scene check|schema|reference|export`: checks scene files and prints their JSON Schema and reference.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use serde_json::{Value, json};

use super::{export, write_data};
use crate::scene::compile;
use crate::scene::description::{self, Parsed};
use crate::{Error, ErrorKind, Result};

/// `abbe scene …`.
#[derive(Debug, Args)]
pub struct SceneArgs {
    /// What to do.
    #[command(subcommand)]
    pub command: SceneCommand,
}

/// The subcommands of `abbe scene`.
#[derive(Debug, Subcommand)]
pub enum SceneCommand {
    /// Check scene files; `-` is stdin
    Check(CheckArgs),
    /// Print the JSON Schema of scene files
    Schema,
    /// Print every key of scene files with its meaning, as Markdown
    Reference,
    /// Write a scene for another renderer
    Export(export::ExportArgs),
}

/// `abbe scene check SCENE...`.
#[derive(Debug, Args)]
pub struct CheckArgs {
    /// Scene files; `-` is stdin
    #[arg(required = true, value_name = "SCENE")]
    pub scenes: Vec<PathBuf>,
    /// Print one JSON object instead of lines
    #[arg(long)]
    pub json: bool,
    /// Print nothing but errors
    #[arg(short, long)]
    pub quiet: bool,
}

/// What `check` tells about a scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Summary {
    /// Objects with a shape.
    pub objects: usize,
    /// Materials.
    pub materials: usize,
    /// Named spectra.
    pub spectra: usize,
    /// Lights without a shape.
    pub lights: usize,
    /// One line each.
    pub warnings: Vec<String>,
}

/// Runs `abbe scene`: data to `out`, warnings and all errors but the last to `err`; the last error is returned.
pub fn run(args: &SceneArgs, out: &mut dyn Write, err: &mut dyn Write) -> Result<()> {
    match &args.command {
        SceneCommand::Check(args) => check(args, out, err),
        SceneCommand::Schema => {
            let text = serde_json::to_string_pretty(&description::schema()).map_err(|error| failed(&error))?;
            write_data(out, format!("{text}\n").as_bytes())
        }
        SceneCommand::Reference => write_data(out, description::reference().as_bytes()),
        SceneCommand::Export(args) => export::run(args, out),
    }
}

/// Parses and compiles one scene, so that the files, glasses and colours it names are looked up too; `-` is stdin.
pub fn check_one(path: &Path) -> Result<Summary> {
    let Parsed { description, mut warnings } = match path.as_os_str() == "-" {
        true => description::parse_reader(std::io::stdin().lock(), Path::new("<stdin>"))?,
        false => description::parse_file(path)?,
    };
    warnings.extend(compile(&description)?.warnings);
    Ok(Summary {
        objects: description.objects.len(),
        materials: description.materials.len(),
        spectra: description.spectra.len(),
        lights: description.lights.len(),
        warnings,
    })
}

fn check(args: &CheckArgs, out: &mut dyn Write, err: &mut dyn Write) -> Result<()> {
    let mut last_error: Option<Error> = None;
    let mut scenes = Vec::new();
    for path in &args.scenes {
        let checked = check_one(path);
        if args.json {
            scenes.push(report(path, &checked));
        }
        match checked {
            Ok(summary) => print(args, path, &summary, out, err)?,
            Err(error) => {
                if let Some(earlier) = last_error.replace(error) {
                    writeln!(err, "{earlier}").map_err(|error| failed(&error))?;
                }
            }
        }
    }
    if args.json {
        write_data(out, format!("{}\n", json!({ "scenes": scenes })).as_bytes())?;
    }
    last_error.map_or(Ok(()), Err)
}

fn print(args: &CheckArgs, path: &Path, summary: &Summary, out: &mut dyn Write, err: &mut dyn Write) -> Result<()> {
    if args.quiet {
        return Ok(());
    }
    for warning in &summary.warnings {
        writeln!(err, "warning: {warning}").map_err(|error| failed(&error))?;
    }
    if args.json {
        return Ok(());
    }
    let count = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
    let spectra =
        if summary.spectra == 1 { "1 named spectrum".into() } else { format!("{} named spectra", summary.spectra) };
    let line = format!(
        "{}: ok: {}, {}, {}, {spectra}\n",
        path.display(),
        count(summary.objects, "object"),
        count(summary.materials, "material"),
        count(summary.lights, "light")
    );
    write_data(out, line.as_bytes())
}

/// One scene's result as JSON.
fn report(path: &Path, checked: &Result<Summary>) -> Value {
    match checked {
        Ok(summary) => json!({
            "file": path.display().to_string(),
            "ok": true,
            "objects": summary.objects,
            "materials": summary.materials,
            "lights": summary.lights,
            "spectra": summary.spectra,
            "warnings": summary.warnings,
        }),
        Err(error) => json!({
            "file": path.display().to_string(),
            "ok": false,
            "error": {
                "code": error.kind.code(),
                "json_path": error.place,
                "message": error.message,
                "nearest": error.nearest,
            },
        }),
    }
}

fn failed(error: &dyn std::fmt::Display) -> Error {
    Error::new(ErrorKind::Io, format!("writing failed: {error}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Command {
        #[command(flatten)]
        scene: SceneArgs,
    }

    const GOOD: &str = r#"{"camera": {"type": "perspective", "from": [0, 0, 1], "to": [0, 0, 0]},
        "film": {"width": 4, "height": 4}, "spectra": {"a": 1, "b": 2}}"#;

    /// Runs `abbe scene ARGS` and returns stdout, stderr and the error.
    fn scene(args: &[&str]) -> (String, String, Option<Error>) {
        let args = Command::try_parse_from(["abbe"].iter().chain(args)).expect("valid arguments").scene;
        let (mut out, mut err) = (Vec::new(), Vec::new());
        let error = run(&args, &mut out, &mut err).err();
        (String::from_utf8(out).unwrap(), String::from_utf8(err).unwrap(), error)
    }

    fn file(name: &str, text: &str) -> String {
        let path = std::env::temp_dir().join(format!("abbe-{}-{name}", std::process::id()));
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    }

    #[test]
    fn checks_every_scene_and_returns_the_last_error() {
        let (good, bad) = (file("good.json", GOOD), file("bad.json", "{}"));
        let (out, err, error) = scene(&["check", &bad, &good, "/no/such/scene.json"]);
        assert_eq!(out, format!("{good}: ok: 0 objects, 0 materials, 0 lights, 2 named spectra\n"));
        assert!(err.contains(&format!("\n{bad}: missing key `camera`")), "{err}");
        assert!(err.contains("warning:") && err.contains("spectra.b: nothing uses"), "{err}");
        assert_eq!(error.unwrap().kind, ErrorKind::FileNotFound);

        let (out, err, error) = scene(&["check", "-q", "--json", &good, &bad]);
        let report: Value = serde_json::from_str(&out).unwrap();
        assert_eq!(report["scenes"][0]["spectra"], 2);
        assert_eq!(report["scenes"][1]["error"]["code"], "missing");
        assert!(err.is_empty() && error.is_some());
        for path in [good, bad] {
            std::fs::remove_file(path).unwrap();
        }
    }

    #[test]
    fn prints_the_schema() {
        let (out, _, error) = scene(&["schema"]);
        assert!(error.is_none() && serde_json::from_str::<Value>(&out).is_ok());
        assert!(Command::try_parse_from(["abbe", "check"]).is_err());
    }
}
