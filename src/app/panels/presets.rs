//! Presets: keeping the look of a plant under a name and using it again.

use super::icons::Icon;
use super::snapshot::Snapshot;
use super::widgets::{IconButton, menu_line, note, palette, section, text_button_sized};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg, Named};
use crate::app::presets::MAX_NAME;
use crate::app::theme::TARGET;
use egui::{Id, TextEdit, Ui, vec2};

/// The presets in the artist's folder.
pub fn show(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    section(ui, messages.get(Msg::PresetsTitle), |ui| {
        if snapshot.presets.is_empty() {
            note(ui, messages.get(Msg::PresetsNone));
        }
        for preset in &snapshot.presets {
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 0.0;
                let room = ui.available_width() - TARGET;
                let line = ui
                    .allocate_ui(vec2(room, TARGET), |ui| menu_line(ui, Icon::Plant, &preset.name, ""))
                    .inner;
                let hint = messages.fill(Msg::PresetsApply, &[("name", &preset.name)]);
                if line.on_hover_text(hint).clicked() {
                    out.push(Action::ApplyPreset(preset.path.clone()));
                }
                let label = messages.fill(Msg::PresetsDelete, &[("name", &preset.name)]);
                let bin = IconButton::new(Icon::Delete, &label).colour(palette(ui).weak);
                if bin.show(ui).clicked() {
                    out.push(Action::DeletePreset(preset.path.clone()));
                }
            });
        }
        save(ui, snapshot, messages, out);
    });
}

/// A name to keep the look under; one is proposed, so that nobody needs a keyboard.
fn save(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let at = Id::unique("name of the next preset");
    let proposed = || proposed_name(snapshot, messages);
    let mut name: String = ui.data(|data| data.get_temp(at)).unwrap_or_else(proposed);
    let field = TextEdit::singleline(&mut name)
        .char_limit(MAX_NAME)
        .hint_text(messages.get(Msg::PresetsName))
        .align(egui::Align2::LEFT_CENTER)
        .margin(egui::Margin::symmetric(10, 4));
    if ui.add_sized(vec2(ui.available_width(), TARGET), field).changed() {
        ui.data_mut(|data| data.insert_temp(at, name.clone()));
    }
    let width = ui.available_width();
    let button = text_button_sized(ui, Some(Icon::Save), messages.get(Msg::PresetsSave), false, Some(width));
    if button.clicked() && !name.trim().is_empty() {
        out.push(Action::SavePreset(name.trim().to_owned()));
        ui.data_mut(|data| data.remove::<String>(at));
    }
}

/// The species' name, with a number that no preset has.
fn proposed_name(snapshot: &Snapshot, messages: &Messages) -> String {
    let stem = std::path::Path::new(&snapshot.species).file_stem().unwrap_or_default().to_string_lossy();
    let species = messages.name(Named::Species, &stem);
    let mut names = (1..).map(|n| format!("{species} {n}"));
    names.find(|name| snapshot.presets.iter().all(|preset| preset.name != *name)).unwrap_or(species)
}
