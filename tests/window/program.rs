//! The program under test: a real process with a window, and what it logs on stderr.

use crate::screen::{Area, Pixels, Screen};
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

/// Longest wait for anything; software drivers on a busy machine are slow.
const PATIENCE: Duration = Duration::from_secs(60);

/// Longest time from a move of the mouse to the program's first line about it.
const QUIET: Duration = Duration::from_millis(300);

/// Longer than any thread that has done its work waits for more before it gives free memory back, which it logs.
const IDLE: Duration = Duration::from_millis(1500);

/// Colour of what stands out, in the light theme.
pub(crate) const ACCENT: [u8; 3] = [0x7b, 0x3f, 0x83];

pub(crate) struct Program {
    child: Child,
    lines: Receiver<String>,
    log: Vec<String>,
}

impl Program {
    /// Opens the window, with settings and state below `home`, and gives it the keyboard.
    pub(crate) fn start(screen: &Screen, home: &Path, args: &[&str]) -> Self {
        Self::start_with(screen, home, args, &[])
    }

    /// The same with more in its environment.
    pub(crate) fn start_with(screen: &Screen, home: &Path, args: &[&str], more: &[(&str, &str)]) -> Self {
        let mut command = command(home, args);
        command.envs(more.iter().copied());
        Self::start_command(screen, command)
    }

    /// Opens the window of a command that ends up as the program.
    pub(crate) fn start_command(screen: &Screen, mut command: Command) -> Self {
        command.env("DISPLAY", &screen.display);
        let mut program = Self::spawn(command);
        program.wait_for("the window is drawn by");
        program.raise(screen);
        program
    }

    /// Starts the program and reads its log.
    pub(crate) fn spawn(mut command: Command) -> Self {
        let mut child = command.stderr(Stdio::piped()).spawn().unwrap();
        let (sender, lines) = channel();
        let stderr = BufReader::new(child.stderr.take().unwrap());
        std::thread::spawn(move || {
            stderr.lines().map_while(Result::ok).try_for_each(|line| sender.send(line))
        });
        Self { child, lines, log: Vec::new() }
    }

    pub(crate) fn id(&self) -> u32 {
        self.child.id()
    }

    /// X's number of the window.
    pub(crate) fn window(&self, screen: &Screen) -> String {
        let id = self.id().to_string();
        let found = ["search", "--sync", "--onlyvisible", "--all", "--pid", &id, "--name", "Penstemon"];
        screen.hand(&found).lines().next().unwrap().to_owned()
    }

    /// Puts the window before the others and gives it the keyboard: there is no window manager to do it.
    pub(crate) fn raise(&self, screen: &Screen) {
        let window = self.window(screen);
        screen.hand(&["windowraise", &window, "windowfocus", "--sync", &window]);
    }

    /// Waits for a new line that contains `words` and returns it.
    pub(crate) fn wait_for(&mut self, words: &str) -> String {
        let deadline = Instant::now() + PATIENCE;
        loop {
            match self.lines.recv_timeout(deadline.saturating_duration_since(Instant::now())) {
                Ok(line) => {
                    self.log.push(line.clone());
                    if line.contains(words) {
                        return line;
                    }
                }
                Err(_) => panic!("never logged `{words}`; logged:\n{}", self.log.join("\n")),
            }
        }
    }

    /// The last line logged that contains `words`.
    pub(crate) fn last_logged(&mut self, words: &str) -> String {
        self.log.extend(self.lines.try_iter());
        let line = self.log.iter().rev().find(|line| line.contains(words));
        line.unwrap_or_else(|| panic!("never logged `{words}`; logged:\n{}", self.log.join("\n"))).clone()
    }

    /// What has been logged since the last call.
    pub(crate) fn new_lines(&mut self) -> Vec<String> {
        let new_lines: Vec<String> = self.lines.try_iter().collect();
        self.log.extend(new_lines.iter().cloned());
        new_lines
    }

    /// Whether something that contains `words` has been logged, up to now.
    pub(crate) fn has_logged(&mut self, words: &str) -> bool {
        self.log.extend(self.lines.try_iter());
        self.log.iter().any(|line| line.contains(words))
    }

    /// Waits until the program has carried out everything and sleeps.
    pub(crate) fn rest(&mut self) {
        self.rest_in("at rest", QUIET);
    }

    /// Waits until the program sleeps and all its threads have done the last that they do by themselves.
    pub(crate) fn idle(&mut self) {
        self.rest_in("at rest", IDLE);
    }

    /// Waits until the program sleeps and a dialog of this name is open.
    pub(crate) fn rest_in_dialog(&mut self, name: &str) {
        self.rest_in(&format!("at rest in the dialog {name}"), QUIET);
    }

