//! Branches that the artist cut off.

use super::joint::Joint;
use crate::plant::{Cut, FlowerBuds, Plant};
use std::collections::HashMap;

/// Cuts off branches with all that stands on them. Of a bush each stem is cut by itself, although they stand on the first.
pub(super) fn cut_off(plant: &mut Plant, buds: &mut FlowerBuds, joints: &HashMap<usize, Vec<Joint>>) {
    let first_cut = |index: &usize| joints.get(index)?.iter().find(|joint| joint.pose.is_cut);
    let cut_of = |index: usize| match first_cut(&index) {
        None => Cut::Whole,
        Some(joint) if joint.arc > 0.0 => Cut::At(joint.arc),
        Some(_) => Cut::Gone,
    };
    let mut cuts: Vec<Cut> = (0..plant.branches.len()).map(cut_of).collect();
    if cuts.iter().all(|cut| *cut == Cut::Whole) {
        return;
    }
    let mut first_left: HashMap<usize, usize> = HashMap::new();
    for index in 0..plant.branches.len() {
        let branch = &plant.branches[index];
        let base = branch.points.first().copied().unwrap_or_default();
        let parent = branch.parent.filter(|_| !plant.is_held(&cuts, branch.parent, base));
        let Some(parent) = parent.filter(|_| cuts[index] != Cut::Gone) else { continue };
        if branch.is_basal_stem() {
            plant.branches[index].parent = first_left.get(&parent).copied();
            first_left.entry(parent).or_insert(index);
        } else {
            cuts[index] = Cut::Gone;
        }
    }
    plant.cut(buds, &cuts, |_| true);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{Branch, Origin, Role, WoodPart};
    use crate::sketch::{PartName, PartPose};
    use glam::Vec3;

    fn branch(foot: Vec3, parent: Option<usize>, level: u32) -> Branch {
        let (points, radii) = (vec![foot, foot + Vec3::Y], vec![0.01; 2]);
        Branch { origin: Origin::Generated, parent, level, points, radii, role: Role::of(WoodPart::Stem) }
    }

    #[test]
    fn stems_of_a_bush_are_cut_by_themselves() {
        // A stem with a twig, and two more that stand on its base.
        let twig = branch(Vec3::Y * 0.5, Some(0), 1);
        let stems = [0.0, 0.1, 0.2].map(|z| branch(Vec3::Z * z, (z > 0.0).then_some(0), 0));
        let [first, second, third] = stems;
        let branches = vec![first, twig, second.clone(), third.clone()];
        let mut plant = Plant { branches, ..Plant::default() };
        plant.check_invariants().unwrap();
        let pose = PartPose { is_cut: true, ..PartPose::still(PartName::Grown(1)) };
        let joints = HashMap::from([(0, vec![Joint { arc: 0.0, pose }])]);
        cut_off(&mut plant, &mut FlowerBuds::default(), &joints);
        assert_eq!(plant.branches, [Branch { parent: None, ..second }, third]);
    }
}
