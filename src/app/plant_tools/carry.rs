//! Carries what was taken hold of, a plant or a control point of a petal; where to, the editor makes of it.

use crate::app::plant_view::PlantView;
use crate::app::tool::Tool;
use crate::pen::PenSample;
use glam::DVec2;

/// Hands on from where to where the pointer moves.
#[derive(Debug, Default)]
pub(super) struct Carry {
    last: DVec2,
}

impl Tool<PlantView> for Carry {
    fn begin(&mut self, sample: &PenSample, _: &mut PlantView) {
        self.last = sample.position;
    }

    fn sample(&mut self, sample: &PenSample, view: &mut PlantView) {
        let from = std::mem::replace(&mut self.last, sample.position);
        view.carry(from, sample.position);
    }

    fn end(&mut self, sample: &PenSample, view: &mut PlantView) {
        self.sample(sample, view);
    }

    fn cancel(&mut self, _: &mut PlantView) {}
}
