//! Wacom from 2017 on: one layout with 8-bit tilt (report 0x10), one with 16-bit tilt (0x1E), a small one (0x1F), and the
//! Bluetooth form with seven moments in a report (0x80).
//!
//! Flags, in range and height follow real report descriptors. Twist is in fifths of a degree. What a model does not
//! have, its report ends before or leaves zero; only what every model has must be there.

use super::spec::{share, tilt, twist};
use super::{AWAY, Bytes, Decode, Family, HidEvent, RawPen, Spec, bit};
use glam::DVec2;

const PEN_8_BIT_TILT: u8 = 0x10;
const KEYS: u8 = 0x11;
const PEN_16_BIT_TILT: u8 = 0x1E;
const PEN_SMALL: u8 = 0x1F;
const FINGERS: [u8; 2] = [0x21, 0xD2];
const MOMENTS: u8 = 0x80;
/// Greatest height, in the narrow and the wide byte.
const NARROW_HEIGHTS: f32 = 63.0;
const WIDE_HEIGHTS: f32 = 255.0;
/// Bytes of a finger, and fingers in a report.
const FINGER: usize = 8;
const FINGER_SLOTS: usize = 5;
/// Bytes of a moment, and moments in a Bluetooth report.
const MOMENT: usize = 14;
const MOMENT_COUNT: usize = 7;
const SERIAL_AFTER_MOMENTS: usize = 99;

/// By cable.
pub(super) struct Modern {
    spec: Spec,
}

impl Modern {
    pub(super) fn new(spec: Spec) -> Self {
        Self { spec }
    }

    fn read(&self, b: Bytes<'_>) -> Option<HidEvent> {
        match b.u8(0)? {
            PEN_8_BIT_TILT if self.spec.family == Family::WacomIntuosV2 => pen_8_bit_tilt(&self.spec, b),
            PEN_16_BIT_TILT => pen_16_bit_tilt(&self.spec, b),
            PEN_SMALL if self.spec.family == Family::WacomIntuosV3 && b.u8(1)? == 1 => {
                small_pen(&self.spec, b)
            }
            KEYS if self.spec.family == Family::WacomIntuosV3 => {
                let (left, right) = (u32::from(b.u8(1)?), u32::from(b.u8(3)?));
                // Four keys, a dial's button, four keys, the other dial's button.
                Some(HidEvent::Keys(left & 0x0F | (right & 1) << 4 | (left & 0xF0) << 1 | (right & 2) << 8))
            }
            KEYS => Some(HidEvent::Keys(u32::from(b.u8(1)?) | (u32::from(b.u8(3)?) & 1) << 8)),
            _ => None,
        }
    }
}

impl Decode for Modern {
    fn decode(&mut self, report: &[u8], sink: &mut dyn FnMut(HidEvent)) {
        let b = Bytes(report);
        if b.u8(0).is_some_and(|id| FINGERS.contains(&id)) {
            fingers(&self.spec, report, sink);
        } else if let Some(event) = self.read(b) {
            sink(event);
        }
    }
}

/// Pen flags as these reports share them, from the tip on upward.
fn flagged(pen: RawPen, touches: bool, erases: bool, inverted: bool, barrel: [bool; 3]) -> RawPen {
    RawPen { touches: touches || erases, eraser: inverted || erases, barrel, ..pen }
}

fn pen_8_bit_tilt(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    let flags = b.u8(1)?;
    let pen = spec.pen(b.u24(2)?, b.u24(5)?, b.u16(8)?);
    if !bit(flags, 5) {
        return Some(AWAY);
    }
    let barrel = [bit(flags, 1), bit(flags, 2), false];
    Some(HidEvent::Pen(RawPen {
        tilt_deg: tilt(b.i8(10).unwrap_or(0), b.i8(11).unwrap_or(0)),
        twist_deg: twist(b.i16(12).unwrap_or(0).into()),
        distance: (f32::from(b.u8(16).unwrap_or(0)) / NARROW_HEIGHTS).min(1.0),
        serial: b.u32(17).unwrap_or(0).into(),
        ..flagged(pen, bit(flags, 0), bit(flags, 3), bit(flags, 4), barrel)
    }))
}

