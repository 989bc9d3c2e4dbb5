//! Moves, turns or zooms the canvas, or turns the plant.

use super::shown::Shown;
use crate::app::canvas::outcome::CanvasOutcome;
use crate::app::canvas::tool_context::ToolContext;
use crate::app::tool::Tool;
use crate::pen::PenSample;
use glam::DVec2;

/// Logical pixels of a drag with Ctrl+Space that zoom by Euler's number.
const ZOOM_DRAG: f64 = 200.0;

/// How a drag changes the view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::app::canvas) enum ViewDrag {
    Pan,
    Turn,
    Zoom,
    /// Turns the plant, not the canvas.
    Orbit,
}

/// Changes the view; what was changed stays.
#[derive(Debug)]
pub(in crate::app::canvas) struct MoveView {
    pub(in crate::app::canvas) by: ViewDrag,
}

impl Tool<ToolContext<'_>, Shown> for MoveView {
    fn begin(&mut self, _: &PenSample, _: &mut ToolContext<'_>) {}

    fn sample(&mut self, sample: &PenSample, context: &mut ToolContext<'_>) {
        let (start, from, to) = (context.touch.start.position, context.touch.last, sample.position);
        match self.by {
            ViewDrag::Pan => context.view.pan(to - from),
            ViewDrag::Turn => turn(context, from, to),
            ViewDrag::Zoom => {
                let along = (to.x - from.x) - (to.y - from.y);
                context.view.zoom_about(start, (along / (ZOOM_DRAG * context.scale_factor)).exp());
            }
            ViewDrag::Orbit => return context.out.push(CanvasOutcome::Orbit(to - from)),
        }
        context.out.push(CanvasOutcome::ViewChanged);
    }

    fn end(&mut self, sample: &PenSample, context: &mut ToolContext<'_>) {
        if context.has_moved(sample) {
            self.sample(sample, context);
        }
        context.view.settle();
    }

    fn cancel(&mut self, context: &mut ToolContext<'_>) {
        context.view.settle();
    }
}

/// Turns the canvas about the middle of what is seen of it.
fn turn(context: &mut ToolContext<'_>, from: DVec2, to: DVec2) {
    let middle = context.viewport.center();
    let (a, b) = (from - middle, to - middle);
    if a.length() * b.length() > 0.0 {
        context.view.rotate_about(middle, a.angle_to(b));
    }
}
