//! Report descriptors of many devices: every pen decodes, nothing else is taken for one.
//!
//! Besides made-up devices, every `*.bin` of the folder named by `PENSTEMON_HID_DESCRIPTORS`, or of `../shared/data/hid`
//! where that is there. What those should say is worked out here a second time, plainly, from the descriptor's own fields.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::print_stderr, reason = "says what could not run")]

use glam::{DVec2, Vec2};
use hidreport::{Field, Report, ReportDescriptor, VariableField};
use penstemon::pen::hid::{Abilities, Decode, DescriptorDecoder, HidEvent, RawPen, TypedReports};
use proptest::prelude::*;
use std::path::{Path, PathBuf};

#[path = "common/not_run.rs"]
mod not_run;
#[path = "common/tablets.rs"]
#[allow(dead_code, reason = "shared with other tests")]
mod tablets;

use tablets::{DisplayReport, switch};

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
    let mut display = decoder(tablets::PEN_DISPLAY);
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
    let mut display = decoder(tablets::PEN_DISPLAY);
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
    let mut display = decoder(tablets::PEN_DISPLAY);
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

/// [`tablets::DESK_TABLET`] with another unit of its area and other numbers of steps and of physical units on its axes.
fn desk_tablet_with_area(unit: u8, steps: [u16; 2], physical: [u16; 2]) -> Vec<u8> {
    let [x, y] = steps.map(u16::to_le_bytes);
    let [width, height] = physical.map(u16::to_le_bytes);
    let [head, tail] = [&tablets::DESK_TABLET[..38], &tablets::DESK_TABLET[70..]];
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
    let mut display = decoder(tablets::PEN_DISPLAY);
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
    let mut tablet = decoder(tablets::DESK_TABLET);
    assert!(tablet.area_mm().unwrap().abs_diff_eq(DVec2::new(254.0, 158.75), 1e-9));
    let report = [0, 0b1000_0011, 0x38, 0x63, 0x06, 0x7C, 0xFF, 0x1F, (-30i8) as u8, 60];
    let pen = decode_pen(&mut tablet, &report).unwrap();
    assert!(pen.in_range && pen.touches && !pen.eraser);
    assert_eq!((pen.barrel, pen.pressure), ([true, false, false], Some(1.0)));
    assert_eq!((pen.position, pen.tilt_deg), (DVec2::new(0.5, 1.0), Vec2::new(-30.0, 60.0)));
}

