//! What a tool of the canvas works on: the parts of the canvas that it may read and change, the drawing, and where what comes
//! of it goes.

use super::outcome::CanvasOutcome;
use super::select::Selection;
use super::settings::CanvasSettings;
use super::stroke_index::StrokeIndex;
use super::view::{CanvasView, Rect};
use crate::pen::{PenSample, PenTool};
use crate::sketch::change::StrokeChange;
use crate::sketch::{Stroke, StrokeId};
use glam::DVec2;
use std::sync::Arc;

/// Distance within which a tap of a pen or mouse hits a stroke, in logical pixels.
pub const PICK_REACH: f64 = 10.0;

/// Distance within which a tap of a finger hits a stroke, in logical pixels.
pub const FINGER_PICK_REACH: f64 = 20.0;

/// Modifier keys held.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Keys {
    pub(super) space: bool,
    pub(super) shift: bool,
    pub(super) ctrl: bool,
}

/// A touch so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch {
    /// Where and how it began.
    pub(super) start: PenSample,
    /// Where it was at the last sample, physical pixels of the window.
    pub(super) last: DVec2,
    /// Whether it has not moved further than a tap does. Time does not count: on a busy machine the release arrives late.
    pub(super) is_still: bool,
}

/// What a tool works on.
pub(super) struct ToolContext<'a> {
    pub(super) view: &'a mut CanvasView,
    pub(super) index: &'a mut StrokeIndex,
    pub(super) selection: &'a mut Selection,
    /// Box around the selection on the canvas.
    pub(super) bounds: &'a mut Option<Rect>,
    pub(super) settings: &'a CanvasSettings,
    /// The part of the window that shows the canvas, physical pixels.
    pub(super) viewport: Rect,
    pub(super) scale_factor: f64,
    pub(super) keys: Keys,
    /// The strokes of the drawing, oldest first.
    pub(super) strokes: &'a [Arc<Stroke>],
    /// Gives a name that no stroke has or had.
    pub(super) new_id: &'a mut dyn FnMut() -> StrokeId,
    pub(super) out: &'a mut Vec<CanvasOutcome>,
    /// The touch that the tool works with.
    pub(super) touch: Touch,
}

impl ToolContext<'_> {
    /// The place on the canvas of a sample.
    pub(super) fn place(&self, sample: &PenSample) -> DVec2 {
        self.view.to_canvas(sample.position)
    }

    /// Whether a sample is elsewhere than the one before.
    pub(super) fn has_moved(&self, sample: &PenSample) -> bool {
        self.touch.last != sample.position
    }

    /// Brings what is known of the strokes up to the drawing.
    pub(super) fn sync(&mut self) {
        self.index.sync(self.strokes);
        if self.selection.keep_known(self.index) {
            self.selection_changed();
        }
    }

    pub(super) fn selection_changed(&mut self) {
        *self.bounds = self.selection.bounds(self.index);
        self.out.push(CanvasOutcome::SelectionChanged);
    }

    /// Changes the drawing, unless that is nothing.
    pub(super) fn change(&mut self, changes: Vec<StrokeChange>) {
        if !changes.is_empty() {
            self.out.push(CanvasOutcome::Changed(changes));
        }
    }

    /// The stroke under a pointer.
    fn stroke_at(&mut self, sample: &PenSample) -> Option<StrokeId> {
        self.sync();
        let is_finger = matches!(sample.tool, PenTool::Finger(_));
        let reach = if is_finger { FINGER_PICK_REACH } else { PICK_REACH };
        let reach = reach * self.scale_factor / self.view.zoom();
        self.index.nearest(self.place(sample), reach)
    }

    /// Asks about the stroke under a pointer.
    pub(super) fn pick(&mut self, sample: &PenSample) {
        let at = sample.position;
        if let Some(id) = self.stroke_at(sample) {
            self.out.push(CanvasOutcome::TapOnStroke { id, at });
        }
    }

    /// Selects the stroke that was tapped, with Shift besides others; none where there is none.
    pub(super) fn tap_select(&mut self) {
        let start = self.touch.start;
        let changed = match (self.stroke_at(&start), self.keys.shift) {
            (Some(id), true) => {
                self.selection.toggle(id);
                true
            }
            (None, true) => false,
            (found, false) => self.selection.take(found, false),
        };
        if changed {
            self.selection_changed();
        }
    }
}
