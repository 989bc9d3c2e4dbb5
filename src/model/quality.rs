//! Mesh quality report.
