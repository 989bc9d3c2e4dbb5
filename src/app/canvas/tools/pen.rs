//! Draws a stroke.

use super::shown::Shown;
use crate::app::canvas::desk::Desk;
use crate::app::canvas::outcome::CanvasOutcome;
use crate::app::canvas::stroke_builder::StrokeBuilder;
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

impl tool::Tool<Desk<'_>, Shown> for Pen {
    fn begin(&mut self, sample: &PenSample, desk: &mut Desk<'_>) {
        let how = (desk.settings.stabiliser, desk.settings.pressure);
        self.stroke = StrokeBuilder::begin((desk.new_id)(), self.kind, sample, desk.view, how);
        desk.out.extend(self.stroke.as_ref().map(|stroke| CanvasOutcome::StrokeBegan(stroke.id())));
    }

    fn sample(&mut self, sample: &PenSample, desk: &mut Desk<'_>) {
        let from = self.stroke.as_mut().and_then(|stroke| stroke.push(sample, desk.view));
        desk.out.extend(from.map(|from| CanvasOutcome::StrokeGrew { from }));
    }

    fn end(&mut self, sample: &PenSample, desk: &mut Desk<'_>) {
        if desk.touch.is_still {
            // A dot means nothing in a plant, and hardly anybody would see it.
            self.cancel(desk);
            let start = desk.touch.start;
            return desk.pick(&start);
        }
        if let Some(mut stroke) = self.stroke.take() {
            stroke.lift(sample, desk.view);
            desk.out.push(CanvasOutcome::StrokeFinished(stroke.finish()));
        }
    }

    fn cancel(&mut self, desk: &mut Desk<'_>) {
        desk.out.extend(self.stroke.take().map(|stroke| CanvasOutcome::StrokeCancelled(stroke.id())));
    }
}
