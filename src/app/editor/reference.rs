//! The picture under the drawing that artists trace.
//!
//! With the selection tool in hand an unlocked picture shows a frame: its corners scale it about the opposite corner, the
//! handle above turns it about its middle, in steps with Shift, its edges and its middle move it. What lies inside the frame
//! stays the lasso's. One drag is one step to undo.

use super::Editor;
use super::reference_hold::{Frame, GRIP, Hold, corners, drag};
use crate::app::canvas::transform::TURN_HANDLE_DISTANCE;
use crate::app::canvas_tool::CanvasTool;
use crate::pen::{PenEvent, PenPhase};
use crate::sketch::{Change, Picture, Reference};
use glam::{DVec2, Vec2};

/// Share of the visible canvas that a new picture fills.
const FILL: f64 = 0.8;

impl Editor {
    /// The picture's frame; `None` where it has none to show.
    pub(in crate::app) fn reference_frame(&self) -> Option<Frame> {
        let reference = self.sketch().reference.as_ref().filter(|r| r.visible && !r.locked)?;
        if self.canvas.tool() != CanvasTool::Select {
            return None;
        }
        let window = |p: Vec2| self.canvas.view().to_window(p.as_dvec2());
        let (corners, middle) = (corners(reference).map(window), window(reference.center));
        let edge = (corners[0] + corners[1]) / 2.0;
        let out = (edge - middle).normalize_or(DVec2::NEG_Y);
        let away = out * TURN_HANDLE_DISTANCE * self.layout.pixels_per_point();
        // Inside the picture where there is no room above it.
        let room = self.layout.canvas_px();
        let above = edge + away;
        let is_seen = above.cmpge(room.min).all() && above.cmple(room.max).all();
        Some(Frame { corners, middle, turn: [edge, if is_seen { above } else { edge - away }] })
    }

    /// Handles a pointer before the canvas does; whether it is at work on the picture.
    pub(super) fn hold_reference(&mut self, event: &PenEvent) -> bool {
        let at = event.sample.position;
        match (event.phase, self.pens.hold) {
            (PenPhase::Down, None) => {
                self.pens.hold = self.grip(at);
                self.pens.hold.is_some()
            }
            (PenPhase::Move, Some(hold)) => {
                let pointer = self.canvas.view().to_canvas(at).as_vec2();
                let steps = self.canvas.is_shift_held();
                self.edit_reference(|reference| drag(reference, hold, pointer, steps));
                true
            }
            (PenPhase::Up | PenPhase::Cancel, Some(_)) => {
                self.pens.hold = None;
                self.drawing.end_merging();
                true
            }
            (_, hold) => hold.is_some(),
        }
    }

    /// What of the frame is under the pointer.
    fn grip(&self, at: DVec2) -> Option<Hold> {
        let frame = self.reference_frame()?;
        let reference = self.sketch().reference.as_ref()?;
        let pointer = self.canvas.view().to_canvas(at).as_vec2();
        Hold::begin(reference, &frame, (at, pointer), GRIP * self.layout.pixels_per_point())
    }

    /// Puts a picture under the drawing.
    pub(super) fn lay(&mut self, picture: Picture) {
        let (center, width) = self.place_for(&picture);
        self.change(Change::reference(Some(Reference::new(picture, center, width))));
    }

    /// The middle of what is seen of the canvas, and a width that fits.
    fn place_for(&self, picture: &Picture) -> (glam::Vec2, f32) {
        let view = self.canvas.view();
        let area = self.layout.canvas_px();
        let size = picture.size_px().as_dvec2();
        let room = area.size() * FILL / view.zoom();
        let width = (room.x).min(room.y * size.x / size.y).max(1.0);
        (view.to_canvas(area.center()).as_vec2(), width as f32)
    }

    /// Changes how the picture lies; one slider is one step.
    pub(super) fn edit_reference(&mut self, edit: impl FnOnce(&mut Reference)) {
        if let Some(reference) = &self.sketch().reference {
            let mut reference = Reference::clone(reference);
            edit(&mut reference);
            self.change_merging(Change::reference(Some(reference)), "reference");
        }
    }
}
