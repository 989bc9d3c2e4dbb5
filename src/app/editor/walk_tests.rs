//! Walking through a plant and its garden: keys, taps, drags, wheels, and the way back.

use super::*;
use crate::app::editor::test_window::{build, frame, touch, with_sketch};
use crate::pen::{PenPhase, PenTool};
use egui::Modifiers;
use glam::{DVec2, Vec2, Vec3Swizzles as _};

fn press(editor: &mut Editor, key: Key) -> bool {
    editor.key(key, Modifiers::NONE, true, false)
}

/// Frames until the camera rests.
fn arrive(editor: &mut Editor, egui: &egui::Context) {
    for _ in 0..10_000 {
        frame(editor, egui);
        if !editor.plant.is_moving() {
            return;
        }
    }
    panic!("the camera flies for ever");
}

fn walking(home: &tempfile::TempDir) -> (Editor, egui::Context) {
    let (mut editor, egui) = with_sketch(home, "balloon_flower");
    build(&mut editor);
    frame(&mut editor, &egui);
    press(&mut editor, Key::Q);
    arrive(&mut editor, &egui);
    (editor, egui)
}

#[test]
fn one_stands_on_the_ground_before_the_plant_and_comes_back() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = with_sketch(&home, "balloon_flower");
    build(&mut editor);
    frame(&mut editor, &egui);
    let before = editor.plant.camera();
    assert!(press(&mut editor, Key::Q));
    arrive(&mut editor, &egui);
    let (low, high) = editor.plant.bounds().unwrap();
    let camera = editor.plant.camera();
    assert!(camera.eye().y > high.y && camera.eye().y < 1.3 * high.y, "over the plant: {}", camera.eye());
    let seen = camera.project(low.midpoint(high)).unwrap();
    assert!(seen.abs().max_element() < 0.5, "the plant is before the eye: {seen}");
    assert!(editor.plant.state.walking);
    press(&mut editor, Key::Escape);
    arrive(&mut editor, &egui);
    assert_eq!((editor.plant.camera(), editor.plant.state.walking), (before, false));
}

#[test]
fn keys_walk_turn_and_raise_the_eye() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, _egui) = walking(&home);
    let eye = |editor: &Editor| editor.plant.camera().eye();
    let start = eye(&editor);
    press(&mut editor, Key::ArrowUp);
    assert!(eye(&editor).z < start.z - 0.01 && eye(&editor).y == start.y, "ahead");
    press(&mut editor, Key::ArrowDown);
    assert!(eye(&editor).distance(start) < 1e-4, "and back");
    editor.key(Key::ArrowRight, Modifiers::SHIFT, true, false);
    assert!(eye(&editor).x > start.x + 0.01, "aside");
    let turned = editor.plant.camera().yaw_deg;
    press(&mut editor, Key::ArrowRight);
    assert!(editor.plant.camera().yaw_deg < turned - 1.0, "to the right");
    press(&mut editor, Key::PageUp);
    assert!(eye(&editor).y > 1.05 * start.y);
    press(&mut editor, Key::Q);
    press(&mut editor, Key::ArrowUp);
    assert!(!editor.plant.state.walking, "arrows are what they were");
}

#[test]
fn a_tap_goes_there_and_a_drag_looks_around() {
    for tool in [PenTool::Pen, PenTool::Mouse, PenTool::Finger(1)] {
        let home = tempfile::tempdir().unwrap();
        let (mut editor, egui) = walking(&home);
        let place = Vec2::new(0.3, 0.2);
        let at = editor.plant.seen_at(Vec3::new(place.x, 0.0, place.y)).unwrap();
        let start = editor.plant.camera();
        touch(&mut editor, (PenPhase::Down, tool), at, 0.5);
        touch(&mut editor, (PenPhase::Up, tool), at, 0.0);
        arrive(&mut editor, &egui);
        let there = editor.plant.camera();
        let (before, after) = (start.eye().xz().distance(place), there.eye().xz().distance(place));
        assert!(after < before && there.yaw_deg == start.yaw_deg, "{tool:?}: {before} {after}");
        touch(&mut editor, (PenPhase::Down, tool), at, 0.5);
        for k in 1..=10 {
            touch(&mut editor, (PenPhase::Move, tool), at + DVec2::new(8.0 * f64::from(k), 0.0), 0.5);
        }
        touch(&mut editor, (PenPhase::Up, tool), at + DVec2::new(80.0, 0.0), 0.0);
        let turned = editor.plant.camera();
        assert!(turned.eye().distance(there.eye()) < 1e-4, "{tool:?}: the eye stays");
        assert!(turned.yaw_deg > there.yaw_deg + 1.0, "{tool:?}: what is seen follows");
        assert!(editor.canvas.selection().is_empty(), "{tool:?}: nothing is picked");
    }
}

#[test]
fn one_does_not_walk_through_the_plant_that_is_tapped() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = walking(&home);
    let (low, high) = editor.plant.bounds().unwrap();
    let at = editor.plant.seen_at(low.midpoint(high)).unwrap();
    let start = editor.plant.camera().eye();
    touch(&mut editor, (PenPhase::Down, PenTool::Pen), at, 0.5);
    touch(&mut editor, (PenPhase::Up, PenTool::Pen), at, 0.0);
    arrive(&mut editor, &egui);
    let eye = editor.plant.camera().eye();
    assert!(eye.z < start.z && eye.z > high.z, "before the plant: {start} {eye} {high}");
}

#[test]
fn a_garden_is_painted_while_one_stands_in_it() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = walking(&home);
    let camera = editor.plant.camera();
    press(&mut editor, Key::N);
    frame(&mut editor, &egui);
    assert_eq!(editor.plant.camera(), camera, "the view stays on the ground");
    let at = editor.plant.seen_at(Vec3::new(0.2, 0.0, 0.2)).unwrap();
    touch(&mut editor, (PenPhase::Down, PenTool::Pen), at, 0.5);
    touch(&mut editor, (PenPhase::Up, PenTool::Pen), at, 0.0);
    build(&mut editor);
    assert_eq!(editor.sketch().garden.len(), 1);
    assert_eq!(editor.plant.camera(), camera);
}

#[test]
fn other_ways_to_look_end_the_walk() {
    let ends = [Action::FrontView, Action::SetTurntable(true), Action::SetOrthographic(false)];
    for action in ends {
        let home = tempfile::tempdir().unwrap();
        let (mut editor, egui) = walking(&home);
        let wide = editor.plant.camera().field_of_view_deg;
        editor.perform(action.clone());
        frame(&mut editor, &egui);
        assert!(!editor.plant.state.walking, "{action:?}");
        editor.perform(Action::SetTurntable(false));
        editor.perform(Action::FrontView);
        arrive(&mut editor, &egui);
        let camera = editor.plant.camera();
        assert!(camera.field_of_view_deg < wide && camera.lamps_yaw_deg.is_none(), "{action:?}");
    }
}

#[test]
fn on_an_empty_sheet_there_is_nowhere_to_walk() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, _egui) = with_sketch(&home, "balloon_flower");
    editor.perform(Action::New);
    build(&mut editor);
    press(&mut editor, Key::Q);
    assert!(editor.plant.state.walking == editor.plant.bounds().is_some());
}
