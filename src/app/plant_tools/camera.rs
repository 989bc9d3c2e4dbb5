//! Moves the camera: turns it around the plant, or moves it beside it.

use crate::app::plant_view::PlantView;
use crate::app::tool::Tool;
use crate::pen::PenSample;
use glam::DVec2;

/// Moves the camera by what the pointer moves; what was moved stays.
#[derive(Debug)]
pub(super) struct MoveCamera {
    by: fn(&mut PlantView, DVec2),
    last: DVec2,
}

impl MoveCamera {
    /// Turns it around the plant.
    pub(super) fn orbit() -> Self {
        Self { by: PlantView::orbit, last: DVec2::ZERO }
    }

    /// Moves it beside the plant.
    pub(super) fn pan() -> Self {
        Self { by: PlantView::pan, last: DVec2::ZERO }
    }
}

impl Tool<PlantView> for MoveCamera {
    fn begin(&mut self, sample: &PenSample, _: &mut PlantView) {
        self.last = sample.position;
    }

    fn sample(&mut self, sample: &PenSample, view: &mut PlantView) {
        let from = std::mem::replace(&mut self.last, sample.position);
        if from != sample.position {
            (self.by)(view, sample.position - from);
        }
    }

    fn end(&mut self, sample: &PenSample, view: &mut PlantView) {
        self.sample(sample, view);
    }

    fn cancel(&mut self, _: &mut PlantView) {}
}
