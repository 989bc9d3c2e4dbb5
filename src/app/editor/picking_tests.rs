//! What is clicked in the view of the plant is selected in the drawing.

use crate::app::action::Action;
use crate::app::canvas_tool::CanvasTool;
use crate::app::editor::test_window::{PATIENCE, build, frame};
use crate::app::editor::{Editor, Places};
use crate::model::pick::{Element, pick};
use crate::pen::tests::Hand;
use crate::pen::{PenPhase, PenTool};
use crate::render::OrbitCamera;
use glam::{Vec2, Vec3};
use std::time::Instant;

/// An editor with the daisy, built.
fn daisy(home: &tempfile::TempDir) -> Editor {
    let places = Places { config: home.path().join("config"), state: home.path().join("state") };
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/sketches/daisy.penstemon");
    let mut editor = Editor::open_in(places, Some(file.into()), || ()).unwrap();
    build(&mut editor);
    editor
}

/// An element that is seen in the window, and where.
fn seen(editor: &Editor, mut elements: impl Iterator<Item = Element>) -> (Element, glam::DVec2) {
    let (area, built) = (editor.layout().plant, editor.built().unwrap());
    let at = |element: Element| editor.plant.camera().project(middle(editor, element)).unwrap();
    let is_seen = |element: &Element| {
        let ray = editor.plant.ray(at(*element)).unwrap();
        pick(&built.model, &built.plant, &ray).is_some_and(|picked| picked.element == *element)
    };
    let element = elements.find(is_seen).unwrap();
    let at = at(element) * area.height();
    (element, glam::DVec2::new(f64::from(area.center().x + at.x), f64::from(area.center().y + at.y)))
}

/// The middle of a blade, or of a branch.
fn middle(editor: &Editor, element: Element) -> Vec3 {
    let plant = &editor.built().unwrap().plant;
    match element {
        Element::Branch(branch) => {
            let points = &plant.branches[branch].points;
            points[points.len() / 2]
        }
        Element::Organ(organ) => match &plant.organs[organ].shape {
            crate::plant::Shape::Blade(blade) => {
                let blade = plant.templates.resolve(blade);
                blade.at_rest(Vec2::new(0.0, 0.6 * blade.template.length()))
            }
            _ => plant.organs[organ].base(),
        },
    }
}

#[test]
fn rays_from_any_side_find_what_was_drawn() {
    let home = tempfile::tempdir().unwrap();
    let editor = daisy(&home);
    let built = editor.built().unwrap();
    let bounds = built.model.bounds().unwrap();
    let branches = (0..built.plant.branches.len()).map(Element::Branch);
    let drawn: Vec<Element> = branches
        .chain((0..built.plant.organs.len()).map(Element::Organ))
        .filter(|element| match element {
            Element::Branch(branch) => built.plant.branches[*branch].origin.is_drawn(),
            Element::Organ(organ) => built.plant.organs[*organ].origin.is_drawn(),
        })
        .collect();
    assert!(drawn.len() > 10, "{}", drawn.len());
    for yaw_deg in [0.0, 35.0, 180.0] {
        let mut camera = OrbitCamera { yaw_deg, ..OrbitCamera::default() };
        camera.fit(bounds, 1.0);
        let picks = |element: &Element| {
            let at = camera.project(middle(&editor, *element)).unwrap();
            pick(&built.model, &built.plant, &camera.ray(at, bounds))
        };
        // Others may stand before it, but something is always hit, and most of what was drawn is seen.
        let picked: Vec<_> = drawn.iter().map(picks).collect();
        assert!(
            picked.iter().filter(|one| one.is_some()).count() + 1 >= drawn.len(),
            "{yaw_deg}: {picked:?}"
        );
        let own = drawn.iter().zip(&picked).filter(|(element, one)| {
            let stroke = |element: Element| element.stroke(&built.plant, &built.provenance);
            one.is_some_and(|one| stroke(one.element) == stroke(**element))
        });
        let (own, all) = (own.count(), drawn.len());
        assert!(3 * own >= 2 * all, "{yaw_deg}: {own} of {all}");
    }
    let away = OrbitCamera::front(bounds, 1.0).ray(Vec2::new(5.0, 5.0), bounds);
    assert_eq!(pick(&built.model, &built.plant, &away), None);
}

