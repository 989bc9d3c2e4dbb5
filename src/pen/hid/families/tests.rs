//! What holds for every family: no report, however odd, panics or breaks the promises of the events.

use super::testing::{away, events, pen, quiet, spec};
use super::*;
use proptest::prelude::*;

fn any_spec() -> impl Strategy<Value = Spec> {
    let range = prop_oneof![Just(0_u32), 1_u32..100_000, Just(u32::MAX)];
    let ranges = (range.clone(), range.clone(), range, proptest::option::of(any::<[u32; 2]>()));
    let id = proptest::option::of(any::<u8>());
    let flags = (any::<bool>(), any::<bool>(), prop_oneof![Just(8_usize), Just(10), Just(12), Just(361)]);
    (prop::sample::select(&Family::ALL[..]), ranges, id, flags).prop_map(
        |(family, (x, y, pressure, touch), report_id, (tilts, shifted, report_length))| Spec {
            family,
            steps: [x, y],
            pressure,
            touch,
            tilts,
            shifted,
            report_id,
            report_length,
        },
    )
}

/// Bytes that look like reports: ids and flags that families use, then anything.
fn any_report() -> impl Strategy<Value = Vec<u8>> {
    let ids =
        prop::sample::select(&[0_u8, 1, 2, 3, 5, 7, 8, 9, 0x0C, 0x10, 0x11, 0x1E, 0x1F, 0x21, 0x80][..]);
    let flags = prop::sample::select(
        &[0_u8, 1, 0x41, 0x42, 0x80, 0x81, 0xA0, 0xA1, 0xC0, 0xC2, 0xE0, 0xE1, 0xEA, 0xF0, 0xF1][..],
    );
    let head = (prop_oneof![ids, any::<u8>()], prop_oneof![flags, any::<u8>()]);
    (head, prop::collection::vec(any::<u8>(), 0..130)).prop_map(|((id, flags), rest)| {
        let mut report = vec![id, flags];
        report.extend(rest);
        report
    })
}

proptest! {
    #[test]
    fn whatever_comes_events_keep_their_promises(
        spec in any_spec(),
        reports in prop::collection::vec(any_report(), 1..40),
        cut in 0_usize..140,
    ) {
        let mut decoder = spec.decoder();
        for report in &reports {
            for report in [&report[..], &report[..cut.min(report.len())]] {
                decoder.decode(report, &mut |event| check_event(&event).unwrap());
            }
        }
    }
}

#[test]
fn every_family_has_a_decoder_and_a_name_of_its_own() {
    let names: std::collections::BTreeSet<String> =
        Family::ALL.iter().map(|f| serde_json::to_string(f).unwrap()).collect();
    assert_eq!(names.len(), Family::ALL.len());
    assert!(names.contains("\"wacom-64b-aux\"") && names.contains("\"uclogic-tilt\""));
    for family in Family::ALL {
        assert!(quiet(&mut *spec(family, 12).decoder(), &[]), "{family:?} speaks without a report");
    }
}

#[test]
fn a_shifted_node_reads_the_same_one_byte_later() {
    let shifted = Spec { shifted: true, ..spec(Family::WacomIntuos, 10) };
    // Something, then id, flags (near, in range, tip), x 8192, y 4096, pressure 4096, height 31 − 15
    let seen = pen(&mut *shifted.decoder(), &[0xFF, 2, 0xE1, 0x00, 0x20, 0x00, 0x10, 0x00, 0x10, 15]);
    assert_eq!((seen.position.x, seen.position.y, seen.pressure), (0.25, 0.25, Some(0.5)));
    assert!(away(&mut *shifted.decoder(), &[0xFF, 2, 0x80, 0, 0, 0, 0, 0, 0, 0]));
}

#[test]
fn values_beyond_the_range_are_held_at_its_end() {
    let narrow = Spec { steps: [100, 100], pressure: 100, ..spec(Family::Generic, 8) };
    let seen = pen(&mut *narrow.decoder(), &[7, 0x81, 0xFF, 0xFF, 50, 0, 0xFF, 0xFF]);
    assert_eq!((seen.position.x, seen.position.y, seen.pressure), (1.0, 0.5, Some(1.0)));
}

#[test]
fn broken_promises_are_found() {
    let sound = RawPen { in_range: true, ..RawPen::default() };
    for broken in [
        RawPen { position: glam::DVec2::new(f64::NAN, 0.0), ..sound },
        RawPen { pressure: Some(1.5), ..sound },
        RawPen { tilt_deg: glam::Vec2::new(0.0, -91.0), ..sound },
        RawPen { twist_deg: 360.0, ..sound },
        RawPen { in_range: false, touches: true, ..sound },
    ] {
        assert!(check_event(&HidEvent::Pen(broken)).is_err(), "{broken:?}");
    }
    assert_eq!(check_event(&HidEvent::Pen(sound)), Ok(()));
    assert!(check_event(&HidEvent::Battery(101)).is_err());
    assert!(events(&mut *spec(Family::Generic, 8).decoder(), &[1]).is_empty());
}
