//! Acepen: like early Veikk, with tilt, and keys that tell one change at a time.
//!
//! The tilt bytes are read as signed, which they plausibly are.

use super::spec::tilt;
use super::{AWAY, Bytes, HidEvent, OneEvent, RawPen, Spec, bit};

const PEN: u8 = 0x41;
const KEY: u8 = 0x42;

/// Keeps which keys are held.
pub(super) struct Acepen {
    spec: Spec,
    keys: u32,
}

impl Acepen {
    pub(super) fn new(spec: Spec) -> Self {
        Self { spec, keys: 0 }
    }
}

impl OneEvent for Acepen {
    fn read(&mut self, b: Bytes<'_>) -> Option<HidEvent> {
        match (b.u8(1)?, b.u8(2)?) {
            _ if !self.spec.speaks(b) => None,
            (PEN, flags) if flags & 0xF0 == 0xA0 => Some(HidEvent::Pen(RawPen {
                barrel: [bit(flags, 1), bit(flags, 2), false],
                tilt_deg: tilt(b.i8(9)?, b.i8(10)?),
                ..self.spec.pen(b.u16(3)?, b.u16(5)?, b.u16(7)?)
            })),
            (PEN, _) => Some(AWAY),
            (KEY, _) => {
                let key = 1_u32 << b.u8(4)?.checked_ilog2()?;
                self.keys = if bit(b.u8(3)?, 0) { self.keys | key } else { self.keys & !key };
                Some(HidEvent::Keys(self.keys))
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Family;
    use super::super::testing::{away, keys, pen, silent_when_cut, spec};

    #[test]
    fn pen_leans_and_leaves() {
        let mut acepen = spec(Family::Acepen, 11).decoder();
        // id, channel, flags (in range, upper button), x 8192, y 4096, pressure 4096, tilt −10, 20
        let report = [9, 0x41, 0xA4, 0x00, 0x20, 0x00, 0x10, 0x00, 0x10, 0xF6, 0x14];
        let seen = pen(&mut *acepen, &report);
        assert_eq!((seen.position.x, seen.position.y, seen.pressure), (0.25, 0.25, Some(0.5)));
        assert_eq!((seen.tilt_deg.x, seen.tilt_deg.y), (-10.0, 20.0));
        assert!(seen.touches && seen.barrel == [false, true, false]);
        assert!(away(&mut *acepen, &[9, 0x41, 0xC0, 0, 0, 0, 0, 0, 0, 0, 0]));
        silent_when_cut(spec(Family::Acepen, 11), &report, 11);
    }

    #[test]
    fn keys_are_kept_until_released() {
        let mut acepen = spec(Family::Acepen, 11).decoder();
        // id, channel, -, pressed, bit of the key
        assert_eq!(keys(&mut *acepen, &[9, 0x42, 0, 1, 0x01]), 0b001);
        assert_eq!(keys(&mut *acepen, &[9, 0x42, 0, 1, 0x04]), 0b101);
        assert_eq!(keys(&mut *acepen, &[9, 0x42, 0, 0, 0x01]), 0b100);
        silent_when_cut(spec(Family::Acepen, 11), &[9, 0x42, 0, 1, 0x01], 5);
    }
}
