//! Asking for a file: with the system's dialog where there is one, with our own elsewhere.
//!
//! The system's dialog runs on a thread of its own, so that the window goes on; its answer arrives as an action. A system
//! without a desktop portal (no session bus) is asked by [`Dialog::Path`](super::dialog::Dialog::Path).

use super::action::Action;
use super::dialog::{PathPurpose, PathRequest};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::Sender;

/// What is asked for; without a folder the artist's home.
pub(super) fn request(
    purpose: PathPurpose,
    folder: Option<PathBuf>,
    name: String,
    extensions: Vec<&'static str>,
) -> PathRequest {
    let folder = folder.filter(|f| f.is_dir()).or_else(|| etcetera::home_dir().ok());
    PathRequest { purpose, folder: folder.unwrap_or_else(|| PathBuf::from("/")), name, extensions }
}

/// Opens the system's dialog; the answer is sent and `wake` called.
///
/// # Errors
/// Gives the request back where the system has no dialog.
pub(super) fn ask(
    request: PathRequest,
    answers: &Sender<Action>,
    wake: Arc<dyn Fn() + Send + Sync>,
) -> Result<(), PathRequest> {
    if !has_system_dialog() {
        return Err(request);
    }
    let answers = answers.clone();
    let asked = request.clone();
    let work = move || {
        let answer = match open(&asked) {
            Some(path) => Action::PathChosen { purpose: asked.purpose, path },
            // Whatever was to happen after it will not.
            None => Action::CloseDialog,
        };
        // A window that closed does not listen any more.
        let _ = answers.send(answer);
        wake();
    };
    let thread = std::thread::Builder::new().name("file dialog".into()).spawn(work);
    thread.map(drop).map_err(|_| request)
}

fn open(request: &PathRequest) -> Option<PathBuf> {
    let dialog = rfd::FileDialog::new()
        .set_directory(&request.folder)
        .add_filter(request.extensions.join(", "), &request.extensions);
    match request.purpose {
        PathPurpose::SaveDrawing | PathPurpose::Export => dialog.set_file_name(&request.name).save_file(),
        _ => dialog.pick_file(),
    }
}

/// Whether the system has file dialogs for us: on Linux they come over the session bus.
fn has_system_dialog() -> bool {
    !cfg!(target_os = "linux") || has_session_bus()
}

/// Whether there is a bus on which the desktop's programs speak to each other.
pub(super) fn has_session_bus() -> bool {
    let named = std::env::var_os("DBUS_SESSION_BUS_ADDRESS").is_some_and(|address| !address.is_empty());
    let socket =
        std::env::var_os("XDG_RUNTIME_DIR").is_some_and(|dir| PathBuf::from(dir).join("bus").exists());
    named || socket
}