#[test]
fn a_click_selects_the_stroke_and_shift_adds() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = daisy(&home);
    let built = editor.built().unwrap();
    let mut branches = built.plant.branches.iter();
    let stroke = branches.find_map(|branch| built.provenance.stroke(branch.origin)).unwrap();
    editor.perform(Action::SelectStroke { stroke, besides: false });
    assert_eq!(editor.canvas.selection().ids().iter().copied().collect::<Vec<_>>(), [stroke]);
    assert_eq!(editor.canvas.tool(), CanvasTool::Select);
    let other = editor.sketch().strokes.iter().map(|s| s.id).find(|id| *id != stroke).unwrap();
    editor.perform(Action::SelectStroke { stroke: other, besides: true });
    assert_eq!(editor.canvas.selection().ids().len(), 2);
    editor.perform(Action::SelectStroke { stroke: u64::MAX, besides: false });
    assert_eq!(editor.canvas.selection().ids().len(), 2, "no such stroke");
}

#[test]
fn a_tap_of_a_pen_on_a_branch_picks_it_where_the_window_shows_it() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = daisy(&home);
    let egui = egui::Context::default();
    frame(&mut editor, &egui);
    let built = editor.built().unwrap().clone();
    let branches = (0..built.plant.branches.len()).map(Element::Branch);
    let (element, position) = seen(&editor, branches);
    for phase in [PenPhase::Down, PenPhase::Up] {
        let mut hand = Hand { position, ..Hand::default() };
        editor.plant_pen(&hand.event(phase, PenTool::Pen, 0.0));
    }
    let stroke = element.stroke(&built.plant, &built.provenance).unwrap();
    let begun = Instant::now();
    while editor.canvas.selection().is_empty() {
        assert!(begun.elapsed() < PATIENCE, "nothing is picked");
        frame(&mut editor, &egui);
    }
    assert_eq!(editor.canvas.selection().ids().iter().copied().collect::<Vec<_>>(), [stroke]);
}

#[test]
fn a_plant_beside_is_tapped_and_then_carried_along_the_ground() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = (daisy(&home), egui::Context::default());
    editor.perform(Action::AddPlant("hazel".to_owned()));
    editor.perform(Action::SelectPlant(None));
    build(&mut editor);
    frame(&mut editor, &egui);
    let placed = editor.built().unwrap().beside[0].clone().unwrap();
    let (_, position) = seen(&editor, placed.branches.map(Element::Branch));
    let touch = |editor: &mut Editor, phase, tool, by: f64| {
        let mut hand = Hand { position: position + glam::DVec2::X * by, ..Hand::default() };
        editor.plant_pen(&hand.event(phase, tool, 0.0));
    };
    let before = editor.sketch().plants[0].clone();
    for tool in [PenTool::Mouse, PenTool::Pen] {
        touch(&mut editor, PenPhase::Down, tool, 0.0);
        touch(&mut editor, PenPhase::Move, tool, 30.0);
        touch(&mut editor, PenPhase::Up, tool, 30.0);
        assert_eq!(editor.sketch().plants[0], before, "what is not selected stays");
        editor.plant.show_front();
        while editor.plant.is_moving() {
            frame(&mut editor, &egui);
        }
        touch(&mut editor, PenPhase::Down, tool, 0.0);
        touch(&mut editor, PenPhase::Up, tool, 0.0);
        let begun = Instant::now();
        while editor.panel_snapshot().beside.selected.is_none() {
            assert!(begun.elapsed() < PATIENCE, "nothing is picked");
            frame(&mut editor, &egui);
        }
        let camera = editor.plant.camera();
        touch(&mut editor, PenPhase::Down, tool, 0.0);
        [10.0, 20.0, 30.0].into_iter().for_each(|by| touch(&mut editor, PenPhase::Move, tool, by));
        touch(&mut editor, PenPhase::Up, tool, 30.0);
        assert_eq!(editor.plant.camera(), camera);
        let after = &editor.sketch().plants[0];
        // As far as the pointer went, from the front.
        let pixel = camera.height() / editor.layout().plant.height();
        let scale = editor.built().unwrap().provenance.world_from_canvas.scale;
        let by = (after.foot.x - before.foot.x) * scale / pixel;
        assert!((by - 30.0).abs() < 0.5 && after.foot.y == before.foot.y, "{by} points");
        editor.perform(Action::Undo);
        assert_eq!(editor.sketch().plants[0], before, "one drag is one step");
        editor.perform(Action::SelectPlant(None));
        build(&mut editor);
        frame(&mut editor, &egui);
    }
}
