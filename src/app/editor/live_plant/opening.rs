//! How far the flowers have opened: what the slider shows, and their opening replayed from the buds.

use super::LivePlant;
use super::growth::own_number;
use crate::app::editor::replay::Replayed;
use crate::app::panels::opening::OPEN;
use crate::app::panels::snapshot::OpeningState;
use crate::sketch::Sketch;

impl LivePlant {
    /// What the panels show of flowers that open; none where the plant has no such flowers, or florets that open in turn.
    pub(in crate::app) fn opening_state(&self, sketch: &Sketch) -> Option<OpeningState> {
        let is_single = self.species().is_some_and(|species| species.inflorescence.is_none());
        if !(self.counts.opens && is_single) {
            return None;
        }
        let own = own_number(sketch, OPEN);
        let replay = self.replay_of(Replayed::Opening);
        let open = replay.map_or(own.unwrap_or(1.0), |replay| replay.value()).clamp(0.0, 1.0);
        let playing = replay.is_some_and(|replay| replay.is_running());
        Some(OpeningState { open, chosen: own.is_some(), playing })
    }
}
