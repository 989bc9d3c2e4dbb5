//! Pen events from the events of a winit 0.31 window: mouse, touch, and tablet tools where the platform reports them.
//!
//! winit passes on what the system says, in any order. Here every tool gets a small state machine, so that what comes out
//! obeys [`super::grammar`]: a tool enters before it does anything, touches once, and says nothing after it left. A tool
//! that the system loses in the middle of a stroke is lifted, so that the stroke counts; a finger that the system takes
//! away is cancelled, as winit documents it. A mouse that leaves the window with its button held goes on drawing until
//! the button is released.
//!
//! winit's Wayland backend reports both the tip and the lower barrel button (BTN_STYLUS) as `Contact`: a contact without
//! pressure is the button. Tablets without pressure need [`WinitPen::tip_without_pressure`]. Its Windows backend reports
//! touching only, named after the button that is held or the eraser end that touches ([`TabletReports`]); a barrel button
//! in the air is not reported there. Samples with positions that are no numbers or beyond all screens are dropped.

use super::{MAX_POSITION_PX, PenButtons, PenEvent, PenPhase, PenSample, PenTool};
use crate::sketch::StrokePoint;
use glam::{DVec2, Vec2};
use winit::dpi::PhysicalPosition;
use winit::event::{
    ButtonSource, ElementState, Force, MouseButton, PointerKind, PointerSource, TabletToolButton,
    TabletToolData, TabletToolKind, WindowEvent,
};

/// Most fingers followed at once; what lands beyond is not seen.
const MAX_FINGERS: usize = 32;

/// Linux codes of the buttons of a tablet's mouse, passed on by winit as they are.
const BTN_LEFT: u16 = 0x110;
const BTN_RIGHT: u16 = 0x111;
const BTN_MIDDLE: u16 = 0x112;
const BTN_STYLUS3: u16 = 0x149;
/// Windows' flag for the eraser end, passed on by winit as a button.
const PEN_FLAG_ERASER: u16 = 4;

/// What a system's part of winit reports as buttons of a tablet tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TabletReports {
    /// Every button, with the tip and the lower barrel button under one name: Wayland.
    Buttons,
    /// Touching and lifting, under the name of the barrel button that is held or of the eraser end: Windows.
    Contacts,
}

impl Default for TabletReports {
    fn default() -> Self {
        if cfg!(windows) { Self::Contacts } else { Self::Buttons }
    }
}

/// Turns window events into pen events.
#[derive(Clone, Debug, Default)]
pub struct WinitPen {
    /// How tablet tools are reported; default that of this system.
    pub tablet_reports: TabletReports,
    /// Whether a contact of a tablet tool that reports no pressure is its tip, not its barrel button; default no.
    pub tip_without_pressure: bool,
    mouse: Option<Pointer>,
    stylus: Option<Pointer>,
    fingers: Vec<Pointer>,
    time_ms: f64,
}

/// A tool in range.
#[derive(Clone, Debug)]
struct Pointer {
    last: PenSample,
    /// The window was left while the button was held: leaving waits for the release.
    has_left: bool,
}

/// What one window event says about a tool.
#[derive(Clone, Copy)]
struct Reading {
    tool: PenTool,
    position: Option<DVec2>,
    /// `None` where the device does not say.
    pressure: Option<f32>,
    tilt_deg: Vec2,
    twist_deg: f32,
    time_ms: f64,
}

/// What a button does.
#[derive(Clone, Copy)]
enum Key {
    Tip,
    Secondary,
    Middle,
    Third,
}

impl WinitPen {
    /// A source that has seen nothing yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Appends what a window event means to `out`: nothing for events that are not about pointers, up to three events
    /// where something was missed before. `time_ms` is when the event came, on any clock that does not go back.
    pub fn event(&mut self, event: &WindowEvent, time_ms: f64, out: &mut Vec<PenEvent>) {
        self.time_ms = if time_ms.is_finite() { time_ms.max(self.time_ms) } else { self.time_ms };
        match event {
            WindowEvent::PointerEntered { position, kind, .. } => {
                if let Some(reading) = self.reading(self.tool_of(*kind), Some(*position)) {
                    self.enter(&reading, out);
                }
            }
            WindowEvent::PointerMoved { position, source, .. } => self.moved(*position, source, out),
            WindowEvent::PointerButton { position, button, state, .. } => {
                self.button(*position, button, *state == ElementState::Pressed, out);
            }
            WindowEvent::PointerLeft { position, kind, .. } => {
                if let Some(reading) = self.reading(self.tool_of(*kind), *position) {
                    self.left(&reading, out);
                }
            }
            WindowEvent::Focused(false) => self.release(time_ms, out),
            _ => {}
        }
    }