#[test]
fn wacoms_own_page_is_read_like_the_standard_one() {
    let mut tablet = decoder(tablets::WACOM_PAGE);
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
fn no_other_device_is_taken_for_a_pen() {
    for descriptor in [tablets::TOUCH_SCREEN, tablets::MOUSE, tablets::KEYBOARD] {
        assert!(DescriptorDecoder::new(descriptor).unwrap().is_none());
    }
}

#[test]
fn reports_that_are_short_or_unknown_say_nothing() {
    let mut display = decoder(tablets::PEN_DISPLAY);
    let report = DisplayReport { switches: switch::IN_RANGE, ..Default::default() }.bytes();
    for length in 0..report.len() {
        assert_eq!(decode(&mut display, &report[..length]), [], "{length} bytes");
    }
    assert_eq!(decode(&mut display, &[9; 64]), []);
}

#[test]
fn every_cut_and_every_flipped_byte_of_a_descriptor_ends_in_an_answer() {
    for descriptor in [tablets::PEN_DISPLAY, tablets::WACOM_PAGE] {
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

/// Where the real descriptors are, if they are.
fn folder() -> Option<PathBuf> {
    let named = std::env::var_os("PENSTEMON_HID_DESCRIPTORS").map(PathBuf::from);
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/hid");
    named.or(Some(beside)).filter(|folder| folder.is_dir())
}

fn descriptors(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let paths = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut paths: Vec<PathBuf> = paths.filter(|path| path.extension().is_some_and(|e| e == "bin")).collect();
    paths.sort();
    paths.iter().map(|p| (p.file_name().unwrap().display().to_string(), std::fs::read(p).unwrap())).collect()
}

/// The fields of a report that stand in a pen's collections, as the descriptor names them.
struct PenReport {
    id: Option<u8>,
    bytes: usize,
    fields: Vec<VariableField>,
}

fn is_pen_collection(field: &VariableField) -> bool {
    let usages: Vec<u32> =
        field.collections.iter().map(|c| c.usages().first().map_or(0, u32::from)).collect();
    let is_tablet = matches!(usages.first(), Some(0x000D_0001 | 0x000D_0002 | 0xFF0D_0001 | 0xFF0D_0002));
    is_tablet && !usages.iter().any(|usage| matches!(usage & 0xFFFF, 0x21 | 0x22))
}

fn find<'a>(fields: &'a [VariableField], usages: &[u32]) -> Option<&'a VariableField> {
    fields.iter().find(|field| usages.contains(&u32::from(field.usage)))
}

const X: [u32; 2] = [0x0001_0030, 0xFF0D_0130];
const Y: [u32; 2] = [0x0001_0031, 0xFF0D_0131];
const TIP: [u32; 2] = [0x000D_0042, 0xFF0D_0042];
const IN_RANGE: [u32; 2] = [0x000D_0032, 0xFF0D_0032];
const PRESSURE: [u32; 2] = [0x000D_0030, 0xFF0D_0030];
const TILT: [[u32; 2]; 2] = [[0x000D_003D, 0xFF0D_003D], [0x000D_003E, 0xFF0D_003E]];

/// Reports with position, tip and pressure of a pen, by a plain reading of the descriptor; `None` where that cannot be had.
fn pen_reports(descriptor: &[u8]) -> Option<Vec<PenReport>> {
    let parsed = ReportDescriptor::try_from(descriptor).ok()?;
    let reports = parsed.input_reports().iter().map(|report| {
        let fields = report.fields().iter().filter_map(|field| match field {
            Field::Variable(field) if is_pen_collection(field) => Some(field.clone()),
            _ => None,
        });
        let (id, bytes) = (report.report_id().map(u8::from), report.size_in_bytes());
        PenReport { id, bytes, fields: fields.collect() }
    });
    Some(reports.filter(|r| [X, Y, TIP, PRESSURE].iter().all(|u| find(&r.fields, u).is_some())).collect())
}

/// Least and greatest number of a field as the descriptor writes them, whatever their size.
fn range(field: &VariableField) -> (i64, i64) {
    let (low, high) = (i32::from(field.logical_minimum), i32::from(field.logical_maximum));
    let mask = (1u64 << field.bits.len().min(32)) - 1;
    let high = if high < low { (high as u64 & mask) as i64 } else { i64::from(high) };
    (i64::from(low), high)
}

fn write_bits(report: &mut [u8], field: &VariableField, shift: usize, value: i64) {
    for (number, bit) in field.bits.clone().enumerate() {
        let (byte, bit) = ((bit + shift) / 8, (bit + shift) % 8);
        let set = value >> number.min(63) & 1 == 1;
        report[byte] = report[byte] & !(1 << bit) | u8::from(set) << bit;
    }
}

/// A touching report with every range field at this share of its range, and what it should say.
fn synthesise(pen: &PenReport, share: f64) -> (Vec<u8>, RawPen) {
    let shift = if pen.id.is_some() { 0 } else { 8 };
    let mut report = vec![0; pen.bytes + shift / 8];
    report[0] = pen.id.unwrap_or(0);
    let number_at = |field: &VariableField| {
        let (low, high) = range(field);
        low + ((high - low) as f64 * share).round() as i64
    };
    let exact = |field: &VariableField| {
        let (low, high) = range(field);
        (number_at(field) - low) as f64 / (high - low) as f64
    };
    let mut expected = RawPen { in_range: true, touches: true, ..RawPen::default() };
    for usages in [TIP, IN_RANGE] {
        find(&pen.fields, &usages).inspect(|field| write_bits(&mut report, field, shift, 1));
    }
    for usages in [X, Y, PRESSURE, TILT[0], TILT[1]] {
        find(&pen.fields, &usages).inspect(|field| write_bits(&mut report, field, shift, number_at(field)));
    }
    let share_of = |usages: &[u32]| exact(find(&pen.fields, usages).unwrap());
    expected.position = DVec2::new(share_of(&X), share_of(&Y));
    expected.pressure = Some(share_of(&PRESSURE) as f32);
    let tilt = TILT.map(|usages| {
        find(&pen.fields, &usages).map_or(0.0, |field| {
            // Units that are angles are taken as the descriptor says it; everything else is whole degrees.
            let number = number_at(field) as f64;
            let degrees = match (field.unit.map_or(0, u32::from), range(field)) {
                (0x14, (0, 18_000)) => (number - 9_000.0) / 100.0,
                (0x14, (_, 9_000)) => number / 100.0,
                _ => number,
            };
            degrees.clamp(-90.0, 90.0) as f32
        })
    });
    expected.tilt_deg = Vec2::from(tilt);
    (report, expected)
}

#[test]
fn every_real_pen_decodes_and_nothing_else_does() {
    let Some(folder) = folder() else {
        let why = "no folder of real report descriptors; name one with PENSTEMON_HID_DESCRIPTORS";
        not_run::not_run("every_real_pen_decodes_and_nothing_else_does", why);
        return;
    };
    let (mut read, mut pens, mut sized, mut tilted, mut reports) = (0, 0, 0, 0, 0);
    let mut wrong = Vec::new();
    let all = descriptors(&folder);
    for (name, descriptor) in &all {
        let decoder = DescriptorDecoder::new(descriptor);
        read += usize::from(decoder.is_ok());
        let expected = pen_reports(descriptor);
        let (Ok(decoder), Some(expected)) = (decoder, expected) else {
            eprintln!("not compared: {name}");
            continue;
        };
        match (&decoder, expected.is_empty()) {
            (None, false) => wrong.push(format!("{name}: a pen was not seen")),
            (Some(_), true) => wrong.push(format!("{name}: taken for a pen")),
            _ => {}
        }
        let Some(mut decoder) = decoder else { continue };
        pens += 1;
        sized += usize::from(decoder.area_mm().is_some());
        tilted += usize::from(decoder.abilities().tilt);
        for (pen, share) in expected.iter().flat_map(|pen| [0.0, 0.5, 1.0].map(|share| (pen, share))) {
            let (report, expected) = synthesise(pen, share);
            reports += 1;
            if TypedReports::of(descriptor).holds(&report) {
                wrong.push(format!("{name}: {report:02x?} is taken for something typed"));
            }
            match decode_pen(&mut decoder, &report) {
                Some(pen) if is_close(&pen, &expected) => {}
                pen => wrong.push(format!("{name}: {report:02x?} became {pen:?}, not {expected:?}")),
            }
        }
    }
    eprintln!(
        "{} descriptors, {read} read, {pens} pens, {sized} with their size, {tilted} with tilt, {reports} reports",
        all.len()
    );
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong.join("\n"));
    assert!(pens > 0, "{} holds no pen", folder.display());
}

fn is_close(pen: &RawPen, expected: &RawPen) -> bool {
    let pressure = pen.pressure.zip(expected.pressure).is_some_and(|(a, b)| (a - b).abs() < 1e-6);
    pen.in_range
        && pen.touches
        && pressure
        && pen.position.abs_diff_eq(expected.position, 1e-9)
        && pen.tilt_deg.abs_diff_eq(expected.tilt_deg, 1e-3)
}

proptest! {
    #[test]
    fn any_bytes_end_in_an_answer_and_any_report_in_sound_numbers(
        bytes in prop::collection::vec(any::<u8>(), 0..300),
        hits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..12),
        reports in prop::collection::vec(prop::collection::vec(any::<u8>(), 0..40), 0..20),
    ) {
        let _ = DescriptorDecoder::new(&bytes);
        let mut broken = tablets::PEN_DISPLAY.to_vec();
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
