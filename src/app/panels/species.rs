//! Choosing a species: a picture of each, and files of the artist's own.

use super::icons::Icon;
use super::snapshot::{PathPurpose, Snapshot};
use super::widgets::{note, palette, section, text_button, text_button_sized};
use super::{species_grid, thumbnails};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg, Named};
use crate::app::theme::ROUND;
use crate::species::Species;
use egui::{Align, CornerRadius, Image, Label, Layout, Rect, RichText, Sense, Ui, UiBuilder, pos2, vec2};
use std::path::Path;

/// Species in a row.
const COLUMNS: usize = 3;
/// Height of the species now, and side of its picture.
const CURRENT: f32 = 56.0;

/// The species of the drawing.
pub fn show(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    section(ui, messages.get(Msg::SpeciesTitle), |ui| {
        current(ui, snapshot, messages, out);
        let missing = snapshot.missing_species.as_ref();
        if let Some(name) = missing {
            note(ui, &messages.fill(Msg::SpeciesGone, &[("name", name)]));
            file_button(ui, Msg::NoticeFind, true, messages, out);
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

/// The species now with its picture, who chose it, and a button: to keep a guess, or to let the drawing decide. As high for both.
fn current(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let species = &snapshot.species;
    let is_file = species.ends_with(".toml");
    let name = match Path::new(species).file_stem().filter(|_| is_file) {
        Some(stem) => messages.fill(Msg::SpeciesOwn, &[("name", &stem.to_string_lossy())]),
        None => messages.name(Named::Species, species),
    };
    let (who, label, action) = if snapshot.species_is_guess {
        let who = if snapshot.blank { Msg::SpeciesNotYet } else { Msg::SpeciesGuessed };
        (who, Msg::SpeciesKeep, Action::SetSpecies(species.clone()))
    } else {
        (Msg::SpeciesChosen, Msg::SpeciesGuess, Action::GuessSpecies)
    };
    let p = palette(ui);
    let row = vec2(ui.available_width(), CURRENT);
    ui.allocate_ui_with_layout(row, Layout::right_to_left(Align::Center), |ui| {
        let is_needed = !(snapshot.blank && snapshot.species_is_guess);
        if is_needed && text_button(ui, None, messages.get(label), false).clicked() {
            out.push(action);
        }
        let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), CURRENT), Sense::hover());
        let picture = Rect::from_min_size(rect.min, vec2(CURRENT, CURRENT));
        ui.painter().rect_filled(picture, CornerRadius::same(ROUND), p.card);
        if let Some(texture) = thumbnails::of_species(ui.ctx(), species) {
            Image::new(&texture).corner_radius(ROUND).paint_at(ui, picture);
        }
        let words = Rect::from_min_max(pos2(picture.right() + 10.0, rect.top()), rect.max);
        let mut words = ui.new_child(UiBuilder::new().max_rect(words).layout(Layout::top_down(Align::Min)));
        words.spacing_mut().item_spacing.y = 0.0;
        words.add_space(6.0);
        words.add(Label::new(RichText::new(name).color(p.text)).truncate());
        words.add(Label::new(RichText::new(messages.get(who)).size(12.0).color(p.weak)).wrap());
    });
    ui.add_space(4.0);
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
        if let Some(name) = species_grid::show(ui, COLUMNS, names, Some(&snapshot.species), messages) {
            out.push(Action::SetSpecies(name.to_owned()));
        }
    });
}
