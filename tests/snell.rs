//! The command line, built for the tests that run it as its users do.

use std::process::ExitCode;

fn main() -> ExitCode {
    compare::cli::main()
}
