//! Painting a garden in the view of the plant: pens, mice and fingers, taps, undo, files, the camera.

use super::*;
use crate::app::editor::test_window::{build, drag, frame, touch, with_sketch};
use crate::app::garden_brush::GardenBrushKind;
use crate::app::panels::snapshot::PathPurpose;
use crate::sketch::{GardenTool, json};
use egui::{Key, Modifiers};

/// A place in the window, physical pixels, where the ground is seen so far from the plant, metres.
fn seen(editor: &Editor, x: f32, z: f32) -> DVec2 {
    editor.plant.seen_at(Vec3::new(x, 0.0, z)).unwrap()
}

fn opened(home: &tempfile::TempDir) -> (Editor, egui::Context) {
    let (mut editor, egui) = with_sketch(home, "balloon_flower");
    editor.key(Key::N, Modifiers::NONE, true, false);
    assert!(editor.garden_state().on);
    frame(&mut editor, &egui);
    (editor, egui)
}

#[test]
fn any_pointer_paints_a_bed_as_one_step() {
    for tool in [PenTool::Pen, PenTool::Mouse, PenTool::Finger(2)] {
        let home = tempfile::tempdir().unwrap();
        let (mut editor, _egui) = opened(&home);
        let (camera, before) = (editor.plant.camera(), editor.built().unwrap().model.clone());
        let (from, to) = (seen(&editor, -0.4, 0.4), seen(&editor, 0.4, 0.4));
        drag(&mut editor, tool, from, to);
        assert_eq!(editor.plant.camera(), camera, "{tool:?}: it paints, the camera stays");
        build(&mut editor);
        let strokes = &editor.sketch().garden;
        assert_eq!(strokes.len(), 1, "{tool:?}");
        assert_eq!(strokes[0].tool, GardenTool::Plants(GardenPlant::Drawn));
        let ends = [strokes[0].points[0].at, strokes[0].points.last().unwrap().at];
        assert!(ends[0].distance(glam::Vec2::new(-0.4, 0.4)) < 0.01, "{tool:?}: {ends:?}");
        assert!(ends[1].distance(glam::Vec2::new(0.4, 0.4)) < 0.05, "{tool:?}: {ends:?}");
        let plants = editor.garden_state().plants.unwrap();
        assert!(plants > 2, "{tool:?}: {plants}");
        assert_eq!(editor.built().unwrap().model, before, "{tool:?}: the drawn plant is as it was");
        let text = json::write(editor.sketch());
        let again = crate::sketch::from_bytes(text.as_bytes(), "a.penstemon").unwrap().0;
        assert_eq!(&again, editor.sketch(), "{tool:?}: its file keeps it");
        editor.perform(Action::Undo);
        build(&mut editor);
        assert!(editor.sketch().garden.is_empty() && editor.garden_state().plants.is_none(), "{tool:?}");
    }
}

#[test]
fn a_tap_plants_one_and_the_garden_grows_while_the_pen_moves() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, _egui) = opened(&home);
    let at = seen(&editor, 0.3, 0.3);
    touch(&mut editor, (PenPhase::Down, PenTool::Pen), at, 0.5);
    touch(&mut editor, (PenPhase::Up, PenTool::Pen), at, 0.0);
    build(&mut editor);
    assert_eq!(editor.garden_state().plants, Some(1));
    assert!(editor.sketch().garden[0].points.len() == 1);
    let brush = GardenBrush { plant: GardenPlant::species("daisy"), ..editor.garden_state().brush };
    editor.perform(Action::SetGardenBrush(brush));
    let (from, to) = (seen(&editor, -0.5, 0.5), seen(&editor, 0.5, 0.5));
    touch(&mut editor, (PenPhase::Down, PenTool::Pen), from, 0.5);
    touch(&mut editor, (PenPhase::Move, PenTool::Pen), to, 0.5);
    build(&mut editor);
    assert!(editor.garden_state().plants > Some(3), "{:?}", editor.garden_state().plants);
    assert_eq!(editor.sketch().garden.len(), 1, "it does not count yet");
    touch(&mut editor, (PenPhase::Cancel, PenTool::Pen), to, 0.0);
    build(&mut editor);
    assert_eq!(editor.garden_state().plants, Some(1));
}

#[test]
fn paths_and_clearings_are_painted_and_the_sky_is_not() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = opened(&home);
    for (kind, tool) in
        [(GardenBrushKind::Path, GardenTool::Path), (GardenBrushKind::Clear, GardenTool::Clear)]
    {
        editor.perform(Action::SetGardenBrush(GardenBrush { kind, ..editor.garden_state().brush }));
        let (from, to) = (seen(&editor, -0.5, 0.5), seen(&editor, 0.5, 0.5));
        drag(&mut editor, PenTool::Mouse, from, to);
        assert_eq!(editor.sketch().garden.last().unwrap().tool, tool);
    }
    build(&mut editor);
    frame(&mut editor, &egui);
    // From the front the ground is a line, and a drag turns the view.
    editor.perform(Action::FrontView);
    std::thread::sleep(std::time::Duration::from_millis(400));
    frame(&mut editor, &egui);
    let middle = editor.plant.seen_at(editor.plant.camera().target).unwrap();
    drag(&mut editor, PenTool::Mouse, middle, middle + DVec2::new(80.0, 0.0));
    assert_eq!(editor.sketch().garden.len(), 2);
}

