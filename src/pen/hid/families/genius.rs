//! Genius, Trust and Waltop.
//!
//! Neither layout is known to say when the pen leaves; a pen that hovers and falls silent is taken to have left.

use super::uclogic::plain_pen;
use super::{Bytes, HidEvent, RawPen, Spec, bit};

/// Keys of the second layout are numbered 1, 3, 5 …, of which there are so many.
const KEY_COUNT: u8 = 12;

/// Report 0x10 is the pen; 0x11 is a mouse, which says nothing here.
pub(super) fn genius(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    if b.u8(0)? == 0x10 { plain_pen(spec, b).map(HidEvent::Pen) } else { None }
}

/// Report 2 is the pen, whose pressure counts only while the tip touches; report 5 names one key.
pub(super) fn v2(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    match b.u8(0)? {
        2 => {
            let flags = b.u8(5)?;
            let (touches, pressure) = (bit(flags, 2), b.u16(6)?);
            let pen = spec.pen(b.u16(1)?, b.u16(3)?, if touches { pressure } else { 0 });
            Some(HidEvent::Pen(RawPen { touches, barrel: [bit(flags, 3), bit(flags, 4), false], ..pen }))
        }
        5 => match b.u8(3)?.checked_sub(1) {
            None => Some(HidEvent::Keys(0)),
            Some(twice) if twice / 2 < KEY_COUNT => Some(HidEvent::Keys(1 << (twice / 2))),
            Some(_) => None,
        },
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::Family;
    use super::super::testing::{keys, pen, quiet, silent_when_cut, spec};

    #[test]
    fn first_layout() {
        let mut genius = spec(Family::Genius, 8).decoder();
        // id, flags (tip, lower button), x 16384, y 4096, pressure 2048
        let report = [0x10, 0x03, 0x00, 0x40, 0x00, 0x10, 0x00, 0x08];
        let seen = pen(&mut *genius, &report);
        assert_eq!((seen.position.x, seen.position.y, seen.pressure), (0.5, 0.25, Some(0.25)));
        assert!(seen.touches && seen.barrel == [true, false, false]);
        assert!(quiet(&mut *genius, &[0x11, 0x01, 0, 0x40, 0, 0x10, 0, 0]), "a mouse");
        silent_when_cut(spec(Family::Genius, 8), &report, 8);
    }

    #[test]
    fn second_layout() {
        let mut genius = spec(Family::GeniusV2, 8).decoder();
        // id, x 16384, y 4096, flags (tip, upper button), pressure 2048
        let report = [2, 0x00, 0x40, 0x00, 0x10, 0x14, 0x00, 0x08];
        let seen = pen(&mut *genius, &report);
        assert_eq!((seen.position.x, seen.position.y, seen.pressure), (0.5, 0.25, Some(0.25)));
        assert!(seen.touches && seen.barrel == [false, true, false]);
        let hovering = pen(&mut *genius, &[2, 0x00, 0x40, 0x00, 0x10, 0x00, 0x00, 0x08]);
        assert!(!hovering.touches && hovering.pressure == Some(0.0), "pressure without the tip is none");
        silent_when_cut(spec(Family::GeniusV2, 8), &report, 8);
        // id, -, -, number of the key
        assert_eq!(keys(&mut *genius, &[5, 0, 0, 3]), 0b10);
        assert_eq!(keys(&mut *genius, &[5, 0, 0, 0]), 0);
        assert!(quiet(&mut *genius, &[5, 0, 0, 0xFF]));
    }
}
