//! Hand-computed reports of the UC-Logic line.

use super::super::testing::{away, is_of_wheels, keys, pen, quiet, silent_when_cut, spec};
use super::super::{Family, Spec};

/// id, flags (in range, tip, lower button), x 8192, y 12288, pressure 2048, upper x, upper y, tilt 15, 30 away
const LEANING: [u8; 12] = [8, 0x83, 0x00, 0x20, 0x00, 0x30, 0x00, 0x08, 0, 0, 15, 30];
/// id, keys, -, -, keys 1 and 8, key 9, key 20 and a bit above it
const KEYS: [u8; 12] = [8, 0xE0, 1, 1, 0x81, 0x01, 0x18, 0, 0, 0, 0, 0];
const KEYS_HELD: u32 = 0x8_0181;

#[test]
fn generic_takes_every_report_for_the_pen() {
    // id, flags (tip, upper and third button), x 16384, y 4096, pressure 8192
    let report = [3, 0x0D, 0x00, 0x40, 0x00, 0x10, 0x00, 0x20];
    let seen = pen(&mut *spec(Family::Generic, 8).decoder(), &report);
    assert_eq!((seen.position.x, seen.position.y, seen.pressure), (0.5, 0.25, Some(1.0)));
    assert!(seen.touches && seen.barrel == [false, true, true]);
    silent_when_cut(spec(Family::Generic, 8), &report, 8);
}

#[test]
fn generic_woken_by_a_string_speaks_that_protocol() {
    let woken = Spec { report_id: Some(7), ..spec(Family::Generic, 8) };
    assert!(
        quiet(&mut *woken.decoder(), &[3, 0x81, 0, 0x40, 0, 0x10, 0, 0x20]),
        "a copy for systems without driver"
    );
    assert!(away(&mut *woken.decoder(), &[7, 0xC0, 0, 0x40, 0, 0x10, 0, 0]));
    assert!(pen(&mut *woken.decoder(), &[7, 0x81, 0, 0x40, 0, 0x10, 0, 0x20]).touches);
    assert!(pen(&mut *woken.decoder(), &[0, 0x81, 0, 0x40, 0, 0x10, 0, 0x20]).touches, "a node without ids");
}

#[test]
fn tilt_keys_and_leaving() {
    for family in [
        Family::Uclogic,
        Family::UclogicTilt,
        Family::UclogicV2,
        Family::HuionGiano,
        Family::HuionInspiroy,
        Family::HuionTiltWheel,
    ] {
        let mut decoder = spec(family, 12).decoder();
        let seen = pen(&mut *decoder, &LEANING);
        assert_eq!((seen.position.x, seen.position.y, seen.pressure), (0.25, 0.75, Some(0.25)), "{family:?}");
        assert!(seen.touches && !seen.eraser && seen.barrel == [true, false, false], "{family:?}");
        let lean = if family == Family::Uclogic { (0.0, 0.0) } else { (15.0, -30.0) };
        assert_eq!((seen.tilt_deg.x, seen.tilt_deg.y), lean, "{family:?}");
        assert_eq!(keys(&mut *decoder, &KEYS), KEYS_HELD, "{family:?}");
        assert!(away(&mut *decoder, &[8, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]), "{family:?}");
        for other in [0xF0, 0xF1] {
            assert!(
                is_of_wheels(&mut *decoder, &[8, other, 1, 1, 0, 3, 0, 0, 0, 0, 0, 0]),
                "{family:?}: ring or dial"
            );
        }
        silent_when_cut(spec(family, 12), &LEANING, if family == Family::Uclogic { 8 } else { 12 });
        silent_when_cut(spec(family, 12), &KEYS, 7);
    }
}

#[test]
fn uclogic_v1_has_its_own_sense_of_range() {
    let mut decoder = spec(Family::UclogicV1, 8).decoder();
    // id, flags (in range, tip), x 8192, y 4096, pressure 4096
    let report = [7, 0x41, 0x00, 0x20, 0x00, 0x10, 0x00, 0x10];
    let seen = pen(&mut *decoder, &report);
    assert_eq!((seen.position.x, seen.position.y, seen.pressure), (0.25, 0.25, Some(0.5)));
    assert!(away(&mut *decoder, &[7, 0x80, 0x00, 0x20, 0x00, 0x10, 0, 0]));
    assert_eq!(keys(&mut *decoder, &KEYS), KEYS_HELD);
    silent_when_cut(spec(Family::UclogicV1, 8), &report, 8);
}

#[test]
fn giano_counts_beyond_16_bits() {
    let wide = Spec { steps: [0x20000, 0x20000], ..spec(Family::HuionGiano, 14) };
    let mut report = LEANING;
    // Bit 16 of x and y: x = 0x12000, y = 0x13000
    (report[8], report[9]) = (1, 1);
    let seen = pen(&mut *wide.decoder(), &report);
    assert_eq!((seen.position.x, seen.position.y), (0.562_5, 0.593_75));
}

#[test]
fn inspiroy_has_groups_of_keys_and_nothing_below_the_flag() {
    let mut decoder = spec(Family::HuionInspiroy, 12).decoder();
    let mut group = KEYS;
    group[1] = 0xE3;
    assert_eq!(keys(&mut *decoder, &group), KEYS_HELD);
    assert!(quiet(&mut *decoder, &[8, 0x01, 0, 0x20, 0, 0x30, 0, 8, 0, 0, 0, 0]));
}
