//! Hand-computed reports of the XP-Pen line.

use super::super::testing::{away, keys, pen, quiet, silent_when_cut, spec};
use super::super::{Family, Spec};

/// id, flags (in range, tip, upper button), x 8192, y 4096, pressure 4096, tilt −20, 40, upper x, upper y
const PEN: [u8; 12] = [2, 0xA5, 0x00, 0x20, 0x00, 0x10, 0x00, 0x10, 0xEC, 40, 0, 0];
const LEFT: [u8; 12] = [2, 0xC0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];
/// id, keys, keys 2, 9 and 20
const KEYS: [u8; 12] = [2, 0xF0, 0x02, 0x01, 0x08, 0, 0, 0, 0, 0, 0, 0];

#[test]
fn long_nodes_lean() {
    for family in [Family::XpPen, Family::XpPenOffsetPressure] {
        for length in [10, 12] {
            let mut decoder = spec(family, length).decoder();
            let seen = pen(&mut *decoder, &PEN[..length]);
            assert_eq!((seen.position.x, seen.position.y, seen.pressure), (0.25, 0.25, Some(0.5)));
            assert_eq!((seen.tilt_deg.x, seen.tilt_deg.y), (-20.0, 40.0));
            assert!(seen.touches && !seen.eraser && seen.barrel == [false, true, false]);
            assert!(away(&mut *decoder, &LEFT[..length]));
            assert_eq!(keys(&mut *decoder, &KEYS[..length]), 0x8_0102);
            assert!(quiet(&mut *decoder, &[2, 0xF2, 80, 0, 0, 0, 0, 0, 0, 0, 0, 0]), "the battery");
            silent_when_cut(spec(family, length), &PEN[..length], length);
            silent_when_cut(spec(family, length), &KEYS[..length], 5);
        }
    }
}

#[test]
fn upper_bits_count_from_12_bytes_on_and_the_eraser_is_a_flag() {
    let wide = Spec { steps: [0x20000, 0x20000], ..spec(Family::XpPen, 12) };
    // Flags: in range, tip, eraser; x 0x12000, y 0x11000
    let report = [2, 0xA9, 0x00, 0x20, 0x00, 0x10, 0x00, 0x10, 0, 0, 1, 1];
    let seen = pen(&mut *wide.decoder(), &report);
    assert_eq!((seen.position.x, seen.position.y), (0.562_5, 0.531_25));
    assert!(seen.eraser && seen.touches);
}

#[test]
fn short_nodes_do_not_lean() {
    // id, flags (tip, third button), x 8192, y 4096, pressure 4096
    let report = [2, 0xA9, 0x00, 0x20, 0x00, 0x10, 0x00, 0x10];
    let seen = pen(&mut *spec(Family::XpPen, 8).decoder(), &report);
    assert!(seen.touches && !seen.eraser && seen.barrel == [false, false, true]);
    silent_when_cut(spec(Family::XpPen, 8), &report, 8);
    let offset = pen(&mut *spec(Family::XpPenOffsetPressure, 8).decoder(), &report);
    assert!(offset.eraser && offset.barrel == [false; 3], "here the third flag is the eraser");
    assert_eq!(offset.pressure, Some(0.5));
    silent_when_cut(spec(Family::XpPenOffsetPressure, 8), &report, 8);
}

#[test]
fn pressure_is_cleaned_where_other_things_stand_above_it() {
    let mut report = PEN;
    // 0x1000 with the upper three bits set
    report[7] = 0xF0;
    assert_eq!(pen(&mut *spec(Family::XpPenOffsetPressure, 12).decoder(), &report).pressure, Some(0.5));
    assert_eq!(pen(&mut *spec(Family::XpPen, 12).decoder(), &report).pressure, Some(1.0));
}

#[test]
fn second_generation_has_a_fourteenth_bit_of_pressure() {
    let gen2 = Spec { pressure: 0x4000, ..spec(Family::XpPenGen2, 14) };
    // Pressure 0x1000, bit 14 set and to be ignored; last byte: bit 13 of pressure
    let report = [2, 0xA1, 0x00, 0x20, 0x00, 0x10, 0x00, 0x50, 5, 6, 0, 0, 0, 1];
    let seen = pen(&mut *gen2.decoder(), &report);
    assert_eq!(seen.pressure, Some(0.75));
    assert_eq!((seen.position.x, seen.tilt_deg.x, seen.tilt_deg.y), (0.25, 5.0, 6.0));
    assert!(away(&mut *gen2.decoder(), &LEFT));
    assert!(quiet(&mut *gen2.decoder(), &KEYS));
    silent_when_cut(gen2, &report, 14);
}

#[test]
fn keys_behind_bit_5() {
    let mut decoder = spec(Family::XpPenOffsetAux, 8).decoder();
    // id, keys, -, -, key 1, key 9, key 17
    assert_eq!(keys(&mut *decoder, &[2, 0xE0, 0, 0, 1, 1, 1, 0]), 0x1_0101);
    // id, flags (tip, lower button), x 8192, y 4096, pressure 4096
    let report = [2, 0x83, 0x00, 0x20, 0x00, 0x10, 0x00, 0x10];
    let seen = pen(&mut *decoder, &report);
    assert!(seen.touches && seen.barrel == [true, false, false] && seen.pressure == Some(0.5));
    assert!(away(&mut *decoder, &LEFT));
    silent_when_cut(spec(Family::XpPenOffsetAux, 8), &report, 8);
}

#[test]
fn xencelabs() {
    let mut decoder = spec(Family::Xencelabs, 10).decoder();
    // id, flags (in range, eraser, third button), x 8192, y 4096, pressure 4096, tilt −20, 40
    let report = [2, 0x68, 0x00, 0x20, 0x00, 0x10, 0x00, 0x10, 0xEC, 40];
    let seen = pen(&mut *decoder, &report);
    assert!(seen.touches && seen.eraser && seen.barrel == [false, false, true]);
    assert_eq!((seen.tilt_deg.x, seen.tilt_deg.y), (-20.0, 40.0));
    assert!(away(&mut *decoder, &LEFT));
    assert_eq!(keys(&mut *decoder, &KEYS), 0x8_0102);
    assert!(quiet(&mut *decoder, &[2, 0xF2, 80, 0, 0, 0, 0, 0, 0, 0]));
    silent_when_cut(spec(Family::Xencelabs, 10), &report, 10);
}

#[test]
fn copies_under_other_ids_say_nothing_once_woken() {
    for family in [Family::XpPen, Family::XpPenGen2, Family::XpPenOffsetPressure, Family::XpPenOffsetAux] {
        for length in [8, 14] {
            let woken = Spec { report_id: Some(2), ..spec(family, length) };
            assert!(quiet(&mut *woken.decoder(), &[7, 0xA1, 0, 0x20, 0, 0x10, 0, 0x10, 0, 0, 0, 0, 0, 0]));
        }
    }
}
