//! The `abbe` command.

fn main() -> std::process::ExitCode {
    abbe::cli::main()
}
