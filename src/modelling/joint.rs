//! Where the wood of a plant is posed: each pose finds its branch by its name.
//!
//! Most poses are of a branch from its base on. One of a branch that runs on in the line of another is at the place there where
//! it begins.

use super::part_names::PartNames;
use crate::geom::polyline;
use crate::plant::{Continued, Plant};
use crate::sketch::{PartName, PartPose};
use std::collections::HashMap;

/// A pose at a place of a branch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Joint {
    /// How far from the branch's base, metres.
    pub(super) arc: f32,
    /// The pose of what is beyond.
    pub(super) pose: PartPose,
}

/// The poses of each branch, from its base to its end; those that are of one are taken out of the list.
pub(super) fn joints(
    plant: &Plant,
    names: &PartNames,
    continued: &[Continued],
    poses: &mut Vec<PartPose>,
) -> HashMap<usize, Vec<Joint>> {
    let mut pose_of: HashMap<PartName, PartPose> = poses.iter().map(|pose| (pose.part, *pose)).collect();
    let mut joints: HashMap<usize, Vec<Joint>> = HashMap::new();
    for (index, branch) in plant.branches.iter().enumerate() {
        let pose = names.of(branch.origin).and_then(|name| pose_of.remove(&name));
        pose.into_iter().for_each(|pose| joints.entry(index).or_default().push(Joint { arc: 0.0, pose }));
    }
    for Continued { name, branch, from } in continued {
        let Some(pose) = pose_of.remove(&PartName::Grown(name.0)) else { continue };
        let arc = polyline::nearest(&plant.branches[*branch].points, *from).map_or(0.0, |(_, arc)| arc);
        joints.entry(*branch).or_default().push(Joint { arc, pose });
    }
    joints.values_mut().for_each(|joints| joints.sort_by(|a, b| a.arc.total_cmp(&b.arc)));
    poses.retain(|pose| pose_of.contains_key(&pose.part));
    joints
}
