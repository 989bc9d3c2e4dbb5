//! From what a tablet says about its pen, sample by sample, to events that obey [`super::grammar`].
//!
//! A tablet reports states: near or away, touching or not, tip or eraser. This machine says what happened in between: one
//! end at a time, tip and eraser changing over only out of range, nothing after leaving, no touch without having entered.
//! What is missing is put in (a pen that touches at once has entered; one that vanishes while touching was lifted where
//! it was last seen); what cannot be is left out or brought into range. Buttons are let go when the pen leaves. It serves
//! every source that reports states, raw HID and X11 alike. The states and moves are those of HID's digitizer page as
//! Windows and the Linux kernel's pen tests take them.

use super::mapping::Mapping;
use super::raw_pen::RawPen;
use super::{PenButtons, PenEvent, PenPhase, PenSample, PenTool};
use crate::sketch::StrokePoint;
use glam::Vec2;

/// When silence says that the pen of a tablet has left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Silence {
    /// Milliseconds without a word of the pen.
    pub after_ms: f64,
    /// A pen that touches leaves, too. Otherwise only one that hovers does: a pen that rests where it touches may have
    /// nothing to say.
    pub lifts: bool,
}

impl Silence {
    /// For tablets that report as long as the pen is near and never say that it left: what the Linux kernel's driver waits.
    pub const KNOWN: Self = Self { after_ms: 100.0, lifts: true };
    /// For tablets of which it is not known how the pen leaves.
    pub const LIKELY: Self = Self { after_ms: 1000.0, lifts: false };

    /// Whether a pen that touches, or hovers, leaves at all.
    pub fn applies(self, touches: bool) -> bool {
        self.lifts || !touches
    }
}

/// Follows one pen.
#[derive(Clone, Debug)]
pub struct PenMachine {
    mapping: Mapping,
    /// The last sample of the pen in range.
    last: Option<PenSample>,
    time_ms: f64,
}

impl PenMachine {
    /// A machine that has seen no pen yet.
    pub fn new(mapping: Mapping) -> Self {
        Self { mapping, last: None, time_ms: 0.0 }
    }

    /// Maps later samples in another way; an unfinished stroke goes on from where it is.
    pub fn set_mapping(&mut self, mapping: Mapping) {
        self.mapping = mapping;
    }

    /// The tool in range and whether it touches.
    pub fn state(&self) -> Option<(PenTool, bool)> {
        self.last.map(|last| (last.tool, last.buttons.primary))
    }

    /// Takes what the tablet says at `time_ms` and appends what happened to `out`: at most five events.
    pub fn sample(&mut self, raw: &RawPen, time_ms: f64, out: &mut Vec<PenEvent>) {
        self.pass_time(time_ms);
        if !raw.in_range && !raw.touches {
            return self.leave(time_ms, out);
        }
        let tool = if raw.eraser { PenTool::Eraser } else { PenTool::Pen };
        if self.last.is_some_and(|last| last.tool != tool) {
            self.leave(time_ms, out);
        }
        let Some(sample) = self.reading(raw, tool) else { return };
        let (was_near, touched) = (self.last.is_some(), self.last.is_some_and(|last| last.buttons.primary));
        if !was_near {
            self.say(PenPhase::Enter, lifted(sample), out);
        }
        match (touched, raw.touches) {
            (false, true) => self.say(PenPhase::Down, sample, out),
            (true, true) => self.say(PenPhase::Move, sample, out),
            (true, false) => self.say(PenPhase::Up, sample, out),
            (false, false) if was_near => self.say(PenPhase::Hover, sample, out),
            (false, false) => {}
        }
    }

    /// Lets the pen leave if it sent nothing for so long: for tablets that do not say when it leaves.
    pub fn idle(&mut self, now_ms: f64, silence: Silence, out: &mut Vec<PenEvent>) {
        let is_over = |last: PenSample| {
            silence.applies(last.buttons.primary) && now_ms - last.time_ms >= silence.after_ms
        };
        if self.last.is_some_and(is_over) {
            self.leave(now_ms, out);
        }
    }

    /// Lets the pen leave: it went away, or its tablet did. A touch is lifted where it was last, so that its stroke
    /// counts.
    pub fn leave(&mut self, now_ms: f64, out: &mut Vec<PenEvent>) {
        self.pass_time(now_ms);
        let Some(last) = self.last else { return };
        if last.buttons.primary {
            self.say(PenPhase::Up, lifted(last), out);
        }
        self.say(PenPhase::Leave, PenSample { buttons: PenButtons::default(), ..lifted(last) }, out);
        self.last = None;
    }

    fn pass_time(&mut self, time_ms: f64) {
        if time_ms.is_finite() {
            self.time_ms = self.time_ms.max(time_ms);
        }
    }

    fn say(&mut self, phase: PenPhase, sample: PenSample, out: &mut Vec<PenEvent>) {
        let sample = PenSample { time_ms: self.time_ms, ..sample };
        self.last = Some(sample);
        out.push(PenEvent { phase, sample });
    }

    /// The sample in the window; what is no number or beyond its range counts as it was before. `None` for a pen that
    /// was never anywhere.
    fn reading(&self, raw: &RawPen, tool: PenTool) -> Option<PenSample> {
        let last = self.last;
        let position = self.mapping.position(raw.position).or(last.map(|l| l.position))?;
        let pressure = match raw.pressure {
            _ if !raw.touches => 0.0,
            None => StrokePoint::NEUTRAL_PRESSURE,
            Some(pressure) if pressure.is_nan() => last.map_or(0.0, |l| l.pressure),
            Some(pressure) => pressure.clamp(0.0, 1.0),
        };
        let tilt_deg = match raw.tilt_deg {
            tilt if tilt.is_finite() => self.mapping.tilt(tilt.clamp(Vec2::splat(-90.0), Vec2::splat(90.0))),
            _ => last.map_or(Vec2::ZERO, |l| l.tilt_deg),
        };
        let twist_deg = match raw.twist_deg {
            twist if twist.is_finite() => self.mapping.twist(twist),
            _ => last.map_or(0.0, |l| l.twist_deg),
        };
        let distance = match raw.distance {
            _ if raw.touches => 0.0,
            distance if distance.is_nan() => last.map_or(0.0, |l| l.distance),
            distance => distance.clamp(0.0, 1.0),
        };
        let [secondary, middle, third] = raw.barrel;
        let buttons = PenButtons { primary: raw.touches, secondary, middle, third };
        Some(PenSample {
            position,
            pressure,
            tilt_deg,
            twist_deg,
            distance,
            tool,
            buttons,
            time_ms: self.time_ms,
        })
    }
}

/// The same sample without touching.
fn lifted(sample: PenSample) -> PenSample {
    let buttons = PenButtons { primary: false, ..sample.buttons };
    PenSample { pressure: 0.0, buttons, ..sample }
}

#[cfg(test)]
#[path = "machine_tests.rs"]
mod tests;
