//! Copies that cannot be written or read: full disk, no folder, damage, a newer program.

use super::{PATIENCE, begin, draw, file, stroke};
use penstemon::sketch::Change;
use penstemon::sketch::journal::{JournalError, JournalState, Recovery};
use std::env;
use std::fs::{self, File};
use std::process::Command;

#[test]
fn copies_of_a_newer_program_are_kept_and_said_to_be_so() {
    let state = tempfile::tempdir().unwrap();
    let recovery = Recovery::at(state.path());
    let (mut document, mut writer) = begin(&recovery, "from the future");
    draw(&mut document, &mut writer, 2);
    drop(writer);
    let newer = |start: &str, old: &str, new: &str| {
        let path = file(state.path(), start);
        let text = String::from_utf8(fs::read(&path).unwrap()).unwrap();
        fs::write(&path, text.replacen(old, new, 1)).unwrap();
        let found = recovery.list().unwrap().pop().unwrap();
        fs::write(&path, text).unwrap();
        assert_eq!(found.meta.title, "from the future");
        let error = recovery.resume(found).unwrap_err();
        assert!(matches!(error, JournalError::NewerVersion { version: 9.0, .. }), "{error}");
        assert!(error.to_string().contains("newer Penstemon (version 9)"), "{error}");
    };
    newer("snapshot", "\"version\": 1", "\"version\": 9");
    newer("journal", "journal 1", "journal 9");
    assert_eq!(recovery.list().unwrap()[0].strokes(), 2);
}

#[test]
fn a_damaged_copy_is_told_and_kept_until_it_is_discarded() {
    let state = tempfile::tempdir().unwrap();
    let recovery = Recovery::at(state.path());
    let (mut document, mut writer) = begin(&recovery, "damaged");
    draw(&mut document, &mut writer, 2);
    drop(writer);
    let snapshot = file(state.path(), "snapshot");
    File::options().write(true).open(&snapshot).unwrap().set_len(100).unwrap();
    let found = recovery.list().unwrap().pop().unwrap();
    let message = found.content.as_ref().unwrap_err().to_string();
    assert!(message.contains("is damaged") && message.contains("snapshot-1"), "{message}");
    assert!(snapshot.exists());
    recovery.discard(found).unwrap();
    assert!(!snapshot.exists());
}

#[test]
fn a_state_folder_that_cannot_be_written_is_told_while_drawing_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let in_the_way = folder.path().join("file");
    fs::write(&in_the_way, b"").unwrap();
    let recovery = Recovery::at(in_the_way.join("state"));
    let (mut document, mut writer) = begin(&recovery, "nowhere");
    let step = document.apply(Change::put(stroke(1))).unwrap().unwrap();
    let number = writer.append(&step);
    assert!(!writer.wait_until_durable(number, PATIENCE), "failing ends the wait");
    let JournalState::Failed(message) = writer.state() else { panic!("{:?}", writer.state()) };
    assert!(message.contains("there is no folder") && message.contains("go on drawing"), "{message}");
    assert_eq!(document.sketch().strokes.len(), 1);
    writer.close();
}

/// Not a test of its own: draws under a limit on the size of files, which is how a full disk feels.
#[cfg(unix)]
#[test]
fn child_on_a_full_disk() {
    let Ok(folder) = env::var("PENSTEMON_TEST_FULL") else { return };
    let recovery = Recovery::at(folder);
    let (mut document, mut writer) = begin(&recovery, "full");
    let mut failed = false;
    for id in 1..400 {
        let number = writer.append(&document.apply(Change::put(stroke(id))).unwrap().unwrap());
        failed |= !writer.wait_until_durable(number, PATIENCE);
    }
    assert!(failed);
    let JournalState::Failed(message) = writer.state() else { panic!("{:?}", writer.state()) };
    assert!(message.contains("the disk is full; free some space"), "{message}");
    assert_eq!(document.sketch().strokes.len(), 399, "the drawing is still there");
    println!("survived");
}

#[cfg(unix)]
#[test]
fn a_full_disk_is_told_and_what_was_written_before_is_kept() {
    let state = tempfile::tempdir().unwrap();
    let program = env::current_exe().unwrap();
    // Blocks of 512 bytes; without the trap the system would end the program instead of refusing the write.
    let script = "trap '' XFSZ; ulimit -f 24; exec \"$0\" --exact faults::child_on_a_full_disk --nocapture";
    let output = Command::new("sh")
        .args(["-c", script, program.to_str().unwrap()])
        .env("PENSTEMON_TEST_FULL", state.path())
        .output()
        .unwrap();
    let report = String::from_utf8_lossy(&output.stdout);
    assert!(report.contains("survived"), "{report}\n{}", String::from_utf8_lossy(&output.stderr));
    let found = Recovery::at(state.path()).list().unwrap().pop().unwrap();
    let strokes = found.strokes();
    assert!((10..399).contains(&strokes), "{strokes}");
    let drawn = &found.content.as_ref().unwrap().sketch.strokes;
    assert!(drawn.iter().zip(1..).all(|(found, id)| **found == stroke(id)));
}
