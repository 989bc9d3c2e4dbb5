//! Hand-computed reports of the Veikk line.

use super::super::testing::{away, is_of_wheels, keys, pen, quiet, silent_when_cut, spec};
use super::super::{Family, Spec};

/// id, channel, flags (in range, lower button), x 8192, y 4096, pressure 4096, tilt −20, 40
const WIDE: [u8; 13] = [9, 0x41, 0xA2, 0x00, 0x20, 0, 0x00, 0x10, 0, 0x00, 0x10, 0xEC, 40];
/// id, channel, flags (in range, all three buttons), x 8192, y 4096, pressure 4096
const NARROW: [u8; 9] = [9, 0x41, 0xAE, 0x00, 0x20, 0x00, 0x10, 0x00, 0x10];
const LEFT: [u8; 13] = [9, 0x41, 0xC0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];

#[test]
fn wide_reports() {
    let mut veikk = spec(Family::Veikk, 13).decoder();
    let seen = pen(&mut *veikk, &WIDE);
    assert_eq!((seen.position.x, seen.position.y, seen.pressure), (0.25, 0.25, Some(0.5)));
    assert!(seen.touches && seen.barrel == [true, false, false]);
    assert_eq!((seen.tilt_deg.x, seen.tilt_deg.y), (0.0, 0.0));
    assert!(away(&mut *veikk, &LEFT));
    // id, channel, keys, held, key 3, key 12
    assert_eq!(keys(&mut *veikk, &[9, 0x42, 1, 1, 0x04, 0x08]), 0x804);
    assert_eq!(keys(&mut *veikk, &[9, 0x42, 1, 0, 0x04, 0x08]), 0, "released");
    assert!(is_of_wheels(&mut *veikk, &[9, 0x42, 3, 1, 0x02, 0, 0, 0, 0, 0, 0, 0, 0]), "the dial");
    assert!(quiet(&mut *veikk, &[9, 0x43, 0x20, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]), "the touchpad");
    silent_when_cut(spec(Family::Veikk, 13), &WIDE, 11);
}

#[test]
fn wide_reports_with_tilt() {
    let mut veikk = spec(Family::VeikkTilt, 13).decoder();
    let seen = pen(&mut *veikk, &WIDE);
    assert_eq!((seen.tilt_deg.x, seen.tilt_deg.y, seen.pressure), (-20.0, 40.0, Some(0.5)));
    assert!(away(&mut *veikk, &LEFT));
    assert_eq!(keys(&mut *veikk, &[9, 0x42, 1, 1, 0x01, 0x01]), 0x101);
    assert!(quiet(&mut *veikk, &[9, 0x43, 0x20, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]));
    silent_when_cut(spec(Family::VeikkTilt, 13), &WIDE, 13);
}

#[test]
fn narrow_reports() {
    for (family, third) in [(Family::VeikkV1, true), (Family::VeikkA15, false), (Family::VeikkPlain, true)] {
        let mut veikk = spec(family, 9).decoder();
        let seen = pen(&mut *veikk, &NARROW);
        assert_eq!((seen.position.x, seen.position.y, seen.pressure), (0.25, 0.25, Some(0.5)), "{family:?}");
        assert!(seen.touches && seen.barrel == [true, true, third], "{family:?}");
        assert!(away(&mut *veikk, &LEFT[..9]), "{family:?}");
        assert!(quiet(&mut *veikk, &[9, 0x43, 0xA0, 0, 0, 0, 0, 0, 0]), "{family:?}");
        silent_when_cut(spec(family, 9), &NARROW, 9);
    }
    // id, channel, keys, held, key 1, key 9
    assert_eq!(keys(&mut *spec(Family::VeikkA15, 9).decoder(), &[9, 0x42, 1, 1, 1, 1]), 0x101);
}

#[test]
fn typed_keys_distinguish_the_fourth_from_the_sixth_by_the_modifier() {
    let mut veikk = spec(Family::VeikkV1, 8).decoder();
    // id, modifier, key codes
    assert_eq!(keys(&mut *veikk, &[3, 0, 0x3E, 0x2F]), 0x801);
    assert_eq!(keys(&mut *veikk, &[3, 0, 0x19]), 1 << 3);
    assert_eq!(keys(&mut *veikk, &[3, 1, 0x19]), 1 << 5);
    assert_eq!(keys(&mut *veikk, &[3, 0, 0, 0, 0]), 0);
}

#[test]
fn copies_under_other_ids_say_nothing_once_woken() {
    for family in [Family::Veikk, Family::VeikkTilt, Family::VeikkA15, Family::VeikkPlain, Family::VeikkV1] {
        let woken = Spec { report_id: Some(9), ..spec(family, 13) };
        let mut copy = WIDE;
        copy[0] = 1;
        assert!(quiet(&mut *woken.decoder(), &copy), "{family:?}");
    }
}
