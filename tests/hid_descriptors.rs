//! Report descriptors of made-up devices: what each says is decoded, and nothing else is taken for a pen.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::virtual_tablets;
use glam::{DVec2, Vec2};
use penstemon::pen::hid::{Abilities, Decode, DescriptorDecoder, HidEvent, RawPen};
use proptest::prelude::*;

use crate::virtual_tablets::{DisplayReport, switch};

fn decode(decoder: &mut DescriptorDecoder, report: &[u8]) -> Vec<HidEvent> {
    let mut events = Vec::new();
    decoder.decode(report, &mut |event| events.push(event));
    events
}

fn decode_pen(decoder: &mut DescriptorDecoder, report: &[u8]) -> Option<RawPen> {
    decode(decoder, report).into_iter().find_map(|event| match event {
        HidEvent::Pen(pen) => Some(pen),
        _ => None,
    })
}

fn decoder(descriptor: &[u8]) -> DescriptorDecoder {
    DescriptorDecoder::new(descriptor).unwrap().unwrap()
}

#[test]
fn a_pen_display_says_everything() {
    let mut display = decoder(virtual_tablets::PEN_DISPLAY);
    assert!(display.area_mm().unwrap().abs_diff_eq(DVec2::new(294.64, 165.74), 1e-9));
    let all = Abilities {
        pressure_levels: 4096,
        tilt: true,
        twist: true,
        distance: false,
        eraser: true,
        barrel_buttons: 2,
        leaves: true,
        serial: true,
        battery: true,
        touch: true,
        is_pad: false,
    };
    assert_eq!(display.abilities(), all);
    let report = DisplayReport {
        switches: switch::TIP | switch::IN_RANGE | switch::SECOND_BARREL,
        x: 8192,
        y: 32768,
        pressure: 4095,
        tilt: [-4500, 9000],
        twist: 27000,
        battery: 63,
        serial: 0xDEAD_BEEF,
    };
    let pen = RawPen {
        in_range: true,
        touches: true,
        eraser: false,
        barrel: [false, true, false],
        position: DVec2::new(0.25, 1.0),
        pressure: Some(1.0),
        tilt_deg: Vec2::new(-45.0, 90.0),
        twist_deg: 270.0,
        distance: 0.0,
        serial: 0xDEAD_BEEF,
    };
    assert_eq!(decode(&mut display, &report.bytes()), [HidEvent::Pen(pen), HidEvent::Battery(63)]);
    assert_eq!(
        decode(&mut display, &report.bytes()),
        [HidEvent::Pen(pen)],
        "the battery is told when it changes"
    );
    let gone = decode_pen(&mut display, &DisplayReport::default().bytes()).unwrap();
    assert_eq!((gone.in_range, gone.position), (false, pen.position), "it leaves where it was seen last");
}

#[test]
fn impossible_switches_are_cured() {
    use switch::{ERASER, IN_RANGE, INVERT, TIP};
    let mut display = decoder(virtual_tablets::PEN_DISPLAY);
    let mut state = |switches| {
        let report = DisplayReport { switches, pressure: 100, ..Default::default() };
        let pen = decode_pen(&mut display, &report.bytes()).unwrap();
        (pen.in_range, pen.touches, pen.eraser)
    };
    assert_eq!(state(IN_RANGE), (true, false, false));
    assert_eq!(state(IN_RANGE | INVERT), (true, false, true));
    assert_eq!(state(IN_RANGE | INVERT | ERASER), (true, true, true));
    assert_eq!(state(IN_RANGE | ERASER), (true, true, true), "an eraser without invert erases");
    assert_eq!(state(IN_RANGE | TIP | INVERT), (true, true, true), "a tip with invert erases");
    assert_eq!(state(TIP), (true, true, false), "a tip without in-range touches");
    assert_eq!(state(INVERT), (false, false, false));
}

/// What pens of Huion, XP-Pen and KYE send in the air while their upper button is held.
#[test]
fn an_eraser_in_the_air_does_not_erase() {
    use switch::{ERASER, IN_RANGE, INVERT, TIP};
    let mut display = decoder(virtual_tablets::PEN_DISPLAY);
    let mut state = |switches, pressure| {
        let report = DisplayReport { switches, pressure, ..Default::default() };
        let pen = decode_pen(&mut display, &report.bytes()).unwrap();
        (pen.in_range, pen.touches, pen.eraser)
    };
    assert_eq!(state(IN_RANGE | ERASER, 0), (true, false, true));
    assert_eq!(state(IN_RANGE | INVERT | ERASER, 0), (true, false, true));
    assert_eq!(state(ERASER, 0), (true, false, true), "it is near all the same");
    assert_eq!(state(IN_RANGE | ERASER, 1), (true, true, true));
    assert_eq!(state(IN_RANGE | ERASER | TIP, 0), (true, true, true));
}

