//! Drags a handle of the selection: moves, scales or turns it.

use super::shown::Shown;
use crate::app::canvas::desk::Desk;
use crate::app::canvas::outcome::CanvasOutcome;
use crate::app::canvas::transform::{Drag, Handle};
use crate::app::tool::Tool;
use crate::pen::PenSample;

/// Drags a handle; a tap selects what is under it instead.
#[derive(Debug)]
pub(in crate::app::canvas) struct DragHandle {
    drag: Drag,
}

impl DragHandle {
    /// A handle that was taken hold of.
    pub(in crate::app::canvas) fn new(drag: Drag) -> Self {
        Self { drag }
    }

    /// Which one it is.
    pub(in crate::app::canvas) fn handle(&self) -> Handle {
        self.drag.handle
    }
}

impl Tool<Desk<'_>, Shown> for DragHandle {
    fn begin(&mut self, _: &PenSample, _: &mut Desk<'_>) {}

    fn sample(&mut self, sample: &PenSample, desk: &mut Desk<'_>) {
        self.drag.drag_to(desk.place(sample));
        if !desk.touch.is_still {
            desk.out.extend([CanvasOutcome::PreviewChanged, CanvasOutcome::OverlayChanged]);
        }
    }

    fn end(&mut self, sample: &PenSample, desk: &mut Desk<'_>) {
        if desk.has_moved(sample) {
            self.sample(sample, desk);
        }
        if desk.touch.is_still {
            return desk.tap_select();
        }
        let transform = self.drag.transform(desk.keys.shift);
        desk.change(desk.selection.transform(desk.index, &transform));
    }

    fn cancel(&mut self, desk: &mut Desk<'_>) {
        desk.out.push(CanvasOutcome::PreviewChanged);
    }

    fn preview(&self) -> Shown {
        Shown::Drag(self.drag)
    }
}
