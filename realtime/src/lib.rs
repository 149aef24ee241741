//! The approximations.
