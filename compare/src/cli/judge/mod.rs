//! Commands that set one thing beside another.

pub(super) mod bench;
pub(super) mod compare;
pub(super) mod report;
pub(super) mod study;
