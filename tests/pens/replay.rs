//! Recordings in `tests/recordings/` drive the whole program: the same strokes every time.
//!
//! The recordings are made here, of made-up tablets; `INSTA_UPDATE=always` writes them anew.

use super::tablets::{DESK_TABLET, DisplayReport, PEN_DISPLAY, switch};
use super::{empty_drawing, saved};
use crate::program::Program;
use crate::screen::Screen;
use glam::DVec2;
use penstemon::pen::hid::recording::{Entry, Recorded, RecordedDevice};
use penstemon::pen::hid::{Bus, DeviceInfo, Recording, replay};
use penstemon::pen::mapping::Rect;
use penstemon::pen::{PenEvent, PenPhase};
use penstemon::sketch::Sketch;
use std::f64::consts::TAU;
use tempfile::TempDir;

const TWO_TABLETS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/recordings/two_tablets.txt");
const SAMPLES: u16 = 120;
/// Time between two reports, and between two strokes, in microseconds.
const REPORT_US: u64 = 5_000;
const PAUSE_US: u64 = 300_000;
pub(crate) const WINDOW: (u32, u32) = (1280, 800);

/// One report of a pen: where, how strongly, and which way it leans.
struct Held {
    touches: bool,
    in_range: bool,
    at: DVec2,
    pressure: f64,
    tilt_deg: DVec2,
}

fn of_display(held: &Held) -> Vec<u8> {
    let set = |is_set: bool, bit: u8| if is_set { bit } else { 0 };
    let report = DisplayReport {
        switches: set(held.touches, switch::TIP) | set(held.in_range, switch::IN_RANGE),
        x: (held.at.x * 32768.0) as u16,
        y: (held.at.y * 32768.0) as u16,
        pressure: (held.pressure * 4095.0) as u16,
        tilt: [(held.tilt_deg.x * 100.0) as i16, (held.tilt_deg.y * 100.0) as i16],
        ..DisplayReport::default()
    };
    report.bytes()
}

fn of_desk(held: &Held) -> Vec<u8> {
    let mut bytes = vec![0, u8::from(held.touches) | u8::from(held.in_range) << 7];
    let steps = [held.at.x * 50800.0, held.at.y * 31750.0, held.pressure * 8191.0];
    steps.iter().for_each(|value| bytes.extend((*value as u16).to_le_bytes()));
    bytes.extend([held.tilt_deg.x as i8 as u8, held.tilt_deg.y as i8 as u8]);
    bytes
}

/// A stroke from place to place: the pen comes, touches, sways, presses more and more, is lifted and goes.
fn stroke(from: [f64; 2], to: [f64; 2]) -> Vec<Held> {
    let held = |n: u16| {
        let along = f64::from(n.clamp(1, SAMPLES) - 1) / f64::from(SAMPLES - 1);
        let touches = (1..=SAMPLES).contains(&n);
        let sway = DVec2::new((along * TAU).sin(), 0.0) * 0.02;
        Held {
            touches,
            in_range: n <= SAMPLES + 1,
            at: DVec2::from(from).lerp(DVec2::from(to), along) + sway,
            pressure: if touches { 0.05 + 0.9 * along } else { 0.0 },
            tilt_deg: DVec2::new(-40.0 + 90.0 * along, 30.0 - 60.0 * along).trunc(),
        }
    };
    (0..=SAMPLES + 2).map(held).collect()
}

/// A pen display draws twice, a tablet on the desk once in between.
fn two_tablets() -> Recording {
    let device = |name: &str, product_id: u16, bus: Bus, descriptor: &[u8]| RecordedDevice {
        info: DeviceInfo { vendor_id: 0x1209, product_id, bus, product: name.into(), ..Default::default() },
        descriptor: descriptor.to_vec(),
        ..RecordedDevice::default()
    };
    let devices = vec![
        device("Simulated Pen Display", 1, Bus::Usb, PEN_DISPLAY),
        device("Simulated Desk Tablet", 2, Bus::Bluetooth, DESK_TABLET),
    ];
    let strokes = [
        (0, stroke([0.12, 0.35], [0.38, 0.40])),
        (1, stroke([0.14, 0.45], [0.36, 0.55])),
        (0, stroke([0.12, 0.70], [0.30, 0.62])),
    ];
    let (mut entries, mut time_us) = (Vec::new(), 0);
    for (device, stroke) in strokes {
        for held in &stroke {
            let report = if device == 0 { of_display(held) } else { of_desk(held) };
            entries.push(Entry { time_us, device, what: Recorded::Report(report) });
            time_us += REPORT_US;
        }
        time_us += PAUSE_US;
    }
    Recording { devices, entries }
}

