//! Tests of the writing thread's own decisions, without the thread.

use super::*;
use crate::file_system::System;
use crate::sketch::document::Document;
use crate::sketch::journal::Recovery;
use crate::sketch::{Change, Picture, Reference, Stroke, StrokePoint, Tool};
use glam::{Vec2, vec2};
use std::fs;
use std::path::Path;
use std::sync::mpsc::channel;

fn stroke(id: u64) -> Stroke {
    let points = (0..20).map(|k| StrokePoint::at(vec2(id as f32, k as f32))).collect();
    Stroke { id, tool: Tool::Leaf, points, brush: None }
}

/// A journal and the document that it writes down.
struct Fixture {
    document: Document,
    journal: JournalThread,
    failures: Receiver<Command>,
    number: u64,
}

impl Fixture {
    fn new(state: &Path) -> Self {
        let document = Document::empty();
        let meta = Meta { title: "a drawing".into(), ..Meta::default() };
        let identity = Identity { meta, is_saved: true };
        let subject = Subject { sketch: document.sketch().clone(), identity, damaged: Vec::new() };
        let (shared, (sender, failures)) = (Arc::new(Shared::default()), channel());
        let flusher = Flusher::start(shared.clone(), sender).unwrap();
        let mut journal =
            JournalThread::new(Arc::new(System), state.to_owned(), None, subject, shared, flusher);
        journal.carry_out(std::iter::once(Command::Begin));
        Self { document, journal, failures, number: 0 }
    }

    fn apply(&mut self, change: Change) {
        let step = self.document.apply(change).unwrap().unwrap();
        self.number += 1;
        self.journal.carry_out(std::iter::once(Command::Step(self.number, step)));
    }

    fn draw(&mut self) {
        self.apply(Change::put(stroke(self.document.next_id())));
    }

    /// Waits for the disk.
    fn settle(&mut self) {
        self.journal.finish_background(true);
        self.journal.flusher.wait();
        assert!(self.failures.try_recv().is_err());
    }

    fn folder(&self) -> PathBuf {
        self.journal.session.as_ref().unwrap().folder.path.clone()
    }