/// [`virtual_tablets::DESK_TABLET`] with another unit of its area and other numbers of steps and of physical units on its axes.
fn desk_tablet_with_area(unit: u8, steps: [u16; 2], physical: [u16; 2]) -> Vec<u8> {
    let [x, y] = steps.map(u16::to_le_bytes);
    let [width, height] = physical.map(u16::to_le_bytes);
    let [head, tail] = [&virtual_tablets::DESK_TABLET[..38], &virtual_tablets::DESK_TABLET[70..]];
    let area = [
        &[0x05, 0x01, 0x65, unit, 0x55, 0x0D, 0x75, 0x10, 0x35, 0x00][..],
        &[0x09, 0x30, 0x27, x[0], x[1], 0, 0, 0x46, width[0], width[1], 0x81, 0x02],
        &[0x09, 0x31, 0x27, y[0], y[1], 0, 0, 0x46, height[0], height[1], 0x81, 0x02],
    ];
    [head, &area.concat(), tail].concat()
}

#[test]
fn an_area_in_units_that_are_no_length_counts_only_where_its_numbers_agree() {
    const INCH: u8 = 0x13;
    const CUBIC_INCH: u8 = 0x33;
    let area = |unit, steps, physical| decoder(&desk_tablet_with_area(unit, steps, physical)).area_mm();
    let six_by_five = DVec2::new(164.7952, 124.079);
    assert!(
        area(INCH, [16480, 12410], [6488, 4885]).is_some_and(|mm| mm.abs_diff_eq(six_by_five, 1e-9)),
        "a length"
    );
    assert!(
        area(CUBIC_INCH, [16480, 12410], [6488, 4885]).is_some_and(|mm| mm.abs_diff_eq(six_by_five, 1e-9)),
        "2540 steps an inch on both axes: an inch is meant"
    );
    assert_eq!(area(CUBIC_INCH, [32767, 32767], [2048, 2048]), None, "a square for every tablet");
    assert_eq!(area(CUBIC_INCH, [14080, 10240], [14080, 10240]), None, "the steps once more");
    assert_eq!(area(CUBIC_INCH, [32767, 32766], [2048, 4096]), None, "axes that do not agree");
    assert_eq!(area(INCH, [32767, 32767], [2048, 2048]), Some(DVec2::splat(52.0192)), "a length is believed");
}

#[test]
fn fingers_count_unless_the_screen_takes_them_for_a_palm() {
    let mut display = decoder(virtual_tablets::PEN_DISPLAY);
    let touch = |finger, touches, x: f64| HidEvent::Touch { finger, touches, position: DVec2::new(x, 0.0) };
    let mut frame = |first: [u8; 3], second: [u8; 3], count| {
        let contact = |[state, number, x]: [u8; 3]| [state, number, x, 0, 0, 0];
        let bytes = [&[3][..], &contact(first), &contact(second), &[count]].concat();
        decode(&mut display, &bytes)
    };
    let (sure, palm, lifted) = (3, 1, 2);
    assert_eq!(frame([sure, 5, 100], [palm, 6, 0], 2), [touch(5, true, 0.1)]);
    assert_eq!(frame([sure, 5, 200], [sure, 6, 0], 2), [touch(5, true, 0.2), touch(6, true, 0.0)]);
    assert_eq!(frame([sure, 5, 200], [palm, 6, 0], 2), [touch(5, true, 0.2), touch(6, false, 0.0)]);
    assert_eq!(frame([lifted, 5, 200], [sure, 9, 0], 1), [touch(5, false, 0.2)], "only one contact counts");
}

#[test]
fn a_tablet_without_report_ids_has_0_there() {
    let mut tablet = decoder(virtual_tablets::DESK_TABLET);
    assert!(tablet.area_mm().unwrap().abs_diff_eq(DVec2::new(254.0, 158.75), 1e-9));
    let report = [0, 0b1000_0011, 0x38, 0x63, 0x06, 0x7C, 0xFF, 0x1F, (-30i8) as u8, 60];
    let pen = decode_pen(&mut tablet, &report).unwrap();
    assert!(pen.in_range && pen.touches && !pen.eraser);
    assert_eq!((pen.barrel, pen.pressure), ([true, false, false], Some(1.0)));
    assert_eq!((pen.position, pen.tilt_deg), (DVec2::new(0.5, 1.0), Vec2::new(-30.0, 60.0)));
}

#[test]
fn wacoms_own_page_is_read_like_the_standard_one() {
    let mut tablet = decoder(virtual_tablets::WACOM_PAGE);
    assert!(tablet.area_mm().unwrap().abs_diff_eq(DVec2::new(224.0, 148.0), 1e-9));
    let switches = 0b0101_1010;
    let mut report = vec![16, switches, 0x80, 0x57, 0, 0xA0, 0x73, 0, 0, 0x10];
    report.extend([(-64i8) as u8, 63]);
    report.extend((-450i16).to_le_bytes());
    report.push(63);
    report.extend(0x1234_5678u32.to_le_bytes());
    report.extend(0x9Au32.to_le_bytes());
    report.push(1);
    let events = decode(&mut tablet, &report);
    let pen = RawPen {
        in_range: true,
        touches: true,
        eraser: true,
        barrel: [true, false, true],
        position: DVec2::new(0.5, 1.0),
        pressure: Some((4096.0 / 8191.0) as f32),
        tilt_deg: Vec2::new(-64.0, 63.0),
        twist_deg: 270.0,
        distance: 1.0,
        serial: 0x9A_1234_5678,
    };
    assert_eq!(events, [HidEvent::Pen(pen), HidEvent::Keys(1)]);
}

