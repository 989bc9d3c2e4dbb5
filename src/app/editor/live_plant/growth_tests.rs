//! Growth in the editor: an age that is undone like any change, and a replay that is none.

use super::YEARS;
use crate::app::action::Action;
use crate::app::editor::replay::LENGTH;
use crate::app::editor::{Editor, Places};
use crate::app::panels::snapshot::GrowthState;
use crate::growth::habit::Resource;
use crate::growth::overlay::{Kind, Wanted};
use crate::sketch::{Change, Stroke, StrokePoint, Tool};
use glam::{Vec2, vec2};
use serde_json::Value;
use std::f32::consts::TAU;
use std::time::{Duration, Instant};

/// Longest wait for a plant; only a test that has failed takes so long.
const PATIENCE: Duration = Duration::from_secs(60);

fn step(editor: &mut Editor) {
    editor.submit();
    editor.collect();
    std::thread::sleep(Duration::from_millis(1));
}

fn settle(editor: &mut Editor) {
    let begun = Instant::now();
    while editor.is_working() {
        assert!(begun.elapsed() < PATIENCE, "it is built for ever");
        step(editor);
    }
}

/// An editor with a small oak in a round crown.
fn oak(home: &tempfile::TempDir) -> Editor {
    let places = Places { config: home.path().join("config"), state: home.path().join("state") };
    let mut editor = Editor::open_in(places, None, || ()).unwrap();
    editor.perform(Action::New);
    editor.perform(Action::SetSpecies("oak".into()));
    editor.perform(Action::SetParam { path: "growth.fineness".into(), value: Some(Value::from(0.5)) });
    let circle = (0..=40).map(|k| vec2(300.0, 200.0) + Vec2::from_angle(k as f32 / 40.0 * TAU) * 150.0);
    let points = circle.map(StrokePoint::at).collect();
    editor.change(Change::put(Stroke { id: 1, tool: Tool::Crown, points, brush: None }));
    settle(&mut editor);
    editor
}

fn shown(editor: &Editor) -> f32 {
    editor.built().unwrap().growth.unwrap().shown
}

fn growth_state(editor: &Editor) -> GrowthState {
    editor.live.growth_state(editor.sketch()).unwrap()
}

/// Moves a replay on, whose clock stands still from here on, and waits for the plant of its age.
fn advance(editor: &mut Editor, by: Duration) {
    editor.live.replay.as_mut().unwrap().advance(by);
    editor.live.replay_moved();
    let begun = Instant::now();
    editor.submit();
    while editor.live.is_running {
        assert!(begun.elapsed() < PATIENCE, "it is built for ever");
        editor.collect();
        std::thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn a_replay_follows_the_clock() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = oak(&home);
    editor.perform(Action::PlayGrowth(true));
    editor.live.is_stale = false;
    editor.live.replay_growth(Instant::now() + LENGTH / 2);
    assert!(editor.live.is_stale && editor.live.replay.unwrap().value() > 0.0);
}

#[test]
fn the_age_is_set_and_undone_like_any_change() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = oak(&home);
    let filled = shown(&editor);
    let state = growth_state(&editor);
    assert!(filled > 2.0 && state.age == filled && !state.chosen && state.crown && state.most >= 39.0);
    editor.perform(Action::SetParam { path: YEARS.into(), value: Some(Value::from(2.5)) });
    settle(&mut editor);
    assert_eq!(shown(&editor), 2.5);
    assert!(growth_state(&editor).chosen);
    editor.perform(Action::Undo);
    settle(&mut editor);
    assert_eq!(shown(&editor), filled);
}

#[test]
fn a_habit_is_set_shown_and_grown_and_rests_for_plants_that_do_not_grow() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = oak(&home);
    let (internode, bare) = ("habit.internode", "habit.leaf.length");
    let before = editor.panel_snapshot().params;
    assert!((before.species[internode] - 0.25).abs() < 1e-6 && before.applies(bare));
    assert!(!editor.built().unwrap().plant.organs.is_empty());
    editor.perform(Action::SetParam { path: bare.into(), value: Some(Value::from(0.0)) });
    settle(&mut editor);
    assert!(editor.built().unwrap().plant.organs.is_empty(), "it has grown again, without leaves");
    assert_eq!(editor.panel_snapshot().params.own[bare], 0.0);
    editor.perform(Action::SetParam { path: "habit.age".into(), value: Some(Value::from(60)) });
    assert_eq!(growth_state(&editor).most, 90.0, "the slider reaches as far");
    editor.perform(Action::SelectAll);
    editor.perform(Action::DeleteSelected);
    editor.perform(Action::SetSpecies("daisy".into()));
    settle(&mut editor);
    assert!(!editor.panel_snapshot().params.applies(bare));
    assert_eq!(editor.panel_snapshot().notices, [], "what rests is no fault");
}

