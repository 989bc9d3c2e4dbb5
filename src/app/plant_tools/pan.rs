//! Moves the camera beside the plant.

use crate::app::plant_view::PlantView;
use crate::app::tool::Tool;
use crate::pen::PenSample;
use glam::DVec2;

/// Moves the camera; what was moved stays.
#[derive(Debug, Default)]
pub(super) struct Pan {
    last: DVec2,
}

impl Tool<PlantView> for Pan {
    fn begin(&mut self, sample: &PenSample, _: &mut PlantView) {
        self.last = sample.position;
    }

    fn sample(&mut self, sample: &PenSample, view: &mut PlantView) {
        let from = std::mem::replace(&mut self.last, sample.position);
        if from != sample.position {
            view.pan(sample.position - from);
        }
    }

    fn end(&mut self, sample: &PenSample, view: &mut PlantView) {
        self.sample(sample, view);
    }

    fn cancel(&mut self, _: &mut PlantView) {}
}
