//! The window itself: the real program under a real X server or Wayland compositor, worked with mouse and keyboard.
//!
//! What the program tells with `--verbose` (`layout`, `built`, `saved`, `exported`) says when it is ready for the next
//! move; what is on the screen is read from the server's frame buffer. Screenshots stay in `target/tmp/window`.
//!
//! Needs Xvfb, xdotool, weston and a software driver (Debian: xvfb, xdotool, weston, mesa-vulkan-drivers).

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

mod drawing;
mod looks;
mod program;
mod screen;
mod trouble;
mod wayland;

use penstemon::sketch::{self, Sketch};
use program::{Program, field};
use screen::{Area, Screen};
use std::path::{Path, PathBuf};

fn sketch_file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/sketches/{name}.penstemon"))
}

fn daisy() -> Sketch {
    sketch::read(&sketch_file("daisy")).unwrap().0
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

/// A line across the canvas: something to save.
fn draw_line(screen: &Screen, program: &mut Program) -> String {
    let [left, top, width, height] = program.area("canvas");
    let at = |t: f64| [left + width * (0.3 + 0.02 * t), top + height * (0.9 - 0.06 * t)];
    screen.draw(&(0..10).map(|i| at(f64::from(i))).collect::<Vec<_>>());
    program.built()
}
