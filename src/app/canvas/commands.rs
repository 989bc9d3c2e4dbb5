//! Actions that concern the canvas: tools, the selection, and showing all.

use super::controller::Canvas;
use super::outcome::{CanvasOutcome, Drawing};
use super::view::Rect;
use crate::app::action::{Action, CanvasTool};
use crate::sketch::StrokeId;
use crate::sketch::change::StrokeChange;
use glam::DVec2;

/// How far beside themselves copies lie, in logical pixels.
const COPY_OFFSET: f64 = 24.0;

impl Canvas {
    /// Carries out an action if it is one of the canvas: `SetTool`, `SetPart`, `DeleteSelected`, `DuplicateSelected`,
    /// `SelectAll`, `FitCanvas`, `Zoom`. Gives whether it was; all others are the application's.
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
            Action::SelectAll => {
                self.set_tool(CanvasTool::Select, out);
                let all: Vec<StrokeId> = drawing.strokes.iter().map(|s| s.id).collect();
                if self.selection.take(all, false) {
                    self.selection_changed(out);
                }
            }
            Action::FitCanvas => {
                let bounds = bounds(drawing)
                    .unwrap_or(Rect::new(DVec2::ZERO, self.viewport.size() / self.scale_factor));
                self.fit(bounds, out);
            }
            Action::Zoom(steps) => self.zoom_steps(*steps, out),
            _ => return false,
        }
        true
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

    /// A tool taken up while another is at work serves from the next touch on. The selection belongs to its tool.
    fn set_tool(&mut self, tool: CanvasTool, out: &mut Vec<CanvasOutcome>) {
        self.tool = tool;
        if tool != CanvasTool::Select && self.selection.take([], false) {
            self.selection_changed(out);
        }
        out.push(CanvasOutcome::OverlayChanged);
    }
}

fn bounds(drawing: &Drawing) -> Option<Rect> {
    let mut places = drawing.strokes.iter().flat_map(|s| &s.points).map(|p| p.position);
    let first = places.next()?;
    let (low, high) = places.fold((first, first), |(low, high), p| (low.min(p), high.max(p)));
    Some(Rect { min: low.as_dvec2(), max: high.as_dvec2() })
}
