//! What the roles of a plant are made of in a species.

use super::builtin_textures::builtin_texture;
use super::cap::UNDERSIDE;
use super::fruit_look::FruitLook;
use super::fruits::UNRIPE;
use super::looks::{FilamentLook, FlowerLook, MaterialLook, SeasonLook, Species};
use super::season::{self, Tint};
use crate::input;
use crate::picture::{self, Picture, recoloured};
use crate::plant::{FinishedPlant, Material, OrganPart, Plant, PlantPart, Role, Texture, WoodPart};
use std::borrow::Cow;
use std::iter;

/// The plant with the species' materials: those of wood, leaves and petals first, whether it has such organs or not.
pub(super) fn with_materials(plant: Plant, species: &Species) -> FinishedPlant {
    let roles = |part: OrganPart, look, count| {
        (0..count as u32).map(move |variant| Role { part: part.into(), look, variant })
    };
    let wood = iter::once(Role::of(WoodPart::Stem)).chain(plant.branches.iter().map(|branch| branch.role));
    let wood = wood.map(Role::from);
    let leaves = roles(OrganPart::Leaf, 0, species.leaf.materials.0.len());
    let petals = species.flowers.iter().enumerate();
    let petals =
        petals.flat_map(|(k, look)| roles(OrganPart::Petal, k as u32, look.petals.materials.0.len()));
    let first: Vec<Role> = wood.chain(leaves).chain(petals).collect();
    FinishedPlant::new(plant, &first, |role| material(species, role))
}

/// What a role is made of: with the artist's own picture if its part was given one.
fn material(species: &Species, role: Role) -> Material {
    let (usual, tint) = season::untinted(species, role.variant);
    match tint.filter(|_| role.part == OrganPart::Leaf.into()) {
        Some(tint) => tinted(usual_material(species, Role { variant: usual, ..role }), tint, &species.season),
        None => usual_material(species, role),
    }
}

/// A material in the colour of a season. One whose picture cannot be recoloured keeps it: whoever shows it says what is wrong with it.
fn tinted(usual: Material, tint: Tint, look: &SeasonLook) -> Material {
    let name = format!("{}-{}", usual.name, tint.suffix());
    let of_colour = |colour, texture, usual: Material| {
        let Material { diffuse, ambient, .. } = Material::plain("", colour);
        Material { name: name.clone(), diffuse, ambient, texture, ..usual }
    };
    let Some(texture) = &usual.texture else { return of_colour(tint.colour(look), None, usual) };
    let file = bytes_of(texture).and_then(|bytes| recoloured(&bytes, tint.colour(look)).ok());
    match file.and_then(|file| Picture::new(file).ok()) {
        // The colour is in the picture.
        Some(picture) => of_colour([1.0; 3], Some(Texture::Own(picture)), usual),
        None => Material { name, ..usual },
    }
}

fn bytes_of(texture: &Texture) -> Option<Cow<'_, [u8]>> {
    match texture {
        Texture::BuiltIn(name) => builtin_texture(name).map(Cow::Borrowed),
        Texture::Own(picture) => Some(Cow::Borrowed(picture.bytes())),
        Texture::File(path) => input::read(path, picture::MAX_BYTES as u64).ok().map(Cow::Owned),
    }
}

/// What a role is made of in summer.
fn usual_material(species: &Species, role: Role) -> Material {
    let (part, name) = named(species, role);
    let look = species.materials.get(name).cloned().unwrap_or_else(|| usual(role));
    let Some(own) = species.pictures.get(&part) else { return look.material(name) };
    // The species' own materials have no hyphen in their names, see `SpeciesError::MaterialName`.
    let unique = format!("{}-picture", part.name());
    let white = Material::plain(&unique, [1.0; 3]);
    Material {
        diffuse: white.diffuse,
        ambient: white.ambient,
        texture: Some(Texture::Own(own.clone())),
        ..look.material(&unique)
    }
}

