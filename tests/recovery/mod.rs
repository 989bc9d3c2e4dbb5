//! Nothing lost: a drawing program that is killed at any moment, and what the next start finds.
//!
//! The test program starts itself as a child that draws ([`kill`]) or that has no room to write ([`faults`]), and looks at
//! what is left. On a simulated disk every operation fails once, and the power goes at every moment ([`power`]).

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "helpers of tests fail by panicking; children report"
)]

mod artist;
mod faults;
mod kill;
mod power;
mod simulated;

use artist::Artist;
use penstemon::sketch::document::Document;
use penstemon::sketch::journal::{JournalError, JournalState, JournalWriter, Meta, Recovery};
use penstemon::sketch::{Change, Stroke, StrokePoint, Tool};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Longest that a healthy disk is waited for.
const PATIENCE: Duration = Duration::from_secs(60);

/// What the program of tests calls a test of a module.
fn test_name(module: &str, test: &str) -> String {
    let (_program, place) = module.split_once("::").unwrap();
    format!("{place}::{test}")
}

fn stroke(id: u64) -> Stroke {
    Stroke {
        id,
        tool: Tool::Petal,
        points: (0..9).map(|k| StrokePoint::at([id as f32, k as f32].into())).collect(),
        brush: None,
    }
}

/// Draws strokes and waits until they are on disk.
fn draw(document: &mut Document, writer: &mut JournalWriter, count: usize) {
    for _ in 0..count {
        let step = document.apply(Change::put(stroke(document.next_id()))).unwrap().unwrap();
        writer.append(&step);
    }
    assert_eq!(writer.flush(PATIENCE), JournalState::Saved);
}

fn begin(recovery: &Recovery, title: &str) -> (Document, JournalWriter) {
    let document = Document::empty();
    let meta = Meta { title: title.to_owned(), ..Meta::default() };
    let writer = recovery.start(document.sketch(), meta, true).unwrap();
    (document, writer)
}

fn titles(recovery: &Recovery) -> Vec<String> {
    let mut titles: Vec<String> =
        recovery.list().unwrap().into_iter().map(|found| found.meta.title).collect();
    titles.sort();
    titles
}

#[test]
fn running_windows_are_not_offered_and_abandoned_ones_to_one_window_only() {
    let state = tempfile::tempdir().unwrap();
    let recovery = Recovery::at(state.path());
    let ((mut first, mut one), (mut second, mut two)) = (begin(&recovery, "one"), begin(&recovery, "two"));
    draw(&mut first, &mut one, 3);
    draw(&mut second, &mut two, 2);
    assert_eq!(titles(&recovery), Vec::<String>::new());
    drop(one);
    let held = recovery.list().unwrap();
    assert_eq!(held.len(), 1);
    assert_eq!((held[0].meta.title.as_str(), held[0].strokes()), ("one", 3));
    assert_eq!(titles(&recovery), Vec::<String>::new(), "another window is not offered what this one shows");
    drop(held);
    assert_eq!(titles(&recovery), ["one"]);
    two.close();
    assert_eq!(titles(&recovery), ["one"], "a window that was closed leaves nothing");
    let one = recovery.list().unwrap().pop().unwrap();
    recovery.discard(one).unwrap();
    assert_eq!(fs::read_dir(state.path()).unwrap().count(), 0);
}

#[test]
fn a_restored_drawing_goes_on_and_can_be_lost_again() {
    let state = tempfile::tempdir().unwrap();
    let recovery = Recovery::at(state.path().join("made/when/needed"));
    assert!(recovery.list().unwrap().is_empty());
    let (mut document, mut writer) = begin(&recovery, "lost twice");
    draw(&mut document, &mut writer, 4);
    drop(writer);
    let found = recovery.list().unwrap().pop().unwrap();
    let (restored, meta, mut writer) = recovery.resume(found).unwrap();
    assert_eq!(meta.title, "lost twice");
    assert_eq!(&restored.sketch, document.sketch());
    let mut document = Document::unsaved(restored.sketch);
    assert!(titles(&recovery).is_empty());
    draw(&mut document, &mut writer, 2);
    let undone = document.undo().unwrap();
    writer.append(&undone);
    drop(writer);
    let found = recovery.list().unwrap();
    assert_eq!(found.len(), 1);
    assert_eq!(&found[0].content.as_ref().unwrap().sketch, document.sketch());
}

