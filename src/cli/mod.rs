//! Command line: one file a subcommand; the only place that prints, shows progress or exits.

mod bench;
mod compare;
mod completions;
mod export;
mod glass;
mod heat;
mod names;
mod plot;
mod process;
mod render;
mod scene;
mod spectrum;
mod swatch;
mod upsample;
mod values;

use crate::{Error, ErrorKind, Result};
use clap::{CommandFactory, Parser, Subcommand};
use std::io::Write;
use std::process::ExitCode;

/// Exit code of a render that was interrupted after it had written what it had.
const INTERRUPTED: u8 = 75;
/// Exit code of a comparison over its threshold.
const OVER_THRESHOLD: u8 = 4;

/// A spectral renderer and colour library.
#[derive(Debug, Parser)]
#[command(name = "abbe", version, about, arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Render a scene to EXR and PNG
    Render(Box<render::RenderArgs>),
    /// Check scenes, write them for other renderers, or print the format: schema or reference
    Scene(scene::SceneArgs),
    /// Print the glass catalogue, or the index of refraction of one of its entries
    Glass(glass::GlassArgs),
    /// Compare two EXR pictures, of abbe or any renderer
    Compare(compare::CompareArgs),
    /// Run time against error: integrators, settings and other renderers on the same scenes
    Bench(Box<bench::BenchArgs>),
    /// Print the colour of spectra from a file
    Spectrum(Box<spectrum::SpectrumArgs>),
    /// Make a spectrum of an RGB colour
    Upsample(Box<upsample::UpsampleArgs>),
    /// Print completions for a shell
    Completions(completions::CompletionsArgs),
}

/// Runs the command line of the process: parses, runs, prints the one error, returns the exit code.
pub fn main() -> ExitCode {
    if let Some(missing) = process::missing_processor_feature() {
        eprintln!(
            "this build of abbe needs a processor with {missing}; build it without .cargo/config.toml for this one"
        );
        return ExitCode::FAILURE;
    }
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return refuse(&error),
    };
    match run(&cli.command) {
        Ok(code) => code,
        Err(error) => {
            // If stderr is closed there is nobody to tell.
            let _ = writeln!(std::io::stderr(), "{error}");
            ExitCode::from(exit_code(error.kind))
        }
    }
}

/// Exit code of an error: 1 failed, 2 usage, 3 bad input.
fn exit_code(kind: ErrorKind) -> u8 {
    match kind {
        ErrorKind::Usage => 2,
        ErrorKind::Io => 1,
        _ => 3,
    }
}

/// Help and version are data; anything else is a usage error, told in one line.
fn refuse(error: &clap::Error) -> ExitCode {
    if !error.use_stderr() || error.kind() == clap::error::ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        // If the stream is closed there is nobody to tell.
        let _ = error.print();
    } else {
        let _ = writeln!(std::io::stderr(), "{}", one_line(&error.to_string()));
    }
    ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2))
}

/// The message of a parser's error without its usage and advice to ask for help.
fn one_line(text: &str) -> String {
    // Lists that are longer than this do not help: the nearest name does.
    const LONGEST_LIST: usize = 240;
    let lines =
        text.lines().map(str::trim).take_while(|line| !line.starts_with("Usage:") && !line.starts_with("For more"));
    let mut message = String::new();
    let helps = |line: &&str| !(line.is_empty() || line.starts_with("tip: to pass") || line.len() > LONGEST_LIST);
    for line in lines.filter(helps) {
        let joint = if line.starts_with(['[', 't']) { "; " } else { " " };
        message += if message.is_empty() { "" } else { joint };
        message += line.strip_prefix("error: ").unwrap_or(line);
    }
    message
}

fn run(command: &Command) -> Result<ExitCode> {
    let done = |result: Result<()>| result.map(|()| ExitCode::SUCCESS);
    match command {
        Command::Render(args) => render::run(args),
        Command::Scene(args) => done(scene::run(args, &mut std::io::stdout().lock(), &mut std::io::stderr().lock())),
        Command::Glass(args) => done(glass::run(args)),
        Command::Compare(args) => compare::run(args),
        Command::Bench(args) => bench::run(args),
        Command::Spectrum(args) => done(spectrum::run(args)),
        Command::Upsample(args) => done(upsample::run(args)),
        Command::Completions(args) => done(completions::run(args, Cli::command())),
    }
}

/// Writes data to stdout. A reader that has seen enough, as in `abbe glass | head`, is no error.
fn write_data(out: &mut dyn Write, bytes: &[u8]) -> Result<()> {
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Err(e) if e.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        result => result.map_err(|e| Error::new(ErrorKind::Io, format!("writing to stdout failed: {e}"))),
    }
}

fn usage(message: impl Into<String>) -> Error {
    Error::new(ErrorKind::Usage, message)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn usage_errors_are_one_line() {
        let message = |args: &[&str]| one_line(&Cli::try_parse_from(args).unwrap_err().to_string());
        assert_eq!(
            message(&["abbe", "glass", "--att", "5"]),
            "unexpected argument '--att' found; tip: a similar argument exists: '--at'"
        );
        assert_eq!(message(&["abbe", "glass", "--colour"]), "unexpected argument '--colour' found");
        assert_eq!(message(&["abbe", "render"]), "the following required arguments were not provided: <SCENE>");
        let kinds = message(&["abbe", "spectrum", "a.csv", "--as", "emision"]);
        let expected = "invalid value 'emision' for '--as <KIND>'; [possible values: emission, reflectance, transmittance]; \
            tip: a similar value exists: 'emission'";
        assert_eq!(kinds, expected);
        let space = message(&["abbe", "spectrum", "a.csv", "--space", "rec202"]);
        assert!(
            space.starts_with("invalid value 'rec202' for '--space <NAME>'; tip: ") && space.len() < 200,
            "{space}"
        );
    }

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }
}
