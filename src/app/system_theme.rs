//! Whether the system's colours are light or dark.
//!
//! Windows and macOS report it through winit. On Linux desktops report it over the session bus (the settings portal's
//! `org.freedesktop.appearance color-scheme`); one of three small programs that speak to the bus is asked: every desktop
//! has at least one. That happens on a thread, when the window opens and when it is looked at again.
//!
//! Limits: a change is seen when the window gets the focus. Desktops without the portal have no opinion.

use super::file_dialog::has_session_bus;
use std::process::{Command, Stdio};

const SERVICE: &str = "org.freedesktop.portal.Desktop";
const PATH: &str = "/org/freedesktop/portal/desktop";
const SETTINGS: &str = "org.freedesktop.portal.Settings";
const NAMESPACE: &str = "org.freedesktop.appearance";
const KEY: &str = "color-scheme";

/// Whether there is somebody to ask.
pub(super) fn can_be_asked() -> bool {
    cfg!(target_os = "linux") && has_session_bus()
}

/// Asks the desktop; up to some seconds. `None` where it has no opinion.
pub(super) fn ask() -> Option<egui::Theme> {
    let method = format!("{SETTINGS}.Read");
    let (namespace, key) = (format!("string:{NAMESPACE}"), format!("string:{KEY}"));
    let (service, reply) = (format!("--dest={SERVICE}"), "--print-reply=literal");
    let gdbus = ["call", "--session", "--timeout=2", "--dest", SERVICE, "--object-path", PATH, "--method"];
    let gdbus = [gdbus.as_slice(), &[&method, NAMESPACE, KEY]].concat();
    let ways: [(&str, &[&str]); 3] = [
        ("busctl", &["--user", "--timeout=2", "call", SERVICE, PATH, SETTINGS, "Read", "ss", NAMESPACE, KEY]),
        ("gdbus", &gdbus),
        (
            "dbus-send",
            &["--session", "--reply-timeout=2000", reply, &service, PATH, &method, &namespace, &key],
        ),
    ];
    ways.iter().find_map(|(program, words)| answer(program, words)).and_then(|reply| scheme(&reply))
}

/// What a program says, if it is there and content.
fn answer(program: &str, words: &[&str]) -> Option<String> {
    let done = Command::new(program).args(words).stdin(Stdio::null()).stderr(Stdio::null()).output().ok()?;
    done.status.success().then(|| String::from_utf8_lossy(&done.stdout).into_owned())
}

/// The scheme in an answer: the last number in it.
fn scheme(reply: &str) -> Option<egui::Theme> {
    match reply.split(|c: char| !c.is_ascii_digit()).rfind(|number| !number.is_empty())? {
        "1" => Some(egui::Theme::Dark),
        "2" => Some(egui::Theme::Light),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_way_of_saying_it_is_understood() {
        for reply in ["v v u 1\n", "(<<uint32 1>>,)\n", "   variant       variant          uint32 1\n"] {
            assert_eq!(scheme(reply), Some(egui::Theme::Dark), "{reply}");
            assert_eq!(scheme(&reply.replace('1', "2")), Some(egui::Theme::Light), "{reply}");
            assert_eq!(scheme(&reply.replace('1', "0")), None, "{reply}");
        }
        assert_eq!(scheme(""), None);
    }
}