    /// Lifts pen and mouse where they touch, as when the window loses the keyboard or shows a dialog: their release may
    /// never come. Fingers are the system's to cancel.
    pub fn release(&mut self, time_ms: f64, out: &mut Vec<PenEvent>) {
        self.time_ms = if time_ms.is_finite() { time_ms.max(self.time_ms) } else { self.time_ms };
        for slot in [&mut self.stylus, &mut self.mouse] {
            if let Some(pointer) = slot {
                pointer.lift(None, self.time_ms, out);
                pointer.last.buttons = PenButtons::default();
                if pointer.has_left {
                    pointer.leave(self.time_ms, out);
                    *slot = None;
                }
            }
        }
    }

    fn reading(&self, tool: PenTool, position: Option<PhysicalPosition<f64>>) -> Option<Reading> {
        let place = position.map(|p| DVec2::new(p.x, p.y));
        let is_sound = place.is_none_or(|p| p.is_finite() && p.abs().max_element() <= MAX_POSITION_PX);
        let position = if is_sound { place } else { None };
        let is_known = self.slot(tool).is_some();
        (position.is_some() || is_known).then_some(Reading {
            tool,
            position,
            pressure: None,
            tilt_deg: Vec2::ZERO,
            twist_deg: 0.0,
            time_ms: self.time_ms,
        })
    }

    /// Which tool a kind of pointer is. Where only contacts are reported, a pen is what touched last until it leaves.
    fn tool_of(&self, kind: PointerKind) -> PenTool {
        let touched = self.stylus.as_ref().map(|p| p.last.tool);
        match kind {
            PointerKind::Touch(finger) => PenTool::Finger(finger.into_raw() as u64),
            PointerKind::TabletTool(TabletToolKind::Eraser) => PenTool::Eraser,
            PointerKind::TabletTool(_) => match (self.tablet_reports, touched) {
                (TabletReports::Contacts, Some(tool)) => tool,
                _ => PenTool::Pen,
            },
            _ => PenTool::Mouse,
        }
    }

    fn slot(&self, tool: PenTool) -> Option<&Pointer> {
        match tool {
            PenTool::Mouse => self.mouse.as_ref(),
            PenTool::Pen | PenTool::Eraser => self.stylus.as_ref().filter(|p| p.last.tool == tool),
            PenTool::Finger(_) => self.fingers.iter().find(|p| p.last.tool == tool),
        }
    }

    /// The pointer of a reading's tool, which enters if it was out of range; `None` where that cannot be.
    fn enter(&mut self, reading: &Reading, out: &mut Vec<PenEvent>) -> Option<&mut Pointer> {
        let slot = match reading.tool {
            PenTool::Mouse => &mut self.mouse,
            PenTool::Pen | PenTool::Eraser => {
                if self.stylus.as_ref().is_some_and(|p| p.last.tool != reading.tool) {
                    leave_slot(&mut self.stylus, reading.time_ms, out);
                }
                &mut self.stylus
            }
            PenTool::Finger(_) => return self.enter_finger(reading, out),
        };
        let pointer = match slot.take() {
            Some(pointer) => pointer,
            None => Pointer::enter(reading, out)?,
        };
        let pointer = slot.insert(pointer);
        pointer.has_left = false;
        Some(pointer)
    }

    fn enter_finger(&mut self, reading: &Reading, out: &mut Vec<PenEvent>) -> Option<&mut Pointer> {
        let place = match self.fingers.iter().position(|p| p.last.tool == reading.tool) {
            Some(place) => place,
            None if self.fingers.len() >= MAX_FINGERS => return None,
            None => {
                self.fingers.push(Pointer::enter(reading, out)?);
                self.fingers.len() - 1
            }
        };
        self.fingers.get_mut(place)
    }

    fn moved(&mut self, at: PhysicalPosition<f64>, source: &PointerSource, out: &mut Vec<PenEvent>) {
        let tool = self.tool_of(source.clone().into());
        let Some(reading) = self.reading(tool, Some(at)) else { return };
        if reading.position.is_none() {
            return;
        }
        let reading = match source {
            PointerSource::Touch { force, .. } => reading.with_touch(*force),
            PointerSource::TabletTool { data, .. } => reading.with_tablet(data),
            _ => reading,
        };
        // A mouse that draws beyond the edge of the window has not come back to it.
        let had_left = self.slot(tool).is_some_and(|p| p.has_left);
        if let Some(pointer) = self.enter(&reading, out) {
            pointer.has_left = had_left;
            pointer.moved(&reading, out);
        }
    }

