//! Branches drawn, turned and bent by mouse in the view of the plant.

use crate::program::Program;
use crate::screen::Screen;
use crate::sketch_saved_by;
use penstemon::sketch::{PartName, Sketch, Tool};
use std::path::Path;
use tempfile::TempDir;

/// A trunk in the middle of the sheet, so that it stands in the middle of the view.
const TRUNK: &str = r#"{"format": "penstemon-sketch", "version": 1, "canvas": {"width": 800, "height": 800}, "strokes": [
    {"tool": "branch", "points": [[400, 780], [404, 600], [398, 400], [400, 200], [400, 20]]}]}"#;

/// Saves, and reads the file.
fn saved(screen: &Screen, program: &mut Program, file: &Path) -> Sketch {
    screen.hand(&["key", "ctrl+s"]);
    program.rest();
    sketch_saved_by(file)
}

/// A line of eleven places.
fn line(from: [f64; 2], by: [f64; 2]) -> Vec<[f64; 2]> {
    let at = |k: i32| f64::from(k) / 10.0;
    (0..=10).map(|k| [from[0] + by[0] * at(k), from[1] + by[1] * at(k)]).collect()
}

#[test]
fn branches_are_drawn_turned_and_bent_and_each_is_one_step() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let file = home.path().join("tree.penstemon");
    std::fs::write(&file, TRUNK).unwrap();
    let mut program = Program::start(&screen, home.path(), &[file.to_str().unwrap()]);
    program.built();
    let [left, top, width, height] = program.area("plant");
    let middle = [left + 0.5 * width, top + 0.5 * height];

    screen.hand(&["key", "w"]);
    program.rest();
    screen.draw(&line(middle, [0.25 * width, -0.15 * height]));
    program.built();
    // From another side a second one, toward where the viewer was: the plant is turned by a drag beside it.
    screen.draw(&line([left + 0.15 * width, middle[1]], [0.25 * width, 0.0]));
    program.rest();
    screen.draw(&line([middle[0], middle[1] + 0.1 * height], [-0.2 * width, -0.1 * height]));
    program.built();
    program.picture(&screen).keep("drawn-in-space");
    let drawn = saved(&screen, &mut program, &file);
    let in_space: Vec<_> = drawn.strokes.iter().filter(|s| s.tool == Tool::SpaceBranch).collect();
    assert_eq!(
        in_space.len(),
        2,
        "two branches: {:?}",
        drawn.strokes.iter().map(|s| s.tool).collect::<Vec<_>>()
    );
    let depth = |k: usize| in_space[k].points.iter().map(|p| p.depth.abs()).fold(0.0, f32::max);
    assert!(depth(0) < 60.0, "the first lies about in the plane of the sheet: {}", depth(0));
    assert!(depth(1) > 30.0, "the second leads out of it: {}", depth(1));

    screen.hand(&["key", "j"]);
    program.rest();
    let grip = [middle[0], top + 0.2 * height];
    screen.draw(&line(grip, [0.1 * width, 0.0]));
    program.built();
    program.picture(&screen).keep("turned-in-space");
    let turned = saved(&screen, &mut program, &file);
    assert_eq!(turned.part_poses.len(), 1);
    assert_eq!(turned.part_poses[0].part, PartName::Stroke(drawn.strokes[0].id), "the trunk was dragged");
    screen.hand(&["key", "ctrl+z"]);
    program.built();
    assert_eq!(saved(&screen, &mut program, &file).part_poses, [].into());
    screen.hand(&["key", "ctrl+z"]);
    program.built();
    assert_eq!(saved(&screen, &mut program, &file).strokes.len(), 2, "one step each");
}

#[test]
fn brushes_paint_and_prune_and_each_stroke_is_one_step() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let file = home.path().join("tree.penstemon");
    std::fs::write(&file, TRUNK).unwrap();
    let mut program = Program::start(&screen, home.path(), &[file.to_str().unwrap()]);
    program.built();
    let [left, top, width, height] = program.area("plant");
    let middle = [left + 0.5 * width, top + 0.5 * height];

    screen.hand(&["key", "u"]);
    program.rest();
    screen.draw(&line([middle[0], top + 0.35 * height], [0.3 * width, -0.1 * height]));
    program.built();
    program.picture(&screen).keep("painted");
    screen.hand(&["key", "x"]);
    program.rest();
    screen.draw(&line([middle[0] - 0.1 * width, top + 0.5 * height], [0.2 * width, 0.0]));
    program.built();
    program.picture(&screen).keep("pruned");
    let drawn = saved(&screen, &mut program, &file);
    let tools: Vec<Tool> = drawn.strokes.iter().map(|stroke| stroke.tool).collect();
    assert_eq!(tools, [Tool::Branch, Tool::GrowthBrush, Tool::PruningBrush]);
    assert!(drawn.strokes[1].brush.is_some_and(|brush| brush.radius > 0.0));
    // Beside the plant a brush turns it.
    screen.draw(&line([left + 0.1 * width, middle[1]], [0.2 * width, 0.0]));
    program.rest();
    for left in [2, 1] {
        screen.hand(&["key", "ctrl+z"]);
        program.built();
        assert_eq!(saved(&screen, &mut program, &file).strokes.len(), left, "one step each");
    }
}
