//! Branches turned, bent, made thicker and cut off in the view of the plant (001 §4.3): a drag that begins on wood moves it about
//! its base, and all that grows on it goes along.
//!
//! The place that is held follows the pointer in the plane through it that faces the viewer, as near as the length of the
//! branch allows. Bent, the branch stays at its base and curves evenly to its end. One drag is one step to undo. A tap
//! chooses a branch, another tap on it the one that it grows on; a drag on the branch that is chosen, or on what it carries,
//! moves all of it. So a bough is moved from any of its twigs.
//!
//! A ring around its base turns it precisely (`pose_ring.rs`).
//!
//! Limits: a turn about the branch's own axis takes two drags from different sides, or a view along it and the ring.

use super::Editor;
use super::pose_tool::WoodHold;
use crate::app::action::Action;
use crate::app::panels::snapshot::PoseState;
use crate::geom::polyline;
use crate::model::pick::{Element, pick};
use crate::plant::{Branch, GrownId, Origin};
use crate::sketch::wood_poses::{WoodPose, pose_of, posed};
use crate::sketch::{Change, WoodName};
use glam::{DVec2, Quat, Vec3};
use std::f32::consts::PI;

/// Least distance of the place that is held from the base, as a share of the branch's length: nearer, a small move would be a
/// large turn.
const LEAST_LEVER: f32 = 0.08;

impl Editor {
    /// Actions about posed branches.
    pub(super) fn perform_on_poses(&mut self, action: Action) {
        match action {
            Action::PoseWood(on) => {
                self.lay_down_plant_tools();
                self.posing.is_on = on;
            }
            Action::BendWood(on) => self.posing.bends = on,
            Action::ResetPose => self.pose_chosen(|pose| WoodPose::still(pose.wood)),
            Action::ThickenWood(thickness) => {
                if let Some(pose) = self.chosen_pose() {
                    self.pose(WoodPose { thickness, ..pose });
                }
            }
            Action::CutWood => match self.posing.last {
                Some(WoodName::Stroke(stroke)) => self.change(Change::remove([stroke])),
                _ => self.pose_chosen(|pose| WoodPose { is_cut: true, ..pose }),
            },
            other => self.perform_on_brushes(other),
        }
    }

    /// Lays down whichever tool is in hand in the view of the plant.
    pub(super) fn lay_down_plant_tools(&mut self) {
        (self.petals.is_on, self.space.is_on, self.posing.is_on) = (false, false, false);
        (self.brush.tool, self.brush.stroke) = (None, None);
        self.petals.let_go();
        self.posing.let_go();
        self.space.stroke = None;
    }

    /// What the card over the plant shows.
    pub(super) fn pose_state(&self) -> PoseState {
        let chosen = self.chosen_pose();
        PoseState {
            on: self.posing.is_on,
            bends: self.posing.bends,
            posed: chosen.is_some_and(|pose| !pose.is_still()),
            thickness: chosen.filter(|pose| !pose.is_cut).map(|pose| pose.thickness),
        }
    }

    /// Whether a branch is chosen that can be cut off.
    pub(super) fn can_cut_wood(&self) -> bool {
        self.posing.is_on && self.chosen_pose().is_some_and(|pose| !pose.is_cut)
    }

    /// The pose of the branch that is chosen.
    fn chosen_pose(&self) -> Option<WoodPose> {
        self.posing.last.map(|wood| pose_of(&self.sketch().wood_poses, wood))
    }

    /// Gives the branch that is chosen another pose, as a step of its own.
    fn pose_chosen(&mut self, other: impl Fn(WoodPose) -> WoodPose) {
        if let Some(pose) = self.chosen_pose() {
            self.drawing.end_merging();
            self.pose(other(pose));
            self.drawing.end_merging();
        }
    }

    /// What a tap chooses: the branch that grew there, or what that grows on if it is chosen already.
    pub(super) fn wood_to_choose(&self, tapped: Element) -> Option<WoodName> {
        let touched = self.grown_under(tapped).filter(|_| self.posing.is_on)?;
        let chosen = self.chosen_index().filter(|chosen| self.carries(*chosen, touched));
        let lower = chosen.and_then(|chosen| self.built()?.plant.branches[chosen].parent);
        // Below the lowest that grew it begins again.
        lower.and_then(|lower| self.name_of(lower)).or_else(|| self.name_of(touched))
    }

    /// Takes hold of the branch under a place in the window, physical pixels; whether there is one.
    pub(super) fn hold_wood(&mut self, at: DVec2) -> bool {
        if !self.posing.is_on {
            return false;
        }
        self.posing.hold = self.wood_hold(at);
        if self.posing.hold.is_some() {
            // A plant that becomes larger under the pointer does not move away from it.
            self.plant.take_hold();
        }
        self.posing.hold.is_some()
    }

    /// What is held: the branch that is hit, and where that was drawn, or leaves are hit, drawn wood as near as a finger is thick.
    fn wood_hold(&self, at: DVec2) -> Option<WoodHold> {
        let ray = self.plant.ray(self.plant.place(at))?;
        let built = self.built()?;
        let hit = pick(&built.model, &built.plant, &ray);
        let grown = || {
            let hit = hit?;
            self.grown_hold(self.grown_under(hit.element)?, ray.at(hit.distance))
        };
        match hit.map(|hit| hit.element) {
            Some(Element::Branch(_)) => grown().or_else(|| self.drawn_hold(at)),
            _ => self.drawn_hold(at).or_else(grown),
        }
    }

    /// The drawn branch under a place in the window.
    fn drawn_hold(&self, at: DVec2) -> Option<WoodHold> {
        let (touched, grip) = self.wood_at(at)?;
        let built = self.built()?;
        let (_, branch) = built.wood.branches(&built.plant).find(|(index, _)| *index == touched)?;
        self.hold(built.provenance.stroke(branch.origin).map(WoodName::Stroke)?, grip)
    }

