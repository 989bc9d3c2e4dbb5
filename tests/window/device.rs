//! The graphics device is lost under an open window: a layer of ours between the program and its Vulkan driver
//! (`lose_device.c`) answers from then on as a driver does that was reset.

use crate::not_run::not_run;
use crate::program::Program;
use crate::screen::{Pixels, Screen};
use crate::{draw_line, number, sketch_saved_by};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

/// How a device is lost.
struct Layer {
    folder: TempDir,
}

impl Layer {
    /// Compiles the layer; `None` where there is no compiler.
    fn compile() -> Option<Self> {
        let folder = TempDir::new().unwrap();
        let library = folder.path().join("liblose_device.so");
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/window/lose_device.c");
        let mut compiler = Command::new("cc");
        compiler.args(["-O1", "-Wall", "-Werror", "-shared", "-fPIC", "-fvisibility=hidden", "-o"]);
        let Ok(done) = compiler.arg(&library).arg(source).output() else {
            not_run("a graphics card that is lost", "no compiler (Debian: gcc)");
            return None;
        };
        assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
        let manifest = serde_json::json!({
            "file_format_version": "1.0.0",
            "layer": {
                "name": "VK_LAYER_lose_device",
                "type": "GLOBAL",
                "library_path": library,
                "api_version": "1.3.0",
                "implementation_version": "1",
                "description": "Loses devices",
            },
        });
        fs::write(folder.path().join("lose_device.json"), manifest.to_string()).unwrap();
        Some(Self { folder })
    }

    /// The program on this layer, with a new drawing of two lines.
    fn program(&self, screen: &Screen, home: &Path) -> Program {
        let (lose, refuse, folder) = (self.lose(), self.refuse(), self.folder.path());
        let text = |path: &PathBuf| path.to_str().unwrap().to_owned();
        let more = [
            ("VK_LAYER_PATH", folder.to_str().unwrap()),
            ("VK_INSTANCE_LAYERS", "VK_LAYER_lose_device"),
            ("LOSE_DEVICE", &text(&lose)),
            ("REFUSE_DEVICES", &text(&refuse)),
            // No OpenGL that could take the place of Vulkan.
            ("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent"),
        ];
        let mut program = Program::start_with(screen, home, &[], &more);
        program.built();
        screen.hand(&["key", "ctrl+n"]);
        program.built();
        for count in [1, 2] {
            assert_eq!(number(&draw_line(screen, &mut program), "strokes"), count);
        }
        program
    }

    /// As long as this is there, no device can be opened.
    fn refuse(&self) -> PathBuf {
        self.folder.path().join("refuse")
    }

    /// When this is made, the device is lost with the next frame.
    fn lose(&self) -> PathBuf {
        self.folder.path().join("lose")
    }
}

/// Everything is seen as it was before, and can be saved.
fn is_whole(screen: &Screen, program: &mut Program, before: &Pixels, home: &Path) {
    let canvas = program.area("canvas");
    program.picture(screen).keep("after-lost-device");
    assert!(program.picture(screen).changed(before, canvas) > 0.0005, "the third line is seen");
    screen.hand(&["key", "ctrl+z"]);
    program.built_of(2);
    // Good news go by themselves, after some seconds.
    let whole = [0.0, 0.0, f64::from(before.width), f64::from(before.height)];
    let is_as_before = |picture: &Pixels| picture.changed(before, whole) < 0.002;
    let after = program.picture_where(screen, is_as_before);
    after.keep("after-lost-device-undone");
    assert!(is_as_before(&after), "drawing, plant and panels are as before");
    screen.hand(&["key", "ctrl+s"]);
    program.type_name(screen, "kept");
    program.wait_for("saved");
    assert_eq!(sketch_saved_by(&home.join("kept.penstemon")).strokes.len(), 2);
}

#[test]
fn a_device_lost_while_a_stroke_is_drawn_costs_nothing() {
    let Some(layer) = Layer::compile() else { return };
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let mut program = layer.program(&screen, home.path());
    let before = program.picture(&screen);
    fs::write(layer.lose(), "").unwrap();
    assert_eq!(number(&draw_line(&screen, &mut program), "strokes"), 3);
    assert!(program.has_logged("the graphics device was lost"), "nothing was lost");
    assert!(program.last_logged("notice").contains("Nothing of the drawing is lost"));
    is_whole(&screen, &mut program, &before, home.path());
}

#[test]
fn without_a_device_the_drawing_goes_on_until_there_is_one() {
    let Some(layer) = Layer::compile() else { return };
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let mut program = layer.program(&screen, home.path());
    let before = program.picture(&screen);
    fs::write(layer.refuse(), "").unwrap();
    fs::write(layer.lose(), "").unwrap();
    screen.hand(&["mousemove", "600", "400", "mousemove", "620", "420"]);
    program.wait_for("no graphics device yet");
    // Drawn blindly.
    let [left, top, width, height] = program.area("canvas");
    let place = |t: f64| [left + width * (0.3 + t), top + height * (0.8 - t)];
    screen.draw(&[0.0, 0.1, 0.2, 0.3].map(place));
    program.wait_for(" strokes=3 ");
    fs::remove_file(layer.refuse()).unwrap();
    program.wait_for("the window is drawn by");
    is_whole(&screen, &mut program, &before, home.path());
}

#[test]
fn where_no_device_comes_back_the_program_says_so_and_offers_the_drawing_at_the_next_start() {
    let Some(layer) = Layer::compile() else { return };
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let mut program = layer.program(&screen, home.path());
    fs::write(layer.refuse(), "").unwrap();
    fs::write(layer.lose(), "").unwrap();
    screen.hand(&["mousemove", "600", "400", "mousemove", "620", "420"]);
    assert_eq!(program.wait().code(), Some(1));
    let message = program.last_logged("penstemon:");
    assert!(message.contains("the drawing is kept") && message.contains("mesa-vulkan-drivers"), "{message}");
    let mut again = Program::start(&screen, home.path(), &[]);
    again.built();
    assert_eq!(number(&again.last_logged("recoverable"), "strokes"), 2);
}
