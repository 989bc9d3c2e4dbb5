//! Leaves, flowers and fruits that are dragged onto another one and become copies of it.

use super::Editor;
use super::posable::Part;
use super::pose_tool::Held;
use crate::model::pick::pick;
use crate::modelling::is_replaceable;
use crate::sketch::{PartName, PartPose};
use glam::DVec2;

impl Editor {
    /// Makes what is held, with the others that are chosen, copies of what is under a place in the window, physical pixels; over
    /// nothing that can be copied they stay what they became last.
    pub(super) fn replace_held(&mut self, held: &Held, at: DVec2) {
        let Some(like) = self.pattern_at(at) else { return };
        let held = [held].into_iter().chain(&self.posing.held_others).filter(|held| held.is_stiff);
        let others = held.filter(|held| held.before.part != like);
        let poses: Vec<PartPose> = others.map(|held| PartPose { like: Some(like), ..held.before }).collect();
        self.pose(poses);
    }

    /// The leaf, flower or fruit that is seen at a place in the window.
    fn pattern_at(&self, at: DVec2) -> Option<PartName> {
        let ray = self.plant.ray(self.plant.place(at))?;
        let built = self.built()?;
        let hit = pick(&built.model, &built.plant, &ray)?;
        let can_be = |name: &PartName| match self.posable(*name).map(|posable| posable.part) {
            Some(Part::Organs(group)) => is_replaceable(&built.plant, &group),
            Some(Part::Branch(_)) | None => false,
        };
        self.parts_under(hit.element).into_iter().find(can_be)
    }
}

#[cfg(test)]
#[path = "replacing_tests.rs"]
mod tests;
