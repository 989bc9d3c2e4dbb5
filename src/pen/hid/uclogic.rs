//! What tablets of UC-Logic's two protocols say of themselves: Huion, Gaomon, UGEE, XP-Pen's older ones and many more.
//!
//! Reading USB string 200 wakes them into the second protocol, string 100 into the first, and the answer holds the ranges of
//! the pen: greatest x and y, greatest pressure and lines an inch, little-endian behind the descriptor's two bytes.
//!
//! | string | x | y | pressure | lines an inch | report |
//! | --- | --- | --- | --- | --- | --- |
//! | 100 | bytes 2, 3 | 4, 5 | 8, 9 | 10, 11 | 7 |
//! | 200 | bytes 2 to 4 | 5 to 7 | 8, 9 | 10, 11 | 8 |
//!
//! Firmwares that know no such string answer with text, which is told by numbers that no tablet has. The report descriptor
//! of the first protocol is true but for two things, which is why it is recognised and not followed: the bit "in range" is
//! turned about, and the bit called "eraser" is the upper button. Source: facts from the Linux kernel's hid-uclogic.

use super::descriptor::DescriptorDecoder;
use super::families::{Family, Spec};
use super::field::Bits;
use crate::pen::machine::Silence;
use glam::DVec2;
use std::ops::RangeInclusive;

/// Millimetres in an inch.
const MM_PER_INCH: f64 = 25.4;
/// Greatest coordinate, greatest pressure and lines an inch that a pen tablet can have.
const STEPS: RangeInclusive<u32> = 1_000..=1_000_000;
const PRESSURE: RangeInclusive<u32> = 255..=65_535;
const LINES: RangeInclusive<u32> = 500..=20_000;

/// One of the two protocols.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Protocol {
    /// Coordinates of 16 bits, no tilt.
    First,
    /// Coordinates of 24 bits, tilt; the pen leaves by falling silent.
    Second,
}

impl Protocol {
    /// The newer first.
    pub const ALL: [Self; 2] = [Self::Second, Self::First];

    /// The USB string whose reading wakes a tablet into it.
    pub fn string(self) -> u8 {
        match self {
            Self::First => 100,
            Self::Second => 200,
        }
    }

    /// The report that the pen then sends.
    pub fn report_id(self) -> u8 {
        match self {
            Self::First => 7,
            Self::Second => 8,
        }
    }

    /// The silence that says that the pen left.
    pub fn silence(self) -> Option<Silence> {
        (self == Self::Second).then_some(Silence::KNOWN)
    }
}

/// The ranges of a pen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ranges {
    /// Greatest raw x and y.
    pub steps: [u32; 2],
    /// Greatest raw pressure.
    pub pressure: u32,
    /// Width and height of the active area in millimetres, where the tablet says how fine it is.
    pub area_mm: Option<DVec2>,
}

impl Ranges {
    /// Reads the answer to a protocol's string; `None` where it is cut short or holds something else.
    pub fn read(protocol: Protocol, descriptor: &[u8]) -> Option<Self> {
        let number = |at: usize, bytes: usize| {
            let number = descriptor.get(at..at + bytes)?;
            Some(number.iter().rev().fold(0, |number, byte| number << 8 | u32::from(*byte)))
        };
        let steps = match protocol {
            Protocol::First => [number(2, 2)?, number(4, 2)?],
            Protocol::Second => [number(2, 3)?, number(5, 3)?],
        };
        let (pressure, lines) = (number(8, 2)?, number(10, 2)?);
        let is_sound = steps.iter().all(|most| STEPS.contains(most)) && PRESSURE.contains(&pressure);
        let area_mm = LINES
            .contains(&lines)
            .then(|| DVec2::from(steps.map(f64::from)) * MM_PER_INCH / f64::from(lines));
        is_sound.then_some(Self { steps, pressure, area_mm })
    }

    /// What decoding the pen's reports in this protocol needs.
    pub fn spec(&self, protocol: Protocol, report_length: usize) -> Spec {
        Spec {
            family: match protocol {
                Protocol::First => Family::Uclogic,
                Protocol::Second => Family::HuionGiano,
            },
            steps: self.steps,
            pressure: self.pressure,
            touch: None,
            tilts: protocol == Protocol::Second,
            shifted: false,
            report_id: Some(protocol.report_id()),
            report_length,
        }
    }
}

