//! A model file, ready to be drawn.

use crate::model::{Mesh, Model, Part, PartKind};
use crate::picture::PictureFormat;
use crate::plant::{Material, Texture};
use glam::Vec3;
use std::path::PathBuf;

/// A model with what belongs to it.
#[derive(Debug, Default)]
pub struct Loaded {
    /// Its surfaces and materials.
    pub model: Model,
    /// Pictures inside the file.
    pub embedded: Embedded,
    /// Files that it names: libraries of materials, and pictures, used or not.
    pub files: Vec<PathBuf>,
    /// What could not be had, for the user.
    pub warnings: Vec<String>,
}

/// Pictures that a model file carries; the model's textures name them as if they were files.
#[derive(Debug, Default)]
pub struct Embedded(Vec<(Texture, Vec<u8>)>);

impl Embedded {
    /// The file of a texture, if it is one of these.
    pub fn get(&self, texture: &Texture) -> Option<&[u8]> {
        self.0.iter().find(|(known, _)| known == texture).map(|(_, bytes)| bytes.as_slice())
    }

    /// Adds a picture and returns the texture that stands for it.
    pub(super) fn push(&mut self, bytes: &[u8]) -> Texture {
        let texture = Texture::File(PathBuf::from(format!("embedded picture {}", self.0.len())));
        self.0.push((texture.clone(), bytes.to_vec()));
        texture
    }
}

impl Loaded {
    /// Adds a surface with the material of that index; normals that the file does not give are those of a smooth surface.
    pub(super) fn push(&mut self, name: String, mut mesh: Mesh, material: usize) {
        if mesh.vertices.iter().any(|vertex| vertex.normal == Vec3::ZERO) {
            mesh.smooth_missing_normals();
            mesh.split_disagreeing_corners();
        }
        self.model.parts.push(Part::alone(name, PartKind::Wood, material, mesh.into()));
    }

    /// Adds a material and returns its index.
    pub(super) fn push_material(&mut self, material: Material) -> usize {
        self.model.materials.push(material);
        self.model.materials.len() - 1
    }
}

/// What surfaces without a material are made of.
pub(super) fn clay() -> Material {
    Material { double_sided: true, ..Material::plain("clay", [0.6, 0.55, 0.5]) }
}

/// Whether the bytes begin like a picture.
pub(super) fn is_picture(bytes: &[u8]) -> bool {
    PictureFormat::of(bytes).is_some()
}
