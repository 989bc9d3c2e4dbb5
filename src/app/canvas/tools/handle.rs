//! Drags a handle of the selection: moves, scales or turns it.

use super::shown::Shown;
use crate::app::canvas::outcome::CanvasOutcome;
use crate::app::canvas::tool_context::ToolContext;
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

impl Tool<ToolContext<'_>, Shown> for DragHandle {
    fn begin(&mut self, _: &PenSample, _: &mut ToolContext<'_>) {}

    fn sample(&mut self, sample: &PenSample, context: &mut ToolContext<'_>) {
        self.drag.drag_to(context.place(sample));
        if !context.touch.is_still {
            context.out.extend([CanvasOutcome::PreviewChanged, CanvasOutcome::OverlayChanged]);
        }
    }

    fn end(&mut self, sample: &PenSample, context: &mut ToolContext<'_>) {
        if context.has_moved(sample) {
            self.sample(sample, context);
        }
        if context.touch.is_still {
            return context.tap_select();
        }
        let transform = self.drag.transform(context.keys.shift);
        context.change(context.selection.transform(context.index, &transform));
    }

    fn cancel(&mut self, context: &mut ToolContext<'_>) {
        context.out.push(CanvasOutcome::PreviewChanged);
    }

    fn preview(&self) -> Shown {
        Shown::Drag(self.drag)
    }
}
