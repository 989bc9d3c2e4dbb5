//! Brushes in the view of the plant: pens, mice and fingers paint, prune, undo and save.

use super::*;
use crate::app::brush_settings::BrushSettings;
use crate::app::editor::test_window::{build, frame, touch, with_sketch};
use crate::sketch::json;

/// Where a place on the trunk is seen, by its share of the points.
fn on_trunk(editor: &Editor, share: f32) -> DVec2 {
    let built = editor.built().unwrap();
    let trunk = built.plant.branches.iter().find(|branch| branch.parent.is_none()).unwrap();
    editor.plant.seen_at(trunk.points[(share * (trunk.points.len() - 1) as f32) as usize]).unwrap()
}

/// Drags from a place by so much.
fn drag(editor: &mut Editor, tool: PenTool, from: DVec2, by: DVec2) {
    touch(editor, (PenPhase::Down, tool), from, 0.5);
    for k in 1..=10 {
        touch(editor, (PenPhase::Move, tool), from + by * f64::from(k) / 10.0, 0.5);
    }
    touch(editor, (PenPhase::Up, tool), from + by, 0.0);
}

fn organs(editor: &Editor) -> usize {
    editor.built().unwrap().plant.organs.len()
}

#[test]
fn any_pointer_paints_growth_as_one_step() {
    for tool in [PenTool::Pen, PenTool::Mouse, PenTool::Finger(2)] {
        let home = tempfile::tempdir().unwrap();
        let (mut editor, egui) = with_sketch(&home, "balloon_flower");
        let (before, camera) = (organs(&editor), editor.plant.camera());
        editor.key(egui::Key::U, egui::Modifiers::NONE, true, false);
        assert_eq!(editor.brush_state().tool, Some(Tool::GrowthBrush));
        let from = on_trunk(&editor, 0.5);
        drag(&mut editor, tool, from, DVec2::new(120.0, -40.0));
        assert_eq!(editor.plant.camera(), camera, "{tool:?}: it paints, the camera stays");
        build(&mut editor);
        frame(&mut editor, &egui);
        assert_eq!(editor.sketch().brush_strokes().count(), 1, "{tool:?}");
        assert!(organs(&editor) > before + 20, "{tool:?}: {before}, then {}", organs(&editor));
        let text = json::write(editor.sketch());
        let again = crate::sketch::from_bytes(text.as_bytes(), "a.penstemon").unwrap().0;
        assert_eq!(&again, editor.sketch(), "{tool:?}: its file keeps it");
        editor.perform(Action::Undo);
        build(&mut editor);
        assert_eq!(
            (editor.sketch().brush_strokes().count(), organs(&editor)),
            (0, before),
            "{tool:?}: one step"
        );
    }
}

#[test]
fn light_may_be_painted_far_from_all_wood() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, _) = with_sketch(&home, "tree_round");
    let far = on_trunk(&editor, 0.5) + DVec2::new(260.0, 0.0);
    let painted = |key, editor: &mut Editor| {
        editor.key(key, egui::Modifiers::NONE, true, false);
        drag(editor, PenTool::Pen, far, DVec2::new(0.0, -60.0));
        build(editor);
        editor.sketch().brush_strokes().map(|stroke| stroke.tool).collect::<Vec<_>>()
    };
    assert_eq!(painted(egui::Key::U, &mut editor), [], "a growth brush begins over wood");
    assert_eq!(painted(egui::Key::I, &mut editor), [Tool::LightBrush]);
    editor.perform(Action::Undo);
    assert_eq!(editor.sketch().brush_strokes().count(), 0);
}