    fn button(
        &mut self,
        at: PhysicalPosition<f64>,
        button: &ButtonSource,
        pressed: bool,
        out: &mut Vec<PenEvent>,
    ) {
        let tool = match button {
            ButtonSource::Mouse(_) => PenTool::Mouse,
            ButtonSource::Touch { finger_id, .. } => PenTool::Finger(finger_id.into_raw() as u64),
            ButtonSource::TabletTool { button: TabletToolButton::Other(PEN_FLAG_ERASER), .. } => {
                PenTool::Eraser
            }
            ButtonSource::TabletTool { kind, .. } => self.tool_of(PointerKind::TabletTool(*kind)),
            _ => return,
        };
        let Some(reading) = self.reading(tool, Some(at)) else { return };
        let reading = match button {
            ButtonSource::Touch { force, .. } => reading.with_touch(*force),
            ButtonSource::TabletTool { data, .. } => reading.with_tablet(data),
            _ => reading,
        };
        // Nobody is lifted who was not seen, and nothing touches at a place that is none.
        if (!pressed && self.slot(tool).is_none()) || (pressed && reading.position.is_none()) {
            return;
        }
        let Some(key) = self.key_of(button, &reading, pressed) else { return };
        let barrel = self.barrel_in_contact(button, pressed);
        let had_left = !pressed && self.slot(tool).is_some_and(|p| p.has_left);
        let Some(pointer) = self.enter(&reading, out) else { return };
        pointer.has_left = had_left;
        pointer.last.buttons.secondary = barrel.unwrap_or(pointer.last.buttons.secondary);
        pointer.press(key, pressed, &reading, out);
        if pointer.has_left && !pointer.last.buttons.primary {
            leave_slot(&mut self.mouse, reading.time_ms, out);
        }
    }

    /// What a button of a source means; `None` for buttons without a meaning here.
    fn key_of(&self, button: &ButtonSource, reading: &Reading, pressed: bool) -> Option<Key> {
        match button {
            ButtonSource::Mouse(MouseButton::Left) | ButtonSource::Touch { .. } => Some(Key::Tip),
            ButtonSource::Mouse(MouseButton::Right) => Some(Key::Secondary),
            ButtonSource::Mouse(MouseButton::Middle) => Some(Key::Middle),
            ButtonSource::TabletTool { .. } if self.tablet_reports == TabletReports::Contacts => {
                Some(Key::Tip)
            }
            ButtonSource::TabletTool { button, .. } => match button {
                TabletToolButton::Contact => Some(self.contact(reading, pressed)),
                // Wayland's upper of two barrel buttons.
                TabletToolButton::Barrel => Some(Key::Middle),
                TabletToolButton::Other(BTN_LEFT) => Some(Key::Tip),
                TabletToolButton::Other(BTN_RIGHT) => Some(Key::Secondary),
                TabletToolButton::Other(1 | BTN_MIDDLE) => Some(Key::Middle),
                TabletToolButton::Other(BTN_STYLUS3) => Some(Key::Third),
                TabletToolButton::Other(_) => None,
            },
            _ => None,
        }
    }

    /// Whether the barrel button is held, where a contact says so.
    fn barrel_in_contact(&self, button: &ButtonSource, pressed: bool) -> Option<bool> {
        match button {
            ButtonSource::TabletTool { button, .. } if self.tablet_reports == TabletReports::Contacts => {
                Some(pressed && *button == TabletToolButton::Barrel)
            }
            _ => None,
        }
    }

    /// Whether a contact is the tip or the lower barrel button, told by the pressure and by what is held.
    fn contact(&self, reading: &Reading, pressed: bool) -> Key {
        let presses = match reading.pressure {
            Some(pressure) => pressure > 0.0,
            None => self.tip_without_pressure,
        };
        let held = self.slot(reading.tool).map_or(PenButtons::default(), |p| p.last.buttons);
        let is_tip = match (pressed, held.primary, held.secondary) {
            (true, touches, _) => presses && !touches,
            (false, true, true) => !presses,
            (false, touches, _) => touches,
        };
        if is_tip { Key::Tip } else { Key::Secondary }
    }

    fn left(&mut self, reading: &Reading, out: &mut Vec<PenEvent>) {
        let time_ms = reading.time_ms;
        match reading.tool {
            PenTool::Mouse => match &mut self.mouse {
                Some(mouse) if mouse.last.buttons.primary => mouse.has_left = true,
                _ => leave_slot(&mut self.mouse, time_ms, out),
            },
            tool @ (PenTool::Pen | PenTool::Eraser) => {
                if self.stylus.as_ref().is_some_and(|p| p.last.tool == tool) {
                    leave_slot(&mut self.stylus, time_ms, out);
                }
            }
            tool @ PenTool::Finger(_) => {
                let Some(place) = self.fingers.iter().position(|p| p.last.tool == tool) else { return };
                let mut finger = self.fingers.swap_remove(place);
                if finger.last.buttons.primary {
                    finger.say(PenPhase::Cancel, false, time_ms, out);
                } else {
                    finger.leave(time_ms, out);
                }
            }
        }
    }
}

