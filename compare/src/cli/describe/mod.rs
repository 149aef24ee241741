//! Commands that answer without an image: what there is, and what would run.

pub(super) mod adapters;
pub(super) mod export;
pub(super) mod mesh;
pub(super) mod methods;
pub(super) mod plan;
pub(super) mod scenes;
pub(super) mod schema;
pub(super) mod shell;
