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
    Stroke { id, tool: Tool::Leaf, points }
}

/// A scribe and the document that it writes down.
struct Desk {
    document: Document,
    scribe: Scribe,
    failures: Receiver<Command>,
    number: u64,
}

impl Desk {
    fn new(state: &Path) -> Self {
        let document = Document::empty();
        let meta = Meta { title: "a drawing".into(), ..Meta::default() };
        let identity = Identity { meta, is_saved: true };
        let subject = Subject { sketch: document.sketch().clone(), identity, damaged: Vec::new() };
        let (shared, (tell, failures)) = (Arc::new(Shared::default()), channel());
        let flusher = Flusher::start(shared.clone(), tell).unwrap();
        let mut scribe = Scribe::new(Arc::new(System), state.to_owned(), None, subject, shared, flusher);
        scribe.carry_out(std::iter::once(Command::Begin));
        Self { document, scribe, failures, number: 0 }
    }

    fn apply(&mut self, change: Change) {
        let step = self.document.apply(change).unwrap().unwrap();
        self.number += 1;
        self.scribe.carry_out(std::iter::once(Command::Step(self.number, step)));
    }

    fn draw(&mut self) {
        self.apply(Change::put(stroke(self.document.next_id())));
    }

    /// Waits for the disk.
    fn settle(&mut self) {
        self.scribe.finish_background(true);
        self.scribe.flusher.wait();
        assert!(self.failures.try_recv().is_err());
    }

    fn folder(&self) -> PathBuf {
        self.scribe.session.as_ref().unwrap().folder.path.clone()
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
        drop(self.scribe);
        Recovery::at(state).list().unwrap()
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
    let mut desk = Desk::new(state.path());
    desk.draw();
    desk.settle();
    fs::remove_dir_all(desk.folder()).unwrap();
    desk.draw();
    assert_eq!(desk.files(), ["journal-1", "lock", "snapshot-1.penstemon"]);
    let expected = desk.document.sketch().clone();
    assert_eq!(only(desk.found(state.path())), expected);
}

#[test]
fn two_generations_are_kept_and_either_snapshot_may_be_lost() {
    let state = tempfile::tempdir().unwrap();
    let mut desk = Desk::new(state.path());
    for _ in 0..4 {
        desk.draw();
        desk.scribe.snapshot();
        desk.draw();
        desk.settle();
    }
    let names = ["journal-4", "journal-5", "lock", "snapshot-4.penstemon", "snapshot-5.penstemon"];
    assert_eq!(desk.files(), names);
    let (folder, expected) = (desk.folder(), desk.document.sketch().clone());
    drop(desk.scribe);
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
    let mut desk = Desk::new(state.path());
    desk.draw();
    desk.scribe.snapshot();
    desk.draw();
    desk.scribe.background.take().unwrap().join().unwrap().unwrap();
    fs::remove_file(desk.folder().join("snapshot-2.penstemon")).unwrap();
    let expected = desk.document.sketch().clone();
    assert_eq!(only(desk.found(state.path())), expected);
}

#[test]
fn a_long_journal_makes_room_for_a_snapshot() {
    let state = tempfile::tempdir().unwrap();
    let mut desk = Desk::new(state.path());
    desk.draw();
    desk.scribe.journal.as_mut().unwrap().pretend_long(JOURNAL_BYTES);
    desk.draw();
    desk.settle();
    assert!(desk.folder().join("snapshot-2.penstemon").exists());
    desk.scribe.snapshot();
    assert!(desk.scribe.background.is_none(), "nothing new, no snapshot");
}

#[test]
fn a_reference_picture_is_written_once_however_often_it_is_moved() {
    let state = tempfile::tempdir().unwrap();
    let mut desk = Desk::new(state.path());
    desk.draw();
    let picture = Picture::new(&include_bytes!("../../../tests/fixtures/reference/small.jpg")[..]).unwrap();
    let size = picture.bytes().len() as u64;
    let before = desk.scribe.journal.as_ref().unwrap().bytes();
    for k in 0..20 {
        let reference = Reference::new(picture.clone(), Vec2::splat(k as f32), 300.0);
        desk.apply(Change::reference(Some(reference)));
    }
    let grown = desk.scribe.journal.as_ref().unwrap().bytes() - before;
    assert!(grown < size + 20 * 200, "{grown} bytes for a picture of {size}");
    let expected = desk.document.sketch().clone();
    assert!(expected.reference.is_some());
    assert_eq!(only(desk.found(state.path())), expected);
}

#[test]
fn a_saved_drawing_leaves_nothing_to_recover_until_it_changes() {
    let state = tempfile::tempdir().unwrap();
    let drawn = |saved: u64, more: bool| {
        let mut desk = Desk::new(state.path());
        desk.draw();
        desk.draw();
        desk.scribe.carry_out(std::iter::once(Command::Saved(Meta::default(), saved)));
        if more {
            desk.draw();
        }
        let expected = desk.document.sketch().clone();
        (expected, desk.found(state.path()))
    };
    let (expected, found) = drawn(1, false);
    assert_eq!(only(found), expected, "something was drawn while it was being saved");
    for found in Recovery::at(state.path()).list().unwrap() {
        Recovery::at(state.path()).discard(found).unwrap();
    }
    assert_eq!(drawn(2, false).1.len(), 0);
    let (expected, found) = drawn(2, true);
    assert_eq!(only(found), expected);

    let mut desk = Desk::new(state.path());
    desk.draw();
    desk.scribe.carry_out(std::iter::once(Command::Close));
    assert_eq!(desk.found(state.path()).len(), 1, "only the one from above");
}

#[test]
fn a_state_folder_that_cannot_be_made_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, b"").unwrap();
    let mut desk = Desk::new(&file.join("state"));
    desk.draw();
    assert!(desk.scribe.failed_at.is_some());
    // Where there is a folder after all, the whole drawing goes there.
    fs::remove_file(&file).unwrap();
    desk.scribe.on_time();
    assert!(desk.scribe.failed_at.is_none());
    let expected = desk.document.sketch().clone();
    assert_eq!(only(desk.found(&file.join("state"))), expected);
}