#[test]
fn only_what_changed_and_is_not_saved_is_recovered() {
    let state = tempfile::tempdir().unwrap();
    let recovery = Recovery::at(state.path());
    let (_, untouched) = begin(&recovery, "opened and looked at");
    untouched.snapshot();
    drop(untouched);
    let (mut document, mut writer) = begin(&recovery, "saved");
    draw(&mut document, &mut writer, 2);
    writer.saved(Meta::default(), writer.last_step());
    drop(writer);
    assert_eq!(titles(&recovery), Vec::<String>::new());
    let imported =
        recovery.start(document.sketch(), Meta { title: "import".into(), ..Meta::default() }, false);
    drop(imported.unwrap());
    assert_eq!(titles(&recovery), ["import"]);
}

#[test]
fn a_journal_with_any_byte_changed_restores_all_but_what_was_changed() {
    let state = tempfile::tempdir().unwrap();
    let recovery = Recovery::at(state.path());
    let mut artist = Artist::new(11);
    let mut writer = recovery.start(artist.document.sketch(), Meta::default(), false).unwrap();
    for _ in 0..12 {
        writer.append(&artist.act());
    }
    assert_eq!(writer.flush(PATIENCE), JournalState::Saved);
    drop(writer);
    let last = artist.document.sketch();
    let journal = file(state.path(), "journal");
    let whole = fs::read(&journal).unwrap();
    let mut rng = Pcg64Mcg::seed_from_u64(5);
    for _ in 0..300 {
        let mut changed = whole.clone();
        let at = rng.random_range(0..changed.len());
        changed[at] ^= 1 << rng.random_range(0..8);
        fs::write(&journal, &changed).unwrap();
        match recovery.list().unwrap().pop().unwrap().content {
            Ok(restored) => {
                // One step may be missing, with all that it did.
                let missing = last.strokes.iter().filter(|stroke| !restored.sketch.strokes.contains(stroke));
                assert!(missing.count() <= 2, "byte {at}");
                assert!(restored.sketch == *last || !restored.gaps.is_empty(), "byte {at}: nothing is said");
            }
            Err(error) => assert!(matches!(error, JournalError::NewerVersion { .. }), "byte {at}: {error}"),
        }
    }
}

/// The only file below `state` whose name begins so.
fn file(state: &Path, start: &str) -> PathBuf {
    let session = fs::read_dir(state).unwrap().next().unwrap().unwrap().path();
    let files = fs::read_dir(session).unwrap().map(|entry| entry.unwrap().path());
    files.into_iter().find(|path| path.file_name().unwrap().to_str().unwrap().starts_with(start)).unwrap()
}

#[test]
fn a_journal_cut_anywhere_restores_the_finished_steps() {
    let state = tempfile::tempdir().unwrap();
    let recovery = Recovery::at(state.path());
    let mut artist = Artist::new(7);
    let mut states = vec![artist.document.sketch().clone()];
    let mut writer = recovery.start(artist.document.sketch(), Meta::default(), false).unwrap();
    assert_eq!(writer.flush(PATIENCE), JournalState::Saved);
    let mut ends = Vec::new();
    for _ in 0..12 {
        let step = writer.append(&artist.act());
        assert!(writer.wait_until_durable(step, PATIENCE));
        states.push(artist.document.sketch().clone());
        ends.push(fs::metadata(file(state.path(), "journal")).unwrap().len());
    }
    drop(writer);
    let journal = file(state.path(), "journal");
    let whole = fs::read(&journal).unwrap();
    // Every byte near the ends of records, and a few hundred others.
    let near = |cut: u64| ends.iter().any(|end| end.abs_diff(cut) < 12) || cut < 40 || cut.is_multiple_of(23);
    for cut in (0..=whole.len() as u64).filter(|cut| near(*cut)) {
        fs::write(&journal, &whole[..cut as usize]).unwrap();
        let finished = ends.iter().filter(|end| **end <= cut).count();
        let found = recovery.list().unwrap().pop().unwrap();
        assert_eq!(found.content.unwrap().sketch, states[finished], "cut at {cut}");
    }
}
