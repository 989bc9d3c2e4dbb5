//! Finished models to files: one trait, one file per format; and back, for the judge of meshes.
//!
//! An [`Exporter`] makes the bytes in memory, [`export`] also writes them ([`crate::atomic`]: whole or not at all,
//! companions such as MTL and pictures first). Same model, same bytes. [`read()`] opens OBJ and GLB files for
//! [`quality`](crate::model::quality), [`load()`] opens them with their materials to be looked at.

pub mod decode;
pub mod error;
pub mod glb;
mod glb_container;
mod gltf_accessor;
mod gltf_extensions;
mod gltf_materials;
mod gltf_tree;
pub mod load;
mod load_glb;
mod load_obj;
pub mod mtl;
mod names;
pub mod obj;
pub mod pictures;
pub mod plant_json;
pub mod read;
mod read_glb;
mod read_obj;
pub mod scene;
mod tint;

pub use crate::atomic::{WriteError, write_atomically};
pub use error::ExportError;
pub use load::{Embedded, Loaded, load};
pub use pictures::{BuiltInTextures, Pictures};
pub use read::{ReadError, Surface, read};
pub use scene::Scene;

use crate::model::Model;
use crate::plant::Plant;
use std::borrow::Cow;
use std::path::{Path, PathBuf};

/// An encoded model.
#[derive(Debug)]
pub struct Encoded {
    /// The file itself.
    pub bytes: Vec<u8>,
    /// Files that it refers to, by name; they belong into the same folder.
    pub companions: Vec<(String, Cow<'static, [u8]>)>,
}

/// A file format that models are written in.
pub trait Exporter: Sync {
    /// The extension that chooses it, in lower case.
    fn extension(&self) -> &'static str;

    /// The scene in this format.
    ///
    /// # Errors
    /// A scene that the format cannot hold.
    fn encode(&self, scene: &Scene<'_>) -> Result<Encoded, ExportError>;
}

/// Every format, in the order in which help lists them.
pub const FORMATS: [&dyn Exporter; 3] = [&obj::Obj, &glb::Glb, &plant_json::PlantJson];

/// The format that a file's extension asks for, in upper or lower case.
///
/// # Errors
/// [`ExportError::UnknownFormat`], listing the known ones.
pub fn format_of(path: &Path) -> Result<&'static dyn Exporter, ExportError> {
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    let wanted = FORMATS.into_iter().find(|format| extension.as_deref() == Some(format.extension()));
    wanted.ok_or_else(|| ExportError::UnknownFormat {
        path: path.to_owned(),
        extension,
        known: FORMATS.iter().map(|format| format.extension()).collect(),
    })
}

/// Writes a model in the format that the path's extension asks for, whole or not at all, and returns the number of
/// bytes of all files together.
///
/// `built_in` serves the program's own textures; a user's own are read from disk.
///
/// # Errors
/// [`ExportError`]; nothing is left half written.
pub fn export(
    path: &Path,
    model: &Model,
    plant: &Plant,
    built_in: &BuiltInTextures<'_>,
) -> Result<usize, ExportError> {
    let format = format_of(path)?;
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let scene = Scene::new(model, plant, built_in, stem)?;
    let encoded = format.encode(&scene)?;
    let mut files: Vec<(PathBuf, &[u8])> =
        encoded.companions.iter().map(|(name, bytes)| (path.with_file_name(name), bytes.as_ref())).collect();
    files.push((path.to_owned(), &encoded.bytes));
    crate::atomic::write_group_atomically(&files)?;
    Ok(files.iter().map(|(_, bytes)| bytes.len()).sum())
}
