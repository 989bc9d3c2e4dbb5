//! What keeps a model from being read.

use crate::quote;
use std::io;
use std::path::PathBuf;
use thiserror::Error;

/// Largest model file that is read, in bytes.
pub const MAX_FILE_BYTES: u64 = 1 << 30;

/// What is wrong with the contents of a file.
#[derive(Debug, Error, PartialEq)]
#[error("{place}: {reason}")]
pub struct Malformed {
    /// Where: a line, an accessor, a mesh.
    pub place: String,
    /// What and why.
    pub reason: String,
}

impl Malformed {
    pub(super) fn new(place: impl Into<String>, reason: impl Into<String>) -> Self {
        Self { place: quote::name(&place.into()), reason: quote::message(&reason.into()) }
    }
}

/// A model that could not be read.
#[derive(Debug, Error)]
pub enum ReadError {
    /// The file's name promises no model.
    #[error("{}: models are read from .obj and .glb files only", .0.display())]
    UnknownFormat(PathBuf),
    /// The system refuses.
    #[error("{}: cannot read it: {source}", .path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Too large to be taken into memory.
    #[error("{}: larger than the {} MiB that are read", .0.display(), MAX_FILE_BYTES >> 20)]
    TooLarge(PathBuf),
    /// The contents are damaged or of a kind that is not read.
    #[error("{}: {malformed}", .path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        malformed: Malformed,
    },
}
