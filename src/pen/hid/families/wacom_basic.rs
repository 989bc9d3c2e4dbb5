//! Wacom's simple layouts: small Intuos and Bamboo until 2015, Bamboo Pad, PTU.
//!
//! In range follows the Linux kernel (bit 5), not the coarser proximity bit 6. The eraser is decided when the pen comes
//! into range and kept until it leaves, as the kernel does.

use super::{AWAY, Bytes, HidEvent, OneEvent, RawPen, Spec, bit};

/// Report id of the pen once the tablet is woken.
const PEN: u8 = 0x02;
/// Greatest height that small Intuos report; they count it downward.
const HEIGHTS: u8 = 31;

/// Small Intuos and Bamboo.
pub(super) struct Bamboo {
    spec: Spec,
    /// Which end came into range, as long as one is.
    eraser: Option<bool>,
}

impl Bamboo {
    pub(super) fn new(spec: Spec) -> Self {
        Self { spec, eraser: None }
    }
}

impl OneEvent for Bamboo {
    fn read(&mut self, b: Bytes<'_>) -> Option<HidEvent> {
        let flags = b.u8(1)?;
        if b.u8(0)? != PEN {
            return None;
        }
        let pen = self.spec.pen(b.u16(2)?, b.u16(4)?, b.u16(6)?);
        if !bit(flags, 5) {
            self.eraser = None;
            return Some(AWAY);
        }
        let eraser = *self.eraser.get_or_insert(bit(flags, 3));
        let distance =
            b.u8(8).map_or(0.0, |near| f32::from(HEIGHTS.saturating_sub(near)) / f32::from(HEIGHTS));
        let barrel = [bit(flags, 1), bit(flags, 2), false];
        Some(HidEvent::Pen(RawPen { touches: bit(flags, 0), eraser, barrel, distance, ..pen }))
    }
}

/// One report for pen, keys and fingers; fingers say nothing. It is not known how the pen leaves: silence
/// while it hovers says so.
pub(super) fn bamboo_pad(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    match (b.u8(0)?, b.u8(1)?) {
        (0x10, 0x01) => {
            let flags = b.u8(2)?;
            let pen = spec.pen(b.u16(3)?, b.u16(5)?, b.u16(7)?);
            let barrel = [bit(flags, 1), false, false];
            Some(HidEvent::Pen(RawPen { barrel, eraser: bit(flags, 3), ..pen }))
        }
        (0x10, 0x06) => match b.u8(23)? {
            key @ 0..=2 => Some(HidEvent::Keys(key.into())),
            _ => None,
        },
        _ => None,
    }
}

/// Two tips, one for each end.
pub(super) fn ptu(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    let flags = b.u8(1)?;
    if b.u8(0)? != PEN {
        return None;
    }
    let pen = spec.pen(b.u16(2)?, b.u16(4)?, b.u16(6)?);
    if !bit(flags, 5) {
        return Some(AWAY);
    }
    let (touches, eraser) = (bit(flags, 0) || bit(flags, 3), bit(flags, 2));
    Some(HidEvent::Pen(RawPen { touches, eraser, barrel: [bit(flags, 1), bit(flags, 4), false], ..pen }))
}

#[cfg(test)]
#[path = "wacom_basic_tests.rs"]
mod tests;
