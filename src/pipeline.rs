//! From a sketch to a model: every stage in a row.
