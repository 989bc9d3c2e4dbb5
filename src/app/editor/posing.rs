//! Parts of the plant turned, bent, moved, made larger and taken away in its view (001 §4.3): a drag that begins on a part turns it
//! about its base, and all that grows on it goes along.
//!
//! The place that is held follows the pointer in the plane through it that faces the viewer, as near as the length of the
//! part allows. Bent, a branch stays at its base and curves evenly to its end. Moved, the base of a part slides along what it
//! grows on, and what stands on the ground over that. One drag is one step to undo. A tap chooses a part, another tap on it
//! what carries it; a drag on what is chosen, or on what that carries, moves all of it. So a bough is moved from any of
//! its twigs, and from its leaves. Leaves and flowers that were drawn, or that are seen large, are dragged themselves.
//!
//! A ring around its base turns a part precisely (`pose_ring.rs`).
//!
//! Limits: a turn about the part's own axis takes two drags from different sides, or a view along it and the ring.

use super::Editor;
use super::posable::{Part, Posable};
use super::pose_tool::PartHold;
use crate::app::action::Action;
use crate::app::panels::snapshot::PoseState;
use crate::app::pose_drag::PoseDrag;
use crate::geom::polyline;
use crate::model::pick::{Element, pick};
use crate::modelling::{OrganGroup, PartFrame};
use crate::sketch::part_poses::{PartPose, pose_of, posed};
use crate::sketch::{Change, PartName};
use glam::{DVec2, Quat, Vec3};
use std::f32::consts::PI;

/// Least distance of the place that is held from the base, as a share of the part's length: nearer, a small move would be a
/// large turn.
const LEAST_LEVER: f32 = 0.08;

impl Editor {
    /// Actions about posed parts.
    pub(super) fn perform_on_poses(&mut self, action: Action) {
        match action {
            Action::PoseParts(on) => {
                self.lay_down_plant_tools();
                self.posing.is_on = on;
            }
            Action::PoseBy(drag) => self.posing.drag = drag,
            Action::ResetPose => self.pose_chosen(|pose| PartPose::still(pose.part)),
            Action::SizePart(thickness) => {
                if let Some(pose) = self.chosen_pose() {
                    self.pose(PartPose { thickness, ..pose });
                }
            }
            Action::TakeAwayPart => self.take_away_part(),
            other => self.perform_on_garden(other),
        }
    }

    /// Takes away the part that is chosen: what was drawn with its strokes.
    fn take_away_part(&mut self) {
        let strokes = self.posing.last.map(|name| self.strokes_of(name)).unwrap_or_default();
        match strokes.is_empty() {
            true => self.pose_chosen(|pose| PartPose { is_cut: true, ..pose }),
            false => self.change(Change::remove(strokes)),
        }
    }

    /// Whether a tool is in hand in the view of the plant.
    pub(super) fn has_plant_tool(&self) -> bool {
        let is_on = self.petals.is_on || self.space.is_on || self.posing.is_on || self.garden.is_on;
        is_on || self.brush.tool.is_some()
    }

    /// Lays down whichever tool is in hand in the view of the plant.
    pub(super) fn lay_down_plant_tools(&mut self) {
        (self.petals.is_on, self.space.is_on, self.posing.is_on) = (false, false, false);
        self.garden.is_on = false;
        self.garden.let_go();
        (self.brush.tool, self.brush.stroke) = (None, None);
        self.petals.let_go();
        self.posing.let_go();
        self.space.stroke = None;
    }

    /// What the bar below the plant shows.
    pub(super) fn pose_state(&self) -> PoseState {
        let chosen = self.chosen_pose();
        let part = self.posing.last.filter(|_| self.posing.is_on).and_then(|name| self.posable(name));
        let plant = self.built().map(|built| &built.plant);
        PoseState {
            any: plant.is_some_and(|plant| !(plant.branches.is_empty() && plant.organs.is_empty())),
            on: self.posing.is_on,
            drag: self.posing.drag,
            posed: chosen.is_some_and(|pose| !pose.is_still()),
            size: chosen.filter(|pose| !pose.is_cut).map(|pose| pose.thickness),
            is_organ: part.is_some_and(|part| matches!(part.part, Part::Organs(_))),
        }
    }

