//! Parts of the plant turned, bent, straightened, moved, grafted, made larger and taken away in its view (001 §4.3): a drag that begins on a part turns it
//! about its base, and all that grows on it goes along.
//!
//! The place that is held follows the pointer in the plane through it that faces the viewer, as near as the length of the
//! part allows. Bent, a branch stays at its base and curves evenly to its end. Moved, the base of a part slides along what it
//! grows on, and what stands on the ground over that; grafted, it stands on the branch under the pointer (`grafting.rs`). One drag is one step to undo. A tap chooses a part, another tap on it
//! what carries it; a drag on what is chosen, or on what that carries, moves all of it. So a bough is moved from any of
//! its twigs, and from its leaves. Leaves and flowers that were drawn, or that are seen large, are dragged themselves.
//!
//! A ring around its base turns a part precisely (`pose_ring.rs`).
//!
//! Limits: a turn about the part's own axis takes two drags from different sides, or a view along it and the ring.

use super::Editor;
use super::posable::Part;
use super::pose_tool::{Held, PartHold};
use crate::app::action::Action;
use crate::app::panels::snapshot::PoseState;
use crate::app::pose_drag::PoseDrag;
use crate::geom::polyline;
use crate::model::pick::{Element, pick};
use crate::modelling::OrganGroup;
use crate::sketch::part_poses::{PartPose, pose_of, posed};
use crate::sketch::{Change, PartName};
use glam::{DVec2, Quat, Vec3};
use std::collections::HashSet;
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
            Action::MeetWood(on_contact) => self.posing.on_contact = on_contact,
            Action::ResetPose => self.pose_as_step(|pose| PartPose::still(pose.part)),
            Action::SizePart(thickness) => self.pose_chosen(|pose| PartPose { thickness, ..pose }),
            Action::StraightenPart(straight) => self.pose_branches(|pose| PartPose { straight, ..pose }),
            Action::MakePartYounger(younger) => self.pose_branches(|pose| PartPose { younger, ..pose }),
            Action::TakeAwayPart => self.take_away_chosen(),
            other => self.perform_on_garden(other),
        }
    }

    /// Gives the branches that are chosen, and no organs, another pose.
    fn pose_branches(&mut self, other: impl Fn(PartPose) -> PartPose) {
        let Some(built) = self.built() else { return };
        let chosen: HashSet<PartName> = self.chosen_parts().collect();
        let names = built.plant.branches.iter().filter_map(|branch| built.names.of(branch.origin));
        let known = &self.sketch().part_poses;
        let pose = |part: PartName| other(pose_of(known, part));
        let poses: Vec<PartPose> = names.filter(|name| chosen.contains(name)).map(pose).collect();
        self.pose(poses);
    }

    /// Takes away the parts that are chosen: what was drawn with its strokes.
    fn take_away_chosen(&mut self) {
        let (mut strokes, mut poses) = (Vec::new(), self.sketch().part_poses.clone());
        for part in self.chosen_parts() {
            let drew = self.strokes_of(part);
            if drew.is_empty() {
                poses = posed(&poses, PartPose { is_cut: true, ..pose_of(&poses, part) });
            }
            strokes.extend(drew);
        }
        let removed = Change::remove(strokes).strokes;
        self.drawing.end_merging();
        self.change(Change { strokes: removed, ..Change::part_poses(poses) });
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
        let is_organ = part.is_some_and(|part| matches!(part.part, Part::Organs(_)));
        let plant = self.built().map(|built| &built.plant);
        let branch = chosen.filter(|pose| !pose.is_cut && !is_organ);
        let ages = self.built().and_then(|built| built.growth);
        PoseState {
            any: plant.is_some_and(|plant| !(plant.branches.is_empty() && plant.organs.is_empty())),
            on: self.posing.is_on,
            drag: self.posing.drag,
            on_contact: self.posing.on_contact,
            chosen: self.chosen_parts().count(),
            posed: chosen.is_some_and(|pose| !pose.is_still()),
            size: chosen.filter(|pose| !pose.is_cut).map(|pose| pose.thickness),
            straight: branch.map(|pose| pose.straight),
            younger: branch.map(|pose| pose.younger),
            years: ages.map_or(0, |ages| ages.shown.ceil() as u16),
            is_organ,
        }
    }

    /// Whether a part is chosen that can be taken away.
    pub(super) fn can_take_part_away(&self) -> bool {
        self.posing.is_on && self.chosen_pose().is_some_and(|pose| !pose.is_cut)
    }

    /// Gives the parts that are chosen another pose, as a step of its own.
    fn pose_as_step(&mut self, other: impl Fn(PartPose) -> PartPose) {
        self.drawing.end_merging();
        self.pose_chosen(other);
        self.drawing.end_merging();
    }

    /// What a tap chooses: what is hit, or what carries that if it is chosen already; with `besides` always what is hit.
    pub(super) fn part_to_choose(&self, tapped: Element, besides: bool) -> Option<PartName> {
        if !self.posing.is_on {
            return None;
        }
        let parts = self.parts_under(tapped);
        let chosen = self
            .posing
            .last
            .filter(|_| !besides)
            .and_then(|chosen| parts.iter().position(|part| *part == chosen));
        // Below the trunk it begins again.
        let next = chosen.and_then(|chosen| parts.get(chosen + 1)).or_else(|| parts.first());
        next.copied()
    }

    /// Takes hold of the part under a place in the window, physical pixels; whether there is one.
    pub(super) fn hold_part(&mut self, at: DVec2) -> bool {
        if !self.posing.is_on {
            return false;
        }
        if self.posing.drag == PoseDrag::Choose {
            self.posing.choosing = Some(vec![at]);
            return true;
        }
        self.posing.hold = self.part_hold(at);
        if let Some(hold) = &self.posing.hold {
            let part = hold.held.before.part;
            self.posing.held_others = self.other_holds(part);
            self.posing.around = self.wood_around(part);
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
        if let Some(chosen) = self.chosen_parts().find(|chosen| parts.contains(chosen)) {
            return self.hold(chosen, grip);
        }
        let takes_any = self.posing.drag == PoseDrag::Replace && matches!(hit.element, Element::Organ(_));
        if takes_any || self.is_organ_meant(hit.element) {
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
        let held = self.held(name)?;
        let mut hold = PartHold { drag: self.posing.drag, held, grip, share: 1.0 };
        match self.posable(name)?.part {
            Part::Branch(branch) => {
                let (_, arc) = polyline::nearest(&branch.points, grip)?;
                let length = polyline::length(&branch.points).max(f32::MIN_POSITIVE);
                hold.share = arc / length;
                let is_lever = grip.distance(held.base) >= LEAST_LEVER * length;
                let is_moved = matches!(hold.drag, PoseDrag::Move | PoseDrag::Graft);
                // Branches are not replaced.
                (hold.drag != PoseDrag::Replace && (is_lever || is_moved)).then_some(hold)
            }
            Part::Organs(group) => {
                let of_stem = match hold.drag {
                    PoseDrag::Move => Some(PoseDrag::Turn),
                    PoseDrag::Graft => Some(PoseDrag::Graft),
                    PoseDrag::Turn | PoseDrag::Bend | PoseDrag::Replace | PoseDrag::Choose => None,
                };
                if let Some((drag, stem)) = of_stem.zip(self.stem_of(&group)) {
                    return Some(PartHold { drag, ..self.hold(stem, grip)? });
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

    /// Poses the part that is held with the pointer, and with it the others that are chosen.
    pub(super) fn drag_part(&mut self, to: DVec2) {
        let Some(hold) = self.posing.hold else { return };
        // Not when it was taken hold of: that may become a tap.
        self.posing.take_up(hold.held.before.part);
        match hold.drag {
            PoseDrag::Graft => return self.graft_part(&hold.held.before, to),
            PoseDrag::Replace => return self.replace_held(&hold.held, to),
            PoseDrag::Turn | PoseDrag::Bend | PoseDrag::Move | PoseDrag::Choose => {}
        }
        let Some((target, world)) = self.plant.on_plane(hold.grip, to).zip(self.world()) else { return };
        let bends = hold.drag == PoseDrag::Bend;
        let turn = turn_toward(&hold, target, bends);
        let turn = if hold.drag == PoseDrag::Turn { self.posing.free_turn(turn) } else { turn };
        let pose = |held: &Held| match hold.drag {
            PoseDrag::Move => moved(held, target - hold.grip, world.scale),
            _ => turned(held, turn, bends),
        };
        let poses: Vec<PartPose> =
            [&hold.held].into_iter().chain(&self.posing.held_others).map(pose).collect();
        self.pose(poses);
    }
}

/// The turn of the part, or with `bends` of its end, by which the place that is held comes into the direction of a point.
fn turn_toward(hold: &PartHold, target: Vec3, bends: bool) -> Quat {
    let (base, grip) = (hold.held.base, hold.grip);
    let (from, to) = ((grip - base).try_normalize(), (target - base).try_normalize());
    let Some((from, to)) = from.zip(to) else { return Quat::IDENTITY };
    let turn = Quat::from_rotation_arc(from, to);
    if !bends {
        return turn;
    }
    // A place at a share of an evenly bent branch is seen under half of that share of the whole bend.
    let (axis, angle) = turn.to_axis_angle();
    Quat::from_axis_angle(axis, (angle * 2.0 / hold.share.max(LEAST_LEVER)).clamp(-PI, PI))
}

/// The pose in which the base has moved by a way, metres; a pixel of the canvas is `scale` metres.
fn moved(held: &Held, by: Vec3, scale: f32) -> PartPose {
    let way = held.base + by - held.frame.stood;
    PartPose { shift: held.frame.parent_turn.inverse() * way / scale, ..held.before }
}

/// The pose with one more turn in the world of the part, or of its end; organs are not bent.
pub(super) fn turned(held: &Held, turn: Quat, bends: bool) -> PartPose {
    let (before, foot) = (held.before, held.frame.foot);
    if bends {
        let bend = (foot.inverse() * turn * foot * before.bend).normalize();
        return if held.is_stiff { before } else { PartPose { bend, ..before } };
    }
    // The foot is turned by what carries it and then by the part's own turn.
    let parent_turn = foot * before.turn.inverse();
    let turn = (parent_turn.inverse() * turn * parent_turn * before.turn).normalize();
    PartPose { turn, ..before }
}

#[cfg(test)]
#[path = "posing_tests.rs"]
mod tests;
