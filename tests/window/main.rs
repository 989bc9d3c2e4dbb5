//! The window itself: the real program under a real X server, worked with mouse and keyboard.
//!
//! What the program tells with `--verbose` (`layout`, `built`, `saved`, `exported`) says when it is ready for the next
//! move; what is on the screen is read from the server's frame buffer. Screenshots stay in `target/tmp/window`.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

mod program;
mod screen;

use penstemon::sketch::{self, Sketch};
use program::{Program, field};
use screen::{Area, Screen};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

fn sketch_file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/sketches/{name}.penstemon"))
}

/// Places on the screen of every stroke of a sketch, fitted into an area.
fn strokes_in(sketch: &Sketch, [left, top, width, height]: Area) -> Vec<Vec<[f64; 2]>> {
    let (lo, hi) = sketch.bounds().unwrap();
    let size = (hi - lo).as_dvec2();
    let scale = (0.8 * width / size.x).min(0.8 * height / size.y);
    let corner = [left + 0.5 * (width - scale * size.x), top + 0.5 * (height - scale * size.y)];
    let place = |p: glam::Vec2| {
        let p = (p - lo).as_dvec2() * scale;
        [corner[0] + p.x, corner[1] + p.y]
    };
    sketch.strokes.iter().map(|s| s.points.iter().map(|p| place(p.position)).collect()).collect()
}

fn number(line: &str, name: &str) -> u64 {
    field(line, name).parse().unwrap()
}

#[test]
fn a_daisy_drawn_by_mouse_becomes_a_plant_and_survives() {
    let (screen, home) = (Screen::start(1280, 800), TempDir::new().unwrap());
    let mut program = Program::start(&screen, home.path(), &[]);
    let sample = program.settle("built");
    assert!(number(&sample, "triangles") > 1000, "the first start shows a plant: {sample}");
    screen.pixels().keep("first-start");

    // An empty drawing.
    screen.hand(&["key", "ctrl+n"]);
    program.settle("built revision");
    let empty = screen.pixels();
    let (canvas, plant) = (program.area("canvas"), program.area("plant"));
    let (daisy, _) = sketch::read(&sketch_file("daisy")).unwrap();
    let strokes = strokes_in(&daisy, canvas);
    for stroke in &strokes {
        screen.draw(stroke);
    }
    let drawn = program.settle("built");
    assert_eq!(number(&drawn, "strokes"), strokes.len() as u64);
    assert_eq!(number(&drawn, "flowers"), 1);
    let daisy_picture = screen.pixels();
    daisy_picture.keep("daisy-by-mouse");
    assert!(daisy_picture.changed(&empty, canvas) > 0.003, "the drawing is seen");
    assert!(daisy_picture.changed(&empty, plant) > 0.03, "the plant is seen");

    // Undo and redo.
    screen.hand(&["key", "ctrl+z"]);
    assert_eq!(number(&program.settle("built"), "strokes"), strokes.len() as u64 - 1);
    screen.hand(&["key", "ctrl+shift+z"]);
    assert_eq!(number(&program.settle("built"), "strokes"), strokes.len() as u64);

    // Saved under a name typed into the dialog.
    let file = home.path().join("my-daisy.penstemon");
    screen.hand(&["key", "ctrl+shift+s"]);
    std::thread::sleep(std::time::Duration::from_millis(800));
    screen.hand(&["key", "ctrl+a"]);
    screen.hand(&["type", "--delay", "5", file.to_str().unwrap()]);
    screen.pixels().keep("save-as");
    screen.hand(&["key", "Return"]);
    program.wait_for("saved");
    let (saved, warnings) = sketch::read(&file).unwrap();
    assert!(warnings.is_empty(), "{warnings:?}");
    assert_eq!(saved.strokes.len(), strokes.len());

    // A saved drawing closes without a question and opens again.
    screen.hand(&["key", "ctrl+q"]);
    assert!(program.wait().success());
    let mut again = Program::start(&screen, home.path(), &[file.to_str().unwrap()]);
    let reopened = again.settle("built");
    assert_eq!(field(&reopened, "triangles"), field(&drawn, "triangles"));
    screen.pixels().keep("daisy-reopened");
}

#[test]
fn a_killed_program_offers_the_drawing_back() {
    let (screen, home) = (Screen::start(1280, 800), TempDir::new().unwrap());
    let mut program = Program::start(&screen, home.path(), &[]);
    program.settle("built");
    screen.hand(&["key", "ctrl+n"]);
    program.settle("built");
    let (daisy, _) = sketch::read(&sketch_file("daisy")).unwrap();
    let strokes = strokes_in(&daisy, program.area("canvas"));
    for stroke in &strokes[..3] {
        screen.draw(stroke);
    }
    program.settle("built");
    program.kill();

    let mut again = Program::start(&screen, home.path(), &[]);
    let offered = again.wait_for("recoverable");
    assert_eq!(number(&offered, "strokes"), 3);
    again.settle("built");
    screen.pixels().keep("recovery");
}

#[test]
fn resize_storms_are_survived() {
    let (screen, home) = (Screen::start(1600, 1000), TempDir::new().unwrap());
    let mut program = Program::start(&screen, home.path(), &[sketch_file("daisy").to_str().unwrap()]);
    program.settle("built");
    let window = screen.hand(&["search", "--sync", "--name", "Penstemon"]);
    let window = window.lines().next().unwrap();
    for (width, height) in [(700, 500), (1, 1), (1500, 900), (320, 1000), (1600, 120), (900, 700)] {
        screen.hand(&["windowsize", window, &width.to_string(), &height.to_string()]);
    }
    screen.hand(&["windowsize", "--sync", window, "1200", "760"]);
    program.settle("layout");
    screen.pixels().keep("after-resizes");
    let [left, top, width, height] = program.area("plant");
    assert!(left + width <= 1200.0 && top + height <= 760.0);
    screen.hand(&["key", "ctrl+q"]);
    assert!(program.wait().success());
}
