//! Plants beside the drawn one, by actions and by hand.

use super::*;
use crate::app::canvas::Rect as CanvasRect;
use crate::app::canvas_tool::CanvasTool;
use crate::app::editor::Places;
use crate::app::panels::snapshot::Severity;
use crate::pen::tests::Hand;
use crate::pen::{PenPhase, PenTool};
use crate::sketch::{Stroke, StrokePoint, Tool};

/// An editor with a stem of 600 pixels, on whose view everything is seen.
fn editor(home: &tempfile::TempDir) -> Editor {
    let places = Places { config: home.path().join("config"), state: home.path().join("state") };
    let mut editor = Editor::open_in(places, None, || ()).unwrap();
    editor.perform(Action::New);
    editor.canvas.set_viewport(CanvasRect::new(DVec2::ZERO, DVec2::splat(800.0)), 1.0);
    let points = (0..=20u8).map(|k| StrokePoint::at(Vec2::new(300.0, 700.0 - 30.0 * f32::from(k))));
    editor.change(Change::put(Stroke { id: 1, tool: Tool::Branch, points: points.collect(), brush: None }));
    editor.perform(Action::FitCanvas);
    editor
}

fn plants(editor: &Editor) -> &[PlacedPlant] {
    &editor.sketch().plants
}

fn seed(plant: &PlacedPlant) -> &SeedOf {
    let Maker::Growth(seed) = &plant.maker;
    seed
}

#[test]
fn added_plants_stand_beside_the_drawing_and_beside_each_other() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = editor(&home);
    for species in ["birch", "hazel", "birch"] {
        editor.perform(Action::AddPlant(species.to_owned()));
    }
    let feet: Vec<Vec2> = plants(&editor).iter().map(|plant| plant.foot).collect();
    assert_eq!(
        plants(&editor).iter().map(|p| p.maker.species()).collect::<Vec<_>>(),
        ["birch", "hazel", "birch"]
    );
    assert!(feet[0].x > 300.0 && feet[1].x < 300.0 && feet[2].x > feet[0].x, "{feet:?}");
    assert!(feet.iter().all(|foot| foot.y == 700.0), "on the ground of the drawing: {feet:?}");
    assert!(plants(&editor).iter().all(|plant| plant.height == Some(600.0)));
    assert_ne!(seed(&plants(&editor)[0]).seed, seed(&plants(&editor)[2]).seed, "two birches are two plants");
    assert_eq!(editor.beside.selected(), Some(2));
    editor.perform(Action::Undo);
    assert_eq!((plants(&editor).len(), editor.beside.selected()), (2, None));
    // A place that became free is taken again.
    editor.perform(Action::RemovePlant(0));
    editor.perform(Action::AddPlant("oak".to_owned()));
    assert_eq!(plants(&editor)[1].foot, feet[0]);
}

#[test]
fn a_plant_on_an_empty_sheet_stands_in_its_middle() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = editor(&home);
    editor.perform(Action::SelectAll);
    editor.perform(Action::DeleteSelected);
    editor.perform(Action::AddPlant("oak".to_owned()));
    let canvas = editor.sketch().canvas;
    let plant = &plants(&editor)[0];
    assert_eq!(plant.foot, Vec2::new((0.5 * canvas.width).round(), canvas.height));
    assert_eq!(plant.height, Some((0.8 * canvas.height).round()));
}

#[test]
fn what_is_changed_of_a_plant_is_one_step_until_it_is_let_go() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = editor(&home);
    editor.perform(Action::AddPlant("birch".to_owned()));
    editor.drawing.end_merging();
    let first = plants(&editor)[0].clone();
    for age in [3.0, 4.0, 5.0] {
        let maker = Maker::Growth(SeedOf { age: Some(age), ..seed(&first).clone() });
        editor.perform(Action::SetPlant { place: 0, plant: PlacedPlant { maker, ..first.clone() } });
    }
    assert_eq!(editor.beside_state().plants[0].age, 5.0);
    editor.perform(Action::Undo);
    assert_eq!(plants(&editor), std::slice::from_ref(&first));
    editor.perform(Action::RollPlantSeed(0));
    assert_ne!(seed(&plants(&editor)[0]).seed, seed(&first).seed);
    // Places that are none change nothing.
    for action in [Action::RemovePlant(7), Action::RollPlantSeed(7), Action::SelectPlant(Some(7))] {
        editor.perform(action);
    }
    assert_eq!((plants(&editor).len(), editor.beside.selected()), (1, None));
}

