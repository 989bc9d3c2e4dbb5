//! Memory of the whole program: building the largest sketch takes at most ten times the bytes that are written.
//!
//! The peak of a child process (`VmHWM` of `/proc/PID/status`) less that of one that builds a single stroke, which is
//! the program itself. The kernel forgets the number when the process is gone, so it is read again and again until then;
//! what is used only in the last moments before the end could be missed.

#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread;
use std::time::Duration;

const ONE_STROKE: &str = r#"{"format":"penstemon-sketch","version":1,
    "strokes":[{"tool":"branch","points":[[0,400],[10,200],[0,0]]}]}"#;

/// Peak memory of building a sketch and the bytes that were written.
fn build(sketch: &Path, out: &Path) -> (u64, u64) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_penstemon"))
        .args(["build".as_ref(), sketch.as_os_str(), "-o".as_ref(), out.as_os_str()])
        .stderr(Stdio::inherit())
        .spawn()
        .unwrap();
    let status = format!("/proc/{}/status", child.id());
    let mut peak = 0;
    let ended = loop {
        peak = peak.max(high_water(&status).unwrap_or(0));
        if let Some(ended) = child.try_wait().unwrap() {
            break ended;
        }
        thread::sleep(Duration::from_micros(200));
    };
    assert!(ended.success() && peak > 0, "{ended}");
    (peak, fs::metadata(out).unwrap().len())
}

/// `VmHWM` in bytes; `None` when the process has ended.
fn high_water(status: &str) -> Option<u64> {
    let text = fs::read_to_string(status).ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(1024 * line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?)
}

#[test]
fn the_peak_is_at_most_ten_times_the_result() {
    let folder = tempfile::tempdir().unwrap();
    let stroke = folder.path().join("stroke.penstemon");
    fs::write(&stroke, ONE_STROKE).unwrap();
    let (floor, _) = build(&stroke, &folder.path().join("stroke.glb"));
    let sketches = fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/sketches")).unwrap();
    let built = sketches.map(|entry| entry.unwrap().path()).map(|sketch| {
        let (peak, written) = build(&sketch, &folder.path().join("plant.glb"));
        (written, peak, sketch)
    });
    let (written, peak, sketch) = built.max().unwrap();
    let growth = peak.saturating_sub(floor);
    let ratio = growth as f64 / written as f64;
    eprintln!("{}: {growth} bytes above {floor} for {written} written: {ratio:.1} times", sketch.display());
    assert!(ratio <= 10.0, "{}: {ratio:.1} times the {written} bytes written", sketch.display());
}
