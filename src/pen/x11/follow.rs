//! From states of pens to events that obey [`crate::pen::grammar`].
//!
//! [`PenMachine`] does the work. Here is what X11 adds: there is one pen in the artist's hand, so when another device
//! speaks, the one before leaves. That a hovering pen was taken away is reported by no event of XInput 2, so a pen that says
//! nothing for a while has left; so has one when the mouse moves, since both move the same pointer. A pen that touches stays
//! for as long as it is held still, and nothing that hovers or moves beside it ends its stroke.

use super::decode::Reading;
use crate::pen::hid::RawPen;
use crate::pen::{Mapping, PenEvent, PenMachine};

/// Milliseconds of silence after which a hovering pen has left.
pub const HOVER_MS: f64 = 1000.0;

/// Follows the pen in the artist's hand.
#[derive(Clone, Debug)]
pub struct PenFollower {
    machine: PenMachine,
    /// The device that spoke last.
    device: Option<u16>,
    received_ms: f64,
}

impl Default for PenFollower {
    fn default() -> Self {
        Self { machine: PenMachine::new(Mapping::pixels()), device: None, received_ms: 0.0 }
    }
}

impl PenFollower {
    /// Appends what a reading means to `out`; `time_ms` is when it was taken.
    pub fn feed(&mut self, reading: &Reading, time_ms: f64, out: &mut Vec<PenEvent>) {
        if self.device != Some(reading.device) {
            if !reading.state.in_range || (self.touches() && !reading.state.touches) {
                return;
            }
            self.machine.leave(time_ms, out);
            self.device = Some(reading.device);
        }
        if time_ms.is_finite() {
            self.received_ms = self.received_ms.max(time_ms);
        }
        self.machine.sample(&RawPen { position: reading.position, ..reading.state }, time_ms, out);
    }

    /// The pointer is another device's now: a hovering pen leaves.
    pub fn other_device(&mut self, time_ms: f64, out: &mut Vec<PenEvent>) {
        if !self.touches() {
            self.machine.leave(time_ms, out);
        }
    }

    /// Gives the time: a hovering pen that has been silent for long leaves.
    pub fn idle(&mut self, now_ms: f64, out: &mut Vec<PenEvent>) {
        if self.leaves_at().is_some_and(|at| now_ms >= at) {
            self.machine.leave(now_ms, out);
        }
    }

    /// When a pen leaves if it stays silent.
    pub fn leaves_at(&self) -> Option<f64> {
        let (_, touches) = self.machine.state()?;
        (!touches).then_some(self.received_ms + HOVER_MS)
    }

    fn touches(&self) -> bool {
        self.machine.state().is_some_and(|(_, touches)| touches)
    }
}