#[test]
fn one_plant_too_many_is_refused_with_a_reason() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = editor(&home);
    for _ in 0..=limits::MAX_PLANTS {
        editor.perform(Action::AddPlant("box".to_owned()));
    }
    assert_eq!(plants(&editor).len(), limits::MAX_PLANTS);
    let feet: Vec<f32> = plants(&editor).iter().map(|plant| plant.foot.x).collect();
    let apart = |a: usize, b: usize| (feet[a] - feet[b]).abs() >= 0.5 * 600.0;
    assert!((0..feet.len()).all(|a| (0..a).all(|b| apart(a, b))), "{feet:?}");
    let reported: Vec<_> =
        editor.dialogs.notices().iter().filter(|n| n.severity == Severity::Error).collect();
    assert!(reported.len() == 1 && reported[0].what.contains("16"), "{reported:?}");
}

#[test]
fn delete_takes_strokes_first_and_then_the_plant() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = editor(&home);
    editor.perform(Action::AddPlant("birch".to_owned()));
    editor.perform(Action::SelectAll);
    let delete = |editor: &mut Editor| {
        editor.key(egui::Key::Delete, egui::Modifiers::NONE, true, false);
        (editor.sketch().strokes.len(), plants(editor).len())
    };
    assert_eq!(delete(&mut editor), (0, 1));
    assert_eq!(delete(&mut editor), (0, 0));
    editor.perform(Action::Undo);
    editor.perform(Action::Undo);
    assert_eq!((editor.sketch().strokes.len(), plants(&editor).len()), (1, 1));
}

/// Drags a pen over the canvas from one place of the drawing to another, in three moves.
fn drag(editor: &mut Editor, from: Vec2, to: Vec2) {
    let window = |editor: &Editor, p: Vec2| editor.canvas.view().to_window(p.as_dvec2());
    let mut at = |phase, p: Vec2| {
        let position = window(editor, p);
        let mut hand = Hand { position, ..Hand::default() };
        editor.pen(hand.event(phase, PenTool::Pen, 0.0));
    };
    at(PenPhase::Down, from);
    [0.3, 0.6, 1.0].into_iter().for_each(|t| at(PenPhase::Move, from.lerp(to, t)));
    at(PenPhase::Up, to);
}

#[test]
fn marks_on_the_paper_move_a_plant_and_make_it_taller() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = editor(&home);
    editor.perform(Action::AddPlant("birch".to_owned()));
    editor.perform(Action::SelectPlant(None));
    let before = plants(&editor)[0].clone();
    let by = Vec2::new(80.0, -40.0);
    // With the pen in hand a stroke is drawn; with the selection tool the plant is taken hold of.
    drag(&mut editor, before.foot, before.foot + by);
    assert_eq!((plants(&editor), editor.sketch().strokes.len()), (std::slice::from_ref(&before), 2));
    editor.perform(Action::Undo);
    editor.perform(Action::SetTool(CanvasTool::Select));
    drag(&mut editor, before.foot, before.foot + by);
    assert_eq!((plants(&editor)[0].foot, editor.beside.selected()), (before.foot + by, Some(0)));
    let top = plants(&editor)[0].foot - Vec2::Y * 600.0;
    drag(&mut editor, top, top - Vec2::Y * 90.0);
    let height = plants(&editor)[0].height.unwrap();
    assert!((height - 690.0).abs() < 0.1, "{height}");
    editor.perform(Action::Undo);
    editor.perform(Action::Undo);
    assert_eq!(plants(&editor), [before], "each drag was one step");
    assert_eq!(editor.sketch().strokes.len(), 1);
}
