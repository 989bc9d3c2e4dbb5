//! Saving beside the window: what is saved, in which order, and what waits for it.

use super::*;
use crate::app::action::Action;
use crate::app::editor::Places;
use crate::app::panels::snapshot::{Autosave, Dialog, Severity};
use crate::sketch::journal::JournalState;
use crate::sketch::{self, Change, Stroke, StrokePoint, Tool};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Longest wait for anything; only a test that has failed takes so long.
const PATIENCE: Duration = Duration::from_secs(60);

fn editor(home: &Path) -> Editor {
    let places = Places { config: home.join("config"), state: home.join("state") };
    let mut editor = Editor::open_in(places, None, || ()).unwrap();
    editor.perform(Action::New);
    editor
}

fn draw(editor: &mut Editor) {
    let id = editor.drawing.next_id();
    let place = |i: u8| glam::Vec2::new(f32::from(i) * 10.0, id as f32);
    let points = (0..9).map(|i| StrokePoint::at(place(i))).collect();
    editor.change(Change::put(Stroke { id, tool: Tool::Branch, points, brush: None }));
}

fn save_as(editor: &mut Editor, path: &Path) {
    editor.perform(Action::PathChosen { purpose: PathPurpose::SaveDrawing, path: path.to_owned() });
}

/// Goes on until nothing is being saved.
fn settle(editor: &mut Editor) {
    let begun = Instant::now();
    while editor.disk.saver.is_busy() {
        assert!(begun.elapsed() < PATIENCE, "it is saved for ever");
        std::thread::sleep(Duration::from_millis(1));
        editor.collect();
    }
}

fn strokes_at(path: &Path) -> usize {
    sketch::read(path).unwrap().0.strokes.len()
}

fn errors(editor: &Editor) -> Vec<&str> {
    let reported = editor.dialogs.notices().iter().filter(|notice| notice.severity == Severity::Error);
    reported.map(|notice| notice.what.as_str()).collect()
}

#[test]
fn what_is_drawn_while_it_is_saved_stays_unsaved() {
    let home = TempDir::new().unwrap();
    let (mut editor, path) = (editor(home.path()), home.path().join("rose.penstemon"));
    draw(&mut editor);
    save_as(&mut editor, &path);
    assert_eq!(editor.panel_snapshot().status.autosave, Autosave::Saving);
    assert!(editor.is_working() && !editor.drawing.is_saved());
    draw(&mut editor);
    settle(&mut editor);
    assert!(!editor.drawing.is_saved());
    assert_eq!(strokes_at(&path), 1);
    editor.perform(Action::Undo);
    assert!(editor.drawing.is_saved(), "this is what was saved");
    assert_eq!(editor.drawing.flush_journal(PATIENCE), JournalState::Saved);
    assert_eq!(editor.panel_snapshot().status.autosave, Autosave::Saved);
}

#[test]
fn saves_in_a_row_end_with_the_last_and_know_each_other() {
    let home = TempDir::new().unwrap();
    let (mut editor, path) = (editor(home.path()), home.path().join("rose.penstemon"));
    draw(&mut editor);
    save_as(&mut editor, &path);
    for _ in 0..3 {
        draw(&mut editor);
        editor.perform(Action::Save);
    }
    settle(&mut editor);
    assert_eq!(errors(&editor), Vec::<&str>::new());
    assert!(editor.drawing.is_saved());
    assert_eq!(strokes_at(&path), 4);
    // Under another name while the first is still on its way: both are written, the later name is the drawing's.
    let other = home.path().join("other.penstemon");
    draw(&mut editor);
    editor.perform(Action::Save);
    save_as(&mut editor, &other);
    settle(&mut editor);
    assert_eq!((strokes_at(&path), strokes_at(&other)), (5, 5));
    assert_eq!(editor.drawing.path(), Some(other.as_path()));
}

