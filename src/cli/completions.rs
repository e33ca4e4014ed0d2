//! `abbe completions SHELL`: a script that completes commands, flags and their values.

use super::write_data;
use crate::Result;
use clap_complete::Shell;

/// Arguments of `abbe completions`.
#[derive(Debug, Clone, clap::Args)]
pub struct CompletionsArgs {
    /// The shell to complete in
    pub shell: Shell,
}

/// Prints the script for a command to stdout.
///
/// # Errors
/// `Io`.
pub fn run(args: &CompletionsArgs, mut command: clap::Command) -> Result<()> {
    let mut script = Vec::new();
    let name = command.get_name().to_owned();
    clap_complete::generate(args.shell, &mut command, name, &mut script);
    write_data(&mut std::io::stdout().lock(), &script)
}
