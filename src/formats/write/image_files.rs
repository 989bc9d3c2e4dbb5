//! The pictures that a model's materials need, each once, as the bytes that go into files.
//!
//! Colours are not decoded here: PNG and JPEG are what both OBJ and glTF carry, known by their first bytes. A material with a
//! relief has a normal map beside its colours, which is made of them.
//!
//! Limits: a picture that cannot be decoded has no relief.

use super::{ExportError, Scene};
use crate::formats::textures::{BuiltInTextures, fetch};
use crate::picture::decode::decode;
use crate::picture::{PictureFormat, normal_map};
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
    /// Each picture once, in the order in which materials first name them, and behind them the normal maps.
    pub all: Vec<ImageFile>,
    /// For each material of the model the index of its picture; `None` too for materials that no part has.
    pub of_material: Vec<Option<usize>>,
    /// The same for the normal map of its relief.
    pub relief_of_material: Vec<Option<usize>>,
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
        pictures.add_reliefs(&scene.model.materials);
        Ok(pictures)
    }

    /// Adds the normal maps of materials with pictures; each is there once for all that have the same.
    fn add_reliefs(&mut self, materials: &[Material]) {
        let mut known: Vec<((usize, u32), Option<usize>)> = Vec::new();
        for (material, picture) in materials.iter().zip(&self.of_material) {
            let key =
                picture.filter(|_| material.relief > 0.0).map(|picture| (picture, material.relief.to_bits()));
            let index = key.and_then(|key| {
                if let Some((_, index)) = known.iter().find(|(known, _)| *known == key) {
                    return *index;
                }
                let map = relief(&self.all[key.0], material.relief);
                let index = map.map(|map| {
                    self.all.push(map);
                    self.all.len() - 1
                });
                known.push((key, index));
                index
            });
            self.relief_of_material.push(index);
        }
    }
}

/// The normal map of a picture, if that can be decoded.
fn relief(picture: &ImageFile, relief: f32) -> Option<ImageFile> {
    let map = normal_map(&decode(&picture.bytes).ok()?, relief);
    let stem = format!("{}_normal", picture.stem);
    Some(ImageFile { stem, format: PictureFormat::Png, bytes: map.to_png().ok()?.into() })
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
