//! Placeholder.
pub fn read() {}
