//! The artist's own textures: found, and laid over a finished plant, by kind of part.
//!
//! A choice names a kind of part by its [`key`] and a texture: a built-in one, by file name with or without ending, or a
//! picture. Every material that such parts have gets the texture; a material that other parts have too is split
//! first, so that a choice for petals never shows on leaves. The colour becomes white, for a picture shows its own
//! colours; only the built-in `…_soft` textures are grey and keep the species' colour.
//!
//! Drawings of the first version name a picture by its path. [`take_in`] reads such pictures into the drawing; where one
//! is missing the part is as its species has it.

use super::builtin_textures::builtin_texture;
use crate::picture::{Picture, PictureError, decode};
use crate::plant::{FinishedPlant, Material, OrganKind, Texture};
use crate::sketch::species_file::own_name;
use crate::sketch::{Remark, TextureChoice, Textures, Warning};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Kinds of parts that have a texture of their own, `None` for branches.
pub fn kinds() -> impl Iterator<Item = Option<OrganKind>> {
    std::iter::once(None).chain(OrganKind::ALL.iter().copied().map(Some))
}

/// Name of a kind of part among the choices; branches are `None`.
pub fn key(organ: Option<OrganKind>) -> &'static str {
    organ.map_or("branch", OrganKind::name)
}

/// File name of the built-in texture that a choice means, given with or without `.png`; `None` where there is none.
pub fn built_in_name(name: &str) -> Option<String> {
    let names = [name.to_owned(), format!("{name}.png")];
    names.into_iter().find(|name| builtin_texture(name).is_some())
}

/// The texture that a choice means; `None` for a picture that is missing.
pub fn chosen(choice: &TextureChoice) -> Option<Texture> {
    match choice {
        TextureChoice::Named(name) => built_in_name(name).map(Texture::BuiltIn),
        TextureChoice::Own(picture) => Some(Texture::Own(picture.clone())),
    }
}

/// Reads the pictures that choices name by path into the choices. A path is looked up from `folder`, the drawing's; then
/// the file's name is looked for in `folder` itself, for drawings are moved together with their pictures. Of a picture
/// that is missing the name without folders stays; one that is damaged goes, also where it was in the drawing before.
///
/// Returns one remark for each picture that is missing or damaged.
pub fn take_in(textures: &mut Textures, folder: &Path) -> Vec<Warning> {
    let mut troubles: BTreeMap<(String, Option<String>), Vec<String>> = BTreeMap::new();
    let mut looked_at: BTreeMap<String, Option<String>> = BTreeMap::new();
    let mut note = |name: &str, damage: Option<String>, part: &str| {
        troubles.entry((name.to_owned(), damage)).or_default().push(part.to_owned());
    };
    textures.retain(|part, choice| match choice {
        TextureChoice::Named(name) if built_in_name(name).is_some() => true,
        TextureChoice::Named(path) => {
            let name = own_name(path).to_owned();
            match found(path, &name, folder) {
                Ok(picture) => *choice = TextureChoice::Own(picture),
                Err(PictureError::Unreadable(_)) => {
                    note(&name, None, part);
                    *choice = TextureChoice::Named(name);
                }
                Err(damage) => {
                    note(&name, Some(damage.to_string()), part);
                    return false;
                }
            }
            true
        }
        TextureChoice::Own(picture) => {
            let look = || decode::decode(picture.bytes()).err();
            let damage = looked_at.entry(picture.name()).or_insert_with(look).clone();
            if damage.is_some() {
                note(&picture.name(), damage.clone(), part);
            }
            damage.is_none()
        }
    });
    let remark = |((name, damage), parts)| match damage {
        None => Remark::PictureMissing { name, parts },
        Some(reason) => Remark::PictureDamaged { reason, parts },
    };
    troubles.into_iter().map(|trouble| Warning { stroke: None, remark: remark(trouble) }).collect()
}

/// Where the pictures may be that choices name by path, as [`take_in`] looks for them.
pub fn files(textures: &Textures, folder: &Path) -> impl Iterator<Item = PathBuf> {
    let named = textures.values().filter_map(|choice| match choice {
        TextureChoice::Named(name) if built_in_name(name).is_none() => Some(name),
        _ => None,
    });
    named.flat_map(move |path| [folder.join(path), folder.join(own_name(path))])
}