    /// A branch that grew, held at a place; the one that is chosen, if that carries it.
    fn grown_hold(&self, touched: usize, grip: Vec3) -> Option<WoodHold> {
        let chosen = self.chosen_index().filter(|chosen| self.carries(*chosen, touched));
        self.hold(self.name_of(chosen.unwrap_or(touched))?, grip)
    }

    /// The branch of a name, and what its foot is turned by. Of several branches of one stroke the first is posed.
    pub(super) fn posed_branch(&self, wood: WoodName) -> Option<(&Branch, Quat)> {
        let built = self.built()?;
        match wood {
            WoodName::Grown(name) => {
                let branch = &built.plant.branches[self.grown_index(GrownId(name))?];
                Some((branch, built.wood.posed.grown_foot(GrownId(name))))
            }
            WoodName::Stroke(stroke) => {
                let is_of = |branch: &Branch| built.provenance.stroke(branch.origin) == Some(stroke);
                let mut drawn = built.wood.branches(&built.plant);
                let (index, branch) = drawn.find(|(_, branch)| is_of(branch))?;
                Some((branch, built.wood.posed.foot(index)))
            }
        }
    }

    /// A branch held at a place, unless that is too near to its base.
    fn hold(&self, wood: WoodName, grip: Vec3) -> Option<WoodHold> {
        let (branch, foot) = self.posed_branch(wood)?;
        let base = *branch.points.first()?;
        let (_, arc) = polyline::nearest(&branch.points, grip)?;
        let length = polyline::length(&branch.points).max(f32::MIN_POSITIVE);
        if grip.distance(base) < LEAST_LEVER * length {
            return None;
        }
        let before = pose_of(&self.sketch().wood_poses, wood);
        Some(WoodHold { before, base, grip, share: arc / length, foot })
    }

    /// The branch that grew and was hit, or whose leaf was; none on drawn wood, and on plants beside the drawn one.
    fn grown_under(&self, hit: Element) -> Option<usize> {
        let built = self.built()?;
        let branch = match hit {
            Element::Branch(branch) => branch,
            Element::Organ(organ) => built.plant.organs[organ].branch?,
        };
        let is_beside = super::picking::place_of(Element::Branch(branch), &built.beside).is_some();
        let grew = matches!(built.plant.branches[branch].origin, Origin::Grown(_));
        (grew && !is_beside).then_some(branch)
    }

    /// What the branch of this place in the plant is known by.
    fn name_of(&self, index: usize) -> Option<WoodName> {
        let built = self.built()?;
        match built.plant.branches[index].origin {
            Origin::Grown(GrownId(name)) => Some(WoodName::Grown(name)),
            origin => built.provenance.stroke(origin).map(WoodName::Stroke),
        }
    }

    /// Place in the plant of the branch that is chosen, if that grew.
    pub(super) fn chosen_index(&self) -> Option<usize> {
        let Some(WoodName::Grown(name)) = self.posing.last else { return None };
        self.grown_index(GrownId(name))
    }

    /// Place in the plant of a branch that grew.
    fn grown_index(&self, name: GrownId) -> Option<usize> {
        self.built()?.plant.branches.iter().position(|branch| branch.origin == Origin::Grown(name))
    }

    /// Whether a branch is another one or grows on it, near or far.
    fn carries(&self, below: usize, branch: usize) -> bool {
        let Some(built) = self.built() else { return false };
        let mut down = std::iter::successors(Some(branch), |at| built.plant.branches[*at].parent);
        down.any(|at| at == below)
    }

    /// Moves the branch that is held with the pointer.
    pub(super) fn drag_wood(&mut self, to: DVec2) {
        let Some(hold) = self.posing.hold else { return };
        let Some(target) = self.plant.on_plane(hold.grip, to) else { return };
        // Not when it was taken hold of: that may become a tap.
        self.posing.last = Some(hold.before.wood);
        self.pose(dragged(&hold, target, self.posing.bends));
    }

    /// Poses a branch; one drag is one step.
    pub(super) fn pose(&mut self, pose: WoodPose) {
        let poses = posed(&self.sketch().wood_poses, pose);
        self.change_merging(Change::wood_poses(poses), "wood poses");
    }
}

/// The pose in which the place that is held lies in the direction of a point.
fn dragged(hold: &WoodHold, target: Vec3, bends: bool) -> WoodPose {
    let &WoodHold { before, base, grip, share, foot } = hold;
    let (from, to) = ((grip - base).try_normalize(), (target - base).try_normalize());
    let Some((from, to)) = from.zip(to) else { return before };
    let turn = Quat::from_rotation_arc(from, to);
    // A place at a share of an evenly bent branch is seen under half of that share of the whole bend.
    let (axis, angle) = turn.to_axis_angle();
    let whole = (angle * 2.0 / share.max(LEAST_LEVER)).clamp(-PI, PI);
    let turn = if bends { Quat::from_axis_angle(axis, whole) } else { turn };
    turned(&before, foot, turn, bends)
}

/// A pose with one more turn in the world of the branch, or of its end, whose foot is turned so.
pub(super) fn turned(before: &WoodPose, foot: Quat, turn: Quat, bends: bool) -> WoodPose {
    if bends {
        let bend = (foot.inverse() * turn * foot * before.bend).normalize();
        return WoodPose { bend, ..*before };
    }
    // The foot is turned by its parent and then by the branch's own turn.
    let parent = foot * before.turn.inverse();
    let turn = (parent.inverse() * turn * parent * before.turn).normalize();
    WoodPose { turn, ..*before }
}

#[cfg(test)]
#[path = "posing_tests.rs"]
mod tests;
