//! Draws a stroke.

use super::shown::Shown;
use crate::app::canvas::outcome::CanvasOutcome;
use crate::app::canvas::stroke_builder::StrokeBuilder;
use crate::app::canvas::tool_context::ToolContext;
use crate::app::tool;
use crate::pen::PenSample;
use crate::sketch::Tool;

/// Draws a stroke; a tap asks about the stroke under it instead.
#[derive(Debug)]
pub(in crate::app::canvas) struct Pen {
    /// What it is drawn as.
    kind: Tool,
    /// `None` where it would begin off the largest canvas.
    stroke: Option<StrokeBuilder>,
}

impl Pen {
    /// Draws strokes of this kind.
    pub(in crate::app::canvas) fn new(kind: Tool) -> Self {
        Self { kind, stroke: None }
    }

    /// The stroke so far.
    pub(in crate::app::canvas) fn stroke(&self) -> Option<&StrokeBuilder> {
        self.stroke.as_ref()
    }
}

impl tool::Tool<ToolContext<'_>, Shown> for Pen {
    fn begin(&mut self, sample: &PenSample, context: &mut ToolContext<'_>) {
        let how = (context.settings.stabiliser, context.settings.pressure);
        self.stroke = StrokeBuilder::begin((context.new_id)(), self.kind, sample, context.view, how);
        context.out.extend(self.stroke.as_ref().map(|stroke| CanvasOutcome::StrokeBegan(stroke.id())));
    }

    fn sample(&mut self, sample: &PenSample, context: &mut ToolContext<'_>) {
        let from = self.stroke.as_mut().and_then(|stroke| stroke.push(sample, context.view));
        context.out.extend(from.map(|from| CanvasOutcome::StrokeGrew { from }));
    }

    fn end(&mut self, sample: &PenSample, context: &mut ToolContext<'_>) {
        if context.touch.is_still {
            // A dot means nothing in a plant, and hardly anybody would see it.
            self.cancel(context);
            let start = context.touch.start;
            return context.pick(&start);
        }
        if let Some(mut stroke) = self.stroke.take() {
            stroke.lift(sample, context.view);
            context.out.push(CanvasOutcome::StrokeFinished(stroke.finish()));
        }
    }

    fn cancel(&mut self, context: &mut ToolContext<'_>) {
        context.out.extend(self.stroke.take().map(|stroke| CanvasOutcome::StrokeCancelled(stroke.id())));
    }
}