fn found(path: &str, name: &str, folder: &Path) -> Result<Picture, PictureError> {
    match Picture::read(&folder.join(path)) {
        Err(PictureError::Unreadable(_)) => Picture::read(&folder.join(name)),
        read => read,
    }
}

/// Lays the artist's textures over a plant. Choices for unknown kinds of parts, for those that the plant does not have,
/// and of missing pictures change nothing.
pub fn lay_over(plant: &mut FinishedPlant, choices: &Textures) {
    for organ in kinds() {
        if let Some(texture) = choices.get(key(organ)).and_then(chosen) {
            plant.change_materials(organ, key(organ), |material| textured(material, &texture));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{Branch, Organ, OrganPart, Origin, Plant, Role, Shape, WoodPart};
    use glam::{Vec2, Vec3};
    use std::collections::BTreeSet;

    /// A plant with a stem and one organ of each kind, each with a material of its own, and a stamen whose head has
    /// another one.
    fn plant() -> FinishedPlant {
        let shape = |part| match part {
            OrganPart::Stamen => Shape::Filament {
                points: vec![Vec3::Y, 2.0 * Vec3::Y],
                radius: 0.01,
                head: Vec2::splat(0.02),
            },
            _ => Shape::Dome { base: Vec3::Y, axis: Vec3::Y, radius: 0.1, height: 0.1 },
        };
        let part = |kind| OrganPart::ALL.iter().copied().find(|part| part.kind() == kind).unwrap();
        let organ = |kind| Organ {
            role: Role::of(part(kind)),
            origin: Origin::Generated,
            branch: Some(0),
            flower: None,
            shape: shape(part(kind)),
        };
        let plant = FinishedPlant::plain(Plant {
            branches: vec![Branch {
                origin: Origin::Generated,
                parent: None,
                level: 0,
                points: vec![Vec3::ZERO, Vec3::Y],
                radii: vec![0.1; 2],
                role: Role::of(WoodPart::Stem),
            }],
            organs: kinds().flatten().map(organ).collect(),
            ..Plant::default()
        });
        assert_eq!(plant.check_invariants(), Ok(()));
        plant
    }

    const PNG: &[u8] = include_bytes!("../../tests/fixtures/reference/small.png");

    fn named(name: &str) -> TextureChoice {
        TextureChoice::Named(name.to_owned())
    }

    fn choices(pairs: &[(&str, &str)]) -> Textures {
        pairs.iter().map(|(k, v)| ((*k).to_owned(), named(v))).collect()
    }

    fn textures_of(plant: &FinishedPlant, wanted: Option<OrganKind>) -> BTreeSet<String> {
        let roles = plant.roles().filter(|role| role.part.kind() == wanted);
        roles.map(|role| format!("{:?}", plant.materials()[plant.material(role)].texture)).collect()
    }

    #[test]
    fn only_the_chosen_kind_of_part_changes() {
        let before = plant();
        let mut after = before.clone();
        let mut textures = choices(&[("petal", "petal_rose"), ("leaf", "/photos/gone.jpg")]);
        let own = Picture::new(PNG).unwrap();
        textures.insert("branch".to_owned(), TextureChoice::Own(own.clone()));
        lay_over(&mut after, &textures);
        assert_eq!(after.check_invariants(), Ok(()));
        assert_eq!(
            textures_of(&after, Some(OrganKind::Petal)),
            ["Some(BuiltIn(\"petal_rose.png\"))".to_owned()].into()
        );
        assert_eq!(textures_of(&after, None), [format!("{:?}", Some(Texture::Own(own)))].into());
        for kind in [OrganKind::Leaf, OrganKind::Receptacle, OrganKind::Sepal, OrganKind::Stamen] {
            assert_eq!(textures_of(&after, Some(kind)), textures_of(&before, Some(kind)), "{kind:?}");
        }
    }

    #[test]
    fn a_material_of_two_kinds_of_parts_is_split() {
        let mut plant = FinishedPlant::new((*plant()).clone(), &[], |_| Material::plain("all", [0.5; 3]));
        lay_over(&mut plant, &choices(&[("leaf", "leaf_maple.png")]));
        let names: Vec<&str> = plant.materials().iter().map(|material| material.name.as_str()).collect();
        assert_eq!(names, ["all", "all-leaf"]);
        assert_ne!(textures_of(&plant, None), textures_of(&plant, Some(OrganKind::Leaf)));
        assert_eq!(plant.check_invariants(), Ok(()));
    }

    #[test]
    fn filaments_have_the_texture_with_their_heads() {
        let mut plant = plant();
        lay_over(&mut plant, &choices(&[("stamen", "petal_daisy")]));
        assert_eq!(textures_of(&plant, Some(OrganKind::Stamen)).len(), 1);
    }

    #[test]
    fn grey_textures_keep_the_colour_and_pictures_show_their_own() {
        let tinted = Material::plain("petal", [0.8, 0.1, 0.2]);
        assert_eq!(textured(&tinted, &chosen(&named("petal_soft")).unwrap()).diffuse, tinted.diffuse);
        assert_eq!(textured(&tinted, &chosen(&named("petal_daisy")).unwrap()).diffuse, [1.0; 3]);
        assert_eq!(chosen(&named("petal.png")), None);
    }

    #[test]
    fn pictures_are_found_by_path_and_beside_the_drawing_and_taken_in() {
        let folder = tempfile::tempdir().unwrap();
        let elsewhere = tempfile::tempdir().unwrap();
        let far = elsewhere.path().join("far.png");
        for path in [&far, &folder.path().join("near.png"), &folder.path().join("moved.png")] {
            std::fs::write(path, PNG).unwrap();
        }
        let mut textures = choices(&[
            ("branch", far.to_str().unwrap()),
            ("leaf", "near.png"),
            ("petal", "/home/ada/moved.png"),
            ("sepal", r"C:\Users\ada\moved.png"),
            ("pot", "terracotta"),
        ]);
        assert_eq!(take_in(&mut textures, folder.path()), []);
        let own = TextureChoice::Own(Picture::new(PNG).unwrap());
        assert_eq!(textures.remove("pot"), Some(named("terracotta")));
        assert!(textures.len() == 4 && textures.values().all(|choice| *choice == own));
    }

    #[test]
    fn a_missing_picture_is_one_remark_and_keeps_no_folder() {
        let folder = tempfile::tempdir().unwrap();
        let mut textures = choices(&[("leaf", "/home/ada/gone.png"), ("petal", "/home/ada/gone.png")]);
        let remarks = take_in(&mut textures, folder.path());
        let parts = vec!["leaf".to_owned(), "petal".to_owned()];
        let missing = Remark::PictureMissing { name: "gone.png".to_owned(), parts };
        assert_eq!(remarks, [Warning { stroke: None, remark: missing }]);
        assert_eq!(textures, choices(&[("leaf", "gone.png"), ("petal", "gone.png")]));
    }

    #[test]
    fn a_damaged_picture_is_left_out_with_a_remark() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("cut.png"), &PNG[..PNG.len() - 20]).unwrap();
        let mut textures = choices(&[("leaf", "cut.png")]);
        let cut = Picture::new(&PNG[..PNG.len() - 20]).unwrap();
        textures.insert("petal".to_owned(), TextureChoice::Own(cut));
        let remarks = take_in(&mut textures, folder.path());
        assert!(remarks.len() == 2 && textures.is_empty(), "{remarks:?}");
        assert!(remarks.iter().all(|w| matches!(w.remark, Remark::PictureDamaged { .. })));
    }

    #[test]
    fn no_choice_changes_nothing() {
        let before = plant();
        let mut after = before.clone();
        lay_over(&mut after, &choices(&[("nonsense", "x.png")]));
        assert_eq!(before, after);
        let mut bare = (*after).clone();
        bare.organs.retain(|organ| organ.kind() != OrganKind::Petal);
        let before = FinishedPlant::plain(bare);
        let mut after = before.clone();
        lay_over(&mut after, &choices(&[("petal", "petal_rose")]));
        assert_eq!(before, after);
    }

    #[test]
    fn every_kind_has_its_own_name() {
        let names: BTreeSet<_> = kinds().map(key).collect();
        assert_eq!(names.len(), kinds().count());
    }
}
