//! Grown plants beside the drawn one, added and worked on by mouse.

use crate::program::{Program, field};
use crate::screen::Screen;
use crate::{sketch_file, sketch_saved_by};
use penstemon::app::canvas::{CanvasView, Rect};
use penstemon::sketch::{Maker, PlacedPlant};
use std::path::Path;
use tempfile::TempDir;

/// Saves, and gives the plants that the file then names.
fn saved(screen: &Screen, program: &mut Program, file: &Path) -> Vec<PlacedPlant> {
    screen.hand(&["key", "ctrl+s"]);
    program.wait_for("saved");
    program.rest();
    sketch_saved_by(file).plants
}

/// How the canvas lies in the window that shows all of a drawing with these plants.
fn view(program: &mut Program, file: &Path) -> CanvasView {
    let [left, top, width, height] = program.area("canvas");
    let sketch = sketch_saved_by(file);
    let (low, high) = sketch.bounds().unwrap();
    let places = sketch
        .plants
        .iter()
        .flat_map(|plant| [plant.foot, plant.foot - glam::Vec2::Y * plant.height.unwrap_or(0.0)]);
    let (low, high) = places.fold((low, high), |(low, high), p| (low.min(p), high.max(p)));
    let mut view = CanvasView::default();
    let room = Rect::new(glam::DVec2::new(left, top), glam::DVec2::new(left + width, top + height));
    view.fit(Rect::new(low.as_dvec2(), high.as_dvec2()), room);
    view
}

#[test]
fn a_birch_is_put_beside_a_daisy_picked_moved_and_taken_away() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let file = home.path().join("meadow.penstemon");
    std::fs::copy(sketch_file("daisy"), &file).unwrap();
    let mut program = Program::start(&screen, home.path(), &[file.to_str().unwrap()]);
    let alone = program.built();
    screen.hand(&["key", "g"]);
    program.rest_in_dialog("plant species");
    program.picture(&screen).keep("plant-species");
    // The sixth picture of the first row.
    screen.click([824.0, 180.0]);
    let both = program.built();
    let triangles = |line: &str| field(line, "triangles").parse::<u64>().unwrap();
    assert!(triangles(&both) > triangles(&alone), "{both}");
    let shown = program.picture(&screen);
    shown.keep("plant-beside");
    let plants = saved(&screen, &mut program, &file);
    assert_eq!(plants.len(), 1);
    let Maker::Growth(seed) = &plants[0].maker;
    assert_eq!(seed.species, "birch", "{seed:?} at {}", plants[0].foot);

    // A click on the plant beside selects it, whatever was selected before.
    let [left, top, width, height] = program.area("plant");
    let at = |k: u8| [left + f64::from(k) / 20.0 * width, top + 0.45 * height];
    let picked = (5..19).find(|k| {
        screen.click(at(*k));
        let picked = program.wait_for("picked ").contains("picked plant=0");
        program.rest();
        picked
    });
    let [x, y] = at(picked.expect("the plant beside is nowhere"));

    // Selected it is carried along the ground; one drag is one step.
    let places: Vec<[f64; 2]> = (0..=12).map(|i| [x + 3.0 * f64::from(i), y]).collect();
    screen.draw(&places);
    program.built();
    program.picture(&screen).keep("plant-beside-carried");
    let carried = saved(&screen, &mut program, &file);
    assert!(
        carried[0].foot.x > plants[0].foot.x + 5.0 && carried[0].foot.y == plants[0].foot.y,
        "{carried:?}"
    );
    screen.hand(&["key", "ctrl+z"]);
    program.built();
    assert_eq!(saved(&screen, &mut program, &file), plants);

    // With the selection tool the dot at its foot moves it; one drag is one step.
    screen.hand(&["key", "s"]);
    program.rest();
    let view = view(&mut program, &file);
    let from = view.to_window(plants[0].foot.as_dvec2());
    let places: Vec<[f64; 2]> = (0..=12).map(|i| [from.x - 4.0 * f64::from(i), from.y]).collect();
    screen.draw(&places);
    program.built();
    program.picture(&screen).keep("plant-beside-moved");
    let moved = saved(&screen, &mut program, &file);
    let by = f64::from(plants[0].foot.x - moved[0].foot.x) * view.zoom();
    assert!((by - 48.0).abs() < 2.0 && moved[0].foot.y == plants[0].foot.y, "{moved:?}");
    screen.hand(&["key", "ctrl+z"]);
    program.built();
    assert_eq!(saved(&screen, &mut program, &file), plants);

    // Del takes it away, and undo brings it back.
    screen.hand(&["key", "Delete"]);
    assert_eq!(field(&program.built(), "triangles"), field(&alone, "triangles"));
    screen.hand(&["key", "ctrl+z"]);
    assert_eq!(field(&program.built(), "triangles"), field(&both, "triangles"));
}
