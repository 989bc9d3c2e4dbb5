//! Branches drawn in the view of the plant (001 §4.2): from wood, or from the ground for a trunk of its own.
//!
//! A line that begins on wood is a branch of it; what else is dragged turns the camera as ever, and a tap selects. The pen
//! draws on the surface that is chosen: facing the viewer through the beginning, level, or along the lines of sight of the
//! branch drawn last, which is lifted. While it draws, the plant grows with every sample; lifted, it is one step to undo.
//!
//! Limits: branches begin on wood that was drawn, for wood that grew is another one when anything changes; what was turned or
//! bent by itself is not lifted.

use super::Editor;
use super::drawing_surface::DrawingSurface;
use super::space_tool::SpaceStroke;
use super::stroke_frame::StrokeFrame;
use crate::app::action::Action;
use crate::app::panels::snapshot::SpaceState;
use crate::app::work_surface::WorkSurface;
use crate::pen::{PenPhase, PenSample, PenTool};
use crate::plant::{Branch, WorldFromCanvas};
use crate::sketch::part_poses::pose_of;
use crate::sketch::{Change, PartName, Stroke, StrokeId, StrokePoint, Tool};
use glam::Vec3;

impl Editor {
    /// Actions about branches in space.
    pub(super) fn perform_in_space(&mut self, action: Action) {
        match action {
            Action::DrawInSpace(on) => {
                self.lay_down_plant_tools();
                self.space.is_on = on;
            }
            Action::SetWorkSurface(surface) => self.space.surface = surface,
            other => self.perform_on_poses(other),
        }
    }

    /// What the bar below the plant shows.
    pub(super) fn space_state(&self) -> SpaceState {
        let can_lift = self.space.is_on && self.last_in_space().is_some();
        let surface = match self.space.surface {
            WorkSurface::Lifted if !can_lift => WorkSurface::Facing,
            surface => surface,
        };
        let any = self.built().is_some_and(|built| !built.plant.branches.is_empty());
        SpaceState { any, on: self.space.is_on, surface, can_lift }
    }

    /// Begins a branch at a place in the window, physical pixels; whether there is anything to begin on.
    pub(super) fn begin_in_space(&mut self, sample: &PenSample) -> bool {
        let buttons = sample.buttons;
        let moves_camera = buttons.secondary || buttons.middle || self.canvas.is_shift_held();
        let begun = match self.space_state().surface {
            _ if !self.space.is_on || moves_camera => None,
            WorkSurface::Lifted => self.lift_begun(sample),
            surface @ (WorkSurface::Facing | WorkSurface::Level) => self.branch_begun(sample, surface),
        };
        let Some(stroke) = begun else { return false };
        // A plant that becomes larger under the pen does not move away from it.
        self.plant.take_hold();
        self.space.stroke = Some(stroke);
        true
    }

    /// A new branch with its first sample.
    fn branch_begun(&self, sample: &PenSample, surface: WorkSurface) -> Option<SpaceStroke> {
        let on_wood = self.wood_at(sample.position);
        let start = on_wood.map(|(_, place)| place).or_else(|| self.ground_at(sample.position))?;
        let normal = if surface == WorkSurface::Level { Vec3::Y } else { self.plant.forward()? };
        let built = self.built()?;
        let motion = on_wood.and_then(|(branch, place)| built.wood.posed.motion_at(branch, place));
        let frame = StrokeFrame { world: self.world()?, motion };
        Some(SpaceStroke {
            id: self.unused_id(),
            surface: DrawingSurface::Plane { through: start, normal },
            frame,
            began_ms: sample.time_ms,
            points: vec![frame.sample(start, self.pressed(sample), 0.0)],
            lifts: false,
        })
    }

    /// The branch drawn last, to be lifted from its beginning on; none away from it.
    fn lift_begun(&self, sample: &PenSample) -> Option<SpaceStroke> {
        let (stroke, built) = (self.last_in_space()?, self.built()?);
        let mut drawn = self.drawn_wood();
        let branch = drawn.find(|b| built.provenance.stroke(b.origin) == Some(stroke.id))?;
        self.place_on(branch, sample.position)?;
        let parent = branch.parent.and_then(|parent| built.wood.at(&built.plant, parent));
        let motion = parent.zip(branch.points.first());
        let motion = motion.and_then(|(parent, base)| built.wood.posed.motion_at(parent, *base));
        let frame = StrokeFrame { world: self.world()?, motion };
        let line: Vec<Vec3> = branch.points.clone();
        let start = *line.first()?;
        let seen = self.space.last.filter(|(id, _)| *id == stroke.id);
        let along = seen.map_or(Vec3::Y, |(_, along)| along);
        Some(SpaceStroke {
            id: stroke.id,
            surface: DrawingSurface::Ruled { line, along, from: 0.0 },
            frame,
            began_ms: sample.time_ms,
            points: vec![frame.sample(start, self.pressed(sample), 0.0)],
            lifts: true,
        })
    }

