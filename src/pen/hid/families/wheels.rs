//! Dials, rings and strips beside the pen and the keys.
//!
//! They stand in reports of their own, or among the keys, so they are read once more from every report of a family that has
//! them. A dial says how far it was turned, a ring or strip where the finger lies. Which way is clockwise, and which end of a
//! strip is its first, is as the Linux kernel's drivers have it; it is untried on hardware by us.

use super::{Bytes, Decode, Family, HidEvent, Spec, bit};

/// Second bytes of UC-Logic's reports about a ring and about a dial.
const RING: u8 = 0xF0;
const DIAL: u8 = 0xF1;
/// Second byte of XP-Pen's reports about keys, among which the dials stand.
const XP_PEN_KEYS: u8 = 0xF0;
/// Places of UC-Logic's and of Wacom's rings.
const UCLOGIC_PLACES: u8 = 12;
const WACOM_PLACES: u8 = 72;
/// Bits of a Wacom strip; the highest that is set says where the finger lies.
const STRIP_PLACES: u8 = 13;
/// Wheels of a tablet that one report tells of at most.
const WHEELS: usize = 2;

/// A family whose tablets may have dials, rings or strips.
pub(super) struct WithWheels {
    spec: Spec,
    inner: Box<dyn Decode>,
    /// Where fingers were on the rings or strips; reports about keys repeat it.
    places: [Option<u8>; WHEELS],
}

impl WithWheels {
    /// The same decoder, with wheels where the family has any.
    pub(super) fn around(inner: Box<dyn Decode>, spec: &Spec) -> Box<dyn Decode> {
        if reader(spec.family).is_some() {
            Box::new(Self { spec: *spec, inner, places: [None; WHEELS] })
        } else {
            inner
        }
    }
}

impl Decode for WithWheels {
    fn decode(&mut self, report: &[u8], sink: &mut dyn FnMut(HidEvent)) {
        self.inner.decode(report, sink);
        let b = Bytes(report);
        let read = reader(self.spec.family).filter(|_| self.spec.speaks(b));
        for event in read.map(|read| read(b)).into_iter().flatten().flatten() {
            if let HidEvent::Ring { number, place, .. } | HidEvent::Strip { number, place, .. } = event
                && let Some(before) = self.places.get_mut(usize::from(number))
                && std::mem::replace(before, place) == place
            {
                continue;
            }
            sink(event);
        }
    }
}