fn pen_16_bit_tilt(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    let flags = b.u8(2)?;
    let pen = spec.pen(b.u24(3)?, b.u24(6)?, b.u16(9)?);
    if !bit(flags, 6) {
        return Some(AWAY);
    }
    let barrel = [bit(flags, 1), bit(flags, 2), bit(flags, 3)];
    Some(HidEvent::Pen(RawPen {
        tilt_deg: tilt(b.i16(11)?, b.i16(13)?),
        twist_deg: twist(b.i16(15).unwrap_or(0).into()),
        distance: f32::from(b.u8(19).unwrap_or(0)) / WIDE_HEIGHTS,
        serial: b.u32(20).unwrap_or(0).into(),
        ..flagged(pen, bit(flags, 0), bit(flags, 4), bit(flags, 5), barrel)
    }))
}

fn small_pen(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    let flags = b.u8(2)?;
    let pen = spec.pen(b.u16(3)?, b.u16(5)?, b.u16(7)?);
    if !bit(flags, 6) {
        return Some(AWAY);
    }
    let barrel = [bit(flags, 1), bit(flags, 2), false];
    Some(HidEvent::Pen(RawPen {
        tilt_deg: tilt(b.i16(9)?, b.i16(11)?),
        distance: f32::from(b.u8(13).unwrap_or(0)) / WIDE_HEIGHTS,
        ..flagged(pen, bit(flags, 0), bit(flags, 4), bit(flags, 5), barrel)
    }))
}

fn fingers(spec: &Spec, report: &[u8], sink: &mut dyn FnMut(HidEvent)) {
    let Some([across, along]) = spec.touch else { return };
    let slots = report.get(2..).unwrap_or_default().chunks_exact(FINGER).take(FINGER_SLOTS);
    for slot in slots.map(Bytes) {
        let (Some(id), Some(state), Some(x), Some(y)) = (slot.u8(0), slot.u8(1), slot.u16(2), slot.u16(4))
        else {
            continue;
        };
        if let Some(finger) = id.checked_sub(1) {
            let position = DVec2::new(share(x.into(), across), share(y.into(), along));
            sink(HidEvent::Touch { finger: finger.into(), touches: state != 0, position });
        }
    }
}

/// Over Bluetooth: several moments in one report; what comes after them belongs to all.
pub(super) struct Bluetooth {
    spec: Spec,
}

impl Bluetooth {
    pub(super) fn new(spec: Spec) -> Self {
        Self { spec }
    }

    fn moment(&self, b: Bytes<'_>, serial: u64) -> Option<HidEvent> {
        let flags = b.u8(0)?;
        if !bit(flags, 7) {
            return None;
        }
        if !bit(flags, 5) {
            return Some(AWAY);
        }
        let pen = self.spec.pen(b.u16(1)?, b.u16(3)?, b.u16(5)?);
        let barrel = [bit(flags, 1), bit(flags, 2), false];
        Some(HidEvent::Pen(RawPen {
            tilt_deg: tilt(b.i8(7)?, b.i8(8)?),
            twist_deg: twist(b.i16(9)?.into()),
            distance: (f32::from(b.u8(13)?) / NARROW_HEIGHTS).min(1.0),
            serial,
            ..flagged(pen, bit(flags, 0), bit(flags, 3), bit(flags, 4), barrel)
        }))
    }
}

impl Decode for Bluetooth {
    fn decode(&mut self, report: &[u8], sink: &mut dyn FnMut(HidEvent)) {
        let b = Bytes(report);
        let Some(serial) = b.u64(SERIAL_AFTER_MOMENTS).filter(|_| b.u8(0) == Some(MOMENTS)) else { return };
        for moment in report.get(1..).unwrap_or_default().chunks_exact(MOMENT).take(MOMENT_COUNT) {
            if let Some(event) = self.moment(Bytes(moment), serial) {
                sink(event);
            }
        }
    }
}

#[cfg(test)]
#[path = "wacom_modern_tests.rs"]
mod tests;
