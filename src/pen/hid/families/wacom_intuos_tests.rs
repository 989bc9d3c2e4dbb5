//! Hand-computed reports of Intuos 1 to 5.

use super::super::testing::{away, keys, pen, quiet, silent_when_cut, spec};
use super::super::{Family, Spec};

const FAMILIES: [Family; 6] = [
    Family::WacomIntuosV1,
    Family::WacomIntuosPro,
    Family::WacomIntuos4,
    Family::WacomIntuos3,
    Family::WacomIntuos3ExtraAux,
    Family::WacomCintiqV1,
];

/// id, pen with the upper button, x 0x10 << 9, y 0x08 << 9, pressure 0x80 << 3 | 1 << 1, tilt x 0x2A << 1 | 1 = 85 − 64,
/// y 0x20 = 32 − 64, height 21 and low bits of x and y
const PEN: [u8; 10] = [2, 0xE4, 0x10, 0x00, 0x08, 0x00, 0x80, 0x6A, 0xA0, 0x54];
/// id, tool packet: kind 0x_8_ is an eraser, serial 0x1234_5678 = 0x1 | 0x23 | 0x45 | 0x67 | 0x8
const ERASER: [u8; 10] = [2, 0xC2, 0x80, 0xA1, 0x23, 0x45, 0x67, 0x80, 0, 0];
const LEFT: [u8; 10] = [2, 0x80, 0, 0, 0, 0, 0, 0, 0, 0];

#[test]
fn pen_packets() {
    for family in FAMILIES {
        let spec = Spec { pressure: 2047, ..spec(family, 10) };
        let mut intuos = spec.decoder();
        let seen = pen(&mut *intuos, &PEN);
        assert_eq!((seen.position.x, seen.position.y), (0.25, 0.25), "{family:?}");
        assert_eq!(seen.pressure, Some(1026.0 / 2047.0), "{family:?}");
        assert_eq!((seen.tilt_deg.x, seen.tilt_deg.y), (21.0, -32.0), "{family:?}");
        assert!(seen.touches && !seen.eraser && seen.barrel == [false, true, false], "{family:?}");
        assert_eq!(seen.distance, 21.0 / 63.0);
        let mut finest = PEN;
        // Lowest bits: pressure, x, y
        (finest[1], finest[9]) = (0xE5, 0x57);
        let seen = pen(&mut *intuos, &finest);
        assert_eq!(seen.pressure, Some(1027.0 / 2047.0));
        assert_eq!((seen.position.x, seen.position.y), (8193.0 / 32768.0, 4097.0 / 16384.0));
        assert!(away(&mut *intuos, &LEFT), "{family:?}");
        silent_when_cut(spec, &PEN, 10);
    }
}

#[test]
fn the_lowest_flag_is_no_pressure_on_even_models() {
    let even = Spec { pressure: 2046, ..spec(Family::WacomIntuos3, 10) };
    let mut odd = PEN;
    odd[1] = 0xE5;
    assert_eq!(pen(&mut *even.decoder(), &odd).pressure, Some(1026.0 / 2046.0));
}

#[test]
fn a_light_touch_is_none() {
    let spec = Spec { pressure: 2047, ..spec(Family::WacomIntuosV1, 10) };
    // Pressure 10, then 11
    let mut light = PEN;
    (light[6], light[7]) = (1, 0x6A);
    assert!(!pen(&mut *spec.decoder(), &light).touches);
    light[1] = 0xE5;
    assert!(pen(&mut *spec.decoder(), &light).touches);
}

#[test]
fn a_tool_announces_itself_and_is_kept_until_it_leaves() {
    for family in FAMILIES {
        let mut intuos = spec(family, 10).decoder();
        assert!(quiet(&mut *intuos, &ERASER), "{family:?}");
        let seen = pen(&mut *intuos, &PEN);
        assert!(seen.eraser, "{family:?}");
        assert_eq!(seen.serial, 0x1234_5678, "{family:?}");
        assert!(away(&mut *intuos, &LEFT));
        let next = pen(&mut *intuos, &PEN);
        assert!(!next.eraser && next.serial == 0, "{family:?}");
    }
}

