//! A screen reader's view of the window, over an accessibility bus of its own.

use crate::program::Program;
use crate::screen::Screen;
use std::collections::VecDeque;
use std::io::{BufRead as _, BufReader};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Longest wait for the window to appear on the bus.
const PATIENCE: Duration = Duration::from_secs(60);

/// A bus of a desktop's session, with the accessibility services of the system.
struct Session {
    daemon: Child,
    address: String,
}

impl Session {
    fn start(home: &TempDir, display: &str) -> Self {
        let mut daemon = Command::new("dbus-daemon")
            .args(["--session", "--nofork", "--nopidfile", "--print-address=1"])
            .env("XDG_RUNTIME_DIR", home.path())
            .env("HOME", home.path())
            .env("DISPLAY", display)
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("dbus-daemon, from the package dbus");
        let mut address = String::new();
        BufReader::new(daemon.stdout.take().unwrap()).read_line(&mut address).unwrap();
        Self { daemon, address: address.trim().to_owned() }
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        let _ = self.daemon.kill();
        let _ = self.daemon.wait();
    }
}

/// Calls a method on a bus and gives the answer as gdbus writes it.
fn call(bus: &str, to: &str, path: &str, method: &str, arguments: &[&str]) -> String {
    let answer = Command::new("gdbus")
        .args(["call", "--address", bus, "--dest", to, "--object-path", path, "--method", method])
        .args(arguments)
        .output()
        .expect("gdbus, from the package libglib2.0-bin");
    String::from_utf8(answer.stdout).unwrap()
}

/// The texts in quotes of an answer.
fn quoted(answer: &str) -> Vec<String> {
    answer.split('\'').skip(1).step_by(2).map(str::to_owned).collect()
}

/// Name and children of something that can be read: `(bus name, path)` each.
fn read(bus: &str, (to, path): &(String, String)) -> (String, Vec<(String, String)>) {
    const PROPERTY: &str = "org.freedesktop.DBus.Properties.Get";
    const ACCESSIBLE: &str = "org.a11y.atspi.Accessible";
    let name = call(bus, to, path, PROPERTY, &[ACCESSIBLE, "Name"]);
    let name = quoted(&name).into_iter().next().unwrap_or_default();
    let children = quoted(&call(bus, to, path, "org.a11y.atspi.Accessible.GetChildren", &[]));
    (name, children.chunks_exact(2).map(|pair| (pair[0].clone(), pair[1].clone())).collect())
}

/// Looks for something of this name below the root of the bus.
fn find(bus: &str, wanted: &str) -> Option<(String, String)> {
    let root = ("org.a11y.atspi.Registry".to_owned(), "/org/a11y/atspi/accessible/root".to_owned());
    let mut waiting = VecDeque::from([root]);
    let mut seen = 0;
    while let Some(node) = waiting.pop_front() {
        seen += 1;
        assert!(seen < 2000, "the tree has no end");
        let (name, children) = read(bus, &node);
        if name == wanted {
            return Some(node);
        }
        waiting.extend(children);
    }
    None
}

#[test]
fn a_screen_reader_finds_a_button_and_presses_it() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let session = Session::start(&home, &screen.display);
    let bus = session.address.as_str();
    // What a screen reader does first.
    let on = ["org.a11y.Status", "IsEnabled", "<true>"];
    call(bus, "org.a11y.Bus", "/org/a11y/bus", "org.freedesktop.DBus.Properties.Set", &on);
    let address = call(bus, "org.a11y.Bus", "/org/a11y/bus", "org.a11y.Bus.GetAddress", &[]);
    let reading = quoted(&address).into_iter().next().expect("at-spi2-core, from the package of that name");
    let mut program = Program::start_with(&screen, home.path(), &[], &[("DBUS_SESSION_BUS_ADDRESS", bus)]);
    program.built();
    let begun = Instant::now();
    let (to, path) = loop {
        if let Some(button) = find(&reading, "Help") {
            break button;
        }
        assert!(begun.elapsed() < PATIENCE, "the window is not on the bus");
        std::thread::sleep(Duration::from_millis(200));
    };
    let done = call(&reading, &to, &path, "org.a11y.atspi.Action.DoAction", &["0"]);
    assert!(done.contains("true"), "{done}");
    program.rest_in_dialog("about");
}
