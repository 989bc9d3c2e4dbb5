//! A recording with the eraser end and every button of a pen drives the whole program.
//!
//! Three strokes are drawn. The eraser end removes the second, the tip with the lower button the third; the upper button
//! takes both back, and the third button of another tablet's pen removes the second again. So two strokes are left, and
//! none of the five could be missing.

use super::replay::{WINDOW, holds, kept};
use super::tablets::{DisplayReport, PEN_DISPLAY, WACOM_PAGE, switch};
use super::{empty_drawing, saved};
use crate::program::Program;
use crate::screen::Screen;
use glam::DVec2;
use penstemon::pen::hid::recording::{Entry, Recorded, RecordedDevice};
use penstemon::pen::hid::{Bus, DeviceInfo, Recording, replay};
use penstemon::pen::mapping::Rect;
use penstemon::pen::{PenEvent, PenPhase, PenTool};
use tempfile::TempDir;

const ERASER_AND_BUTTONS: &str =
    concat!(env!("CARGO_MANIFEST_DIR"), "/tests/recordings/eraser_and_buttons.txt");
const SAMPLES: u16 = 60;
/// Time between two reports, and between what is done, in microseconds.
const REPORT_US: u64 = 5_000;
const PAUSE_US: u64 = 200_000;
/// What the artist chose for the two pens.
const SETTINGS: &str = "stabiliser = \"off\"\n[pens.\"Simulated Pen Display\".uses]\nlower = \"erase\"\nupper = \"undo\"\n\
                        [pens.\"Simulated Page Tablet\".uses]\nthird = \"redo\"\n";

/// Reports of the pen display while something goes from place to place: it comes, touches, is lifted and leaves.
fn line(near: u8, touching: u8, from: [f64; 2], to: [f64; 2]) -> Vec<Vec<u8>> {
    let report = |n: u16| {
        let along = f64::from(n.clamp(1, SAMPLES) - 1) / f64::from(SAMPLES - 1);
        let touches = (1..=SAMPLES).contains(&n);
        let at = DVec2::from(from).lerp(DVec2::from(to), along) * 32768.0;
        let switches = match n {
            _ if touches => touching,
            0 => near,
            n if n == SAMPLES + 1 => near,
            _ => 0,
        };
        let pressure = if touches { 500 + 50 * n } else { 0 };
        let tilt = [1000, -2000];
        DisplayReport { switches, x: at.x as u16, y: at.y as u16, pressure, tilt, ..Default::default() }
            .bytes()
    };
    (0..=SAMPLES + 2).map(report).collect()
}

/// Reports while a button of a hovering pen is pressed and let go.
fn click(report: impl Fn(u8) -> Vec<u8>, near: u8, button: u8) -> Vec<Vec<u8>> {
    [near, near | button, near | button, near, 0].map(report).to_vec()
}

fn display_hovers(switches: u8) -> Vec<u8> {
    DisplayReport { switches, x: 8000, y: 16_000, ..Default::default() }.bytes()
}

/// The tablet with the third button, its pen over the same part of the window.
fn page_hovers(switches: u8) -> Vec<u8> {
    let mut report = vec![16, switches];
    report.extend(&11_000u32.to_le_bytes()[..3]);
    report.extend(&14_000u32.to_le_bytes()[..3]);
    report.resize(24, 0);
    report
}

fn eraser_and_buttons() -> Recording {
    let device = |name: &str, product_id: u16, descriptor: &[u8]| RecordedDevice {
        info: DeviceInfo {
            vendor_id: 0x1209,
            product_id,
            bus: Bus::Usb,
            product: name.into(),
            ..Default::default()
        },
        descriptor: descriptor.to_vec(),
        ..RecordedDevice::default()
    };
    let devices =
        vec![device("Simulated Pen Display", 1, PEN_DISPLAY), device("Simulated Page Tablet", 3, WACOM_PAGE)];
    let (near, tip) = (switch::IN_RANGE, switch::IN_RANGE | switch::TIP);
    let turned = near | switch::INVERT;
    let undo = || click(display_hovers, near, switch::SECOND_BARREL);
    let acts = [
        (0, line(near, tip, [0.12, 0.35], [0.38, 0.40])),
        (0, line(near, tip, [0.14, 0.45], [0.36, 0.55])),
        (0, line(near, tip, [0.12, 0.70], [0.30, 0.62])),
        (0, line(turned, turned | switch::ERASER, [0.25, 0.44], [0.25, 0.58])),
        (0, line(near | switch::BARREL, tip | switch::BARREL, [0.20, 0.61], [0.20, 0.72])),
        (0, undo()),
        (0, undo()),
        (1, click(page_hovers, 0x40, 0x08)),
    ];
    let (mut entries, mut time_us) = (Vec::new(), 0);
    for (device, reports) in acts {
        for report in reports {
            entries.push(Entry { time_us, device, what: Recorded::Report(report) });
            time_us += REPORT_US;
        }
        time_us += PAUSE_US;
    }
    Recording { devices, entries }
}

#[test]
fn eraser_and_buttons_of_a_recording_do_what_was_chosen_for_them() {
    let recording = kept(ERASER_AND_BUTTONS, &eraser_and_buttons());
    let target = Rect { min: DVec2::ZERO, max: DVec2::new(WINDOW.0.into(), WINDOW.1.into()) };
    let mut touches: Vec<Vec<PenEvent>> = Vec::new();
    let mut presses = [0; 2];
    let unread = replay::play(&recording, target, &mut |_, event| {
        let buttons = event.sample.buttons;
        match event.phase {
            PenPhase::Down => touches.push(vec![*event]),
            PenPhase::Move => touches.last_mut().unwrap().push(*event),
            PenPhase::Hover => {
                presses[0] += i32::from(buttons.middle);
                presses[1] += i32::from(buttons.third);
            }
            _ => {}
        }
    });
    assert_eq!(unread, []);
    assert_eq!(presses, [4, 2], "samples with the upper button twice, with the third once");
    let seen: Vec<_> =
        touches.iter().map(|t| (t[0].sample.tool, t[0].sample.buttons.secondary, t.len())).collect();
    let all = usize::from(SAMPLES);
    let (pen, eraser, with_button) =
        ((PenTool::Pen, false, all), (PenTool::Eraser, false, all), (PenTool::Pen, true, all));
    assert_eq!(seen, [pen, pen, pen, eraser, with_button]);

    let (screen, home) = (Screen::beside_others(WINDOW.0, WINDOW.1), TempDir::new().unwrap());
    let file = empty_drawing(home.path());
    let settings = home.path().join(".config/penstemon");
    std::fs::create_dir_all(&settings).unwrap();
    std::fs::write(settings.join("settings.toml"), SETTINGS).unwrap();
    let args = ["pen", "replay", ERASER_AND_BUTTONS, "--window", file.to_str().unwrap()];
    let mut program = Program::start(&screen, home.path(), &args);
    program.wait_for("tablet Simulated Page Tablet is gone");
    program.rest();
    let built = program.last_logged("built revision");
    assert!(built.contains(" strokes=2 "), "{built}");
    screen.hand(&["key", "ctrl+s"]);
    program.wait_for("saved");
    screen.hand(&["key", "ctrl+q"]);
    assert!(program.wait().success());
    for bad in ["notice", "ERROR penstemon", "WARN penstemon", "panicked"] {
        assert!(!program.has_logged(bad), "{bad}");
    }
    let left = [touches.swap_remove(0), touches.swap_remove(2)];
    holds(&saved(&file), &left);
}
