//! Branches are drawn in the view of the plant by pens, mice and fingers, lifted, undone and saved.

use super::*;
use crate::app::editor::test_window::{build, frame, touch, with_sketch};
use crate::sketch::json;
use glam::DVec2;

/// The stem of the drawing: the branch that stands on the ground.
fn stem(editor: &Editor) -> Branch {
    editor.built().unwrap().plant.branches.iter().find(|branch| branch.parent.is_none()).unwrap().clone()
}

/// Where a place on the stem is seen, by its share of the points.
fn on_stem(editor: &Editor, share: f32) -> DVec2 {
    let stem = stem(editor);
    editor.plant.seen_at(stem.points[(share * (stem.points.len() - 1) as f32) as usize]).unwrap()
}

/// Draws from a place by so much, in ten samples that press ever more.
fn draw(editor: &mut Editor, tool: PenTool, from: DVec2, by: DVec2) {
    touch(editor, (PenPhase::Down, tool), from, 0.4);
    for k in 1..=10 {
        touch(editor, (PenPhase::Move, tool), from + by * f64::from(k) / 10.0, 0.4 + 0.05 * k as f32);
    }
    touch(editor, (PenPhase::Up, tool), from + by, 0.0);
}

/// The branch that a stroke in space drew.
fn drawn_in_space(editor: &Editor) -> Option<Branch> {
    let id = editor.sketch().in_space().last()?.id;
    let built = editor.built().unwrap();
    built.plant.branches.iter().find(|branch| built.provenance.stroke(branch.origin) == Some(id)).cloned()
}

#[test]
fn any_pointer_draws_a_branch_on_the_wood_as_one_step() {
    for tool in [PenTool::Pen, PenTool::Mouse, PenTool::Finger(2)] {
        let home = tempfile::tempdir().unwrap();
        let (mut editor, egui) = with_sketch(&home, "balloon_flower");
        let before = editor.built().unwrap().plant.branches.len();
        editor.key(egui::Key::W, egui::Modifiers::NONE, true, false);
        frame(&mut editor, &egui);
        let (from, camera) = (on_stem(&editor, 0.4), editor.plant.camera());
        draw(&mut editor, tool, from, DVec2::new(90.0, -60.0));
        assert_eq!(editor.plant.camera(), camera, "{tool:?}: it draws, the camera stays");
        build(&mut editor);
        frame(&mut editor, &egui);
        let (branch, built) = (drawn_in_space(&editor).unwrap(), editor.built().unwrap());
        assert_eq!(built.plant.branches.len(), before + 1, "{tool:?}");
        let end = camera.project(*branch.points.last().unwrap()).map(|at| editor.plant.window_place(at));
        assert!(
            end.unwrap().distance(from + DVec2::new(90.0, -60.0)) < 3.0,
            "{tool:?}: it ends under the pen"
        );
        assert!(branch.parent.is_some() && branch.level > 0, "{tool:?}: it grows on the stem");
        editor.perform(Action::Undo);
        assert_eq!(editor.sketch().in_space().count(), 0, "{tool:?}: one step");
        editor.perform(Action::Redo);
        let text = json::write(editor.sketch());
        let again = crate::sketch::from_bytes(text.as_bytes(), "a.penstemon").unwrap().0;
        assert_eq!(&again, editor.sketch(), "{tool:?}: its file keeps it");
    }
}

#[test]
fn what_begins_beside_the_wood_turns_the_camera_and_a_tap_draws_nothing() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, _) = with_sketch(&home, "balloon_flower");
    editor.perform(Action::DrawInSpace(true));
    let (on, camera) = (on_stem(&editor, 0.4), editor.plant.camera());
    touch(&mut editor, (PenPhase::Down, PenTool::Pen), on, 0.5);
    touch(&mut editor, (PenPhase::Up, PenTool::Pen), on, 0.0);
    assert_eq!(editor.sketch().in_space().count(), 0);
    assert!(editor.plant.has_click(), "a tap picks");
    draw(&mut editor, PenTool::Pen, on + DVec2::new(-120.0, 0.0), DVec2::new(50.0, 0.0));
    assert_eq!(editor.sketch().in_space().count(), 0);
    assert_ne!(editor.plant.camera(), camera, "what is dragged beside the plant turns it");
    // Laid down, the tool leaves wood alone.
    editor.perform(Action::DrawInSpace(false));
    let on = on_stem(&editor, 0.4);
    draw(&mut editor, PenTool::Pen, on, DVec2::new(50.0, 0.0));
    assert_eq!(editor.sketch().in_space().count(), 0);
}

