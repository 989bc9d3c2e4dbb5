//! Hand-computed reports of Wacom from 2017 on.

use super::super::testing::{away, events, keys, pen, quiet, silent_when_cut, spec};
use super::super::{Family, HidEvent, Spec};
use glam::DVec2;

/// id, flags (near, in range, inverted, eraser), x 8192, y 4096, pressure 4096, tilt −20, 40, twist −450 fifths,
/// wheel, height 63, serial 0x0403_0201, tool kind
const NARROW_TILT: [u8; 27] = [
    0x10, 0x78, 0x00, 0x20, 0, 0x00, 0x10, 0, 0x00, 0x10, 0xEC, 40, 0x3E, 0xFE, 0, 0, 63, 1, 2, 3, 4, 0, 0,
    0, 0, 0, 0,
];
/// id, pen number, flags (near, in range, tip, third button), x 8192, y 4096, pressure 4096, tilt −64, 90, twist 899,
/// wheel, height 255, serial 0x0403_0201, tool kind
const WIDE_TILT: [u8; 30] = [
    0x1E, 1, 0xC9, 0x00, 0x20, 0, 0x00, 0x10, 0, 0x00, 0x10, 0xC0, 0xFF, 90, 0, 0x83, 0x03, 0, 0, 255, 1, 2,
    3, 4, 0, 0, 0, 0, 0, 0,
];
/// id, pen, flags (near, in range, tip, lower button), x 8192, y 4096, pressure 4096, tilt −64, 90, height 0, time
const SMALL: [u8; 18] = [0x1F, 1, 0xC3, 0x00, 0x20, 0x00, 0x10, 0x00, 0x10, 0xC0, 0xFF, 90, 0, 0, 0, 0, 0, 0];

#[test]
fn eight_bit_tilt() {
    let mut tablet = spec(Family::WacomIntuosV2, 192).decoder();
    let seen = pen(&mut *tablet, &NARROW_TILT);
    assert_eq!((seen.position.x, seen.position.y, seen.pressure), (0.25, 0.25, Some(0.5)));
    assert_eq!((seen.tilt_deg.x, seen.tilt_deg.y, seen.twist_deg), (-20.0, 40.0, 270.0));
    assert_eq!((seen.distance, seen.serial), (1.0, 0x0403_0201));
    assert!(seen.touches && seen.eraser && seen.barrel == [false; 3]);
    let mut hovering = NARROW_TILT;
    hovering[1] = 0x66;
    let seen = pen(&mut *tablet, &hovering);
    assert!(!seen.touches && !seen.eraser && seen.barrel == [true, true, false]);
    hovering[1] = 0x40;
    assert!(away(&mut *tablet, &hovering), "near, but not in range");
    silent_when_cut(spec(Family::WacomIntuosV2, 192), &NARROW_TILT, 10);
}

#[test]
fn sixteen_bit_tilt() {
    for family in [Family::WacomIntuosV2, Family::WacomIntuosV3] {
        let mut tablet = spec(family, 192).decoder();
        let seen = pen(&mut *tablet, &WIDE_TILT);
        assert_eq!((seen.position.x, seen.position.y, seen.pressure), (0.25, 0.25, Some(0.5)));
        assert_eq!((seen.tilt_deg.x, seen.tilt_deg.y, seen.twist_deg), (-64.0, 90.0, 179.8));
        assert_eq!((seen.distance, seen.serial), (1.0, 0x0403_0201));
        assert!(seen.touches && !seen.eraser && seen.barrel == [false, false, true]);
        let mut left = WIDE_TILT;
        left[2] = 0x80;
        assert!(away(&mut *tablet, &left));
        silent_when_cut(spec(family, 192), &WIDE_TILT, 15);
    }
}