#[test]
fn a_failure_is_reported_and_the_drawing_stays_unsaved_and_open() {
    let home = TempDir::new().unwrap();
    let (mut editor, path) = (editor(home.path()), home.path().join("gone/rose.penstemon"));
    draw(&mut editor);
    save_as(&mut editor, &path);
    editor.ask_to_quit();
    settle(&mut editor);
    assert!(errors(&editor)[0].contains("rose.penstemon"), "{:?}", errors(&editor));
    assert!(!editor.drawing.is_saved() && !editor.is_closed());
    assert_eq!(editor.drawing.path(), None);
    // Elsewhere it works, and does not close the window long after that was asked for.
    save_as(&mut editor, &home.path().join("rose.penstemon"));
    settle(&mut editor);
    assert!(editor.drawing.is_saved() && !editor.is_closed());
}

#[test]
fn another_windows_work_is_not_replaced() {
    let home = TempDir::new().unwrap();
    let (mut editor, path) = (editor(home.path()), home.path().join("rose.penstemon"));
    draw(&mut editor);
    save_as(&mut editor, &path);
    settle(&mut editor);
    let theirs = sketch::json::write(&sketch::Sketch::empty());
    std::fs::write(&path, &theirs).unwrap();
    draw(&mut editor);
    editor.perform(Action::Save);
    settle(&mut editor);
    assert!(errors(&editor)[0].contains("changed by another window"), "{:?}", errors(&editor));
    assert!(!editor.drawing.is_saved());
    assert_eq!(std::fs::read_to_string(&path).unwrap(), theirs);
}

#[test]
fn the_window_closes_after_saving_and_asks_where_that_was_not_all() {
    let home = TempDir::new().unwrap();
    let (mut editor, path) = (editor(home.path()), home.path().join("rose.penstemon"));
    draw(&mut editor);
    save_as(&mut editor, &path);
    editor.ask_to_quit();
    assert!(!editor.is_closed() && editor.dialog().is_none(), "it waits");
    draw(&mut editor);
    settle(&mut editor);
    assert_eq!(editor.dialog(), Some(&Dialog::Unsaved), "what was drawn since is not saved");
    editor.perform(Action::SaveAndContinue);
    assert!(!editor.is_closed());
    settle(&mut editor);
    assert!(editor.is_closed());
    assert_eq!(strokes_at(&path), 2);
}

#[test]
fn a_window_that_is_taken_away_finishes_saving() {
    let home = TempDir::new().unwrap();
    let (mut editor, path) = (editor(home.path()), home.path().join("rose.penstemon"));
    draw(&mut editor);
    save_as(&mut editor, &path);
    editor.shut_down();
    assert_eq!(strokes_at(&path), 1);
}

#[test]
fn a_drawing_that_went_on_while_a_file_was_chosen_is_asked_about() {
    let home = TempDir::new().unwrap();
    let (mut editor, path) = (editor(home.path()), home.path().join("rose.penstemon"));
    draw(&mut editor);
    save_as(&mut editor, &path);
    settle(&mut editor);
    let open = Action::PathChosen { purpose: PathPurpose::OpenDrawing, path };
    draw(&mut editor);
    editor.perform(open.clone());
    assert_eq!(editor.dialog(), Some(&Dialog::Unsaved));
    assert_eq!(editor.sketch().strokes.len(), 2);
    // Whoever gave up the drawing before choosing the file is not asked again.
    editor.perform(Action::DiscardAndContinue);
    assert_eq!(editor.sketch().strokes.len(), 1);
    draw(&mut editor);
    editor.perform(Action::Open);
    editor.perform(Action::DiscardAndContinue);
    editor.perform(open);
    assert_eq!(editor.sketch().strokes.len(), 1);
}

#[test]
fn a_file_that_the_systems_dialog_did_not_ask_about_is_not_written_over_unasked() {
    let home = TempDir::new().unwrap();
    let (mut editor, full) = (editor(home.path()), home.path().join("rose.penstemon"));
    std::fs::write(&full, "somebody's work").unwrap();
    draw(&mut editor);
    // The dialog asked about `rose`, which is not there.
    save_as(&mut editor, &home.path().join("rose"));
    let asked = Dialog::Replace { purpose: PathPurpose::SaveDrawing, path: full.clone() };
    assert!(!editor.disk.saver.is_busy() && editor.dialog() == Some(&asked), "{:?}", editor.dialog());
    assert_eq!(std::fs::read_to_string(&full).unwrap(), "somebody's work");
    editor.perform(Action::CloseDialog);
    assert!(editor.drawing.path().is_none());
    // Asked about the whole name, it is replaced; and what is not there needs no question.
    save_as(&mut editor, &full);
    settle(&mut editor);
    assert_eq!(strokes_at(&full), 1);
    save_as(&mut editor, &home.path().join("tulip"));
    settle(&mut editor);
    assert_eq!(strokes_at(&home.path().join("tulip.penstemon")), 1);
}