#[test]
fn the_plant_shows_the_branch_while_the_pen_draws_and_a_touch_taken_away_leaves_none() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, _) = with_sketch(&home, "balloon_flower");
    let before = editor.built().unwrap().plant.branches.len();
    editor.perform(Action::DrawInSpace(true));
    let from = on_stem(&editor, 0.4);
    touch(&mut editor, (PenPhase::Down, PenTool::Pen), from, 0.5);
    for k in 1..=8 {
        touch(&mut editor, (PenPhase::Move, PenTool::Pen), from + DVec2::X * 10.0 * f64::from(k), 0.5);
    }
    build(&mut editor);
    assert_eq!(editor.built().unwrap().plant.branches.len(), before + 1);
    assert_eq!(editor.sketch().in_space().count(), 0, "it does not count yet");
    touch(&mut editor, (PenPhase::Cancel, PenTool::Pen), from, 0.0);
    build(&mut editor);
    assert_eq!(editor.built().unwrap().plant.branches.len(), before);
}

#[test]
fn a_plan_from_above_and_a_line_from_the_front_are_one_curve_in_space() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = with_sketch(&home, "balloon_flower");
    editor.perform(Action::DrawInSpace(true));
    editor.perform(Action::SetWorkSurface(WorkSurface::Level));
    // From above: the plan leads to the side and toward the viewer.
    editor.plant.take_hold();
    editor.plant.orbit(DVec2::new(0.0, 260.0));
    frame(&mut editor, &egui);
    let from = on_stem(&editor, 0.5);
    draw(&mut editor, PenTool::Pen, from, DVec2::new(80.0, 60.0));
    build(&mut editor);
    frame(&mut editor, &egui);
    let level = drawn_in_space(&editor).unwrap();
    let heights =
        |branch: &Branch| branch.points.iter().map(|p| p.y - branch.points[0].y).collect::<Vec<_>>();
    let scale = level.points[0].distance(*level.points.last().unwrap());
    assert!(heights(&level).iter().all(|height| height.abs() < 0.01 * scale), "{:?}", heights(&level));
    // Nearly from the front: the line leads upward.
    editor.plant.orbit(DVec2::new(0.0, -240.0));
    editor.perform(Action::SetWorkSurface(WorkSurface::Lifted));
    frame(&mut editor, &egui);
    assert_eq!(editor.space_state().surface, WorkSurface::Lifted);
    let seen = |editor: &Editor, point: Vec3| editor.plant.seen_at(point).unwrap();
    let (from, to) = (seen(&editor, level.points[0]), seen(&editor, *level.points.last().unwrap()));
    draw(&mut editor, PenTool::Pen, from, to - from + DVec2::new(0.0, -60.0));
    build(&mut editor);
    let lifted = drawn_in_space(&editor).unwrap();
    assert_eq!(editor.sketch().in_space().count(), 1, "it is the same branch");
    let (a, b) = (level.points.last().unwrap(), lifted.points.last().unwrap());
    assert!(b.y - a.y > 0.1 * scale, "{a} and {b}");
    assert!(a.with_y(0.0).distance(b.with_y(0.0)) < 0.1 * scale, "its plan stays: {a} and {b}");
    assert_eq!(editor.space_state().surface, WorkSurface::Facing, "the next one is drawn as before");
    editor.perform(Action::Undo);
    build(&mut editor);
    assert_eq!(drawn_in_space(&editor).unwrap(), level, "lifting it is one step");
}

