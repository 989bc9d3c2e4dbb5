//! Choosing a species: a picture of each, and files of the artist's own.

use super::icons::Icon;
use super::snapshot::{PathPurpose, Snapshot};
use super::widgets::{note, section, text_button_sized};
use super::{thumbnails, tiles};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg, Named};
use crate::species::Species;
use egui::Ui;
use std::path::Path;

/// Species in a row.
const COLUMNS: usize = 3;

/// The species of the drawing.
pub fn show(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    section(ui, messages.get(Msg::SpeciesTitle), |ui| {
        let missing = snapshot.missing_species.as_ref();
        if let Some(name) = missing {
            note(ui, &messages.fill(Msg::SpeciesGone, &[("name", name)]));
            file_button(ui, Msg::NoticeFind, true, messages, out);
        } else if snapshot.species.ends_with(".toml") {
            let name = Path::new(&snapshot.species).file_stem().unwrap_or_default().to_string_lossy();
            note(ui, &messages.fill(Msg::SpeciesOwn, &[("name", &name)]));
        }
        let (growing, drawn): (Vec<&str>, Vec<&str>) =
            Species::all().into_iter().partition(|name| Species::growing().contains(name));
        pictures(ui, &drawn, snapshot, messages, out);
        note(ui, messages.get(Msg::SpeciesGrowing));
        pictures(ui, &growing, snapshot, messages, out);
        if missing.is_none() {
            file_button(ui, Msg::SpeciesFile, false, messages, out);
        }
    });
}

/// Asks for a species file.
fn file_button(ui: &mut Ui, label: Msg, loud: bool, messages: &Messages, out: &mut Vec<Action>) {
    let width = ui.available_width();
    if text_button_sized(ui, Some(Icon::Open), messages.get(label), loud, Some(width)).clicked() {
        out.push(Action::ChooseFile(PathPurpose::Species));
    }
}

/// A picture of each of some species.
fn pictures(ui: &mut Ui, names: &[&str], snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    ui.scope(|ui| {
        tiles::grid(
            ui,
            COLUMNS,
            names.len(),
            |width| width + 22.0,
            |ui, index, size| {
                let name = names[index];
                let picture = thumbnails::of_species(ui.ctx(), name);
                let chosen = snapshot.species == name;
                let label = messages.name(Named::Species, name);
                if tiles::picture(ui, size, picture.as_ref(), &label, true, chosen).clicked() {
                    out.push(Action::SetSpecies(name.to_owned()));
                }
            },
        );
    });
}
