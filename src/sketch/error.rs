//! Why a drawing could not be read.

use thiserror::Error;

/// A drawing that cannot be read: what is wrong, where, and what to do.
#[derive(Debug, Error)]
pub enum SketchError {}