/// Colour of a ripe fruit, linear RGB.
const RIPE: [f32; 3] = [0.56, 0.03, 0.025];

/// What a part is made of where the species has no material for it: a drawn pot is of clay, a fruit is red.
fn usual(role: Role) -> MaterialLook {
    let of = |texture: &str, specular| MaterialLook {
        texture: Some(Texture::BuiltIn(texture.to_owned())),
        specular,
        ..MaterialLook::default()
    };
    match role.part {
        PlantPart::Organ(OrganPart::Pot) => of("terracotta.png", 0.02),
        PlantPart::Organ(OrganPart::Soil) => of("soil.png", 0.0),
        PlantPart::Organ(OrganPart::Fruit) => {
            MaterialLook { color: RIPE, specular: 0.25, shininess: 60.0, ..MaterialLook::default() }
        }
        _ => MaterialLook::default(),
    }
}

/// What a variant of a species' fruits is made of.
fn of_fruit(look: &FruitLook, variant: u32) -> &str {
    let other = match variant {
        UNDERSIDE => &look.underside,
        UNRIPE => &look.unripe,
        _ => &None,
    };
    other.as_ref().unwrap_or(&look.material)
}

/// The name of a role's material and the part whose picture replaces it. What the species says nothing about is made of
/// what its leaves or stems are made of.
fn named(species: &Species, role: Role) -> (PlantPart, &str) {
    let flower = species.flowers.get(role.look as usize);
    let of_flower = |name: fn(&FlowerLook) -> Option<&str>| flower.and_then(name);
    let of_filaments = |groups: fn(&FlowerLook) -> &[FilamentLook]| {
        flower.and_then(|look| groups(look).get(role.variant as usize))
    };
    let of_organ = |part: OrganPart| match part {
        OrganPart::Petal => flower.map(|look| look.petals.materials.nth(role.variant)),
        OrganPart::Sepal => of_flower(|look| Some(&look.sepals.as_ref()?.material)),
        OrganPart::Cup => {
            let own = of_flower(|look| Some(&look.cup.as_ref()?.material));
            own.or_else(|| of_flower(|look| Some(&look.sepals.as_ref()?.material)))
        }
        OrganPart::Disc => of_flower(|look| Some(&look.disc.material)),
        OrganPart::Stamen => of_filaments(|look| &look.stamens).map(FilamentLook::material),
        OrganPart::Anther => of_filaments(|look| &look.stamens).map(FilamentLook::head_material),
        OrganPart::Pistil => of_filaments(|look| &look.pistils).map(FilamentLook::material),
        OrganPart::Stigma => of_filaments(|look| &look.pistils).map(FilamentLook::head_material),
        OrganPart::Thorn => species.thorns.as_ref().map(|look| look.material.as_str()),
        OrganPart::Pot => Some(species.pot.as_ref().map_or(part.name(), |look| &look.material)),
        OrganPart::Soil => Some(species.pot.as_ref().map_or(part.name(), |look| &look.soil)),
        OrganPart::Fruit => {
            Some(species.fruit.as_ref().map_or(part.name(), |look| of_fruit(look, role.variant)))
        }
        OrganPart::FruitStalk => {
            species.fruit.as_ref().and_then(|look| look.stalk.as_deref()).or(species.stem.twig.as_deref())
        }
        OrganPart::Leaf | OrganPart::Petiole => None,
    };
    let own = match role.part {
        PlantPart::Organ(part) => of_organ(part),
        PlantPart::Wood(WoodPart::Twig) => species.stem.twig.as_deref(),
        PlantPart::Wood(WoodPart::Stem) => None,
    };
    match (own, role.part) {
        (Some(name), part) => (part, name),
        (None, PlantPart::Organ(OrganPart::Leaf | OrganPart::Petal | OrganPart::Sepal)) => {
            (OrganPart::Leaf.into(), species.leaf.material(role.variant))
        }
        (None, _) => (WoodPart::Stem.into(), &species.stem.material),
    }
}