#[test]
fn a_garden_is_painted_where_nothing_is_drawn() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = with_sketch(&home, "balloon_flower");
    editor.perform(Action::New);
    build(&mut editor);
    frame(&mut editor, &egui);
    editor.key(Key::N, Modifiers::NONE, true, false);
    assert_eq!(editor.garden_state().brush.plant, GardenPlant::species("rose"));
    let (from, to) = (seen(&editor, -0.5, 0.0), seen(&editor, 0.5, 0.0));
    drag(&mut editor, PenTool::Pen, from, to);
    build(&mut editor);
    assert_eq!(editor.sketch().garden.len(), 1);
    assert!(editor.garden_state().plants > Some(0), "{:?}", editor.garden_state().plants);
    assert!(editor.plant.bounds().is_some());
}

#[test]
fn the_ground_is_looked_at_from_above_and_the_brush_fits_the_plant() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, _egui) = opened(&home);
    assert!(editor.plant.camera().pitch_deg >= 30.0);
    let (low, high) = editor.plant.bounds().unwrap();
    let width = (high - low).xz().max_element();
    let radius = editor.garden_state().brush.radius;
    assert!((radius - width).abs() < 0.03, "{radius} {width}");
    editor.perform(Action::SetGardenBrush(GardenBrush { radius: 0.11, ..editor.garden_state().brush }));
    editor.perform(Action::PaintGarden(false));
    editor.perform(Action::PaintGarden(true));
    assert_eq!(editor.garden_state().brush.radius, 0.11, "what the artist says stays");
    editor.key(Key::U, Modifiers::NONE, true, false);
    assert!(!editor.garden_state().on, "one tool at a time");
}

#[test]
fn the_plant_of_another_drawing_is_planted_and_kept_in_the_drawing() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, _egui) = opened(&home);
    let path = home.path().join("my herb.penstemon");
    let chosen = Action::PathChosen { purpose: PathPurpose::GardenDrawing, path: path.clone() };
    editor.perform(chosen.clone());
    let said = |editor: &Editor, part: &str| editor.dialogs.notices().iter().any(|n| n.what.contains(part));
    assert!(said(&editor, "my herb"));
    assert_eq!(editor.garden_state().brush.plant, GardenPlant::Drawn, "there is no such file");
    let herb = crate::sketch::Sketch { garden: Default::default(), ..editor.sketch().clone() };
    std::fs::write(&path, json::write(&herb)).unwrap();
    editor.perform(chosen.clone());
    let GardenPlant::Drawing(drawing) = editor.garden_state().brush.plant else {
        panic!("it is in the brush")
    };
    assert_eq!(drawing.name(), "my herb");
    let (from, to) = (seen(&editor, -0.4, 0.4), seen(&editor, 0.4, 0.4));
    drag(&mut editor, PenTool::Pen, from, to);
    // Where the file goes does not matter any more.
    std::fs::remove_file(&path).unwrap();
    build(&mut editor);
    assert!(editor.garden_state().plants > Some(2));
    let text = json::write(editor.sketch());
    assert_eq!(&crate::sketch::from_bytes(text.as_bytes(), "a").unwrap().0, editor.sketch());
    // Another drawing of that name has a name of its own.
    let seed = herb.seed + 1;
    std::fs::write(&path, json::write(&crate::sketch::Sketch { seed, ..herb })).unwrap();
    editor.perform(chosen);
    let names: Vec<String> = editor.garden_state().drawings.iter().map(|d| d.name().to_owned()).collect();
    assert_eq!(names, ["my herb", "my herb 2"]);
    std::fs::write(&path, json::write(&crate::sketch::Sketch::empty())).unwrap();
    editor.perform(Action::PathChosen { purpose: PathPurpose::GardenDrawing, path });
    assert!(said(&editor, "nothing is drawn"));
}

#[test]
fn whole_strokes_are_taken_away_by_the_eraser() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = opened(&home);
    for y in [0.5, 0.3, -0.5] {
        let radius = 0.15;
        editor.perform(Action::SetGardenBrush(GardenBrush { radius, ..editor.garden_state().brush }));
        let (from, to) = (seen(&editor, -0.5, y), seen(&editor, 0.5, y));
        drag(&mut editor, PenTool::Pen, from, to);
    }
    let lines = |editor: &Editor| {
        editor.sketch().garden.iter().map(|stroke| (stroke.points[0].at.y * 10.0).round()).collect::<Vec<_>>()
    };
    assert_eq!(lines(&editor), [5.0, 3.0, -5.0]);
    let press = |editor: &mut Editor, tool: PenTool, y: f32| {
        let at = seen(editor, 0.0, y);
        touch(editor, (PenPhase::Down, tool), at, 0.5);
        touch(editor, (PenPhase::Up, tool), at, 0.0);
    };
    // Where two lie over each other the later one goes, and the pen's other end does the same.
    press(&mut editor, PenTool::Eraser, 0.4);
    assert_eq!(lines(&editor), [5.0, -5.0]);
    let kind = GardenBrushKind::Erase;
    editor.perform(Action::SetGardenBrush(GardenBrush { kind, ..editor.garden_state().brush }));
    press(&mut editor, PenTool::Mouse, 0.0);
    assert_eq!(lines(&editor), [5.0, -5.0], "nothing is there");
    press(&mut editor, PenTool::Mouse, -0.5);
    assert_eq!(lines(&editor), [5.0]);
    frame(&mut editor, &egui);
    editor.perform(Action::Undo);
    editor.perform(Action::Undo);
    assert_eq!(lines(&editor), [5.0, 3.0, -5.0]);
}
