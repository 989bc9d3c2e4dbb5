//! Drawings and presets whose species file is gone.

use super::*;
use crate::app::action::Action;
use crate::app::editor::Places;
use crate::app::presets::Preset;
use std::path::Path;

const SPECIES: &str = include_str!("../../../assets/species/daisy.toml");

fn editor(home: &Path) -> Editor {
    let places = Places { config: home.join("config"), state: home.join("state") };
    Editor::open_in(places, None, || ()).unwrap()
}

/// A drawing that names a species file which is not there.
fn drawing(home: &Path) -> std::path::PathBuf {
    let text = r#"{"format": "penstemon-sketch", "version": 1, "species": "own/weed.toml",
        "strokes": [{"points": [[0, 0], [9, 9]]}]}"#;
    let drawing = home.join("old.penstemon");
    std::fs::write(&drawing, text).unwrap();
    drawing
}

fn finds(editor: &Editor) -> Vec<String> {
    let offers = |notice: &&Notice| notice.find == Some(PathPurpose::Species);
    editor.dialogs.notices().iter().filter(offers).map(|notice| notice.what.clone()).collect()
}

#[test]
fn a_missing_species_is_one_notice_and_is_found_again_in_one_step() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = editor(home.path());
    editor.perform(Action::OpenPath(drawing(home.path())));
    assert!(matches!(&finds(&editor)[..], [what] if what.contains("weed.toml")), "{:?}", finds(&editor));
    assert_eq!(editor.panel_snapshot().missing_species.as_deref(), Some("weed.toml"));
    let weed = home.path().join("weeds.toml");
    std::fs::write(&weed, SPECIES).unwrap();
    editor.perform(Action::PathChosen { purpose: PathPurpose::Species, path: weed.clone() });
    assert_eq!(editor.sketch().species.as_deref(), weed.to_str());
    assert_eq!(editor.panel_snapshot().missing_species, None);
    editor.perform(Action::Undo);
    assert_eq!(editor.sketch().species.as_deref(), Some("own/weed.toml"));
    assert_eq!(editor.panel_snapshot().missing_species.as_deref(), Some("weed.toml"), "it is missing again");
    assert_eq!((editor.drawing.can_undo(), finds(&editor).len()), (false, 1));
}

#[test]
fn a_species_that_is_there_is_not_reported() {
    let home = tempfile::tempdir().unwrap();
    std::fs::create_dir(home.path().join("own")).unwrap();
    std::fs::write(home.path().join("own/weed.toml"), SPECIES).unwrap();
    let mut editor = editor(home.path());
    editor.perform(Action::OpenPath(drawing(home.path())));
    assert_eq!((finds(&editor).len(), editor.panel_snapshot().missing_species), (0, None));
}

#[test]
fn a_preset_may_name_a_missing_species_too() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = editor(home.path());
    let species = Some(home.path().join("gone.toml").to_string_lossy().into_owned());
    let preset = Preset { name: "Weeds".to_owned(), species, ..Preset::default() };
    editor.disk.presets.save(&preset).unwrap();
    editor.perform(Action::ApplyPreset(editor.disk.presets.listed()[0].path.clone()));
    assert!(matches!(&finds(&editor)[..], [what] if what.contains("gone.toml")), "{:?}", finds(&editor));
}
