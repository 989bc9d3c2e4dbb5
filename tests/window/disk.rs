//! Disks that are full and folders that cannot be written: a message, and the drawing stays.

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

/// The program on a drawing that lies on a disk of 256 KiB, which is full but for the drawing.
fn on_full_disk(home: &Path, disk: &Path) -> Command {
    let file = disk.join("daisy.penstemon");
    let plain = command(home, &[file.to_str().unwrap()]);
    let mut command = Command::new("unshare");
    command.args(["-rm", "sh", "-c"]);
    command.arg(
        "mount -t tmpfs -o size=256k none \"$1\" && cp \"$2\" \"$1/daisy.penstemon\" || exit 9
         cat /dev/zero >\"$1/fill\" 2>/dev/null
         shift 2; exec \"$@\"",
    );
    command.arg("sh").arg(disk).arg(sketch_file("daisy")).arg(plain.get_program()).args(plain.get_args());
    for (name, value) in plain.get_envs() {
        match value {
            Some(value) => command.env(name, value),
            None => command.env_remove(name),
        };
    }
    command
}

#[test]
fn a_full_disk_is_told_and_the_drawing_is_saved_elsewhere() {
    if !can_mount() {
        eprintln!("not run: this user can mount no disk (unshare -rm)");
        return;
    }
    let (screen, home) = (Screen::start(1280, 800), TempDir::new().unwrap());
    let disk = TempDir::new().unwrap();
    let mut program = Program::start_command(&screen, on_full_disk(home.path(), disk.path()));
    let strokes = number(&program.built(), "strokes");
    draw_line(&screen, &mut program);
    screen.hand(&["key", "ctrl+s"]);
    let notice = program.wait_for("notice");
    assert!(notice.contains("the disk is full") && notice.contains("daisy.penstemon"), "{notice}");
    program.picture(&screen).keep("full-disk");
    // The drawing is still there, and still unsaved: closing asks, and gives up closing when saving fails again.
    screen.hand(&["key", "ctrl+q"]);
    program.press_loud_button(&screen);
    program.rest();
    assert!(program.is_running());
    save_elsewhere(&screen, &mut program, home.path(), strokes + 1);
}

#[test]
fn a_folder_that_cannot_be_written_is_told_and_the_drawing_is_saved_elsewhere() {
    // The kernel's own folder takes no files of anybody, the system's administrator included.
    let folder = Path::new("/sys/kernel");
    if !folder.is_dir() {
        eprintln!("not run: this system has no {}", folder.display());
        return;
    }
    let (screen, home) = (Screen::start(1280, 800), TempDir::new().unwrap());
    let mut program = Program::start(&screen, home.path(), &[]);
    program.built();
    screen.hand(&["key", "ctrl+n"]);
    program.built();
    draw_line(&screen, &mut program);
    screen.hand(&["key", "ctrl+s"]);
    program.type_name(&screen, "/sys/kernel/rose");
    let notice = program.wait_for("notice");
    assert!(notice.contains("cannot write /sys/kernel/rose.penstemon"), "{notice}");
    program.picture(&screen).keep("read-only-folder");
    save_elsewhere(&screen, &mut program, home.path(), 1);
}

fn save_elsewhere(screen: &Screen, program: &mut Program, home: &Path, strokes: u64) {
    screen.hand(&["key", "ctrl+shift+s"]);
    program.type_name(screen, &home.join("rescued").display().to_string());
    program.wait_for("saved");
    assert_eq!(sketch_saved_by(&home.join("rescued.penstemon")).strokes.len() as u64, strokes);
    screen.hand(&["key", "ctrl+q"]);
    assert!(program.wait().success(), "it is saved now");
}
