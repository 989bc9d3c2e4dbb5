//! What one input report says, whatever family of tablet sent it.
//!
//! Decoders are pure: bytes in, events out, state only where the protocol itself latches (a tool announced in one report and
//! used in the next). They allocate nothing for a report. Units are the same for all: position and pressure as shares of
//! the device's range, angles in degrees.

use crate::pen::raw_pen::RawPen;
use glam::DVec2;

/// What a report says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HidEvent {
    /// Where the pen is and how it is held.
    Pen(RawPen),
    /// Which keys of the tablet are held: bit 0 is the first key.
    Keys(u32),
    /// A dial of the tablet was turned.
    Dial {
        /// Which, from 0.
        number: u8,
        /// By how many notches, clockwise positive.
        notches: i8,
    },
    /// Where a finger lies on a ring of the tablet.
    Ring {
        /// Which, from 0.
        number: u8,
        /// The place, from 0; `None` while no finger is there.
        place: Option<u8>,
        /// How many places there are.
        places: u8,
    },
    /// Where a finger lies on a strip of the tablet, whose ends do not meet.
    Strip {
        /// Which, from 0: the left one, then the right one.
        number: u8,
        /// The place, from 0 at its far end; `None` while no finger is there.
        place: Option<u8>,
        /// How many places there are.
        places: u8,
    },
    /// A finger: its number, whether it touches, and where, as a share of the area. A touch the device itself takes for a
    /// palm is never reported.
    Touch {
        /// Number of the contact for as long as it touches.
        finger: u16,
        /// It touches now.
        touches: bool,
        /// Share of the touch area, 0 to 1.
        position: DVec2,
    },
    /// Charge of the pen or the tablet in percent.
    Battery(u8),
}

/// Turns the input reports of one device node into events.
pub trait Decode: Send {
    /// Decodes one report and hands each thing it says to `sink`. `report[0]` is the report id; nodes without report ids have
    /// 0 there. Reports that are cut short, unknown or not about a pen say nothing.
    fn decode(&mut self, report: &[u8], sink: &mut dyn FnMut(HidEvent));
}
