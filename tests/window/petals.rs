//! Petals shaped by mouse in the window.

use crate::program::Program;
use crate::screen::Screen;
use crate::{sketch_file, sketch_saved_by};
use penstemon::sketch::petal_shapes::PetalShape;
use std::path::Path;
use std::time::Duration;
use tempfile::TempDir;

/// Longer than the window waits for a second click.
const NO_SECOND_CLICK: Duration = Duration::from_millis(600);

/// Saves, and gives the shapes of petals that the file then has.
fn saved(screen: &Screen, program: &mut Program, file: &Path) -> Vec<PetalShape> {
    screen.hand(&["key", "ctrl+s"]);
    program.rest();
    sketch_saved_by(file).petal_shapes.to_vec()
}

#[test]
fn a_petal_is_tapped_its_point_dragged_and_the_flower_shaped_with_it() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let file = home.path().join("flower.penstemon");
    std::fs::copy(sketch_file("balloon_flower"), &file).unwrap();
    let mut program = Program::start(&screen, home.path(), &[file.to_str().unwrap()]);
    program.built();
    screen.hand(&["key", "k"]);
    program.rest();
    let [left, top, width, height] = program.area("plant");
    // The larger flower stands to the upper left; a drag from beside every point turns the plant, and the next place is tried.
    let mut places = [(0.33, 0.2), (0.28, 0.17), (0.38, 0.14), (0.25, 0.25), (0.4, 0.22), (0.33, 0.28)]
        .into_iter()
        .map(|(x, y)| [left + x * width, top + y * height]);
    let shaped = places.find_map(|[x, y]| {
        screen.click([x, y]);
        std::thread::sleep(NO_SECOND_CLICK);
        program.rest();
        let up: Vec<[f64; 2]> = (0..=10).map(|i| [x, y - 6.0 * f64::from(i)]).collect();
        screen.draw(&up);
        program.rest();
        let shapes = saved(&screen, &mut program, &file);
        (!shapes.is_empty()).then_some(shapes)
    });
    let shaped = shaped.expect("no petal could be shaped");
    program.picture(&screen).keep("petal-shaped");
    assert_eq!(shaped.len(), 1);
    let strokes = &shaped[0].strokes;
    assert_eq!(strokes.len(), 5, "all petals of the flower: {strokes:?}");
    let moved = shaped[0].offsets.as_flattened().iter().filter(|offset| offset.length() > 0.01).count();
    assert!((1..=2).contains(&moved), "a point and its partner: {moved}");

    // One drag is one step.
    screen.hand(&["key", "ctrl+z"]);
    program.built();
    assert_eq!(saved(&screen, &mut program, &file), []);
}
