//! The pictures that a model's materials need, each once, as the bytes that go into files.
//!
//! Pictures are not decoded here: PNG and JPEG are what both OBJ and glTF carry, told apart by their first bytes.

use super::{ExportError, Scene};
use crate::formats::textures::{BuiltInTextures, fetch};
use crate::picture::PictureFormat;
use crate::plant::{Material, Texture};
use std::borrow::Cow;
use std::path::Path;

/// One picture.
#[derive(Clone, Debug)]
pub struct ImageFile {
    /// File name without folder and extension.
    pub stem: String,
    /// Encoding of `bytes`.
    pub format: PictureFormat,
    /// The encoded picture.
    pub bytes: Cow<'static, [u8]>,
}

/// Every picture in use.
#[derive(Clone, Debug, Default)]
pub struct ImageFiles {
    /// Each picture once, in the order in which materials first name them.
    pub all: Vec<ImageFile>,
    /// For each material of the model the index of its picture; `None` too for materials that no part has.
    pub of_material: Vec<Option<usize>>,
}

impl ImageFiles {
    /// Fetches the pictures of all materials that parts use.
    ///
    /// # Errors
    /// A texture that does not exist, cannot be read or is no picture.
    pub fn of(scene: &Scene<'_>) -> Result<Self, ExportError> {
        let mut pictures = Self::default();
        let mut known: Vec<&Texture> = Vec::new();
        for (material, used) in scene.model.materials.iter().zip(scene.used_materials()) {
            let Some(texture) = material.texture.as_ref().filter(|_| used) else {
                pictures.of_material.push(None);
                continue;
            };
            let index = match known.iter().position(|k| *k == texture) {
                Some(index) => index,
                None => {
                    pictures.all.push(picture(material, texture, scene.built_in)?);
                    known.push(texture);
                    known.len() - 1
                }
            };
            pictures.of_material.push(Some(index));
        }
        Ok(pictures)
    }
}

fn picture(
    material: &Material,
    texture: &Texture,
    built_in: &BuiltInTextures<'_>,
) -> Result<ImageFile, ExportError> {
    let wanted_by = || material.name.clone();
    let bytes =
        fetch(texture, built_in).map_err(|fault| ExportError::Texture { material: wanted_by(), fault })?;
    let named = |path: &Path| {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        (stem, path.display().to_string())
    };
    let (stem, picture) = match texture {
        Texture::BuiltIn(name) => named(Path::new(name)),
        Texture::File(path) => named(path),
        // By the material of the part that shows it: its file's name stays on the artist's machine.
        Texture::Own(_) => (material.name.clone(), material.name.clone()),
    };
    let strange = || ExportError::NotAPicture { material: wanted_by(), picture };
    let format = PictureFormat::of(&bytes).ok_or_else(strange)?;
    Ok(ImageFile { stem, format, bytes })
}