    /// The branch in space that is the newest stroke of its kind, if it stands as it was drawn.
    fn last_in_space(&self) -> Option<&Stroke> {
        let last = self.sketch().in_space().max_by_key(|stroke| stroke.id)?;
        pose_of(&self.sketch().part_poses, PartName::Stroke(last.id)).is_still().then_some(&**last)
    }

    /// Follows what the pen drew or painted in the view of the plant since this was asked last.
    pub(super) fn draw_in_space(&mut self) {
        for (phase, sample) in self.plant.take_drawn() {
            if self.garden.is_busy() {
                self.paint_garden(phase, &sample);
                continue;
            }
            if self.brush.stroke.is_some() {
                self.paint(phase, &sample);
                continue;
            }
            match phase {
                PenPhase::Move => self.extend_in_space(&sample, self.pressed(&sample)),
                PenPhase::Up => {
                    // A lifted pen presses no more: the end is as thick as what is before it.
                    let last = self.space.stroke.as_ref().and_then(|stroke| stroke.points.last());
                    let pressure = last.map_or(StrokePoint::NEUTRAL_PRESSURE, |last| last.pressure);
                    self.extend_in_space(&sample, pressure);
                    self.end_in_space();
                }
                PenPhase::Cancel => self.cancel_in_space(),
                _ => {}
            }
        }
    }

    /// One more sample of the branch under the pen.
    fn extend_in_space(&mut self, sample: &PenSample, pressure: f32) {
        let ray = self.plant.ray(self.plant.place(sample.position));
        let (Some(stroke), Some(ray)) = (self.space.stroke.as_mut(), ray) else { return };
        let Some(met) = stroke.surface.met_by(&ray) else { return };
        let when = (pressure, sample.time_ms - stroke.began_ms);
        let Some(new) = stroke.frame.next_sample(stroke.points.last(), met, when) else { return };
        stroke.points.push(new);
        if stroke.lifts {
            let lifted = lifted(stroke);
            return self.change_merging(Change::put(lifted), "lift");
        }
        self.live.set_stale();
    }

    /// What was drawn does not count.
    fn cancel_in_space(&mut self) {
        match self.space.stroke.take() {
            Some(stroke) if stroke.lifts && stroke.points.len() > 1 => {
                self.drawing.end_merging();
                let is_other = self.drawing.undo();
                self.changed(is_other);
            }
            _ => self.live.set_stale(),
        }
    }

    /// The pen is lifted: the branch counts.
    pub(super) fn end_in_space(&mut self) {
        let Some(stroke) = self.space.stroke.take() else { return };
        if stroke.lifts {
            // Once more it would be lifted along the first lines of sight; the next branch is drawn as before.
            self.space.surface = WorkSurface::Facing;
            return self.drawing.end_merging();
        }
        if stroke.points.len() < 2 {
            return self.live.set_stale();
        }
        if let DrawingSurface::Plane { normal, .. } = stroke.surface {
            self.space.last = Some((stroke.id, normal));
        }
        let SpaceStroke { id, points, .. } = stroke;
        self.change(Change::put(Stroke { id, tool: Tool::SpaceBranch, points, brush: None }));
    }

    /// What the pen presses, as the artist's curve has it.
    pub(super) fn pressed(&self, sample: &PenSample) -> f32 {
        let pressure = match sample.tool {
            PenTool::Pen | PenTool::Eraser => self.canvas.pressure(sample.pressure),
            PenTool::Finger(_) | PenTool::Mouse => StrokePoint::NEUTRAL_PRESSURE,
        };
        if pressure.is_nan() { StrokePoint::NEUTRAL_PRESSURE } else { pressure.clamp(0.0, 1.0) }
    }

    /// A name for a branch that no other stroke has, neither that under a pen on the canvas.
    pub(super) fn unused_id(&self) -> StrokeId {
        let on_canvas = self.canvas.growing().map_or(0, |stroke| stroke.id().saturating_add(1));
        self.drawing.next_id().max(on_canvas)
    }

    /// How the drawing maps to the world of the plant that is shown.
    pub(super) fn world(&self) -> Option<WorldFromCanvas> {
        self.built().map(|built| built.provenance.world_from_canvas)
    }

    /// The wood that branches in space can begin on, each branch with its place.
    pub(super) fn drawn_wood(&self) -> impl Iterator<Item = &Branch> {
        self.built().into_iter().flat_map(|built| built.wood.branches(&built.plant).map(|(_, branch)| branch))
    }
}

/// The branch that is lifted: as far as the pen has come, and the rest of it after that, moved along.
fn lifted(stroke: &SpaceStroke) -> Stroke {
    let mut points = stroke.points.clone();
    let last = stroke.points.last();
    let beyond = last.and_then(|last| stroke.surface.beyond(stroke.frame.place(last)));
    if let Some((last, (height, rest))) = last.zip(beyond) {
        let sample = |place: &Vec3| stroke.frame.sample(*place + height, last.pressure, last.time_ms);
        points.extend(rest.iter().map(sample));
    }
    Stroke { id: stroke.id, tool: Tool::SpaceBranch, points, brush: None }
}

#[cfg(test)]
#[path = "space_tests.rs"]
mod tests;
