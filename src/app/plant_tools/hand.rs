//! Which tool a pen works with in the view of the plant.

use super::orbit::Orbit;
use super::pan::Pan;
use super::pick::Pick;
use crate::app::plant_view::PlantView;
use crate::app::tool::Tool;
use crate::pen::{PenEvent, PenPhase, PenSample, PenTool};

/// Farthest that a pen moves in a tap, in logical pixels.
const TAP_SLOP: f64 = 4.0;

/// A tool of the view of the plant.
pub type PlantTool = Box<dyn Tool<PlantView> + Send>;

/// Which of the tools is at work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum AtWork {
    Pick,
    Orbit,
    Pan,
    Own,
}

/// A touch from its beginning.
#[derive(Clone, Copy, Debug)]
struct Touch {
    owner: PenTool,
    start: PenSample,
    at_work: AtWork,
}

/// The tools of pens in the view of the plant.
#[derive(Default)]
pub struct PlantHand {
    pick: Pick,
    orbit: Orbit,
    pan: Pan,
    /// Works in the place of those.
    own: Option<PlantTool>,
    touch: Option<Touch>,
}

impl PlantHand {
    /// Takes up a tool in the place of those that move the camera and pick, from the next touch on; `None` gives it back.
    pub fn take_up(&mut self, tool: Option<PlantTool>, view: &mut PlantView) {
        self.cancel(view);
        self.own = tool;
    }

    /// Hears a pen that went down over the plant, until it is lifted; `shift` says whether that key is held.
    pub fn event(&mut self, event: &PenEvent, shift: bool, view: &mut PlantView) {
        let sample = &event.sample;
        let is_owner = self.touch.is_some_and(|touch| touch.owner == sample.tool);
        match event.phase {
            PenPhase::Down if self.touch.is_none() => self.begin(sample, shift, view),
            PenPhase::Move if is_owner => self.moved(sample, shift, view),
            PenPhase::Up | PenPhase::Leave if is_owner => {
                if let Some(touch) = self.touch.take() {
                    self.tool(touch.at_work).end(sample, view);
                }
            }
            PenPhase::Cancel if is_owner => self.cancel(view),
            _ => {}
        }
    }

    fn begin(&mut self, sample: &PenSample, shift: bool, view: &mut PlantView) {
        self.pick.besides = shift;
        let at_work = if self.own.is_some() { AtWork::Own } else { AtWork::Pick };
        self.touch = Some(Touch { owner: sample.tool, start: *sample, at_work });
        self.tool(at_work).begin(sample, view);
    }

    fn moved(&mut self, sample: &PenSample, shift: bool, view: &mut PlantView) {
        let Some(mut touch) = self.touch else { return };
        let slop = TAP_SLOP * view.pixels_per_point();
        if touch.at_work == AtWork::Pick && sample.position.distance(touch.start.position) > slop {
            self.pick.cancel(view);
            let moves = shift || sample.buttons.secondary || sample.buttons.middle;
            touch.at_work = if moves { AtWork::Pan } else { AtWork::Orbit };
            self.touch = Some(touch);
            self.tool(touch.at_work).begin(&touch.start, view);
        }
        self.tool(touch.at_work).sample(sample, view);
    }

    fn cancel(&mut self, view: &mut PlantView) {
        if let Some(touch) = self.touch.take() {
            self.tool(touch.at_work).cancel(view);
        }
    }

    fn tool(&mut self, at_work: AtWork) -> &mut dyn Tool<PlantView> {
        match (at_work, &mut self.own) {
            (AtWork::Own, Some(own)) => &mut **own,
            (AtWork::Orbit, _) => &mut self.orbit,
            (AtWork::Pan, _) => &mut self.pan,
            (AtWork::Pick | AtWork::Own, _) => &mut self.pick,
        }
    }
}

#[cfg(test)]
#[path = "hand_tests.rs"]
mod tests;
