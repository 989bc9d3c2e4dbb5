//! Tests of recordings: round trips, hostile files, and playing them.

use super::*;
use crate::pen::grammar::Grammar;
use crate::pen::hid::made_up::{self as tablets, DisplayReport, switch};
use crate::pen::hid::reader::{Notice, Reader, queue};
use crate::pen::hid::{
    DeviceInfo, Enumerate as _, HidEvent, KnownStrings, StringsKept, choose_decoder, recording, replay,
};
use crate::pen::mapping::Rect;
use crate::pen::{PenPhase, PenTool};
use glam::DVec2;
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::time::{Duration, Instant};

fn device(vendor_id: u16, descriptor: &[u8]) -> RecordedDevice {
    let info = DeviceInfo {
        path: "/dev/hidraw3".into(),
        vendor_id,
        product_id: 0x0357,
        bus: Bus::Bluetooth,
        product: "Pen Display 13 – Ünïcode".into(),
        manufacturer: "Maker Co.,Ltd.".into(),
        serial: String::new(),
        usage: (0x0D, 0x02),
        interface: Some(1),
    };
    RecordedDevice { info, descriptor: descriptor.to_vec(), ..RecordedDevice::default() }
}

/// A stroke with rising pressure, 5 ms a sample, and then the device is unplugged while the pen touches.
fn stroke() -> Recording {
    let report = |ms: u16| {
        let touches = if ms >= 10 { switch::TIP } else { 0 };
        let switches = switch::IN_RANGE | touches;
        let report =
            DisplayReport { switches, x: ms * 100, y: 16_384, pressure: ms * 40, ..Default::default() };
        let what = Recorded::Report(report.bytes());
        Entry { time_us: u64::from(ms) * 1000, device: 0, what }
    };
    let mut entries: Vec<Entry> = (0..20).map(|n| report(n * 5)).collect();
    entries.push(Entry { time_us: 100_000, device: 0, what: Recorded::Gone });
    Recording { devices: vec![device(0x056A, tablets::PEN_DISPLAY)], entries }
}

fn window() -> Rect {
    Rect { min: DVec2::ZERO, max: DVec2::new(1920.0, 1080.0) }
}

fn fault(text: &str) -> (usize, LineFault) {
    match Recording::from_bytes(text.as_bytes(), "pen.txt").unwrap_err() {
        RecordingError::Line { line, fault, .. } => (line, fault),
        error => panic!("{error}"),
    }
}

#[test]
fn a_recording_is_read_as_it_was_written() {
    let mut recording = stroke();
    let strings = BTreeMap::from([(200, vec![4, 3, 0xA0, 0xD7]), (201, vec![2, 3])]);
    recording.devices.push(RecordedDevice { strings, ..device(0x256C, tablets::DESK_TABLET) });
    recording.entries.push(Entry { time_us: 100_000, device: 1, what: Recorded::Report(vec![0, 1, 2]) });
    let text = recording.to_text();
    assert_eq!(Recording::from_bytes(text.as_bytes(), "pen.txt").unwrap(), recording);
    assert!(
        text.starts_with("penstemon-pen-recording 1\ndevice 0\nbus bluetooth\nvendor 056a\nproduct 0357\n")
    );
    assert!(text.ends_with("100000 gone\n100000 1:000102\n"), "{text}");
}

#[test]
fn a_serial_number_is_not_written() {
    let mut recording = stroke();
    recording.devices[0].info.serial = "SECRET-7".into();
    assert!(!recording.to_text().contains("SECRET-7"));
}

