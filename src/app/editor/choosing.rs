//! Which parts of the plant are chosen to be posed: one by a tap, several by a loop that is drawn around them.
//!
//! Of wood in the loop the lowest branches are chosen, which take along all that they carry; a branch counts as inside with most of
//! its line. Leaves, flowers, fruits and pots are chosen by their middle where they stand on wood that is not, and petals where their
//! flower is not. With Shift they come to those that are chosen. What is hidden is chosen, too: the loop goes through the plant.
//!
//! What is done then is done to all of them, as one step: each turns, bends and moves about its own base as the one that is held
//! does. Only a graft moves that one alone.

use super::Editor;
use super::posable::Part;
use super::pose_tool::Held;
use crate::geom::region::Region;
use crate::modelling::OrganGroup;
use crate::plant::{Branch, FinishedPlant, Shape};
use crate::sketch::part_poses::{PartPose, pose_of, posed};
use crate::sketch::{Change, PartName, PartPoses};
use glam::{DVec2, Vec2, Vec3};
use std::collections::HashSet;

/// Shortest step of a loop, points.
const STEP: f64 = 1.5;
/// Fewest places of a loop; one of fewer is a tap.
const FEWEST: usize = 4;
/// Share of a branch's points that must lie inside.
const MOST_INSIDE: f32 = 0.75;

impl Editor {
    /// The parts that are chosen, first the one whose ring is shown.
    pub(super) fn chosen_parts(&self) -> impl Iterator<Item = PartName> {
        self.posing.last.into_iter().chain(self.posing.others.iter().copied())
    }

    /// The pose of the part that was chosen last.
    pub(super) fn chosen_pose(&self) -> Option<PartPose> {
        self.posing.last.map(|part| pose_of(&self.sketch().part_poses, part))
    }

    /// Chooses a part: with `besides` it comes to those that are chosen, or goes from them.
    pub(super) fn choose_part(&mut self, part: PartName, besides: bool) {
        if !besides {
            self.posing.others.clear();
        } else if self.posing.others.contains(&part) {
            return self.posing.others.retain(|other| *other != part);
        } else if self.posing.last == Some(part) {
            self.posing.last = self.posing.others.pop();
            return;
        } else {
            self.posing.others.extend(self.posing.last);
        }
        self.posing.last = Some(part);
    }

    /// Gives all parts that are chosen another pose, as one step by itself or as one with what came right before.
    pub(super) fn pose_chosen(&mut self, other: impl Fn(PartPose) -> PartPose) {
        let known = &self.sketch().part_poses;
        let poses: Vec<PartPose> = self.chosen_parts().map(|part| other(pose_of(known, part))).collect();
        self.pose(poses);
    }

    /// Gives parts other poses; one drag is one step.
    pub(super) fn pose(&mut self, new: impl IntoIterator<Item = PartPose>) {
        let known = self.sketch().part_poses.clone();
        let poses: PartPoses = new.into_iter().fold(known, |known, pose| posed(&known, pose));
        self.change_merging(Change::part_poses(poses), "part poses");
    }

    /// The other parts that are chosen, as they are when one of them is taken hold of.
    pub(super) fn other_holds(&self, held: PartName) -> Vec<Held> {
        if !self.chosen_parts().any(|part| part == held) {
            return Vec::new();
        }
        let others = self.chosen_parts().filter(|part| *part != held);
        others.filter_map(|part| self.held(part)).collect()
    }

    /// A part as it is when it is taken hold of.
    pub(super) fn held(&self, part: PartName) -> Option<Held> {
        let posable = self.posable(part)?;
        let before = pose_of(&self.sketch().part_poses, part);
        let is_stiff = matches!(posable.part, Part::Organs(_));
        Some(Held { before, frame: posable.frame, base: posable.base, is_stiff })
    }

    /// Goes on with the loop, physical pixels of the window; whether one is being drawn.
    pub(super) fn draw_loop(&mut self, to: DVec2) -> bool {
        let step = STEP * self.plant.pixels_per_point();
        let Some(places) = &mut self.posing.choosing else { return false };
        if places.last().is_none_or(|last| last.distance(to) >= step) {
            places.push(to);
        }
        true
    }

    /// Chooses the parts in the loop, where one was drawn.
    pub(super) fn close_loop(&mut self, besides: bool) {
        let places = self.posing.choosing.take().unwrap_or_default();
        if places.len() < FEWEST {
            return;
        }
        self.drawing.end_merging();
        let inside = Region::new(places.iter().map(|place| place.as_vec2()).collect());
        let found = self.parts_inside(&inside);
        if !besides {
            (self.posing.last, self.posing.others) = (None, Vec::new());
        }
        let known: Vec<PartName> = self.chosen_parts().collect();
        let mut new = found.into_iter().filter(|part| !known.contains(part));
        if self.posing.last.is_none() {
            self.posing.last = new.next();
        }
        self.posing.others.extend(new);
    }

    /// The parts whose picture lies in a loop.
    fn parts_inside(&self, inside: &Region) -> Vec<PartName> {
        let Some(built) = self.built() else { return Vec::new() };
        let (plant, names) = (&built.plant, &built.names);
        let is_inside = |at: Vec3| -> bool {
            let seen: Option<Vec2> = self.plant.seen_at(at).map(|seen| seen.as_vec2());
            seen.is_some_and(|seen| inside.contains(seen))
        };
        let (mut chosen, mut along) = (Vec::new(), vec![false; plant.branches.len()]);
        for (index, branch) in plant.branches.iter().enumerate() {
            along[index] = branch.parent.is_some_and(|parent| along[parent]);
            let name = names.of(branch.origin).filter(|_| !along[index] && is_mostly(branch, is_inside));
            along[index] |= name.is_some();
            chosen.extend(name);
        }
        let mut groups = OrganGroup::all(plant, names, |_| true);
        let goes_along = |group: &OrganGroup| group.on.or(group.stalk).is_some_and(|branch| along[branch]);
        groups.retain(|group| !goes_along(group) && is_inside(middle(plant, group)));
        let whole = groups.iter().filter(|group| group.is_flower).filter_map(|group| group.flower);
        let whole: HashSet<usize> = whole.collect();
        let is_part = |group: &OrganGroup| {
            !group.is_flower && group.flower.is_some_and(|flower| whole.contains(&flower))
        };
        chosen.extend(groups.iter().filter(|group| !is_part(group)).map(|group| group.name));
        chosen
    }
}

/// Whether most of a branch's line is inside.
fn is_mostly(branch: &Branch, is_inside: impl Fn(Vec3) -> bool) -> bool {
    let inside = branch.points.iter().filter(|point| is_inside(**point)).count();
    inside as f32 >= MOST_INSIDE * branch.points.len() as f32
}

/// The middle of a leaf; where a flower or another organ stands.
fn middle(plant: &FinishedPlant, group: &OrganGroup) -> Vec3 {
    if let Some(flower) = group.flower.filter(|_| group.is_flower) {
        return plant.flowers[flower].cone.apex;
    }
    match group.organs.first().map(|organ| &plant.organs[*organ].shape) {
        Some(Shape::Blade(blade)) => {
            let blade = plant.templates.resolve(blade);
            blade.base + blade.v * (0.5 * blade.template.length())
        }
        _ => group.base,
    }
}

#[cfg(test)]
#[path = "choosing_tests.rs"]
mod tests;
