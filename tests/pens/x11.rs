//! Pens, mouse and touch under a real Xorg.

use super::pen::{Pen, Touch, assert_drawn, assert_shifted, on_canvas, ramp};
use super::xorg::{InputTest, PenDriver, SIZE, SimPen, Xorg};
use super::{SAMPLES, empty_drawing, not_run, saved};
use crate::program::{Program, command};
use crate::screen::Area;
use crate::turn::{self, Turn};
use std::path::PathBuf;
use tempfile::TempDir;

/// The program on a server of its own.
struct Desk {
    program: Program,
    xorg: Xorg,
    file: PathBuf,
    home: TempDir,
    _turn: Turn,
}

impl Desk {
    /// `None`, and a word about it, where there is no such server.
    fn set_up(test: &str, pens: PenDriver) -> Option<Self> {
        let (_turn, home) = (turn::beside_others(), TempDir::new().unwrap());
        let xorg = match Xorg::start(pens) {
            Ok(xorg) => xorg,
            Err(why) => {
                not_run(test, &why);
                return None;
            }
        };
        let file = empty_drawing(home.path());
        let mut command = command(home.path(), &[file.to_str().unwrap()]);
        command.env("DISPLAY", &xorg.display);
        let mut program = Program::spawn(command);
        program.wait_for("the window is drawn by");
        let id = program.id().to_string();
        let found = ["search", "--sync", "--onlyvisible", "--all", "--pid", &id, "--name", "Penstemon"];
        let window = xorg.hand(&found).lines().next().unwrap().to_owned();
        xorg.hand(&["windowmove", &window, "0", "0", "windowfocus", "--sync", &window]);
        program.built();
        Some(Self { program, xorg, file, home, _turn })
    }

    /// A place on the canvas, as shares of its width and height.
    fn on_canvas(&mut self, x: f64, y: f64) -> [f64; 2] {
        let [left, top, width, height]: Area = self.program.area("canvas");
        [left + x * width, top + y * height]
    }

    fn save(&mut self) -> penstemon::sketch::Sketch {
        self.xorg.hand(&["key", "ctrl+s"]);
        self.program.wait_for("saved");
        saved(&self.file)
    }

    /// Nothing went wrong that the program noticed.
    fn close(&mut self) {
        self.xorg.hand(&["key", "ctrl+q"]);
        assert!(self.program.wait().success());
        for bad in ["notice", "ERROR penstemon", "WARN penstemon", "panicked"] {
            assert!(!self.program.has_logged(bad), "{bad}");
        }
    }
}

/// Greatest values of an absolute axis that spans the screen.
fn on_axes(at: [f64; 2], most: [f64; 2]) -> [f64; 2] {
    [at[0] / f64::from(SIZE.0) * most[0], at[1] / f64::from(SIZE.1) * most[1]]
}

impl Pen for SimPen {
    fn hover(&mut self, at: [f64; 2]) {
        let [x, y] = on_axes(at, [44800.0, 29600.0]);
        self.say(&format!("in 0={x} 1={y} 2=0"));
        self.say(&format!("move 0={x} 1={y}"));
    }

    fn press(&mut self, button: u32, touch: &Touch) {
        self.say(&format!("press {button} {}", sim_axes(touch)));
    }

    fn draw(&mut self, touch: &Touch) {
        self.say(&format!("move {}", sim_axes(touch)));
    }

    fn release(&mut self, button: u32) {
        self.say(&format!("release {button} 2=0"));
    }

    fn go(&mut self) {
        self.say("out");
    }
}

fn sim_axes(touch: &Touch) -> String {
    let [x, y] = on_axes(touch.at, [44800.0, 29600.0]);
    let [tilt_x, tilt_y] = touch.tilt_deg;
    format!("0={x} 1={y} 2={} 3={tilt_x} 4={tilt_y}", touch.pressure * 65536.0)
}

impl Pen for InputTest {
    fn hover(&mut self, at: [f64; 2]) {
        let [x, y] = on_axes(at, [65535.0; 2]);
        self.proximity(true, &[(0, x), (1, y)]);
        self.motion(true, &[(0, x), (1, y), (4, 0.0)]);
        self.sync();
    }

    fn press(&mut self, button: u32, touch: &Touch) {
        self.button(true, button, true, &test_axes(touch));
        self.sync();
    }

    fn draw(&mut self, touch: &Touch) {
        self.motion(true, &test_axes(touch));
        self.sync();
    }

    fn release(&mut self, button: u32) {
        self.button(true, button, false, &[(4, 0.0)]);
        self.sync();
    }

    fn go(&mut self) {
        self.proximity(false, &[]);
        self.sync();
    }
}

fn test_axes(touch: &Touch) -> [(usize, f64); 3] {
    let [x, y] = on_axes(touch.at, [65535.0; 2]);
    [(0, x), (1, y), (4, touch.pressure * 1000.0)]
}

