//! The artist's own textures: laid over a dressed plant, by kind of part.
//!
//! A choice names a kind of part by its [`key`] and a texture: a built-in one, by file name with or without ending, or a
//! picture file. Every material that such parts wear gets the texture; a material that other parts wear too is split
//! first, so that a choice for petals never shows on leaves. The colour becomes white, for a picture shows its own
//! colours; only the built-in `…_soft` textures are grey and keep the species' colour.
//!
//! Limits: whether a picture file can be read is found out by who draws or exports it.

use super::builtin::builtin_texture;
use crate::plant::{Material, OrganKind, Plant, Shape, Texture};
use std::collections::{BTreeMap, BTreeSet};

/// Kinds of parts that have a texture of their own, `None` for branches.
pub const KINDS: [Option<OrganKind>; 10] = [
    None,
    Some(OrganKind::Leaf),
    Some(OrganKind::Petal),
    Some(OrganKind::Sepal),
    Some(OrganKind::Receptacle),
    Some(OrganKind::Stamen),
    Some(OrganKind::Pistil),
    Some(OrganKind::Fruit),
    Some(OrganKind::Thorn),
    Some(OrganKind::Pot),
];

/// Name of a kind of part among the choices; branches are `None`.
pub fn key(organ: Option<OrganKind>) -> &'static str {
    match organ {
        None => "branch",
        Some(OrganKind::Leaf) => "leaf",
        Some(OrganKind::Bud) => "bud",
        Some(OrganKind::Petal) => "petal",
        Some(OrganKind::Sepal) => "sepal",
        Some(OrganKind::Receptacle) => "receptacle",
        Some(OrganKind::Stamen) => "stamen",
        Some(OrganKind::Pistil) => "pistil",
        Some(OrganKind::Fruit) => "fruit",
        Some(OrganKind::Thorn) => "thorn",
        Some(OrganKind::Pot) => "pot",
    }
}

/// The texture that a choice means: a built-in name with or without `.png`, anything else a file.
pub fn chosen(name: &str) -> Texture {
    let built_in = [name.to_owned(), format!("{name}.png")];
    match built_in.into_iter().find(|name| builtin_texture(name).is_some()) {
        Some(name) => Texture::BuiltIn(name),
        None => Texture::File(name.into()),
    }
}

/// Lays the artist's textures over a dressed plant. Choices for unknown kinds of parts, and for those that the plant
/// does not have, change nothing.
pub fn lay_over(plant: &mut Plant, choices: &BTreeMap<String, String>) {
    for organ in KINDS {
        if let Some(name) = choices.get(key(organ)) {
            lay(plant, organ, &chosen(name));
        }
    }
}

fn lay(plant: &mut Plant, organ: Option<OrganKind>, texture: &Texture) {
    let mut mine = BTreeSet::new();
    let mut others = BTreeSet::new();
    visit(plant, |kind, material| {
        if kind == organ {
            mine.insert(*material)
        } else {
            others.insert(*material)
        };
    });
    let mut moved = BTreeMap::new();
    for index in mine {
        let Some(material) = plant.materials.get(index) else { continue };
        let mut dressed = textured(material, texture);
        if others.contains(&index) {
            dressed.name = unique_name(&plant.materials, &format!("{}-{}", dressed.name, key(organ)));
            moved.insert(index, plant.materials.len());
            plant.materials.push(dressed);
        } else {
            plant.materials[index] = dressed;
        }
    }
    visit(plant, |kind, material| {
        if let Some(new) = moved.get(material).filter(|_| kind == organ) {
            *material = *new;
        }
    });
}

/// Shows every material index of the plant with the kind of part that wears it.
fn visit(plant: &mut Plant, mut see: impl FnMut(Option<OrganKind>, &mut usize)) {
    for branch in &mut plant.branches {
        see(None, &mut branch.material);
    }
    for organ in &mut plant.organs {
        see(Some(organ.kind), &mut organ.material);
        if let Shape::Filament { head_material, .. } = &mut organ.shape {
            see(Some(organ.kind), head_material);
        }
    }
}

fn textured(material: &Material, texture: &Texture) -> Material {
    let mut out = material.clone();
    let grey = matches!(texture, Texture::BuiltIn(name) if name.ends_with("_soft.png"));
    if !grey {
        let white = Material::plain("", [1.0; 3]);
        (out.diffuse, out.ambient) = (white.diffuse, white.ambient);
    }
    out.texture = Some(texture.clone());
    out
}

