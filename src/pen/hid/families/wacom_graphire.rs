//! Wacom Graphire and the Bamboo of 2007: pen, mouse and keys in one report.
//!
//! The mouse says nothing here. The eraser is decided when the pen comes into range and kept until it leaves.

use super::{AWAY, Bytes, Decode, HidEvent, RawPen, Spec, bit};

const PEN: u8 = 0x02;

/// Keeps which end is in range, and the keys, which every report repeats.
pub(super) struct Graphire {
    spec: Spec,
    key_places: &'static [u8],
    eraser: Option<bool>,
    keys: u32,
}

impl Graphire {
    pub(super) fn new(spec: Spec) -> Self {
        Self { spec, key_places: &[6, 7], eraser: None, keys: 0 }
    }

    pub(super) fn bamboo(spec: Spec) -> Self {
        Self { key_places: &[3, 4, 5, 6], ..Self::new(spec) }
    }

    fn pen(&mut self, b: Bytes<'_>) -> Option<HidEvent> {
        let (flags, upper) = (b.u8(1)?, b.u8(7)? & 3);
        let touches = bit(flags, 0);
        let raw = u16::from(b.u8(6)?) | u16::from(upper) << 8;
        let (x, y) = (b.u16(2)?, b.u16(4)?);
        let present = bit(flags, 7) || x != 0 || y != 0 || raw != 0;
        if present && bit(flags, 6) {
            return None;
        }
        if !bit(flags, 7) {
            // A report about keys alone does not repeat that the pen is gone.
            return (self.eraser.take().is_some() || present).then_some(AWAY);
        }
        let eraser = *self.eraser.get_or_insert(bit(flags, 5));
        let barrel = [bit(flags, 1), bit(flags, 2), false];
        let pen = self.spec.pen(x, y, if touches { raw } else { 0 });
        Some(HidEvent::Pen(RawPen { touches, eraser, barrel, ..pen }))
    }
}

impl Decode for Graphire {
    fn decode(&mut self, report: &[u8], sink: &mut dyn FnMut(HidEvent)) {
        let b = Bytes(report);
        let (Some(PEN), Some(held)) = (b.u8(0), b.u8(7)) else { return };
        if let Some(event) = self.pen(b) {
            sink(event);
        }
        let places = self.key_places.iter().enumerate();
        let keys = places.filter(|(_, place)| bit(held, **place)).map(|(key, _)| 1 << key).sum();
        if keys != self.keys {
            self.keys = keys;
            sink(HidEvent::Keys(keys));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{away, events, pen, quiet, silent_when_cut, spec};
    use super::super::{Family, HidEvent};

    #[test]
    fn pen_eraser_keys_and_mouse() {
        for (family, key) in [(Family::WacomGraphire, 0x40), (Family::WacomBamboo, 0x08)] {
            let mut graphire = spec(family, 8).decoder();
            // id, flags (in range, eraser end, tip), x 16384, y 4096, pressure 0x200
            let report = [2, 0xA1, 0x00, 0x40, 0x00, 0x10, 0x00, 0x02];
            let seen = pen(&mut *graphire, &report);
            assert_eq!((seen.position.x, seen.position.y, seen.pressure), (0.5, 0.25, Some(0.0625)));
            assert!(seen.touches && seen.eraser);
            let latched = pen(&mut *graphire, &[2, 0x84, 0x00, 0x40, 0x00, 0x10, 0xFF, 0x00]);
            assert!(latched.eraser && !latched.touches && latched.barrel == [false, true, false]);
            assert_eq!(latched.pressure, Some(0.0), "pressure without the tip is none");
            assert!(away(&mut *graphire, &[2, 0x00, 0x00, 0x40, 0x00, 0x10, 0, 0]));
            let held = events(&mut *graphire, &[2, 0, 0, 0, 0, 0, 0, key]);
            assert_eq!(held, [HidEvent::Keys(1)], "keys alone");
            let mut mouse = report;
            (mouse[1], mouse[7]) = (0xC0, key);
            assert!(quiet(&mut *graphire, &mouse), "a mouse, and keys as they were");
            assert!(quiet(&mut *graphire, &[3, 0x81, 0, 0, 0, 0, 0, 0]), "another report");
            silent_when_cut(spec(family, 8), &report, 8);
        }
    }
}
