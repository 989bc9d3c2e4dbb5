//! Strokes copied, pasted and moved by keys.

use super::*;
use crate::app::action::Action;
use crate::app::canvas_tool::{CanvasTool, Mirror};
use crate::app::editor::Places;
use crate::sketch::{Change, Stroke, StrokePoint, Tool};
use egui::{Key, Modifiers};
use glam::{Vec2, vec2};

fn editor(home: &tempfile::TempDir) -> Editor {
    let places = Places { config: home.path().join("config"), state: home.path().join("state") };
    let mut editor = Editor::open_in(places, None, || ()).unwrap();
    editor.perform(Action::New);
    editor
}

/// A leaf with pressure and tilt, and a branch.
fn drawn(home: &tempfile::TempDir) -> Editor {
    let mut editor = editor(home);
    let point = |x: f32, y: f32| StrokePoint {
        position: vec2(x, y),
        pressure: 0.25,
        tilt_deg: vec2(12.0, -3.0),
        time_ms: x,
        depth: 0.0,
    };
    let leaf = Stroke {
        id: 1,
        tool: Tool::Leaf,
        points: (0..9).map(|k| point(k as f32, 5.0)).collect(),
        brush: None,
    };
    let branch = Stroke {
        id: 2,
        tool: Tool::Branch,
        points: (0..9).map(|k| point(3.0, k as f32)).collect(),
        brush: None,
    };
    editor.change(Change::put(leaf));
    editor.change(Change::put(branch));
    editor
}

fn press(editor: &mut Editor, key: Key, modifiers: Modifiers) {
    assert!(editor.key(key, modifiers, true, false), "{key:?}");
}

fn copied_text(editor: &mut Editor) -> String {
    match editor.take_copied() {
        Some(Copied::Text(text)) => text,
        _ => panic!("strokes were to be copied"),
    }
}

fn first_place(editor: &Editor, stroke: usize) -> Vec2 {
    editor.sketch().strokes[stroke].points[0].position
}

#[test]
fn strokes_are_copied_into_another_window_with_all_that_the_pen_said() {
    let homes = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    let (mut here, mut there) = (drawn(&homes[0]), editor(&homes[1]));
    press(&mut here, Key::A, Modifiers::COMMAND);
    press(&mut here, Key::C, Modifiers::COMMAND);
    let text = copied_text(&mut here);
    there.paste_text(&text);
    let pairs = here.sketch().strokes.iter().zip(&there.sketch().strokes);
    for (from, to) in pairs {
        let shift = to.points[0].position - from.points[0].position;
        assert_eq!((from.tool, from.points.len()), (to.tool, to.points.len()));
        for (a, b) in from.points.iter().zip(&to.points) {
            assert!(b.position.distance(a.position + shift) < 1e-3);
            assert_eq!((a.pressure, a.tilt_deg, a.time_ms), (b.pressure, b.tilt_deg, b.time_ms));
        }
    }
    assert_eq!(there.canvas().selection().ids().len(), 2, "what was pasted is selected");
    assert_eq!(there.canvas().tool(), CanvasTool::Select);
    there.perform(Action::Undo);
    assert!(there.sketch().strokes.is_empty(), "it was one step");
}

#[test]
fn pasted_strokes_never_lie_exactly_on_others() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = drawn(&home);
    press(&mut editor, Key::A, Modifiers::COMMAND);
    press(&mut editor, Key::C, Modifiers::COMMAND);
    let text = copied_text(&mut editor);
    for _ in 0..3 {
        editor.paste_text(&text);
    }
    let strokes = &editor.sketch().strokes;
    assert_eq!(strokes.len(), 8);
    for (i, stroke) in strokes.iter().enumerate() {
        assert!(strokes[..i].iter().all(|other| other.points != stroke.points));
    }
}

#[test]
fn cutting_takes_the_strokes_out_and_svg_comes_in() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = drawn(&home);
    press(&mut editor, Key::A, Modifiers::COMMAND);
    press(&mut editor, Key::X, Modifiers::COMMAND);
    assert!(editor.sketch().strokes.is_empty() && copied_text(&mut editor).contains("\"leaf\""));
    editor.paste_text(r#"<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0 L50 20 L80 90"/></svg>"#);
    assert_eq!(editor.sketch().strokes.len(), 1);
    let before = editor.panel_snapshot().notices.len();
    editor.paste_text("a shopping list");
    assert_eq!((editor.sketch().strokes.len(), editor.panel_snapshot().notices.len()), (1, before + 1));
    press(&mut editor, Key::V, Modifiers::COMMAND);
    assert!(editor.take_paste_request() && !editor.take_paste_request());
}

#[test]
fn arrows_move_the_selection_and_a_burst_is_one_step() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = drawn(&home);
    assert!(!editor.key(Key::ArrowLeft, Modifiers::NONE, true, false), "nothing is selected");
    press(&mut editor, Key::A, Modifiers::COMMAND);
    let start = first_place(&editor, 0);
    for _ in 0..3 {
        press(&mut editor, Key::ArrowRight, Modifiers::NONE);
    }
    assert!(editor.key(Key::ArrowDown, Modifiers::SHIFT, true, true), "a held key goes on");
    assert!(first_place(&editor, 0).distance(start + vec2(3.0, 10.0)) < 1e-4);
    // A pause.
    editor.drawing.pause_nudging();
    press(&mut editor, Key::ArrowUp, Modifiers::NONE);
    editor.perform(Action::Undo);
    assert!(first_place(&editor, 0).distance(start + vec2(3.0, 10.0)) < 1e-4, "the last burst is taken back");
    editor.perform(Action::Undo);
    assert_eq!(first_place(&editor, 0), start, "the first burst is taken back");
}

#[test]
fn the_selection_is_mirrored_by_a_key_about_its_middle() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = drawn(&home);
    press(&mut editor, Key::A, Modifiers::COMMAND);
    press(&mut editor, Key::H, Modifiers::SHIFT);
    assert_eq!(first_place(&editor, 0), vec2(8.0, 5.0));
    assert_eq!(editor.sketch().strokes[0].points[0].tilt_deg, vec2(-12.0, -3.0));
    press(&mut editor, Key::V, Modifiers::SHIFT);
    assert_eq!(first_place(&editor, 0), vec2(8.0, 3.0));
    editor.perform(Action::MirrorSelected(Mirror::TopBottom));
    editor.perform(Action::MirrorSelected(Mirror::LeftRight));
    assert_eq!(first_place(&editor, 0), vec2(0.0, 5.0));
    assert_eq!(editor.canvas().selection().ids().len(), 2);
}
