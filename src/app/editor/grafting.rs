//! A part of the plant that is dragged onto another branch and grows there.
//!
//! The branch is the one that is seen under the pointer, in front of others, or else the nearest within the reach of a finger. What the
//! part carries itself is left out, so that it does not hop onto its own twigs while it follows the pointer. Over no branch it
//! stays where it was last.

use super::Editor;
use crate::geom::polyline;
use crate::plant::Branch;
use crate::sketch::{Graft, PartName, PartPose};
use glam::{DVec2, Vec3};
use std::collections::HashSet;

impl Editor {
    /// Sets a part on the branch under a place in the window, physical pixels.
    pub(super) fn graft_part(&mut self, before: &PartPose, at: DVec2) {
        let Some(graft) = self.graft_at(before.part, at) else { return };
        self.pose([PartPose { graft: Some(graft), shift: Vec3::ZERO, ..*before }]);
    }

    /// Where on another branch a part would grow.
    fn graft_at(&self, part: PartName, at: DVec2) -> Option<Graft> {
        let forward = self.plant.forward()?;
        let seen = |branch| {
            let (away, place, radius) = self.seen_on(branch, at)?;
            let beside = (away - self.seen_length(place, radius)?).max(0.0);
            (away <= self.reach_at(place, radius)).then_some((branch, place, beside))
        };
        let nearer = |a: &(&Branch, Vec3, f64), b: &(&Branch, Vec3, f64)| {
            a.2.total_cmp(&b.2).then(a.1.dot(forward).total_cmp(&b.1.dot(forward)))
        };
        let (branch, place, _) = self.branches_for(part).into_iter().filter_map(seen).min_by(nearer)?;
        let (_, arc) = polyline::nearest(&branch.points, place)?;
        let length = polyline::length(&branch.points).max(f32::MIN_POSITIVE);
        let onto = self.built()?.names.of(branch.origin)?;
        Some(Graft { onto, at: (arc / length).clamp(0.0, 1.0) })
    }

    /// The branches that a part can be set on: those with a name that it does not carry. Drawn wood is set on drawn wood, as long as
    /// that was drawn, without what grew on from it.
    fn branches_for(&self, part: PartName) -> Vec<&Branch> {
        let Some(built) = self.built() else { return Vec::new() };
        let (plant, names) = (&built.plant, &built.names);
        let is_it = |branch: &Branch| names.of(branch.origin) == Some(part);
        let is_drawn = built.wood.branches(plant).any(|(_, branch)| is_it(branch));
        let wood: Vec<(usize, &Branch)> = match is_drawn {
            true => built.wood.branches(plant).collect(),
            false => plant.branches.iter().enumerate().collect(),
        };
        let (mut carried, mut free) = (HashSet::new(), Vec::new());
        for (index, branch) in wood {
            if is_it(branch) || branch.parent.is_some_and(|parent| carried.contains(&parent)) {
                carried.insert(index);
            } else if names.of(branch.origin).is_some() {
                free.push(branch);
            }
        }
        free
    }
}

#[cfg(test)]
#[path = "grafting_tests.rs"]
mod tests;
