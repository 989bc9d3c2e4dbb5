//! Models read back from OBJ and GLB files.
//!
//! [`read`] gives the surfaces as the file defines them, for [`quality`](crate::model::quality); [`load`] gives them in
//! their places and with their materials, to be looked at. Total: any bytes end in surfaces or in a message that names file, place and reason; memory and time stay in
//! proportion to the file, whatever its counts claim.

mod glb_container;
mod glb_model;
mod glb_surfaces;
mod gltf_accessor;
pub mod model;
mod obj_model;
mod obj_surfaces;

pub use model::{Embedded, Loaded, load};

use crate::model::Mesh;
use crate::model::quality::Attributes;
use crate::{input, quote};
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Largest model file that is read, in bytes.
pub const MAX_FILE_BYTES: u64 = 1 << 30;

/// A connected space of points: one mesh of a GLB file, everything in an OBJ file.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// The mesh's name, empty for an OBJ file.
    pub name: String,
    /// The surface; indices are as the file says and may be out of range.
    pub mesh: Mesh,
    /// What the file gives for every vertex; the rest is zero in `mesh`.
    pub has: Attributes,
}

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
    fn new(place: impl Into<String>, reason: impl Into<String>) -> Self {
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

/// A format that models are read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReadFormat {
    /// Wavefront OBJ.
    Obj,
    /// Binary glTF 2.0.
    Glb,
}

impl ReadFormat {
    /// The format that an extension stands for, in upper or lower case.
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_lowercase().as_str() {
            "obj" => Some(Self::Obj),
            "glb" => Some(Self::Glb),
            _ => None,
        }
    }
}

/// Reads a model file.
///
/// # Errors
/// [`ReadError`], naming the file and, inside it, the place.
pub fn read(path: &Path) -> Result<Vec<Surface>, ReadError> {
    let (format, bytes) = file(path)?;
    from_bytes(format, &bytes).map_err(|malformed| ReadError::Malformed { path: path.to_owned(), malformed })
}

/// A model file's format and contents.
fn file(path: &Path) -> Result<(ReadFormat, Vec<u8>), ReadError> {
    let format = ReadFormat::of(path).ok_or_else(|| ReadError::UnknownFormat(path.to_owned()))?;
    let failed = |source: io::Error| match source.kind() {
        io::ErrorKind::FileTooLarge => ReadError::TooLarge(path.to_owned()),
        _ => ReadError::Io { path: path.to_owned(), source },
    };
    let bytes = input::read(path, MAX_FILE_BYTES).map_err(failed)?;
    Ok((format, bytes))
}

/// Reads a model from memory.
///
/// # Errors
/// [`Malformed`], naming the place.
pub fn from_bytes(format: ReadFormat, bytes: &[u8]) -> Result<Vec<Surface>, Malformed> {
    match format {
        ReadFormat::Obj => obj_surfaces::surfaces(bytes),
        ReadFormat::Glb => glb_surfaces::surfaces(bytes),
    }
}