#[test]
fn a_species_file_is_saved_without_the_folders_of_the_machine_and_is_still_known_here() {
    const WEED: &str = include_str!("../../../tests/fixtures/weed.toml");
    let home = TempDir::new().unwrap();
    let (drawings, own) = (home.path().join("drawings"), home.path().join("own"));
    std::fs::create_dir(&own).unwrap();
    std::fs::create_dir_all(drawings.join("mine")).unwrap();
    let (far, near) = (own.join("weed.toml"), drawings.join("mine/weed.toml"));
    for path in [&far, &near] {
        std::fs::write(path, WEED).unwrap();
    }
    let mut first = editor(home.path());
    draw(&mut first);
    let drawing = drawings.join("rose.penstemon");
    for (species, written) in [(&far, "weed.toml"), (&near, "mine/weed.toml")] {
        first.perform(Action::PathChosen { purpose: PathPurpose::Species, path: species.clone() });
        save_as(&mut first, &drawing);
        settle(&mut first);
        assert_eq!(sketch::read(&drawing).unwrap().0.species.as_deref(), Some(written));
        let known = first.sketch().species.as_deref().unwrap();
        assert!(Path::new(known) == species.as_path() && first.drawing.is_saved(), "{known}");
    }
    // Opened again it is found, and again when it is saved elsewhere.
    let mut second = editor(home.path());
    second.perform(Action::OpenPath(drawing));
    assert_eq!(second.live.species().map(|species| species.name.as_str()), Some("weed"));
    save_as(&mut second, &home.path().join("elsewhere.penstemon"));
    settle(&mut second);
    let there = sketch::read(&home.path().join("elsewhere.penstemon")).unwrap().0;
    assert_eq!(there.species.as_deref(), Some("drawings/mine/weed.toml"));
}

#[test]
fn folders_are_remembered_for_each_kind_of_file() {
    let home = TempDir::new().unwrap();
    let [drawings, pictures] = ["drawings", "pictures"].map(|name| home.path().join(name));
    for folder in [&drawings, &pictures] {
        std::fs::create_dir(folder).unwrap();
    }
    let mut first = editor(home.path());
    draw(&mut first);
    save_as(&mut first, &drawings.join("rose"));
    settle(&mut first);
    let picture = pictures.join("photo.png");
    first.perform(Action::PathChosen { purpose: PathPurpose::Reference, path: picture });
    first.save_settings();
    drop(first);
    let second = editor(home.path());
    assert_eq!(second.path_request(PathPurpose::OpenDrawing).folder, drawings);
    assert_eq!(second.path_request(PathPurpose::Texture(None)).folder, pictures);
    std::fs::remove_dir_all(&pictures).unwrap();
    assert_ne!(second.path_request(PathPurpose::Texture(None)).folder, pictures, "it is gone");
}

#[test]
fn a_recovery_copy_that_cannot_be_kept_is_reported_once() {
    let home = TempDir::new().unwrap();
    std::fs::write(home.path().join("state"), b"a file where the folder belongs").unwrap();
    let mut editor = editor(home.path());
    draw(&mut editor);
    let begun = Instant::now();
    while errors(&editor).is_empty() {
        assert!(begun.elapsed() < PATIENCE, "it is never told");
        std::thread::sleep(Duration::from_millis(1));
        editor.submit();
    }
    let reported = errors(&editor);
    assert!(reported.len() == 1 && reported[0].contains("no recovery copy can be kept"), "{reported:?}");
    let shown: Vec<u64> = editor.dialogs.notices().iter().map(|notice| notice.id).collect();
    shown.into_iter().for_each(|id| editor.dialogs.notices_mut().dismiss(id));
    editor.submit();
    assert_eq!(errors(&editor), Vec::<&str>::new(), "once is enough");
    assert_eq!(editor.panel_snapshot().status.autosave, Autosave::Failed);
    assert!(editor.wakes_at().is_some(), "the window looks whether it works again");
}
