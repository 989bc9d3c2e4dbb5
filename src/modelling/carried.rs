//! Leaves, flowers and buds moved with the branches that they grow on.

use crate::plant::{FlowerBuds, Motion, Plant};
use glam::Vec3;

/// Moves flowers, and all organs with the place that they grow on; those of flowers with their flower. `motion` says how the place
/// of a branch that is nearest to a point was moved, and nothing of branches that stay.
pub(super) fn move_organs(plant: &mut Plant, motion: impl Fn(usize, Vec3) -> Option<Motion>) {
    let on = |branch: Option<usize>, at: Vec3| motion(branch?, at);
    let motions: Vec<Option<Motion>> =
        plant.flowers.iter().map(|flower| on(flower.branch, flower.cone.apex)).collect();
    for (flower, motion) in plant.flowers.iter_mut().zip(&motions) {
        motion.iter().for_each(|motion| flower.move_by(motion));
    }
    for organ in &mut plant.organs {
        let of_flower = organ.flower.map(|flower| motions[flower]);
        let motion = of_flower.unwrap_or_else(|| on(organ.branch, organ.base()));
        motion.iter().for_each(|motion| organ.move_by(motion));
    }
}

/// Moves buds of flowers in the same way.
pub(super) fn move_buds(buds: &mut FlowerBuds, motion: impl Fn(usize, Vec3) -> Option<Motion>) {
    for bud in &mut buds.buds {
        let motion = bud.branch.and_then(|branch| motion(branch, bud.base));
        motion.iter().for_each(|motion| bud.move_by(motion));
    }
}
