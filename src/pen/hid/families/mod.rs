//! Report families: the byte layouts in which tablets speak, one file per family or group of kin.
//!
//! A family is what makers share: hundreds of tablets speak some forty layouts. [`Spec`] joins a family with the ranges of
//! one tablet, and [`Spec::decoder`] gives what turns its reports into [`HidEvent`]s: shares of the area and of the
//! greatest pressure, degrees, keys as bits. Decoders read through `bytes::Bytes`, which knows no report's end it could
//! run over; a report that is cut short says nothing.
//!
//! Origin: facts from the OpenTabletDriver parsers (2025-12), corrected by what the Linux kernel's drivers and real
//! descriptors say; where those disagree, the file says which side was taken. `b[0]` is always the report id.
//!
//! Limits: pucks and mice on tablets and batteries are not decoded; their reports say nothing.

mod acepen;
mod bytes;
mod decoders;
mod family;
mod genius;
mod keys;
mod others;
mod spec;
#[cfg(test)]
mod testing;
mod uclogic;
mod veikk;
mod wacom_basic;
mod wacom_finger;
mod wacom_graphire;
mod wacom_intuos;
mod wacom_modern;
mod wacom_pl;
mod wheels;
mod xp_pen;

pub use family::Family;
pub use spec::Spec;

use super::{Decode, HidEvent, RawPen};
use bytes::Bytes;

/// A family whose reports say one thing each.
trait OneEvent: Send {
    /// What a report says; `None` for one that is cut short, unknown or of no interest.
    fn read(&mut self, b: Bytes<'_>) -> Option<HidEvent>;
}

impl<Family: OneEvent> Decode for Family {
    fn decode(&mut self, report: &[u8], sink: &mut dyn FnMut(HidEvent)) {
        if let Some(event) = self.read(Bytes(report)) {
            sink(event);
        }
    }
}

/// The pen went out of range.
const AWAY: HidEvent = HidEvent::Pen(RawPen {
    in_range: false,
    touches: false,
    eraser: false,
    barrel: [false; 3],
    position: glam::DVec2::ZERO,
    pressure: None,
    tilt_deg: glam::Vec2::ZERO,
    twist_deg: 0.0,
    distance: 0.0,
    serial: 0,
});

fn bit(flags: u8, place: u8) -> bool {
    flags >> place & 1 == 1
}

/// Barrel buttons from three bits of the flags.
fn barrel(flags: u8, places: [u8; 3]) -> [bool; 3] {
    places.map(|place| bit(flags, place))
}

/// Says what breaks the promises of [`HidEvent`]: shares outside 0 to 1, angles beyond their range, numbers that are none.
///
/// # Errors
/// The broken promise, for tests and fuzzing.
pub fn check_event(event: &HidEvent) -> Result<(), String> {
    let share = |what: &str, x: f64| {
        if (0.0..=1.0).contains(&x) { Ok(()) } else { Err(format!("{what} {x} is no share: {event:?}")) }
    };
    match event {
        HidEvent::Pen(pen) => {
            share("x", pen.position.x)?;
            share("y", pen.position.y)?;
            share("pressure", pen.pressure.unwrap_or(0.0).into())?;
            share("distance", pen.distance.into())?;
            if !pen.tilt_deg.to_array().iter().all(|lean| (-90.0..=90.0).contains(lean)) {
                return Err(format!("tilt beyond 90 degrees: {event:?}"));
            }
            if !(0.0..360.0).contains(&pen.twist_deg) {
                return Err(format!("twist is not within one turn: {event:?}"));
            }
            if !pen.in_range && *event != AWAY {
                return Err(format!("a pen out of range says more: {event:?}"));
            }
            Ok(())
        }
        HidEvent::Touch { position, .. } => {
            share("touch x", position.x)?;
            share("touch y", position.y)
        }
        HidEvent::Keys(_) | HidEvent::Dial { .. } => Ok(()),
        HidEvent::Ring { place, places, .. } | HidEvent::Strip { place, places, .. } => {
            let is_there = place.is_none_or(|place| place < *places);
            if is_there { Ok(()) } else { Err(format!("beyond the ring: {event:?}")) }
        }
        HidEvent::Battery(percent) => share("battery", f64::from(*percent) / 100.0),
    }
}

#[cfg(test)]
mod tests;
