//! From states of pens to events that obey [`crate::pen::grammar`].
//!
//! There is one pen in the artist's hand: when another device speaks, the one before is lifted and leaves. That a hovering
//! pen was taken away is told by no event of XInput 2, so a pen that says nothing for a while has left; so has one when
//! the mouse moves, since both move the same pointer. A pen that touches stays for as long as it is held still.

use super::decode::Reading;
use crate::pen::hid::RawPen;
use crate::pen::{MAX_POSITION_PX, PenButtons, PenEvent, PenPhase, PenSample, PenTool};
use crate::sketch::StrokePoint;
use glam::{DVec2, Vec2};

/// Milliseconds of silence after which a hovering pen has left.
pub const HOVER_MS: f64 = 1000.0;

/// Follows the pen in the artist's hand.
#[derive(Clone, Debug, Default)]
pub struct PenFollower {
    pen: Option<InRange>,
    time_ms: f64,
}

#[derive(Clone, Debug)]
struct InRange {
    device: u16,
    last: PenSample,
}

impl PenFollower {
    /// Appends what a reading means to `out`; `time_ms` is when it was taken.
    pub fn feed(&mut self, reading: &Reading, time_ms: f64, out: &mut Vec<PenEvent>) {
        self.tick(time_ms);
        let Reading { device, state, position, .. } = reading;
        let tool = if state.eraser { PenTool::Eraser } else { PenTool::Pen };
        let is_sound = position.is_finite() && position.abs().max_element() <= MAX_POSITION_PX;
        let is_same = self.pen.as_ref().is_some_and(|pen| pen.device == *device && pen.last.tool == tool);
        if !state.in_range {
            if is_same {
                self.leave(out);
            }
            return;
        }
        if !is_sound {
            return;
        }
        if !is_same {
            self.leave(out);
            let last = PenSample { time_ms: self.time_ms, ..sample_of(state, *position, tool) };
            out.push(PenEvent { phase: PenPhase::Enter, sample: hovering(last) });
            self.pen = Some(InRange { device: *device, last: hovering(last) });
            if !state.touches {
                return;
            }
        }
        let Some(pen) = &mut self.pen else { return };
        let phase = match (pen.last.buttons.primary, state.touches) {
            (false, false) => PenPhase::Hover,
            (false, true) => PenPhase::Down,
            (true, true) => PenPhase::Move,
            (true, false) => PenPhase::Up,
        };
        pen.last = PenSample { time_ms: self.time_ms, ..sample_of(state, *position, tool) };
        out.push(PenEvent { phase, sample: pen.last });
    }

    /// The pointer is another device's now: a pen in range leaves.
    pub fn other_device(&mut self, time_ms: f64, out: &mut Vec<PenEvent>) {
        self.tick(time_ms);
        self.leave(out);
    }

    /// Tells the time: a hovering pen that has been silent for long leaves.
    pub fn idle(&mut self, now_ms: f64, out: &mut Vec<PenEvent>) {
        if self.leaves_at().is_some_and(|at| now_ms >= at) {
            self.tick(now_ms);
            self.leave(out);
        }
    }

    /// When a pen leaves if it stays silent.
    pub fn leaves_at(&self) -> Option<f64> {
        let pen = self.pen.as_ref().filter(|pen| !pen.last.buttons.primary)?;
        Some(pen.last.time_ms + HOVER_MS)
    }

    fn tick(&mut self, time_ms: f64) {
        if time_ms.is_finite() {
            self.time_ms = self.time_ms.max(time_ms);
        }
    }

    fn leave(&mut self, out: &mut Vec<PenEvent>) {
        let Some(pen) = self.pen.take() else { return };
        let mut sample = PenSample { time_ms: self.time_ms, ..hovering(pen.last) };
        if pen.last.buttons.primary {
            out.push(PenEvent { phase: PenPhase::Up, sample });
        }
        sample.buttons = PenButtons::default();
        out.push(PenEvent { phase: PenPhase::Leave, sample });
    }
}

fn sample_of(state: &RawPen, position: DVec2, tool: PenTool) -> PenSample {
    let pressure = state.pressure.filter(|p| !p.is_nan()).unwrap_or(StrokePoint::NEUTRAL_PRESSURE);
    let tilt_deg = if state.tilt_deg.is_nan() { Vec2::ZERO } else { state.tilt_deg };
    let [lower, upper, _] = state.barrel;
    PenSample {
        position,
        pressure: if state.touches { pressure.clamp(0.0, 1.0) } else { 0.0 },
        tilt_deg: tilt_deg.clamp(Vec2::splat(-90.0), Vec2::splat(90.0)),
        twist_deg: if (0.0..360.0).contains(&state.twist_deg) { state.twist_deg } else { 0.0 },
        distance: if (0.0..=1.0).contains(&state.distance) { state.distance } else { 0.0 },
        tool,
        buttons: PenButtons { primary: state.touches, secondary: lower, middle: upper },
        time_ms: 0.0,
    }
}

/// The same without contact.
fn hovering(sample: PenSample) -> PenSample {
    let buttons = PenButtons { primary: false, ..sample.buttons };
    PenSample { pressure: 0.0, buttons, ..sample }
}
