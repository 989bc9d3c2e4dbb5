//! Which tool a pointer works with in the view of the plant.

use super::camera::MoveCamera;
use super::carry::Carry;
use super::draw::Draw;
use super::pick::Pick;
use crate::app::canvas::gesture::{Touch as Gesture, TouchGestures};
use crate::app::plant_view::PlantView;
use crate::app::tool::Tool;
use crate::pen::{PenEvent, PenPhase, PenSample, PenTool};

/// Farthest that a pen or mouse, and a finger, moves in a tap, in logical pixels.
const TAP_SLOP: f64 = 4.0;
const FINGER_TAP_SLOP: f64 = 10.0;

/// A tool of the view of the plant.
pub type PlantTool = Box<dyn Tool<PlantView> + Send>;

/// What is held besides a pointer, and what is under it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Keys {
    /// The Shift key is held.
    pub shift: bool,
    /// The pointer is over something that can be carried: a plant, a control point of a petal.
    pub over_carried: bool,
    /// The pointer is where a branch can begin, and the tool that draws them is in hand.
    pub draws: bool,
    /// What draws takes a tap as well as a line.
    pub taps_draw: bool,
}

/// Which of the tools is at work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum AtWork {
    Pick,
    Orbit,
    Pan,
    Carry,
    Draw,
    Own,
}

/// A touch from its beginning.
#[derive(Clone, Copy, Debug)]
struct Touch {
    owner: PenTool,
    start: PenSample,
    at_work: AtWork,
    /// It began over something that can be carried.
    carries: bool,
}

/// The tools of pointers in the view of the plant.
pub struct PlantHand {
    pick: Pick,
    orbit: MoveCamera,
    pan: MoveCamera,
    carry: Carry,
    draw: Draw,
    /// Works in the place of those.
    own: Option<PlantTool>,
    touch: Option<Touch>,
    fingers: TouchGestures,
    /// Room for what fingers mean, kept so that no event allocates.
    gestures: Vec<Gesture>,
}

impl Default for PlantHand {
    fn default() -> Self {
        Self {
            pick: Pick::default(),
            orbit: MoveCamera::orbit(),
            pan: MoveCamera::pan(),
            carry: Carry::default(),
            draw: Draw::default(),
            own: None,
            touch: None,
            fingers: TouchGestures::default(),
            gestures: Vec::new(),
        }
    }
}

impl PlantHand {
    /// Takes up a tool in the place of those that move the camera and pick, from the next touch on; `None` gives it back.
    pub fn take_up(&mut self, tool: Option<PlantTool>, view: &mut PlantView) {
        self.cancel(view);
        self.own = tool;
    }

    /// Whether a pointer is at work.
    pub fn is_busy(&self) -> bool {
        self.touch.is_some()
    }

    /// Whether it draws.
    pub fn is_drawing(&self) -> bool {
        self.touch.is_some_and(|touch| touch.at_work == AtWork::Draw)
    }

    /// Handles a pointer that went down over the plant, until it is lifted.
    pub fn event(&mut self, event: &PenEvent, keys: Keys, view: &mut PlantView) {
        if !matches!(event.sample.tool, PenTool::Finger(_)) {
            return self.pointer(event, keys, view);
        }
        let mut gestures = std::mem::take(&mut self.gestures);
        self.fingers.scale_factor = view.pixels_per_point();
        self.fingers.event(event, &mut gestures);
        for gesture in gestures.drain(..) {
            match gesture {
                Gesture::Draw(event) => self.pointer(&event, keys, view),
                Gesture::Pan(by) => view.pan(by),
                Gesture::Pair { from, to } => view.follow_pair(from, to),
                Gesture::Settled | Gesture::Tap(_) => {}
            }
        }
        self.gestures = gestures;
    }

    fn pointer(&mut self, event: &PenEvent, keys: Keys, view: &mut PlantView) {
        let sample = &event.sample;
        let is_owner = self.touch.is_some_and(|touch| touch.owner == sample.tool);
        match event.phase {
            PenPhase::Down if self.touch.is_none() => self.begin(sample, keys, view),
            PenPhase::Move if is_owner => self.moved(sample, keys, view),
            PenPhase::Hover if sample.tool == PenTool::Mouse => self.hovered(sample, view),
            PenPhase::Up | PenPhase::Leave if is_owner => self.end(sample, view),
            PenPhase::Cancel if is_owner => self.cancel(view),
            _ => {}
        }
    }

    fn begin(&mut self, sample: &PenSample, keys: Keys, view: &mut PlantView) {
        self.pick.besides = keys.shift;
        (self.draw.pick.besides, self.draw.slop) = (keys.shift, slop(sample, view));
        self.draw.takes_taps = keys.taps_draw;
        let at_work = match (&self.own, keys.draws) {
            (Some(_), _) => AtWork::Own,
            (None, true) => AtWork::Draw,
            (None, false) => AtWork::Pick,
        };
        self.begin_with(at_work, keys.over_carried, sample, view);
    }

    fn begin_with(&mut self, at_work: AtWork, carries: bool, sample: &PenSample, view: &mut PlantView) {
        self.touch = Some(Touch { owner: sample.tool, start: *sample, at_work, carries });
        self.tool(at_work).begin(sample, view);
    }

    fn moved(&mut self, sample: &PenSample, keys: Keys, view: &mut PlantView) {
        let Some(mut touch) = self.touch else { return };
        let moved = sample.position.distance(touch.start.position);
        if touch.at_work == AtWork::Pick && moved > slop(sample, view) {
            self.pick.cancel(view);
            let moves = keys.shift || sample.buttons.secondary || sample.buttons.middle;
            touch.at_work = match (moves, touch.carries) {
                (true, _) => AtWork::Pan,
                (false, true) => AtWork::Carry,
                (false, false) => AtWork::Orbit,
            };
            self.touch = Some(touch);
            self.tool(touch.at_work).begin(&touch.start, view);
        }
        self.tool(touch.at_work).sample(sample, view);
    }

    /// A mouse without its first button: any other one moves the camera while it is held.
    fn hovered(&mut self, sample: &PenSample, view: &mut PlantView) {
        let is_pressed = sample.buttons.secondary || sample.buttons.middle;
        match (self.touch, is_pressed) {
            (None, true) => self.begin_with(AtWork::Pan, false, sample, view),
            (Some(touch), true) if touch.owner == sample.tool => {
                self.tool(touch.at_work).sample(sample, view);
            }
            (Some(touch), false) if touch.owner == sample.tool => self.end(sample, view),
            _ => {}
        }
    }

    fn end(&mut self, sample: &PenSample, view: &mut PlantView) {
        if let Some(touch) = self.touch.take() {
            self.tool(touch.at_work).end(sample, view);
        }
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
            (AtWork::Carry, _) => &mut self.carry,
            (AtWork::Draw, _) => &mut self.draw,
            (AtWork::Pick | AtWork::Own, _) => &mut self.pick,
        }
    }
}

/// Farthest that a pointer moves in a tap, physical pixels.
fn slop(sample: &PenSample, view: &PlantView) -> f64 {
    let is_finger = matches!(sample.tool, PenTool::Finger(_));
    let slop = if is_finger { FINGER_TAP_SLOP } else { TAP_SLOP };
    slop * view.pixels_per_point()
}

#[cfg(test)]
#[path = "hand_tests.rs"]
mod tests;
