//! Which files models are read from, and their bytes.

use super::error::{MAX_FILE_BYTES, ReadError};
use crate::input;
use std::io;
use std::path::Path;

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

/// A model file's format and contents.
///
/// # Errors
/// [`ReadError`], naming the file.
pub(super) fn read(path: &Path) -> Result<(ReadFormat, Vec<u8>), ReadError> {
    let format = ReadFormat::of(path).ok_or_else(|| ReadError::UnknownFormat(path.to_owned()))?;
    let failed = |source: io::Error| match source.kind() {
        io::ErrorKind::FileTooLarge => ReadError::TooLarge(path.to_owned()),
        _ => ReadError::Io { path: path.to_owned(), source },
    };
    let bytes = input::read(path, MAX_FILE_BYTES).map_err(failed)?;
    Ok((format, bytes))
}
