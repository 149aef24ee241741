//! How a check is told: to people, to JUnit readers, to GitHub, as images.

pub mod command;
pub mod github;
pub mod junit;
pub mod table;
pub mod triple;
