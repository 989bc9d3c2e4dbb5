//! Choosing a file where the system has no dialog of its own: a path that is typed and completed, the ways up and home, a new
//! folder, a folder's list, and a name. Nothing of it needs a keyboard but names.
//!
//! The folder that is looked at and the name are kept in egui's memory under what the dialog is for; the folder that it begins
//! in is remembered by the settings. The button always answers: where a path cannot be used, it says why.
//!
//! Limits: no thumbnails, no sorting but by name; hidden files are not listed, but can be typed.

mod folder;

use super::export::buttons;
use super::icons::Icon;
use super::snapshot::{PathPurpose, PathRequest};
use super::widgets::{IconButton, menu_line, note, palette, text_button};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
use crate::app::theme::TARGET;
use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditState;
use egui::{Align2, CompletionPopup, Id, Key, Margin, RectAlign, Response, ScrollArea, Suggestion, TextEdit};
use egui::{Ui, vec2};
use folder::{Folder, Refusal, Target};
use std::path::{Path, PathBuf};

/// The state of the dialog.
#[derive(Clone, Debug, Default)]
struct Looking {
    folder: Folder,
    /// The path as it is typed.
    address: String,
    /// The folder in which a name of it is completed.
    completing: Folder,
    /// The file's name as it is typed or was chosen.
    name: String,
    /// The name of a folder that is being made.
    new_folder: Option<String>,
    /// Why the last path could not be used.
    refusal: Option<String>,
    /// The file that the next press replaces.
    may_replace: Option<PathBuf>,
    /// The name was offered for writing.
    is_offered: bool,
}

impl Looking {
    fn enter(&mut self, path: &Path, request: &PathRequest) {
        // Without `..` and the like, where that can be had.
        let path = path.canonicalize().unwrap_or_else(|_| path.to_owned());
        self.folder = Folder::read(path, &request.extensions);
        self.address = self.folder.path.display().to_string();
        self.new_folder = None;
        self.forget();
    }

    /// Another name or folder: what was said and asked about the last one holds no more.
    fn forget(&mut self) {
        self.refusal = None;
        self.may_replace = None;
    }
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
        first.enter(&request.folder, request);
        first
    });
    let saves = matches!(request.purpose, PathPurpose::SaveDrawing | PathPurpose::Export);
    let mut chosen = header(ui, &mut looking, request, saves, messages);
    new_folder(ui, &mut looking, request, messages);
    let room = (height - 400.0).clamp(TARGET * 2.0, 420.0);
    let picked = list(ui, &mut looking, request, room, messages);
    let entered = if saves { name_field(ui, &mut looking, messages) } else { picked };
    if let Some(refusal) = &looking.refusal {
        ui.colored_label(palette(ui).warning, refusal);
    }
    chosen = chosen.or(footer(ui, &mut looking, (request, saves), entered, messages, out));
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

/// Where we are, to be typed too, and the ways up, home and into a new folder. Gives a file whose path was typed to be opened.
fn header(
    ui: &mut Ui,
    looking: &mut Looking,
    request: &PathRequest,
    saves: bool,
    messages: &Messages,
) -> Option<PathBuf> {
    let mut chosen = None;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0;
        let above = looking.folder.path.parent().map(Path::to_owned);
        let up = IconButton::new(Icon::Up, messages.get(Msg::PathUp)).enabled(above.is_some());
        if let Some(above) = above.filter(|_| up.show(ui).clicked()) {
            looking.enter(&above, request);
        }
        if IconButton::new(Icon::Home, messages.get(Msg::PathHome)).show(ui).clicked()
            && let Ok(home) = etcetera::home_dir()
        {
            looking.enter(&home, request);
        }
        let is_open = looking.new_folder.is_some();
        let new = IconButton::new(Icon::NewFolder, messages.get(Msg::PathNewFolder)).chosen(is_open);
        if new.show(ui).clicked() {
            looking.new_folder = (!is_open).then(String::new);
        }
        let response = address(ui, looking, request, messages);
        if response.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter)) {
            chosen = follow(looking, request, saves, messages);
        }
    });
    chosen
}

