//! Several models of one plant, the finest first, as one: levels of detail for files that hold them all.
//!
//! Parts of a level have its number behind their names. Materials that levels have in common are there once.

use super::Model;
use crate::plant::Material;
use smol_str::format_smolstr;
use std::collections::{BTreeMap, BTreeSet};

/// Models of one plant in one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Levels {
    /// All parts. Each level has plants of its own.
    pub model: Model,
    /// For each plant of the model its level, 0 for the finest.
    pub of_specimen: Vec<usize>,
}

impl Levels {
    /// Puts models together, in their order.
    pub fn of(models: impl IntoIterator<Item = Model>) -> Self {
        let mut levels = Self::default();
        models.into_iter().enumerate().for_each(|(level, model)| levels.add(level, model));
        levels
    }

    fn add(&mut self, level: usize, model: Model) {
        let (first_part, first_specimen) = (self.model.parts.len(), self.of_specimen.len());
        let materials = &mut self.model.materials;
        let places: Vec<usize> =
            model.materials.into_iter().map(|material| place_of(materials, material, level)).collect();
        // Of plants without a part of their own no number is left.
        let plants: BTreeSet<usize> = model.parts.iter().map(|part| part.specimen).collect();
        let place: BTreeMap<usize, usize> = plants.into_iter().zip(first_specimen..).collect();
        self.of_specimen.resize(first_specimen + place.len(), level);
        for mut part in model.parts {
            part.name = format_smolstr!("{}_LOD{level}", part.name);
            part.parent = part.parent.map(|parent| first_part + parent);
            part.specimen = place[&part.specimen];
            part.material = places[part.material];
            part.more_materials.iter_mut().for_each(|material| *material = places[*material]);
            self.model.parts.push(part);
        }
    }
}

/// Where a material is among those that are there; a different one of the same name gets a new name.
fn place_of(materials: &mut Vec<Material>, mut material: Material, level: usize) -> usize {
    if let Some(known) = materials.iter().position(|known| *known == material) {
        return known;
    }
    if materials.iter().any(|known| known.name == material.name) {
        material.name = format!("{}_LOD{level}", material.name);
    }
    materials.push(material);
    materials.len() - 1
}

#[cfg(test)]
mod tests {
    use super::super::{Mesh, Part, PartKind};
    use super::*;
    use glam::Vec3;
    use std::sync::Arc;

    fn model(colour: f32) -> Model {
        let part = |name: &str, parent: Option<usize>, material: usize| Part {
            name: name.into(),
            kind: PartKind::Wood,
            parent,
            specimen: 7,
            pivot: Vec3::ZERO,
            material,
            more_materials: vec![0],
            mesh: Arc::new(Mesh::default()),
            copies: None,
        };
        Model {
            parts: vec![part("wood", None, 0), part("leaves", Some(0), 1)],
            materials: vec![Material::plain("bark", [0.2; 3]), Material::plain("leaf", [colour; 3])],
        }
    }

    #[test]
    fn levels_stand_behind_one_another_and_share_what_is_the_same() {
        let Levels { model, of_specimen } = Levels::of([model(0.5), model(0.5), model(0.7)]);
        assert_eq!(of_specimen, [0, 1, 2]);
        let names: Vec<&str> = model.materials.iter().map(|material| material.name.as_str()).collect();
        assert_eq!(names, ["bark", "leaf", "leaf_LOD2"]);
        let last = &model.parts[5];
        assert_eq!(
            (last.name.as_str(), last.parent, last.specimen, last.material),
            ("leaves_LOD2", Some(4), 2, 2)
        );
        assert_eq!((&last.more_materials[..], model.parts[3].material), (&[0][..], 1));
    }
}
