//! The window itself: the real program under a real X server or Wayland compositor, worked with mouse and keyboard.
//!
//! What the program tells with `--verbose` (`layout`, `built`, `saved`, `exported`) says when it is ready for the next
//! move; what is on the screen is read from the server's frame buffer. Screenshots stay in `target/tmp/window`.
//!
//! Needs Xvfb, xdotool, xclip, weston, an accessibility bus and a software driver (Debian: xvfb, xdotool, xclip, weston,
//! dbus, at-spi2-core, libglib2.0-bin, mesa-vulkan-drivers).

#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

mod assistive;
mod beside;
mod client;
mod device;
mod disk;
mod display;
mod drawing;
mod exports;
mod garden;
mod kills;
mod latency;
mod looks;
mod memory;
#[path = "../common/not_run.rs"]
mod not_run;
mod opening;
mod others;
#[path = "../pens/mod.rs"]
mod pens;
mod petals;
mod program;
mod reference;
mod screen;
mod space;
mod trouble;
mod turn;
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

fn sketch_saved_by(path: &Path) -> Sketch {
    sketch::read(path).unwrap().0
}

/// A PNG file that can be told from everything else on the screen: stripes.
fn photograph() -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let mut encoder = png::Encoder::new(&mut bytes, 64, 48);
    encoder.set_color(png::ColorType::Rgb);
    let stripe = |i: usize| if ((i % 64) / 8).is_multiple_of(2) { [30, 90, 200] } else { [20, 40, 60] };
    let pixels: Vec<u8> = (0..64 * 48).flat_map(stripe).collect();
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&pixels).unwrap();
    writer.finish().unwrap();
    bytes.into_inner()
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