/// The ranges that a descriptor gives for the first protocol's report; `None` for a descriptor that has none, among them
/// those that the Linux kernel's driver puts in its place, which has no eraser.
pub(super) fn declared(decoder: &DescriptorDecoder) -> Option<Ranges> {
    let pen = decoder.pen_of(Protocol::First.report_id())?;
    let is_at = |bits: Option<Bits>, range| bits == Bits::new(&range, false);
    let pressure = pen.pressure?;
    let is_known = is_at(Some(pen.tip), 8..9)
        && is_at(pen.barrel[0], 9..10)
        && is_at(pen.eraser, 10..11)
        && is_at(pen.in_range, 14..15)
        && is_at(Some(pen.x.bits), 16..32)
        && is_at(Some(pen.y.bits), 32..48)
        && is_at(Some(pressure.bits), 48..64);
    let most = |high: i64| u32::try_from(high).ok();
    let steps = [most(pen.x.high)?, most(pen.y.high)?];
    is_known.then_some(Ranges { steps, pressure: most(pressure.high)?, area_mm: pen.area_mm })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pen::hid::strings::descriptor;

    /// An answer, and the steps, pressure and area that it tells.
    type Known = (&'static [u8], [u32; 2], u32, [f64; 2]);

    /// Answers of real tablets: UGEE M708, Huion H58L, XP-Pen Artist 15.6 Pro; Huion WH1409, New 1060 Plus.
    const FIRST: [Known; 3] = [
        (
            &[0x0E, 3, 0x40, 0x9C, 0xC0, 0x5D, 3, 0, 0xFF, 7, 0xA0, 0x0F, 8, 0],
            [40_000, 24_000],
            2047,
            [254.0, 152.4],
        ),
        (
            &[0x12, 3, 0, 0x7D, 0x20, 0x4E, 3, 0, 0xFF, 7, 0xA0, 0x0F, 8, 0],
            [32_000, 20_000],
            2047,
            [203.2, 127.0],
        ),
        (
            &[0x0C, 3, 0x73, 0x86, 5, 0x4C, 8, 0, 0xFF, 0x1F, 0xEC, 9],
            [34_419, 19_461],
            8191,
            [344.19, 194.61],
        ),
    ];
    const SECOND: [Known; 2] = [
        (
            &[0x12, 3, 0xA0, 0xD7, 0, 0xC4, 0x86, 0, 0xFF, 7, 0xA0, 0x0F],
            [55_200, 34_500],
            2047,
            [350.52, 219.075],
        ),
        (
            &[0x12, 3, 0x70, 0xC6, 0, 6, 0x7C, 0, 0xFF, 0x1F, 0xD8, 0x13],
            [50_800, 31_750],
            8191,
            [254.0, 158.75],
        ),
    ];

    #[test]
    fn answers_of_real_tablets_are_understood() {
        let known = FIRST.map(|known| (Protocol::First, known)).into_iter();
        for (protocol, (answer, steps, pressure, area)) in
            known.chain(SECOND.map(|known| (Protocol::Second, known)))
        {
            let ranges = Ranges::read(protocol, answer).unwrap();
            assert_eq!((ranges.steps, ranges.pressure), (steps, pressure));
            assert!(ranges.area_mm.unwrap().abs_diff_eq(DVec2::from(area), 1e-9), "{ranges:?}");
            assert_eq!(ranges.spec(protocol, 12).report_id, Some(protocol.report_id()));
        }
    }

    #[test]
    fn text_and_cut_answers_are_no_ranges() {
        for protocol in Protocol::ALL {
            for text in ["V2.0 20170423", "HK On", "", "HUION Animation Technology Co.,ltd"] {
                assert_eq!(Ranges::read(protocol, &descriptor(text)), None, "{text}");
            }
            let whole = SECOND[1].0;
            assert!((0..12).all(|length| Ranges::read(protocol, &whole[..length]).is_none()));
        }
        let unknown_fineness = [0x12, 3, 0x70, 0xC6, 0, 6, 0x7C, 0, 0xFF, 0x1F, 0, 0];
        assert_eq!(Ranges::read(Protocol::Second, &unknown_fineness).unwrap().area_mm, None);
    }
}