#[test]
fn pen_mouse_and_touch_draw_beside_each_other() {
    let name = "pen, mouse and touch under Xorg";
    let Some(mut desk) = Desk::set_up(name, PenDriver::InputTest) else { return };
    let touches = ramp(desk.on_canvas(0.1, 0.2), desk.on_canvas(0.8, 0.3), SAMPLES);
    let mut pen = desk.xorg.inputtest("pen");
    pen.stroke(&touches);
    desk.program.built_of(1);

    // The mouse is put somewhere and then moves by steps of its own.
    let [x, y] = desk.on_canvas(0.2, 0.5).map(f64::round);
    desk.xorg.hand(&["mousemove", &x.to_string(), &y.to_string()]);
    let mut mouse = desk.xorg.inputtest("mouse");
    mouse.button(false, 1, true, &[]);
    for _ in 0..50 {
        mouse.motion(false, &[(0, 4.0), (1, 1.0)]);
        mouse.sync();
    }
    mouse.button(false, 1, false, &[]);
    mouse.sync();
    desk.program.built_of(2);

    // The pen has left: a finger is no palm.
    let mut finger = desk.xorg.inputtest("touch");
    let (from, to) = (desk.on_canvas(0.2, 0.8), desk.on_canvas(0.7, 0.7));
    std::thread::sleep(std::time::Duration::from_millis(400));
    for i in 0..=40 {
        let t = f64::from(i) / 40.0;
        let at = [from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])];
        let [x, y] = on_axes(at, [65535.0; 2]);
        let phase = if i == 0 { 18 } else { 19 };
        finger.touch(1, phase, &[(0, x), (1, y)]);
        finger.sync();
    }
    finger.touch(1, 20, &[]);
    finger.sync();
    desk.program.built_of(3);

    // And the pen draws again, as if nothing had been.
    let again = ramp(desk.on_canvas(0.8, 0.9), desk.on_canvas(0.1, 0.85), SAMPLES);
    pen.stroke(&again);
    desk.program.built_of(4);

    let sketch = desk.save();
    let [pen, mouse, finger, later] = &sketch.strokes[..] else { panic!("{} strokes", sketch.strokes.len()) };
    assert_drawn(pen, &touches, false);
    assert_drawn(later, &again, false);
    assert_eq!(mouse.points.len(), 51, "the press and 50 moves");
    assert_eq!(finger.points.len(), 41, "the press and 40 moves");
    // All three mean the same places.
    let of_mouse = mouse.points[0].position.as_dvec2() - on_canvas(pen, &touches, [x, y]);
    let of_finger = finger.points[0].position.as_dvec2() - on_canvas(pen, &touches, from);
    assert!(of_mouse.length() < 1.5 && of_finger.length() < 1.5, "{of_mouse} {of_finger}");
    assert!(mouse.points.iter().chain(&finger.points).all(|point| point.pressure == 0.5));
    desk.close();
}

#[test]
fn tilt_and_eraser_and_cables() {
    let name = "tilt, eraser and unplugging under Xorg";
    let Some(mut desk) = Desk::set_up(name, PenDriver::SimPen) else { return };
    let first = ramp(desk.on_canvas(0.1, 0.2), desk.on_canvas(0.8, 0.3), SAMPLES);
    let second = ramp(desk.on_canvas(0.9, 0.7), desk.on_canvas(0.2, 0.6), SAMPLES);
    let mut pen = desk.xorg.simpen("pen");
    pen.stroke(&first);
    desk.program.built_of(1);
    pen.stroke(&second);
    desk.program.built_of(2);
    let sketch = desk.save();
    assert_drawn(&sketch.strokes[0], &first, true);
    assert_drawn(&sketch.strokes[1], &second, true);

    // The other end takes away the stroke that it crosses.
    let across = ramp(desk.on_canvas(0.4, 0.1), desk.on_canvas(0.4, 0.4), 40);
    desk.xorg.simpen("eraser").stroke(&across);
    desk.program.built_of(1);
    let sketch = desk.save();
    assert_eq!(sketch.strokes.len(), 1);
    assert_drawn(&sketch.strokes[0], &second, true);

    // The lower button moves the sheet while the pen hovers, and draws nothing.
    pen.drag(2, [600.0, 400.0], [630.0, 420.0]);
    desk.program.rest();
    pen.stroke(&second);
    desk.program.built_of(2);
    let sketch = desk.save();
    assert_shifted(&sketch.strokes[0], &sketch.strokes[1]);

    // A pen that is pulled out while it touches ends its stroke; another one draws on.
    pen.hover(first[0].at);
    pen.press(1, &first[0]);
    first[1..100].iter().for_each(|touch| pen.draw(touch));
    desk.program.wait_for(" strokes=3 ");
    desk.program.rest();
    desk.xorg.unplug("pen");
    desk.program.wait_for("pens of the X server: 1");
    desk.program.rest();
    desk.xorg.plug("pen2");
    desk.program.wait_for("pens of the X server: 2");
    let mut pen = desk.xorg.simpen("pen2");
    pen.stroke(&across);
    desk.program.built_of(4);
    let sketch = desk.save();
    assert_drawn(&sketch.strokes[2], &first[..100], true);
    assert_drawn(&sketch.strokes[3], &across, true);

    // Panels hear it as they hear a mouse: the menu opens, and in it the dark theme is chosen.
    pen.tap([1049.0, 26.0]);
    desk.program.rest();
    pen.tap([986.0, 169.0]);
    desk.program.rest();
    desk.close();
    let settings = desk.home.path().join(".config/penstemon/settings.toml");
    let settings = std::fs::read_to_string(settings).unwrap();
    assert!(settings.contains("theme = \"dark\""), "{settings}");
}
