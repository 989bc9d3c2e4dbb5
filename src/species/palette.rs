//! The materials that a plant really uses, gathered while it is dressed.

use super::looks::{Names, Species};
use super::part::Part;
use crate::plant::{Material, Texture};

/// Materials in the order of first use; a name that is asked for again keeps its index.
pub(super) struct Palette<'a> {
    species: &'a Species,
    materials: Vec<Material>,
}

impl<'a> Palette<'a> {
    /// An empty palette of a species.
    pub(super) fn new(species: &'a Species) -> Self {
        Self { species, materials: Vec::new() }
    }

    /// Index of the material `name` as `part` wears it: with the artist's own picture if the part was given one.
    pub(super) fn index(&mut self, part: Part, name: &str) -> usize {
        // the species' own materials have no hyphen in their names, see `SpeciesError::MaterialName`
        let picture =
            self.species.pictures.get(&part).map(|(_, own)| (format!("{}-picture", part.name()), own));
        let unique = picture.as_ref().map_or(name, |(unique, _)| unique.as_str());
        if let Some(index) = self.materials.iter().position(|m| m.name == unique) {
            return index;
        }
        let look = self.species.materials.get(name).cloned().unwrap_or_default();
        let mut material = look.material(unique);
        if let Some((_, own)) = picture {
            let white = Material::plain(unique, [1.0; 3]);
            material = Material { diffuse: white.diffuse, ambient: white.ambient, ..material };
            material.texture = Some(Texture::Own(own.clone()));
        }
        self.materials.push(material);
        self.materials.len() - 1
    }

    /// Indices of several materials.
    pub(super) fn indices(&mut self, part: Part, names: &Names) -> Vec<usize> {
        names.0.iter().map(|name| self.index(part, name)).collect()
    }

    /// The finished list.
    pub(super) fn finish(self) -> Vec<Material> {
        self.materials
    }
}
