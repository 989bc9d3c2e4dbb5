//! Selects strokes: those in a loop, or the one that is tapped.

use super::shown::Shown;
use crate::app::canvas::desk::Desk;
use crate::app::canvas::outcome::CanvasOutcome;
use crate::app::canvas::select::lassoed;
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

impl Tool<Desk<'_>, Shown> for Lasso {
    fn begin(&mut self, sample: &PenSample, desk: &mut Desk<'_>) {
        self.places.push(desk.place(sample));
    }

    fn sample(&mut self, sample: &PenSample, desk: &mut Desk<'_>) {
        let (place, step) = (desk.place(sample), STEP * desk.scale_factor / desk.view.zoom());
        if self.places.last().is_none_or(|last| last.distance(place) >= step) {
            self.places.push(place);
            desk.out.push(CanvasOutcome::OverlayChanged);
        }
    }

    fn end(&mut self, sample: &PenSample, desk: &mut Desk<'_>) {
        if desk.has_moved(sample) {
            self.sample(sample, desk);
        }
        if desk.touch.is_still {
            desk.tap_select();
        } else if desk.selection.take(lassoed(&self.places, desk.index), desk.keys.shift) {
            desk.selection_changed();
        }
    }

    fn cancel(&mut self, _: &mut Desk<'_>) {}

    fn preview(&self) -> Shown {
        Shown::Lasso(self.places.clone())
    }
}
