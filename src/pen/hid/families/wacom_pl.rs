//! Wacom PL: seven bits a byte, and one bit that is either the eraser or the upper button.
//!
//! The bit means the eraser if it is set when the pen comes into range; once it is seen clear, it was the button after
//! all, as the Linux kernel decides it.

use super::{AWAY, Bytes, HidEvent, OneEvent, RawPen, Spec, bit};

/// What the double-faced bit has proved to be since the pen came into range.
#[derive(Clone, Copy, PartialEq, Eq)]
enum End {
    Pen,
    MaybeEraser,
}

/// Keeps which end is in range.
pub(super) struct Pl {
    spec: Spec,
    end: Option<End>,
}

impl Pl {
    pub(super) fn new(spec: Spec) -> Self {
        Self { spec, end: None }
    }
}

impl OneEvent for Pl {
    fn read(&mut self, b: Bytes<'_>) -> Option<HidEvent> {
        let (first, second) = (b.u8(1)?, b.u8(4)?);
        let coordinate = |upper: u8, at: usize| {
            let (middle, low) = (u16::from(b.u8(at)? & 0x7F), u16::from(b.u8(at + 1)? & 0x7F));
            Some(u16::from(upper & 3) << 14 | middle << 7 | low)
        };
        let (x, y) = (coordinate(first, 2)?, coordinate(second, 5)?);
        let upper_pressure = u16::from((b.u8(7)? ^ 0x40) & 0x7F);
        if !bit(first, 6) {
            self.end = None;
            return Some(AWAY);
        }
        let either = bit(second, 5);
        let end = match self.end {
            None | Some(End::MaybeEraser) if either => End::MaybeEraser,
            _ => End::Pen,
        };
        self.end = Some(end);
        let pressure = upper_pressure << 2 | u16::from(bit(second, 6)) << 1 | u16::from(bit(second, 2));
        Some(HidEvent::Pen(RawPen {
            touches: bit(second, 3),
            eraser: end == End::MaybeEraser,
            barrel: [bit(second, 4), either && end == End::Pen, false],
            ..self.spec.pen(x, y, pressure)
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::super::Family;
    use super::super::testing::{away, pen, silent_when_cut, spec};

    #[test]
    fn one_bit_is_eraser_or_button() {
        let mut pl = spec(Family::WacomPl, 8).decoder();
        // id, in range and x 1<<14, -, -, tip and lower button and y 0, y 32<<7, -, pressure (0x00 flipped is 64) × 4
        let report = [2, 0x41, 0, 0, 0x18, 0x20, 0, 0x00];
        let seen = pen(&mut *pl, &report);
        assert_eq!((seen.position.x, seen.position.y), (0.5, 0.25));
        assert_eq!(seen.pressure, Some(256.0 / 8192.0));
        assert!(seen.touches && !seen.eraser && seen.barrel == [true, false, false]);
        let mut pressed = report;
        pressed[4] = 0x20;
        assert!(pen(&mut *pl, &pressed).barrel[1], "set after it was clear: the button");
        assert!(away(&mut *pl, &[2, 0x01, 0, 0, 0x18, 0x20, 0, 0x40]));
        let erasing = pen(&mut *pl, &pressed);
        assert!(erasing.eraser && !erasing.barrel[1], "set from the first report on: the eraser");
        assert!(!pen(&mut *pl, &report).eraser, "clear: it was the pen");
        silent_when_cut(spec(Family::WacomPl, 8), &report, 8);
    }
}