fn unique_name(taken: &[Material], wish: &str) -> String {
    let free = |name: &String| taken.iter().all(|material| material.name != *name);
    let mut names = std::iter::once(wish.to_owned()).chain((2..).map(|n| format!("{wish}{n}")));
    names.find(free).unwrap_or_else(|| wish.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{Branch, Organ, WorldFromCanvas};
    use glam::{Vec2, Vec3};

    /// A plant with a stem and one organ of each kind, each with a material of its own, and a stamen whose head has
    /// another one.
    fn plant() -> Plant {
        let mut plant = Plant {
            world_from_canvas: WorldFromCanvas { scale: 0.001, origin: Vec2::ZERO },
            branches: vec![Branch {
                stroke: Some(1),
                parent: None,
                level: 0,
                points: vec![Vec3::ZERO, Vec3::Y],
                radii: vec![0.1; 2],
                material: 0,
            }],
            flowers: Vec::new(),
            organs: Vec::new(),
            materials: vec![Material::plain("stem", [0.2, 0.4, 0.2])],
        };
        for kind in KINDS.into_iter().flatten() {
            let material = plant.materials.len();
            plant.materials.push(Material::plain(key(Some(kind)), [0.1, 0.2, 0.3]));
            let shape = if kind == OrganKind::Stamen {
                plant.materials.push(Material::plain("anther", [0.9, 0.8, 0.1]));
                let points = vec![Vec3::Y, 2.0 * Vec3::Y];
                Shape::Filament { points, radius: 0.01, head: Vec2::splat(0.02), head_material: material + 1 }
            } else {
                Shape::Dome { base: Vec3::Y, axis: Vec3::Y, radius: 0.1, height: 0.1 }
            };
            plant.organs.push(Organ { kind, stroke: None, branch: Some(0), flower: None, material, shape });
        }
        assert_eq!(plant.check_invariants(), Ok(()));
        plant
    }

    fn choices(pairs: &[(&str, &str)]) -> BTreeMap<String, String> {
        pairs.iter().map(|(k, v)| ((*k).to_owned(), (*v).to_owned())).collect()
    }

    fn textures_of(plant: &Plant, wanted: Option<OrganKind>) -> BTreeSet<String> {
        let mut plant = plant.clone();
        let mut out = BTreeSet::new();
        let materials = plant.materials.clone();
        visit(&mut plant, |kind, material| {
            if kind == wanted {
                out.insert(format!("{:?}", materials[*material].texture));
            }
        });
        out
    }

    #[test]
    fn only_the_chosen_kind_of_part_changes() {
        let before = plant();
        let mut after = before.clone();
        lay_over(&mut after, &choices(&[("petal", "petal_rose"), ("branch", "/photos/bark.jpg")]));
        assert_eq!(after.check_invariants(), Ok(()));
        assert_eq!(
            textures_of(&after, Some(OrganKind::Petal)),
            ["Some(BuiltIn(\"petal_rose.png\"))".to_owned()].into()
        );
        assert_eq!(textures_of(&after, None), ["Some(File(\"/photos/bark.jpg\"))".to_owned()].into());
        for kind in [OrganKind::Leaf, OrganKind::Receptacle, OrganKind::Sepal, OrganKind::Stamen] {
            assert_eq!(textures_of(&after, Some(kind)), textures_of(&before, Some(kind)), "{kind:?}");
        }
    }

    #[test]
    fn a_material_worn_by_two_kinds_of_parts_is_split() {
        let mut plant = plant();
        visit(&mut plant, |_, material| *material = 0);
        plant.materials.truncate(1);
        lay_over(&mut plant, &choices(&[("leaf", "leaf_maple.png")]));
        assert_eq!(plant.materials.len(), 2);
        assert_ne!(plant.materials[0].name, plant.materials[1].name);
        assert_ne!(textures_of(&plant, None), textures_of(&plant, Some(OrganKind::Leaf)));
        assert_eq!(plant.check_invariants(), Ok(()));
    }

    #[test]
    fn threads_wear_the_texture_with_their_heads() {
        let mut plant = plant();
        lay_over(&mut plant, &choices(&[("stamen", "petal_daisy")]));
        assert_eq!(textures_of(&plant, Some(OrganKind::Stamen)).len(), 1);
    }

    #[test]
    fn grey_textures_keep_the_colour_and_pictures_show_their_own() {
        let tinted = Material::plain("petal", [0.8, 0.1, 0.2]);
        assert_eq!(textured(&tinted, &chosen("petal_soft")).diffuse, tinted.diffuse);
        assert_eq!(textured(&tinted, &chosen("petal_daisy")).diffuse, [1.0; 3]);
        assert_eq!(chosen("petal.png"), Texture::File("petal.png".into()));
    }

    #[test]
    fn no_choice_changes_nothing() {
        let before = plant();
        let mut after = before.clone();
        lay_over(&mut after, &choices(&[("nonsense", "x.png")]));
        assert_eq!(before, after);
        after.organs.retain(|organ| organ.kind != OrganKind::Petal);
        let bare = after.clone();
        lay_over(&mut after, &choices(&[("petal", "petal_rose")]));
        assert_eq!(bare, after);
    }

    #[test]
    fn every_kind_has_its_own_name() {
        let names: BTreeSet<_> = KINDS.into_iter().map(key).collect();
        assert_eq!(names.len(), KINDS.len());
    }
}
