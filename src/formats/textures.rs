//! The files of a material's textures: built in, on disk, or kept with the drawing. What they hold is not looked at.

use crate::plant::{Material, Texture};
use std::borrow::Cow;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Largest picture that is taken from a user, in bytes.
pub const MAX_PICTURE_BYTES: u64 = 256 << 20;

/// Serves the program's own textures by file name; `None` where there is none of that name.
pub type BuiltInTextures<'a> = dyn Fn(&str) -> Option<Cow<'static, [u8]>> + 'a;

/// A texture whose file is not to be had.
#[derive(Debug, Error)]
pub enum FetchError {
    /// The program has no texture of that name.
    #[error("there is no built-in texture `{}`", crate::quote::name(.0))]
    NotBuiltIn(String),
    /// A user's picture could not be read.
    #[error("cannot read the picture {}: {cause}", .path.display())]
    Unreadable {
        /// The picture.
        path: PathBuf,
        /// What the system says; part of the message, so not a source of its own.
        cause: io::Error,
    },
}

/// The users' own pictures that materials name.
pub fn files(materials: &[Material]) -> impl Iterator<Item = &Path> {
    materials.iter().filter_map(|material| match &material.texture {
        Some(Texture::File(path)) => Some(path.as_path()),
        _ => None,
    })
}

/// The file of a texture, whatever it holds.
///
/// # Errors
/// A name that is not built in; a file that cannot be read or is larger than [`MAX_PICTURE_BYTES`].
pub fn fetch(texture: &Texture, built_in: &BuiltInTextures<'_>) -> Result<Cow<'static, [u8]>, FetchError> {
    match texture {
        Texture::BuiltIn(name) => built_in(name).ok_or_else(|| FetchError::NotBuiltIn(name.clone())),
        Texture::File(path) => match crate::input::read(path, MAX_PICTURE_BYTES) {
            Ok(bytes) => Ok(bytes.into()),
            Err(cause) => Err(FetchError::Unreadable { path: path.clone(), cause }),
        },
        Texture::Own(picture) => Ok(picture.bytes().to_vec().into()),
    }
}
