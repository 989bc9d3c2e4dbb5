//! Branches turned and bent in the view of the plant (001 §4.3): a drag that begins on drawn wood moves it about its base, and
//! all that grows on it goes along.
//!
//! The place that is held follows the pointer in the plane through it that faces the viewer, as near as the length of the
//! branch allows. Bent, the branch stays at its base and curves evenly to its end. One drag is one step to undo.
//!
//! Limits: wood that grew is posed with the drawn branch that it grew from; a turn about the branch's own axis takes two drags
//! from different sides.

use super::Editor;
use super::pose_tool::WoodHold;
use crate::app::action::Action;
use crate::app::panels::snapshot::PoseState;
use crate::geom::polyline;
use crate::sketch::wood_poses::{WoodPose, pose_of, posed};
use crate::sketch::{Change, StrokeId};
use glam::{DVec2, Quat, Vec3};
use std::f32::consts::PI;

/// Least distance of the place that is held from the base, as a share of the branch's length: nearer, a small move would be a
/// large turn.
const LEAST_LEVER: f32 = 0.08;

impl Editor {
    /// Actions about turned and bent branches.
    pub(super) fn perform_on_poses(&mut self, action: Action) {
        match action {
            Action::PoseWood(on) => {
                self.lay_down_plant_tools();
                self.posing.is_on = on;
            }
            Action::BendWood(on) => self.posing.bends = on,
            Action::ResetPose => {
                if let Some(stroke) = self.posing.last {
                    self.drawing.end_merging();
                    self.pose(WoodPose::still(stroke));
                    self.drawing.end_merging();
                }
            }
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
        let poses = &self.sketch().wood_poses;
        let posed = self.posing.last.is_some_and(|stroke| !pose_of(poses, stroke).is_still());
        PoseState { on: self.posing.is_on, bends: self.posing.bends, posed }
    }

    /// Takes hold of the drawn branch under a place in the window, physical pixels; whether there is one.
    pub(super) fn hold_wood(&mut self, at: DVec2) -> bool {
        if !self.posing.is_on {
            return false;
        }
        self.posing.hold = self.wood_hold(at);
        if let Some(hold) = &self.posing.hold {
            self.posing.last = Some(hold.before.stroke);
            // A plant that becomes larger under the pointer does not move away from it.
            self.plant.take_hold();
        }
        self.posing.hold.is_some()
    }

    fn wood_hold(&self, at: DVec2) -> Option<WoodHold> {
        let (touched, grip) = self.wood_at(at)?;
        let built = self.built()?;
        let stroke_of = |branch: &crate::plant::Branch| built.provenance.stroke(branch.origin);
        let mut drawn = built.wood.branches(&built.plant);
        let stroke: StrokeId = stroke_of(drawn.find(|(index, _)| *index == touched)?.1)?;
        // Of several branches of one stroke the first is posed.
        let mut drawn = built.wood.branches(&built.plant);
        let (index, branch) = drawn.find(|(_, branch)| stroke_of(branch) == Some(stroke))?;
        let base = *branch.points.first()?;
        let (_, arc) = polyline::nearest(&branch.points, grip)?;
        let length = polyline::length(&branch.points).max(f32::MIN_POSITIVE);
        if grip.distance(base) < LEAST_LEVER * length {
            return None;
        }
        let before = pose_of(&self.sketch().wood_poses, stroke);
        let foot = built.wood.posed.foot(index);
        Some(WoodHold { before, base, grip, share: arc / length, foot })
    }

    /// Moves the branch that is held with the pointer.
    pub(super) fn drag_wood(&mut self, to: DVec2) {
        let Some(hold) = self.posing.hold else { return };
        let Some(target) = self.plant.on_plane(hold.grip, to) else { return };
        self.pose(dragged(&hold, target, self.posing.bends));
    }

    /// Poses a branch; one drag is one step.
    fn pose(&mut self, pose: WoodPose) {
        let poses = posed(&self.sketch().wood_poses, pose);
        self.change_merging(Change::wood_poses(poses), "wood poses");
    }
}

/// The pose in which the place that is held lies in the direction of a point.
fn dragged(hold: &WoodHold, target: Vec3, bends: bool) -> WoodPose {
    let WoodHold { before, base, grip, share, foot } = *hold;
    let (from, to) = ((grip - base).try_normalize(), (target - base).try_normalize());
    let Some((from, to)) = from.zip(to) else { return before };
    let turn = Quat::from_rotation_arc(from, to);
    if bends {
        // A place at a share of an evenly bent branch is seen under half of that share of the whole bend.
        let (axis, angle) = turn.to_axis_angle();
        let angle = (angle * 2.0 / share.max(LEAST_LEVER)).clamp(-PI, PI);
        let turn = Quat::from_axis_angle(axis, angle);
        let bend = (foot.inverse() * turn * foot * before.bend).normalize();
        return WoodPose { bend, ..before };
    }
    // The foot is turned by its parent and then by the branch's own turn.
    let parent = foot * before.turn.inverse();
    let turn = (parent.inverse() * turn * parent * before.turn).normalize();
    WoodPose { turn, ..before }
}

#[cfg(test)]
#[path = "posing_tests.rs"]
mod tests;
