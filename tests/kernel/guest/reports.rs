//! What the virtual tablets send, and the same again from what the library reads: nothing may differ.

use crate::tablets::{DisplayReport, switch};
use penstemon::pen::hid::RawPen;

/// A number that a pen should have said as a share of `steps`.
fn steps(share: f64, steps: f64) -> i64 {
    (share * steps).round() as i64
}

/// A report of the pen display: every field changes from report to report.
pub(crate) fn display_report(number: u32) -> DisplayReport {
    let n = number as u16;
    let barrel = [switch::BARREL, switch::SECOND_BARREL, 0][number as usize % 3];
    let end = [switch::TIP, switch::INVERT | switch::ERASER, 0, switch::INVERT][number as usize / 7 % 4];
    DisplayReport {
        switches: switch::IN_RANGE | barrel | end,
        x: n * 32,
        y: 32768 - n * 31,
        pressure: n * 4,
        tilt: [n as i16 * 18 - 9000, 9000 - n as i16 * 17],
        twist: n * 35,
        battery: 50,
        serial: 0xA000_0000 + number,
    }
}

/// What a report of the pen display was read as, in the report's own steps.
pub(crate) fn display_said(pen: &RawPen) -> DisplayReport {
    let set = |is_set: bool, bits: u8| if is_set { bits } else { 0 };
    let end = match (pen.eraser, pen.touches) {
        (false, touches) => set(touches, switch::TIP),
        (true, touches) => switch::INVERT | set(touches, switch::ERASER),
    };
    let barrel = set(pen.barrel[0], switch::BARREL) | set(pen.barrel[1], switch::SECOND_BARREL);
    DisplayReport {
        switches: set(pen.in_range, switch::IN_RANGE) | barrel | end,
        x: steps(pen.position.x, 32768.0) as u16,
        y: steps(pen.position.y, 32768.0) as u16,
        pressure: steps(pen.pressure.unwrap_or(-1.0).into(), 4095.0) as u16,
        tilt: [pen.tilt_deg.x, pen.tilt_deg.y].map(|degrees| steps(degrees.into(), 100.0) as i16),
        twist: steps(pen.twist_deg.into(), 100.0) as u16,
        battery: 50,
        serial: pen.serial as u32,
    }
}

/// A report of the desk tablet, without report ids: switches, x, y, pressure, tilt.
pub(crate) fn desk_report(number: u32) -> Vec<u8> {
    let n = number as u16;
    let mut bytes = vec![0b1000_0001];
    [n * 50, n * 31, n * 8].iter().for_each(|value| bytes.extend(value.to_le_bytes()));
    bytes.extend([(n % 121) as i8 - 60, 60 - (n % 121) as i8].map(|degrees| degrees as u8));
    bytes
}

/// What a report of the desk tablet was read as.
pub(crate) fn desk_said(pen: &RawPen) -> Vec<u8> {
    let mut bytes = vec![u8::from(pen.touches) | u8::from(pen.in_range) << 7];
    let shares =
        [(pen.position.x, 50800.0), (pen.position.y, 31750.0), (pen.pressure.unwrap_or(-1.0).into(), 8191.0)];
    shares.iter().for_each(|(share, most)| bytes.extend((steps(*share, *most) as u16).to_le_bytes()));
    bytes.extend([pen.tilt_deg.x, pen.tilt_deg.y].map(|degrees| degrees.round() as i8 as u8));
    bytes
}

/// A node of the maker's own page: report 2 with 9 bytes of input and 7 of output besides its id.
pub(crate) const VENDOR_PAGE: &[u8] = &[
    0x06, 0x0A, 0xFF, 0x09, 0x01, 0xA1, 0x01, 0x85, 0x02, 0x15, 0x00, 0x26, 0xFF, 0x00, 0x75, 0x08, 0x09,
    0x01, 0x95, 0x09, 0x81, 0x02, 0x09, 0x01, 0x95, 0x07, 0x91, 0x02, 0xC0,
];

/// Adesso's Cybertablet K8, awake: report id, switches, x to 20320, y to 11430, pressure to 8191, tilt.
pub(crate) fn k8_report(number: u32) -> Vec<u8> {
    let n = number as u16;
    let tilt = (n % 121) as i8 - 60;
    let mut bytes = vec![2, 0xA0 | u8::from(!n.is_multiple_of(10))];
    [n * 20, n * 11, n * 8].iter().for_each(|value| bytes.extend(value.to_le_bytes()));
    bytes.extend([tilt as u8, -tilt as u8]);
    bytes
}

/// What a report of the K8 was read as.
pub(crate) fn k8_said(pen: &RawPen) -> Vec<u8> {
    let mut bytes = vec![2, if pen.in_range { 0xA0 } else { 0 } | u8::from(pen.touches)];
    let shares =
        [(pen.position.x, 20320.0), (pen.position.y, 11430.0), (pen.pressure.unwrap_or(-1.0).into(), 8191.0)];
    shares.iter().for_each(|(share, most)| bytes.extend((steps(*share, *most) as u16).to_le_bytes()));
    bytes.extend([pen.tilt_deg.x, pen.tilt_deg.y].map(|degrees| degrees.round() as i8 as u8));
    bytes
}