#[test]
fn faults_are_reported_with_file_line_reason_and_remedy() {
    use LineFault::*;
    let with = |lines: &str| fault(&format!("{FIRST_LINE}\n{lines}"));
    let head = "device 0\nvendor 056a\nproduct 0001\ndescriptor 050d\n";
    assert_eq!(fault(""), (1, FirstLine));
    assert_eq!(fault("penstemon-pen-recording 2\n"), (1, FirstLine));
    assert_eq!(with("bus usb"), (2, NoDevice));
    assert_eq!(with("5 00"), (2, NoDevice));
    assert_eq!(with("device 1"), (2, DeviceNumber(0)));
    assert_eq!(with("device 0\ncolour red"), (3, Word("colour".into())));
    assert_eq!(with("device 0\nvendor 056a\nvendor 056a"), (4, Twice("vendor")));
    assert!(matches!(with("device 0\nvendor 56a"), (3, Value { key: "vendor", .. })));
    assert!(matches!(with("device 0\nbus ps2"), (3, Value { key: "bus", .. })));
    assert_eq!(with("string 201 0203"), (2, NoDevice));
    for wrong in ["string 201", "string 256 0203", "string 201 020", "string 201 "] {
        assert!(matches!(with(&format!("device 0\n{wrong}")), (3, Value { key: "string", .. })), "{wrong}");
    }
    assert_eq!(with("device 0\nstring 4 0203\nstring 5 0203\nstring 4 0203"), (5, Twice("string")));
    assert!(matches!(with("device 0\ndescriptor 0"), (3, Value { key: "descriptor", .. })));
    assert!(matches!(with(&format!("device 0\nname {}", "x".repeat(300))), (3, Value { key: "name", .. })));
    assert_eq!(with("device 0\nvendor 056a\n0 00"), (4, Missing { device: 0, key: "product" }));
    assert_eq!(with("device 0\nvendor 056a\n"), (4, Missing { device: 0, key: "product" }));
    assert_eq!(with(&format!("{head}0 1:00")), (6, UnknownDevice("1".into())));
    assert_eq!(with(&format!("{head}9 00\n8 00")), (7, Time));
    assert_eq!(with(&format!("{head}99999999999999 00")), (6, Time));
    assert_eq!(with(&format!("{head}9 0")), (6, Report));
    assert_eq!(with(&format!("{head}9 ")), (6, Report));
    assert_eq!(with(&format!("{head}9 gone\n9 00")), (7, WasGone(0)));
    let message = Recording::from_bytes(b"\xFF", "pen.txt").unwrap_err().to_string();
    assert!(message.starts_with("pen.txt, line 1: ") && message.contains("get it again"), "{message}");
    let message = Recording::open(Path::new("/nowhere/pen.txt")).unwrap_err().to_string();
    assert!(message.starts_with("/nowhere/pen.txt: ") && message.contains("check the name"), "{message}");
}

#[test]
fn a_played_stroke_has_its_times_places_and_pressures() {
    let (recording, mut events) = (stroke(), Vec::new());
    assert_eq!(replay::play(&recording, window(), &mut |_, event| events.push(*event)), []);
    let mut grammar = Grammar::default();
    events.iter().for_each(|event| assert_eq!(grammar.accept(event), Ok(())));
    let moves: Vec<_> = events.iter().filter(|e| e.phase == PenPhase::Move).collect();
    assert_eq!(moves.len(), 17);
    for (event, n) in moves.iter().zip(3u16..) {
        assert_eq!(event.sample.time_ms, f64::from(n) * 5.0);
        assert_eq!(event.sample.pressure, (f64::from(n * 200) / 4095.0) as f32);
        assert!((event.sample.position.x - f64::from(n) * 500.0 / 32768.0 * 1920.0).abs() < 1e-9);
    }
    let ends: Vec<_> =
        events.iter().rev().take(2).map(|e| (e.phase, e.sample.tool, e.sample.time_ms)).collect();
    let unplugged = [(PenPhase::Leave, PenTool::Pen, 100.0), (PenPhase::Up, PenTool::Pen, 100.0)];
    assert_eq!(ends, unplugged, "the unplugged tablet's stroke counts");
}

#[test]
fn a_device_that_is_no_pen_is_named() {
    let recording =
        Recording { devices: vec![device(1, tablets::MOUSE), device(2, &[0xC0])], entries: vec![] };
    let unread = replay::play(&recording, window(), &mut |_, _| panic!("nothing happened"));
    assert_eq!(unread.iter().map(|u| u.device).collect::<Vec<_>>(), [0, 1]);
}

