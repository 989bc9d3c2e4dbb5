//! Any bytes given to any family of tablet reports end in events that keep their promises, or in none.
//!
//! The first bytes choose family, ranges and options; then come reports, each after its length.

use penstemon::pen::hid::families::{Family, Spec, check_event};

/// Fails where what the head of this file says does not hold of these bytes.
pub fn check(bytes: &[u8]) {
    let Some((head, mut reports)) = bytes.split_first_chunk::<8>() else { return };
    let [family, options, report_id, length, x, y, pressure, touch] = *head;
    let option = |bit: u8| options >> bit & 1 == 1;
    let spec = Spec {
        family: Family::ALL[usize::from(family) % Family::ALL.len()],
        steps: [u32::from(x) << 9, u32::from(y) << 9],
        pressure: u32::from(pressure) << 6,
        touch: option(0).then_some([u32::from(touch) << 5; 2]),
        tilts: option(1),
        shifted: option(2),
        report_id: option(3).then_some(report_id),
        report_length: length.into(),
    };
    let mut decoder = spec.decoder();
    while let Some((&length, rest)) = reports.split_first() {
        let (report, rest) = rest.split_at(usize::from(length).min(rest.len()));
        decoder.decode(report, &mut |event| check_event(&event).unwrap());
        reports = rest;
    }
}
