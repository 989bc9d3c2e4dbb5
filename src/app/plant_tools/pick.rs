//! Picks what is tapped on the plant; a second tap soon after shows the front instead.

use crate::app::plant_view::PlantView;
use crate::app::tool::Tool;
use crate::pen::PenSample;

/// Picks where the pen is lifted.
#[derive(Debug, Default)]
pub(super) struct Pick {
    /// Whether what is picked joins what is selected.
    pub(super) besides: bool,
}

impl Tool<PlantView> for Pick {
    fn begin(&mut self, _: &PenSample, _: &mut PlantView) {}

    fn sample(&mut self, _: &PenSample, _: &mut PlantView) {}

    fn end(&mut self, sample: &PenSample, view: &mut PlantView) {
        view.tap(sample.position, self.besides);
    }

    fn cancel(&mut self, _: &mut PlantView) {}
}
