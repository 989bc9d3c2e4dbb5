//! Drawing, saving, exporting, and what is left after the program was killed.

use crate::program::{Program, field};
use crate::screen::Screen;
use crate::{daisy, draw_line, number, sketch_file, strokes_in};
use glam::Vec2;
use penstemon::sketch::{self, Sketch, Stroke, StrokePoint, Tool};
use std::process::Command;
use tempfile::TempDir;

#[test]
fn a_daisy_drawn_by_mouse_becomes_a_plant_and_a_file() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let mut program = Program::start(&screen, home.path(), &[]);
    let sample = program.built();
    assert!(number(&sample, "triangles") > 1000, "the first start shows a plant: {sample}");
    program.picture(&screen).keep("first-start");

    screen.hand(&["key", "ctrl+n"]);
    program.built();
    let empty = program.picture(&screen);
    empty.keep("empty");
    let (canvas, plant) = (program.area("canvas"), program.area("plant"));
    let (daisy, strokes) = (daisy(), strokes_in(&daisy(), canvas));
    for (stroke, places) in daisy.strokes.iter().zip(&strokes) {
        screen.hand(&["key", if stroke.tool == Tool::Leaf { "l" } else { "a" }]);
        screen.draw(places);
    }
    let drawn = program.built_of(strokes.len());
    assert_eq!(number(&drawn, "flowers"), 2);
    let picture = program.picture(&screen);
    picture.keep("daisy-by-mouse");
    assert!(picture.changed(&empty, canvas) > 0.01, "the drawing is seen");
    assert!(picture.changed(&empty, plant) > 0.05, "the plant is seen");

    screen.hand(&["key", "ctrl+z"]);
    program.built_of(strokes.len() - 1);
    assert!(program.picture(&screen).changed(&picture, canvas) > 0.0005, "the last stroke is gone");
    screen.hand(&["key", "ctrl+shift+z"]);
    let again = program.built_of(strokes.len());
    assert_eq!(field(&again, "triangles"), field(&drawn, "triangles"));
    assert!(program.picture(&screen).changed(&picture, canvas) < 0.0005, "it is back as it was");

    screen.hand(&["key", "ctrl+s"]);
    program.type_name(&screen, "my daisy");
    program.wait_for("saved");
    let file = home.path().join("my daisy.penstemon");
    let (saved, warnings) = sketch::read(&file).unwrap();
    assert!(warnings.is_empty(), "{warnings:?}");
    assert_eq!(saved.strokes.len(), strokes.len());

    export(&screen, &mut program, &home);

    // A saved drawing closes without a question and opens again as it was.
    screen.hand(&["key", "ctrl+q"]);
    assert!(program.wait().success());
    let mut again = Program::start(&screen, home.path(), &[file.to_str().unwrap()]);
    let reopened = again.built();
    assert_eq!(field(&reopened, "triangles"), field(&drawn, "triangles"));
    again.picture(&screen).keep("daisy-reopened");
}

#[test]
fn a_click_on_the_plant_selects_the_stroke_that_drew_what_is_under_it() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let mut drawing = Sketch::empty();
    let points = (0..=40u8).map(|k| StrokePoint::at(Vec2::new(300.0, 20.0 + 15.0 * f32::from(k))));
    drawing.strokes.push(Stroke { id: 7, tool: Tool::Branch, points: points.collect(), brush: None }.into());
    let file = home.path().join("stem.penstemon");
    std::fs::write(&file, sketch::json::write(&drawing)).unwrap();
    let mut program = Program::start(&screen, home.path(), &[file.to_str().unwrap()]);
    program.built_of(1);
    let [left, top, width, height] = program.area("plant");
    screen.click([left + 0.5 * width, top + 0.5 * height]);
    let picked = program.wait_for("picked");
    eprintln!("{picked}");
    assert_eq!(field(&picked, "stroke"), "7");
    screen.hand(&["key", "Delete"]);
    program.built_of(0);
}

/// Exports through the dialog and holds the file against the judge.
fn export(screen: &Screen, program: &mut Program, home: &TempDir) {
    screen.hand(&["key", "ctrl+e"]);
    program.rest_in_dialog("export");
    program.picture(screen).keep("export");
    program.press_loud_button(screen, "export");
    program.type_name(screen, "daisy.glb");
    program.wait_for("exported");
    program.picture(screen).keep("exported");
    let file = home.path().join("daisy.glb");
    let checked = Command::new(env!("CARGO_BIN_EXE_penstemon")).arg("check").arg(&file).output().unwrap();
    assert!(checked.status.success(), "{}", String::from_utf8_lossy(&checked.stderr));
    let surfaces = penstemon::formats::read::read(&file).unwrap();
    assert!(surfaces.len() > 20, "{} surfaces", surfaces.len());
}

#[test]
fn a_killed_program_offers_the_drawing_back() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let mut program = Program::start(&screen, home.path(), &[]);
    program.built();
    screen.hand(&["key", "ctrl+n"]);
    program.built();
    let strokes = strokes_in(&daisy(), program.area("canvas"));
    for stroke in &strokes[..3] {
        screen.draw(stroke);
    }
    // The fourth is begun: what was finished before is on the disk.
    let [x, y] = strokes[3][0].map(|x| x.round().to_string());
    screen.hand(&["mousemove", &x, &y, "mousedown", "1"]);
    program.built();
    program.kill();
    screen.hand(&["mouseup", "1"]);

    let mut again = Program::start(&screen, home.path(), &[]);
    again.built();
    assert_eq!(number(&again.last_logged("recoverable"), "strokes"), 3);
    again.rest_in_dialog("recovery");
    again.picture(&screen).keep("recovery");
    again.press_loud_button(&screen, "recovery");
    let recovered = again.built();
    assert_eq!(number(&recovered, "strokes"), 3);
    again.picture(&screen).keep("recovered");

    // What was recovered is unsaved: closing asks.
    screen.hand(&["key", "ctrl+q"]);
    again.rest_in_dialog("unsaved");
    again.picture(&screen).keep("unsaved");
    again.press_loud_button(&screen, "unsaved");
    again.type_name(&screen, "found");
    again.wait_for("saved");
    assert!(again.wait().success(), "having saved it goes on to close");
    assert_eq!(sketch::read(&home.path().join("found.penstemon")).unwrap().0.strokes.len(), 3);
}

#[test]
fn two_windows_on_one_file_do_not_destroy_each_others_work() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let file = home.path().join("shared.penstemon");
    std::fs::copy(sketch_file("daisy"), &file).unwrap();
    let mut one = Program::start(&screen, home.path(), &[file.to_str().unwrap()]);
    one.built();
    let mut other = Program::start(&screen, home.path(), &[file.to_str().unwrap()]);
    other.built();
    assert!(!other.has_logged("recoverable"), "the first window is still open");

    one.raise(&screen);
    one.rest();
    draw_line(&screen, &mut one);
    screen.hand(&["key", "ctrl+s"]);
    one.wait_for("saved");
    let saved = std::fs::read(&file).unwrap();

    other.raise(&screen);
    other.rest();
    draw_line(&screen, &mut other);
    screen.hand(&["key", "ctrl+s"]);
    let notice = other.wait_for("notice");
    assert!(notice.contains("was changed by another window"), "{notice}");
    other.picture(&screen).keep("two-windows");
    assert_eq!(std::fs::read(&file).unwrap(), saved);
}
