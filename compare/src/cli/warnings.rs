//! Warnings: each is told once on standard error, and all are part of every
//! answer for programs.

use crate::Error;
use std::io::Write;
use std::sync::{Mutex, PoisonError};

/// What was warned of so far.
#[derive(Debug, Default)]
pub(super) struct Warnings {
    deny: bool,
    told: Mutex<Vec<String>>,
}

impl Warnings {
    /// None yet. `deny`: the first to come is an error.
    pub(super) fn new(deny: bool) -> Self {
        Self { deny, told: Mutex::default() }
    }

    /// All so far.
    pub(super) fn all(&self) -> Vec<String> {
        self.told.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Tells those that were not told before.
    ///
    /// # Errors
    /// If they are denied; all of `texts` have been told.
    pub(super) fn tell(&self, texts: impl IntoIterator<Item = String>) -> Result<(), Error> {
        let mut told = self.told.lock().unwrap_or_else(PoisonError::into_inner);
        let before = told.len();
        for text in texts {
            if !told.contains(&text) {
                // Nobody listens if standard error is closed.
                let _ = writeln!(std::io::stderr(), "warning: {}", text.replace('\n', "; "));
                told.push(text);
            }
        }
        match told.len() - before {
            count if self.deny && count > 0 => Err(Error::Warnings(count)),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_warning_is_told_once_and_kept() {
        let warnings = Warnings::new(false);
        for _ in 0..2 {
            assert!(warnings.tell(["a".to_owned(), "b".to_owned()]).is_ok());
        }
        assert_eq!(warnings.all(), ["a", "b"]);
    }

    #[test]
    fn what_is_denied_is_an_error() {
        let warnings = Warnings::new(true);
        assert!(warnings.tell([]).is_ok());
        assert!(matches!(warnings.tell(["a".to_owned()]), Err(Error::Warnings(1))));
    }
}
