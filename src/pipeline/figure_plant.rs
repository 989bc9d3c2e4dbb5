//! What a grammar drew, as a plant: stems become branches, organs what the species has for them.

use super::stem_leaves;
use crate::grammar::{Figure, Item};
use crate::plant::{
    Blade, BladeForm, Branch, FlowerBud, FlowerBuds, Organ, OrganPart, Origin, Plant, RestSurface, Role,
    Shape, TemplateId, WoodPart,
};
use crate::species::Species;
use glam::Vec2;

/// How a fruit swells from its foot to its top: shares of its radius and of its height.
const FRUIT: [(f32, f32); 7] =
    [(0.0, 0.0), (0.45, 0.06), (0.85, 0.28), (1.0, 0.55), (0.85, 0.82), (0.4, 0.97), (0.0, 1.0)];
/// Height of a fruit in radii.
const FRUIT_HEIGHT: f32 = 2.2;

/// How the back of a receptacle swells to its rim: shares of the receptacle's radius and of the depth.
const BACK: [(f32, f32); 6] = [(0.0, 0.0), (0.3, 0.04), (0.72, 0.35), (1.0, 0.75), (1.08, 1.0), (0.0, 1.0)];
/// How deep it is, in radii.
const BACK_DEPTH: f32 = 0.4;

/// The plant of a figure, and its flower buds.
pub(super) fn plant_of(figure: &Figure, species: &Species) -> (Plant, FlowerBuds) {
    let mut plant = Plant { branches: branches(figure), ..Plant::default() };
    let leaves = figure.items.iter().filter(|item| matches!(&*item.name, "leaf" | "bract")).count();
    let template = stem_leaves::template(&mut plant, species, leaves);
    plant.organs = figure.items.iter().flat_map(|item| organs(item, template)).collect();
    plant.drop_unused_templates();
    let looks = species.looks_of_florets();
    let buds = figure.items.iter().filter_map(|item| bud(item, &looks)).collect();
    (plant, FlowerBuds { buds, is_thinned: false })
}

fn branches(figure: &Figure) -> Vec<Branch> {
    let mut branches: Vec<Branch> = Vec::with_capacity(figure.stems.len());
    for stem in &figure.stems {
        let level = stem.parent.map_or(0, |parent| branches[parent].level + 1);
        let (points, radii, role) = (stem.points.clone(), stem.radii.clone(), Role::of(WoodPart::Stem));
        branches.push(Branch { origin: Origin::Generated, parent: stem.parent, level, points, radii, role });
    }
    branches
}

/// The bud of a flower, of the first of these looks, or of a ray, of the second.
fn bud(item: &Item, looks: &[usize]) -> Option<FlowerBud> {
    let look = match &*item.name {
        "flower" => *looks.first()?,
        "ray" => *looks.get(1).or(looks.first())?,
        _ => return None,
    };
    let size = item.args[1] * item.scale;
    let (base, u, v) = (item.origin, item.left * size, item.heading * size);
    (size > 0.0).then_some(FlowerBud {
        origin: Origin::Generated,
        branch: item.stem,
        base,
        u,
        v,
        look,
        open: item.args[0].clamp(0.0, 1.0),
    })
}

/// What an item is: one organ, of a receptacle also its green back; nothing where its name or size says nothing.
fn organs(item: &Item, template: TemplateId) -> impl Iterator<Item = Organ> {
    let organ = |(part, shape)| Organ {
        role: Role::of(part),
        origin: Origin::Generated,
        branch: item.stem,
        flower: None,
        shape,
    };
    shape(item, template).into_iter().chain(back(item)).map(organ)
}

/// The back of a receptacle, which swells from the stalk to beyond the rim, where bracts and rays begin.
fn back(item: &Item) -> Option<(OrganPart, Shape)> {
    let radius = *item.args.first()? * item.scale;
    let shape = || {
        let profile = BACK.map(|(r, h)| radius * Vec2::new(r, BACK_DEPTH * h)).to_vec();
        let base = item.origin - item.heading * (BACK_DEPTH * radius);
        (OrganPart::Cup, Shape::Lathe { base, axis: item.heading, profile })
    };
    (&*item.name == "receptacle" && radius > 0.0).then(shape)
}

fn shape(item: &Item, template: TemplateId) -> Option<(OrganPart, Shape)> {
    let size = |k: usize| item.args.get(k).map_or(0.0, |size| size * item.scale);
    let (base, axis) = (item.origin, item.heading);
    let lathe = |profile: Vec<Vec2>| Shape::Lathe { base, axis, profile };
    Some(match &*item.name {
        "leaf" | "bract" if size(0) > 0.0 => {
            let (u, v) = (-item.left * size(0), item.heading * size(0));
            let (rest, form) = (RestSurface::Plane, BladeForm::default());
            (OrganPart::Leaf, Shape::Blade(Blade { template, base, u, v, rest, form }))
        }
        "receptacle" if size(0) > 0.0 => (
            OrganPart::Disc,
            Shape::Dome { base, axis, radius: size(0), height: size(1).max(0.02 * size(0)) },
        ),
        "fruit" | "@ball" if size(0) > 0.0 => {
            let at = |(r, h): &(f32, f32)| Vec2::new(r * size(0), h * FRUIT_HEIGHT * size(0));
            (OrganPart::Fruit, lathe(FRUIT.iter().map(at).collect()))
        }
        "@cylinder" if size(0) > 0.0 && size(1) > 0.0 => {
            let (radius, length) = (size(0), size(1));
            let profile = [(0.0, 0.0), (radius, 0.0), (radius, length), (0.0, length)];
            (OrganPart::Fruit, lathe(profile.map(Vec2::from).to_vec()))
        }
        _ => return None,
    })
}
