//! Draws in the space of the plant: hands every sample of the pen on; what they draw, the editor makes of them.

use super::pick::Pick;
use crate::app::plant_view::PlantView;
use crate::app::tool::Tool;
use crate::pen::{PenPhase, PenSample};

/// Draws a line, which begins where the pen has moved farther than in a tap; a tap picks, or is drawn as well.
#[derive(Debug, Default)]
pub(super) struct Draw {
    begun: Option<PenSample>,
    /// Farthest that a tap moves, physical pixels.
    pub(super) slop: f64,
    /// It has moved farther, and so is a line.
    is_line: bool,
    /// Whether what draws takes a tap, too.
    pub(super) takes_taps: bool,
    pub(super) pick: Pick,
}

impl Tool<PlantView> for Draw {
    fn begin(&mut self, sample: &PenSample, view: &mut PlantView) {
        (self.begun, self.is_line) = (Some(*sample), false);
        self.pick.begin(sample, view);
    }

    fn sample(&mut self, sample: &PenSample, view: &mut PlantView) {
        let far = self.begun.is_some_and(|begun| begun.position.distance(sample.position) > self.slop);
        self.is_line |= far;
        if self.is_line {
            view.draw(PenPhase::Move, sample);
        }
    }

    fn end(&mut self, sample: &PenSample, view: &mut PlantView) {
        if self.is_line || self.takes_taps {
            return view.draw(PenPhase::Up, sample);
        }
        view.draw(PenPhase::Cancel, sample);
        self.pick.end(sample, view);
    }

    fn cancel(&mut self, view: &mut PlantView) {
        if let Some(begun) = self.begun.take() {
            view.draw(PenPhase::Cancel, &begun);
        }
    }
}