    /// Whether a part is chosen that can be taken away.
    pub(super) fn can_take_part_away(&self) -> bool {
        self.posing.is_on && self.chosen_pose().is_some_and(|pose| !pose.is_cut)
    }

    /// The pose of the part that is chosen.
    fn chosen_pose(&self) -> Option<PartPose> {
        self.posing.last.map(|part| pose_of(&self.sketch().part_poses, part))
    }

    /// Gives the part that is chosen another pose, as a step of its own.
    fn pose_chosen(&mut self, other: impl Fn(PartPose) -> PartPose) {
        if let Some(pose) = self.chosen_pose() {
            self.drawing.end_merging();
            self.pose(other(pose));
            self.drawing.end_merging();
        }
    }

    /// What a tap chooses: what is hit, or what carries that if it is chosen already.
    pub(super) fn part_to_choose(&self, tapped: Element) -> Option<PartName> {
        if !self.posing.is_on {
            return None;
        }
        let parts = self.parts_under(tapped);
        let chosen = self.posing.last.and_then(|chosen| parts.iter().position(|part| *part == chosen));
        // Below the trunk it begins again.
        let next = chosen.and_then(|chosen| parts.get(chosen + 1)).or_else(|| parts.first());
        next.copied()
    }

    /// Takes hold of the part under a place in the window, physical pixels; whether there is one.
    pub(super) fn hold_part(&mut self, at: DVec2) -> bool {
        if !self.posing.is_on {
            return false;
        }
        self.posing.hold = self.part_hold(at);
        if self.posing.hold.is_some() {
            // A plant that becomes larger under the pointer does not move away from it.
            self.plant.take_hold();
        }
        self.posing.hold.is_some()
    }

    /// What is held: what is chosen if that is hit or carries what is hit, or else an organ that is drawn or seen large, drawn wood as
    /// near as a finger is thick, or the twig that is hit or whose leaf is.
    fn part_hold(&self, at: DVec2) -> Option<PartHold> {
        let ray = self.plant.ray(self.plant.place(at))?;
        let built = self.built()?;
        let Some(hit) = pick(&built.model, &built.plant, &ray) else { return self.drawn_hold(at) };
        let (parts, grip) = (self.parts_under(hit.element), ray.at(hit.distance));
        if let Some(chosen) = self.posing.last.filter(|chosen| parts.contains(chosen)) {
            return self.hold(chosen, grip);
        }
        if self.is_organ_meant(hit.element) {
            return self.hold(*parts.first()?, grip);
        }
        let names = &built.names;
        let is_branch = |name: &&PartName| names.branch(&built.plant, **name).is_some();
        let twig = || self.hold(*parts.iter().find(is_branch)?, grip);
        match hit.element {
            Element::Branch(_) => twig().or_else(|| self.drawn_hold(at)),
            Element::Organ(_) => self.drawn_hold(at).or_else(twig),
        }
    }

    /// The drawn branch under a place in the window.
    fn drawn_hold(&self, at: DVec2) -> Option<PartHold> {
        let (branch, grip) = self.wood_at(at)?;
        self.hold(self.built()?.names.of(branch.origin)?, grip)
    }