    fn files(&mut self) -> Vec<String> {
        self.settle();
        let entries = fs::read_dir(self.folder()).unwrap();
        let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// What a later start of the program finds.
    fn found(self, state: &Path) -> Vec<crate::sketch::journal::Recoverable> {
        drop(self.journal);
        Recovery::at(state).list().unwrap()
    }

    /// Checks that a later start of the program finds all of the drawing.
    fn assert_found(self, state: &Path) {
        let expected = self.document.sketch().clone();
        assert_eq!(only(self.found(state)), expected);
    }
}

fn only(found: Vec<crate::sketch::journal::Recoverable>) -> Sketch {
    assert_eq!(found.len(), 1, "{found:?}");
    let restored = found.into_iter().next().unwrap().content.unwrap();
    assert!(restored.gaps.is_empty(), "{:?}", restored.gaps);
    restored.sketch
}

#[test]
fn a_folder_that_vanishes_is_made_again_with_everything_in_it() {
    let state = tempfile::tempdir().unwrap();
    let mut fixture = Fixture::new(state.path());
    fixture.draw();
    fixture.settle();
    fs::remove_dir_all(fixture.folder()).unwrap();
    fixture.draw();
    assert_eq!(fixture.files(), ["journal-1", "lock", "snapshot-1.penstemon"]);
    fixture.assert_found(state.path());
}

#[test]
fn two_generations_are_kept_and_either_snapshot_may_be_lost() {
    let state = tempfile::tempdir().unwrap();
    let mut fixture = Fixture::new(state.path());
    for _ in 0..4 {
        fixture.draw();
        fixture.journal.snapshot();
        fixture.draw();
        fixture.settle();
    }
    let names = ["journal-4", "journal-5", "lock", "snapshot-4.penstemon", "snapshot-5.penstemon"];
    assert_eq!(fixture.files(), names);
    let (folder, expected) = (fixture.folder(), fixture.document.sketch().clone());
    drop(fixture.journal);
    for lost in ["snapshot-4.penstemon", "snapshot-5.penstemon"] {
        let kept = fs::read(folder.join(lost)).unwrap();
        fs::remove_file(folder.join(lost)).unwrap();
        assert_eq!(only(Recovery::at(state.path()).list().unwrap()), expected);
        fs::write(folder.join(lost), kept).unwrap();
    }
}

#[test]
fn a_snapshot_that_is_lost_on_its_way_costs_nothing() {
    let state = tempfile::tempdir().unwrap();
    let mut fixture = Fixture::new(state.path());
    fixture.draw();
    fixture.journal.snapshot();
    fixture.draw();
    fixture.journal.background.take().unwrap().join().unwrap().unwrap();
    fs::remove_file(fixture.folder().join("snapshot-2.penstemon")).unwrap();
    fixture.assert_found(state.path());
}

#[test]
fn a_long_journal_makes_room_for_a_snapshot() {
    let state = tempfile::tempdir().unwrap();
    let mut fixture = Fixture::new(state.path());
    fixture.draw();
    fixture.journal.journal.as_mut().unwrap().pretend_long(JOURNAL_BYTES);
    fixture.draw();
    fixture.settle();
    assert!(fixture.folder().join("snapshot-2.penstemon").exists());
    fixture.journal.snapshot();
    assert!(fixture.journal.background.is_none(), "nothing new, no snapshot");
}

#[test]
fn a_reference_picture_is_written_once_however_often_it_is_moved() {
    let state = tempfile::tempdir().unwrap();
    let mut fixture = Fixture::new(state.path());
    fixture.draw();
    let picture = Picture::new(&include_bytes!("../../../tests/fixtures/reference/small.jpg")[..]).unwrap();
    let size = picture.bytes().len() as u64;
    let before = fixture.journal.journal.as_ref().unwrap().bytes();
    for k in 0..20 {
        let reference = Reference::new(picture.clone(), Vec2::splat(k as f32), 300.0);
        fixture.apply(Change::reference(Some(reference)));
    }
    let grown = fixture.journal.journal.as_ref().unwrap().bytes() - before;
    assert!(grown < size + 20 * 200, "{grown} bytes for a picture of {size}");
    assert!(fixture.document.sketch().reference.is_some());
    fixture.assert_found(state.path());
}

#[test]
fn a_saved_drawing_leaves_nothing_to_recover_until_it_changes() {
    let state = tempfile::tempdir().unwrap();
    let drawn = |saved: u64, more: bool| {
        let mut fixture = Fixture::new(state.path());
        fixture.draw();
        fixture.draw();
        fixture.journal.carry_out(std::iter::once(Command::Saved(Meta::default(), saved)));
        if more {
            fixture.draw();
        }
        let expected = fixture.document.sketch().clone();
        (expected, fixture.found(state.path()))
    };
    let (expected, found) = drawn(1, false);
    assert_eq!(only(found), expected, "something was drawn while it was being saved");
    for found in Recovery::at(state.path()).list().unwrap() {
        Recovery::at(state.path()).discard(found).unwrap();
    }
    assert_eq!(drawn(2, false).1.len(), 0);
    let (expected, found) = drawn(2, true);
    assert_eq!(only(found), expected);

    let mut fixture = Fixture::new(state.path());
    fixture.draw();
    fixture.journal.carry_out(std::iter::once(Command::Close));
    assert_eq!(fixture.found(state.path()).len(), 1, "only the one from above");
}

#[test]
fn a_state_folder_that_cannot_be_made_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, b"").unwrap();
    let mut fixture = Fixture::new(&file.join("state"));
    fixture.draw();
    assert!(fixture.journal.failed_at.is_some());
    // Where there is a folder after all, the whole drawing goes there.
    fs::remove_file(&file).unwrap();
    fixture.journal.on_time();
    assert!(fixture.journal.failed_at.is_none());
    fixture.assert_found(&file.join("state"));
}
