//! How long work shows that it goes on.

use crate::support::progress::{self, Form};

/// How progress is told, on standard error.
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct ProgressArgs {
    /// Tell on standard error how far the work is
    #[arg(long, value_name = "HOW", value_enum, default_value_t = Form::Bar)]
    progress: Form,
}

impl ProgressArgs {
    /// What this process tells from now on.
    pub(in crate::cli) fn choose(&self) {
        progress::choose(self.progress);
    }
}
