//! Tests of the writing thread's own decisions, without the thread.

use super::*;
use crate::sketch::document::Document;
use crate::sketch::journal::Recovery;
use crate::sketch::{Change, Picture, Reference, Stroke, StrokePoint, Tool};
use glam::{Vec2, vec2};
use std::fs;
use std::path::Path;

fn stroke(id: u64) -> Stroke {
    let points = (0..20).map(|k| StrokePoint::at(vec2(id as f32, k as f32))).collect();
    Stroke { id, tool: Tool::Leaf, points }
}

/// A scribe and the document that it writes down.
struct Desk {
    document: Document,
    scribe: Scribe,
    number: u64,
}

impl Desk {
    fn new(state: &Path) -> Self {
        let document = Document::empty();
        let meta = Meta { title: "a drawing".into(), ..Meta::default() };
        let sketch = document.sketch().clone();
        let scribe = Scribe::new(state.to_owned(), None, sketch, meta, Arc::new(Shared::default()));
        Self { document, scribe, number: 0 }
    }

    fn apply(&mut self, change: Change) {
        let step = self.document.apply(change).unwrap().unwrap();
        self.number += 1;
        self.scribe.carry_out(std::iter::once(Command::Step(self.number, step)));
    }

    fn draw(&mut self) {
        self.apply(Change::put(stroke(self.document.next_id())));
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

fn files(scribe: &Scribe) -> Vec<String> {
    let entries = fs::read_dir(&scribe.session.as_ref().unwrap().folder).unwrap();
    let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_full_disk_is_told_and_everything_is_written_once_there_is_room() {
    let state = tempfile::tempdir().unwrap();
    let mut desk = Desk::new(state.path());
    desk.draw();
    let full = File::options().write(true).open("/dev/full").unwrap();
    let error = Journal { file: full, ..desk.scribe.journal.take().unwrap() };
    desk.scribe.journal = Some(error);
    let journal = desk.scribe.journal.as_mut().unwrap();
    let step = Arc::new(Step::default());
    assert_eq!(journal.append(&[step]).unwrap_err().kind(), io::ErrorKind::StorageFull);
    // The scribe itself goes on in a new generation, where there is room.
    desk.draw();
    assert_eq!(desk.scribe.failed_at, None);
    assert_eq!(files(&desk.scribe), ["journal-2", "lock", "meta.json", "snapshot-2.penstemon"]);
    let expected = desk.document.sketch().clone();
    assert_eq!(only(desk.found(state.path())), expected);
}

#[test]
fn a_folder_that_vanishes_is_made_again_with_everything_in_it() {
    let state = tempfile::tempdir().unwrap();
    let mut desk = Desk::new(state.path());
    desk.draw();
    fs::remove_dir_all(&desk.scribe.session.as_ref().unwrap().folder).unwrap();
    desk.draw();
    let expected = desk.document.sketch().clone();
    assert_eq!(only(desk.found(state.path())), expected);
}

#[test]
fn snapshots_beside_the_drawing_keep_every_step_at_every_moment() {
    let state = tempfile::tempdir().unwrap();
    let mut desk = Desk::new(state.path());
    desk.draw();
    desk.draw();
    desk.scribe.snapshot();
    desk.draw();
    // The snapshot is lost on its way: the old one and both journals have everything.
    desk.scribe.finish_background(true);
    let folder = desk.scribe.session.as_ref().unwrap().folder.clone();
    assert_eq!(files(&desk.scribe), ["journal-2", "lock", "meta.json", "snapshot-2.penstemon"]);
    desk.scribe.snapshot();
    desk.draw();
    desk.scribe.background.take().unwrap().join().unwrap().unwrap();
    assert!(
        folder.join("snapshot-2.penstemon").exists(),
        "the old goes only when the new is known to be whole"
    );
    fs::remove_file(folder.join("snapshot-3.penstemon")).unwrap();
    let expected = desk.document.sketch().clone();
    assert_eq!(only(desk.found(state.path())), expected);
}

#[test]
fn a_long_journal_makes_room_for_a_snapshot() {
    let state = tempfile::tempdir().unwrap();
    let mut desk = Desk::new(state.path());
    desk.draw();
    desk.scribe.journal.as_mut().unwrap().bytes = JOURNAL_BYTES;
    desk.draw();
    desk.scribe.finish_background(true);
    assert_eq!(files(&desk.scribe), ["journal-2", "lock", "meta.json", "snapshot-2.penstemon"]);
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
    let before = desk.scribe.journal.as_ref().unwrap().bytes;
    for k in 0..20 {
        let reference = Reference::new(picture.clone(), Vec2::splat(k as f32), 300.0);
        desk.apply(Change::reference(Some(reference)));
    }
    let grown = desk.scribe.journal.as_ref().unwrap().bytes - before;
    assert!(grown < size + 20 * 200, "{grown} bytes for a picture of {size}");
    let expected = desk.document.sketch().clone();
    assert!(expected.reference.is_some());
    assert_eq!(only(desk.found(state.path())), expected);
}

#[test]
fn a_saved_drawing_leaves_nothing_to_recover_until_it_changes() {
    let state = tempfile::tempdir().unwrap();
    let mut desk = Desk::new(state.path());
    desk.draw();
    desk.draw();
    desk.scribe.carry_out(std::iter::once(Command::Saved(Meta::default(), 1)));
    assert_eq!(files(&desk.scribe).len(), 4, "something was drawn while it was being saved");
    desk.scribe.carry_out(std::iter::once(Command::Saved(Meta::default(), 2)));
    assert_eq!(files(&desk.scribe), ["lock", "meta.json"]);
    desk.draw();
    let expected = desk.document.sketch().clone();
    assert_eq!(only(desk.found(state.path())), expected);

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