/// Reads what one report says of each wheel.
type Reader = fn(Bytes<'_>) -> [Option<HidEvent>; WHEELS];

/// What reads the wheels of a family.
fn reader(family: Family) -> Option<Reader> {
    Some(match family {
        Family::Uclogic
        | Family::UclogicTilt
        | Family::UclogicV2
        | Family::HuionGiano
        | Family::HuionInspiroy
        | Family::HuionTiltWheel => |b| [uclogic(b), None],
        Family::XpPen | Family::XpPenOffsetPressure => |b| [xp_pen(b), None],
        Family::Veikk | Family::VeikkTilt => |b| [veikk(b), None],
        Family::WacomIntuos3 | Family::WacomIntuos3ExtraAux | Family::WacomCintiqV1 => {
            |b| [wacom_strip(b, 0), wacom_strip(b, 1)]
        }
        Family::WacomIntuosPro => |b| [wacom_ring(b, 0x03, 2), None],
        Family::WacomIntuos4 => |b| [wacom_ring(b, 0x0C, 1), None],
        Family::WacomIntuosV2 => |b| [wacom_ring(b, 0x11, 4), None],
        Family::WacomIntuosV3 => |b| [wacom_dial(b, 0), wacom_dial(b, 1)],
        _ => return None,
    })
}

/// One notch one way or the other; nothing for a dial that rests.
fn dial(number: u8, code: u8) -> Option<HidEvent> {
    let notches = match code {
        1 => 1,
        2 => -1,
        _ => return None,
    };
    Some(HidEvent::Dial { number, notches })
}

fn uclogic(b: Bytes<'_>) -> Option<HidEvent> {
    match b.u8(1)? {
        RING => {
            let place = b.u8(5)?.checked_sub(1).filter(|place| *place < UCLOGIC_PLACES);
            Some(HidEvent::Ring { number: 0, place, places: UCLOGIC_PLACES })
        }
        DIAL => dial(b.u8(3)?.saturating_sub(1).min(1), b.u8(5)?),
        _ => None,
    }
}

fn xp_pen(b: Bytes<'_>) -> Option<HidEvent> {
    if b.u8(1)? != XP_PEN_KEYS {
        return None;
    }
    dial(0, b.u8(7)?).or_else(|| dial(1, b.u8(8)?))
}

fn veikk(b: Bytes<'_>) -> Option<HidEvent> {
    if b.u8(2)? != 3 || !bit(b.u8(3)?, 0) {
        return None;
    }
    let flags = b.u8(4)?;
    dial(
        0,
        if bit(flags, 1) {
            1
        } else if bit(flags, 0) {
            2
        } else {
            0
        },
    )
}

fn wacom_ring(b: Bytes<'_>, id: u8, at: usize) -> Option<HidEvent> {
    if b.u8(0)? != id {
        return None;
    }
    let byte = b.u8(at)?;
    let place = bit(byte, 7).then_some(byte & 0x7F).filter(|place| *place < WACOM_PLACES);
    Some(HidEvent::Ring { number: 0, place, places: WACOM_PLACES })
}

/// Strips behind or beside the screen: thirteen bits each, of which one is set, or two where the finger lies between.
fn wacom_strip(b: Bytes<'_>, number: u8) -> Option<HidEvent> {
    if b.u8(0)? != 0x0C {
        return None;
    }
    let at = 1 + 2 * usize::from(number);
    let bits = u16::from(b.u8(at)? & 0x1F) << 8 | u16::from(b.u8(at + 1)?);
    let place = bits.checked_ilog2().map(|place| place as u8);
    Some(HidEvent::Strip { number, place, places: STRIP_PLACES })
}

/// One of two dials with seven bits each, the sign among them.
fn wacom_dial(b: Bytes<'_>, number: u8) -> Option<HidEvent> {
    if b.u8(0)? != 0x11 {
        return None;
    }
    let notches = (b.u8(4 + usize::from(number))? << 1) as i8 >> 1;
    (notches != 0).then_some(HidEvent::Dial { number, notches })
}

#[cfg(test)]
mod tests {
    use super::super::testing::{events, is_wheel, spec};
    use super::*;

    fn wheels(family: Family, report: &[u8]) -> Vec<HidEvent> {
        let all = events(&mut *spec(family, report.len()).decoder(), report);
        all.into_iter().filter(is_wheel).collect()
    }

    fn ring(place: Option<u8>, places: u8) -> Vec<HidEvent> {
        vec![HidEvent::Ring { number: 0, place, places }]
    }

    fn dial(number: u8, notches: i8) -> Vec<HidEvent> {
        vec![HidEvent::Dial { number, notches }]
    }

    #[test]
    fn uc_logics_rings_and_dials_have_reports_of_their_own() {
        // id, ring, -, -, -, place from 1, 0 without a finger
        assert_eq!(wheels(Family::UclogicTilt, &[8, 0xF0, 1, 1, 0, 1, 0, 0, 0, 0, 0, 0]), ring(Some(0), 12));
        assert_eq!(
            wheels(Family::HuionTiltWheel, &[8, 0xF0, 1, 1, 0, 12, 0, 0, 0, 0, 0, 0]),
            ring(Some(11), 12)
        );
        // id, dial, -, its number, -, 1 or 2 for the way
        assert_eq!(wheels(Family::HuionGiano, &[8, 0xF1, 1, 1, 0, 1, 0, 0, 0, 0, 0, 0]), dial(0, 1));
        assert_eq!(wheels(Family::HuionGiano, &[8, 0xF1, 1, 2, 0, 2, 0, 0, 0, 0, 0, 0]), dial(1, -1));
        assert_eq!(wheels(Family::HuionGiano, &[8, 0xF1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0]), []);
    }

    #[test]
    fn dials_stand_among_the_keys() {
        // id, keys, three bytes of keys, -, -, dial, second dial
        assert_eq!(wheels(Family::XpPen, &[2, 0xF0, 0, 0, 0, 0, 0, 1, 0, 0]), dial(0, 1));
        assert_eq!(wheels(Family::XpPen, &[2, 0xF0, 0, 0, 0, 0, 0, 0, 2, 0]), dial(1, -1));
        assert_eq!(wheels(Family::XpPen, &[2, 0xA0, 0, 0, 0, 0, 0, 1, 0, 0]), [], "a pen");
        // id, channel, dial, turned, the way
        assert_eq!(wheels(Family::Veikk, &[9, 0x42, 3, 1, 2, 0, 0, 0, 0, 0, 0, 0, 0]), dial(0, 1));
        assert_eq!(wheels(Family::Veikk, &[9, 0x42, 3, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0]), dial(0, -1));
        // id, keys, -, keys, two dials of seven bits
        assert_eq!(wheels(Family::WacomIntuosV3, &[0x11, 0, 0, 0, 3, 0]), dial(0, 3));
        assert_eq!(wheels(Family::WacomIntuosV3, &[0x11, 0, 0, 0, 0, 0x7F]), dial(1, -1));
        assert_eq!(
            wheels(Family::WacomIntuosV3, &[0x11, 0, 0, 0, 3, 0x7F]),
            [dial(0, 3), dial(1, -1)].concat()
        );
    }

    #[test]
    fn wacoms_rings_have_72_places() {
        assert_eq!(wheels(Family::WacomIntuosV2, &[0x11, 0, 0, 0, 0x80 | 71]), ring(Some(71), 72));
        let mut decoder = spec(Family::WacomIntuosV2, 192).decoder();
        let mut rings = |byte| events(&mut *decoder, &[0x11, 1, 0, 0, byte]).len() - 1;
        assert_eq!([0x85, 0x85, 0x86, 6, 6].map(&mut rings), [1, 0, 1, 1, 0], "it is said when it changes");
        assert_eq!(wheels(Family::WacomIntuosPro, &[3, 0, 0x85, 0, 0, 0, 0, 0, 0, 0]), ring(Some(5), 72));
        assert_eq!(wheels(Family::WacomIntuos4, &[0x0C, 0x80, 0, 0, 0, 0, 0, 0, 0, 0]), ring(Some(0), 72));
        assert_eq!(wheels(Family::WacomIntuos4, &[2, 0x80, 0, 0, 0, 0, 0, 0, 0, 0]), [], "a pen");
    }

    #[test]
    fn wacoms_strips_set_a_bit_where_the_finger_lies() {
        let strip = |number, place| HidEvent::Strip { number, place, places: 13 };
        for family in [Family::WacomIntuos3, Family::WacomIntuos3ExtraAux, Family::WacomCintiqV1] {
            let mut decoder = spec(family, 10).decoder();
            // id, 13 bits of the left strip, 13 of the right, keys
            let mut strips = |bytes: [u8; 4]| {
                let [a, b, c, d] = bytes;
                let mut said = events(&mut *decoder, &[0x0C, a, b, c, d, 0, 0, 0, 0, 0]);
                said.retain(is_wheel);
                said
            };
            assert_eq!(strips([0, 0, 0, 0]), [], "no finger before, none now");
            assert_eq!(strips([0, 1, 0x10, 0]), [strip(0, Some(0)), strip(1, Some(12))]);
            assert_eq!(strips([0, 0x03, 0x10, 0]), [strip(0, Some(1))], "between two bits");
            assert_eq!(
                strips([0xE0, 0, 0xE0, 0]),
                [strip(0, None), strip(1, None)],
                "bits beside the strips"
            );
            let pen = [2, 0xE0, 1, 0, 1, 0, 0, 0, 0, 0];
            assert!(!events(&mut *decoder, &pen).iter().any(is_wheel));
        }
    }
}
