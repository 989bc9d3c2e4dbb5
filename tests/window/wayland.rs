//! The window under a Wayland compositor without a screen.

use crate::number;
use crate::program::{Program, command};
use crate::turn;
use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Longest wait for the compositor.
const PATIENCE: Duration = Duration::from_secs(30);

/// A compositor, ended with this value.
struct Compositor(Child);

impl Compositor {
    fn start(runtime: &Path) -> Self {
        fs::set_permissions(runtime, fs::Permissions::from_mode(0o700)).unwrap();
        let mut command = Command::new("weston");
        command.args(["--backend=headless-backend.so", "--width=1280", "--height=800", "--idle-time=0"]);
        command.args(["--socket=wayland-test", "--no-config"]).env("XDG_RUNTIME_DIR", runtime);
        let child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn();
        let mut compositor = Self(child.expect("weston, from the package of that name"));
        let begun = Instant::now();
        while !runtime.join("wayland-test").exists() {
            assert_eq!(compositor.0.try_wait().unwrap(), None, "weston ended");
            assert!(begun.elapsed() < PATIENCE, "weston does not start");
            std::thread::sleep(Duration::from_millis(30));
        }
        compositor
    }
}

#[test]
fn a_compositor_that_goes_away_ends_the_program_with_a_word() {
    let (_turn, home) = (turn::beside_others(), TempDir::new().unwrap());
    let compositor = Compositor::start(home.path());
    let mut command = command(home.path(), &[]);
    command.env("WAYLAND_DISPLAY", "wayland-test");
    let mut program = Program::spawn(command);
    program.built();
    drop(compositor);
    let status = program.wait();
    assert!(!status.success(), "{status}");
    assert!(program.has_logged("the connection to the display broke"));
    assert!(!program.has_logged("panicked"));
}

impl Drop for Compositor {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[test]
fn the_window_opens_and_stays_under_wayland() {
    let (_turn, home) = (turn::beside_others(), TempDir::new().unwrap());
    let _compositor = Compositor::start(home.path());
    let mut command = command(home.path(), &[]);
    command.env("WAYLAND_DISPLAY", "wayland-test");
    let mut program = Program::spawn(command);
    let built = program.built();
    assert!(number(&built, "triangles") > 1000, "{built}");
    assert!(program.has_logged("uploaded") && program.has_logged("layout"));
    // That nothing goes wrong cannot be waited for: it has happened by the time when nothing more happens.
    program.idle();
    assert!(program.is_running());
    for bad in ["notice", "ERROR penstemon", "WARN penstemon", "panicked"] {
        assert!(!program.has_logged(bad), "{bad}");
    }
}
