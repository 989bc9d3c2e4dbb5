//! Copies that cannot be written or read: full disk, no folder, damage, a newer program.

#[cfg(unix)]
use super::test_name;
use super::{PATIENCE, begin, draw, file, stroke};
use penstemon::sketch::document::Document;
#[cfg(unix)]
use penstemon::sketch::journal::JournalWriter;
use penstemon::sketch::journal::{Gap, JournalError, JournalState, Recovery};
use penstemon::sketch::{self, Change};
#[cfg(unix)]
use std::env;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
#[cfg(unix)]
use std::process::Command;
#[cfg(unix)]
use std::sync::Arc;
#[cfg(unix)]
use std::time::{Duration, Instant};

#[test]
fn copies_of_a_newer_program_are_kept_and_said_to_be_so() {
    let state = tempfile::tempdir().unwrap();
    let recovery = Recovery::at(state.path());
    let (mut document, mut writer) = begin(&recovery, "from the future");
    draw(&mut document, &mut writer, 2);
    drop(writer);
    let newer = |start: &str, old: &str, new: &str, newest: f64| {
        let path = file(state.path(), start);
        let whole = fs::read(&path).unwrap();
        let at = whole.windows(old.len()).position(|bytes| bytes == old.as_bytes()).unwrap();
        let mut changed = whole.clone();
        changed[at..at + new.len()].copy_from_slice(new.as_bytes());
        fs::write(&path, changed).unwrap();
        let found = recovery.list().unwrap().pop().unwrap();
        fs::write(&path, whole).unwrap();
        assert_eq!(found.meta.title, "from the future");
        let error = recovery.resume(found).unwrap_err();
        assert!(matches!(error, JournalError::NewerVersion { version, .. } if version == newest), "{error}");
        assert!(error.to_string().contains(&format!("newer Penstemon (version {newest})")), "{error}");
    };
    newer("snapshot", "\"version\": 1", "\"version\":15", 15.0);
    newer("journal", "journal 3", "journal 9", 9.0);
    assert_eq!(recovery.list().unwrap()[0].strokes(), 2);
}

#[test]
fn a_damaged_copy_is_reported_and_kept_until_it_is_discarded() {
    let state = tempfile::tempdir().unwrap();
    let recovery = Recovery::at(state.path());
    let (mut document, mut writer) = begin(&recovery, "damaged");
    draw(&mut document, &mut writer, 2);
    drop(writer);
    let (snapshot, journal) = (file(state.path(), "snapshot"), file(state.path(), "journal"));
    File::options().write(true).open(&snapshot).unwrap().set_len(100).unwrap();
    // What was drawn since is had all the same, and it is said that this is not all.
    let found = recovery.list().unwrap().pop().unwrap();
    let restored = found.content.as_ref().unwrap();
    assert_eq!((restored.sketch.strokes.len(), restored.gaps.len()), (2, 1));
    assert!(restored.gaps[0].to_string().contains("missing or damaged"), "{}", restored.gaps[0]);
    drop(found);
    fs::write(&journal, b"").unwrap();
    let found = recovery.list().unwrap().pop().unwrap();
    let message = found.content.as_ref().unwrap_err().to_string();
    assert!(message.contains("is damaged") && message.contains("snapshot-1"), "{message}");
    assert!(snapshot.exists());
    recovery.discard(found).unwrap();
    assert!(!snapshot.exists());
}

/// A session of strokes 1 to `count` that nobody runs any more, and its folder.
fn abandoned(state: &Path, count: usize) -> PathBuf {
    let recovery = Recovery::at(state);
    let (mut document, mut writer) = begin(&recovery, "abandoned");
    draw(&mut document, &mut writer, count);
    drop(writer);
    file(state, "journal").parent().unwrap().to_owned()
}

#[test]
fn one_damaged_record_costs_its_stroke_and_is_said_and_its_file_is_kept() {
    let state = tempfile::tempdir().unwrap();
    let recovery = Recovery::at(state.path());
    let folder = abandoned(state.path(), 14);
    let journal = folder.join("journal-1");
    let mut bytes = fs::read(&journal).unwrap();
    let fifth = bytes.windows(8).position(|bytes| bytes == b"\"id\": 5,").unwrap();
    bytes[fifth + 40] ^= 4;
    fs::write(&journal, &bytes).unwrap();
    let found = recovery.list().unwrap().pop().unwrap();
    let (restored, _, mut writer) = recovery.resume(found).unwrap();
    let ids: Vec<u64> = restored.sketch.strokes.iter().map(|stroke| stroke.id).collect();
    assert_eq!(ids, (1..=14).filter(|id| *id != 5).collect::<Vec<_>>());
    let [gap @ Gap::LeftOut { count: 1, .. }] = restored.gaps.as_slice() else {
        panic!("{:?}", restored.gaps)
    };
    assert!(gap.to_string().contains("checksum"), "{gap}");
    // Drawing on does not cost what a better tool than ours may read.
    let mut document = Document::unsaved(restored.sketch);
    draw(&mut document, &mut writer, 1);
    writer.close();
    let kept: Vec<PathBuf> =
        fs::read_dir(recovery.damaged_files()).unwrap().map(|entry| entry.unwrap().path()).collect();
    assert_eq!(kept.len(), 1);
    assert_eq!(fs::read(&kept[0]).unwrap(), bytes);
}

