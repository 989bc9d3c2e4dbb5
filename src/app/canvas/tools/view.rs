//! Moves, turns or zooms the canvas, or turns the plant.

use super::shown::Shown;
use crate::app::canvas::desk::Desk;
use crate::app::canvas::outcome::CanvasOutcome;
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

impl Tool<Desk<'_>, Shown> for MoveView {
    fn begin(&mut self, _: &PenSample, _: &mut Desk<'_>) {}

    fn sample(&mut self, sample: &PenSample, desk: &mut Desk<'_>) {
        let (start, from, to) = (desk.touch.start.position, desk.touch.last, sample.position);
        match self.by {
            ViewDrag::Pan => desk.view.pan(to - from),
            ViewDrag::Turn => turn(desk, from, to),
            ViewDrag::Zoom => {
                let along = (to.x - from.x) - (to.y - from.y);
                desk.view.zoom_about(start, (along / (ZOOM_DRAG * desk.scale_factor)).exp());
            }
            ViewDrag::Orbit => return desk.out.push(CanvasOutcome::Orbit(to - from)),
        }
        desk.out.push(CanvasOutcome::ViewChanged);
    }

    fn end(&mut self, sample: &PenSample, desk: &mut Desk<'_>) {
        if desk.has_moved(sample) {
            self.sample(sample, desk);
        }
        desk.view.settle();
    }

    fn cancel(&mut self, desk: &mut Desk<'_>) {
        desk.view.settle();
    }
}

/// Turns the canvas about the middle of what is seen of it.
fn turn(desk: &mut Desk<'_>, from: DVec2, to: DVec2) {
    let middle = desk.viewport.center();
    let (a, b) = (from - middle, to - middle);
    if a.length() * b.length() > 0.0 {
        desk.view.rotate_about(middle, a.angle_to(b));
    }
}
