//! The exact answer.