#[test]
fn small_reports() {
    let mut tablet = spec(Family::WacomIntuosV3, 19).decoder();
    let seen = pen(&mut *tablet, &SMALL);
    assert_eq!((seen.position.x, seen.position.y, seen.pressure), (0.25, 0.25, Some(0.5)));
    assert_eq!((seen.tilt_deg.x, seen.tilt_deg.y), (-64.0, 90.0));
    assert!(seen.touches && seen.barrel == [true, false, false]);
    let mut other = SMALL;
    other[1] = 2;
    assert!(quiet(&mut *tablet, &other), "not the pen");
    let mut left = SMALL;
    left[2] = 0;
    assert!(away(&mut *tablet, &left));
    assert!(quiet(&mut *spec(Family::WacomIntuosV2, 192).decoder(), &SMALL));
    silent_when_cut(spec(Family::WacomIntuosV3, 19), &SMALL, 13);
}

#[test]
fn keys_of_both_generations() {
    // id, keys 1 and 8, -, ring button, ring
    let report = [0x11, 0x81, 0, 0x01, 0x85];
    assert_eq!(keys(&mut *spec(Family::WacomIntuosV2, 192).decoder(), &report), 0x181);
    silent_when_cut(spec(Family::WacomIntuosV2, 192), &report, 4);
    // id, keys 1 and 6, -, buttons of both dials, dials
    let report = [0x11, 0x11, 0, 0x03, 1, 0x7F];
    assert_eq!(keys(&mut *spec(Family::WacomIntuosV3, 192).decoder(), &report), 0b10_0011_0001);
    for other in [0x06, 0x13, 0xAC, 0xC0, 0xFE] {
        let mut report = NARROW_TILT;
        report[0] = other;
        assert!(quiet(&mut *spec(Family::WacomIntuosV2, 192).decoder(), &report), "{other:x}");
    }
}

#[test]
fn fingers_where_their_range_is_known() {
    let touch = Spec { touch: Some([4096, 4096]), ..spec(Family::WacomIntuosV2, 44) };
    // id, count, finger 0 down at (2048, 1024), finger 3 up, empty slot
    let mut report = [0_u8; 26];
    report[..8].copy_from_slice(&[0x21, 2, 1, 1, 0x00, 0x08, 0x00, 0x04]);
    report[10..16].copy_from_slice(&[4, 0, 0x00, 0x08, 0x00, 0x04]);
    let position = DVec2::new(0.5, 0.25);
    let down = HidEvent::Touch { finger: 0, touches: true, position };
    let up = HidEvent::Touch { finger: 3, touches: false, position };
    assert_eq!(events(&mut *touch.decoder(), &report), [down, up]);
    assert!(quiet(&mut *spec(Family::WacomIntuosV2, 44).decoder(), &report));
    silent_when_cut(touch, &report[..10], 10);
}

#[test]
fn bluetooth_gives_every_moment_of_a_report() {
    let mut report = [0_u8; 109];
    report[0] = 0x80;
    // Flags (valid, near, in range, tip), x 8192, y 4096, pressure 4096, tilt −20, 40, twist −450, wheel, height 63
    let moment = [0xE1, 0x00, 0x20, 0x00, 0x10, 0x00, 0x10, 0xEC, 40, 0x3E, 0xFE, 0, 0, 63];
    report[1..15].copy_from_slice(&moment);
    report[15..29].copy_from_slice(&moment);
    // The third moment is out of range, the others are not valid; then the serial number.
    report[29] = 0x80;
    report[99..107].copy_from_slice(&[1, 2, 3, 4, 5, 6, 7, 8]);
    let said = events(&mut *spec(Family::WacomIntuosBluetooth, 361).decoder(), &report);
    let [HidEvent::Pen(first), HidEvent::Pen(second), HidEvent::Pen(third)] = said[..] else {
        panic!("{said:?}")
    };
    assert_eq!((first.position, first.pressure), (DVec2::new(0.25, 0.25), Some(0.5)));
    assert_eq!(
        (first.tilt_deg.x, first.tilt_deg.y, first.twist_deg, first.distance),
        (-20.0, 40.0, 270.0, 1.0)
    );
    assert_eq!(first.serial, 0x0807_0605_0403_0201);
    assert!(first == second && !third.in_range);
    silent_when_cut(spec(Family::WacomIntuosBluetooth, 361), &report, 107);
}
