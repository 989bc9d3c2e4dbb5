//! Models read back from OBJ and GLB files.
//!
//! [`read`] gives the surfaces as the file defines them, for [`quality`](crate::model::quality); [`load`] gives them in
//! their places and with their materials, to be looked at. Total: any bytes end in surfaces or in a message that names
//! file, place and reason; memory and time stay in proportion to the file, whatever its counts claim, or to a large plant
//! where a file says little but shows it often.

mod error;
mod file;
mod glb_container;
mod glb_model;
mod glb_nodes;
mod glb_surfaces;
mod gltf_accessor;
mod loaded;
pub mod model;
mod obj_model;
mod obj_surfaces;
mod surface;

pub use error::{MAX_FILE_BYTES, Malformed, ReadError};
pub use file::ReadFormat;
pub use loaded::{Embedded, Loaded};
pub use model::load;
pub use surface::Surface;

use std::path::Path;

/// Reads a model file.
///
/// # Errors
/// [`ReadError`], naming the file and, inside it, the place.
pub fn read(path: &Path) -> Result<Vec<Surface>, ReadError> {
    let (format, bytes) = file::read(path)?;
    from_bytes(format, &bytes).map_err(|malformed| ReadError::Malformed { path: path.to_owned(), malformed })
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