fn leave_slot(slot: &mut Option<Pointer>, time_ms: f64, out: &mut Vec<PenEvent>) {
    if let Some(mut pointer) = slot.take() {
        pointer.lift(None, time_ms, out);
        pointer.leave(time_ms, out);
    }
}

/// Force as a share of the greatest; `None` where it is no number.
fn share_of(force: Force) -> Option<f32> {
    let share = force.normalized(None);
    (!share.is_nan()).then_some(share.clamp(0.0, 1.0) as f32)
}

impl Reading {
    /// A touch without force says 0 on some systems: then it is not known.
    fn with_touch(self, force: Option<Force>) -> Self {
        Self { pressure: force.and_then(share_of).filter(|share| *share > 0.0), ..self }
    }

    fn with_tablet(self, data: &TabletToolData) -> Self {
        let tilt = data.clone().tilt();
        let tilt_deg = tilt.map_or(Vec2::ZERO, |t| Vec2::new(t.x.into(), t.y.into()));
        Self {
            pressure: data.force.and_then(share_of),
            tilt_deg: tilt_deg.clamp(Vec2::splat(-90.0), Vec2::splat(90.0)),
            twist_deg: f32::from(data.twist.unwrap_or(0) % 360),
            ..self
        }
    }
}

impl Pointer {
    fn enter(reading: &Reading, out: &mut Vec<PenEvent>) -> Option<Self> {
        let last = PenSample {
            position: reading.position?,
            pressure: 0.0,
            tilt_deg: reading.tilt_deg,
            twist_deg: reading.twist_deg,
            distance: 0.0,
            tool: reading.tool,
            buttons: PenButtons::default(),
            time_ms: reading.time_ms,
        };
        out.push(PenEvent { phase: PenPhase::Enter, sample: last });
        Some(Self { last, has_left: false })
    }

    fn say(&mut self, phase: PenPhase, touches: bool, time_ms: f64, out: &mut Vec<PenEvent>) {
        self.last.time_ms = time_ms;
        self.last.buttons.primary = touches;
        if !touches {
            self.last.pressure = 0.0;
        }
        out.push(PenEvent { phase, sample: self.last });
    }

    fn take(&mut self, reading: &Reading) {
        self.last.position = reading.position.unwrap_or(self.last.position);
        self.last.pressure = reading.pressure.unwrap_or(StrokePoint::NEUTRAL_PRESSURE);
        self.last.tilt_deg = reading.tilt_deg;
        self.last.twist_deg = reading.twist_deg;
    }

    fn moved(&mut self, reading: &Reading, out: &mut Vec<PenEvent>) {
        self.take(reading);
        let touches = self.last.buttons.primary;
        let phase = if touches { PenPhase::Move } else { PenPhase::Hover };
        self.say(phase, touches, reading.time_ms, out);
    }

    fn press(&mut self, key: Key, pressed: bool, reading: &Reading, out: &mut Vec<PenEvent>) {
        let buttons = &mut self.last.buttons;
        let held = match key {
            Key::Tip if pressed && buttons.primary => return,
            Key::Tip if pressed => {
                self.take(reading);
                return self.say(PenPhase::Down, true, reading.time_ms, out);
            }
            Key::Tip => return self.lift(Some(reading), reading.time_ms, out),
            Key::Secondary => &mut buttons.secondary,
            Key::Middle => &mut buttons.middle,
            Key::Third => &mut buttons.third,
        };
        if *held != pressed {
            *held = pressed;
            self.moved(reading, out);
        }
    }

    /// Lifts the tool if it touches.
    fn lift(&mut self, reading: Option<&Reading>, time_ms: f64, out: &mut Vec<PenEvent>) {
        if self.last.buttons.primary {
            if let Some(reading) = reading {
                self.take(reading);
            }
            self.say(PenPhase::Up, false, time_ms, out);
        }
    }

    fn leave(&mut self, time_ms: f64, out: &mut Vec<PenEvent>) {
        self.last.buttons = PenButtons::default();
        self.say(PenPhase::Leave, false, time_ms, out);
    }
}

#[cfg(test)]
#[path = "from_winit_tests.rs"]
mod tests;
