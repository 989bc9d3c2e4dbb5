//! Several models of one plant, the finest first, as one: levels of detail for files that hold them all.
//!
//! Parts of a level have its number behind their names. Materials that levels have in common are there once.
//!
//! Which level is shown follows from the share of the screen's height that the plant fills: the shares fall with the square root of
//! the triangles, so that these are about equally dense on the screen. No level but the last is shown over more than four times the
//! distance: two crossing pictures have so few triangles that they would else come when the plant is a few pixels high.

use super::Model;
use crate::plant::Material;
use smol_str::format_smolstr;
use std::collections::{BTreeMap, BTreeSet};

/// The share of the screen's height below which the second level is shown.
const SECOND: f32 = 0.5;
/// The share of the screen's height below which a plant in levels of detail is not shown at all.
pub const NOTHING: f32 = 0.004;

/// Least share of a level, in that of the level before it.
const NEXT: f32 = 0.25;

/// For levels of so many triangles, the finest first, the share of the screen's height down to which each is shown, 0 to 1.
pub fn screen_shares(triangles: &[usize]) -> Vec<f32> {
    let of_second = triangles.get(1).copied().unwrap_or(1).max(1) as f32;
    let mut before = 0.0;
    let mut share = |of: &usize| {
        let by_triangles = SECOND * (*of as f32 / of_second).sqrt();
        before = by_triangles.max(NEXT * before).max(NOTHING);
        before
    };
    let of_levels: Vec<f32> = triangles.iter().skip(1).map(&mut share).collect();
    of_levels.into_iter().chain([NOTHING]).collect()
}

/// The level that is shown where the plant fills this share of the screen's height, of levels that are shown down to `shares`; the last
/// below all of them.
pub fn shown_at(share: f32, shares: &[f32]) -> usize {
    shares.iter().position(|down_to| share >= *down_to).unwrap_or(shares.len().saturating_sub(1))
}

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

    #[test]
    fn coarser_levels_are_for_smaller_pictures() {
        let shares = screen_shares(&[400_000, 40_000, 10_000, 8]);
        assert!((shares[0] - 0.5).abs() < 1e-6 && (shares[1] - 0.25).abs() < 1e-6, "{shares:?}");
        assert_eq!(shares[2..], [0.0625, NOTHING], "pictures come before the plant is too small to be seen");
        let levels = [2.0, 0.5, 0.49, 0.25, 0.1, 0.005, 0.001].map(|share| shown_at(share, &shares));
        assert_eq!(levels, [0, 0, 1, 1, 2, 3, 3]);
        assert_eq!((shown_at(0.1, &[NOTHING]), shown_at(0.1, &[])), (0, 0));
    }

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
