//! Signs of life on standard error, only where a person is looking.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::Mutex;

/// A bar on the terminal; invisible when standard error is not one.
#[derive(Debug)]
pub struct Progress {
    bar: ProgressBar,
    done: Mutex<f64>,
}

const STEPS: f64 = 10_000.0;

impl Progress {
    /// A bar for a piece of work, at zero.
    ///
    /// # Panics
    /// Never: the template is a constant.
    #[must_use]
    pub fn new(work: &str) -> Self {
        // indicatif hides what is drawn to standard error when that is no terminal.
        let target = ProgressDrawTarget::stderr_with_hz(8);
        let bar = ProgressBar::with_draw_target(Some(STEPS as u64), target);
        #[expect(clippy::unwrap_used, reason = "the template is a constant")]
        let style =
            ProgressStyle::with_template("{elapsed:>4} {bar:24} {percent:>3} %  {msg}").unwrap();
        bar.set_style(style);
        bar.set_message(work.to_owned());
        Self { bar, done: Mutex::new(0.0) }
    }

    /// Names the piece of work that runs now.
    pub fn now(&self, work: &str) {
        self.bar.set_message(work.to_owned());
    }

    /// Share of the whole that is done, 0 to 1; it never runs backwards.
    pub fn at(&self, share: f64) {
        if let Ok(mut done) = self.done.lock() {
            *done = done.max(share);
            self.bar.set_position((*done * STEPS) as u64);
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
