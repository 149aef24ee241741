//! `snell`.
fn main() {}
