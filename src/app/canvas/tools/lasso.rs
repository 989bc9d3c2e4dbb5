//! Selects strokes: those in a loop, or the one that is tapped.

use super::shown::Shown;
use crate::app::canvas::outcome::CanvasOutcome;
use crate::app::canvas::select::lassoed;
use crate::app::canvas::tool_context::ToolContext;
use crate::app::tool::Tool;
use crate::pen::PenSample;
use glam::DVec2;

/// Shortest step of a lasso, in logical pixels.
const STEP: f64 = 1.5;

/// Selects strokes; with Shift besides those that are.
#[derive(Debug, Default)]
pub(in crate::app::canvas) struct Lasso {
    /// Canvas places.
    places: Vec<DVec2>,
}

impl Tool<ToolContext<'_>, Shown> for Lasso {
    fn begin(&mut self, sample: &PenSample, context: &mut ToolContext<'_>) {
        self.places.push(context.place(sample));
    }

    fn sample(&mut self, sample: &PenSample, context: &mut ToolContext<'_>) {
        let (place, step) = (context.place(sample), STEP * context.scale_factor / context.view.zoom());
        if self.places.last().is_none_or(|last| last.distance(place) >= step) {
            self.places.push(place);
            context.out.push(CanvasOutcome::OverlayChanged);
        }
    }

    fn end(&mut self, sample: &PenSample, context: &mut ToolContext<'_>) {
        if context.has_moved(sample) {
            self.sample(sample, context);
        }
        if context.touch.is_still {
            context.tap_select();
        } else if context.selection.take(lassoed(&self.places, context.index), context.keys.shift) {
            context.selection_changed();
        }
    }

    fn cancel(&mut self, _: &mut ToolContext<'_>) {}

    fn preview(&self) -> Shown {
        Shown::Lasso(self.places.clone())
    }
}
