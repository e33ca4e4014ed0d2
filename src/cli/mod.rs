//! Command line: one file a subcommand; the only place that prints, shows progress or exits.

pub mod bench;
pub mod compare;
pub mod export;
pub mod glass;
mod heat;
mod process;
pub mod render;
pub mod scene;

use crate::{Error, ErrorKind, Result};
use clap::{Parser, Subcommand};
use std::io::Write;
use std::process::ExitCode;

/// Exit code of a render that was interrupted after it had written what it had.
pub const INTERRUPTED: u8 = 75;
/// Exit code of a comparison over its threshold.
pub const OVER_THRESHOLD: u8 = 4;

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
    /// Check scenes, or print the JSON Schema of the scene format
    Scene(scene::SceneArgs),
    /// Print the glass catalogue, or the index of refraction of one of its entries
    Glass(glass::GlassArgs),
    /// What a scene needs and what is skipped (not yet)
    Explain(NotYet),
    /// Develop an EXR into a PNG (not yet)
    Develop(NotYet),
    /// Compare two EXR pictures, of abbe or any renderer
    Compare(compare::CompareArgs),
    /// Run time against error: integrators, settings and other renderers on the same scenes
    Bench(Box<bench::BenchArgs>),
    /// Colour of a spectrum (not yet)
    Spectrum(NotYet),
    /// Spectrum of a colour (not yet)
    Upsample(NotYet),
    /// Shell completions (not yet)
    Completions(NotYet),
}

/// Takes anything, as it is refused anyway.
#[derive(Debug, clap::Args)]
struct NotYet {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    arguments: Vec<String>,
}

/// Runs the command line of the process: parses, runs, prints the one error, returns the exit code.
pub fn main() -> ExitCode {
    if let Some(missing) = process::missing_processor_feature() {
        eprintln!(
            "this build of abbe needs a processor with {missing}; build it without .cargo/config.toml for this one"
        );
        return ExitCode::FAILURE;
    }
    let cli = Cli::parse();
    match run(&cli.command) {
        Ok(code) => code,
        Err(error) => {
            // If stderr is closed there is nobody to tell.
            let _ = writeln!(std::io::stderr(), "{error}");
            ExitCode::from(error.kind.exit_code())
        }
    }
}

fn run(command: &Command) -> Result<ExitCode> {
    let done = |result: Result<()>| result.map(|()| ExitCode::SUCCESS);
    match command {
        Command::Render(args) => render::run(args),
        Command::Scene(args) => done(scene::run(args, &mut std::io::stdout().lock(), &mut std::io::stderr().lock())),
        Command::Glass(args) => done(glass::run(args)),
        Command::Explain(args) => not_yet("explain", args),
        Command::Develop(args) => not_yet("develop", args),
        Command::Compare(args) => compare::run(args),
        Command::Bench(args) => bench::run(args),
        Command::Spectrum(args) => not_yet("spectrum", args),
        Command::Upsample(args) => not_yet("upsample", args),
        Command::Completions(args) => not_yet("completions", args),
    }
}

/// Writes data to stdout. A reader that has seen enough, as in `abbe glass | head`, is no error.
fn write_data(out: &mut dyn Write, bytes: &[u8]) -> Result<()> {
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Err(e) if e.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        result => result.map_err(|e| Error::new(ErrorKind::Io, format!("writing to stdout failed: {e}"))),
    }
}

fn not_yet(name: &str, args: &NotYet) -> Result<ExitCode> {
    let with = if args.arguments.is_empty() { "" } else { " (and its arguments)" };
    Err(Error::new(ErrorKind::Usage, format!("`abbe {name}`{with} is not there yet")))
}