#[test]
fn leaves_and_flowers_are_painted_while_the_pen_moves() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, _) = with_sketch(&home, "balloon_flower");
    let bare = organs(&editor);
    let mut last = bare;
    for (key, tool) in [(egui::Key::Y, Tool::LeafBrush), (egui::Key::M, Tool::FlowerBrush)] {
        editor.key(key, egui::Modifiers::NONE, true, false);
        let from = on_trunk(&editor, 0.2);
        touch(&mut editor, (PenPhase::Down, PenTool::Pen), from, 0.5);
        let moves = (1..=8).map(|k| from - DVec2::new(0.0, 12.0 * f64::from(k)));
        moves.for_each(|at| touch(&mut editor, (PenPhase::Move, PenTool::Pen), at, 0.5));
        build(&mut editor);
        assert!(organs(&editor) > last, "{tool:?}: before the pen is lifted");
        touch(&mut editor, (PenPhase::Up, PenTool::Pen), from - DVec2::new(0.0, 96.0), 0.0);
        build(&mut editor);
        let strokes: Vec<Tool> = editor.sketch().brush_strokes().map(|stroke| stroke.tool).collect();
        assert_eq!(strokes.last(), Some(&tool));
        last = organs(&editor);
    }
    (0..2).for_each(|_| editor.perform(Action::Undo));
    build(&mut editor);
    assert_eq!(organs(&editor), bare, "a step each");
}

#[test]
fn a_pruning_brush_cuts_while_it_moves_and_a_touch_taken_away_cuts_nothing() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, _egui) = with_sketch(&home, "balloon_flower");
    let before = editor.built().unwrap().plant.clone();
    let top = |editor: &Editor| {
        let points = editor.built().unwrap().plant.branches.iter().flat_map(|b| &b.points).map(|p| p.y);
        points.fold(0.0_f32, f32::max)
    };
    let high = top(&editor);
    editor.perform(Action::TakeBrush(Some(Tool::PruningBrush)));
    let from = on_trunk(&editor, 0.5) - DVec2::X * 10.0;
    touch(&mut editor, (PenPhase::Down, PenTool::Pen), from, 0.5);
    touch(&mut editor, (PenPhase::Move, PenTool::Pen), from + DVec2::X * 20.0, 0.5);
    build(&mut editor);
    assert!(top(&editor) < 0.8 * high, "it is cut while the pen is down");
    touch(&mut editor, (PenPhase::Cancel, PenTool::Pen), from, 0.5);
    build(&mut editor);
    assert_eq!(editor.built().unwrap().plant, before);
    drag(&mut editor, PenTool::Pen, from, DVec2::X * 20.0);
    build(&mut editor);
    assert!(top(&editor) < 0.8 * high && editor.sketch().brush_strokes().count() == 1);
    editor.perform(Action::Undo);
    build(&mut editor);
    assert_eq!(editor.built().unwrap().plant, before);
}

#[test]
fn what_begins_beside_the_plant_turns_the_camera_and_sizes_are_kept_with_the_stroke() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, _egui) = with_sketch(&home, "balloon_flower");
    let settings = BrushSettings { size: 0.02, density: 2.0, guide: -0.5 };
    editor.perform(Action::TakeBrush(Some(Tool::GrowthBrush)));
    editor.perform(Action::SetBrush(settings));
    let (from, camera) = (on_trunk(&editor, 0.5), editor.plant.camera());
    drag(&mut editor, PenTool::Pen, from - DVec2::X * 250.0, DVec2::new(60.0, 0.0));
    assert_ne!(editor.plant.camera(), camera);
    assert_eq!(editor.sketch().brush_strokes().count(), 0);
    editor.perform(Action::FrontView);
    let from = on_trunk(&editor, 0.5);
    drag(&mut editor, PenTool::Mouse, from, DVec2::new(60.0, 0.0));
    let stroke = editor.sketch().brush_strokes().next().unwrap();
    let radius = 0.02 * editor.sketch().canvas.height;
    assert_eq!(stroke.brush, Some(Brush { radius, density: 2.0, guide: -0.5 }));
    // Another tool lays it down.
    editor.perform(Action::DrawInSpace(true));
    assert_eq!(editor.brush_state().tool, None);
}
