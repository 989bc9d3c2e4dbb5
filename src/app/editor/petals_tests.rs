//! Petals are shaped in the view of the plant: chosen by a tap, moved by their points, undone, saved and given back.

use super::*;
use crate::app::editor::Places;
use crate::app::editor::test_window::{PATIENCE, build, frame, with_sketch};
use crate::pen::tests::Hand;
use crate::pen::{PenPhase, PenTool};
use crate::sketch::json;
use glam::Vec2;
use std::time::{Duration, Instant};

/// An editor with the balloon flower, built.
fn balloon_flower(home: &tempfile::TempDir) -> (Editor, egui::Context) {
    with_sketch(home, "balloon_flower")
}

/// The place of the first petal among the organs.
fn first_petal(editor: &Editor) -> usize {
    let built = editor.built().unwrap();
    (0..built.plant.organs.len()).find(|i| is_shapable(built, *i)).unwrap()
}

/// An editor with its first petal chosen.
fn with_petal(home: &tempfile::TempDir) -> (Editor, egui::Context) {
    let (mut editor, egui) = balloon_flower(home);
    editor.perform(Action::ShapePetals(true));
    let petal = first_petal(&editor);
    editor.choose_petal(Some(Element::Organ(petal)));
    frame(&mut editor, &egui);
    (editor, egui)
}

/// Where a control point is seen.
fn seen(editor: &Editor, row: usize, column: usize) -> DVec2 {
    editor.plant.seen_at(editor.petal_net().unwrap().points[row][column]).unwrap()
}

/// Drags a pointer over the plant, in three moves.
fn drag(editor: &mut Editor, tool: PenTool, from: DVec2, to: DVec2) {
    let mut at = |phase, position: DVec2| {
        let mut hand = Hand { position, ..Hand::default() };
        editor.plant_pen(&hand.event(phase, tool, 0.0));
    };
    at(PenPhase::Down, from);
    [0.5, 0.8, 1.0].into_iter().for_each(|t| at(PenPhase::Move, from.lerp(to, t)));
    at(PenPhase::Up, to);
}

fn offsets(editor: &Editor) -> Offsets {
    editor.sketch().petal_shapes.first().map_or(Offsets::default(), |shape| shape.offsets)
}

#[test]
fn a_tap_chooses_the_petal_that_the_window_shows_there() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = balloon_flower(&home);
    editor.key(egui::Key::K, egui::Modifiers::NONE, true, false);
    let petal = first_petal(&editor);
    let built = editor.built().unwrap().clone();
    let Shape::Blade(blade) = &built.plant.organs[petal].shape else { panic!("no blade") };
    let blade = built.plant.templates.resolve(blade);
    let at = editor.plant.seen_at(blade.at_rest(Vec2::Y * 0.6 * blade.template.length())).unwrap();
    for phase in [PenPhase::Down, PenPhase::Up] {
        let mut hand = Hand { position: at, ..Hand::default() };
        editor.plant_pen(&hand.event(phase, PenTool::Finger(1), 0.0));
    }
    let begun = Instant::now();
    while editor.petal_net().is_none() {
        assert!(begun.elapsed() < PATIENCE, "nothing is chosen");
        frame(&mut editor, &egui);
        std::thread::sleep(Duration::from_millis(5));
    }
    assert!(editor.petal_state().chosen && editor.canvas.selection().is_empty());
    let stroke = built.provenance.stroke(built.plant.organs[petal].origin);
    assert_eq!(editor.petals.chosen.map(|chosen| chosen.stroke), stroke);
    editor.key(egui::Key::K, egui::Modifiers::NONE, true, false);
    assert!(editor.petal_net().is_none(), "the tool is laid down");
}

