//! Erases what it sweeps over.

use super::shown::Shown;
use crate::app::canvas::erase::Eraser;
use crate::app::canvas::outcome::CanvasOutcome;
use crate::app::canvas::tool_context::ToolContext;
use crate::app::tool::Tool;
use crate::pen::PenSample;

/// Erases what it sweeps over; one drag is one change.
#[derive(Debug)]
pub(in crate::app::canvas) struct Erase {
    eraser: Eraser,
}

impl Erase {
    /// An eraser that comes down.
    pub(in crate::app::canvas) fn new(eraser: Eraser) -> Self {
        Self { eraser }
    }

    fn sweep(&mut self, sample: &PenSample, context: &mut ToolContext<'_>) {
        let place = context.place(sample);
        if self.eraser.sweep(place, context.index, context.new_id) {
            context.out.push(CanvasOutcome::PreviewChanged);
        }
    }
}

impl Tool<ToolContext<'_>, Shown> for Erase {
    fn begin(&mut self, sample: &PenSample, context: &mut ToolContext<'_>) {
        context.sync();
        self.sweep(sample, context);
    }

    fn sample(&mut self, sample: &PenSample, context: &mut ToolContext<'_>) {
        self.sweep(sample, context);
        context.out.push(CanvasOutcome::OverlayChanged);
    }

    fn end(&mut self, sample: &PenSample, context: &mut ToolContext<'_>) {
        if context.has_moved(sample) {
            self.sample(sample, context);
        }
        context.change(self.eraser.changes());
    }

    fn cancel(&mut self, context: &mut ToolContext<'_>) {
        context.out.push(CanvasOutcome::PreviewChanged);
    }

    fn preview(&self) -> Shown {
        Shown::Changes(self.eraser.changes())
    }
}