    /// A part held at a place, unless that is too near to its base to turn it.
    fn hold(&self, name: PartName, grip: Vec3) -> Option<PartHold> {
        let Posable { base, frame, part } = self.posable(name)?;
        let before = pose_of(&self.sketch().part_poses, name);
        let mut hold = PartHold { drag: self.posing.drag, before, frame, base, grip, share: 1.0 };
        match part {
            Part::Branch(branch) => {
                let (_, arc) = polyline::nearest(&branch.points, grip)?;
                let length = polyline::length(&branch.points).max(f32::MIN_POSITIVE);
                hold.share = arc / length;
                let is_lever = grip.distance(base) >= LEAST_LEVER * length;
                (is_lever || hold.drag == PoseDrag::Move).then_some(hold)
            }
            Part::Organs(group) => {
                if let Some(stem) = self.stem_of(&group).filter(|_| hold.drag == PoseDrag::Move) {
                    return Some(PartHold { drag: PoseDrag::Turn, ..self.hold(stem, grip)? });
                }
                // Organs are stiff.
                hold.drag = if hold.drag == PoseDrag::Bend { PoseDrag::Turn } else { hold.drag };
                Some(hold)
            }
        }
    }

    /// The stem that ends in a flower: it moves with that.
    fn stem_of(&self, group: &OrganGroup) -> Option<PartName> {
        let built = self.built()?;
        let stem = &built.plant.branches[group.on.filter(|_| group.is_flower)?];
        let (end, radius) = (stem.points.last()?, stem.radii.last()?);
        let ends_there =
            end.distance(group.base) <= (4.0 * radius).max(LEAST_LEVER * polyline::length(&stem.points));
        built.names.of(stem.origin).filter(|_| ends_there)
    }

    /// Poses the part that is held with the pointer.
    pub(super) fn drag_part(&mut self, to: DVec2) {
        let Some(hold) = self.posing.hold else { return };
        let Some(target) = self.plant.on_plane(hold.grip, to) else { return };
        // Not when it was taken hold of: that may become a tap.
        self.posing.last = Some(hold.before.part);
        let pose = match hold.drag {
            PoseDrag::Move => self.world().map(|world| moved(&hold, target, world.scale)),
            drag => Some(dragged(&hold, target, drag == PoseDrag::Bend)),
        };
        pose.into_iter().for_each(|pose| self.pose(pose));
    }

    /// Poses a part; one drag is one step.
    pub(super) fn pose(&mut self, pose: PartPose) {
        let poses = posed(&self.sketch().part_poses, pose);
        self.change_merging(Change::part_poses(poses), "part poses");
    }
}

/// The pose in which the place that is held lies in the direction of a point.
fn dragged(hold: &PartHold, target: Vec3, bends: bool) -> PartPose {
    let &PartHold { before, base, grip, share, frame, .. } = hold;
    let (from, to) = ((grip - base).try_normalize(), (target - base).try_normalize());
    let Some((from, to)) = from.zip(to) else { return before };
    let turn = Quat::from_rotation_arc(from, to);
    // A place at a share of an evenly bent branch is seen under half of that share of the whole bend.
    let (axis, angle) = turn.to_axis_angle();
    let whole = (angle * 2.0 / share.max(LEAST_LEVER)).clamp(-PI, PI);
    let turn = if bends { Quat::from_axis_angle(axis, whole) } else { turn };
    turned(&before, &frame, turn, bends)
}

/// The pose in which the base has moved as the place that is held to a point; a pixel of the canvas is `scale` metres.
fn moved(hold: &PartHold, target: Vec3, scale: f32) -> PartPose {
    let way = hold.base + (target - hold.grip) - hold.frame.stood;
    PartPose { shift: hold.frame.parent_turn.inverse() * way / scale, ..hold.before }
}

/// A pose with one more turn in the world of the part, or of its end.
pub(super) fn turned(before: &PartPose, frame: &PartFrame, turn: Quat, bends: bool) -> PartPose {
    let foot = frame.foot;
    if bends {
        let bend = (foot.inverse() * turn * foot * before.bend).normalize();
        return PartPose { bend, ..*before };
    }
    // The foot is turned by what carries it and then by the part's own turn.
    let parent_turn = foot * before.turn.inverse();
    let turn = (parent_turn.inverse() * turn * parent_turn * before.turn).normalize();
    PartPose { turn, ..*before }
}

#[cfg(test)]
#[path = "posing_tests.rs"]
mod tests;
