//! Choosing a file where the system has no dialog of its own: a folder's list, a name, nothing that needs a keyboard.
//!
//! The folder that is looked at and the name are kept in egui's memory under what the dialog is for. A folder is read
//! when it is entered, not in every frame.
//!
//! Limits: no thumbnails, no sorting but by name; hidden files stay hidden.

use super::export::buttons;
use super::icons::Icon;
use super::snapshot::{PathPurpose, PathRequest};
use super::widgets::{IconButton, menu_line, note, palette, text_button};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
use crate::app::theme::TARGET;
use egui::{Id, Label, RichText, ScrollArea, TextEdit, Ui, vec2};
use std::fs;
use std::path::{Path, PathBuf};

/// Most entries of a folder that are listed.
const MAX_ENTRIES: usize = 2000;

/// A folder that is looked at.
#[derive(Clone, Debug, Default)]
struct Looking {
    folder: PathBuf,
    folders: Vec<String>,
    files: Vec<String>,
    failure: Option<String>,
    name: String,
    may_replace: bool,
    /// The name was offered for writing.
    is_offered: bool,
}

impl Looking {
    fn enter(&mut self, folder: PathBuf, extensions: &[&str]) {
        self.folders.clear();
        self.files.clear();
        self.failure = None;
        match fs::read_dir(&folder) {
            Ok(entries) => {
                for entry in entries.flatten().take(MAX_ENTRIES) {
                    let name = entry.file_name().to_string_lossy().into_owned();
                    if name.starts_with('.') {
                        continue;
                    }
                    if entry.path().is_dir() {
                        self.folders.push(name);
                    } else if fits(&name, extensions) {
                        self.files.push(name);
                    }
                }
            }
            Err(error) => self.failure = Some(error.to_string()),
        }
        self.folders.sort_by_key(|name| name.to_lowercase());
        self.files.sort_by_key(|name| name.to_lowercase());
        self.folder = folder;
        self.may_replace = false;
    }
}

fn fits(name: &str, extensions: &[&str]) -> bool {
    let extension = Path::new(name).extension().map(|e| e.to_string_lossy().to_lowercase());
    extensions.is_empty() || extension.is_some_and(|e| extensions.contains(&e.as_str()))
}

/// What stands in the dialog.
pub(super) fn show(
    ui: &mut Ui,
    request: &PathRequest,
    height: f32,
    messages: &Messages,
    out: &mut Vec<Action>,
) {
    let at = Id::unique(("path dialog", request.purpose, &request.folder, &request.name));
    let mut looking: Looking = ui.data(|data| data.get_temp(at)).unwrap_or_else(|| {
        let mut first = Looking { name: request.name.clone(), ..Looking::default() };
        first.enter(request.folder.clone(), &request.extensions);
        first
    });
    let saves = matches!(request.purpose, PathPurpose::SaveDrawing | PathPurpose::Export);
    let entered = header(ui, &looking, messages).or_else(|| list(ui, &mut looking, height, messages));
    if let Some(folder) = entered {
        looking.enter(folder, &request.extensions);
    }
    if saves {
        name_field(ui, &mut looking, messages);
    }
    // Enter in the name field is the loud button.
    let entered = saves && ui.input(|input| input.key_pressed(egui::Key::Enter));
    let chosen = footer(ui, &mut looking, request, entered, messages, out);
    if let Some(path) = chosen {
        out.push(Action::PathChosen { purpose: request.purpose, path });
    }
    let done = out.iter().any(|action| matches!(action, Action::PathChosen { .. } | Action::CloseDialog));
    ui.data_mut(|data| {
        if done {
            data.remove::<Looking>(at);
        } else {
            data.insert_temp(at, looking);
        }
    });
}

/// Where we are, and the ways up and home.
fn header(ui: &mut Ui, looking: &Looking, messages: &Messages) -> Option<PathBuf> {
    let mut to = None;
    ui.horizontal(|ui| {
        let above = looking.folder.parent();
        let up = IconButton::new(Icon::Up, messages.get(Msg::PathUp)).enabled(above.is_some());
        if up.show(ui).clicked() {
            to = above.map(Path::to_owned);
        }
        if IconButton::new(Icon::Home, messages.get(Msg::PathHome)).show(ui).clicked() {
            to = etcetera::home_dir().ok();
        }
        ui.add(Label::new(RichText::new(looking.folder.display().to_string()).monospace()).truncate());
    });
    to
}

