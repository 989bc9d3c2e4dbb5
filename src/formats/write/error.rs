//! Why a model could not be written.

use crate::formats::textures::FetchError;
use crate::quote;
use std::path::PathBuf;
use thiserror::Error;

/// A model that could not be encoded or written.
#[derive(Debug, Error)]
pub enum ExportError {
    /// The output file's name does not say a format.
    #[error("{}: {}; name the output with one of the extensions {}", .path.display(), unknown(.extension), .known.join(", "))]
    UnknownFormat {
        /// The output file.
        path: PathBuf,
        /// Its extension, if it has one.
        extension: Option<String>,
        /// Every extension that can be written.
        known: Vec<&'static str>,
    },
    /// There is no surface to write.
    #[error("the model has no surface, so there is nothing to write; draw a petal, a leaf or a branch first")]
    Empty,
    /// The model breaks its own rules: a mistake of whoever made it.
    #[error("the model is not sound: {0}")]
    Unsound(String),
    /// The format's 32-bit sizes do not reach.
    #[error("the model needs {bytes} bytes, more than the 4 GiB that a GLB file can hold; write it as OBJ")]
    TooLarge {
        /// Size of the file if it were written.
        bytes: u64,
    },
    /// A material names a texture that is not there or cannot be read.
    #[error("material `{}`: {fault}", quote::name(.material))]
    Texture {
        /// The material that wants it.
        material: String,
        /// Why it cannot be had.
        fault: FetchError,
    },
    /// A picture is in no format that model files can carry.
    #[error(
        "material `{}`: the picture {picture} is neither PNG nor JPEG; convert it to one of them", quote::name(.material)
    )]
    NotAPicture {
        /// The material that wants it.
        material: String,
        /// The picture.
        picture: String,
    },
    /// The structured part of the file could not be formed.
    #[error("cannot encode the model: {0}")]
    Json(#[from] serde_json::Error),
    /// A file would replace one that it is made from.
    #[error(transparent)]
    Overwrites(#[from] crate::input::Overwrites),
    /// The bytes could not be put on disk.
    #[error(transparent)]
    Write(#[from] crate::atomic::WriteError),
}

fn unknown(extension: &Option<String>) -> String {
    match extension {
        Some(extension) => format!("`{}` is no format that can be written", quote::name(extension)),
        None => "the name has no extension that tells the format".to_owned(),
    }
}
