//! Where the keys, rings and strips of a tablet lie in a report, on Wacom's page FF0D.
//!
//! Tablets that describe themselves send them in reports of their own beside those of the pen, or from a node that has no
//! pen at all. A ring says a place among as many as its range has; whether a finger is there says a field beside it or,
//! without one, a number out of range. A strip says one bit for its place, none without a finger.
//!
//! Sources: the usages in `drivers/hid/wacom_wac.h` of Linux; the bits of strips as libinput reads them
//! (`evdev-tablet-pad.c`). Keys that makers put on other pages are not known.

use super::HidEvent;
use super::field::{Bits, Share};

/// Most rings and strips that are told apart.
const MAX_WHEELS: usize = 4;

/// What a field of a pad is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PadRole {
    Key(u16),
    Strip,
    Ring,
    RingTouched,
}

/// Wacom's page.
const PAGE: u32 = 0xFF0D;
/// First and last of Wacom's keys.
const KEYS: std::ops::Range<u16> = 0x910..0x930;

/// What a usage means on a pad, if anything.
pub(super) fn role(usage: u32) -> Option<PadRole> {
    let id = (usage & 0xFFFF) as u16;
    if usage >> 16 != PAGE {
        return None;
    }
    match id {
        0x136 | 0x137 => Some(PadRole::Strip),
        0x138 => Some(PadRole::Ring),
        0x139 => Some(PadRole::RingTouched),
        _ => KEYS.contains(&id).then(|| PadRole::Key(id - KEYS.start)),
    }
}

/// A ring or a strip.
#[derive(Clone, Copy, Debug)]
enum Wheel {
    Ring { place: Share, touched: Option<Bits> },
    Strip { place: Share },
}

/// Everything that a report says of keys, rings and strips.
#[derive(Clone, Debug, Default)]
pub(super) struct PadFields {
    keys: Vec<(u16, Bits)>,
    /// Each with its number among those of its kind.
    wheels: Vec<(u8, Wheel)>,
}

impl PadFields {
    /// Those of a report with these fields, in its order: their roles, their places, and which shares they are.
    pub(super) fn of(fields: &[(PadRole, Bits, Option<Share>)]) -> Self {
        let all = |role: PadRole| fields.iter().filter(move |field| field.0 == role);
        let keys = fields.iter().filter_map(|(role, bits, _)| match role {
            PadRole::Key(number) => Some((*number, *bits)),
            _ => None,
        });
        let mut touched = all(PadRole::RingTouched).map(|(_, bits, _)| *bits);
        let rings = all(PadRole::Ring).filter_map(|(_, _, share)| *share);
        let rings = rings.map(|place| Wheel::Ring { place, touched: touched.next() });
        let strips = all(PadRole::Strip).filter_map(|(_, _, share)| *share);
        let strips = strips.map(|place| Wheel::Strip { place });
        let numbered = |wheels: &mut dyn Iterator<Item = Wheel>| {
            (0u8..).zip(wheels.take(MAX_WHEELS)).collect::<Vec<(u8, Wheel)>>()
        };
        let (mut rings, strips) = (numbered(&mut rings.into_iter()), numbered(&mut strips.into_iter()));
        rings.extend(strips);
        Self { keys: keys.collect(), wheels: rings }
    }

    /// Whether there is nothing of a pad.
    pub(super) fn is_empty(&self) -> bool {
        self.keys.is_empty() && self.wheels.is_empty()
    }

    /// Bytes that a report needs to hold all of it.
    pub(super) fn end(&self) -> usize {
        let of_wheel = |wheel: &Wheel| match wheel {
            Wheel::Ring { place, touched } => place.bits.end().max(touched.map_or(0, |bits| bits.end())),
            Wheel::Strip { place } => place.bits.end(),
        };
        let keys = self.keys.iter().map(|(_, bits)| bits.end());
        keys.chain(self.wheels.iter().map(|(_, wheel)| of_wheel(wheel))).max().unwrap_or(0)
    }

    /// Says what a report says; keys only when others are held than `held` says.
    pub(super) fn decode(&self, report: &[u8], held: &mut u32, sink: &mut dyn FnMut(HidEvent)) {
        if !self.keys.is_empty() {
            let pressed = self.keys.iter().filter(|(_, bits)| bits.is_set(report));
            let keys =
                pressed.fold(0, |keys, (number, _)| keys | 1u32.checked_shl((*number).into()).unwrap_or(0));
            if std::mem::replace(held, keys) != keys {
                sink(HidEvent::Keys(keys));
            }
        }
        for (number, wheel) in &self.wheels {
            sink(wheel.event(*number, report));
        }
    }
}

impl Wheel {
    fn event(&self, number: u8, report: &[u8]) -> HidEvent {
        match self {
            Self::Ring { place, touched } => {
                let is_touched = touched.is_none_or(|bits| bits.is_set(report)) && !place.is_null(report);
                let places = u8::try_from(place.high - place.low + 1).unwrap_or(u8::MAX);
                let at = (place.of(report) * f64::from(places - 1)).round() as u8;
                HidEvent::Ring { number, place: is_touched.then_some(at), places }
            }
            Self::Strip { place } => {
                let bit = |number: i64| u64::try_from(number).ok()?.checked_ilog2().map(|bit| bit as u8);
                let places = bit(place.high).unwrap_or(0) + 1;
                let at = bit(place.bits.number(report)).filter(|at| *at < places);
                HidEvent::Strip { number, place: at, places }
            }
        }
    }
}