#[test]
fn growth_is_seen_from_inside_only_while_it_is_asked_for() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = oak(&home);
    let (before, plant) = (editor.sketch().clone(), editor.built().unwrap().plant.clone());
    assert!(editor.built().unwrap().overlay.is_empty());
    let wanted = Wanted { markers: true, ..Wanted::default() };
    editor.perform(Action::SetOverlay(wanted));
    settle(&mut editor);
    let built = editor.built().unwrap().clone();
    assert!(built.overlay.iter().all(|spot| matches!(spot.kind, Kind::Free | Kind::Taken)));
    assert!(built.overlay.len() > 1000 && built.plant == plant, "{}", built.overlay.len());
    assert_eq!(editor.panel_snapshot().view.overlay, wanted);
    assert_eq!(editor.panel_snapshot().growth.unwrap().resource, Some(Resource::Space));
    editor.perform(Action::SetOverlay(Wanted::default()));
    settle(&mut editor);
    assert!(editor.built().unwrap().overlay.is_empty());
    assert_eq!(*editor.sketch(), before, "it is no change of the drawing");
}

#[test]
fn a_replay_shows_rising_ages_changes_nothing_and_comes_to_rest() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = oak(&home);
    let (filled, before) = (shown(&editor), editor.sketch().clone());
    editor.perform(Action::PlayGrowth(true));
    let mut ages = Vec::new();
    while editor.live.replay.is_some() {
        advance(&mut editor, LENGTH / 8);
        ages.push(shown(&editor) / filled);
        let state = growth_state(&editor);
        assert!(!state.playing || state.age <= filled);
    }
    assert_eq!(ages, [0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0]);
    settle(&mut editor);
    assert_eq!(shown(&editor), filled);
    assert_eq!(*editor.sketch(), before);
    assert!(editor.live.replay.is_none() && editor.live.next_age_at().is_none());
}

#[test]
fn a_pause_keeps_its_age_at_rest_and_a_change_ends_it() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = oak(&home);
    let filled = shown(&editor);
    editor.perform(Action::PlayGrowth(true));
    advance(&mut editor, LENGTH / 2);
    editor.perform(Action::PlayGrowth(false));
    settle(&mut editor);
    let paused = growth_state(&editor);
    assert!(!paused.playing && paused.age > 0.4 * filled && paused.age < filled, "{paused:?}");
    assert!(editor.live.next_age_at().is_none() && !editor.is_working(), "the window rests");
    assert!((shown(&editor) - paused.age).abs() < 0.1 * filled);
    editor.perform(Action::SetParam { path: YEARS.into(), value: Some(Value::from(3.0)) });
    settle(&mut editor);
    assert!(editor.live.replay.is_none());
    assert_eq!(shown(&editor), 3.0);
}

/// An editor with a bare stem of a peony, which ends in a flower.
fn peony(home: &tempfile::TempDir) -> Editor {
    let places = Places { config: home.path().join("config"), state: home.path().join("state") };
    let mut editor = Editor::open_in(places, None, || ()).unwrap();
    editor.perform(Action::New);
    editor.perform(Action::SetSpecies("peony".into()));
    let points = (0..=20).map(|k| StrokePoint::at(vec2(300.0, 500.0 - 18.0 * k as f32))).collect();
    editor.change(Change::put(Stroke { id: 1, tool: Tool::Branch, points, brush: None }));
    settle(&mut editor);
    editor
}

/// How high the petals of its flower reach, and how many there are.
fn petals(editor: &Editor) -> (f32, usize) {
    let built = editor.built().unwrap();
    let petals = built.model.parts.iter().filter(|part| part.name.starts_with("petal"));
    let heights = petals.flat_map(|part| part.flattened_mesh().points.clone()).map(|point| point.x.abs());
    (heights.fold(0.0, f32::max), built.plant.flowers.len())
}

#[test]
fn the_flower_of_a_bare_stem_opens_by_the_slider_and_before_the_artists_eyes() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = peony(&home);
    let state = editor.panel_snapshot().opening.unwrap();
    assert!(state.open == 1.0 && !state.chosen && !state.playing, "{state:?}");
    let (wide, flowers) = petals(&editor);
    assert!(flowers == 1 && wide > 0.0);
    editor.perform(Action::PlayOpening(true));
    let mut widths = Vec::new();
    while editor.live.replay.is_some() {
        advance(&mut editor, LENGTH / 4);
        widths.push(petals(&editor).0);
    }
    assert!(widths.is_sorted() && widths[0] < 0.75 * wide && widths[3] == wide, "{widths:?}");
    assert!(editor.sketch().params.is_empty(), "it is no change of the drawing");
    editor.perform(Action::SetParam { path: "flower.open".into(), value: Some(Value::from(0.0)) });
    settle(&mut editor);
    assert!(petals(&editor).0 < 0.75 * wide && editor.panel_snapshot().opening.unwrap().chosen);
    editor.perform(Action::SetSpecies("oak".into()));
    settle(&mut editor);
    assert_eq!(editor.panel_snapshot().opening, None);
}
