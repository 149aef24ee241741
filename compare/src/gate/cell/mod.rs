//! One cell: its truth, its base and head, and the questions that they raise.

pub mod head;
pub mod judge;
pub mod truth;
