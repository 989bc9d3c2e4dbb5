//! Placeholder.
pub fn read(){}
