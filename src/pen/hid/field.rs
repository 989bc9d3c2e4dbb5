//! Fields of a report: where their bits lie and what their numbers mean.
//!
//! Everything is worked out when the descriptor is read; taking a value out of a report is a load, a shift and a mask.
//! Bits are counted as HID counts them: from the lowest bit of the first byte (HID 1.11, section 5.6 and 5.8).

use glam::DVec2;
use hidreport::{FieldAttributes as _, VariableField};
use std::ops::Range;

/// Centimetres and inches in millimetres.
const MM_PER_CM: f64 = 10.0;
const MM_PER_INCH: f64 = 25.4;
/// Sides of a tablet's area; a descriptor that says anything else is wrong about its units.
const AREA_MM: Range<f64> = 20.0..3000.0;
/// How far the fineness of two axes that are equally fine may lie apart, as a share.
const ALIKE: f64 = 0.01;
/// Greatest lean that any pen reports, and the least that is worth reporting.
const TILT_DEG: Range<f64> = 9.0..90.0;

/// Where the bits of a field lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Bits {
    byte: usize,
    bytes: usize,
    shift: u32,
    mask: u64,
    /// The sign bit of a signed field, otherwise 0.
    sign: u64,
}

impl Bits {
    /// `bits` counts from the report id, which every report begins with here.
    pub(super) fn new(bits: &Range<usize>, is_signed: bool) -> Option<Self> {
        let width = u32::try_from(bits.len()).ok().filter(|width| (1..=64).contains(width))?;
        let (byte, shift) = (bits.start / 8, (bits.start % 8) as u32);
        if width + shift > 64 {
            return None;
        }
        let sign = if is_signed { 1 << (width - 1) } else { 0 };
        Some(Self {
            byte,
            bytes: (width + shift).div_ceil(8) as usize,
            shift,
            mask: u64::MAX >> (64 - width),
            sign,
        })
    }

    /// Bytes that a report must have to hold the field.
    pub(super) fn end(&self) -> usize {
        self.byte + self.bytes
    }

    /// The bits as they are; 0 beyond the report's end.
    pub(super) fn raw(&self, report: &[u8]) -> u64 {
        let bytes = report.get(self.byte..self.end()).unwrap_or_default();
        let value = bytes.iter().rev().fold(0u64, |value, byte| value << 8 | u64::from(*byte));
        value >> self.shift & self.mask
    }

    /// The number.
    pub(super) fn number(&self, report: &[u8]) -> i64 {
        let raw = self.raw(report);
        // Two's complement: the sign bit counts negative.
        (raw ^ self.sign).wrapping_sub(self.sign) as i64
    }

    pub(super) fn is_set(&self, report: &[u8]) -> bool {
        self.raw(report) != 0
    }
}

/// A field that stands for a share of its range.
#[derive(Clone, Copy, Debug)]
pub(super) struct Share {
    pub(super) bits: Bits,
    pub(super) low: i64,
    pub(super) high: i64,
    /// A number out of range says that there is no value.
    has_null: bool,
}

impl Share {
    pub(super) fn new(field: &VariableField) -> Option<Self> {
        let (low, high) = logical(field);
        let bits = Bits::new(&field.bits, low < 0)?;
        (low < high).then_some(Self { bits, low, high, has_null: field.has_null_state() })
    }

    /// The value as a share, 0 to 1; numbers out of range count as the nearest in range.
    pub(super) fn of(&self, report: &[u8]) -> f64 {
        let number = self.bits.number(report).clamp(self.low, self.high);
        (number - self.low) as f64 / (self.high - self.low) as f64
    }

    /// Whether the device says that there is no value.
    pub(super) fn is_null(&self, report: &[u8]) -> bool {
        self.has_null && !(self.low..=self.high).contains(&self.bits.number(report))
    }
}

/// A field that stands for an angle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Angle {
    share: Share,
    low_deg: f64,
    span_deg: f64,
}

impl Angle {
    /// A lean. Where the unit is no angle, as in a good part of descriptors, the numbers themselves are degrees; where the
    /// power of ten is evidently wrong, it is mended.
    pub(super) fn tilt(field: &VariableField) -> Option<Self> {
        let angle = Self::turn(field)?;
        let most = angle.low_deg.abs().max((angle.low_deg + angle.span_deg).abs());
        let is_angle = unit_deg(field).is_some();
        // Numbers of one byte without a unit go beyond what pens lean; the decoder clamps them.
        if !is_angle && most <= 128.0 {
            return Some(angle);
        }
        let mut scale = 1.0;
        while most * scale > TILT_DEG.end {
            scale /= 10.0;
        }
        while most * scale <= TILT_DEG.start && most > 0.0 {
            scale *= 10.0;
        }
        Some(Self { low_deg: angle.low_deg * scale, span_deg: angle.span_deg * scale, ..angle })
    }