#[test]
fn one_drag_of_a_point_by_any_pointer_is_one_step_and_shapes_the_flower() {
    for tool in [PenTool::Pen, PenTool::Mouse, PenTool::Finger(3)] {
        let home = tempfile::tempdir().unwrap();
        let (mut editor, egui) = with_petal(&home);
        let (from, camera) = (seen(&editor, 3, 1), editor.plant.camera());
        let to = from + DVec2::new(24.0, -40.0);
        drag(&mut editor, tool, from + DVec2::splat(3.0), to + DVec2::splat(3.0));
        assert_eq!(editor.plant.camera(), camera, "{tool:?}: a point is dragged, not the camera");
        let shape = &editor.sketch().petal_shapes[0];
        assert_eq!(shape.strokes.len(), 5, "all petals of the flower: {:?}", shape.strokes);
        let [left, right] = [1, 2].map(|column| offsets(&editor)[3][column]);
        assert!(left.length() > 0.02 && left.is_finite());
        assert!((right - left * Vec3::new(-1.0, 1.0, 1.0)).length() < 1e-5, "{left} and {right}");
        build(&mut editor);
        frame(&mut editor, &egui);
        // The view may have followed the larger plant: the point is where it was dragged to, as it was seen then.
        let net = editor.petal_net().unwrap();
        let off = camera.project(net.points[3][1]).map(|at| editor.plant.window_place(at).distance(to));
        assert!(off.unwrap() < 1.0, "{tool:?}: {off:?} pixels off");
        editor.perform(Action::Undo);
        assert!(editor.sketch().petal_shapes.is_empty(), "{tool:?}: one step");
        editor.perform(Action::Redo);
        assert_eq!(editor.sketch().petal_shapes.len(), 1);
    }
}

#[test]
fn with_alt_or_without_the_switch_one_side_moves_alone() {
    for alt in [true, false] {
        let home = tempfile::tempdir().unwrap();
        let (mut editor, _) = with_petal(&home);
        if alt {
            editor.modifiers(egui::Modifiers::NONE, egui::Modifiers::ALT);
        } else {
            editor.perform(Action::MirrorPetals(false));
        }
        let from = seen(&editor, 2, 3);
        drag(&mut editor, PenTool::Mouse, from, from + DVec2::new(0.0, 30.0));
        let row = offsets(&editor)[2];
        assert!(row[3].length() > 0.02 && row[0] == Vec3::ZERO, "{row:?}");
    }
}

#[test]
fn numbers_set_the_point_that_was_touched_and_reset_gives_the_petals_back() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, _) = with_petal(&home);
    editor.perform(Action::SetPetalPoint(Vec3::Z));
    assert!(editor.sketch().petal_shapes.is_empty(), "no point was touched");
    let at = seen(&editor, 3, 2);
    drag(&mut editor, PenTool::Mouse, at, at);
    let point = editor.petal_state().point.unwrap();
    assert_eq!((point.row, point.column, point.offset), (3, 2, Vec3::ZERO));
    editor.perform(Action::SetPetalPoint(Vec3::new(0.1, 0.0, 0.5)));
    editor.drawing.end_merging();
    assert_eq!(offsets(&editor)[3][1..3], [Vec3::new(-0.1, 0.0, 0.5), Vec3::new(0.1, 0.0, 0.5)]);
    editor.perform(Action::SetPetalPoint(Vec3::new(0.1, 0.0, 9.0)));
    assert_eq!(offsets(&editor)[3][2].z, limits::MAX_PETAL_OFFSET);
    assert!(editor.petal_state().shaped);
    editor.perform(Action::ResetPetals);
    assert!(editor.sketch().petal_shapes.is_empty() && !editor.petal_state().shaped);
    editor.perform(Action::Undo);
    assert_eq!(offsets(&editor)[3][2].z, limits::MAX_PETAL_OFFSET, "to reset is a step of its own");
}

#[test]
fn shapes_are_in_the_file_and_let_go_with_the_drawing() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, _) = with_petal(&home);
    let from = seen(&editor, 3, 0);
    drag(&mut editor, PenTool::Mouse, from, from + DVec2::new(0.0, -30.0));
    let file = home.path().join("shaped.penstemon");
    std::fs::write(&file, json::write(editor.sketch())).unwrap();
    let kept = editor.sketch().petal_shapes.clone();
    let elsewhere = tempfile::tempdir().unwrap();
    let places = Places { config: elsewhere.path().join("config"), state: elsewhere.path().join("state") };
    let mut opened = Editor::open_in(places, Some(file), || ()).unwrap();
    build(&mut opened);
    assert_eq!((opened.sketch().petal_shapes.len(), &opened.sketch().petal_shapes), (1, &kept));
    opened.perform(Action::ShapePetals(true));
    let petal = first_petal(&opened);
    opened.choose_petal(Some(Element::Organ(petal)));
    assert!(opened.petal_state().shaped, "a shaped petal goes on being shaped");
    opened.perform(Action::New);
    assert!(!opened.petal_state().chosen);
}

#[test]
fn what_has_no_points_says_so() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, _) = with_petal(&home);
    editor.choose_petal(Some(Element::Branch(0)));
    assert!(editor.petal_net().is_none() && editor.dialogs.notices().iter().next().is_none());
    editor.choose_petal(None);
    assert!(!editor.hold_control_point(DVec2::splat(700.0)));
}
