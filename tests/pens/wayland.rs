//! A tablet under Wayland: tool events of tablet-v2, as winit hears them.

use super::compositor::{Compositor, End, SOCKET};
use super::pen::{Pen, Touch, assert_drawn, assert_shifted, ramp};
use super::{SAMPLES, empty_drawing, saved};
use crate::program::{Program, command};
use crate::screen::Area;
use crate::turn::{self, Turn};
use std::path::PathBuf;
use tempfile::TempDir;

/// Linux's codes of the keys that save and quit with Ctrl, and of the pen's lower button.
const KEY_S: u32 = 31;
const KEY_Q: u32 = 16;
const BTN_STYLUS: u32 = 0x14b;

/// One end of the simulated pen.
struct TabletPen<'a> {
    compositor: &'a Compositor,
    end: End,
}

impl Pen for TabletPen<'_> {
    fn hover(&mut self, [x, y]: [f64; 2]) {
        self.compositor.pen(self.end, move |tool, window, tablet, serial| {
            tool.proximity_in(serial, tablet, window);
            tool.motion(x, y);
            tool.pressure(0);
        });
    }

    fn press(&mut self, button: u32, touch: &Touch) {
        let touch = *touch;
        self.compositor.pen(self.end, move |tool, _, _, serial| {
            if button == 1 {
                tool.pressure(pressure(&touch));
                tool.tilt(touch.tilt_deg[0], touch.tilt_deg[1]);
                tool.down(serial);
            } else {
                tool.button(serial, BTN_STYLUS, super::compositor::PRESSED);
            }
        });
    }

    fn draw(&mut self, touch: &Touch) {
        let touch = *touch;
        self.compositor.pen(self.end, move |tool, _, _, _| {
            tool.motion(touch.at[0], touch.at[1]);
            tool.pressure(pressure(&touch));
            tool.tilt(touch.tilt_deg[0], touch.tilt_deg[1]);
        });
    }

    fn release(&mut self, button: u32) {
        self.compositor.pen(self.end, move |tool, _, _, serial| {
            tool.pressure(0);
            if button == 1 {
                tool.up();
            } else {
                tool.button(serial, BTN_STYLUS, super::compositor::RELEASED);
            }
        });
    }

    fn go(&mut self) {
        self.compositor.pen(self.end, |tool, _, _, _| tool.proximity_out());
    }
}

/// As the protocol counts it.
fn pressure(touch: &Touch) -> u32 {
    (touch.pressure * 65535.0).round() as u32
}

/// The program under a compositor of its own.
struct Fixture {
    program: Program,
    compositor: Compositor,
    file: PathBuf,
    _home: TempDir,
    _turn: Turn,
}

impl Fixture {
    fn set_up() -> Self {
        let (_turn, home) = (turn::beside_others(), TempDir::new().unwrap());
        let compositor = Compositor::start(home.path());
        let file = empty_drawing(home.path());
        let mut command = command(home.path(), &[file.to_str().unwrap()]);
        command.env("WAYLAND_DISPLAY", SOCKET);
        let mut program = Program::spawn(command);
        program.wait_for("the window is drawn by");
        compositor.wait_for_window();
        program.built();
        Self { program, compositor, file, _home: home, _turn }
    }

    fn on_canvas(&mut self, x: f64, y: f64) -> [f64; 2] {
        let [left, top, width, height]: Area = self.program.area("canvas");
        [left + x * width, top + y * height]
    }

    fn pen(&self, end: End) -> TabletPen<'_> {
        TabletPen { compositor: &self.compositor, end }
    }

    fn save(&mut self) -> penstemon::sketch::Sketch {
        self.compositor.press_ctrl(KEY_S);
        self.program.wait_for("saved");
        saved(&self.file)
    }
}

#[test]
fn a_tablet_draws_with_pressure_and_tilt_and_erases() {
    let mut fixture = Fixture::set_up();
    let first = ramp(fixture.on_canvas(0.1, 0.2), fixture.on_canvas(0.8, 0.3), SAMPLES);
    let second = ramp(fixture.on_canvas(0.9, 0.7), fixture.on_canvas(0.2, 0.6), SAMPLES);
    fixture.pen(End::Tip).stroke(&first);
    fixture.program.built_of(1);
    fixture.pen(End::Tip).stroke(&second);
    fixture.program.built_of(2);
    let sketch = fixture.save();
    assert_drawn(&sketch.strokes[0], &first, true);
    assert_drawn(&sketch.strokes[1], &second, true);

    // The other end takes away the stroke that it crosses.
    let across = ramp(fixture.on_canvas(0.4, 0.1), fixture.on_canvas(0.4, 0.4), 40);
    fixture.pen(End::Eraser).stroke(&across);
    fixture.program.built_of(1);

    // The lower button moves the sheet while the pen hovers, and draws nothing.
    fixture.pen(End::Tip).drag(2, [600.0, 400.0], [630.0, 420.0]);
    fixture.program.rest();
    fixture.pen(End::Tip).stroke(&second);
    fixture.program.built_of(2);

    // The mouse still draws.
    let mouse: Vec<[f64; 2]> = across.iter().map(|touch| touch.at).collect();
    fixture.compositor.drag(mouse.clone());
    fixture.program.built_of(3);

    let sketch = fixture.save();
    let [before, shifted, by_mouse] = &sketch.strokes[..] else { panic!("{} strokes", sketch.strokes.len()) };
    assert_drawn(before, &second, true);
    assert_drawn(shifted, &second, true);
    assert_shifted(before, shifted);
    assert_eq!(by_mouse.points.len(), mouse.len());
    assert!(by_mouse.points.iter().all(|point| point.pressure == 0.5));
    fixture.compositor.press_ctrl(KEY_Q);
    fixture.compositor.press_ctrl(KEY_S);
    for bad in ["notice", "ERROR penstemon", "WARN penstemon", "panicked"] {
        assert!(!fixture.program.has_logged(bad), "{bad}");
    }
}
