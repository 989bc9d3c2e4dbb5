//! Veikk and Xoppox: report id 9; the second byte names the channel, the third what it says.
//!
//! Which bit is the tip is not known for these, so pressure tells.

use super::spec::tilt as lean;
use super::{AWAY, Bytes, HidEvent, RawPen, Spec, bit};

const PEN: u8 = 0x41;
const KEYS: u8 = 0x42;
const TOUCHPAD: u8 = 0x43;
const LEFT: u8 = 0xC0;
/// Report id under which early models type their keys, and the HID key codes of keys 1 to 12. Keys 4 and 6 share one
/// code and differ in the modifier.
const TYPED: u8 = 0x03;
const TYPED_CODES: [u8; 12] = [0x3E, 0x0C, 0x2C, 0x19, 0x06, 0x19, 0x1D, 0x16, 0x2E, 0x2D, 0x30, 0x2F];

fn wide_pen(spec: &Spec, b: Bytes<'_>) -> Option<RawPen> {
    let flags = b.u8(2)?;
    let pen = spec.pen(b.u24(3)?, b.u24(6)?, b.u16(9)?);
    Some(RawPen { barrel: [bit(flags, 1), bit(flags, 2), false], ..pen })
}

fn narrow_pen(spec: &Spec, b: Bytes<'_>, buttons: usize) -> Option<HidEvent> {
    let flags = b.u8(2)?;
    let pen = spec.pen(b.u16(3)?, b.u16(5)?, b.u16(7)?);
    let barrel = [bit(flags, 1), bit(flags, 2), bit(flags, 3) && buttons > 2];
    Some(HidEvent::Pen(RawPen { barrel, ..pen }))
}

/// Keys count only while byte 3 says that any is held.
fn keys(b: Bytes<'_>) -> Option<HidEvent> {
    let held = bit(b.u8(3)?, 0);
    let keys = u32::from(b.u8(4)?) | u32::from(b.u8(5)? & 0x0F) << 8;
    Some(HidEvent::Keys(if held { keys } else { 0 }))
}

pub(super) fn veikk(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    match b.u8(2)? {
        _ if !spec.speaks(b) || b.u8(1)? == TOUCHPAD => None,
        LEFT => Some(AWAY),
        flags if bit(flags, 5) => wide_pen(spec, b).map(HidEvent::Pen),
        1 => keys(b),
        _ => None,
    }
}

pub(super) fn tilt(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    match (b.u8(1)?, b.u8(2)?) {
        _ if !spec.speaks(b) => None,
        (PEN, LEFT) => Some(AWAY),
        (PEN, _) => {
            let tilt_deg = lean(b.i8(11)?, b.i8(12)?);
            Some(HidEvent::Pen(RawPen { tilt_deg, ..wide_pen(spec, b)? }))
        }
        (KEYS, _) => keys(b),
        _ => None,
    }
}

pub(super) fn v1(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    if b.u8(0)? == TYPED {
        return typed_keys(b);
    }
    match (b.u8(1)?, b.u8(2)?) {
        _ if !spec.speaks(b) => None,
        (PEN, LEFT) => Some(AWAY),
        (PEN, flags) if flags & 0xF0 == 0xA0 => narrow_pen(spec, b, 3),
        _ => None,
    }
}

fn typed_keys(b: Bytes<'_>) -> Option<HidEvent> {
    let modified = b.u8(1)? != 0;
    let mut keys = 0;
    for &code in b.0.get(2..)? {
        let places = TYPED_CODES.iter().enumerate().filter(|(_, c)| **c == code).map(|(place, _)| place);
        let place = if modified { places.max() } else { places.min() };
        keys |= place.map_or(0, |place| 1_u32 << place);
    }
    Some(HidEvent::Keys(keys))
}

pub(super) fn a15(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    match b.u8(2)? {
        _ if !spec.speaks(b) || b.u8(1)? == TOUCHPAD => None,
        LEFT => Some(AWAY),
        flags if bit(flags, 5) => narrow_pen(spec, b, 2),
        1 => keys(b),
        _ => None,
    }
}

pub(super) fn plain(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    match (b.u8(1)?, b.u8(2)?) {
        _ if !spec.speaks(b) => None,
        (PEN, LEFT) => Some(AWAY),
        (PEN, _) => narrow_pen(spec, b, 3),
        _ => None,
    }
}

#[cfg(test)]
#[path = "veikk_tests.rs"]
mod tests;