    /// Waits until the program sleeps in this state and has logged nothing for so long.
    fn rest_in(&mut self, state: &str, quiet: Duration) {
        let deadline = Instant::now() + PATIENCE;
        loop {
            match self.lines.recv_timeout(quiet) {
                Ok(line) => self.log.push(line),
                Err(_) => {
                    let last = self.log.iter().rev().find(|line| line.contains("app::window"));
                    if last.is_some_and(|line| line.contains(state)) {
                        return;
                    }
                }
            }
            assert!(Instant::now() < deadline, "never {state}; logged:\n{}", self.log.join("\n"));
        }
    }

    /// Waits for a new plant and for rest, and returns what was logged last of what was built.
    pub(crate) fn built(&mut self) -> String {
        self.wait_for("built revision");
        self.built_now()
    }

    /// The same for a plant of so many strokes.
    pub(crate) fn built_of(&mut self, strokes: usize) -> String {
        self.wait_for(&format!(" strokes={strokes} "));
        self.built_now()
    }

    fn built_now(&mut self) -> String {
        self.rest();
        self.last_logged("built revision")
    }

    /// What is on the screen once the program rests.
    pub(crate) fn picture(&mut self, screen: &Screen) -> Pixels {
        self.rest();
        screen.still()
    }

    /// What is on the screen once that is as it should be; where it does not become so, what it is at last.
    pub(crate) fn picture_where(&mut self, screen: &Screen, is_so: impl Fn(&Pixels) -> bool) -> Pixels {
        let deadline = Instant::now() + PATIENCE;
        loop {
            let picture = self.picture(screen);
            if is_so(&picture) || Instant::now() > deadline {
                return picture;
            }
        }
    }

    /// Presses the one button that stands out in the dialog of this name, once it is open.
    pub(crate) fn press_loud_button(&mut self, screen: &Screen, dialog: &str) {
        self.rest_in_dialog(dialog);
        let button = self.picture(screen).widest(ACCENT).expect("a button that stands out");
        screen.click(button);
    }

    /// Writes a name into the dialog that asks for a file.
    pub(crate) fn type_name(&mut self, screen: &Screen, name: &str) {
        self.rest_in_dialog("path");
        screen.hand(&["key", "ctrl+a"]);
        screen.hand(&["type", "--delay", "8", name]);
        self.picture(screen).keep("asked-for-a-file");
        screen.hand(&["key", "Return"]);
    }

    /// An area of the window by its name, as last laid out.
    pub(crate) fn area(&mut self, name: &str) -> Area {
        let line = self.log.iter().rev().find(|line| line.contains("layout")).expect("no layout was logged");
        let value = field(line, name);
        let numbers: Vec<f64> = value.split(',').map(|n| n.parse().unwrap()).collect();
        numbers.try_into().unwrap()
    }

    pub(crate) fn is_running(&mut self) -> bool {
        self.child.try_wait().unwrap().is_none()
    }

    pub(crate) fn kill(&mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
    }

    /// Ends the program as the system does when the session ends.
    pub(crate) fn terminate(&mut self) {
        let sent = Command::new("kill").args(["-TERM", &self.id().to_string()]).status().unwrap();
        assert!(sent.success());
    }

    pub(crate) fn wait(&mut self) -> std::process::ExitStatus {
        let deadline = Instant::now() + PATIENCE;
        while Instant::now() < deadline {
            if let Some(status) = self.child.try_wait().unwrap() {
                return status;
            }
            std::thread::sleep(Duration::from_millis(20));
        }
        panic!("the program did not end");
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The program's command with settings and state below `home`, and no display at all.
pub(crate) fn command(home: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_penstemon"));
    command.arg("--verbose").args(args).env("HOME", home).env("LANG", "en_GB.UTF-8").env("NO_COLOR", "1");
    // No session bus: the program asks for files with its own dialog.
    command.env("XDG_RUNTIME_DIR", home);
    let theirs =
        ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET", "DBUS_SESSION_BUS_ADDRESS", "LANGUAGE", "LC_ALL"];
    let folders = ["XDG_CONFIG_HOME", "XDG_STATE_HOME", "XDG_DATA_HOME"];
    for name in
        theirs.into_iter().chain(folders).chain(["LC_MESSAGES", "WGPU_BACKEND", "WINIT_X11_SCALE_FACTOR"])
    {
        command.env_remove(name);
    }
    command
}

/// The value of `name=value` in a line.
pub(crate) fn field<'a>(line: &'a str, name: &str) -> &'a str {
    let start = line.find(&format!("{name}=")).unwrap_or_else(|| panic!("no {name} in {line}"));
    line[start + name.len() + 1..].split_whitespace().next().unwrap()
}
