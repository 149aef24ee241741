//! What one boundary does to light.

pub(crate) mod bend;
pub mod interface;
pub(crate) mod mueller;
