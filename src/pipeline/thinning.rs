//! Plants with fewer leaves, flowers and twigs.
//!
//! What may go is foliage, in pieces: a leaf that nobody drew, a flower of which nothing was drawn. All flowers on one receptacle, as
//! those of a daisy, are one flower with it and its bracts. A share of all goes evenly, so that as few flowers as there are on a rose
//! lose that share, too; leaves and small flowers that stay are larger, so that they cover about what all did.

use crate::geom::polyline;
use crate::plant::{Blade, Detail, FinishedPlant, Motion, Organ, OrganKind, OrganPart, Plant, Shape};
use crate::random::{mix, unit};
use glam::{Quat, Vec3};
use std::collections::{BTreeMap, BTreeSet};

/// How much larger leaves and small flowers become at most.
const LARGER: f32 = 2.0;
/// How far from the middle of a receptacle its flowers and bracts stand, in its radii.
const AROUND: f32 = 1.25;

/// A piece of foliage.
#[derive(Clone, Copy, Debug)]
struct Piece {
    is_flower: bool,
    /// Where the petals of a small flower meet, from where it becomes larger; large ones keep their size.
    middle: Option<Vec3>,
    /// From 0 to 1: of a share of all those go whose number is not below it.
    order: f32,
}

/// The foliage of a plant.
pub(super) struct Foliage {
    /// The piece that each organ belongs to; none for what stays.
    of_organ: Vec<Option<Piece>>,
    /// How many flowers there are.
    pub(super) flowers: usize,
    /// How many leaves and stalks of leaves there are.
    pub(super) leaves: usize,
}

impl Foliage {
    pub(super) fn of(plant: &Plant) -> Self {
        let flowers = flowers(plant);
        let known: BTreeSet<usize> = flowers.iter().copied().flatten().collect();
        let mut sorted: Vec<usize> = known.into_iter().collect();
        sorted.sort_by_key(|flower| mix(1, *flower as u64));
        let rank: BTreeMap<usize, usize> =
            sorted.iter().enumerate().map(|(rank, flower)| (*flower, rank)).collect();
        let small = small_flowers(plant);
        let middle_of = |flower: usize| (*small.get(flower)?).then(|| plant.flowers[flower].cone.apex);
        let piece = |(index, organ): (usize, &Organ)| {
            if let Some(flower) = flowers[index] {
                let order = rank[&flower] as f32 / rank.len() as f32;
                return Some(Piece { is_flower: true, middle: middle_of(flower), order });
            }
            let is_leaf = matches!(organ.kind(), OrganKind::Leaf | OrganKind::Petiole);
            (is_leaf && organ.flower.is_none() && !organ.origin.is_drawn()).then(|| Piece {
                is_flower: false,
                middle: None,
                order: unit(mix(2, index as u64)),
            })
        };
        let of_organ: Vec<Option<Piece>> = plant.organs.iter().enumerate().map(piece).collect();
        let leaves = of_organ.iter().flatten().filter(|piece| !piece.is_flower).count();
        Self { of_organ, flowers: rank.len(), leaves }
    }

    /// The organs of flowers.
    pub(super) fn of_flowers<'a>(&self, plant: &'a Plant) -> impl Iterator<Item = &'a Organ> {
        let organs = plant.organs.iter().zip(&self.of_organ);
        organs.filter(|(_, piece)| piece.is_some_and(|piece| piece.is_flower)).map(|(organ, _)| organ)
    }
}

/// For each flower whether it is small: one of very many, whose petals are of reduced detail.
fn small_flowers(plant: &Plant) -> Vec<bool> {
    let mut small = vec![false; plant.flowers.len()];
    for organ in &plant.organs {
        if let (Some(flower), Shape::Blade(blade)) = (organ.flower, &organ.shape) {
            small[flower] |= plant.templates[blade.template].detail() == Detail::Reduced
                && organ.kind() == OrganKind::Petal;
        }
    }
    small
}

/// A receptacle with several flowers.
struct Head {
    /// Its own number among the organs.
    organ: usize,
    base: Vec3,
    reach: f32,
}

/// The heads on each branch.
fn heads(plant: &Plant) -> BTreeMap<usize, Vec<Head>> {
    let mut heads: BTreeMap<usize, Vec<Head>> = BTreeMap::new();
    for (index, organ) in plant.organs.iter().enumerate() {
        let (Some(branch), None, Shape::Dome { base, radius, height, .. }) =
            (organ.branch, organ.flower, &organ.shape)
        else {
            continue;
        };
        if organ.kind() == OrganKind::Receptacle && !organ.origin.is_drawn() {
            let reach = AROUND * radius.max(*height);
            heads.entry(branch).or_default().push(Head { organ: index, base: *base, reach });
        }
    }
    for (branch, heads) in &mut heads {
        let flowers = plant.flowers.iter().filter(|flower| flower.branch == Some(*branch));
        let seats: Vec<Vec3> = flowers.map(|flower| flower.cone.apex).collect();
        heads.retain(|head| seats.iter().filter(|seat| seat.distance(head.base) < head.reach).count() > 1);
    }
    heads
}

