//! The picture under the drawing, taken hold of by mouse.

use crate::program::Program;
use crate::screen::Screen;
use crate::{photograph, sketch_saved_by};
use glam::{DVec2, Vec2};
use penstemon::picture::Picture;
use penstemon::sketch::reference::Reference;
use penstemon::sketch::{self, Sketch};
use std::path::Path;
use std::sync::Arc;
use tempfile::TempDir;

fn reference_in(file: &Path) -> Reference {
    Reference::clone(sketch_saved_by(file).reference.as_ref().unwrap())
}

#[test]
fn the_picture_is_turned_moved_and_scaled_and_every_drag_is_one_step() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let file = home.path().join("traced.penstemon");
    let mut drawing: Sketch = crate::daisy();
    let (lo, hi) = drawing.bounds().unwrap();
    let (middle, size) = ((lo + hi) / 2.0, hi - lo);
    let picture = Picture::new(photograph()).unwrap();
    drawing.reference = Some(Arc::new(Reference::new(picture, middle, 0.5 * size.x.min(size.y))));
    std::fs::write(&file, sketch::json::write(&drawing)).unwrap();
    let mut program = Program::start(&screen, home.path(), &[file.to_str().unwrap()]);
    program.built();
    screen.hand(&["key", "s"]);
    let shown = program.picture(&screen);
    shown.keep("reference-frame");

    // The frame is a line of the accent's colour: its box on the screen is read from there.
    let [left, top, right, bottom] = shown.extent(crate::program::ACCENT, program.area("canvas"));
    // Corners stand out by the half of their squares.
    let (left, right, bottom) = (left + 6.0, right - 6.0, bottom - 6.0);
    let centre = DVec2::new((left + right) / 2.0, 0.0);
    // The handle stands 32 points above the edge; its circle, of 7, ends the box of what is drawn.
    let edge = top + 32.0 + 7.0;
    let centre = DVec2::new(centre.x, (edge + bottom) / 2.0);
    let from = DVec2::new(centre.x, edge - 32.0);
    let save = |program: &mut Program| {
        screen.hand(&["key", "ctrl+s"]);
        program.wait_for("saved");
        reference_in(&file)
    };
    let drag = |program: &mut Program, from: DVec2, to: DVec2| {
        let places: Vec<[f64; 2]> = (0..=12).map(|i| from.lerp(to, f64::from(i) / 12.0).to_array()).collect();
        screen.draw(&places);
        program.built();
    };
    let before = reference_in(&file);

    // A quarter, clockwise.
    drag(&mut program, from, centre + DVec2::new(from.distance(centre), 0.0));
    program.picture(&screen).keep("reference-turned");
    let turned = save(&mut program);
    assert!((turned.rotation_deg - 90.0).abs() < 2.0, "{}", turned.rotation_deg);
    assert_eq!((turned.center, turned.width), (before.center, before.width));
    screen.hand(&["key", "ctrl+z"]);
    program.built();
    assert_eq!(save(&mut program).rotation_deg, 0.0, "one drag is one step");

    // By its middle to the right, and back.
    drag(&mut program, centre, centre + DVec2::new(60.0, 0.0));
    let moved = save(&mut program);
    assert!(moved.center.x > before.center.x && (moved.center.y - before.center.y).abs() < 1.0);
    screen.hand(&["key", "ctrl+z"]);
    program.built();

    // By its lower right corner, outward.
    let corner = DVec2::new(right, bottom);
    drag(&mut program, corner, corner + (corner - centre) * 0.25);
    let scaled = save(&mut program);
    assert!(scaled.width > 1.08 * before.width, "{} from {}", scaled.width, before.width);
    let fixed = |r: &Reference| r.center - Vec2::new(r.width, r.height()) / 2.0;
    assert!(fixed(&scaled).distance(fixed(&before)) < 1.0, "the other corner stays");
}