#[test]
fn keys_rings_and_strips_are_read_beside_a_pen_and_alone() {
    let both = [virtual_tablets::WACOM_PAGE, virtual_tablets::WACOM_PAD].concat();
    let alone = DescriptorDecoder::of_pad(virtual_tablets::WACOM_PAD).unwrap().unwrap();
    assert_eq!(alone.abilities(), Abilities { is_pad: true, ..Abilities::default() });
    assert!(!decoder(&both).abilities().is_pad && DescriptorDecoder::of_pad(&both).unwrap().is_none());
    for mut tablet in [decoder(&both), alone] {
        let ring = |place| HidEvent::Ring { number: 0, place, places: 72 };
        let strip = |place| HidEvent::Strip { number: 0, place, places: 13 };
        let report = [17, 0b1000_0001, 1, 40, 0, 0x10];
        assert_eq!(decode(&mut tablet, &report), [HidEvent::Keys(0x81), ring(Some(40)), strip(Some(12))]);
        assert_eq!(
            decode(&mut tablet, &[17, 0x81, 0, 40, 1, 0]),
            [ring(None), strip(Some(0))],
            "keys are told once"
        );
        assert_eq!(
            decode(&mut tablet, &[17, 0, 1, 71, 0, 0]),
            [HidEvent::Keys(0), ring(Some(71)), strip(None)]
        );
        assert_eq!(decode(&mut tablet, &report[..5]), [], "cut short");
    }
}

#[test]
fn no_other_device_is_taken_for_a_pen() {
    for descriptor in [virtual_tablets::TOUCH_SCREEN, virtual_tablets::MOUSE, virtual_tablets::KEYBOARD] {
        assert!(DescriptorDecoder::new(descriptor).unwrap().is_none());
        assert!(DescriptorDecoder::of_pad(descriptor).unwrap().is_none());
    }
    assert!(DescriptorDecoder::new(virtual_tablets::WACOM_PAD).unwrap().is_none());
}

#[test]
fn reports_that_are_short_or_unknown_say_nothing() {
    let mut display = decoder(virtual_tablets::PEN_DISPLAY);
    let report = DisplayReport { switches: switch::IN_RANGE, ..Default::default() }.bytes();
    for length in 0..report.len() {
        assert_eq!(decode(&mut display, &report[..length]), [], "{length} bytes");
    }
    assert_eq!(decode(&mut display, &[9; 64]), []);
}

#[test]
fn every_cut_and_every_flipped_byte_of_a_descriptor_ends_in_an_answer() {
    for descriptor in [virtual_tablets::PEN_DISPLAY, virtual_tablets::WACOM_PAGE] {
        for place in 0..descriptor.len() {
            let _ = DescriptorDecoder::new(&descriptor[..place]);
            for value in [0x00, 0x01, 0x7F, 0x80, 0xA1, 0xC0, 0xFE, 0xFF] {
                let mut broken = descriptor.to_vec();
                broken[place] = value;
                if let Ok(Some(mut decoder)) = DescriptorDecoder::new(&broken) {
                    decode(&mut decoder, &[2; 64]);
                    decode(&mut decoder, &[0xFF; 16]);
                }
            }
        }
    }
}

proptest! {
    #[test]
    fn any_bytes_end_in_an_answer_and_any_report_in_sound_numbers(
        bytes in prop::collection::vec(any::<u8>(), 0..300),
        hits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..12),
        reports in prop::collection::vec(prop::collection::vec(any::<u8>(), 0..40), 0..20),
    ) {
        let _ = DescriptorDecoder::new(&bytes);
        let mut broken = virtual_tablets::PEN_DISPLAY.to_vec();
        for (place, value) in hits {
            let place = place.index(broken.len());
            broken[place] = value;
        }
        let Ok(Some(mut decoder)) = DescriptorDecoder::new(&broken) else { return Ok(()) };
        for mut report in reports {
            report.insert(0, 2);
            for event in decode(&mut decoder, &report) {
                let HidEvent::Pen(pen) = event else { continue };
                prop_assert!(pen.position.cmpge(DVec2::ZERO).all() && pen.position.cmple(DVec2::ONE).all());
                prop_assert!(pen.pressure.is_none_or(|p| (0.0..=1.0).contains(&p)), "{pen:?}");
                prop_assert!(pen.tilt_deg.abs().max_element() <= 90.0, "{pen:?}");
                prop_assert!((0.0..360.0).contains(&pen.twist_deg) && (0.0..=1.0).contains(&pen.distance));
            }
        }
    }
}
