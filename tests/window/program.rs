//! The program under test: a real process with a window, and what it tells on stderr.

use crate::screen::{Area, Screen};
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

/// Longest wait for anything; software drivers on a busy machine are slow.
const PATIENCE: Duration = Duration::from_secs(60);

pub(crate) struct Program {
    child: Child,
    lines: Receiver<String>,
    told: Vec<String>,
}

impl Program {
    /// Starts the program with its settings and its state below `home`.
    pub(crate) fn start(screen: &Screen, home: &Path, args: &[&str]) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_penstemon"))
            .arg("--verbose")
            .args(args)
            .env("DISPLAY", &screen.display)
            .env("HOME", home)
            .env("LANG", "en_GB.UTF-8")
            .env("NO_COLOR", "1")
            .env("XDG_RUNTIME_DIR", home)
            .env_remove("WAYLAND_DISPLAY")
            .env_remove("DBUS_SESSION_BUS_ADDRESS")
            .env_remove("XDG_CONFIG_HOME")
            .env_remove("XDG_STATE_HOME")
            .env_remove("XDG_DATA_HOME")
            .env_remove("LC_ALL")
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let (tell, lines) = channel();
        let stderr = BufReader::new(child.stderr.take().unwrap());
        std::thread::spawn(move || stderr.lines().map_while(Result::ok).try_for_each(|line| tell.send(line)));
        Self { child, lines, told: Vec::new() }
    }

    /// Waits for a new line that contains `words` and returns it.
    pub(crate) fn wait_for(&mut self, words: &str) -> String {
        let deadline = Instant::now() + PATIENCE;
        loop {
            match self.lines.recv_timeout(deadline.saturating_duration_since(Instant::now())) {
                Ok(line) => {
                    self.told.push(line.clone());
                    if line.contains(words) {
                        return line;
                    }
                }
                Err(_) => panic!("never told `{words}`; told:\n{}", self.told.join("\n")),
            }
        }
    }

    /// Waits until nothing has been told for a while, and returns the last line told that contains `words`.
    pub(crate) fn settle(&mut self, words: &str) -> String {
        let mut last = self.wait_for(words);
        while let Ok(line) = self.lines.recv_timeout(Duration::from_millis(700)) {
            self.told.push(line.clone());
            if line.contains(words) {
                last = line;
            }
        }
        last
    }

    /// An area of the window by its name, as last laid out.
    pub(crate) fn area(&mut self, name: &str) -> Area {
        let line = self.told.iter().rev().find(|line| line.contains("layout")).expect("no layout was told");
        let value = field(line, name);
        let numbers: Vec<f64> = value.split(',').map(|n| n.parse().unwrap()).collect();
        numbers.try_into().unwrap()
    }

    pub(crate) fn kill(&mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
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

/// The value of `name=value` in a line.
pub(crate) fn field<'a>(line: &'a str, name: &str) -> &'a str {
    let start = line.find(&format!("{name}=")).unwrap_or_else(|| panic!("no {name} in {line}"));
    line[start + name.len() + 1..].split_whitespace().next().unwrap()
}