/// The field with the path; names are completed while it is typed.
fn address(ui: &mut Ui, looking: &mut Looking, request: &PathRequest, messages: &Messages) -> Response {
    let shown = looking.folder.path.display().to_string();
    let Looking { folder, address, completing, .. } = looking;
    let field = TextEdit::singleline(address)
        .desired_width(ui.available_width() - 20.0)
        .min_size(vec2(0.0, TARGET))
        .align(Align2::LEFT_CENTER)
        .margin(Margin::symmetric(10, 4));
    let popup = CompletionPopup::new(ui.make_persistent_id("typed path"))
        .word_boundary(|_| false)
        .align(RectAlign::BOTTOM_START)
        .accept_keys([Key::Tab]);
    let output = popup.show(ui, field, |query| {
        if query.text == shown || query.text.is_empty() {
            return Vec::new();
        }
        let parent = folder.parent_of_typed(query.text);
        if completing.path != parent {
            *completing = Folder::read(parent, &request.extensions);
        }
        completing.completions(query.text).into_iter().map(Suggestion::new).collect()
    });
    let response = output.text_edit.response.response;
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_label(messages.get(Msg::PathTyped)));
    response
}

/// Goes where the typed path leads; gives the file that is to be opened.
fn follow(looking: &mut Looking, request: &PathRequest, saves: bool, messages: &Messages) -> Option<PathBuf> {
    let kind = |typed: &str| match saves {
        true => Target::to_write(&looking.folder, typed, &request.extensions),
        false => Target::to_open(&looking.folder, typed, &request.extensions),
    };
    match kind(&looking.address) {
        Target::Folder(path) => looking.enter(&path, request),
        Target::Refused(refusal) => looking.refusal = Some(reason(&refusal, request, messages)),
        Target::File(path) if !saves => return Some(path),
        // The name of a file to write goes to its field, where it is looked at once more.
        Target::File(path) => {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if let Some(parent) = path.parent() {
                looking.enter(parent, request);
            }
            looking.name = name;
        }
    }
    None
}

/// The name of a folder that is to be made, while one is.
fn new_folder(ui: &mut Ui, looking: &mut Looking, request: &PathRequest, messages: &Messages) {
    let Some(mut name) = looking.new_folder.take() else { return };
    let mut makes = false;
    ui.horizontal(|ui| {
        let label = messages.get(Msg::PathMake);
        let field = text_field(&mut name, messages.get(Msg::PathNewFolderName));
        let response = ui.add_sized(vec2(ui.available_width() - 130.0, TARGET), field);
        makes = response.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
        if name.is_empty() && !response.has_focus() && !response.lost_focus() {
            response.request_focus();
        }
        makes |= text_button(ui, Some(Icon::NewFolder), label, false).clicked();
    });
    if !makes {
        looking.new_folder = Some(name);
        return;
    }
    match folder::make(&looking.folder, &name) {
        Ok(path) => looking.enter(&path, request),
        Err(error) => {
            let reason = messages.fill(Msg::PathNotMade, &[("name", &name), ("reason", &error)]);
            looking.refusal = Some(reason);
            looking.new_folder = Some(name);
        }
    }
}

/// Folders, which are entered, and files, which are taken up; whether one was tapped twice.
fn list(ui: &mut Ui, looking: &mut Looking, request: &PathRequest, room: f32, messages: &Messages) -> bool {
    let (mut to, mut taken, mut is_picked) = (None, None, false);
    ScrollArea::vertical().max_height(room).min_scrolled_height(room).auto_shrink([false, false]).show(
        ui,
        |ui| {
            ui.spacing_mut().item_spacing.y = 1.0;
            let Folder { path, folders, files, failure } = &looking.folder;
            if let Some(reason) = failure {
                ui.colored_label(
                    palette(ui).error,
                    messages.fill(Msg::PathUnreadable, &[("reason", reason)]),
                );
            } else if folders.is_empty() && files.is_empty() {
                note(ui, messages.get(Msg::PathEmpty));
            }
            for name in folders {
                if menu_line(ui, Icon::Open, name, "").clicked() {
                    to = Some(path.join(name));
                }
            }
            for name in files {
                let icon = if *name == looking.name { Icon::Check } else { Icon::File };
                let response = menu_line(ui, icon, name, "");
                if response.clicked() {
                    taken = Some(name.clone());
                }
                is_picked |= response.double_clicked();
            }
        },
    );
    if let Some(path) = to {
        looking.enter(&path, request);
    }
    if let Some(name) = taken {
        looking.name = name;
        looking.forget();
    }
    is_picked
}

