//! What strokes were read as is taken back, chosen otherwise, undone, kept while drawing goes on, saved and recovered.

use crate::app::action::Action;
use crate::app::editor::test_window::{PATIENCE, build};
use crate::app::editor::{Editor, Places};
use crate::app::panels::snapshot::{Dialog, MenuOf, ReadTogether};
use crate::sketch::{Change, Reading, Stroke, StrokePoint, Tool, Verdict, json};
use glam::vec2;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// An editor with a plant in a pot that a person drew: four strokes, of which the first is the pot.
fn potted(home: &tempfile::TempDir) -> Editor {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/strokes/house_plant.json");
    let drawings: serde_json::Value = serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap();
    let strokes: Vec<Vec<[f32; 2]>> = serde_json::from_value(drawings[4]["strokes"].clone()).unwrap();
    let mut editor = editor(home);
    editor.perform(Action::New);
    for (points, id) in strokes.into_iter().zip(1..) {
        let points = points.into_iter().map(|[x, y]| StrokePoint::at(2.0 * vec2(x, y))).collect();
        editor.change(Change::put(Stroke { id, tool: Tool::Auto, points, brush: None }));
    }
    build(&mut editor);
    editor
}

fn editor(home: &tempfile::TempDir) -> Editor {
    open(home, None)
}

fn open(home: &tempfile::TempDir, file: Option<PathBuf>) -> Editor {
    let places = Places { config: home.path().join("config"), state: home.path().join("state") };
    Editor::open_in(places, file, || ()).unwrap()
}

fn readings(editor: &mut Editor) -> Vec<Reading> {
    build(editor);
    editor.panel_snapshot().readings.iter().map(|read| read.reading).collect()
}

#[test]
fn one_tap_takes_a_reading_back_and_one_undo_brings_it_again() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = potted(&home);
    let before = editor.panel_snapshot().readings;
    assert_eq!(before[0], ReadTogether { reading: Reading::Pot, stroke: 1, count: 1 });
    editor.perform(Action::RefuseReading(1));
    assert!(!readings(&mut editor).contains(&Reading::Pot));
    assert!(editor.built().unwrap().anatomy.solids.is_empty());
    editor.perform(Action::Undo);
    assert!(readings(&mut editor).contains(&Reading::Pot) && editor.sketch().corrections.is_empty());
    editor.perform(Action::Redo);
    assert!(!readings(&mut editor).contains(&Reading::Pot));
    // Drawing goes on.
    let points = [vec2(10.0, 10.0), vec2(60.0, 15.0)].map(StrokePoint::at).to_vec();
    editor.change(Change::put(Stroke { id: 9, tool: Tool::Auto, points, brush: None }));
    assert!(!readings(&mut editor).contains(&Reading::Pot));
}

#[test]
fn what_was_taken_back_stays_so_in_the_file_and_in_recovery() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = potted(&home);
    editor.perform(Action::RefuseReading(1));
    let kept = editor.sketch().clone();
    assert_eq!(kept.corrections[0].verdict, Verdict::Not(Reading::Pot));
    let file = home.path().join("potted.penstemon");
    std::fs::write(&file, json::write(&kept)).unwrap();
    editor.break_off();
    drop(editor);
    let mut next = self::editor(&home);
    let Some(Dialog::Recovery(lost)) = next.dialog() else { panic!("nothing is offered") };
    let lost = lost[0].path.clone();
    next.perform(Action::Recover(lost));
    assert_eq!((&next.sketch().corrections, &next.sketch().strokes), (&kept.corrections, &kept.strokes));
    assert!(!readings(&mut next).contains(&Reading::Pot));
    let elsewhere = tempfile::tempdir().unwrap();
    let mut opened = open(&elsewhere, Some(file));
    assert_eq!(opened.sketch().corrections, kept.corrections);
    assert!(!readings(&mut opened).contains(&Reading::Pot));
}

#[test]
fn other_ways_are_looked_for_and_a_tap_chooses_one() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = potted(&home);
    editor.perform(Action::ShowWays { stroke: 1, at: [20.0, 20.0] });
    assert_eq!(editor.panel_snapshot().part_menu.unwrap().of, MenuOf::Reading(1));
    let ways = found(&mut editor);
    assert_eq!(ways[0].correction.verdict, Verdict::As(Reading::Pot));
    let apart = ways.last().unwrap().clone();
    assert_eq!(apart.correction.verdict, Verdict::Separate);
    assert!(ways.iter().all(|way| !way.lines.is_empty()) && ways[0].lines != apart.lines);
    editor.perform(Action::Correct(apart.correction));
    assert!(editor.panel_snapshot().part_menu.is_none());
    assert!(!readings(&mut editor).contains(&Reading::Pot));
    // The stroke itself still offers the pot.
    editor.perform(Action::ShowWays { stroke: 1, at: [20.0, 20.0] });
    assert_eq!(editor.panel_snapshot().ways.unwrap().reading, None);
    let pot = found(&mut editor)[0].correction.clone();
    editor.perform(Action::Correct(pot));
    assert!(readings(&mut editor).contains(&Reading::Pot));
    assert_eq!(editor.sketch().corrections.len(), 1, "the last word replaces what was said before");
}

fn found(editor: &mut Editor) -> Vec<crate::app::ways_to_read::WayToRead> {
    let begun = Instant::now();
    loop {
        assert!(begun.elapsed() < PATIENCE, "they are looked for for ever");
        editor.collect();
        if let Some(found) = editor.panel_snapshot().ways.unwrap().found {
            return found;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn the_guess_of_the_species_is_kept_or_left_to_the_drawing() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = potted(&home);
    let guess = editor.panel_snapshot();
    assert!(guess.species_is_guess);
    editor.perform(Action::SetSpecies(guess.species.clone()));
    let kept = editor.panel_snapshot();
    assert_eq!((kept.species, kept.species_is_guess), (guess.species, false));
    editor.perform(Action::GuessSpecies);
    assert!(editor.panel_snapshot().species_is_guess && editor.sketch().species.is_none());
}

#[test]
fn a_stroke_with_a_tool_of_its_own_is_what_that_says() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = potted(&home);
    editor.perform(Action::ShowWays { stroke: 1, at: [0.0; 2] });
    let pot = found(&mut editor)[0].correction.clone();
    editor.perform(Action::Correct(pot));
    let drawn = Stroke { tool: Tool::Leaf, ..Stroke::clone(&editor.sketch().strokes[0]) };
    editor.change(Change::put(Arc::new(drawn)));
    assert!(!readings(&mut editor).contains(&Reading::Pot));
}
