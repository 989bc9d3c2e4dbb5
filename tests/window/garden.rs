//! A garden painted by mouse on the ground in the view of the plant.

use crate::program::Program;
use crate::screen::{Pixels, Screen};
use crate::sketch_saved_by;
use penstemon::sketch::{GardenPlant, GardenTool, Sketch};
use std::path::Path;
use tempfile::TempDir;

/// A stem with two leaves.
const STEM: &str = r#"{"format": "penstemon-sketch", "version": 1, "canvas": {"width": 800, "height": 800}, "strokes": [
    {"tool": "branch", "points": [[400, 780], [404, 600], [398, 400], [400, 200]]},
    {"tool": "leaf", "points": [[402, 500], [450, 430], [560, 420], [480, 500], [402, 500]]},
    {"tool": "leaf", "points": [[400, 420], [350, 350], [240, 340], [320, 420], [400, 420]]}]}"#;

/// Saves, and reads the file.
fn saved(screen: &Screen, program: &mut Program, file: &Path) -> Sketch {
    screen.hand(&["key", "ctrl+s"]);
    program.rest();
    sketch_saved_by(file)
}

#[test]
fn beds_and_single_plants_are_painted_and_each_is_one_step() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let file = home.path().join("bed.penstemon");
    std::fs::write(&file, STEM).unwrap();
    let mut program = Program::start(&screen, home.path(), &[file.to_str().unwrap()]);
    program.built();
    let [left, top, width, height] = program.area("plant");
    let at = |x: f64, y: f64| [left + x * width, top + y * height];

    screen.hand(&["key", "n"]);
    program.rest();
    let bed: Vec<[f64; 2]> = (0..=10).map(|k| at(0.2 + 0.06 * f64::from(k), 0.5)).collect();
    screen.draw(&bed);
    program.built();
    program.picture(&screen).keep("painted-bed");
    let painted = saved(&screen, &mut program, &file);
    assert_eq!(painted.garden.len(), 1);
    assert_eq!(painted.garden[0].tool, GardenTool::Plants(GardenPlant::Drawn));
    let (from, to) = (painted.garden[0].points[0].at, painted.garden[0].points.last().unwrap().at);
    assert!(to.x - from.x > 0.3 && (to.y - from.y).abs() < 0.1, "{from} {to}");

    let tap = at(0.7, 0.3);
    screen.draw(&[tap, tap]);
    program.built();
    let tapped = saved(&screen, &mut program, &file);
    assert_eq!((tapped.garden.len(), tapped.garden[1].points.len()), (2, 1), "one plant");

    for left in [1, 0] {
        screen.hand(&["key", "ctrl+z"]);
        program.built();
        assert_eq!(saved(&screen, &mut program, &file).garden.len(), left, "one step each");
    }
}

#[test]
fn one_walks_to_what_is_tapped_and_comes_back() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let file = home.path().join("stem.penstemon");
    std::fs::write(&file, STEM).unwrap();
    let mut program = Program::start(&screen, home.path(), &[file.to_str().unwrap()]);
    program.built();
    let area @ [left, top, width, height] = program.area("plant");
    let at = |x: f64, y: f64| [left + x * width, top + y * height];
    // The sky is blue, paper is not.
    let around_plant = [left + 0.25 * width, top + 0.3 * height, 0.5 * width, 0.5 * height];
    let sky = move |picture: &Pixels| {
        let [x, y] = at(0.5, 0.03).map(|place| place as u32);
        let [red, _, blue] = picture.at(x, y);
        blue > red
    };

    let before = program.picture_where(&screen, |picture| !sky(picture));
    screen.hand(&["key", "q"]);
    let there = program.picture_where(&screen, sky);
    there.keep("walking");
    assert!(sky(&there), "the sky is over the plant");
    screen.click(at(0.25, 0.65));
    let moved = |picture: &Pixels| sky(picture) && picture.changed(&there, around_plant) > 0.02;
    let nearer = program.picture_where(&screen, moved);
    nearer.keep("walked");
    assert!(moved(&nearer), "one stands elsewhere");
    screen.hand(&["key", "Escape"]);
    let as_before = |picture: &Pixels| !sky(picture) && picture.changed(&before, area) < 0.01;
    let after = program.picture_where(&screen, as_before);
    assert!(as_before(&after), "the plant is seen as before");
}
