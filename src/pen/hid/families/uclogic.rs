//! UC-Logic and what grew from it: Huion, Gaomon, Artisul, Turcom, Monoprice and the older UGEE and XP-Pen.
//!
//! The second byte tells what a report is about. One deliberate choice: in the protocol that string 200 wakes, x and y
//! carry bits 16 to 23 in bytes 8 and 9, and y tilt points away from the artist on the wire. The Linux kernel's driver
//! treats all tablets of that protocol so, and so do we; per-model signs seen elsewhere contradict each other and wait
//! for hardware (`docs/tablets.md`).

use super::spec::tilt;
use super::{AWAY, Bytes, HidEvent, RawPen, Spec, barrel, bit};

/// Signs that turn raw tilt into ours; see above.
const TILT_SIGNS: [f32; 2] = [1.0, -1.0];
const KEYS: u8 = 0xE0;
/// Keys of the second group, on tablets with groups.
const GROUP_KEYS: u8 = 0xE3;

/// What the second byte says a report is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum About {
    Pen,
    Away,
    Keys,
    /// A dial, a ring, or something yet unknown.
    Other,
}

fn about(flags: u8) -> About {
    match flags {
        0x00 => About::Away,
        KEYS => About::Keys,
        _ if bit(flags, 6) && bit(flags, 5) => About::Other,
        // String 100's protocol: bit 6 is "in range" turned about.
        _ if bit(flags, 6) => About::Away,
        _ => About::Pen,
    }
}

/// The block that nearly all share: flags, x, y and pressure.
pub(super) fn plain_pen(spec: &Spec, b: Bytes<'_>) -> Option<RawPen> {
    let flags = b.u8(1)?;
    let pen = spec.pen(b.u16(2)?, b.u16(4)?, b.u16(6)?);
    Some(RawPen { touches: bit(flags, 0), barrel: barrel(flags, [1, 2, 3]), ..pen })
}

pub(super) fn keys(b: Bytes<'_>) -> Option<HidEvent> {
    b.twenty_keys(4).map(HidEvent::Keys)
}

fn leaning_pen(spec: &Spec, b: Bytes<'_>) -> Option<RawPen> {
    let (x, y) = (b.i8(10)?, b.i8(11)?);
    let tilt_deg = tilt(TILT_SIGNS[0] * f32::from(x), TILT_SIGNS[1] * f32::from(y));
    Some(RawPen { tilt_deg, ..plain_pen(spec, b)? })
}

/// Reads by the second byte; `pen` reads the report if it is about the pen.
fn sorted(spec: &Spec, b: Bytes<'_>, pen: fn(&Spec, Bytes<'_>) -> Option<RawPen>) -> Option<HidEvent> {
    if !spec.speaks(b) {
        return None;
    }
    match about(b.u8(1)?) {
        About::Pen => pen(spec, b).map(HidEvent::Pen),
        About::Away => Some(AWAY),
        About::Keys => keys(b),
        About::Other => None,
    }
}

/// Tablets woken by a string speak UC-Logic's own protocol; on others every report is about the pen.
pub(super) fn generic(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    match spec.report_id {
        Some(_) => sorted(spec, b, plain_pen),
        None => plain_pen(spec, b).map(HidEvent::Pen),
    }
}

pub(super) fn without_tilt(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    sorted(spec, b, plain_pen)
}

pub(super) fn with_tilt(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    sorted(spec, b, leaning_pen)
}

/// Here bit 6 says "in range" as it stands.
pub(super) fn v1(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    match b.u8(1)? {
        _ if !spec.speaks(b) => None,
        KEYS => keys(b),
        flags if bit(flags, 6) => plain_pen(spec, b).map(HidEvent::Pen),
        _ => Some(AWAY),
    }
}

pub(super) fn giano(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    sorted(spec, b, |spec, b| {
        let at = spec.pen(b.u16_and_above(2, 8)?, b.u16_and_above(4, 9)?, b.u16(6)?);
        Some(RawPen { position: at.position, ..leaning_pen(spec, b)? })
    })
}

pub(super) fn inspiroy(spec: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    match b.u8(1)? {
        _ if !spec.speaks(b) => None,
        GROUP_KEYS => keys(b),
        flags if flags != 0 && !bit(flags, 7) => None,
        _ => sorted(spec, b, leaning_pen),
    }
}

#[cfg(test)]
#[path = "uclogic_tests.rs"]
mod tests;