/// The recording opened in the window and saved as a drawing.
fn drawn() -> Sketch {
    let (screen, home) = (Screen::beside_others(WINDOW.0, WINDOW.1), TempDir::new().unwrap());
    let file = empty_drawing(home.path());
    // Places are kept as the pen told them.
    let settings = home.path().join(".config/penstemon");
    std::fs::create_dir_all(&settings).unwrap();
    std::fs::write(settings.join("settings.toml"), "stabiliser = \"off\"\n").unwrap();
    let args = ["pen", "replay", TWO_TABLETS, "--window", file.to_str().unwrap()];
    let mut program = Program::start(&screen, home.path(), &args);
    program.built_of(3);
    screen.hand(&["key", "ctrl+s"]);
    program.wait_for("saved");
    screen.hand(&["key", "ctrl+q"]);
    assert!(program.wait().success());
    for bad in ["notice", "ERROR penstemon", "WARN penstemon", "panicked"] {
        assert!(!program.has_logged(bad), "{bad}");
    }
    saved(&file)
}

/// Panics unless the drawing's strokes are these, sample for sample.
pub(crate) fn holds(sketch: &Sketch, strokes: &[Vec<PenEvent>]) {
    assert_eq!(sketch.strokes.len(), strokes.len());
    // Where the canvas is: one length of the window is one length of the sheet.
    let (first, last) = (strokes[0].first().unwrap(), strokes[0].last().unwrap());
    let on_sheet = |n: usize| sketch.strokes[0].points[n].position.as_dvec2();
    let span = (on_sheet(strokes[0].len() - 1) - on_sheet(0)).length();
    let scale = span / (last.sample.position - first.sample.position).length();
    for (stroke, events) in sketch.strokes.iter().zip(strokes) {
        assert_eq!(stroke.points.len(), events.len());
        for (point, event) in stroke.points.iter().zip(events) {
            let context = format!("{point:?} of {event:?}");
            let place = on_sheet(0) + scale * (event.sample.position - first.sample.position);
            assert!(point.position.as_dvec2().distance(place) < 0.01, "{context}: not at {place}");
            assert!((point.pressure - event.sample.pressure).abs() < 1e-3, "{context}");
            assert!((point.tilt_deg - event.sample.tilt_deg).abs().max_element() < 0.1, "{context}");
        }
    }
}

/// The recording in a file of the tests, which holds what is made here; `INSTA_UPDATE=always` writes it.
pub(crate) fn kept(path: &str, made: &Recording) -> Recording {
    let text = made.to_text();
    if std::env::var("INSTA_UPDATE").is_ok_and(|value| value == "always") {
        std::fs::write(path, &text).unwrap();
    }
    assert_eq!(std::fs::read_to_string(path).unwrap(), text, "INSTA_UPDATE=always writes it");
    Recording::from_bytes(text.as_bytes(), path).unwrap()
}

#[test]
fn a_recording_draws_the_same_strokes_every_time() {
    let recording = kept(TWO_TABLETS, &two_tablets());
    let target = Rect { min: DVec2::ZERO, max: DVec2::new(WINDOW.0.into(), WINDOW.1.into()) };
    let mut strokes: Vec<Vec<PenEvent>> = Vec::new();
    let unread = replay::play(&recording, target, &mut |_, event| match event.phase {
        PenPhase::Down => strokes.push(vec![*event]),
        PenPhase::Move => strokes.last_mut().unwrap().push(*event),
        _ => {}
    });
    assert_eq!(unread, []);

    let [sketch, again] = [drawn(), drawn()];
    holds(&sketch, &strokes);
    for (stroke, same) in sketch.strokes.iter().zip(&again.strokes) {
        assert_eq!(stroke.points.len(), same.points.len());
        for (point, same) in stroke.points.iter().zip(&same.points) {
            assert_eq!(
                (point.position, point.pressure, point.tilt_deg),
                (same.position, same.pressure, same.tilt_deg),
                "drawn again"
            );
        }
    }
}
