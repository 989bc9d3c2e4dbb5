//! XP-Pen, UGEE, Parblo, Adesso, Xencelabs: report id 2 after waking, the second byte tells what a report is about.
//!
//! The layout grows with the node: nodes under 10 bytes have flags, x, y and pressure; from 10 bytes on comes tilt; from
//! 12 on, the upper bits of x and y. Only `0xF0` is taken for keys: other reports with bit 4 tell of the battery.

use super::spec::tilt;
use super::uclogic::{self, plain_pen};
use super::{AWAY, Bytes, HidEvent, RawPen, Spec, barrel, bit};

const LEFT: u8 = 0xC0;
const KEYS: u8 = 0xF0;
/// Shortest nodes, in bytes, with tilt, and with 24-bit positions.
const WITH_TILT: usize = 10;
const WITH_UPPER_BITS: usize = 12;
/// Bits of pressure where other things stand above them.
const THIRTEEN_BITS: u16 = 0x1FFF;

/// A pen in a node of at least 10 bytes, but for what is odd about its pressure.
fn long_pen(spec: &Spec, b: Bytes<'_>, pressure: u16) -> Option<RawPen> {
    let flags = b.u8(1)?;
    let (x, y) = if spec.report_length >= WITH_UPPER_BITS {
        (b.u16_and_above(2, 10)?, b.u16_and_above(4, 11)?)
    } else {
        (b.u16(2)?.into(), b.u16(4)?.into())
    };
    Some(RawPen {
        touches: bit(flags, 0),
        barrel: [bit(flags, 1), bit(flags, 2), false],
        eraser: bit(flags, 3),
        tilt_deg: tilt(b.i8(8)?, b.i8(9)?),
        ..spec.pen(x, y, pressure)
    })
}

/// Reports by their second byte; `pressure` cleans the raw pressure of long reports.
fn sorted(spec: &Spec, b: Bytes<'_>, pressure: fn(u16) -> u16) -> Option<HidEvent> {
    match b.u8(1)? {
        _ if !spec.speaks(b) => None,
        LEFT => Some(AWAY),
        KEYS => b.twenty_keys(2).map(HidEvent::Keys),
        flags if bit(flags, 4) => None,
        _ if spec.report_length < WITH_TILT => plain_pen(spec, b).map(HidEvent::Pen),
        flags if !bit(flags, 5) => Some(AWAY),
        _ => long_pen(spec, b, pressure(b.u16(6)?)).map(HidEvent::Pen),
    }
}

pub(super) fn xp_pen(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    sorted(spec, b, |pressure| pressure)
}

/// Short reports have their upper pressure bits free; only long ones share them.
pub(super) fn offset_pressure(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    if spec.report_length < WITH_TILT && b.u8(1)? & 0x10 == 0 && b.u8(1)? != LEFT {
        let flags = b.u8(1)?;
        let pen = plain_pen(spec, b)?;
        let barrel = [bit(flags, 1), bit(flags, 2), false];
        return spec.speaks(b).then_some(HidEvent::Pen(RawPen { barrel, eraser: bit(flags, 3), ..pen }));
    }
    sorted(spec, b, |pressure| pressure & THIRTEEN_BITS)
}

/// 14 bits of pressure: thirteen in the word, the uppermost there or in the last byte.
pub(super) fn gen2(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    match b.u8(1)? {
        _ if !spec.speaks(b) => None,
        LEFT => Some(AWAY),
        flags if flags & 0xF0 == 0xA0 => {
            let pressure = b.u16(6)? & 0x3FFF | u16::from(b.u8(13)? & 1) << 13;
            long_pen(spec, b, pressure).map(HidEvent::Pen)
        }
        _ => None,
    }
}

/// Bit 5 says "keys", which stand where UC-Logic has them.
pub(super) fn offset_aux(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    match b.u8(1)? {
        _ if !spec.speaks(b) => None,
        LEFT => Some(AWAY),
        flags if bit(flags, 5) => uclogic::keys(b),
        _ if spec.report_length < WITH_TILT => plain_pen(spec, b).map(HidEvent::Pen),
        _ => long_pen(spec, b, b.u16(6)?).map(HidEvent::Pen),
    }
}

/// Whether bit 0 is the tip is not known, so pressure tells.
pub(super) fn xencelabs(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    match b.u8(1)? {
        _ if !spec.speaks(b) => None,
        KEYS => b.twenty_keys(2).map(HidEvent::Keys),
        flags if flags & 0xF0 == 0xF0 => None,
        flags if bit(flags, 5) => Some(HidEvent::Pen(RawPen {
            barrel: barrel(flags, [1, 2, 3]),
            eraser: bit(flags, 6),
            tilt_deg: tilt(b.i8(8)?, b.i8(9)?),
            ..spec.pen(b.u16(2)?, b.u16(4)?, b.u16(6)?)
        })),
        _ => Some(AWAY),
    }
}

#[cfg(test)]
#[path = "xp_pen_tests.rs"]
mod tests;
