//! The maker of roses: a plant from measured form, whose species opens its flowers.

use super::setup::Params;
use super::source::{Produced, Seed};
use crate::plant::{
    Blade, BladeForm, Branch, Detail, FlowerBud, FlowerBuds, Organ, OrganPart, Origin, Plant, RestSurface,
    Role, Shape, Template, TemplateId, WoodPart,
};
use crate::rose::{self, Leaf, RoseBud, RoseHabit, Season, Shrub};
use crate::species::Species;
use glam::{Vec2, Vec3};

/// A hip from its foot up: shares of its radius, and of its height, which is so many radii.
const HIP: [(f32, f32); 9] = [
    (0.0, 0.0),
    (0.5, 0.05),
    (0.88, 0.25),
    (1.0, 0.52),
    (0.86, 0.8),
    (0.5, 0.95),
    (0.42, 1.0),
    (0.2, 0.97),
    (0.0, 0.96),
];
const HIP_HEIGHT: f32 = 2.2;

/// Makes the rose of a seed.
pub(super) fn produce(seed: &Seed, habit: &RoseHabit, (species, params): (&Species, &Params)) -> Produced {
    let shrub = rose::shrub(habit, &Season::at(params.season.time), seed.number);
    let mut plant = Plant { branches: branches(&shrub.stems), ..Plant::default() };
    let buds = put_on(&mut plant, &shrub, species);
    Produced { plant, buds, obstacles: params.obstacle.beside(Vec3::ZERO), ..Produced::default() }
}

/// Puts leaves and hips of a rose on a plant that has its stems; its flower buds.
pub(super) fn put_on(plant: &mut Plant, shrub: &Shrub, species: &Species) -> FlowerBuds {
    let outline = Template::new(species.leaf.outline.points(), Vec::new(), 1.0, Detail::Reduced);
    let leaflet = plant.templates.add(outline);
    plant.organs.extend(shrub.leaves.iter().map(|leaf| whole_leaf(leaf, leaflet, species)));
    plant.organs.extend(shrub.buds.iter().filter_map(hip));
    plant.drop_unused_templates();
    FlowerBuds { buds: shrub.buds.iter().filter_map(bud).collect(), is_thinned: false }
}

/// Stems that nobody drew, as branches.
pub(super) fn branches(stems: &[rose::Stem]) -> Vec<Branch> {
    let branch = |stem: &rose::Stem| Branch {
        origin: Origin::Generated,
        parent: stem.parent,
        level: stem.order,
        points: stem.points.clone(),
        radii: stem.radii.clone(),
        role: Role::of(WoodPart::Stem),
    };
    stems.iter().map(branch).collect()
}

/// A leaf before it is divided: the species does that.
fn whole_leaf(leaf: &Leaf, template: TemplateId, species: &Species) -> Organ {
    let variant = match (leaf.is_young, leaf.is_coloured) {
        (_, true) => species.leaf.autumn_variant(),
        (true, false) => species.leaf.young_variant(),
        (false, false) => 0,
    };
    let (u, v) = (leaf.u * leaf.length, leaf.v * leaf.length);
    let (rest, form) = (RestSurface::Plane, BladeForm::default());
    Organ {
        role: Role { variant, ..Role::of(OrganPart::Leaf) },
        origin: Origin::Generated,
        branch: Some(leaf.stem),
        flower: None,
        shape: Shape::Blade(Blade { template, base: leaf.base, u, v, rest, form }),
    }
}

fn bud(bud: &RoseBud) -> Option<FlowerBud> {
    let u = bud.axis.any_orthonormal_vector() * bud.reach;
    let (branch, base, v) = (Some(bud.stem), bud.base, bud.axis * bud.reach);
    Some(FlowerBud { origin: Origin::Generated, branch, base, u, v, look: 0, open: bud.open? })
}

fn hip(bud: &RoseBud) -> Option<Organ> {
    let at = |(r, h): &(f32, f32)| Vec2::new(r * bud.hip, h * HIP_HEIGHT * bud.hip);
    (bud.hip > 0.0).then(|| Organ {
        role: Role::of(OrganPart::Fruit),
        origin: Origin::Generated,
        branch: Some(bud.stem),
        flower: None,
        shape: Shape::Lathe { base: bud.base, axis: bud.axis, profile: HIP.iter().map(at).collect() },
    })
}
