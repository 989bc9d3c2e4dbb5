//! What other programs do to the window: they close it, end it, drag files onto it and hand it pictures.

use crate::client::Client;
use crate::program::Program;
use crate::screen::Screen;
use crate::{draw_line, number, photograph, sketch_file, sketch_saved_by};
use std::process::{Command, Stdio};
use tempfile::TempDir;

#[test]
fn a_window_that_is_asked_to_close_asks_about_unsaved_work_first() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let file = home.path().join("daisy.penstemon");
    std::fs::copy(sketch_file("daisy"), &file).unwrap();
    let mut program = Program::start(&screen, home.path(), &[file.to_str().unwrap()]);
    let strokes = number(&program.built(), "strokes");
    draw_line(&screen, &mut program);
    let (client, window) = (Client::on(&screen), program.window(&screen));
    // Nothing but the request itself wakes the window.
    program.idle();
    client.close(&window);
    program.rest_in_dialog("unsaved");
    program.picture(&screen).keep("asked-to-close");
    // Save: and the window closes.
    program.press_loud_button(&screen, "unsaved");
    assert!(program.wait().success());
    assert_eq!(sketch_saved_by(&file).strokes.len() as u64, strokes + 1);

    let mut program = Program::start(&screen, home.path(), &[file.to_str().unwrap()]);
    program.built();
    client.close(&program.window(&screen));
    assert!(program.wait().success(), "a saved drawing closes without a question");
}

#[test]
fn a_program_that_is_ended_by_the_system_offers_the_drawing_back() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let mut program = Program::start(&screen, home.path(), &[]);
    program.built();
    screen.hand(&["key", "ctrl+n"]);
    program.built();
    draw_line(&screen, &mut program);
    // A second line is on its way: its beginning is kept as well.
    let [left, top, width, height] = program.area("canvas");
    let place = |x: f64, y: f64| [left + x * width, top + y * height].map(|p| (p as i32).to_string());
    for (k, [x, y]) in [place(0.6, 0.3), place(0.65, 0.4), place(0.7, 0.45)].iter().enumerate() {
        screen.hand(&["mousemove", "--sync", x, y]);
        if k == 0 {
            screen.hand(&["mousedown", "1"]);
        }
    }
    program.built_of(2);
    program.terminate();
    assert!(program.wait().success(), "it ends of its own accord");
    screen.hand(&["mouseup", "1"]);
    let mut again = Program::start(&screen, home.path(), &[]);
    again.built();
    assert_eq!(number(&again.last_logged("recoverable"), "strokes"), 2);
}

#[test]
fn a_drawing_dragged_onto_the_window_is_opened_and_a_picture_lies_under_it() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let mut program = Program::start(&screen, home.path(), &[]);
    program.built();
    // With a name that must be written in escapes by whoever sends it, and is read as it stands here.
    let file = home.path().join("daisy.penstemon");
    std::fs::copy(sketch_file("daisy"), &file).unwrap();
    let (client, window) = (Client::on(&screen), program.window(&screen));
    let [left, top, width, height] = program.area("canvas");
    let middle = [left + 0.5 * width, top + 0.5 * height];
    client.drop_file(&window, middle, &file);
    let strokes = crate::daisy().strokes.len();
    program.built_of(strokes);
    let before = program.picture(&screen);
    let picture = home.path().join("photo.png");
    std::fs::write(&picture, photograph()).unwrap();
    client.drop_file(&window, middle, &picture);
    program.built();
    let after = program.picture(&screen);
    after.keep("dropped-picture");
    assert!(after.changed(&before, [left, top, width, height]) > 0.2, "the picture is seen");
    screen.hand(&["key", "ctrl+s"]);
    program.wait_for("saved");
    let saved = sketch_saved_by(&file);
    assert_eq!(saved.strokes.len(), strokes);
    assert_eq!(saved.reference.unwrap().picture.bytes()[..], photograph());
}

#[test]
fn a_picture_copied_elsewhere_is_pasted_under_the_drawing() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let picture = home.path().join("photo.png");
    std::fs::write(&picture, photograph()).unwrap();
    // xclip goes on as a process of its own that holds the clipboard.
    let copied = Command::new("xclip")
        .args(["-selection", "clipboard", "-t", "image/png", "-i"])
        .arg(&picture)
        .env("DISPLAY", &screen.display)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    assert!(copied.expect("xclip, from the package of that name").success());
    let mut program = Program::start(&screen, home.path(), &[]);
    program.built();
    screen.hand(&["key", "ctrl+n"]);
    program.built();
    draw_line(&screen, &mut program);
    let (before, canvas) = (program.picture(&screen), program.area("canvas"));
    screen.hand(&["key", "ctrl+v"]);
    program.built();
    let after = program.picture(&screen);
    after.keep("pasted-picture");
    assert!(after.changed(&before, canvas) > 0.2, "the picture is seen");
    screen.hand(&["key", "ctrl+s"]);
    program.type_name(&screen, "traced");
    program.wait_for("saved");
    let saved = sketch_saved_by(&home.path().join("traced.penstemon"));
    assert_eq!(saved.reference.unwrap().picture.bytes()[..], photograph());
}
