//! Disks that are full and folders that cannot be written: a message, and the drawing stays.

use crate::not_run::not_run;
use crate::program::{Program, command};
use crate::screen::Screen;
use crate::{draw_line, number, sketch_file, sketch_saved_by};
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

/// Whether the system lets this user mount a disk of his own.
fn can_mount() -> bool {
    let tried = Command::new("unshare").args(["-rm", "mount", "-t", "tmpfs", "none", "/mnt"]).output();
    tried.is_ok_and(|done| done.status.success())
}

/// What is done to a disk before the program starts; its folder is `$1`.
const FILL: &str = "cat /dev/zero >\"$1/fill\" 2>/dev/null";
const PROTECT: &str = "mount -o remount,ro \"$1\" || exit 9";

/// The dialog's button that goes to the home folder, and its field for a name.
const HOME: [f64; 2] = [428.0, 155.0];
const NAME: [f64; 2] = [640.0, 631.0];

/// The program on a drawing that lies on a small disk of its own, to which something was done.
fn on_disk(done: &str, home: &Path, disk: &Path) -> Command {
    let file = disk.join("daisy.penstemon");
    let plain = command(home, &[file.to_str().unwrap()]);
    let mut command = Command::new("unshare");
    command.args(["-rm", "sh", "-c"]);
    command.arg(format!(
        "mount -t tmpfs -o size=256k none \"$1\" && cp \"$2\" \"$1/daisy.penstemon\" || exit 9
         {done}
         shift 2; exec \"$@\""
    ));
    command.arg("sh").arg(disk).arg(sketch_file("daisy")).arg(plain.get_program()).args(plain.get_args());
    for (name, value) in plain.get_envs() {
        match value {
            Some(value) => command.env(name, value),
            None => command.env_remove(name),
        };
    }
    command
}

/// Draws on such a disk, tries to save there, and saves elsewhere.
fn try_disk(done: &str, reason: &str) {
    if !can_mount() {
        not_run("a drawing on a disk that fails", "this user can mount no disk (unshare -rm)");
        return;
    }
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let disk = TempDir::new().unwrap();
    let mut program = Program::start_command(&screen, on_disk(done, home.path(), disk.path()));
    let strokes = number(&program.built(), "strokes");
    draw_line(&screen, &mut program);
    screen.hand(&["key", "ctrl+s"]);
    let notice = program.wait_for("notice").to_lowercase();
    assert!(notice.contains(reason) && notice.contains("daisy.penstemon"), "{notice}");
    program.picture(&screen).keep(&format!("cannot-save-{}", reason.replace(' ', "-")));
    // The drawing is still there, and still unsaved: closing asks, and is given up when saving fails again.
    screen.hand(&["key", "ctrl+q"]);
    program.press_loud_button(&screen, "unsaved");
    program.wait_for("notice");
    program.rest();
    assert!(program.is_running());

    screen.hand(&["key", "ctrl+shift+s"]);
    for place in [HOME, NAME] {
        program.rest_in_dialog("path");
        screen.click(place);
    }
    program.type_name(&screen, "rescued");
    program.wait_for("saved");
    let rescued = sketch_saved_by(&home.path().join("rescued.penstemon"));
    assert_eq!(rescued.strokes.len() as u64, strokes + 1);
    screen.hand(&["key", "ctrl+q"]);
    assert!(program.wait().success(), "it is saved now");
}

#[test]
fn a_full_disk_is_reported_and_the_drawing_is_saved_elsewhere() {
    try_disk(FILL, "disk is full");
}

#[test]
fn a_folder_that_is_read_only_is_reported_and_the_drawing_is_saved_elsewhere() {
    try_disk(PROTECT, "no permission");
}
