//! Command line: one file a subcommand; the only place that prints, shows progress or exits.

pub mod glass;
pub mod scene;

use std::process::ExitCode;

/// Runs the command line.
pub fn main() -> ExitCode {
    ExitCode::SUCCESS
}
