//! Compound leaves of a plant: each leaf that nobody drew becomes leaflets on a rachis where its species says so.
//!
//! A leaf's own outline becomes that of its leaflets, its length that of the whole. So it is for roses, for plants that grow, and for
//! the leaves that fill drawn outlines.
//!
//! Limits: drawn leaves stay as they are. Where leaves are very many their stalks are left out.

use super::looks::LeafLook;
use crate::leaf::compound::{Compound, LeafPose, Leaflet};
use crate::plant::{Blade, Organ, OrganKind, OrganPart, Plant, RestSurface, Role, Shape};
use crate::random::stream;
use glam::{Vec2, Vec3};
use rand::RngExt;

/// Leaves up to which stalks are made.
const MOST_STALKS: usize = 1500;

/// Divides the leaves of a plant.
pub(super) fn divide(plant: &mut Plant, look: &LeafLook, seed: u64) {
    let Some(compound) = &look.compound else { return };
    let is_whole = |organ: &Organ| {
        let is_flat = matches!(&organ.shape, Shape::Blade(blade) if blade.rest == RestSurface::Plane);
        organ.kind() == OrganKind::Leaf && !organ.origin.is_drawn() && organ.flower.is_none() && is_flat
    };
    let has_stalks = plant.organs.iter().filter(|organ| is_whole(organ)).count() <= MOST_STALKS;
    let organs = std::mem::take(&mut plant.organs);
    for organ in organs {
        match &organ.shape {
            Shape::Blade(blade) if is_whole(&organ) => {
                let length = plant.templates[blade.template].length();
                divide_leaf(&mut plant.organs, &organ, (blade, length), (compound, has_stalks), seed);
            }
            _ => plant.organs.push(organ),
        }
    }
}

fn divide_leaf(
    out: &mut Vec<Organ>,
    whole: &Organ,
    (blade, template_length): (&Blade, f32),
    (compound, has_stalks): (&Compound, bool),
    seed: u64,
) {
    let (Some(v), Some(face)) = (blade.v.try_normalize(), blade.u.cross(blade.v).try_normalize()) else {
        return;
    };
    let pose = LeafPose { base: blade.base, u: v.cross(face), v, length: template_length * blade.v.length() };
    let chance = stream(seed, "leaflets", name_of(blade.base)).random_range(0.0..1.0f32);
    let parts = compound.leaf(&pose, compound.count(chance));
    let organ = |part, shape| Organ { role: Role { part, ..whole.role }, shape, ..whole.clone() };
    if has_stalks {
        let shape = Shape::Filament { points: parts.rachis, radius: parts.radius, head: Vec2::ZERO };
        out.push(organ(OrganPart::Petiole, shape));
    }
    let leaflet = |Leaflet { base, u, v }: Leaflet| {
        let (u, v) = (u / template_length, v / template_length);
        organ(OrganPart::Leaf, Shape::Blade(Blade { base, u, v, ..blade.clone() }))
    };
    out.extend(parts.leaflets.into_iter().chain(parts.stipules).map(leaflet));
}

/// What tells a leaf from others, whatever their number: its place to a tenth of a millimetre.
fn name_of(place: Vec3) -> u64 {
    let mixed = |key: u64, x: f32| crate::random::mix(key, (x * 1e4).round() as i64 as u64);
    place.to_array().into_iter().fold(1, mixed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{BladeForm, Detail, Origin, Provenance, Template};

    fn plant(origin: Origin) -> Plant {
        let outline = vec![Vec2::ZERO, Vec2::new(0.3, 0.5), Vec2::Y, Vec2::new(-0.3, 0.5)];
        let mut plant = Plant::default();
        let template = plant.templates.add(Template::new(outline, Vec::new(), 1.0, Detail::Reduced));
        let (rest, form) = (RestSurface::Plane, BladeForm::default());
        let blade = Blade { template, base: Vec3::Y, u: Vec3::X * 0.1, v: Vec3::Y * 0.1, rest, form };
        let role = Role::of(OrganPart::Leaf);
        plant.organs.push(Organ { role, origin, branch: None, flower: None, shape: Shape::Blade(blade) });
        plant
    }

    fn look() -> LeafLook {
        toml::from_str("materials = \"leaf\"\ncompound = { leaflets = [5] }").unwrap()
    }

    #[test]
    fn a_leaf_becomes_a_rachis_and_its_leaflets() {
        let mut plant = plant(Origin::Generated);
        divide(&mut plant, &look(), 1);
        let kinds: Vec<OrganKind> = plant.organs.iter().map(Organ::kind).collect();
        assert_eq!(kinds.iter().filter(|kind| **kind == OrganKind::Leaf).count(), 5);
        assert_eq!(kinds[0], OrganKind::Petiole);
        assert_eq!(plant.check_invariants(), Ok(()));
    }

    #[test]
    fn drawn_leaves_and_leaves_of_other_species_stay() {
        let drawn = plant(Provenance::default().record(Some(1)));
        let mut divided = drawn.clone();
        divide(&mut divided, &look(), 1);
        assert_eq!(divided, drawn);
        let mut simple = plant(Origin::Generated);
        divide(&mut simple, &toml::from_str("materials = \"leaf\"").unwrap(), 1);
        assert_eq!(simple, plant(Origin::Generated));
    }
}
