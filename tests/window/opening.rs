//! How the window opens: never black, and no larger than the desktop has room for.

use crate::client::Client;
use crate::program::{Program, command};
use crate::screen::Screen;
use tempfile::TempDir;

/// What was on the screen before.
const BEFORE: [u8; 3] = [0xff, 0x00, 0xff];

#[test]
fn a_window_is_filled_from_the_moment_it_is_seen() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let client = Client::on(&screen);
    client.paint_root(BEFORE);
    let mut command = command(home.path(), &[]);
    command.env("DISPLAY", &screen.display);
    let mut program = Program::spawn(command);
    client.wait_for_large_window();
    let first = screen.pixels();
    first.keep("opening");
    for (x, y) in [(20, 20), (300, 400), (900, 400), (1270, 790)] {
        let colour = first.at(x, y);
        assert!(colour != BEFORE && colour.iter().all(|c| *c > 60), "{colour:?} at {x}, {y}");
    }
    program.built();
}

#[test]
fn a_window_leaves_room_for_panels_and_its_title_bar() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    // It stays: without any client the server forgets what was said.
    let client = Client::on(&screen);
    client.call_work_area([0, 28, 1280, 740]);
    let mut program = Program::start(&screen, home.path(), &[]);
    program.built();
    let output = screen.hand(&["getwindowgeometry", "--shell", &program.window(&screen)]);
    assert!(output.contains("WIDTH=1280\n") && output.contains("HEIGHT=700\n"), "{output}");
    let [_, top, _, height] = program.area("plant");
    assert!(top + height < 700.0, "the status line is below");
    program.picture(&screen).keep("opening-in-a-work-area");
}