/// The flower that each organ belongs to, by a number of its own; none where any of it was drawn.
fn flowers(plant: &Plant) -> Vec<Option<usize>> {
    let heads = heads(plant);
    let head_at = |branch: Option<usize>, at: Vec3| {
        let here = heads.get(&branch?)?;
        here.iter().find(|head| at.distance(head.base) < head.reach).map(|head| head.organ)
    };
    // A head has the number of its organ behind those of the flowers.
    let first_head = plant.flowers.len();
    let flower_of = |organ: &Organ| match organ.flower {
        Some(index) => {
            let flower = &plant.flowers[index];
            Some(head_at(flower.branch, flower.cone.apex).map_or(index, |head| first_head + head))
        }
        None => head_at(organ.branch, organ.base()).map(|head| first_head + head),
    };
    let mut flowers: Vec<Option<usize>> = plant.organs.iter().map(flower_of).collect();
    let drawn = plant.organs.iter().zip(&flowers).filter(|(organ, _)| organ.origin.is_drawn());
    let drawn: BTreeSet<usize> = drawn.filter_map(|(_, flower)| *flower).collect();
    flowers.iter_mut().for_each(|flower| *flower = flower.filter(|flower| !drawn.contains(flower)));
    flowers
}

/// The plant with such shares of its leaves and of its flowers; of flowers at least one, unless the share is 0.
pub(super) fn thinned(plant: &FinishedPlant, [leaves, flowers]: [f32; 2]) -> FinishedPlant {
    let larger = |share: f32| share.max(f32::MIN_POSITIVE).powf(-0.5).min(LARGER);
    let mut pieces = Foliage::of(plant).of_organ.into_iter();
    let mut plant = plant.clone();
    plant.reshape(|plant| {
        plant.organs.retain_mut(|organ| {
            let Some(Piece { is_flower, middle, order }) = pieces.next().flatten() else { return true };
            let share = if is_flower { flowers } else { leaves };
            match (&mut organ.shape, middle) {
                (Shape::Blade(Blade { u, v, .. }) | Shape::Card { u, v, .. }, _) if !is_flower => {
                    (*u, *v) = (*u * larger(share), *v * larger(share));
                }
                (_, Some(from)) => {
                    organ.move_by(&Motion { turn: Quat::IDENTITY, from, to: from, size: larger(share) });
                }
                _ => {}
            }
            order < share
        });
        plant.drop_unused_templates();
    });
    plant
}

/// The plant without the stamens and styles of small flowers.
pub(super) fn without_stamens(plant: &FinishedPlant) -> FinishedPlant {
    let small = small_flowers(plant);
    let goes = |organ: &Organ| {
        let is_of_small = organ.flower.is_some_and(|flower| small[flower]);
        is_of_small && matches!(organ.shape, Shape::Filament { .. }) && !organ.origin.is_drawn()
    };
    without(plant, plant.organs.iter().map(goes))
}

/// The plant with such a share of the thorns that nobody drew.
pub(super) fn with_thorns(plant: &FinishedPlant, share: f32) -> FinishedPlant {
    let goes = |(index, organ): (u64, &Organ)| {
        organ.kind() == OrganKind::Thorn && !organ.origin.is_drawn() && unit(mix(3, index)) >= share
    };
    without(plant, (0..).zip(&plant.organs).map(goes))
}

/// The plant with such a share of the fruits that nobody drew, each with its stalk, which stands before it.
pub(super) fn with_fruits(plant: &FinishedPlant, share: f32) -> FinishedPlant {
    let mut number = 0;
    let mut is_on_stalk = false;
    let goes = |organ: &Organ| {
        let is_stalk = organ.role.part == OrganPart::FruitStalk;
        number += u64::from(is_stalk || !is_on_stalk);
        is_on_stalk = is_stalk;
        organ.kind() == OrganKind::Fruit && !organ.origin.is_drawn() && unit(mix(4, number)) >= share
    };
    without(plant, plant.organs.iter().map(goes))
}

/// The plant without the organs that go.
fn without(plant: &FinishedPlant, goes: impl Iterator<Item = bool>) -> FinishedPlant {
    let goes: Vec<bool> = goes.collect();
    let mut plant = plant.clone();
    plant.reshape(|plant| {
        let mut goes = goes.into_iter();
        plant.organs.retain(|_| !goes.next().unwrap_or(false));
    });
    plant
}

/// What happens to what stands on twigs that go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OnTwigs {
    /// It stays where it is.
    Stays,
    /// It goes with them; twigs with flowers stay.
    Goes,
}

/// The plant with such a share of its branches: the thinnest that nobody drew are gone, of equally thin ones the shortest. The
/// thickest always stays.
pub(super) fn without_twigs(plant: &FinishedPlant, share: f32, on_twigs: OnTwigs) -> FinishedPlant {
    let size = |i: usize| {
        let branch = &plant.branches[i];
        (branch.radii.first().copied().unwrap_or(0.0), polyline::length(&branch.points))
    };
    let mut order: Vec<(usize, (f32, f32))> = (0..plant.branches.len()).map(|i| (i, size(i))).collect();
    order.sort_by(|(_, a), (_, b)| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut kept = vec![true; order.len()];
    let dropped = ((1.0 - share) * order.len() as f32) as usize;
    for (i, _) in &order[..dropped.min(order.len().saturating_sub(1))] {
        kept[*i] = plant.branches[*i].origin.is_drawn();
    }
    if on_twigs == OnTwigs::Goes {
        let of_flowers = Foliage::of(plant);
        let flowering = of_flowers.of_flowers(plant).filter_map(|organ| organ.branch);
        flowering.for_each(|branch| kept[branch] = true);
    }
    for (i, branch) in plant.branches.iter().enumerate().rev() {
        if let (true, Some(parent)) = (kept[i], branch.parent) {
            kept[parent] = true;
        }
    }
    let mut plant = plant.clone();
    plant.reshape(|plant| {
        if on_twigs == OnTwigs::Goes {
            let stands = |organ: &Organ| organ.branch.is_none_or(|branch| kept[branch]);
            plant.organs.retain(|organ| organ.origin.is_drawn() || stands(organ));
            plant.drop_unused_templates();
        }
        plant.keep_branches(&kept);
    });
    plant
}