fn text_field<'a>(text: &'a mut String, hint: &'a str) -> TextEdit<'a> {
    TextEdit::singleline(text).hint_text(hint).align(Align2::LEFT_CENTER).margin(Margin::symmetric(10, 4))
}

/// The name of a file to write; whether Enter was pressed in it.
fn name_field(ui: &mut Ui, looking: &mut Looking, messages: &Messages) -> bool {
    let end = CCursor::new(looking.name.chars().count());
    let field = text_field(&mut looking.name, messages.get(Msg::PathName));
    let response = ui.add_sized(vec2(ui.available_width(), TARGET), field);
    if response.changed() {
        looking.forget();
    }
    let entered = response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    // Enter again answers what the first one asked.
    let is_first = !std::mem::replace(&mut looking.is_offered, true);
    if entered || is_first {
        response.request_focus();
    }
    if is_first {
        // Whoever types another name types it in place of the offered one.
        let mut state = TextEditState::load(ui.ctx(), response.id).unwrap_or_default();
        state.cursor.set_char_range(Some(CCursorRange::two(CCursor::default(), end)));
        state.store(ui.ctx(), response.id);
    }
    entered
}

/// The buttons; a file that exists is replaced only after a second press.
fn footer(
    ui: &mut Ui,
    looking: &mut Looking,
    (request, saves): (&PathRequest, bool),
    entered: bool,
    messages: &Messages,
    out: &mut Vec<Action>,
) -> Option<PathBuf> {
    let mut pressed = entered;
    buttons(ui, |ui| {
        let msg = match (saves, &looking.may_replace) {
            (true, Some(_)) => Msg::PathReplace,
            (true, None) => Msg::PathSave,
            (false, _) => Msg::PathOpen,
        };
        pressed |= text_button(ui, None, messages.get(msg), true).clicked();
        if text_button(ui, None, messages.get(Msg::DialogCancel), false).clicked() {
            out.push(Action::CloseDialog);
        }
    });
    if !pressed {
        return None;
    }
    let (folder, name) = (&looking.folder, &looking.name);
    let target = match saves {
        true => Target::to_write(folder, name, &request.extensions),
        false => Target::to_open(folder, name, &request.extensions),
    };
    match target {
        Target::Folder(path) => {
            looking.enter(&path, request);
            looking.name.clear();
        }
        Target::File(path) if saves && path.exists() && looking.may_replace.as_ref() != Some(&path) => {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            looking.refusal = Some(messages.fill(Msg::PathExists, &[("name", &name)]));
            looking.may_replace = Some(path);
        }
        Target::File(path) => return Some(path),
        Target::Refused(refusal) => {
            looking.refusal = Some(reason(&refusal, request, messages));
            // The name is asked for once more.
            looking.is_offered = false;
        }
    }
    None
}

/// What is said of a path that cannot be used.
fn reason(refusal: &Refusal, request: &PathRequest, messages: &Messages) -> String {
    let path = |msg, path: &Path| messages.fill(msg, &[("path", &path.display())]);
    match refusal {
        Refusal::NoName => messages.get(Msg::PathNoName).to_owned(),
        Refusal::BadName => messages.get(Msg::PathBadName).to_owned(),
        Refusal::NoFolder(folder) => path(Msg::PathNoFolder, folder),
        Refusal::NoFile(file) => path(Msg::PathNoFile, file),
        Refusal::WrongKind(file) => {
            let kinds = request.extensions.join(", ");
            messages.fill(Msg::PathWrongKind, &[("path", &file.display()), ("kinds", &kinds)])
        }
    }
}