#[test]
fn a_trunk_stands_beside_the_plant_on_the_ground() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, _) = with_sketch(&home, "balloon_flower");
    editor.perform(Action::DrawInSpace(true));
    let foot = on_stem(&editor, 0.0) + DVec2::new(100.0, 0.0);
    draw(&mut editor, PenTool::Pen, foot, DVec2::new(10.0, -90.0));
    build(&mut editor);
    let trunk = drawn_in_space(&editor).unwrap();
    assert_eq!((trunk.parent, trunk.points[0].y), (None, 0.0));
    // One drawn on it after that is its branch.
    let on = editor.plant.seen_at(trunk.points[trunk.points.len() / 2]).unwrap();
    draw(&mut editor, PenTool::Pen, on, DVec2::new(60.0, -20.0));
    build(&mut editor);
    let branch = drawn_in_space(&editor).unwrap();
    let parent = &editor.built().unwrap().plant.branches[branch.parent.unwrap()];
    assert_eq!(parent.points, trunk.points);
}

#[test]
fn a_second_pointer_neither_ends_a_branch_nor_leaves_one_that_never_ends() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, _) = with_sketch(&home, "balloon_flower");
    editor.perform(Action::DrawInSpace(true));
    let from = on_stem(&editor, 0.4);
    touch(&mut editor, (PenPhase::Down, PenTool::Pen), from, 0.5);
    touch(&mut editor, (PenPhase::Move, PenTool::Pen), from + DVec2::X * 40.0, 0.5);
    let other = on_stem(&editor, 0.2);
    touch(&mut editor, (PenPhase::Down, PenTool::Mouse), other, 0.5);
    touch(&mut editor, (PenPhase::Up, PenTool::Mouse), other, 0.0);
    touch(&mut editor, (PenPhase::Move, PenTool::Pen), from + DVec2::X * 80.0, 0.5);
    touch(&mut editor, (PenPhase::Up, PenTool::Pen), from + DVec2::X * 80.0, 0.0);
    assert_eq!(editor.sketch().in_space().count(), 1);
    // Two fingers move the camera and draw nothing, and the next finger draws.
    for (finger, at) in [(1, from), (2, from + DVec2::Y * 90.0)] {
        touch(&mut editor, (PenPhase::Down, PenTool::Finger(finger)), at, 0.5);
    }
    for (finger, at) in [(1, from - DVec2::X * 60.0), (2, from + DVec2::Y * 90.0)] {
        touch(&mut editor, (PenPhase::Move, PenTool::Finger(finger)), at, 0.5);
        touch(&mut editor, (PenPhase::Up, PenTool::Finger(finger)), at, 0.0);
    }
    assert_eq!(editor.sketch().in_space().count(), 1);
    assert!(editor.space.stroke.is_none());
    let on = on_stem(&editor, 0.4);
    draw(&mut editor, PenTool::Finger(3), on, DVec2::new(60.0, -20.0));
    assert_eq!(editor.sketch().in_space().count(), 2);
}

#[test]
fn a_branch_and_a_stroke_on_the_sheet_at_once_are_two_strokes() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, _) = with_sketch(&home, "balloon_flower");
    editor.perform(Action::DrawInSpace(true));
    let before = editor.sketch().strokes.len();
    let from = on_stem(&editor, 0.4);
    touch(&mut editor, (PenPhase::Down, PenTool::Pen), from, 0.5);
    touch(&mut editor, (PenPhase::Move, PenTool::Pen), from + DVec2::X * 40.0, 0.5);
    let sheet = editor.layout.canvas_px();
    let place = sheet.min + (sheet.max - sheet.min) * 0.1;
    let steps = [(PenPhase::Down, 0.0), (PenPhase::Move, 20.0), (PenPhase::Move, 60.0), (PenPhase::Up, 60.0)];
    for (phase, x) in steps {
        let mut hand = crate::pen::tests::Hand { position: place + DVec2::X * x, ..Default::default() };
        editor.pen(hand.event(phase, PenTool::Mouse, x));
    }
    touch(&mut editor, (PenPhase::Move, PenTool::Pen), from + DVec2::X * 80.0, 0.5);
    touch(&mut editor, (PenPhase::Up, PenTool::Pen), from + DVec2::X * 80.0, 0.0);
    assert_eq!(editor.sketch().strokes.len(), before + 2);
}
