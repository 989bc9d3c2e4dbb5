//! Hand-computed reports of the rarer families.

use super::super::Family;
use super::super::testing::{away, keys, pen, quiet, silent_when_cut, spec};

#[test]
fn woodpad() {
    let mut pad = spec(Family::ViewsonicWoodpad, 14).decoder();
    // id, x 8192, -, -, y 4096, -, -, flags (in range, tip, lower button), pressure 4096, tilt
    let report = [2, 0x00, 0x20, 0, 0, 0x00, 0x10, 0, 0, 0x0F, 0x00, 0x10, 0, 0];
    let seen = pen(&mut *pad, &report);
    assert_eq!((seen.position.x, seen.position.y, seen.pressure), (0.25, 0.25, Some(0.5)));
    assert!(seen.touches && seen.barrel == [true, false, false]);
    let mut hovering = report;
    hovering[9] = 0x03;
    assert_eq!(pen(&mut *pad, &hovering).pressure, Some(0.0), "pressure without the tip is none");
    assert!(away(&mut *pad, &[2, 0, 0, 0, 0, 0, 0, 0, 0, 0x01, 0, 0, 0, 0]));
    silent_when_cut(spec(Family::ViewsonicWoodpad, 14), &report, 12);
}

#[test]
fn xenx() {
    let mut decoder = spec(Family::Xenx, 64).decoder();
    // id, flags (tip, upper button, eraser), x 8192, y 4096, pressure 4096
    let report = [1, 0x45, 0x00, 0x20, 0x00, 0x10, 0x00, 0x10];
    let seen = pen(&mut *decoder, &report);
    assert!(seen.touches && seen.eraser && seen.barrel == [false, true, false]);
    assert!(away(&mut *decoder, &[1, 0, 0, 0, 0, 0, 0, 0]));
    // id, -, ten keys: the first and the last
    assert_eq!(keys(&mut *decoder, &[2, 0, 9, 0, 0, 0, 0, 0, 0, 0, 0, 1]), 0x201);
    silent_when_cut(spec(Family::Xenx, 64), &report, 8);
}

#[test]
fn floogoo() {
    let mut decoder = spec(Family::FloogooFma, 12).decoder();
    // id, flags (in range, eraser, lower button), x 8192, y 4096, pressure 4096, tilt −1.5, 90
    let report = [1, 0x2A, 0x00, 0x20, 0x00, 0x10, 0x00, 0x10, 0x6A, 0xFF, 0x28, 0x23];
    let seen = pen(&mut *decoder, &report);
    assert_eq!((seen.tilt_deg.x, seen.tilt_deg.y, seen.pressure), (-1.5, 90.0, Some(0.5)));
    assert!(seen.eraser && seen.barrel == [true, false, false]);
    assert!(away(&mut *decoder, &[1, 0x01, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]));
    assert!(quiet(&mut *decoder, &[2, 0x20, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]));
    silent_when_cut(spec(Family::FloogooFma, 12), &report, 12);
}

#[test]
fn lifetec() {
    let mut decoder = spec(Family::Lifetec, 8).decoder();
    // id, x 8192, y 4096, flags (upper button), pressure 4096
    let report = [2, 0x00, 0x20, 0x00, 0x10, 0x10, 0x00, 0x10];
    let seen = pen(&mut *decoder, &report);
    assert_eq!((seen.position.x, seen.position.y, seen.pressure), (0.25, 0.25, Some(0.5)));
    assert!(seen.touches && seen.barrel == [false, true, false]);
    assert!(quiet(&mut *decoder, &[1, 0, 0, 0, 0, 0, 0, 0]));
    silent_when_cut(spec(Family::Lifetec, 8), &report, 8);
}

#[test]
fn robotpen_holds_no_button_by_pressing_hard() {
    let mut decoder = spec(Family::Robotpen, 64).decoder();
    // id, pen, -, -, -, -, x 8192, y 4096, pressure 0x1200
    let report = [0xAA, 0x42, 0, 0, 0, 0, 0x00, 0x20, 0x00, 0x10, 0x00, 0x12];
    let seen = pen(&mut *decoder, &report);
    assert_eq!((seen.position.x, seen.position.y, seen.pressure), (0.25, 0.25, Some(0.562_5)));
    assert!(seen.touches && seen.barrel == [false; 3]);
    assert!(away(&mut *decoder, &[0xAA, 0x41, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]));
    silent_when_cut(spec(Family::Robotpen, 64), &report, 12);
}
