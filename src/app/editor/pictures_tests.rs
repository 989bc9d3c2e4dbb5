//! Tests of pictures that the artist chooses: they belong to the drawing, and nothing broken gets in.

use super::*;
use crate::app::editor::Places;
use crate::plant::OrganKind;
use crate::sketch::{self, Change, Stroke, StrokePoint, Tool};
use std::time::{Duration, Instant};

/// Longest wait for anything; only a test that has failed takes so long.
const PATIENCE: Duration = Duration::from_secs(60);
const PNG: &[u8] = include_bytes!("../../../tests/fixtures/reference/small.png");
const PETAL: PathPurpose = PathPurpose::Texture(Some(OrganKind::Petal));

fn editor(home: &Path) -> Editor {
    let places = Places { config: home.join("config"), state: home.join("state") };
    let mut editor = Editor::open_in(places, None, || ()).unwrap();
    editor.perform(Action::New);
    let points = (0..9).map(|i| StrokePoint::at(glam::Vec2::splat(i as f32))).collect();
    editor.change(Change::put(Stroke { id: 1, tool: Tool::Branch, points, brush: None }));
    editor
}

/// Waits until something holds.
fn until(editor: &mut Editor, holds: impl Fn(&Editor) -> bool) {
    let begun = Instant::now();
    while !holds(editor) {
        assert!(begun.elapsed() < PATIENCE, "it never happens");
        std::thread::sleep(Duration::from_millis(1));
        editor.collect();
    }
}

fn choose(editor: &mut Editor, purpose: PathPurpose, path: &Path) {
    editor.perform(Action::PathChosen { purpose, path: path.to_owned() });
}

fn texture<'a>(editor: &'a Editor, part: &str) -> Option<&'a TextureChoice> {
    editor.sketch().textures.get(part)
}

#[test]
fn a_chosen_picture_stays_when_its_file_is_gone_and_no_path_is_saved() {
    let home = tempfile::tempdir().unwrap();
    let (picture, drawing) = (home.path().join("petal.png"), home.path().join("rose.penstemon"));
    std::fs::write(&picture, PNG).unwrap();
    let mut first = editor(home.path());
    choose(&mut first, PETAL, &picture);
    until(&mut first, |editor| texture(editor, "petal").is_some());
    choose(&mut first, PathPurpose::SaveDrawing, &drawing);
    until(&mut first, |editor| !editor.disk.saver.is_busy());
    std::fs::remove_file(&picture).unwrap();
    let text = std::fs::read_to_string(&drawing).unwrap();
    assert!(!text.contains("petal.png") && !text.contains(&home.path().display().to_string()), "{text}");
    let mut second = editor(home.path());
    second.perform(Action::OpenPath(drawing));
    second.perform(Action::DiscardAndContinue);
    let own = TextureChoice::Own(Picture::new(PNG).unwrap());
    assert_eq!(texture(&second, "petal"), Some(&own));
    second.perform(Action::SetTexture { organ: Some(OrganKind::Petal), texture: None });
    second.perform(Action::Undo);
    assert_eq!(texture(&second, "petal"), Some(&own));
}

#[test]
fn a_picture_that_cannot_be_shown_is_refused_when_it_is_chosen() {
    let home = tempfile::tempdir().unwrap();
    let cut = home.path().join("cut.png");
    std::fs::write(&cut, &PNG[..PNG.len() - 20]).unwrap();
    let mut editor = editor(home.path());
    for purpose in [PETAL, PathPurpose::Reference] {
        choose(&mut editor, purpose, &cut);
        until(&mut editor, |editor| {
            editor.dialogs.notices().iter().any(|notice| notice.what.contains("cut.png"))
        });
        let notice = editor.dialogs.notices().iter().next_back().unwrap().clone();
        assert_eq!(notice.find, Some(purpose), "{notice:?}");
        editor.perform(Action::DismissNotice(notice.id));
    }
    let sketch = editor.sketch();
    assert!(sketch.textures.is_empty() && sketch.reference.is_none());
}

#[test]
fn an_old_drawing_takes_its_pictures_in_and_a_missing_one_is_one_notice_that_finds_it_for_all_parts() {
    let home = tempfile::tempdir().unwrap();
    std::fs::write(home.path().join("leaf.png"), PNG).unwrap();
    let drawing = home.path().join("old.penstemon");
    let old = r#"{"format": "penstemon-sketch", "version": 1, "strokes": [{"points": [[0, 0], [9, 9]]}], "textures":
        {"leaf": "/home/ada/leaf.png", "petal": "/home/ada/gone.png", "sepal": "/home/ada/gone.png"}}"#;
    std::fs::write(&drawing, old).unwrap();
    let mut editor = editor(home.path());
    let before = editor.dialogs.notices().iter().count();
    editor.perform(Action::OpenPath(drawing));
    editor.perform(Action::DiscardAndContinue);
    let own = TextureChoice::Own(Picture::new(PNG).unwrap());
    assert_eq!(texture(&editor, "leaf"), Some(&own));
    assert_eq!(editor.dialogs.notices().iter().count(), before + 1, "one picture is missing");
    let notice = editor.dialogs.notices().iter().next_back().unwrap();
    assert!(notice.what.contains("gone.png") && notice.find == Some(PETAL), "{notice:?}");
    let text = sketch::json::write(editor.sketch());
    assert!(!text.contains("/home/ada"), "{text}");
    choose(&mut editor, PETAL, &home.path().join("leaf.png"));
    until(&mut editor, |editor| texture(editor, "sepal") == Some(&own));
    assert_eq!(texture(&editor, "petal"), Some(&own));
}

#[test]
fn presets_carry_pictures() {
    let home = tempfile::tempdir().unwrap();
    let picture = home.path().join("petal.png");
    std::fs::write(&picture, PNG).unwrap();
    let mut editor = editor(home.path());
    choose(&mut editor, PETAL, &picture);
    until(&mut editor, |editor| texture(editor, "petal").is_some());
    editor.perform(Action::SavePreset("Spots".to_owned()));
    std::fs::remove_file(&picture).unwrap();
    editor.perform(Action::Undo);
    assert_eq!(texture(&editor, "petal"), None);
    editor.perform(Action::ApplyPreset(editor.disk.presets.listed()[0].path.clone()));
    assert_eq!(texture(&editor, "petal"), Some(&TextureChoice::Own(Picture::new(PNG).unwrap())));
}