    /// A turn about the pen's axis.
    pub(super) fn turn(field: &VariableField) -> Option<Self> {
        let share = Share::new(field)?;
        let (low, high) = match (unit_deg(field), physical(field)) {
            (Some(unit), Some((low, high))) => (low * unit, high * unit),
            (Some(unit), None) => (share.low as f64 * unit, share.high as f64 * unit),
            (None, _) => (share.low as f64, share.high as f64),
        };
        Some(Self { share, low_deg: low, span_deg: high - low })
    }

    pub(super) fn bits(&self) -> Bits {
        self.share.bits
    }

    pub(super) fn degrees(&self, report: &[u8]) -> f64 {
        if self.share.is_null(report) { 0.0 } else { self.low_deg + self.span_deg * self.share.of(report) }
    }
}

/// Least and greatest number of a field.
fn logical(field: &VariableField) -> (i64, i64) {
    let (low, high) = (i32::from(field.logical_minimum), i32::from(field.logical_maximum));
    // A maximum of 32 bits is unsigned where the minimum is not negative.
    let high = if low >= 0 { i64::from(high as u32) } else { i64::from(high) };
    (i64::from(low), high)
}

/// Least and greatest physical value; `None` where the descriptor leaves them to the logical ones.
fn physical(field: &VariableField) -> Option<(f64, f64)> {
    let low = f64::from(i32::from(field.physical_minimum?));
    let high = f64::from(i32::from(field.physical_maximum?));
    (low < high).then_some((low, high))
}

/// System and length of a unit: its two lowest nibbles.
fn unit_nibbles(field: &VariableField) -> (u32, u32) {
    let unit = field.unit.map_or(0, u32::from);
    (unit & 0xF, unit >> 4 & 0xF)
}

fn power_of_ten(field: &VariableField) -> f64 {
    10f64.powi(field.unit_exponent.map_or(0, |exponent| i32::from(exponent.exponent())))
}

/// Degrees of one physical step; `None` where the unit is no angle.
fn unit_deg(field: &VariableField) -> Option<f64> {
    let unit = match unit_nibbles(field) {
        (2, 1) => 1f64.to_degrees(),
        (4, 1) => 1.0,
        _ => return None,
    };
    Some(unit * power_of_ten(field))
}

/// Length of a position field's range in millimetres, and whether its unit is a length: makers also write areas and
/// volumes of centimetres and inches there.
fn length_mm(field: &VariableField) -> Option<(f64, bool)> {
    let (unit, power) = match unit_nibbles(field) {
        (1, power @ 1..) => (MM_PER_CM, power),
        (3, power @ 1..) => (MM_PER_INCH, power),
        _ => return None,
    };
    let (low, high) = physical(field)?;
    Some(((high - low) * unit * power_of_ten(field), power == 1))
}

/// Width and height of a tablet's area in millimetres, where the descriptor says them and they can be true.
///
/// A unit that is no length is taken for one only where the numbers bear it out: both axes as fine as each other, of
/// different lengths, and not just the steps written once more. Many tablets have the same made-up square under such a unit.
pub(super) fn area_mm(x: &VariableField, y: &VariableField) -> Option<DVec2> {
    let ((width, width_is_length), (height, height_is_length)) = length_mm(x).zip(length_mm(y))?;
    let steps = [x, y].map(|field| {
        let (low, high) = logical(field);
        (high - low) as f64
    });
    let bear_out = || {
        let fineness = [steps[0] / width, steps[1] / height];
        let are_alike = (fineness[0] - fineness[1]).abs() <= ALIKE * fineness[0].max(fineness[1]);
        let are_steps = physical(x).is_some_and(|(low, high)| high - low == steps[0]);
        are_alike && steps[0] != steps[1] && !are_steps
    };
    let is_meant = (width_is_length && height_is_length) || bear_out();
    let area = DVec2::new(width, height);
    (is_meant && area.to_array().iter().all(|side| AREA_MM.contains(side))).then_some(area)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_taken_from_the_lowest_up() {
        let report = [0x01, 0b1010_0101, 0xFF, 0x7F];
        let raw = |bits: Range<usize>| Bits::new(&bits, false).unwrap().raw(&report);
        assert_eq!([raw(8..9), raw(9..10), raw(13..14), raw(12..20)], [1, 0, 1, 0xFA]);
        assert_eq!(Bits::new(&(16..32), true).unwrap().number(&report), 0x7FFF);
        assert_eq!(Bits::new(&(16..24), true).unwrap().number(&report), -1);
        assert_eq!(Bits::new(&(20..24), true).unwrap().number(&report), -1);
        assert_eq!(Bits::new(&(24..40), false).unwrap().raw(&report), 0, "beyond the end");
        assert!(Bits::new(&(1..66), false).is_none());
        assert_eq!(Bits::new(&(0..32), false).unwrap().number(&report), 0x7FFF_A501);
    }
}
