//! What is clicked in the view of the plant is selected in the drawing.

use crate::app::action::{Action, CanvasTool};
use crate::app::editor::{Editor, Places};
use crate::model::pick::{Element, pick};
use crate::render::OrbitCamera;
use glam::{Vec2, Vec3};
use std::time::{Duration, Instant};

/// Longest wait for a plant; only a test that has failed takes so long.
const PATIENCE: Duration = Duration::from_secs(60);

/// An editor with the daisy, built.
fn daisy(home: &tempfile::TempDir) -> Editor {
    let places = Places { config: home.path().join("config"), state: home.path().join("state") };
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/sketches/daisy.penstemon");
    let mut editor = Editor::open_in(places, Some(file.into()), || ()).unwrap();
    let begun = Instant::now();
    while editor.is_working() || editor.built().is_none() {
        assert!(begun.elapsed() < PATIENCE, "it is built for ever");
        editor.submit();
        editor.collect();
        std::thread::sleep(Duration::from_millis(1));
    }
    editor
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
            crate::plant::Shape::Blade(blade) => blade.at_rest(Vec2::new(0.0, 0.6 * blade.length)),
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
