//! What goes wrong is said plainly, and the drawing stays.

use crate::program::{Program, command};
use crate::screen::Screen;
use crate::turn;
use crate::{draw_line, number, sketch_file};
use std::process::Command;
use tempfile::TempDir;

/// Runs a program that cannot open a window: what it says.
fn failure(mut command: Command) -> String {
    let done = command.output().unwrap();
    let output = String::from_utf8_lossy(&done.stderr).into_owned();
    assert_eq!(done.status.code(), Some(1), "{output}");
    output.lines().filter(|line| line.starts_with("penstemon:")).collect()
}

#[test]
fn without_a_display_the_program_says_so() {
    let (_turn, home) = (turn::beside_others(), TempDir::new().unwrap());
    let output = failure(command(home.path(), &[]));
    assert!(output.contains("there is no display") && output.contains("penstemon build"), "{output}");
    let mut unreachable = command(home.path(), &[]);
    unreachable.env("DISPLAY", ":4095");
    let output = failure(unreachable);
    assert!(output.contains("there is no display"), "{output}");
}

#[test]
fn without_a_driver_the_program_names_the_package() {
    let (screen, home) = (Screen::beside_others(800, 600), TempDir::new().unwrap());
    let mut command = command(home.path(), &[]);
    command.env("DISPLAY", &screen.display).env("VK_ICD_FILENAMES", "/nonexistent");
    command.env("VK_DRIVER_FILES", "/nonexistent").env("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent");
    let output = failure(command);
    assert!(output.contains("mesa-vulkan-drivers"), "{output}");
}

#[test]
fn without_vulkan_the_window_is_drawn_by_opengl() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let none = [("VK_ICD_FILENAMES", "/nonexistent"), ("VK_DRIVER_FILES", "/nonexistent")];
    let mut program = Program::start_with(&screen, home.path(), &[], &none);
    let built = program.built();
    assert!(program.has_logged("(gl)"), "drawn by something else");
    assert!(number(&built, "triangles") > 1000);
    let picture = program.picture(&screen);
    picture.keep("opengl");
    assert!(!program.has_logged("notice"));
    // The sample's red petals.
    let reds = |x| (200..300).any(|y| matches!(picture.at(x, y), [r, g, _] if r > g.saturating_add(80)));
    assert!((690..930).filter(|&x| reds(x)).count() > 150, "the plant is seen");
}

#[test]
fn a_bad_file_is_reported_and_the_window_stays() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let file = home.path().join("bad.penstemon");
    std::fs::write(&file, "{\"format\": 7").unwrap();
    let mut program = Program::start(&screen, home.path(), &[file.to_str().unwrap()]);
    program.built();
    assert!(program.has_logged("notice") && program.has_logged("bad.penstemon"));
    program.picture(&screen).keep("bad-file");
    draw_line(&screen, &mut program);
    assert!(std::fs::read(&file).unwrap().starts_with(b"{\"format\": 7"));
}

#[test]
fn a_drawing_whose_folder_vanished_stays_and_is_saved_elsewhere() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let folder = home.path().join("stick");
    std::fs::create_dir(&folder).unwrap();
    let file = folder.join("daisy.penstemon");
    std::fs::copy(sketch_file("daisy"), &file).unwrap();
    let mut program = Program::start(&screen, home.path(), &[file.to_str().unwrap()]);
    let strokes = number(&program.built(), "strokes");
    std::fs::remove_dir_all(&folder).unwrap();
    assert_eq!(number(&draw_line(&screen, &mut program), "strokes"), strokes + 1);
    screen.hand(&["key", "ctrl+s"]);
    let notice = program.wait_for("notice");
    assert!(notice.contains("daisy.penstemon"), "{notice}");
    program.picture(&screen).keep("vanished-folder");
    screen.hand(&["key", "ctrl+shift+s"]);
    program.type_name(&screen, "rescued");
    program.wait_for("saved");
    let (saved, _) = penstemon::sketch::read(&home.path().join("rescued.penstemon")).unwrap();
    assert_eq!(saved.strokes.len() as u64, strokes + 1);
}