/// Folders, which are entered, and files, which are taken up.
fn list(ui: &mut Ui, looking: &mut Looking, height: f32, messages: &Messages) -> Option<PathBuf> {
    let mut to = None;
    let room = (height - 340.0).clamp(TARGET * 2.0, 420.0);
    ScrollArea::vertical().max_height(room).min_scrolled_height(room).auto_shrink([false, false]).show(
        ui,
        |ui| {
            ui.spacing_mut().item_spacing.y = 1.0;
            if let Some(reason) = &looking.failure {
                ui.colored_label(
                    palette(ui).error,
                    messages.fill(Msg::PathUnreadable, &[("reason", reason)]),
                );
            } else if looking.folders.is_empty() && looking.files.is_empty() {
                note(ui, messages.get(Msg::PathEmpty));
            }
            for name in &looking.folders {
                if menu_line(ui, Icon::Open, name, "").clicked() {
                    to = Some(looking.folder.join(name));
                }
            }
            for name in &looking.files {
                let chosen = *name == looking.name;
                if menu_line(ui, if chosen { Icon::Check } else { Icon::File }, name, "").clicked() {
                    looking.name.clone_from(name);
                    looking.may_replace = false;
                }
            }
        },
    );
    to
}

fn name_field(ui: &mut Ui, looking: &mut Looking, messages: &Messages) {
    let field = TextEdit::singleline(&mut looking.name)
        .hint_text(messages.get(Msg::PathName))
        .align(egui::Align2::LEFT_CENTER)
        .margin(egui::Margin::symmetric(10, 4));
    let response = ui.add_sized(vec2(ui.available_width(), TARGET), field);
    if response.changed() {
        looking.may_replace = false;
    }
    if !std::mem::replace(&mut looking.is_offered, true) {
        response.request_focus();
    }
}

/// The buttons; a file that exists is replaced only after a second, different press.
fn footer(
    ui: &mut Ui,
    looking: &mut Looking,
    request: &PathRequest,
    entered: bool,
    messages: &Messages,
    out: &mut Vec<Action>,
) -> Option<PathBuf> {
    let saves = matches!(request.purpose, PathPurpose::SaveDrawing | PathPurpose::Export);
    let path = target(looking, request, saves);
    let mut chosen = None;
    buttons(ui, |ui| {
        let msg = match (saves, looking.may_replace) {
            (true, true) => Msg::PathReplace,
            (true, false) => Msg::PathSave,
            (false, _) => Msg::PathOpen,
        };
        let press =
            ui.add_enabled_ui(path.is_some(), |ui| text_button(ui, None, messages.get(msg), true).clicked());
        if let Some(path) = path.filter(|_| press.inner || entered) {
            if saves && path.exists() && !looking.may_replace {
                looking.may_replace = true;
            } else {
                chosen = Some(path);
            }
        }
        if text_button(ui, None, messages.get(Msg::DialogCancel), false).clicked() {
            out.push(Action::CloseDialog);
        }
    });
    chosen
}

/// The path that the dialog stands for, with the first known extension where a name to save has none.
fn target(looking: &Looking, request: &PathRequest, saves: bool) -> Option<PathBuf> {
    let name = looking.name.trim();
    if name.is_empty() || name.contains(['/', '\\', '\0']) || name == "." || name == ".." {
        return None;
    }
    if !saves {
        return looking.files.iter().any(|file| file == name).then(|| looking.folder.join(name));
    }
    match request.extensions.first() {
        Some(extension) if !fits(name, &request.extensions) => {
            Some(looking.folder.join(format!("{name}.{extension}")))
        }
        _ => Some(looking.folder.join(name)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn looking(name: &str) -> Looking {
        Looking {
            folder: "/tmp".into(),
            files: vec!["a.penstemon".into()],
            name: name.into(),
            ..Looking::default()
        }
    }

    fn request() -> PathRequest {
        PathRequest {
            purpose: PathPurpose::SaveDrawing,
            folder: "/tmp".into(),
            name: String::new(),
            extensions: vec!["penstemon", "svg"],
        }
    }

    #[test]
    fn a_name_without_ending_gets_one() {
        let path = |name: &str| target(&looking(name), &request(), true);
        assert_eq!(path("daisy"), Some("/tmp/daisy.penstemon".into()));
        assert_eq!(path("daisy.SVG"), Some("/tmp/daisy.SVG".into()));
        assert_eq!(path("v1.2"), Some("/tmp/v1.2.penstemon".into()));
    }

    #[test]
    fn no_name_leaves_the_folder() {
        for name in ["", "  ", "..", "../x", "a/b", "a\\b"] {
            assert_eq!(target(&looking(name), &request(), true), None, "{name:?}");
        }
    }

    #[test]
    fn only_files_that_are_there_are_opened() {
        assert_eq!(target(&looking("a.penstemon"), &request(), false), Some("/tmp/a.penstemon".into()));
        assert_eq!(target(&looking("b.penstemon"), &request(), false), None);
    }

    #[test]
    fn hidden_and_other_files_are_not_listed() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["b.penstemon", "A.PENSTEMON", ".hidden.penstemon", "note.txt"] {
            fs::write(folder.path().join(name), "").unwrap();
        }
        fs::create_dir(folder.path().join("sub")).unwrap();
        let mut at = Looking::default();
        at.enter(folder.path().to_owned(), &["penstemon"]);
        assert_eq!(at.files, ["A.PENSTEMON", "b.penstemon"]);
        assert_eq!(at.folders, ["sub"]);
        at.enter(folder.path().join("gone"), &[]);
        assert!(at.failure.is_some() && at.files.is_empty());
    }
}
