//! Wacom Intuos 1 to 5, Intuos Pro until 2016, and the Cintiqs of that time.
//!
//! A tool announces itself in a packet of its own with serial number and kind; pen packets follow, and rotation packets
//! between them if the pen feels its turn. There is no tip switch: the lowest flag is a bit of pressure. A pen that was on
//! the tablet before the node was opened never announces itself and is taken for the tip end.
//!
//! The kind of tool is a nibble of the second byte; it is tested first, so that mice and airbrush wheels are never read
//! as pens. Origin of nibble, rotation and serial: the Linux kernel's `wacom` driver.

use super::spec::{tilt, twist};
use super::{AWAY, Bytes, Family, HidEvent, OneEvent, RawPen, Spec, bit};

/// Report ids: by cable, and through the wireless kit.
const TOOL: [u8; 2] = [0x02, 0x10];
const IN_RANGE_WITHOUT_DATA: u8 = 0x20;
/// Greatest pressure of models whose lowest flag is no bit of pressure.
const EVEN_PRESSURE: u32 = 2046;
const HEIGHTS: f32 = 63.0;
/// Half the steps of raw twist, and a full turn, in fifths of a degree.
const QUARTER_TURN: i32 = 450;
const HALF_TURN: i32 = 900;

/// Keeps the announced tool and what the last pen packet said.
pub(super) struct Intuos {
    spec: Spec,
    eraser: bool,
    serial: u64,
    last: RawPen,
}

impl Intuos {
    pub(super) fn new(spec: Spec) -> Self {
        Self { spec, eraser: false, serial: 0, last: RawPen::default() }
    }

    fn tool(&mut self, id: u8, b: Bytes<'_>) -> Option<HidEvent> {
        let flags = b.u8(1)?;
        match flags {
            IN_RANGE_WITHOUT_DATA if id == TOOL[1] => return None,
            0x80 | 0x81 => {
                (self.eraser, self.serial, self.last) = (false, 0, RawPen::default());
                return Some(AWAY);
            }
            0xC0..=0xC3 => return self.announce(b),
            _ if !bit(flags, 5) => return None,
            _ => {}
        }
        let pen = match flags >> 1 & 0x0F {
            0..=3 => self.pen(flags, b)?,
            // On the oldest models this is the second half of what a mouse says.
            5 if !self.is_oldest() => self.turn(b)?,
            0x0A => RawPen {
                position: place(&self.spec, b)?.position,
                tilt_deg: self.lean(b)?,
                ..self.last_in_range()
            },
            _ => return None,
        };
        self.last = pen;
        Some(HidEvent::Pen(pen))
    }

    fn is_oldest(&self) -> bool {
        self.spec.family == Family::WacomIntuosV1 && self.spec.pressure == EVEN_PRESSURE
    }

    /// A tool packet: says nothing yet, but what the packets to come are about.
    fn announce(&mut self, b: Bytes<'_>) -> Option<HidEvent> {
        let [b3, b4, b5, b6, b7] = [3, 4, 5, 6, 7].map(|at| b.u8(at).map(u64::from));
        let serial = (b3? & 0x0F) << 28 | b4? << 20 | b5? << 12 | b6? << 4 | b7? >> 4;
        (self.eraser, self.serial) = (bit(b.u8(3)?, 7), serial);
        None
    }

    fn pen(&self, flags: u8, b: Bytes<'_>) -> Option<RawPen> {
        let lowest = u32::from(bit(flags, 0) && self.spec.pressure != EVEN_PRESSURE);
        let pressure = u32::from(b.u8(6)?) << 3 | u32::from(b.u8(7)? >> 6) << 1 | lowest;
        let pressed = self.spec.pen(0_u32, 0_u32, pressure);
        let at = place(&self.spec, b)?;
        Some(RawPen {
            touches: pressed.touches,
            pressure: pressed.pressure,
            eraser: self.eraser,
            barrel: [bit(flags, 1), bit(flags, 2), false],
            tilt_deg: self.lean(b)?,
            twist_deg: self.last.twist_deg,
            serial: self.serial,
            ..at
        })
    }

    fn lean(&self, b: Bytes<'_>) -> Option<glam::Vec2> {
        let (upper, lower) = (b.u8(7)?, b.u8(8)?);
        let x = (upper & 0x3F) << 1 | lower >> 7;
        let y = lower & 0x7F;
        let raw = tilt(f32::from(x) - 64.0, f32::from(y) - 64.0);
        Some(if self.spec.tilts { raw } else { glam::Vec2::ZERO })
    }

    /// A rotation packet: place and turn; the rest is as the last pen packet said.
    fn turn(&self, b: Bytes<'_>) -> Option<RawPen> {
        let low = b.u8(7)?;
        let t = i32::from(b.u8(6)?) << 3 | i32::from(low >> 5);
        let fifths = if bit(low, 5) { (t - 1) / 2 + QUARTER_TURN } else { QUARTER_TURN - t / 2 };
        let fifths = if fifths > HALF_TURN { fifths - 2 * HALF_TURN } else { fifths };
        let at = place(&self.spec, b)?;
        let twist_deg = twist(fifths);
        Some(RawPen { position: at.position, distance: at.distance, twist_deg, ..self.last_in_range() })
    }

    fn last_in_range(&self) -> RawPen {
        RawPen {
            in_range: true,
            eraser: self.eraser,
            serial: self.serial,
            pressure: self.last.pressure.or(Some(0.0)),
            ..self.last
        }
    }
}

impl OneEvent for Intuos {
    fn read(&mut self, b: Bytes<'_>) -> Option<HidEvent> {
        let id = b.u8(0)?;
        if TOOL.contains(&id) { self.tool(id, b) } else { keys(self.spec.family, id, b).map(HidEvent::Keys) }
    }
}

/// Position and height, which all packets have in the same places.
fn place(spec: &Spec, b: Bytes<'_>) -> Option<RawPen> {
    let [b2, b3, b4, b5] = [2, 3, 4, 5].map(|at| b.u8(at).map(u32::from));
    let low = b.u8(9)?;
    let x = b2? << 9 | b3? << 1 | u32::from(bit(low, 1));
    let y = b4? << 9 | b5? << 1 | u32::from(bit(low, 0));
    Some(RawPen { distance: f32::from(low >> 2) / HEIGHTS, ..spec.pen(x, y, 0_u32) })
}

/// Which keys are held; the button in the middle of a ring comes after them.
fn keys(family: Family, id: u8, b: Bytes<'_>) -> Option<u32> {
    let byte = |at: usize| b.u8(at).map(u32::from);
    Some(match (family, id) {
        (Family::WacomIntuosV1 | Family::WacomIntuos3, 0x03) => byte(4)?,
        (Family::WacomIntuosPro, 0x03) => byte(4)? | (byte(3)? & 1) << 8,
        (Family::WacomIntuos4, 0x0C) => byte(3)? | (byte(2)? & 1) << 8,
        (Family::WacomIntuos3, 0x0C) => byte(5)? & 0x0F | (byte(6)? & 0x0F) << 4,
        (Family::WacomIntuos3ExtraAux, 0x0C) => byte(5)? & 0x1F | (byte(6)? & 0x1F) << 5,
        // Left column, right column, both radial buttons, the keys on top.
        (Family::WacomCintiqV1, 0x0C) => {
            byte(6)? | byte(8)? << 8 | (byte(5)? & 1) << 16 | (byte(7)? & 1) << 17 | (byte(9)? & 7) << 18
        }
        _ => return None,
    })
}

#[cfg(test)]
#[path = "wacom_intuos_tests.rs"]
mod tests;
