//! What the families' tests share.
//!
//! The ranges are powers of two, so that shares in expectations are exact: x of 32768, y of 16384, pressure of 8192.

use super::{AWAY, Decode, Family, HidEvent, RawPen, Spec, check_event};

pub(super) fn spec(family: Family, report_length: usize) -> Spec {
    Spec {
        family,
        steps: [32768, 16384],
        pressure: 8192,
        touch: None,
        tilts: true,
        shifted: false,
        report_id: None,
        report_length,
    }
}

pub(super) fn events(decoder: &mut dyn Decode, report: &[u8]) -> Vec<HidEvent> {
    let mut all = Vec::new();
    decoder.decode(report, &mut |event| all.push(event));
    for event in &all {
        check_event(event).unwrap();
    }
    all
}

fn only(decoder: &mut dyn Decode, report: &[u8]) -> HidEvent {
    let all = events(decoder, report);
    assert_eq!(all.len(), 1, "{all:?} from {report:x?}");
    all[0]
}

pub(super) fn pen(decoder: &mut dyn Decode, report: &[u8]) -> RawPen {
    match only(decoder, report) {
        HidEvent::Pen(pen) => {
            assert!(pen.in_range, "out of range: {report:x?}");
            pen
        }
        other => panic!("{other:?} is no pen"),
    }
}

pub(super) fn is_wheel(event: &HidEvent) -> bool {
    matches!(event, HidEvent::Dial { .. } | HidEvent::Ring { .. } | HidEvent::Strip { .. })
}

/// The keys of a report; what wheels say beside them is their own.
pub(super) fn keys(decoder: &mut dyn Decode, report: &[u8]) -> u32 {
    let mut all = events(decoder, report);
    all.retain(|event| !is_wheel(event));
    match all[..] {
        [HidEvent::Keys(keys)] => keys,
        _ => panic!("{all:?} are no keys"),
    }
}

/// Nothing is said but by wheels.
pub(super) fn is_of_wheels(decoder: &mut dyn Decode, report: &[u8]) -> bool {
    events(decoder, report).iter().all(is_wheel)
}

pub(super) fn away(decoder: &mut dyn Decode, report: &[u8]) -> bool {
    only(decoder, report) == AWAY
}

pub(super) fn quiet(decoder: &mut dyn Decode, report: &[u8]) -> bool {
    events(decoder, report).is_empty()
}

/// Every beginning of the report that is shorter than what it needs says nothing; longer ones say what it says.
pub(super) fn silent_when_cut(spec: Spec, report: &[u8], needs: usize) {
    for length in 0..=report.len() {
        let said = events(&mut *spec.decoder(), &report[..length]);
        assert_eq!(said.is_empty(), length < needs, "{said:?} from {length} bytes of {report:x?}");
    }
}
