//! Model files as they are meant to be seen: every surface in its place, with its material and picture.
//!
//! [`read`](super::read()) is for the judge, who wants meshes as the file defines them; here the nodes of a GLB file put
//! them where they belong, and what a file says of colour, picture, cut-out and sidedness becomes a
//! [`Material`](crate::plant::Material). A picture that is missing or damaged is a warning: the surface is shown in its plain colour.

use super::error::ReadError;
use super::file::{self, ReadFormat};
use super::loaded::Loaded;
use super::{glb_model, obj_model};
use std::path::Path;

/// Reads a model file to be looked at.
///
/// # Errors
/// [`ReadError`], naming the file and, inside it, the place.
pub fn load(path: &Path) -> Result<Loaded, ReadError> {
    let (format, bytes) = file::read(path)?;
    let loaded = match format {
        ReadFormat::Obj => obj_model::load(&bytes, path.parent().unwrap_or(Path::new(""))),
        ReadFormat::Glb => glb_model::load(&bytes),
    };
    loaded.map_err(|malformed| ReadError::Malformed { path: path.to_owned(), malformed })
}
