//! Arguments that several commands share.

pub(super) mod adapter;
pub(super) mod cache;
pub(super) mod exact;
pub(super) mod external;
pub(super) mod progress;
pub(super) mod scene;
pub(super) mod study;
pub(super) mod values;
pub(super) mod view;