#[test]
fn a_changed_digit_in_a_snapshot_is_found_and_the_one_before_serves() {
    let state = tempfile::tempdir().unwrap();
    let recovery = Recovery::at(state.path());
    let (mut document, mut writer) = begin(&recovery, "changed");
    draw(&mut document, &mut writer, 3);
    writer.snapshot();
    draw(&mut document, &mut writer, 2);
    drop(writer);
    let newest = file(state.path(), "snapshot-2");
    let text = fs::read_to_string(&newest).unwrap();
    let changed = text.replacen("[1, 0]", "[1, 7]", 1);
    assert_ne!(changed, text);
    fs::write(&newest, changed).unwrap();
    let found = recovery.list().unwrap().pop().unwrap();
    let restored = found.content.as_ref().unwrap();
    assert_eq!(&restored.sketch, document.sketch());
    assert!(restored.gaps[0].to_string().contains("checksum"), "{}", restored.gaps[0]);
}

#[test]
fn a_journal_without_its_snapshot_is_offered() {
    let state = tempfile::tempdir().unwrap();
    let folder = abandoned(state.path(), 3);
    fs::remove_file(folder.join("snapshot-1.penstemon")).unwrap();
    let found = Recovery::at(state.path()).list().unwrap().pop().unwrap();
    assert_eq!((found.strokes(), found.meta.title.as_str()), (3, "abandoned"));
    assert_eq!(found.content.as_ref().unwrap().gaps.len(), 1);
}

#[test]
fn files_of_others_in_a_session_are_never_removed() {
    let state = tempfile::tempdir().unwrap();
    let recovery = Recovery::at(state.path());
    let folder = abandoned(state.path(), 2);
    let foreign = ["thesis.odt", "journal-x", "snapshot-1.penstemon.bak"];
    for name in foreign {
        fs::write(folder.join(name), b"work").unwrap();
    }
    // A session without anything of its own, as a crash at its beginning leaves it.
    let empty = state.path().join("session-empty");
    fs::create_dir(&empty).unwrap();
    fs::write(empty.join("notes.txt"), b"work").unwrap();
    recovery.discard(recovery.list().unwrap().pop().unwrap()).unwrap();
    assert!(recovery.list().unwrap().is_empty());
    let mut left: Vec<_> = fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    left.sort();
    assert_eq!(left, ["journal-x", "snapshot-1.penstemon.bak", "thesis.odt"]);
    assert_eq!(fs::read(empty.join("notes.txt")).unwrap(), b"work");
}

