//! Families of one or two tablets each: ViewSonic Woodpad, XENX, FlooGoo, LifeTec, RobotPen.

use super::spec::tilt;
use super::uclogic::plain_pen;
use super::{AWAY, Bytes, HidEvent, RawPen, Spec, bit};

/// FlooGoo gives tilt in hundredths of a degree.
const PER_DEGREE: f32 = 100.0;

/// In range while both low bits of byte 9 are set; tilt bytes are of unknown sign and left alone.
pub(super) fn woodpad(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    let flags = b.u8(9)?;
    if flags & 3 != 3 {
        return Some(AWAY);
    }
    let (touches, pressure) = (bit(flags, 2), b.u16(10)?);
    let pen = spec.pen(b.u16(1)?, b.u16(5)?, if touches { pressure } else { 0 });
    Some(HidEvent::Pen(RawPen { touches, barrel: [bit(flags, 3), bit(flags, 4), false], ..pen }))
}

/// Report 1 is the pen, empty flags say that it left; report 2 has a byte for each of ten keys.
pub(super) fn xenx(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    match (b.u8(0)?, b.u8(1)?) {
        (1, 0) => Some(AWAY),
        (1, flags) => {
            let barrel = [bit(flags, 1), bit(flags, 2), false];
            Some(HidEvent::Pen(RawPen { barrel, eraser: bit(flags, 6), ..plain_pen(spec, b)? }))
        }
        (2, _) => {
            let held = b.0.get(2..12)?.iter().enumerate().filter(|(_, key)| **key != 0);
            Some(HidEvent::Keys(held.map(|(place, _)| 1 << place).sum()))
        }
        _ => None,
    }
}

pub(super) fn floogoo(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    let flags = b.u8(1)?;
    let (x, y) = (b.i16(8)?, b.i16(10)?);
    if b.u8(0)? != 1 {
        return None;
    }
    if !bit(flags, 5) {
        return Some(AWAY);
    }
    Some(HidEvent::Pen(RawPen {
        barrel: [bit(flags, 1), bit(flags, 2), false],
        eraser: bit(flags, 3),
        tilt_deg: tilt(f32::from(x) / PER_DEGREE, f32::from(y) / PER_DEGREE),
        ..spec.pen(b.u16(2)?, b.u16(4)?, b.u16(6)?)
    }))
}

/// Its lean is given as azimuth and altitude in places that are not known.
pub(super) fn lifetec(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    if b.u8(0)? != 2 {
        return None;
    }
    let flags = b.u8(5)?;
    let pen = spec.pen(b.u16(1)?, b.u16(3)?, b.u16(6)?);
    Some(HidEvent::Pen(RawPen { barrel: [bit(flags, 3), bit(flags, 4), false], ..pen }))
}

/// The bit said to be its button lies inside the pressure, where it would be held by pressing hard: left alone.
pub(super) fn robotpen(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    if b.u8(1)? != 0x42 {
        return Some(AWAY);
    }
    Some(HidEvent::Pen(spec.pen(b.u16(6)?, b.u16(8)?, b.u16(10)?)))
}

#[cfg(test)]
#[path = "others_tests.rs"]
mod tests;