#[test]
fn rotation_packets_keep_what_the_pen_packet_said() {
    let mut intuos = spec(Family::WacomIntuos4, 10).decoder();
    let before = pen(&mut *intuos, &PEN);
    // id, rotation, x 0x20 << 9, y 0x10 << 9, t = 0x32 << 3 | 4 = 404 with bit 5 clear: 450 − 202 = 248 fifths
    let turned = pen(&mut *intuos, &[2, 0xEA, 0x20, 0x00, 0x10, 0x00, 0x32, 0x80, 0, 0x54]);
    assert_eq!(turned.twist_deg, 49.6);
    assert_eq!((turned.position.x, turned.position.y), (0.5, 0.5));
    assert_eq!(
        (turned.pressure, turned.tilt_deg, turned.barrel),
        (before.pressure, before.tilt_deg, before.barrel)
    );
    // t = 0x38 << 3 | 5 = 453, bit 5 set: 226 + 450 = 676 fifths
    let turned = pen(&mut *intuos, &[2, 0xEA, 0x20, 0x00, 0x10, 0x00, 0x38, 0xA0, 0, 0x54]);
    assert_eq!(turned.twist_deg, 135.2);
    // t = 0xE0 << 3 | 5 = 1797, bit 5 set: 898 + 450 − 1800 = −452 fifths, that is 1348
    let turned = pen(&mut *intuos, &[2, 0xEA, 0x20, 0x00, 0x10, 0x00, 0xE0, 0xA0, 0, 0x54]);
    assert_eq!(turned.twist_deg, 269.6);
    assert_eq!(pen(&mut *intuos, &PEN).twist_deg, 269.6, "kept between rotation packets");
    let oldest = Spec { pressure: 2046, ..spec(Family::WacomIntuosV1, 10) };
    assert!(
        quiet(&mut *oldest.decoder(), &[2, 0xEA, 0x20, 0, 0x10, 0, 0xE0, 0xA0, 0, 0x54]),
        "half of a mouse"
    );
}

#[test]
fn mice_are_no_pens_and_airbrushes_are() {
    for family in FAMILIES {
        let mut intuos = spec(family, 10).decoder();
        // The 4D mouse, the Intuos 4 mouse, the lens
        for mouse in [0xE8, 0xEC, 0xAC, 0xF0] {
            let mut report = PEN;
            report[1] = mouse;
            assert!(quiet(&mut *intuos, &report), "{family:?} {mouse:x}");
        }
        let before = pen(&mut *intuos, &PEN);
        let mut wheel = PEN;
        (wheel[1], wheel[6]) = (0xF4, 0x00);
        assert_eq!(pen(&mut *intuos, &wheel).pressure, before.pressure, "a wheel is no pressure");
        assert!(quiet(&mut *intuos, &[0x10, 0x20, 0, 0, 0, 0, 0, 0, 0, 0]), "in range, without data");
    }
}

#[test]
fn tablets_that_leave_noise_in_tilt_do_not_lean() {
    let upright = Spec { tilts: false, ..spec(Family::WacomIntuosV1, 10) };
    assert_eq!(pen(&mut *upright.decoder(), &PEN).tilt_deg, glam::Vec2::ZERO);
}

#[test]
fn keys_stand_where_each_model_has_them() {
    // Bytes: id, 1, 2, 3, 4, 5, 6, 7, 8, 9
    for (family, report, held) in [
        (Family::WacomIntuosV1, [3, 0, 0, 0, 0x81, 0, 0, 0, 0, 0], 0x81),
        (Family::WacomIntuosPro, [3, 0, 0, 0x01, 0x81, 0, 0, 0, 0, 0], 0x181),
        (Family::WacomIntuos4, [0x0C, 0x85, 0x01, 0x42, 0, 0, 0, 0, 0, 0], 0x142),
        (Family::WacomIntuos3, [0x0C, 0, 0, 0, 0, 0xF1, 0xF8, 0, 0, 0], 0x81),
        (Family::WacomIntuos3, [3, 0, 0, 0, 0x21, 0, 0, 0, 0, 0], 0x21),
        (Family::WacomIntuos3ExtraAux, [0x0C, 0, 0, 0, 0, 0xF0, 0xF1, 0, 0, 0], 0x230),
        (Family::WacomCintiqV1, [0x0C, 0, 0, 0, 0, 1, 0x03, 1, 0x80, 0x05], 0x17_8003),
    ] {
        assert_eq!(keys(&mut *spec(family, 10).decoder(), &report), held, "{family:?}");
        assert!(quiet(&mut *spec(family, 10).decoder(), &[0xC0, 0, 0, 0, 0, 0, 0, 0, 0, 0]), "{family:?}");
    }
    assert!(quiet(&mut *spec(Family::WacomCintiqV1, 10).decoder(), &[3, 0, 0, 0, 0xFF, 0, 0, 0, 0, 0]));
}