#[test]
fn a_device_that_says_nothing_of_a_pen_is_reported() {
    let mut recording = stroke();
    recording.entries = vec![Entry { time_us: 0, device: 0, what: Recorded::Report(vec![9, 0, 1]) }];
    let unread = replay::play(&recording, window(), &mut |_, _| panic!("nothing happened"));
    assert!(
        unread[0].device == 0
            && unread[0].reason.contains("its 1 report")
            && unread[0].reason.contains("not woken"),
        "{unread:?}"
    );
    let empty = Recording { entries: Vec::new(), ..stroke() };
    assert_eq!(replay::play(&empty, window(), &mut |_, _| {}), [], "it was not asked");
}

#[test]
fn strings_that_hold_the_serial_number_are_not_kept() {
    let text = crate::pen::hid::strings::descriptor;
    let strings = BTreeMap::from([(2, text("Tablet")), (3, text("A")), (5, text("no. SECRET-7"))]);
    let mut strings = KnownStrings { strings, ..KnownStrings::none(StringsKept::Unanswered) };
    let device = DeviceInfo { serial: "SECRET-7 ".into(), ..DeviceInfo::default() };
    assert_eq!(recording::strings_to_keep(&device, &mut strings), BTreeMap::from([(2, text("Tablet"))]));
}

#[test]
fn a_replayed_device_is_read_like_a_real_one() {
    let recording = stroke();
    let mut bus = replay::bus(&recording, None);
    let info = bus.devices().unwrap().remove(0);
    let transport = bus.open(&info).unwrap();
    let choice = choose_decoder(&info, transport.descriptor()).unwrap().unwrap();
    let (outbox, inbox) = queue(|| {}, Instant::now());
    let reader = Reader::start(0, transport, choice, outbox).unwrap();
    let begin = Instant::now();
    while !reader.is_finished() && begin.elapsed() < Duration::from_secs(60) {
        std::thread::yield_now();
    }
    let mut pressures = Vec::new();
    inbox.drain(|message| match message.notice {
        Notice::Said(HidEvent::Pen(pen)) if pen.touches => pressures.extend(pen.pressure),
        _ => {}
    });
    assert_eq!(pressures.len(), 18);
    assert!(pressures.is_sorted());
}

#[test]
fn a_stage_waits_and_plays_once() {
    let stage = replay::Stage::new(stroke());
    let mut system = stage.clone();
    assert_eq!(system.devices(), Ok(vec![]));
    stage.begin();
    let devices = system.devices().unwrap();
    assert_eq!((devices.len(), system.devices().unwrap().len()), (1, 1));
    assert_eq!(system.descriptor(&devices[0]).unwrap(), tablets::PEN_DISPLAY);
    let (mut transport, mut buffer, mut reports) = (system.open(&devices[0]).unwrap(), [0; 64], 0);
    assert_eq!(system.devices(), Ok(vec![]), "what was opened does not come again");
    while let Ok(length) = transport.read(&mut buffer, Duration::from_secs(60)) {
        reports += usize::from(length > 0);
    }
    assert_eq!(reports, stroke().entries.iter().filter(|e| matches!(e.what, Recorded::Report(_))).count());
}

proptest! {
    #[test]
    fn any_text_ends_in_a_recording_or_a_fault(text in "(\\PC|\n){0,200}", bytes: Vec<u8>) {
        let _ = Recording::from_bytes(&bytes, "any");
        if let Ok(read) = Recording::from_bytes(format!("{FIRST_LINE}\n{text}").as_bytes(), "any") {
            prop_assert_eq!(Recording::from_bytes(read.to_text().as_bytes(), "again").unwrap(), read);
        }
    }

    #[test]
    fn one_damaged_byte_never_panics_and_what_is_read_can_be_written(place: prop::sample::Index, byte: u8) {
        let mut bytes = stroke().to_text().into_bytes();
        let place = place.index(bytes.len());
        bytes[place] = byte;
        if let Ok(read) = Recording::from_bytes(&bytes, "damaged") {
            prop_assert_eq!(&Recording::from_bytes(read.to_text().as_bytes(), "again").unwrap(), &read);
            let mut grammar = Grammar::default();
            replay::play(&read, window(), &mut |_, event| assert_eq!(grammar.accept(event), Ok(())));
        }
    }
}
