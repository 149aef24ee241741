//! Results that need not be computed again.

mod store;

pub(crate) use store::hex;
pub use store::{Found, Store};
