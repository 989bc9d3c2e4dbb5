//! Recordings of tablets from outside: the program plays them, and says what is wrong with broken ones.

#![cfg(feature = "program")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::virtual_tablets;
use serde_json::Value;
use std::path::PathBuf;
use std::process::{Command, Output};

use crate::virtual_tablets::{DisplayReport, switch};

fn penstemon(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_penstemon")).args(arguments).output().unwrap()
}

/// A recording of a stroke with rising pressure, written to a file of its own.
fn stroke(folder: &tempfile::TempDir) -> PathBuf {
    let hex = |bytes: &[u8]| bytes.iter().map(|byte| format!("{byte:02x}")).collect::<String>();
    let descriptor = hex(virtual_tablets::PEN_DISPLAY);
    let mut text = format!(
        "penstemon-pen-recording 1\ndevice 0\nvendor 1234\nproduct 0001\nname Display\ndescriptor {descriptor}\n"
    );
    for n in 0..=40u16 {
        let touches = if (1..40).contains(&n) { switch::TIP } else { 0 };
        let switches = switch::IN_RANGE | touches;
        let report =
            DisplayReport { switches, x: n * 800, y: 16_384, pressure: n * 100, ..Default::default() };
        text += &format!("{} {}\n", u32::from(n) * 4000, hex(&report.bytes()));
    }
    let path = folder.path().join("stroke.txt");
    std::fs::write(&path, text).unwrap();
    path
}

#[test]
fn a_recording_becomes_pen_events() {
    let folder = tempfile::tempdir().unwrap();
    let path = stroke(&folder);
    let output = penstemon(&["pen", "replay", path.to_str().unwrap(), "--json", "--size", "1000x1000"]);
    assert!(output.status.success(), "{output:?}");
    let lines = String::from_utf8(output.stdout).unwrap();
    let events: Vec<Value> = lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let phases: Vec<&str> = events.iter().map(|event| event["phase"].as_str().unwrap()).collect();
    let expected = [&["enter", "down"][..], &["move"; 38], &["up", "leave"]].concat();
    assert_eq!(phases, expected);
    for (event, n) in events[1..40].iter().zip(1..) {
        let pressure = event["pressure"].as_f64().unwrap();
        assert!((pressure - f64::from(n * 100) / 4095.0).abs() < 1e-6, "{event}");
        assert_eq!(event["time_ms"].as_f64().unwrap(), f64::from(n) * 4.0);
    }
    let text = penstemon(&["pen", "replay", path.to_str().unwrap()]);
    assert_eq!(String::from_utf8(text.stdout).unwrap().lines().count(), 42);
}

/// Plays reports of a UC-Logic tablet that keeps silent until it is woken; `lines` stand beside its numbers.
fn silent(folder: &tempfile::TempDir, lines: &str, reports: &[&str]) -> Output {
    let descriptor: String =
        virtual_tablets::SILENT_TABLET.iter().map(|byte| format!("{byte:02x}")).collect();
    let reports: String = (0..).zip(reports).map(|(n, report)| format!("{} {report}\n", n * 4000)).collect();
    let head = "penstemon-pen-recording 1\ndevice 0\nbus usb\nvendor 5543\nproduct ffff\n";
    let path = folder.path().join("silent.txt");
    std::fs::write(&path, format!("{head}{lines}descriptor {descriptor}\n{reports}")).unwrap();
    penstemon(&["pen", "replay", path.to_str().unwrap(), "--json", "--size", "1000x1000"])
}

/// The last event that touches: its place and pressure.
fn touch(output: &Output) -> ([f64; 2], f64) {
    let lines = String::from_utf8(output.stdout.clone()).unwrap();
    let events = lines.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    let down = events.into_iter().find(|event| event["phase"] == "down").unwrap();
    let side = |k: usize| down["position"][k].as_f64().unwrap();
    ([side(0), side(1)], down["pressure"].as_f64().unwrap())
}

#[test]
fn a_tablet_that_was_not_woken_draws_with_pressure_as_the_mouse_that_it_imitates() {
    let folder = tempfile::tempdir().unwrap();
    let output = silent(&folder, "", &["0900000400040000", "0901000400040004"]);
    assert!(output.status.success(), "{output:?}");
    let (place, pressure) = touch(&output);
    assert!((pressure - 1024.0 / 2047.0).abs() < 1e-6 && (place[1] - 500.0).abs() < 1e-6, "{place:?}");
}

#[test]
fn a_woken_tablet_is_read_by_the_ranges_that_its_recording_keeps() {
    let folder = tempfile::tempdir().unwrap();
    // 40000 × 40000 of 8191 at 4000 lines an inch; its descriptor says 20000 × 15000 of 2047.
    let strings = "string 100 0c03409c409c0000ff1fa00f\n";
    let output = silent(&folder, strings, &["0780204e204e0000", "0781204e204e0010", "07c0204e204e0000"]);
    let ([x, y], pressure) = touch(&output);
    assert!((x - 500.0).abs() < 1e-6 && (y - 500.0).abs() < 1e-6, "{x} {y}");
    assert!((pressure - 4096.0 / 8191.0).abs() < 1e-6, "{pressure}");
    let phases = String::from_utf8(output.stdout).unwrap();
    let phases: Vec<&str> =
        ["enter", "down", "up", "leave"].into_iter().filter(|p| phases.contains(p)).collect();
    assert_eq!(phases, ["enter", "down", "up", "leave"], "it hovers before it touches");
}

#[test]
fn a_replay_that_saw_no_pen_says_so_and_fails() {
    let folder = tempfile::tempdir().unwrap();
    let output = silent(&folder, "", &["0800000000", "0800000000"]);
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(
        message.contains("silent.txt") && message.contains("its 2 reports") && message.contains("woken"),
        "{message}"
    );
    assert!(output.stdout.is_empty());
}

#[test]
fn a_broken_recording_is_reported_with_its_place() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("broken.txt");
    std::fs::write(&path, "penstemon-pen-recording 1\ndevice 0\nvendor nobody\n").unwrap();
    let output = penstemon(&["pen", "replay", path.to_str().unwrap()]);
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(
        message.contains("broken.txt, line 3: ") && message.contains("four hexadecimal digits"),
        "{message}"
    );
}

#[test]
fn the_tablets_of_any_machine_can_be_listed() {
    let output = penstemon(&["tablets", "--json"]);
    assert!(output.status.success(), "{output:?}");
    for line in String::from_utf8(output.stdout).unwrap().lines() {
        let tablet: Value = serde_json::from_str(line).unwrap();
        assert!(tablet["path"].is_string() && tablet["read"].is_boolean());
    }
    let watched = penstemon(&["tablets", "--watch", "--seconds", "1"]);
    assert!(watched.status.success(), "{watched:?}");
}
