//! From events of the X server to the state of the pen that caused them.
//!
//! Motion and buttons come from the pen itself; that the pointer left the window comes from the pointer, naming the pen
//! that moved it. The first button is the tip, the second and third are the barrel's. A button counts as held from its press
//! to its release, and not longer than the server itself says that it is held: a release that went elsewhere is not waited
//! for.
//!
//! Where a device says that it is, the server has a mix of two: whole pixels of where the pointer was before, parts of a
//! pixel of where it is now. So the place is made from the axes, as the server makes it of them for the pointer, and taken
//! only if its parts of a pixel are the server's. A pen that is placed in another way (by steps, as a mouse) has the server's
//! mix. Buttons that carry no axes happened where the pen was.
//!
//! While the tip touches, the pen belongs to the window even beyond its edge; it leaves when it is lifted there.

use super::devices::PenDevice;
use crate::pen::hid::RawPen;
use glam::DVec2;
use x11rb::protocol::Event;
use x11rb::protocol::xinput::{ButtonPressEvent, EnterEvent, NotifyMode};

/// The tip.
const TIP: u32 = 1;
/// Lower, upper and third button of the barrel.
const BARREL: [u32; 3] = [2, 3, 8];

/// Most by which two places may differ that have the same parts of a pixel; the server rounds them to a 65536th.
const SAME_PART: f64 = 2e-3;

/// What one event says about a pen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// Which device.
    pub device: u16,
    /// How it is held.
    pub state: RawPen,
    /// Where in the window, in physical pixels and parts of them.
    pub position: DVec2,
    /// The server's time stamp.
    pub stamp: u32,
}

/// Knows the pens and what they were doing.
#[derive(Clone, Debug, Default)]
pub struct Decoder {
    pens: Vec<Pen>,
    /// Pixels of all screens together, over which a tablet spans.
    desktop: DVec2,
}

#[derive(Clone, Debug)]
struct Pen {
    device: PenDevice,
    touches: bool,
    barrel: [bool; 3],
    /// The pointer is outside the window while the tip still touches.
    has_left: bool,
    /// Where it was last.
    position: Option<DVec2>,
    stamp: u32,
}

impl Decoder {
    /// Learns how large all screens are together, in pixels.
    pub fn set_desktop(&mut self, size: DVec2) {
        self.desktop = size;
    }

    /// Learns which pens there are now. Those that are gone go out of range.
    pub fn set_pens(&mut self, pens: Vec<PenDevice>, mut sink: impl FnMut(Reading)) {
        let before = std::mem::take(&mut self.pens);
        for pen in before.iter().filter(|pen| pens.iter().all(|now| now.id != pen.device.id)) {
            sink(pen.out_of_range());
        }
        for mut device in pens {
            let known = before.iter().find(|pen| pen.device.id == device.id);
            self.pens.push(match known {
                Some(pen) => {
                    device.keep_values(&pen.device);
                    Pen { device, ..pen.clone() }
                }
                None => Pen::new(device),
            });
        }
    }

    /// What an event says; nothing for events that are not about a known pen.
    pub fn decode(&mut self, event: &Event) -> Option<Reading> {
        let desktop = self.desktop;
        match event {
            Event::XinputMotion(event) => Some(self.pen(event.sourceid)?.moved(event, desktop)),
            Event::XinputButtonPress(event) => self.pen(event.sourceid)?.pressed(event, true, desktop),
            Event::XinputButtonRelease(event) => self.pen(event.sourceid)?.pressed(event, false, desktop),
            Event::XinputLeave(event) => self.pen(event.sourceid)?.left(event),
            Event::XinputEnter(event) => {
                self.pen(event.sourceid)?.has_left = false;
                None
            }
            _ => None,
        }
    }

    fn pen(&mut self, id: u16) -> Option<&mut Pen> {
        self.pens.iter_mut().find(|pen| pen.device.id == id)
    }
}

impl Pen {
    fn new(device: PenDevice) -> Self {
        Self { device, touches: false, barrel: [false; 3], has_left: false, position: None, stamp: 0 }
    }

    fn out_of_range(&self) -> Reading {
        let state = RawPen { in_range: false, ..self.device.state(false, [false; 3]) };
        self.reading_of(state)
    }

    fn reading(&self) -> Reading {
        self.reading_of(self.device.state(self.touches, self.barrel))
    }

    fn reading_of(&self, state: RawPen) -> Reading {
        let position = self.position.unwrap_or_default();
        Reading { device: self.device.id, state, position, stamp: self.stamp }
    }

    fn take(&mut self, event: &ButtonPressEvent, desktop: DVec2) {
        self.device.take(&event.valuator_mask, &event.axisvalues);
        if self.position.is_none() || self.device.is_placed_by(&event.valuator_mask) {
            self.position = Some(self.place(event, desktop));
        }
        self.stamp = event.time;
    }

    /// Where in the window.
    fn place(&self, event: &ButtonPressEvent, desktop: DVec2) -> DVec2 {
        let on_desktop = pixels(event.root_x, event.root_y);
        let event_place = pixels(event.event_x, event.event_y);
        let is_servers = |place: &DVec2| {
            let apart = *place - on_desktop;
            (apart - apart.round()).abs().max_element() <= SAME_PART
        };
        match self.device.place_on(desktop).filter(is_servers) {
            Some(place) => place - (on_desktop - event_place),
            None => event_place,
        }
    }

    fn moved(&mut self, event: &ButtonPressEvent, desktop: DVec2) -> Reading {
        self.take(event, desktop);
        let is_held = |button: u32| {
            event.button_mask.get((button / 32) as usize).is_some_and(|word| word >> (button % 32) & 1 == 1)
        };
        self.touches &= is_held(TIP);
        for (held, button) in self.barrel.iter_mut().zip(BARREL) {
            *held &= is_held(button);
        }
        self.reading()
    }

    fn pressed(&mut self, event: &ButtonPressEvent, pressed: bool, desktop: DVec2) -> Option<Reading> {
        self.take(event, desktop);
        if event.detail == TIP {
            self.touches = pressed;
        } else {
            let button = BARREL.iter().position(|button| *button == event.detail)?;
            *self.barrel.get_mut(button)? = pressed;
        }
        if !self.touches && std::mem::take(&mut self.has_left) {
            self.barrel = [false; 3];
            return Some(self.out_of_range());
        }
        Some(self.reading())
    }

    fn left(&mut self, event: &EnterEvent) -> Option<Reading> {
        if self.touches {
            self.has_left = true;
            return None;
        }
        // The pointer is where it was: somebody only took it for a moment, as a window manager does for its keys.
        if event.mode != NotifyMode::NORMAL {
            return None;
        }
        self.stamp = event.time;
        self.barrel = [false; 3];
        let reading = self.out_of_range();
        self.position = None;
        Some(reading)
    }
}

/// X's numbers have 16 bits behind the point.
fn pixels(x: i32, y: i32) -> DVec2 {
    const ONE: f64 = 65536.0;
    DVec2::new(f64::from(x), f64::from(y)) / ONE
}

#[cfg(test)]
#[path = "decode_tests.rs"]
mod tests;
