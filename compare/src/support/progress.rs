//! Signs of life on standard error: a bar where a person is looking, or lines for a
//! program.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde::Serialize;
use std::io::Write;
use std::sync::{Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

/// How progress is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Form {
    /// A bar, if standard error is a terminal
    Bar,
    /// One JSON object a line, eight in a second at most: what is done, and what share of all
    Json,
    /// Nothing
    None,
}

/// Schema of a line.
const SCHEMA: &str = "snell.progress/1";
const STEPS: f64 = 10_000.0;
/// Least time between two lines about one piece of work.
const PAUSE: Duration = Duration::from_millis(125);

static FORM: OnceLock<Form> = OnceLock::new();

/// Chooses how this process tells its progress; only the first choice counts.
pub fn choose(form: Form) {
    FORM.get_or_init(|| form);
}

/// What is told of a piece of work.
#[derive(Debug)]
pub struct Progress {
    form: Form,
    bar: ProgressBar,
    start: Instant,
    state: Mutex<State>,
}

#[derive(Debug)]
struct State {
    work: String,
    done: f64,
    last: Option<Instant>,
}

/// A line for programs.
#[derive(Serialize)]
struct Line<'a> {
    schema: &'a str,
    /// The piece of work that runs now.
    work: &'a str,
    /// Share of the whole that is done, 0 to 1.
    share: f64,
    elapsed_s: f64,
}

impl Progress {
    /// Begins a piece of work.
    ///
    /// # Panics
    /// Never: the template is a constant.
    #[must_use]
    pub fn new(work: &str) -> Self {
        let form = *FORM.get().unwrap_or(&Form::Bar);
        // indicatif hides what is drawn to standard error when that is no terminal.
        let target = match form {
            Form::Bar => ProgressDrawTarget::stderr_with_hz(8),
            Form::Json | Form::None => ProgressDrawTarget::hidden(),
        };
        let bar = ProgressBar::with_draw_target(Some(STEPS as u64), target);
        #[expect(clippy::unwrap_used, reason = "the template is a constant")]
        let style =
            ProgressStyle::with_template("{elapsed:>4} {bar:24} {percent:>3} %  {msg}").unwrap();
        bar.set_style(style);
        bar.set_message(work.to_owned());
        let state = Mutex::new(State { work: work.to_owned(), done: 0.0, last: None });
        Self { form, bar, start: Instant::now(), state }
    }

    /// Names the piece of work that runs now.
    pub fn now(&self, work: &str) {
        self.bar.set_message(work.to_owned());
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        if state.work != work {
            (state.work, state.last) = (work.to_owned(), None);
        }
        self.tell(&mut state);
    }

    /// Share of the whole that is done, 0 to 1; it never runs backwards.
    pub fn at(&self, share: f64) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        state.done = state.done.max(share.min(1.0));
        self.bar.set_position((state.done * STEPS) as u64);
        self.tell(&mut state);
    }

    fn tell(&self, state: &mut State) {
        if self.form != Form::Json || state.last.is_some_and(|last| last.elapsed() < PAUSE) {
            return;
        }
        state.last = Some(Instant::now());
        let elapsed_s = self.start.elapsed().as_secs_f64();
        let line = Line { schema: SCHEMA, work: &state.work, share: state.done, elapsed_s };
        if let Ok(text) = serde_json::to_string(&line) {
            // Nobody listens if standard error is closed.
            let _ = writeln!(std::io::stderr(), "{text}");
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
