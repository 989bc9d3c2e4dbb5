//! Hand-computed reports of Wacom's simple layouts.

use super::super::Family;
use super::super::testing::{away, keys, pen, quiet, silent_when_cut, spec};

#[test]
fn small_intuos_keeps_the_end_that_came() {
    let mut intuos = spec(Family::WacomIntuos, 10).decoder();
    // id, flags (near, in range, eraser, tip), x 8192, y 4096, pressure 4096, height 31 − 0
    let report = [2, 0xE9, 0x00, 0x20, 0x00, 0x10, 0x00, 0x10, 0];
    let seen = pen(&mut *intuos, &report);
    assert_eq!((seen.position.x, seen.position.y, seen.pressure), (0.25, 0.25, Some(0.5)));
    assert!(seen.touches && seen.eraser && seen.distance == 1.0);
    let latched = pen(&mut *intuos, &[2, 0xE6, 0x00, 0x20, 0x00, 0x10, 0, 0, 31]);
    assert!(latched.eraser && !latched.touches && latched.barrel == [true, true, false]);
    assert_eq!(latched.distance, 0.0);
    assert!(away(&mut *intuos, &[2, 0x80, 0x00, 0x20, 0x00, 0x10, 0x55, 0x55, 0]));
    assert!(!pen(&mut *intuos, &[2, 0xE0, 0x00, 0x20, 0x00, 0x10, 0, 0, 31]).eraser, "the other end now");
    assert!(quiet(&mut *intuos, &[3, 0xE0, 0x00, 0x20, 0x00, 0x10, 0, 0, 31]));
    // The 8-byte model has no height.
    silent_when_cut(spec(Family::WacomIntuos, 8), &report, 8);
}

#[test]
fn bamboo_pad() {
    let mut pad = spec(Family::WacomBambooPad, 32).decoder();
    // id, pen, flags (button), x 8192, y 4096, pressure 4096
    let report = [0x10, 0x01, 0x02, 0x00, 0x20, 0x00, 0x10, 0x00, 0x10];
    let seen = pen(&mut *pad, &report);
    assert_eq!((seen.position.x, seen.position.y, seen.pressure), (0.25, 0.25, Some(0.5)));
    assert!(seen.touches && seen.barrel == [true, false, false]);
    silent_when_cut(spec(Family::WacomBambooPad, 32), &report, 9);
    // id, keys, 21 others, the second key
    let mut held = [0_u8; 24];
    (held[0], held[1], held[23]) = (0x10, 0x06, 2);
    assert_eq!(keys(&mut *pad, &held), 0b10);
    held[23] = 7;
    assert!(quiet(&mut *pad, &held) && quiet(&mut *pad, &[0x10, 0x02, 0, 0, 0, 0, 0, 0, 0]));
}

#[test]
fn ptu_has_a_tip_for_each_end() {
    let mut ptu = spec(Family::WacomPtu, 8).decoder();
    // id, flags (in range, eraser, its tip, upper button), x 8192, y 4096, pressure 4096
    let report = [2, 0x3C, 0x00, 0x20, 0x00, 0x10, 0x00, 0x10];
    let seen = pen(&mut *ptu, &report);
    assert!(seen.touches && seen.eraser && seen.barrel == [false, true, false] && seen.pressure == Some(0.5));
    assert!(pen(&mut *ptu, &[2, 0x21, 0, 0, 0, 0, 0, 0]).touches);
    assert!(away(&mut *ptu, &[2, 0x00, 0, 0, 0, 0, 0, 0]));
    assert!(quiet(&mut *ptu, &[1, 0x21, 0, 0, 0, 0, 0, 0]));
    silent_when_cut(spec(Family::WacomPtu, 8), &report, 8);
}
