//! Actions that concern the canvas: tools, the selection, strokes that are pasted, and showing all.

use super::controller::Canvas;
use super::outcome::{CanvasOutcome, Drawing};
use super::view::Rect;
use crate::app::action::Action;
use crate::app::canvas_tool::CanvasTool;
use crate::sketch::change::StrokeChange;
use crate::sketch::{Stroke, StrokeId};
use glam::{DAffine2, DVec2};
use std::sync::Arc;

/// How far beside themselves copies lie, in logical pixels.
const COPY_OFFSET: f64 = 24.0;

/// How far the arrow keys move strokes, without and with Shift, in logical pixels.
const NUDGES: (f64, f64) = (1.0, 10.0);

/// Most places beside each other that are tried for pasted strokes.
const MOST_PLACES: usize = 64;

impl Canvas {
    /// Carries out an action if it is one of the canvas: `SetTool`, `SetPart`, `DeleteSelected`, `DuplicateSelected`,
    /// `MirrorSelected`, `NudgeSelected`, `SelectAll`, `SelectStroke`, `FitCanvas`, `Zoom`. Gives whether it was; all others are the
    /// application's.
    pub fn act(&mut self, action: &Action, drawing: &mut Drawing, out: &mut Vec<CanvasOutcome>) -> bool {
        self.sync(drawing.strokes, out);
        match action {
            Action::SetTool(tool) => self.set_tool(*tool, out),
            Action::SetPart(tool) => {
                let changes = self.selection.set_part(&self.index, *tool);
                self.change(changes, out);
            }
            Action::DeleteSelected => {
                let changes = self.selection.delete(&self.index);
                self.change(changes, out);
            }
            Action::DuplicateSelected => {
                let beside = self.view.vector_to_canvas(DVec2::splat(COPY_OFFSET * self.scale_factor));
                let changes = self.selection.duplicate(&self.index, beside, drawing.new_id);
                self.change(changes, out);
            }
            Action::MirrorSelected(mirror) => {
                let changes = self.selection.mirror(&self.index, *mirror);
                self.change(changes, out);
            }
            Action::NudgeSelected { right, down, far } => {
                let step = if *far { NUDGES.1 } else { NUDGES.0 } * self.scale_factor;
                self.nudge(DVec2::new(f64::from(*right), f64::from(*down)) * step, out);
            }
            Action::SelectAll => {
                self.set_tool(CanvasTool::Select, out);
                let all: Vec<StrokeId> = drawing.strokes.iter().map(|s| s.id).collect();
                if self.selection.take(all, false) {
                    self.selection_changed(out);
                }
            }
            Action::SelectStroke { stroke, besides } => {
                self.set_tool(CanvasTool::Select, out);
                if drawing.strokes.iter().any(|s| s.id == *stroke) && self.selection.take([*stroke], *besides)
                {
                    self.selection_changed(out);
                }
            }
            Action::FitCanvas => {
                let bounds = bounds_of(drawing.strokes)
                    .unwrap_or(Rect::new(DVec2::ZERO, self.viewport().size() / self.scale_factor));
                self.fit(bounds, out);
            }
            Action::Zoom(steps) => self.zoom_steps(*steps, out),
            _ => return false,
        }
        true
    }

    /// Selects no stroke.
    pub fn deselect(&mut self, out: &mut Vec<CanvasOutcome>) {
        if self.selection.take([], false) {
            self.selection_changed(out);
        }
    }

    /// Changes the drawing ahead of the application, which applies the same: copies are selected before they are there.
    fn change(&mut self, changes: Vec<StrokeChange>, out: &mut Vec<CanvasOutcome>) {
        if changes.is_empty() {
            return;
        }
        // A handle on its way held strokes that are about to be others.
        self.abort(out);
        changes.iter().for_each(|change| self.index.apply(change));
        self.selection.keep_known(&self.index);
        out.push(CanvasOutcome::Changed(changes));
        self.selection_changed(out);
    }

    /// Moves the selection by so many physical pixels of the window.
    fn nudge(&mut self, by: DVec2, out: &mut Vec<CanvasOutcome>) {
        let shift = DAffine2::from_translation(self.view.vector_to_canvas(by));
        let changes = self.selection.transform(&self.index, &shift);
        if changes.is_empty() {
            return;
        }
        self.abort(out);
        changes.iter().for_each(|change| self.index.apply(change));
        self.refresh_bounds();
        out.extend([CanvasOutcome::Nudged(changes), CanvasOutcome::OverlayChanged]);
    }

    /// Puts strokes from elsewhere into the drawing, under new names, and selects them: where they were drawn if that is
    /// seen, otherwise into the middle of what is seen, and never exactly onto themselves.
    pub fn insert(&mut self, strokes: &[Arc<Stroke>], drawing: &mut Drawing, out: &mut Vec<CanvasOutcome>) {
        let Some(bounds) = bounds_of(strokes) else { return };
        self.sync(drawing.strokes, out);
        let (shown, place) = (self.viewport(), self.view.to_window(bounds.center()));
        let is_seen = place.cmpge(shown.min).all() && place.cmple(shown.max).all();
        let mut shift = match is_seen {
            true => DVec2::ZERO,
            false => self.view.to_canvas(shown.center()) - bounds.center(),
        };
        let beside = self.view.vector_to_canvas(DVec2::splat(COPY_OFFSET * self.scale_factor));
        let first = |shift: DVec2| Some(strokes.first()?.points.first()?.position.as_dvec2() + shift);
        let is_taken = |shift: DVec2| {
            let place = first(shift).map(DVec2::as_vec2);
            drawing.strokes.iter().any(|stroke| stroke.points.first().map(|p| p.position) == place)
        };
        for _ in 0..MOST_PLACES {
            if is_taken(shift) {
                shift += beside;
            }
        }
        self.set_tool(CanvasTool::Select, out);
        let changes = self.selection.put_copies(strokes, shift, drawing.new_id);
        self.change(changes, out);
    }

    /// A tool taken up while another is at work serves from the next touch on. The selection belongs to its tool.
    fn set_tool(&mut self, tool: CanvasTool, out: &mut Vec<CanvasOutcome>) {
        self.tool = tool;
        if tool != CanvasTool::Select {
            self.deselect(out);
        }
        out.push(CanvasOutcome::OverlayChanged);
    }
}

/// The box around strokes on the canvas; `None` without any.
fn bounds_of(strokes: &[Arc<Stroke>]) -> Option<Rect> {
    let mut places = strokes.iter().flat_map(|s| &s.points).map(|p| p.position);
    let first = places.next()?;
    let (low, high) = places.fold((first, first), |(low, high), p| (low.min(p), high.max(p)));
    Some(Rect { min: low.as_dvec2(), max: high.as_dvec2() })
}