/// What the last release but this left: journals of the first version, and the title in a file of its own.
#[test]
fn sessions_of_older_programs_are_recovered() {
    let state = tempfile::tempdir().unwrap();
    let folder = state.path().join("session-old");
    fs::create_dir(&folder).unwrap();
    let write = |name: &str, bytes: &[u8]| fs::write(folder.join(name), bytes).unwrap();
    write("lock", b"");
    write("meta.json", br#"{"title": "an old rose", "path": "/home/x/rose.penstemon", "stamp": null}"#);
    let mut drawn = sketch::Sketch::empty();
    drawn.strokes.push(stroke(1).into());
    write("snapshot-4.penstemon", sketch::json::write(&drawn).as_bytes());
    let mut journal = b"penstemon-journal 1\n".to_vec();
    for step in [
        r#"{"strokes": [{"at": 1, "insert": {"id": 2, "tool": "leaf", "points": [[1, 2], [3, 4]]}}]}"#,
        r#"{"strokes": [{"at": 0, "remove": true}], "seed": 7}"#,
    ] {
        let content = [b"S", step.as_bytes()].concat();
        journal.extend((content.len() as u32).to_le_bytes());
        journal.extend(crc32fast::hash(&content).to_le_bytes());
        journal.extend(content);
    }
    write("journal-4", &journal);
    let recovery = Recovery::at(state.path());
    let found = recovery.list().unwrap().pop().unwrap();
    let (restored, meta, mut writer) = recovery.resume(found).unwrap();
    assert_eq!(meta.title, "an old rose");
    assert!(restored.gaps.is_empty(), "{:?}", restored.gaps);
    let ids: Vec<u64> = restored.sketch.strokes.iter().map(|stroke| stroke.id).collect();
    assert_eq!((ids, restored.sketch.seed), (vec![2], 7));
    // Drawn on and lost again, it is found with everything.
    let mut document = Document::unsaved(restored.sketch);
    draw(&mut document, &mut writer, 2);
    drop(writer);
    let found = recovery.list().unwrap().pop().unwrap();
    assert_eq!(&found.content.unwrap().sketch, document.sketch());
    assert_eq!(found.meta.path.unwrap(), Path::new("/home/x/rose.penstemon"));
}

#[cfg(unix)]
#[test]
fn pipes_in_the_place_of_files_keep_nobody_waiting() {
    let state = tempfile::tempdir().unwrap();
    let recovery = Recovery::at(state.path());
    let pipe = |path: &Path| {
        fs::remove_file(path).ok();
        assert!(Command::new("mkfifo").arg(path).status().unwrap().success());
    };
    for name in ["lock", "journal-1", "snapshot-1.penstemon", "meta.json"] {
        let folder = abandoned(state.path(), 2);
        pipe(&folder.join(name));
        let found = recovery.list().unwrap();
        let is_had = found.iter().any(|found| found.content.is_ok());
        assert_eq!((found.len(), is_had), if name == "lock" { (0, false) } else { (1, name != "journal-1") });
        drop(found);
        fs::remove_dir_all(folder).unwrap();
    }
    pipe(&state.path().join("session-pipe"));
    assert!(recovery.list().unwrap().is_empty());
}

#[cfg(unix)]
#[test]
fn recovery_copies_are_the_users_alone() {
    use std::os::unix::fs::PermissionsExt;
    let home = tempfile::tempdir().unwrap();
    let state = home.path().join("state");
    let folder = abandoned(&state, 2);
    let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode() & 0o777;
    assert_eq!((mode(&state), mode(&folder)), (0o700, 0o700));
    for entry in fs::read_dir(&folder).unwrap() {
        let path = entry.unwrap().path();
        assert_eq!(mode(&path), 0o600, "{}", path.display());
    }
}

#[cfg(unix)]
#[test]
fn what_is_open_on_a_full_disk_is_offered_to_no_other_window_and_leaves_no_folders() {
    let state = tempfile::tempdir().unwrap();
    let program = env::current_exe().unwrap();
    let script = "trap '' XFSZ; ulimit -f 0; exec \"$0\" --exact \"$1\" --nocapture";
    let child = test_name(module_path!(), "child_without_any_room");
    let output = Command::new("sh")
        .args(["-c", script, program.to_str().unwrap(), &child])
        .env("PENSTEMON_TEST_FULL", state.path())
        .output()
        .unwrap();
    let report = String::from_utf8_lossy(&output.stdout);
    assert!(report.contains("survived"), "{report}\n{}", String::from_utf8_lossy(&output.stderr));
}

/// Not a test of its own: draws where not one byte can be written.
#[cfg(unix)]
#[test]
fn child_without_any_room() {
    let Ok(folder) = env::var("PENSTEMON_TEST_FULL") else { return };
    let recovery = Recovery::at(&folder);
    let (mut document, mut writer) = begin(&recovery, "no room");
    for id in 1..4 {
        let before = writer.failure();
        writer.append(&document.apply(Change::put(stroke(id))).unwrap().unwrap());
        assert!(fails_anew(&writer, before.as_ref()), "it tries again by itself");
        assert!(matches!(writer.state(), JournalState::Failed(_)), "{:?}", writer.state());
        assert!(recovery.list().unwrap().is_empty(), "it is still open here");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1, "one session, one folder");
    }
    println!("survived");
}

/// Whether another attempt to write fails than the one that is known.
#[cfg(unix)]
fn fails_anew(writer: &JournalWriter, known: Option<&Arc<JournalError>>) -> bool {
    let deadline = Instant::now() + PATIENCE;
    let is_known = |failure: Option<Arc<JournalError>>| match (failure, known) {
        (Some(failure), Some(known)) => Arc::ptr_eq(&failure, known),
        (failure, _) => failure.is_none(),
    };
    while is_known(writer.failure()) {
        if Instant::now() > deadline {
            return false;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    true
}

#[test]
fn a_state_folder_that_cannot_be_written_is_reported_while_drawing_goes_on() {
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
fn a_full_disk_is_reported_and_what_was_written_before_is_kept() {
    let state = tempfile::tempdir().unwrap();
    let program = env::current_exe().unwrap();
    // Blocks of 512 bytes; without the trap the system would end the program instead of refusing the write.
    let script = "trap '' XFSZ; ulimit -f 24; exec \"$0\" --exact \"$1\" --nocapture";
    let child = test_name(module_path!(), "child_on_a_full_disk");
    let output = Command::new("sh")
        .args(["-c", script, program.to_str().unwrap(), &child])
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
