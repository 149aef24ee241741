//! `snell`: how wrong is real-time refraction, and what does it cost?

use std::process::ExitCode;

fn main() -> ExitCode {
    compare::cli::main()
}
