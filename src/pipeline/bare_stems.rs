//! A drawing of bare stems gets what its species has on them: a rose its leaves, prickles and flowers, any species with full
//! flowers a flower at each end. A pot under them is no part of the plant.
//!
//! Limits: whoever draws a leaf, a flower or anything else on the stems means what is drawn, and gets no more than that.
//! Inflorescences do not come to drawn stems.

use super::rose::{branches, put_on};
use super::setup::Params;
use crate::plant::{Branch, FlowerBud, FlowerBuds, GrownId, Organ, OrganKind, Origin, Plant, Provenance};
use crate::random::Choice;
use crate::rose::{DrawnStem, RoseHabit, Season, on_stems};
use crate::species::Species;
use glam::Vec3;

/// How much of a flower's direction is that of its stem; the rest is toward the viewer.
const OF_STEM: f32 = 0.7;

/// Adds what the species has on stems where nothing but stems was drawn; the buds of its flowers.
pub(super) fn furnish(
    (plant, provenance): (&mut Plant, &Provenance),
    (species, params): (&Species, &Params),
    seed: u64,
) -> FlowerBuds {
    let is_beside = |organ: &Organ| organ.kind() == OrganKind::Pot;
    let is_bare =
        plant.flowers.is_empty() && !plant.branches.is_empty() && plant.organs.iter().all(is_beside);
    if !is_bare || plant.branches.iter().any(|branch| branch.points.len() < 2) {
        return FlowerBuds::default();
    }
    match &params.rose {
        Some(habit) => rose(plant, (habit, &Season::at(params.season.time)), species, seed),
        None => flowers_at_ends((plant, provenance), species, params),
    }
}

fn rose(plant: &mut Plant, of: (&RoseHabit, &Season), species: &Species, seed: u64) -> FlowerBuds {
    let stems: Vec<DrawnStem<'_>> = plant
        .branches
        .iter()
        .map(|branch| DrawnStem {
            parent: branch.parent,
            order: branch.level,
            points: &branch.points,
            radii: &branch.radii,
        })
        .collect();
    let shrub = on_stems(of, &stems, seed);
    plant.branches.extend(branches(&shrub.stems[plant.branches.len()..]));
    put_on(plant, &shrub, species)
}

/// A bud of the species' first full flower at each end.
fn flowers_at_ends(
    (plant, provenance): (&Plant, &Provenance),
    species: &Species,
    params: &Params,
) -> FlowerBuds {
    let look = species.looks_of_drawn().into_iter().find(|look| species.flowers[*look].layers.is_some());
    let Some(look) = look.filter(|_| species.inflorescence.is_none()) else { return FlowerBuds::default() };
    let reach = params.flower.bloom.reach;
    let bud = |(index, branch): (usize, &Branch)| {
        let [.., before, end] = branch.points.as_slice() else { return None };
        let along = (*end - *before).try_normalize()?;
        let axis = (along * OF_STEM + Vec3::Z * (1.0 - OF_STEM)).try_normalize()?;
        let u = axis.any_orthonormal_vector() * reach;
        let name = |stroke| Origin::Grown(GrownId(Choice::NAME_OF_FLOWER.key(stroke)));
        let origin = provenance.stroke(branch.origin).map_or(Origin::Generated, name);
        Some(FlowerBud { origin, branch: Some(index), base: *end, u, v: axis * reach, look, open: 1.0 })
    };
    FlowerBuds { buds: plant.branches.iter().enumerate().filter_map(bud).collect(), is_thinned: false }
}
