//! Leaves, flowers, fruits and pots turned, moved, made larger and taken away by the artist.
//!
//! They are posed when the species has given the plant its looks: so all else stays as it was, to the last bit, and a flower is
//! moved with its disc and sepals, a compound leaf with its leaflets. What was drawn or grew with a name is found again by
//! that. A leaf turns about the place that its stalk stands on, slides along its stem, and goes with that where it was posed;
//! a petal turns in its flower. Grafted, it stands on another branch; a copy of another takes its place where the artist wants that.
//!
//! Limits: organs are not bent, and nothing keeps them from passing through others. Of a flower that stands on no drawn or
//! grown part, as those of built-in inflorescences, there is no name.

use super::graft::GraftPlaces;
use super::organ_group::OrganGroup;
use super::part_names::PartNames;
use super::poses::{PartFrame, Posed};
use super::replace::replace;
use crate::plant::{FlowerBuds, Motion, Organ, Plant};
use crate::sketch::{PartName, PartPose};
use std::collections::{HashMap, HashSet};

/// Poses organs, and takes away those that are cut off. `scale` is what a pixel of the canvas is, metres. Poses that are left in
/// `poses` are of no organ of the plant.
pub fn pose_organs(
    plant: &mut Plant,
    (names, poses, scale): (&PartNames, &mut Vec<PartPose>, f32),
    posed: &mut Posed,
) {
    if poses.is_empty() {
        return;
    }
    let pose_of: HashMap<PartName, PartPose> = poses.iter().map(|pose| (pose.part, *pose)).collect();
    let patterns: HashSet<PartName> = poses.iter().filter_map(|pose| pose.like).collect();
    let is_wanted = |name| pose_of.contains_key(&name) || patterns.contains(&name);
    let groups = OrganGroup::all(plant, names, is_wanted);
    poses.retain(|pose| groups.iter().all(|group| group.name != pose.part));
    let is_any_grafted = pose_of.values().any(|pose| pose.graft.is_some());
    let places = is_any_grafted.then(|| GraftPlaces::new(plant, names, &[]));
    for group in &groups {
        let Some(pose) = pose_of.get(&group.name) else { continue };
        let parent_turn = group.parent_turn(plant, names, posed);
        let graft = places.as_ref().and_then(|places| group.graft(plant, places, pose));
        let (motion, frame) = group.posed(plant, parent_turn, (pose, graft.as_ref()), scale);
        group.move_by(plant, &motion);
        graft.iter().for_each(|graft| group.stand_on(plant, graft.branch));
        posed.resting += usize::from(pose.graft.is_some() && graft.is_none());
        if group.is_flower {
            let petals = groups.iter().filter(|petal| !petal.is_flower && petal.flower == group.flower);
            for petal in petals {
                posed.organs.entry(petal.name).and_modify(|petal| *petal = moved(petal, &motion));
            }
        }
        posed.organs.insert(group.name, frame);
    }
    let (replaced, resting) = replace(plant, &groups, &pose_of);
    posed.resting += resting;
    let is_cut = |group: &&OrganGroup| pose_of.get(&group.name).is_some_and(|pose| pose.is_cut);
    take_away(plant, groups.iter().filter(is_cut).chain(&replaced));
    if is_any_grafted {
        plant.put_parents_first(&mut FlowerBuds::default());
    }
    debug_assert_eq!(plant.check_invariants(), Ok(()));
}

/// The frame of a petal in a flower that is moved.
fn moved(petal: &PartFrame, by: &Motion) -> PartFrame {
    let (stood, parent_turn, foot) =
        (by.point(petal.stood), by.turn * petal.parent_turn, by.turn * petal.foot);
    PartFrame { stood, parent_turn, foot }
}

fn take_away<'a>(plant: &mut Plant, groups: impl Iterator<Item = &'a OrganGroup>) {
    let mut organs = vec![true; plant.organs.len()];
    let mut flowers = vec![true; plant.flowers.len()];
    let mut branches = vec![true; plant.branches.len()];
    let mut is_any = false;
    for group in groups {
        is_any = true;
        group.organs.iter().for_each(|organ| organs[*organ] = false);
        group.flower.filter(|_| group.is_flower).into_iter().for_each(|flower| flowers[flower] = false);
        group.stalk.into_iter().for_each(|stalk| branches[stalk] = false);
    }
    if is_any {
        // Thorns of a stalk go with it.
        let stands = |organ: &Organ| organ.branch.is_none_or(|branch| branches[branch]);
        organs.iter_mut().zip(&plant.organs).for_each(|(stays, organ)| *stays &= stands(organ));
        plant.keep_organs(&organs, &flowers);
        plant.keep_branches(&branches);
    }
}
