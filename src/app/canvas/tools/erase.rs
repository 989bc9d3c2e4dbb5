//! Erases what it sweeps over.

use super::shown::Shown;
use crate::app::canvas::desk::Desk;
use crate::app::canvas::erase::Eraser;
use crate::app::canvas::outcome::CanvasOutcome;
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

    fn sweep(&mut self, sample: &PenSample, desk: &mut Desk<'_>) {
        let place = desk.place(sample);
        if self.eraser.sweep(place, desk.index, desk.new_id) {
            desk.out.push(CanvasOutcome::PreviewChanged);
        }
    }
}

impl Tool<Desk<'_>, Shown> for Erase {
    fn begin(&mut self, sample: &PenSample, desk: &mut Desk<'_>) {
        desk.sync();
        self.sweep(sample, desk);
    }

    fn sample(&mut self, sample: &PenSample, desk: &mut Desk<'_>) {
        self.sweep(sample, desk);
        desk.out.push(CanvasOutcome::OverlayChanged);
    }

    fn end(&mut self, sample: &PenSample, desk: &mut Desk<'_>) {
        if desk.has_moved(sample) {
            self.sample(sample, desk);
        }
        desk.change(self.eraser.changes());
    }

    fn cancel(&mut self, desk: &mut Desk<'_>) {
        desk.out.push(CanvasOutcome::PreviewChanged);
    }

    fn preview(&self) -> Shown {
        Shown::Changes(self.eraser.changes())
    }
}
